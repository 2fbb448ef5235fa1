//! Names of values, fit for parts of file names.

/// Letters of a label.
const LONGEST: usize = 40;

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
    let label: String = label.trim_matches(['-', '.']).chars().take(LONGEST).collect();
    // A sign is part of a number.
    match (label.is_empty(), last.trim().starts_with('-') && last.trim().parse::<f64>().is_ok()) {
        (true, _) => "empty".to_owned(),
        (false, true) => format!("-{label}"),
        (false, false) => label,
    }
}

/// Numbers in as few digits as keep them apart, three at least.
pub fn numbers(values: &[f64]) -> Vec<String> {
    let texts = |digits: usize| -> Vec<String> { values.iter().map(|value| rounded(*value, digits)).collect() };
    let apart = |texts: &[String]| (1..texts.len()).all(|i| texts[i] != texts[i - 1]);
    (3..17).map(texts).find(|texts| apart(texts)).unwrap_or_else(|| texts(17))
}

/// A number of so many digits, without zeros behind.
fn rounded(value: f64, digits: usize) -> String {
    let short: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    let plain = format!("{short}");
    if plain.len() <= digits + 6 { plain } else { format!("{short:e}") }
}
