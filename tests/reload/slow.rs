//! Code that the driver takes long to compile, or never ends to: told, given up for what is saved after it, and no hindrance to
//! the end. Drivers that draw on the processor take large arrays apart, so these tests are of those alone.

use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use lucerna::watch::ReloadEvent;

use super::Bench;
use crate::support;

const FILE: &str = "shaders/lib/bsdf/lambert.wgsl";
const FROM: &str = "    return INV_PI * cos_theta;\n";

/// An array of 128 KiB, which takes Mesa some 35 s of processor time: long enough for another file to be saved, read and taken up meanwhile,
/// however busy the machine is.
const LONG: u32 = 32_768;

/// A save that waited for that would take longer.
const SOONER: Duration = Duration::from_secs(20);

/// Code with an array of its own for each invocation, which is of no use to the picture. It is other code each time, or the driver's cache
/// would know it from an earlier run.
pub fn with_array(length: u32) -> String {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_nanos() % 1_000_000_007;
    format!(
        "    var a: array<f32, {length}>;\n    for (var i = 0u; i < 8u; i++) {{\n        \
         a[(u32(cos_theta * 1000.0) + i * 37u + {now}u) % {length}u] = cos_theta;\n    }}\n    \
         return INV_PI * cos_theta + 0.0 * a[u32(cos_theta * 500.0) % {length}u];\n"
    )
}

#[test]
fn a_compile_that_takes_long_is_told_and_a_later_save_wins() {
    if !support::gpu().is_software() {
        return;
    }
    let mut bench = Bench::new();
    let before = bench.film();
    let good = bench.replace(FILE, FROM, &with_array(LONG));
    let (files, since, warnings) = bench.wait("compile that takes long", |event| match event {
        ReloadEvent::Compiling { files, since, warnings, .. } => Some((files.len(), *since, warnings.clone())),
        _ => None,
    });
    assert!(files == 1 && since >= Duration::from_secs(2), "{since:?}");
    let line = good.lines().position(|line| format!("{line}\n") == FROM).unwrap() + 1;
    assert_eq!((warnings.len(), warnings[0].line), (1, line), "{warnings:?}");
    assert!(warnings[0].file.as_deref().is_some_and(|file| file.ends_with("lambert.wgsl")), "{warnings:?}");
    assert!(warnings[0].message.contains("bytes in each invocation"), "{warnings:?}");

    let begin = Instant::now();
    // No direction has a density: the light goes no further.
    bench.write(FILE, &good.replace(FROM, "    return 0.0 * cos_theta;\n"));
    assert_eq!(bench.reloaded(), "film");
    assert!(begin.elapsed() < SOONER, "{:?} after the save", begin.elapsed());
    assert!(bench.film().pixels != before.pixels);
    bench.write(FILE, &good);
    assert_eq!(bench.reloaded(), "film");
    assert!(bench.film().pixels == before.pixels);
    assert_eq!(bench.count_for(Duration::from_millis(300)), (0, 0));
}

#[test]
fn a_mistake_and_a_scene_are_told_while_older_code_is_compiled() {
    if !support::gpu().is_software() {
        return;
    }
    let mut bench = Bench::new();
    let good = bench.replace(FILE, FROM, &with_array(LONG));
    bench.wait("compile that takes long", |event| matches!(event, ReloadEvent::Compiling { .. }).then_some(()));
    let scene = bench.replace("scene.ron", "exposure: 0.0", "exposure: 1.0");
    assert_eq!(bench.reloaded(), "picture");
    bench.write(FILE, &good.replace(FROM, "    return wrong;\n"));
    let (file, line, ..) = bench.failed();
    assert_eq!((file.as_str(), line), (FILE, good.lines().position(|line| format!("{line}\n") == FROM).unwrap() + 1));
    bench.write("scene.ron", &scene);
    assert_eq!(bench.reloaded(), "picture");
}
