//! What comes before a first picture: compiling is told, and no more is compiled than is run.

use std::path::Path;
use std::process::Command;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{UVec2, Vec3};
use lucerna::Engine;
use lucerna::app::shared::compiling::watch_compiling;
use lucerna::components::{Environment, Film, Integrator, Render};
use lucerna::scene::{self, SceneDescription};
use lucerna::shader::Library;

use crate::support;

const STEP: Duration = Duration::from_secs(10);

fn small_box() -> SceneDescription {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/cornell-box.ron");
    let mut description = scene::load(&path, &[]).unwrap().description;
    description.film = Film { size: UVec2::splat(8), ..description.film };
    description.render = Render { spp: 1, max_depth: 2, integrator: Integrator::Bsdf, ..description.render };
    description
}

/// Finishes the film. How often compiling was told to begin, and each time to be over.
fn compilations(engine: &mut Engine, told: &Mutex<Vec<bool>>) -> usize {
    while !engine.step(STEP).unwrap().finished {}
    let told = std::mem::take(&mut *told.lock().unwrap());
    assert!(told.chunks(2).all(|pair| pair == [true, false]), "{told:?}");
    told.len() / 2
}

#[test]
fn compiling_is_told_when_it_happens() {
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &small_box()).unwrap();
    let told: Arc<Mutex<Vec<bool>>> = Arc::default();
    let listener = told.clone();
    engine.on_compiling(move |begins| listener.lock().unwrap().push(begins));
    assert!(compilations(&mut engine, &told) > 0, "the first picture");
    assert_eq!(compilations(&mut engine, &told), 0, "nothing to do");
    engine.edit(|world| {
        let mut renders = world.query::<&mut Render>();
        renders.iter_mut(world).for_each(|mut render| render.seed += 1);
    });
    assert_eq!(compilations(&mut engine, &told), 0, "another seed");
    engine.edit(|world| world.spawn((Name::new("sky"), Environment::Constant(Vec3::ONE))).id());
    assert!(compilations(&mut engine, &told) > 0, "a feature that was not there");
}

#[test]
fn only_compiling_that_takes_long_is_shown() {
    let shown: Arc<Mutex<Vec<u64>>> = Arc::default();
    let seen = shown.clone();
    let told = watch_compiling(move |seconds| seen.lock().unwrap().push(seconds));
    told(true);
    told(false);
    std::thread::sleep(Duration::from_millis(1200));
    assert!(shown.lock().unwrap().is_empty(), "over at once");
    told(true);
    std::thread::sleep(Duration::from_millis(2600));
    told(false);
    let seconds = shown.lock().unwrap().clone();
    assert!(seconds.starts_with(&[1]) && seconds.len() <= 3, "{seconds:?}");
    std::thread::sleep(Duration::from_millis(1200));
    assert_eq!(*shown.lock().unwrap(), seconds, "over");
}

/// Compiling the passes of the tree took 2.9 s of Mesa 22 and 17 s of Mesa 25, before a tree of milliseconds.
#[test]
fn the_first_tree_on_a_processor_waits_for_no_compiler() {
    if !support::gpu().is_software() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let run = Command::new(env!("CARGO_BIN_EXE_lucerna"))
        .args(["render", "cornell-box", "--size", "16x16", "--spp", "1", "--json", "--quiet", "-o"])
        .arg(folder.path().join("a.png"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("MESA_SHADER_CACHE_DISABLE", "true")
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let report: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    let passes: Vec<&str> =
        report["passes"].as_array().unwrap().iter().map(|pass| pass["name"].as_str().unwrap()).collect();
    assert!(
        passes.contains(&"path") && !passes.iter().any(|pass| pass.contains("sort") || *pass == "nodes"),
        "{passes:?}"
    );
}
