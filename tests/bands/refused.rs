//! What a device has no room for is said before any work is done on it.

use std::sync::Arc;
use std::time::Duration;

use glam::{DVec3, UVec2};
use lucerna::components::{Film, Geometry, MeshData, Name};
use lucerna::gpu::GpuError;
use lucerna::scene;
use lucerna::shader::Library;
use lucerna::{Engine, EngineError};

use super::lucerna;
use crate::support;

const STEP: Duration = Duration::from_millis(100);

fn open() -> Engine {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/cornell-data.ron");
    let defines =
        [("film.size", "(16,16)"), ("render.spp", "1")].map(|(path, value)| scene::Define::given(path, value));
    let description = scene::load(&path, &defines).unwrap_or_else(|e| panic!("{e:?}")).description;
    Engine::open(support::gpu(), Library::shipped(), &description).unwrap()
}

fn set_size(engine: &mut Engine, size: UVec2) {
    engine.edit(|world| world.query::<&mut Film>().iter_mut(world).for_each(|mut film| film.size = size));
}

/// What refuses it, and nothing else, is entered.
fn refused(engine: &mut Engine, by: &str) -> GpuError {
    let before = engine.entered().clone();
    let Err(EngineError::Gpu(error)) = engine.step(STEP) else { panic!("it is not refused") };
    let since: Vec<&str> =
        engine.entered().iter().filter(|(name, n)| before.get(*name) != Some(n)).map(|(name, _)| *name).collect();
    assert_eq!(since, [by]);
    assert_eq!(engine.dispatches().len(), 0);
    error
}

fn finish(engine: &mut Engine) {
    while !engine.step(STEP).unwrap().finished {}
}

#[test]
fn a_film_is_refused_before_the_scene_is_taken_up() {
    let most = support::gpu().most_bytes();
    let side = ((most / 64).isqrt() + 1) as u32;
    let mut engine = open();
    set_size(&mut engine, UVec2::splat(side));
    // As often as it is tried.
    for _ in 0..2 {
        let error = refused(&mut engine, "refuse_film");
        assert!(matches!(error, GpuError::TooLarge { name: "film", .. }), "{error}");
        let need = u64::from(side) * u64::from(side) * 64;
        assert!(error.to_string().contains(&need.to_string()) && error.to_string().contains(&most.to_string()));
    }
    set_size(&mut engine, UVec2::splat(16));
    finish(&mut engine);
}

/// One small mesh, so many times that its triangles don't fit: no more than its place is known of each.
#[test]
fn triangles_are_refused_before_they_are_flattened() {
    let most = support::gpu().most_bytes();
    let strip: Vec<[u32; 3]> = (0..10_000).map(|i| [i, i + 1, i + 2]).collect();
    let positions = (0..10_002).map(|i| DVec3::new(f64::from(i), f64::from(i % 2), 0.0)).collect();
    let mesh = Arc::new(MeshData { positions, triangles: strip, ..MeshData::default() });
    let mut engine = open();
    let copies = most / 40 / 10_000 + 1;
    let added = engine.edit(|world| {
        let add = |i: u64| world.spawn((Name::new(format!("copy {i}")), Geometry(mesh.clone()))).id();
        (0..copies).map(add).collect::<Vec<_>>()
    });
    let error = refused(&mut engine, "refuse_meshes");
    assert!(matches!(error, GpuError::TooLarge { .. }), "{error}");
    use miette::Diagnostic;
    assert!(error.help().unwrap().to_string().starts_with("use fewer triangles: about "), "{error}");
    engine.edit(|world| added.into_iter().for_each(|entity| assert!(world.despawn(entity))));
    finish(&mut engine);
}

#[test]
fn commands_that_have_no_bands_say_what_does() {
    let folder = tempfile::tempdir().unwrap();
    let scene = super::scene("cornell-data");
    let run = lucerna(folder.path(), Some(64 << 10), &["watch", &scene, "--size", "64x64"]);
    let said = String::from_utf8(run.stderr).unwrap();
    assert!(run.status.code() == Some(1) && said.matches("error:").count() == 1, "{said}");
    assert!(said.contains("the buffer `film` needs 262144 bytes, more than 65536 bytes"), "{said}");
    assert!(said.contains("`lucerna render` makes larger ones in bands"), "{said}");
}

#[test]
fn a_limit_that_is_none_is_refused_and_an_empty_one_is_not_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let doctor = |most: &str| {
        let mut command = super::command(folder.path(), None, &["doctor"]);
        command.env("LUCERNA_MOST_BUFFER", most).output().unwrap()
    };
    let own = lucerna(folder.path(), None, &["doctor"]);
    for empty in ["", " "] {
        assert_eq!(doctor(empty).stdout, own.stdout, "{empty:?}");
    }
    let limited = String::from_utf8(doctor("2097152").stdout).unwrap();
    assert!(limited.contains("buffers: 2 MiB, bound 2 MiB at a time"), "{limited}");
    // More than the adapter has is what the adapter has.
    assert_eq!(doctor("999999999999999").stdout, own.stdout);
    for wrong in ["0", "-1", "65535", "64k", "1e9", "99999999999999999999"] {
        let run = doctor(wrong);
        let said = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(3), "{wrong}: {said}");
        assert!(said.contains(&format!("LUCERNA_MOST_BUFFER is `{wrong}`")) && said.contains("65536"), "{said}");
        assert_eq!(said.matches("error:").count(), 1, "{said}");
    }
}

#[test]
fn a_robust_mean_is_left_out_of_bands_with_a_word() {
    let folder = tempfile::tempdir().unwrap();
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_lucerna"))
        .args(["render", "cornell-data", "--size", "64x64", "--spp", "2", "--robust", "--sources", "--json", "-o"])
        .arg(folder.path().join("a.png"))
        .env("LUCERNA_MOST_BUFFER", "100000")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let [said, told] = [&run.stdout, &run.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    assert!(run.status.success(), "{told}");
    assert!(told.contains("--robust and --sources are left out"), "{told}");
    let report: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert!(report["bands"].is_array() && report["robust"].is_null() && report["sources"].is_null(), "{report}");
}
