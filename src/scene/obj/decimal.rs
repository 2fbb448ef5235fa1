//! Decimal numbers, as most files have them, read from bytes.

/// Powers of ten that f64 holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// The number that a text of words begins with, and the bytes of its word: what `str::parse` gives, to the bit. None where the word is no
/// number or no plain text.
pub fn decimal(text: &[u8]) -> Option<(f64, usize)> {
    quick(text).or_else(|| {
        let length = text.iter().position(|byte| matches!(byte, b' ' | b'\t' | b'\n' | b'\r')).unwrap_or(text.len());
        let value = std::str::from_utf8(&text[..length]).ok()?.parse().ok()?;
        Some((value, length))
    })
}

/// The same, where digits and power of ten are both exact in f64: then one multiplication or division rounds as it should (Clinger: How
/// to read floating point numbers accurately, 1990).
fn quick(text: &[u8]) -> Option<(f64, usize)> {
    let digit = |at: usize| text.get(at).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit < 10);
    let negative = text.first() == Some(&b'-');
    let mut at = usize::from(negative);
    let start = at;
    let mut digits = 0u64;
    while let Some(digit) = digit(at) {
        digits = digits.wrapping_mul(10).wrapping_add(digit.into());
        at += 1;
    }
    let mut count = at - start;
    let mut places = 0;
    if text.get(at) == Some(&b'.') {
        at += 1;
        let point = at;
        while let Some(digit) = digit(at) {
            digits = digits.wrapping_mul(10).wrapping_add(digit.into());
            at += 1;
        }
        places = at - point;
        count += places;
    }
    let ended = matches!(text.get(at), None | Some(b' ' | b'\t' | b'\n' | b'\r'));
    // 19 digits are within 64 bits.
    if !ended || count == 0 || count > 19 || digits > 1 << 53 || places >= POWERS.len() {
        return None;
    }
    let value = digits as f64 / POWERS[places];
    Some((if negative { -value } else { value }, at))
}
