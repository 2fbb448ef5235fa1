//! Numbers as a scene file has them: the fewest digits that are read back as the same number.

/// A number of double precision.
pub fn double(value: f64) -> String {
    // A zero of either sign is one number.
    let value = value + 0.0;
    if is_plain(value) { value.to_string() } else { format!("{value:e}") }
}

/// A number of single precision, which is read as a double and then rounded.
pub fn single(value: f32) -> String {
    let value = value + 0.0;
    let text = if is_plain(value.into()) { value.to_string() } else { format!("{value:e}") };
    let is_read_back = text.parse::<f64>().is_ok_and(|read| read as f32 == value);
    // Twice rounded, a number may come to lie beside itself.
    if is_read_back { text } else { double(value.into()) }
}

/// Whether a number is written without a power of ten.
fn is_plain(value: f64) -> bool {
    value == 0.0 || (1e-5..1e16).contains(&value.abs())
}
