//! Numbers in columns.

use crate::cpu::replay::Values;

/// Characters of a number.
pub const WIDTH: usize = 9;

/// A number in at most nine characters: six digits or so.
pub fn number(x: f64) -> String {
    let size = x.abs();
    match () {
        () if x.is_nan() => "NaN".to_owned(),
        () if x.is_infinite() => if x > 0.0 { "inf" } else { "-inf" }.to_owned(),
        () if size == 0.0 => "0".to_owned(),
        () if !(1e-3..1e6).contains(&size) => format!("{x:.2e}"),
        () => {
            let digits = 6 - (size.log10().floor() as i32).max(0);
            format!("{x:.*}", digits.max(0) as usize)
        }
    }
}

/// Some of them, in a column of three.
pub fn column(values: Option<&Values>) -> String {
    let numbers = values.map_or(&[][..], Values::numbers);
    let text: Vec<String> = numbers.iter().map(|x| format!("{:>WIDTH$}", number(*x))).collect();
    format!("{:<30}", text.join(" "))
}

/// A part of something, with one digit: as much as is known of an error.
pub fn part(x: f64) -> String {
    match () {
        () if x == 0.0 => "0".to_owned(),
        () if x.is_finite() => format!("{x:.0e}"),
        () if x.is_nan() => "NaN".to_owned(),
        () => "all".to_owned(),
    }
}
