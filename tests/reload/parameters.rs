//! Parameters of shaders while an engine runs: another value compiles nothing, and makes anew what reads it.

use lucerna::Engine;
use lucerna::components::{ShaderValue, ShaderValues};
use lucerna::watch::ReloadEvent;

use super::Bench;

const LAMBERT: &str = "shaders/lib/bsdf/lambert.wgsl";
const VALUE: &str = "return kd * (INV_PI * cos_theta);";
const DISPLAY: &str = "shaders/passes/display/display.wgsl";

/// Declares a parameter behind the imports of a module, and reads it.
fn declare(bench: &Bench, file: &str, declared: &str, from: &str, to: &str) {
    let text = bench.read(file);
    let (head, rest) = text.split_at(text.rfind("import ").map_or(0, |at| at + text[at..].find('\n').unwrap() + 1));
    assert!(rest.contains(from), "{file} has no `{from}`");
    bench.write(file, &format!("{head}{declared}\n{}", rest.replace(from, to)));
}

/// A bench whose diffuse surfaces are as bright as a parameter says.
fn bench() -> Bench {
    let mut bench = Bench::new();
    declare(
        &bench,
        LAMBERT,
        "@range(0.0, 4.0) override BRIGHT: f32 = 1.0;",
        VALUE,
        "return kd * (BRIGHT * INV_PI * cos_theta);",
    );
    // The kernel takes a shortcut past the value where there are diffuse surfaces alone.
    bench.replace(
        "shaders/lib/bsdf/mixture.wgsl",
        "weight = select(vec3<f32>(0.0), m.kd, at.pdf > 0.0);",
        "weight = select(vec3<f32>(0.0), at.value / at.pdf, at.pdf > 0.0);",
    );
    assert_eq!(bench.reloaded(), "film");
    bench.finish();
    bench
}

fn set(engine: &mut Engine, name: &str, value: f64) {
    engine.edit(|world| {
        for mut values in world.query::<&mut ShaderValues>().iter_mut(world) {
            values.0.insert(name.to_owned(), ShaderValue::Number(value));
        }
    });
}

fn mean(bench: &mut Bench) -> f64 {
    bench.film().mean.iter().sum()
}

#[test]
fn another_value_compiles_nothing_and_is_the_film_of_that_code() {
    let mut bench = bench();
    let first = mean(&mut bench);
    let compiled = bench.engine.compiled();
    let ran = bench.dispatches(|bench| set(&mut bench.engine, "BRIGHT", 2.0));
    assert_eq!(ran.into_keys().collect::<Vec<_>>(), ["accumulate", "display", "path"]);
    let film = bench.film();
    assert!(film.mean.iter().sum::<f64>() > 1.2 * first, "{:?} {first}", film.mean);
    assert_eq!(bench.engine.compiled(), compiled);
    assert!(bench.engine.reads("BRIGHT") && !bench.engine.reads("OTHER"));
    // To the bit what the number gives where it stands in the code.
    bench.replace(LAMBERT, "@range(0.0, 4.0) override BRIGHT: f32 = 1.0;", "const BRIGHT: f32 = 2.0;");
    assert_eq!(bench.fresh_film().pixels, film.pixels);
}

#[test]
fn the_same_value_makes_nothing_anew() {
    let mut bench = bench();
    let ran = bench.dispatches(|bench| set(&mut bench.engine, "BRIGHT", 1.0));
    assert!(ran.is_empty(), "the default, set: {ran:?}");
    let ran = bench.dispatches(|bench| set(&mut bench.engine, "NOBODYS", 1.0));
    assert!(ran.is_empty(), "what no shader has: {ran:?}");
}

#[test]
fn what_only_the_picture_reads_leaves_the_film() {
    let mut bench = Bench::new();
    declare(
        &bench,
        DISPLAY,
        "@range(0, 2) override DARK: u32 = 0;",
        "srgb8(linear)",
        "srgb8(linear * exp2(-f32(DARK)))",
    );
    assert_eq!(bench.reloaded(), "picture");
    let first = bench.film();
    let ran = bench.dispatches(|bench| set(&mut bench.engine, "DARK", 2.0));
    assert_eq!(ran.into_keys().collect::<Vec<_>>(), ["display"]);
    let second = bench.film();
    assert!(second.pixels == first.pixels && second.picture != first.picture);
    let upload = bench.engine.uploads()["params"];
    set(&mut bench.engine, "DARK", 1.0);
    bench.finish();
    assert!(bench.engine.uploads()["params"] - upload < 64, "its own parameters, and a word");
}

