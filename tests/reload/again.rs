//! Shaders that ran before run again, whatever the files hold.

use lucerna::shader::Library;

use super::Bench;

const DISPLAY: &str = "shaders/passes/display/display.wgsl";

fn kept(bench: &Bench) -> Library {
    bench.engine.library()
}

#[test]
fn shaders_run_again_and_the_next_save_goes_on_from_the_files() {
    let mut bench = Bench::new();
    let (first, first_film) = (kept(&bench), bench.film());
    bench.replace(DISPLAY, "srgb8(linear)", "srgb8(linear * 0.5)");
    assert_eq!(bench.reloaded(), "picture");
    let dark = bench.film();
    assert!(dark.picture != first_film.picture);

    let saved = bench.read(DISPLAY);
    bench.engine.run_again(first.clone());
    assert_eq!(bench.reloaded(), "picture");
    assert!(bench.film() == first_film && bench.engine.library().is_same(&first));
    assert_eq!(bench.read(DISPLAY), saved, "no file is written");

    // Another file is saved: all of the files run, the dark picture among it.
    bench.replace("shaders/lib/rng.wgsl", "fn ", "// A note.\nfn ");
    assert_eq!(bench.reloaded(), "picture");
    assert_eq!(bench.film().picture, dark.picture);
}

#[test]
fn what_is_wrong_with_the_files_is_told_while_other_shaders_run() {
    let mut bench = Bench::new();
    let first = kept(&bench);
    bench.replace(DISPLAY, "srgb8(linear)", "srgb8(linear * 0.5)");
    bench.reloaded();
    bench.replace(DISPLAY, "linear * 0.5", "linear * half");
    bench.failed();
    assert_eq!(bench.engine.problems().len(), 1);
    bench.engine.run_again(first);
    bench.reloaded();
    assert_eq!(bench.engine.problems().len(), 1, "the files are as wrong as before");
    bench.replace(DISPLAY, "linear * half", "linear");
    bench.reloaded();
    assert!(bench.engine.problems().is_empty());
}
