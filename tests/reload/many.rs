//! Reload after reload: none is lost, and memory stays what it is.

use lucerna::process::resident;

use super::Bench;

#[test]
fn a_series_of_reloads() {
    let count = if crate::support::stress() { 1000 } else { 40 };
    let mut bench = Bench::new();
    let display = "shaders/passes/display/display.wgsl";
    let (path, trace) = (bench.read(display), "shaders/lib/sampling.wgsl");
    let sampling = bench.read(trace);
    let mut after_warm_up = None;
    for n in 0..count {
        // Trace code is dear to compile, and one in ten does.
        if n % 10 == 0 {
            let text = sampling.replace("return Angle(sqrt(1.0 - u)", &format!("return Angle(0.{n}1 * sqrt(1.0 - u)"));
            assert_ne!(text, sampling);
            bench.write(trace, &text);
            assert_eq!(bench.reloaded(), "film", "reload {n}");
        } else {
            bench.write(display, &path.replace("srgb8(linear)", &format!("srgb8(linear * {n}.5)")));
            assert_eq!(bench.reloaded(), "picture", "reload {n}");
        }
        bench.finish();
        if n == count / 5 {
            after_warm_up = resident();
        }
    }
    assert_eq!(bench.count_for(std::time::Duration::from_millis(300)).0, 0, "no reload was told twice");
    if let (Some(before), Some(after)) = (after_warm_up, resident()) {
        // Other tests run in this process; a pipeline that was kept for each reload would show as gigabytes in a thousand.
        let grown = after.saturating_sub(before);
        assert!(grown < 400 << 20, "{} MiB more after {} reloads", grown >> 20, count - count / 5);
    }
    assert!(bench.film().pixels == bench.fresh_film().pixels);
}
