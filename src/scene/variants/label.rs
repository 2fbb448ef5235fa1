//! Names of values, fit for parts of file names.

/// Letters of a label, as a part of a name.
const LONGEST: usize = 40;

/// Whole numbers below this one are written whole.
const WHOLE: f64 = 1e7;

/// A text as a part of a file's name on every system: of a path its last part, and `-` for what no name may have.
pub fn label_of(text: &str) -> String {
    let is_path = text.contains(['/', '\\']) && !text.contains(['(', '{', '[']);
    let last = match is_path {
        true => text.trim_end_matches(['/', '\\']).rsplit(['/', '\\']).next().unwrap_or(text),
        false => text,
    };
    let mut label = String::new();
    for c in last.trim().chars() {
        match c {
            c if c.is_alphanumeric() || "._+-".contains(c) => label.push(c),
            _ if label.is_empty() || label.ends_with('-') => {}
            _ => label.push('-'),
        }
    }
    let label = label.trim_matches(['-', '.']);
    // A sign is part of a number.
    match (label.is_empty(), last.trim().starts_with('-') && last.trim().parse::<f64>().is_ok()) {
        (true, _) => "empty".to_owned(),
        (false, true) => format!("-{label}"),
        (false, false) => label.to_owned(),
    }
}

/// A label that is not too long for a part of a name.
pub fn cut(label: String) -> String {
    if label.chars().count() <= LONGEST {
        return label;
    }
    let short: String = label.chars().take(LONGEST).collect();
    short.trim_end_matches(['-', '.']).to_owned()
}

/// Numbers in as few digits as keep them apart, three at least; whole numbers as they are.
pub fn labels_of(values: &[f64]) -> Vec<String> {
    if values.iter().all(|value| value.fract() == 0.0 && value.abs() < WHOLE) {
        return values.iter().map(f64::to_string).collect();
    }
    let texts = |digits: usize| -> Vec<String> { values.iter().map(|value| short(*value, digits)).collect() };
    let apart = |texts: &[String]| (1..texts.len()).all(|i| texts[i] != texts[i - 1]);
    (3..17).map(texts).find(|texts| apart(texts)).unwrap_or_else(|| texts(17))
}

/// A number of so many digits.
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

/// The same as a text, without zeros behind.
fn short(value: f64, digits: usize) -> String {
    let value = rounded(value, digits);
    let plain = format!("{value}");
    if plain.len() <= digits + 6 { plain } else { format!("{value:e}") }
}
