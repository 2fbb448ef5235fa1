//! The statistics by which estimators are held equal, and distributions held to their pdf.

use lucerna::stats::agreement::{Agreement, greatest};
pub use lucerna::stats::agreement::{BATCHES, Pairs, agree};
pub use lucerna::stats::chi_square::{CHI_SQUARE_LIMIT, chi_square_z};

#[test]
fn planted_differences_are_seen() {
    let noise = |i: usize| ((i * 7919 % 31) as f64 / 15.0 - 1.0) * 1e-3;
    let shifted = |by: f64| Pairs { differences: std::array::from_fn(|i| noise(i) + by), mean: 1.0 };
    agree(&shifted(0.0)).unwrap();
    assert!(agree(&shifted(0.01)).is_err());
    assert!(agree(&Pairs { differences: shifted(0.0).differences, mean: 0.01 }).is_err());
}

#[test]
fn what_is_no_number_agrees_with_nothing() {
    let of = |value: f64| Pairs { differences: [value; BATCHES], mean: 1.0 }.agreement();
    assert_eq!(of(0.0), Agreement { mean: 1.0, ..Agreement::PERFECT });
    assert!(of(f64::NAN).check().is_err() && of(0.01).check().is_err());
    assert!(of(0.0).worst(of(f64::NAN)).errors.is_nan() && of(f64::NAN).worst(of(0.0)).errors.is_nan());
    // That of 0 / 0 has a sign of its own.
    assert!(of(0.01).worst(of(-f64::NAN)).errors.is_nan() && of(-f64::NAN).worst(of(0.01)).errors.is_nan());
    assert!(Agreement::PERFECT.worst(of(0.01)).errors > 1e6);
    assert!(greatest([1.0, -f64::NAN, 2.0]).is_nan() && greatest([1.0, 3.0, 2.0]) == 3.0);
}
