//! `lucerna compare`: a picture against a reference.

mod arguments;
mod comparison;
mod heat;
mod report;

use glam::{IVec2, UVec2};

pub use arguments::CompareArguments;
use arguments::Heat;
use comparison::{Comparison, HAS_FLIP, LEAST_SIDE, Side};

use crate::app::shared::output::{self, Unplaced};
use crate::app::{Exit, Failure};
use crate::components::Crop;
use crate::image::srgb::srgb_byte;
use crate::image::{PictureFile, Pixel};
use crate::stats::blocks::{Blocks, Grid};
use crate::stats::metrics::{Census, Difference, comparable, peak_signal_to_noise};

/// Blocks along the longer side, by default.
const BLOCKS: u32 = 16;

/// Pictures that are not to be compared with each other.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
enum CompareError {
    #[error("the pictures differ in size: {a_name} is {}, {b_name} is {}", by(*a), by(*b))]
    #[diagnostic(help("compare pictures of one size, or a part that both have with --crop"))]
    Sizes { a_name: String, a: UVec2, b_name: String, b: UVec2 },
    #[error("the pictures show different parts: {a_name} begins at {}, {b_name} at {}", at(*a), at(*b))]
    #[diagnostic(help("compare a part that both have with --crop"))]
    Places { a_name: String, a: IVec2, b_name: String, b: IVec2 },
    #[error("--crop reaches beyond {name}, which has {} pixels from {}", by(*size), at(*place))]
    #[diagnostic(help("choose a part that both pictures have"))]
    Crop { name: String, size: UVec2, place: IVec2 },
    #[error("no pixel is a finite number of at least 0 in both {a} and {b}")]
    #[diagnostic(help("look at them one by one: one of them holds no picture"))]
    Nothing { a: String, b: String },
}

/// Reads, compares and reports.
pub fn run(arguments: &CompareArguments) -> Result<Exit, Failure> {
    let heat = heat(arguments)?;
    let (a, b) = (PictureFile::open(&arguments.a)?, PictureFile::open(&arguments.b)?);
    let (windows, origin) = windows(&a, &b, arguments.crop).map_err(Failure::of)?;
    let read = [arguments.a.clone(), arguments.b.clone()];
    let prepared = arguments.output.as_ref().map(|output| output.prepare(&read)).transpose();
    let sides = [side(&a, windows[0])?, side(&b, windows[1])?];
    let exposure = exposure(arguments, [&a, &b]);
    let comparison = compare(sides, windows[0].size(), origin, (arguments.block, exposure)).map_err(Failure::of)?;
    // What is known of the pictures is told whatever becomes of the heat map.
    let heat_map = prepared.and_then(|_| {
        let wanted = arguments.output.as_ref().zip(heat);
        wanted.map(|(output, heat)| heat::write(&comparison, heat, output)).transpose()
    });
    let exceeded = report::exceeded(&comparison, arguments);
    match arguments.json {
        true => output::print(&format!("{}\n", report::json(&comparison, arguments, &exceeded)))?,
        false => output::print(&report::text(&comparison))?,
    }
    exceeded.iter().for_each(|line| output::note(line));
    heat_map.map_err(Unplaced::by(output::FILE_FLAG)).map_err(Failure::of)?;
    Ok(if exceeded.is_empty() { Exit::Done } else { Exit::Differs })
}

/// What the heat map is to show, if there is to be one; refuses FLIP where it is not built in.
fn heat(arguments: &CompareArguments) -> Result<Option<Heat>, Failure> {
    let chosen = arguments.heat.unwrap_or(if HAS_FLIP { Heat::Flip } else { Heat::Relative });
    let wanted = arguments.output.is_some().then_some(chosen);
    if !HAS_FLIP && (wanted == Some(Heat::Flip) || arguments.max_flip.is_some()) {
        let help = "build it without --no-default-features, with a C++ compiler";
        return Err(Failure::usage("this lucerna was built without FLIP", help));
    }
    Ok(wanted)
}

