//! What the tests share.

pub mod dice;
pub mod families;
pub mod patience;
pub mod plant;
pub mod stage;
pub mod trees;

use std::sync::{Arc, OnceLock};

use lucerna::gpu::{Gpu, Runtime};
use lucerna::shader::Library;
use lucerna::stress::{Lab, Scale};

/// The one device of all tests.
pub fn gpu() -> Arc<Gpu> {
    static GPU: OnceLock<Arc<Gpu>> = OnceLock::new();
    GPU.get_or_init(|| Gpu::open().expect("the tests need a graphics adapter: `sh setup.sh` installs one")).clone()
}

/// A runtime of its own for one test, with the shipped shaders.
pub fn rig() -> Runtime {
    Runtime::new(gpu(), Library::shipped())
}

/// Whether to run the sizes that are meant for a real GPU: `LUCERNA_STRESS=1`.
pub fn stress() -> bool {
    std::env::var("LUCERNA_STRESS").is_ok_and(|v| v == "1")
}

/// What rows of stress are measured on here.
pub fn lab() -> Lab {
    Lab::new(gpu(), if stress() { Scale::Full } else { Scale::Test })
}
