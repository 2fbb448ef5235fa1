//! What values are between keys, against closed forms.

use lucerna::scene::generate::SplitMix;

use super::{numbers, written};

#[test]
fn lines_are_straight_and_ends_stay() {
    for (frame, value) in numbers(31, "{ 10: 1, 20: -4, 24: -4 }").into_iter().enumerate() {
        let expected = 1.0 - 5.0 * ((frame as f64 - 10.0) / 10.0).clamp(0.0, 1.0);
        assert!((value - expected).abs() < 1e-12, "{frame}: {value}, {expected}");
    }
}

/// Keys in any order, at the number of a frame or at seconds, and one where the next round begins.
#[test]
fn keys_are_at_frames_or_at_seconds() {
    let expected: Vec<f64> = (0..24).map(|frame| f64::from(frame) * 0.25).collect();
    for keys in ["{ 24: 6, 0: 0 }", r#"{ "1s": 6, 0: 0 }"#, r#"{ "0 s": 0, "0.5 s": 3, 24: 6 }"#] {
        assert_eq!(numbers(24, keys), expected, "{keys}");
    }
}

#[test]
fn each_number_of_a_value_goes_by_itself() {
    let tuple = written(5, "cameras.front.position", "{ 0: (0, 1, 5), 4: (4, 1, -3) }");
    assert_eq!(tuple, ["(0, 1, 5)", "(1, 1, 3)", "(2, 1, 1)", "(3, 1, -1)", "(4, 1, -3)"]);
    let light = written(3, "environment", "{ 0: Constant((0, 1,0)), 2: Constant((1,  0, 0.5)) }");
    assert_eq!(light, ["Constant((0, 1, 0))", "Constant((0.5, 0.5, 0.25))", "Constant((1, 0, 0.5))"]);
    let fields = r#"{ 0: (position: (0, 0, 3), look_at: (0, 0, 0)), 2: (position: (0, 0, 5), look_at: (0, 0, 0)) }"#;
    assert_eq!(written(2, "cameras.front", fields)[1], "(position: (0, 0, 4), look_at: (0, 0, 0))");
    assert_eq!(written(2, "models.0.transform", r#"{ 0: (scale: 1), 2: (scale: 2) }"#)[1], "(scale: 1.5)");
}

#[test]
fn steps_are_what_the_key_before_has() {
    let cameras = written(5, "camera", r#"Step({ 0: "front", 3: "near" })"#);
    assert_eq!(cameras, [r#""front""#, r#""front""#, r#""front""#, r#""near""#, r#""near""#]);
    assert_eq!(written(3, "render.roulette", "Step({ 1: true, 2: false })"), ["true", "true", "false"]);
    assert_eq!(written(3, "environment", "Step({ 0: Constant(1), 2: Sky(sun: (3, 4)) })")[1], "Constant(1)");
    // Nothing is a value too.
    assert_eq!(written(2, "film.crop", "Step({ 0: (0, 2, 0, 2), 1: None })"), ["(0, 2, 0, 2)", "None"]);
}

/// Up to a peak and down: with slopes of 0.1 at the ends and of 0 at the peak, the cubic is t + t^2 - t^3.
#[test]
fn a_smooth_curve_is_the_cubic_of_its_slopes() {
    for (frame, value) in numbers(21, "Smooth({ 0: 0, 10: 1, 20: 0 })").into_iter().enumerate() {
        let t = 1.0 - (frame as f64 - 10.0).abs() / 10.0;
        assert!((value - (t + t * t - t * t * t)).abs() < 1e-12, "{frame}: {value}");
    }
    // Slopes of 0 and 1: their mean is within what is monotone, and where one is flat there is none.
    for (frame, value) in numbers(31, "Smooth({ 0: 0, 10: 0, 20: 1, 30: 3 })").into_iter().enumerate() {
        let t = (frame as f64 - 10.0) / 10.0;
        let expected = match frame {
            0..=10 => 0.0,
            // Slopes of 0 and 1.5, in the width of the part.
            11..=20 => 3.0 * t * t - 2.0 * t * t * t + 1.5 * (t * t * t - t * t),
            // Of 1.5 and 2, from 1 to 3.
            _ => {
                let t = t - 1.0;
                let [from, to] = [(1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t), t * t * (3.0 - 2.0 * t)];
                from + 3.0 * to + 1.5 * t * (1.0 - t) * (1.0 - t) - 2.0 * t * t * (1.0 - t)
            }
        };
        assert!((value - expected).abs() < 1e-12, "{frame}: {value}, {expected}");
    }
    assert_eq!(numbers(5, "Smooth({ 0: 2, 4: 6 })"), [2.0, 3.0, 4.0, 5.0, 6.0], "two keys are a line");
    assert_eq!(numbers(3, "Smooth({ 1: 2 })"), [2.0; 3]);
}

/// Slopes of 0.1 and 10 have a mean that would overshoot: it is cut down so that both slopes of a part, in its own, are within a circle of 3.
#[test]
fn a_steep_part_does_not_make_its_neighbour_overshoot() {
    let values = numbers(21, "Smooth({ 0: 0, 10: 1, 20: 101 })");
    let (a, b) = (1.0, 50.5);
    let cut = 3.0 / f64::hypot(a, b);
    for (frame, value) in values[..10].iter().enumerate() {
        let t = frame as f64 / 10.0;
        let expected = t * t * (3.0 - 2.0 * t) + cut * (a * t * (1.0 - t) * (1.0 - t) - b * t * t * (1.0 - t));
        assert!((value - expected).abs() < 1e-12, "{frame}: {value}, {expected}");
    }
}

#[test]
fn a_smooth_curve_is_smooth_and_stays_between_its_keys() {
    const WIDTH: usize = 400;
    let mut random = SplitMix(7);
    for round in 0..20 {
        let values: Vec<f64> = (0..10).map(|_| (random.next_u64() % 9) as f64 / 2.0 - 2.0).collect();
        let keys: Vec<String> = values.iter().enumerate().map(|(k, value)| format!("{}: {value}", k * WIDTH)).collect();
        let found = numbers(4000, &format!("Smooth({{ {} }})", keys.join(", ")));
        for (k, pair) in values.windows(2).enumerate() {
            let within = &found[k * WIDTH..=(k + 1) * WIDTH];
            let (least, most) = (pair[0].min(pair[1]) - 1e-9, pair[0].max(pair[1]) + 1e-9);
            assert!(within.iter().all(|value| (least..=most).contains(value)), "{round}: {keys:?}");
            let turns = |two: &[f64]| (two[1] - two[0]) * (pair[1] - pair[0]).signum() < -1e-9;
            assert!(!within.windows(2).any(turns), "{round}: {keys:?}");
        }
        // Its second derivative is at most (6 x 4 + (4 + 2) x 3 x 4) / WIDTH^2, where a corner of lines is one of half / WIDTH or more.
        let slopes: Vec<f64> = found[..=9 * WIDTH].windows(2).map(|two| two[1] - two[0]).collect();
        let jump = slopes.windows(2).map(|two| (two[1] - two[0]).abs()).fold(0.0, f64::max);
        assert!(jump < 96.0 / (WIDTH * WIDTH) as f64, "{round}: {jump}");
    }
}
