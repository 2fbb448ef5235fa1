//! The values of single statements.

use glam::{DVec3, Vec3};

use super::geometry::Counts;
use crate::scene::diagnostic::Diagnostic;
use crate::scene::lines::{Line, words};
use crate::scene::model::FARTHEST;
use crate::scene::text;

/// Corners that a face may have: clipping the ears of a face takes up to the square of its corners.
pub const MAX_CORNERS: usize = 1 << 14;

/// One corner of a face: position, texture coordinate and normal, from 0.
pub type Corner = (u32, Option<u32>, Option<u32>);

/// Statements that OBJ files have, for suggestions.
pub const KNOWN: &[&str] = &["v", "vt", "vn", "f", "o", "g", "s", "usemtl", "mtllib", "l", "p"];

/// Whether OBJ files have such a statement.
pub fn is_statement(key: &str) -> bool {
    KNOWN.contains(&key) || key == "fo" || is_beyond_us(key)
}

/// Whether a statement belongs to OBJ files, but to a part of them that makes no surface we render: free-form curves
/// and surfaces, and hints to old renderers.
pub fn is_beyond_us(key: &str) -> bool {
    const LIST: &[&str] = &[
        "vp",
        "cstype",
        "deg",
        "bmat",
        "step",
        "curv",
        "curv2",
        "surf",
        "parm",
        "trim",
        "hole",
        "scrv",
        "sp",
        "end",
        "con",
        "bevel",
        "c_interp",
        "d_interp",
        "lod",
        "shadow_obj",
        "trace_obj",
        "ctech",
        "stech",
        "mg",
        "maplib",
        "usemap",
        "call",
        "csh",
        "bsp",
        "bzp",
        "cdc",
        "cdp",
        "res",
    ];
    LIST.contains(&key)
}

/// The three coordinates of a `v`, and whether more follows (a weight or a colour).
pub fn position(line: &Line, key: &str, rest: &str) -> Result<([f64; 3], bool), Diagnostic> {
    let mut list = words(rest);
    let mut coordinates = [0.0; 3];
    for (found, coordinate) in coordinates.iter_mut().enumerate() {
        let Some(word) = list.next() else {
            return Err(line.error(key, format!("a vertex has three coordinates, this one has {found}")));
        };
        match text::number(word) {
            Some(value) if value.abs() <= FARTHEST => *coordinate = value,
            Some(value) if value.is_nan() => return Err(line.error(word, "a vertex can't be at NaN").help(REPAIR)),
            Some(value) if value.is_infinite() => {
                return Err(line.error(word, "a vertex can't be at infinity").help(REPAIR));
            }
            Some(_) => {
                let message = format!("this coordinate is beyond {FARTHEST:e}");
                return Err(line.error(word, message).help("scale the model down"));
            }
            None => return Err(no_number(line, word)),
        }
    }
    Ok((coordinates, list.next().is_some()))
}

fn no_number(line: &Line, word: &str) -> Diagnostic {
    let error = line.error(word, format!("`{word}` is not a number"));
    let with_point = word.replacen(',', ".", 1);
    match text::number(&with_point) {
        Some(_) if with_point != word => error.help(format!("decimals have a point: `{with_point}`")),
        _ => error.help(REPAIR),
    }
}

const REPAIR: &str = "repair the model, or export it again";

/// The first `N` numbers of a `vn` or `vt`; `None` in place of one that single precision can't hold.
pub fn numbers<const N: usize>(
    line: &Line,
    key: &str,
    rest: &str,
    least: usize,
) -> Result<[Option<f64>; N], Diagnostic> {
    let mut values = [Some(0.0); N];
    let mut found = 0;
    for (value, word) in values.iter_mut().zip(words(rest)) {
        let number = text::number(word).ok_or_else(|| no_number(line, word))?;
        *value = (number as f32).is_finite().then_some(number);
        found += 1;
    }
    if found < least {
        return Err(line.error(key, format!("`{key}` needs {least} numbers, this one has {found}")));
    }
    Ok(values)
}

/// Whether a normal has a direction.
pub fn usable(normal: DVec3) -> bool {
    let length = normal.to_array().iter().map(|value| value * value).sum::<f64>().sqrt();
    length > 1e-150 && length.is_finite()
}

/// A normal of unit length, or zero where it has no direction.
pub fn unit(normal: DVec3) -> Vec3 {
    normal.normalize_or_zero().as_vec3()
}

/// One corner of a face, `v`, `v/vt`, `v//vn` or `v/vt/vn`: indices from 0, negative ones resolved, all within their lists.
pub fn corner(line: &Line, word: &str, counts: Counts) -> Result<Corner, Diagnostic> {
    let mut slots = word.split('/');
    let position = slots.next().unwrap_or_default();
    let (uv, normal) = (slots.next().unwrap_or_default(), slots.next().unwrap_or_default());
    if slots.next().is_some() {
        return Err(line.error(word, format!("a corner is v/vt/vn, `{word}` has more parts")));
    }
    let optional = |text: &str, count, what| match text {
        "" => Ok(None),
        text => index(line, text, count, what).map(Some),
    };
    if position.is_empty() {
        return Err(line.error(word, format!("`{word}` has no vertex index: a corner is v/vt/vn")));
    }
    Ok((
        index(line, position, counts[0], "vertex (`v`)")?,
        optional(uv, counts[1], "texture coordinate (`vt`)")?,
        optional(normal, counts[2], "normal (`vn`)")?,
    ))
}

/// One index, from 1 or counted back from the end by negative numbers.
fn index(line: &Line, text: &str, count: u32, what: &str) -> Result<u32, Diagnostic> {
    let value: i64 = text.parse().map_err(|_| line.error(text, format!("`{text}` is not an index")))?;
    let resolved = if value < 0 { value.checked_add(i64::from(count)) } else { value.checked_sub(1) };
    match resolved {
        Some(at) if (0..i64::from(count)).contains(&at) => Ok(at as u32),
        _ if value == 0 => Err(line.error(text, "indices begin at 1, or at -1 from the end: 0 is none")),
        _ => {
            let message = format!("there is no {what} {text}: {count} come before this line");
            Err(line.error(text, message))
        }
    }
}
