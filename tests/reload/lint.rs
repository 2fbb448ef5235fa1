//! Surface code is linted after it has shown its first pixels; what is found is told, and nothing is taken back.

use std::time::{Duration, Instant};

use super::Bench;
use lucerna::watch::ReloadEvent;

/// Waits for a lint's outcome; returns its warnings.
fn linted(bench: &mut Bench) -> Vec<String> {
    let told = |event: &ReloadEvent| match event {
        ReloadEvent::Linted { warnings, .. } => Some(warnings.iter().map(|w| w.diagnostic.to_string()).collect()),
        _ => None,
    };
    bench.wait("lint", told)
}

#[test]
fn a_save_of_surface_code_is_linted() {
    let mut bench = Bench::new();
    let right = bench.replace(
        "shaders/lib/bsdf/lambert.wgsl",
        "return INV_PI * cos_theta;",
        "return 0.5 * INV_PI * cos_theta;",
    );
    // Not before the first pixels: what came before them is dropped here.
    bench.wait("first pixels", |event| matches!(event, ReloadEvent::FirstPixels { .. }).then_some(()));
    let warnings = linted(&mut bench);
    let named =
        |text: &String| text.starts_with("lib/bsdf/lambert.wgsl: mixture_evaluate's pdf") && text.contains("0.5");
    assert!(warnings.iter().any(named), "{warnings:?}");
    // It runs all the same: a warning is no problem that stands.
    assert!(bench.engine.problems().is_empty());
    assert!(bench.film().pixels == bench.fresh_film().pixels);

    bench.write("shaders/lib/bsdf/lambert.wgsl", &right);
    assert_eq!(linted(&mut bench), [""; 0]);
}

#[test]
fn other_saves_are_not() {
    let mut bench = Bench::new();
    let is_lint = |event: &ReloadEvent| matches!(event, ReloadEvent::Linted { .. });
    bench.replace("shaders/lib/bsdf/lambert.wgsl", "// Lambert reflection", "// Lambert's reflection");
    assert_eq!(bench.reloaded(), "nothing");
    // The film starts anew, but no surface's code is another.
    bench.replace("shaders/passes/trace/path.wgsl", "id.z < params.layers", "params.layers > id.z");
    assert_eq!(bench.reloaded(), "film");
    let begin = Instant::now();
    while begin.elapsed() < Duration::from_millis(700) {
        bench.step();
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(!bench.events.iter().any(is_lint), "{:?}", bench.events);
}
