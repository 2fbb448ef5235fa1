//! What values of several commands' flags may be. Whatever is out of range is refused here, with exit code 2.

use glam::UVec2;

use crate::components::{Crop, Film};
use crate::image::Output;
use crate::scene::Define;
use crate::scene::settings::MOST_STOPS;

/// What ends every help text.
pub const MORE: &str = "More: `lucerna help COMMAND` says what values mean; `lucerna help exit-codes`, `help paths` (of -D), `help keys` (of the window)";

/// What the process ends with.
pub const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    wrong input, an error on the way, a file that could not be written, (`bench --against`) less efficiency, or (`bench peers`) no verdict
  2    the command line means nothing
  3    no graphics adapter that can be used: see `lucerna doctor`
  4    compared pictures differ by more than a --max flag allows
  5    judged shaders have another mean
  6    whether they have can't be told yet, or (`stress`) a row proves nothing here
  7    `stress`: a row does not hold, or no row sees a planted mistake
  125  `judge --bisect`: this commit can't be told, and is skipped (1 is one whose means differ)
  128  `judge --bisect`: no commit can be judged, and the search ends
  130  interrupted; what there was, if anything, has been written";

/// A length of time, seconds.
pub fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds <= 1e7 => Ok(seconds),
        _ => Err("expected seconds above 0, at most 1e7".into()),
    }
}

/// A relMSE.
pub fn error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if (1e-9..=1e3).contains(&error) => Ok(error),
        _ => Err("expected a relMSE from 1e-9 to 1e3".into()),
    }
}

/// An exposure.
pub fn stops(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(stops) if stops.abs() <= MOST_STOPS => Ok(stops),
        _ => Err(format!("expected a number from -{MOST_STOPS} to {MOST_STOPS}")),
    }
}

/// A size in pixels, `WIDTHxHEIGHT`.
pub fn size(text: &str) -> Result<UVec2, String> {
    let sides = text.split_once(['x', 'X']).and_then(|(w, h)| Some(UVec2::new(w.parse().ok()?, h.parse().ok()?)));
    match sides {
        Some(size) if size.min_element() >= 1 && size.max_element() <= Film::MAX_SIDE => Ok(size),
        _ => Err(format!("expected WIDTHxHEIGHT, each from 1 to {}", Film::MAX_SIDE)),
    }
}

/// A rectangle of pixels.
pub fn crop(text: &str) -> Result<Crop, String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x0, x1, y0, y1]) if x0 < x1 && y0 < y1 => Ok(Crop { min: UVec2::new(x0, y0), max: UVec2::new(x1, y1) }),
        _ => Err("expected X0,X1,Y0,Y1 in pixels, with X0 < X1 and Y0 < Y1".into()),
    }
}

/// A pixel, `X,Y`.
pub fn pixel(text: &str) -> Result<UVec2, String> {
    let numbers =
        text.split_once(',').and_then(|(x, y)| Some(UVec2::new(x.trim().parse().ok()?, y.trim().parse().ok()?)));
    numbers.ok_or_else(|| "expected X,Y in whole pixels, counted from 0".into())
}

/// `KEY=VALUE`.
pub fn define(text: &str) -> Result<Define, String> {
    match text.split_once('=') {
        Some((key, value)) if !key.is_empty() => Ok(Define::given(key, value)),
        _ => Err("expected KEY=VALUE, such as materials.ball.ns=64".into()),
    }
}

/// A file to be written.
pub fn output(text: &str) -> Result<Output, String> {
    use miette::Diagnostic;
    Output::new(text).map_err(|error| match error.help() {
        Some(help) => format!("{error}; {help}"),
        None => error.to_string(),
    })
}
