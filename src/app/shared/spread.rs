//! The one way to write a measured number: `1.31 ± 0.05`, both with as many places, or `(4.69 ± 0.04)e-6`.

/// A value and its spread, of which two digits are shown.
pub fn spread(value: f64, error: f64) -> String {
    let size = value.abs().max(error.abs());
    if !(error > 0.0 && size.is_finite()) {
        return short(value);
    }
    let exponent = match plain(size) {
        true => 0,
        false => size.log10().floor() as i32,
    };
    let scale = 10f64.powi(-exponent);
    let places = (1 - (error * scale).log10().floor() as i32).clamp(0, 12) as usize;
    let both = format!("{:.places$} ± {:.places$}", value * scale, error * scale);
    if exponent == 0 { both } else { format!("({both})e{exponent}") }
}

/// Three digits, with an exponent where there would be many zeros.
pub fn short(value: f64) -> String {
    let size = value.abs();
    match size {
        0.0 => "0".to_owned(),
        _ if !plain(size) => format!("{value:.2e}"),
        _ => {
            let digits = (2 - size.log10().floor() as i32).max(0) as usize;
            format!("{value:.digits$}")
        }
    }
}

/// Whether a number is written without an exponent.
fn plain(size: f64) -> bool {
    (1e-3..1e5).contains(&size)
}
