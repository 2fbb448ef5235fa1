//! The picture of an environment, as light: what is no radiance is mended, and told at the line that names the picture.

use std::path::Path;

use glam::Vec3;
use miette::Diagnostic as _;

use super::diagnostic::{Diagnostic, Diagnostics, Severity};
use crate::components::EnvironmentMap;
use crate::image::{Fault, ReadError, Shown};

/// The brightest a channel may be, as for a constant environment.
const BRIGHTEST: f32 = 1e6;

/// What a picture of an environment is to be.
const KINDS: &str = "it is an EXR, HDR or PNG file by longitude and latitude";

/// Reads the picture of an environment; `place` is where the scene file names it.
pub fn read_sky(path: &Path, place: &Diagnostic, diagnostics: &mut Diagnostics) -> Option<EnvironmentMap> {
    let picture = match Shown::read(path) {
        Ok(picture) => picture,
        Err(error) => {
            diagnostics.push(refusal(&error, place));
            return None;
        }
    };
    let warning = |message: String| Diagnostic { message, severity: Severity::Warning, ..place.clone() };
    for text in &picture.warnings {
        diagnostics.push(warning(format!("`{}`: {text}", path.display())));
    }
    let (pixels, mended) = mend(picture.pixels);
    if mended > 0 {
        let noun = if mended == 1 { "pixel" } else { "pixels" };
        let path = path.display();
        diagnostics.push(warning(format!(
            "{mended} {noun} of `{path}` with a channel that is negative, no number or above 1e6: it is taken as 0, or as 1e6"
        )));
    }
    Some(EnvironmentMap { size: picture.size, pixels })
}

/// Why there is no environment, and what to do.
fn refusal(error: &ReadError, place: &Diagnostic) -> Diagnostic {
    let message = format!("can't use `{}` as an environment: {}", error.path.display(), error.fault);
    let help = match (&error.fault, error.help()) {
        (Fault::Open(_), _) | (_, None) => format!("{KINDS}; its path is relative to the folder of the scene file"),
        (_, Some(help)) => help.to_string(),
    };
    Diagnostic { message, ..place.clone() }.help(help)
}

/// Radiance, and how many pixels had a channel that was none: negative or no number, and is 0, or above 1e6, and is that.
fn mend(pixels: Vec<[f32; 3]>) -> (Vec<Vec3>, usize) {
    let mut mended = 0;
    let mend = |pixel: [f32; 3]| {
        let good = pixel.map(|channel| if channel.is_nan() { 0.0 } else { channel.clamp(0.0, BRIGHTEST) });
        mended += usize::from(good != pixel);
        Vec3::from(good)
    };
    let good = pixels.into_iter().map(mend).collect();
    (good, mended)
}