#[test]
fn a_save_of_range_and_default_is_followed() {
    let mut bench = bench();
    let declared = |bench: &Bench| {
        let parameters = bench.engine.parameters();
        (parameters[0].name.clone(), parameters[0].default, parameters[0].range)
    };
    assert_eq!(declared(&bench), ("BRIGHT".to_owned(), 1.0, Some([0.0, 4.0])));
    let compiled = bench.engine.compiled();
    let dark = mean(&mut bench);

    // The default is what counts until something is set.
    bench.replace(LAMBERT, "f32 = 1.0;", "f32 = 3.0;");
    assert_eq!(bench.reloaded(), "film");
    let bright = mean(&mut bench);
    assert!(bright > 1.5 * dark, "{dark} {bright}");

    // What is set stays where it is in range, whatever the default.
    set(&mut bench.engine, "BRIGHT", 2.0);
    let middle = mean(&mut bench);
    assert!(dark < middle && middle < bright);
    bench.replace(
        LAMBERT,
        "@range(0.0, 4.0) override BRIGHT: f32 = 3.0;",
        "@range(0.0, 8.0) override BRIGHT: f32 = 0.5;",
    );
    assert_eq!(bench.reloaded(), "nothing");
    assert_eq!((declared(&bench).2, mean(&mut bench)), (Some([0.0, 8.0]), middle));

    // Beyond the range the default counts, and that is told.
    bench.replace(
        LAMBERT,
        "@range(0.0, 8.0) override BRIGHT: f32 = 0.5;",
        "@range(0.0, 1.0) override BRIGHT: f32 = 1.0;",
    );
    let warned = bench.wait("reload", |event| match event {
        ReloadEvent::Reloaded { warnings, restarts, .. } => {
            assert_eq!(restarts.to_string(), "film");
            Some(warnings.iter().map(|warning| warning.message.clone()).collect::<Vec<_>>())
        }
        _ => None,
    });
    assert!(
        warned.len() == 1 && warned[0].contains("shader.BRIGHT: expected a number from 0 to 1, found `2`"),
        "{warned:?}"
    );
    assert_eq!(mean(&mut bench), dark);
    assert_eq!(bench.engine.compiled(), compiled, "none of it is other code");
}

#[test]
fn a_scene_sets_what_there_is_and_is_refused_for_what_there_is_not() {
    let mut bench = bench();
    let dark = mean(&mut bench);
    bench.replace("scene.ron", "    materials:", "    shader: { \"BRIGHT\": 2.5 },\n    materials:");
    assert_eq!(bench.reloaded(), "film");
    let bright = mean(&mut bench);
    assert!(bright > 1.3 * dark);

    bench.replace("scene.ron", "2.5", "25");
    let (file, line, column, message) = bench.failed();
    assert_eq!((file.as_str(), line, column), ("scene.ron", 6, 25), "{message}");
    assert!(message.contains("shader.BRIGHT: expected a number from 0 to 4, found `25`"), "{message}");
    assert_eq!(mean(&mut bench), bright, "the scene as it was");

    bench.replace("scene.ron", "\"BRIGHT\": 25", "\"BRIGTH\": 2.5");
    let (_, line, _, message) = bench.failed();
    assert!(line == 6 && message.contains("no module has `override BRIGTH`"), "{message}");

    // What was moved beside the file stays, as long as the file says what it said.
    bench.replace("scene.ron", "\"BRIGTH\": 2.5", "\"BRIGHT\": 2.5");
    bench.reloaded();
    set(&mut bench.engine, "BRIGHT", 1.0);
    bench.replace("scene.ron", "exposure: 0.0", "exposure: 1.0");
    bench.reloaded();
    assert_eq!(mean(&mut bench), dark);
    bench.replace("scene.ron", "    shader: { \"BRIGHT\": 2.5 },\n", "");
    bench.reloaded();
    assert_eq!(mean(&mut bench), dark, "the default");
}
