//! What comes before a first picture: compiling is told, and no more is compiled than is run.

use std::path::{Path, PathBuf};
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

/// Renders in another process that keeps its pipelines in a folder. Says how many it made, and how many of those an earlier start had left.
fn pipelines_made(kept_in: &str) -> (u64, u64) {
    let folder = tempfile::tempdir().unwrap();
    let run = Command::new(env!("CARGO_BIN_EXE_lucerna"))
        .args(["render", "cornell-box", "--size", "16x16", "--spp", "1", "--json", "--quiet", "-o"])
        .arg(folder.path().join("a.png"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("LUCERNA_PIPELINE_CACHE", kept_in)
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let report: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    let sum = |key: &str| report["compiled"].as_array().unwrap().iter().map(|pass| pass[key].as_u64().unwrap()).sum();
    (sum("count"), sum("kept"))
}

/// Every file below a folder.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files_below(&path) } else { vec![path] }).collect()
}

/// A file with another adapter in wgpu's header, and a checksum that is right again.
fn of_another_device(file: &[u8]) -> Vec<u8> {
    let mut bytes = file[8..].to_vec();
    // Behind a magic of 8 bytes, two versions of 4 and the backend.
    bytes[17] ^= 1;
    let mut hasher = std::hash::DefaultHasher::new();
    std::hash::Hash::hash(&bytes[..], &mut hasher);
    let mut file = std::hash::Hasher::finish(&hasher).to_le_bytes().to_vec();
    file.extend(bytes);
    file
}

#[test]
fn pipelines_are_kept_for_the_next_start_and_damage_costs_a_compile() {
    if !support::gpu().features.contains(wgpu::Features::PIPELINE_CACHE) {
        return;
    }
    let cache = tempfile::tempdir().unwrap();
    let place = cache.path().to_str().unwrap();
    let (made, kept) = pipelines_made(place);
    assert!(made > 0 && kept == 0, "the first start made {made} pipelines, {kept} of them kept before");
    assert_eq!(pipelines_made(place), (made, made), "the second start");
    let files = files_below(cache.path());
    assert_eq!(files.len() as u64, made, "{files:?}");
    for (number, file) in files.iter().enumerate() {
        let mut bytes = std::fs::read(file).unwrap();
        match number % 3 {
            0 => bytes.clear(),
            1 => bytes.truncate(bytes.len() / 2),
            _ => *bytes.last_mut().unwrap() ^= 1,
        }
        std::fs::write(file, bytes).unwrap();
    }
    assert_eq!(pipelines_made(place), (made, 0), "all files were damaged");
    assert_eq!(pipelines_made(place), (made, made), "and mended");
    for file in &files {
        std::fs::write(file, of_another_device(&std::fs::read(file).unwrap())).unwrap();
    }
    assert_eq!(pipelines_made(place).0, made, "all files were of another device");
    assert_eq!(pipelines_made(place), (made, 0), "and are gone");
    assert_eq!(pipelines_made(place), (made, made), "and made anew");
    assert_eq!(pipelines_made("off"), (made, 0), "off");
}

#[test]
fn a_folder_that_cannot_be_had_keeps_nothing_and_fails_nothing() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let (made, kept) = pipelines_made(file.path().join("below").to_str().unwrap());
    assert!(made > 0 && kept == 0);
}
