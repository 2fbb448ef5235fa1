//! Says that shaders are being compiled, where that takes long enough to wonder.

use super::seconds::each_second;

pub use super::seconds::is_due;

/// What an engine is to call: `show` is called from another thread with the seconds that compiling has taken, each
/// second from the first on, and no more once compiling is over.
pub fn watch_compiling(show: impl Fn(u64) + Clone + Send + Sync + 'static) -> impl Fn(bool) + Send + Sync + 'static {
    each_second(show)
}

/// The line for users; where nothing can be written over, it is shown at 1, 10, 20, .. seconds.
pub fn line(seconds: u64) -> String {
    format!("compiling shaders, {seconds} s (a driver keeps them for later runs)")
}