/// The window of each file, and where both begin.
fn windows(a: &PictureFile, b: &PictureFile, crop: Option<Crop>) -> Result<([Crop; 2], IVec2), CompareError> {
    let (a_name, b_name) = (a.path.display().to_string(), b.path.display().to_string());
    // If one of them doesn't say where it belongs, both are taken to begin at the same place.
    let places = a.place.zip(b.place).map_or([IVec2::ZERO; 2], |(a, b)| [a, b]);
    if let Some(crop) = crop {
        let within = |source: &PictureFile, place: IVec2| {
            let corner = |c: UVec2| (c.as_i64vec2() - place.as_i64vec2()).try_into().ok();
            let window = corner(crop.min).zip(corner(crop.max)).map(|(min, max)| Crop { min, max });
            let name = source.path.display().to_string();
            let fits = |window: &Crop| window.max.cmple(source.size).all();
            window.filter(fits).ok_or(CompareError::Crop { name, size: source.size, place })
        };
        return Ok(([within(a, places[0])?, within(b, places[1])?], crop.min.as_ivec2()));
    }
    if a.size != b.size {
        return Err(CompareError::Sizes { a_name, a: a.size, b_name, b: b.size });
    }
    if places[0] != places[1] {
        return Err(CompareError::Places { a_name, a: places[0], b_name, b: places[1] });
    }
    Ok(([Crop { min: UVec2::ZERO, max: a.size }; 2], places[0]))
}

/// The exposure that both are shown at: what the command line says, else what the files do.
fn exposure(arguments: &CompareArguments, [a, b]: [&PictureFile; 2]) -> f32 {
    let given = arguments.exposure.or(b.exposure()).or(a.exposure()).unwrap_or(0.0);
    if arguments.exposure.is_none()
        && let (Some(of_a), Some(of_b)) = (a.exposure(), b.exposure())
        && of_a != of_b
    {
        let (a, b) = (a.path.display(), b.path.display());
        output::note(&format!("{a} was rendered at exposure {of_a}, {b} at {of_b}: both are shown at {of_b}"));
    }
    given
}

fn side(source: &PictureFile, window: Crop) -> Result<Side, Failure> {
    let pixels = source.read(window)?;
    let name = source.path.display().to_string();
    for note in source.notes.iter().chain(&source.warnings) {
        output::note(&format!("{name}: {note}"));
    }
    Ok(Side { name, census: Census::of(&pixels), pixels })
}

fn compare(
    [a, b]: [Side; 2],
    size: UVec2,
    origin: IVec2,
    (block, exposure): (Option<u32>, f32),
) -> Result<Comparison, CompareError> {
    let difference = Difference::of(&a.pixels, &b.pixels);
    let Some(difference) = difference else { return Err(CompareError::Nothing { a: a.name, b: b.name }) };
    let side = block.unwrap_or_else(|| size.max_element().div_ceil(BLOCKS).max(LEAST_SIDE));
    let blocks = Blocks::of(&a.pixels, &b.pixels, Grid::new(size, side));
    let scale = f64::from(exposure).exp2();
    let shown = [shown(&a.pixels, &b.pixels, scale), shown(&b.pixels, &a.pixels, scale)];
    let psnr = peak_signal_to_noise(&shown[0], &shown[1], difference.pixels);
    #[cfg(feature = "flip")]
    let flip = crate::app::shared::flip::flip(&shown[0], &shown[1], size);
    #[cfg(not(feature = "flip"))]
    let flip = Vec::new();
    Ok(Comparison { size, origin, a, b, difference, blocks, exposure, psnr, flip })
}

/// A picture as it would be displayed; black where either is bad, so that both are equal there.
fn shown(picture: &[Pixel], other: &[Pixel], scale: f64) -> Vec<[u8; 3]> {
    let byte = |channel: f32| srgb_byte(f64::from(channel) * scale);
    let pixel = |(own, other): (&Pixel, &Pixel)| if comparable(*own, *other) { own.map(byte) } else { [0; 3] };
    picture.iter().zip(other).map(pixel).collect()
}

fn by(size: UVec2) -> String {
    format!("{}x{}", size.x, size.y)
}

fn at(place: IVec2) -> String {
    format!("{},{}", place.x, place.y)
}
