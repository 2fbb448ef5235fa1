//! The picture of an environment, as light: what is no radiance is mended, and told at the line that names the picture.

use std::path::Path;
use std::sync::Arc;

use glam::Vec3;
use miette::Diagnostic as _;

use super::diagnostic::{Diagnostic, Severity};
use crate::components::EnvironmentMap;
use crate::image::{Fault, ReadError, Shown};

/// The brightest a channel may be, as for a constant environment.
const BRIGHTEST: f32 = 1e6;

/// What a picture of an environment is to be.
const KINDS: &str = "it is an EXR, HDR or PNG file by longitude and latitude";

/// What came of a picture of an environment.
pub struct Sky {
    /// None where it can't be used; a message says why.
    pub image: Option<Arc<EnvironmentMap>>,
    /// Severity, message and help.
    told: Vec<(Severity, String, Option<String>)>,
}

impl Sky {
    /// What there is to say of it, at the place where a scene file names it.
    pub fn messages(&self, place: &Diagnostic) -> impl Iterator<Item = Diagnostic> {
        self.told.iter().map(|(severity, message, help)| Diagnostic {
            severity: *severity,
            message: message.clone(),
            help: help.clone(),
            ..place.clone()
        })
    }
}

/// Reads the picture of an environment.
pub fn read_sky(path: &Path) -> Sky {
    let picture = match Shown::read(path) {
        Ok(picture) => picture,
        Err(error) => return Sky { image: None, told: vec![refusal(&error)] },
    };
    let warning = |message: String| (Severity::Warning, message, None);
    let mut told: Vec<_> =
        picture.warnings.iter().map(|text| warning(format!("`{}`: {text}", path.display()))).collect();
    let (pixels, mended) = mend(picture.pixels);
    if mended > 0 {
        let noun = if mended == 1 { "pixel" } else { "pixels" };
        let path = path.display();
        told.push(warning(format!(
            "{mended} {noun} of `{path}` with a channel that is negative, no number or above 1e6: it is taken as 0, or as 1e6"
        )));
    }
    Sky { image: Some(Arc::new(EnvironmentMap { size: picture.size, pixels })), told }
}

/// Why there is no environment, and what to do.
fn refusal(error: &ReadError) -> (Severity, String, Option<String>) {
    let message = format!("can't use `{}` as an environment: {}", error.path.display(), error.fault);
    let help = match (&error.fault, error.help()) {
        (Fault::Open(_), _) | (_, None) => {
            format!("{KINDS}; its path is relative to the folder of the file that names it")
        }
        (_, Some(help)) => help.to_string(),
    };
    (Severity::Error, message, Some(help))
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
