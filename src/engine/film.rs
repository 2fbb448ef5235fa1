//! The film, read back.

use bevy_ecs::prelude::*;
use glam::UVec2;

use crate::components::Crop;
use crate::cpu::display;
use crate::cpu::film::{FilmSum, Joined, film_sum, half_mean, joined_film_mean, joined_mean};
use crate::cpu::film_error::{ErrorSums, FilmError, Place, error_sums, joined_film_error};
use crate::cpu::robust::{RobustFilm, robust_film};
use crate::layout::film::{FilmPixel, RobustPixel};
use crate::layout::trace::TraceParams;
use crate::layout::view::ViewMode;
use crate::parallel;
use crate::passes::lattice::Lattice;
use crate::passes::{Recording, film};
use crate::systems::EngineError;
use crate::systems::resources::{Device, Displayed, FilmProgress, Robust, Shot, Viewed};

/// The film, read back. Pixels go row by row from the top of the window.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmImage {
    /// The whole film, pixels.
    pub size: UVec2,
    /// The rendered part of it.
    pub window: Crop,
    /// Mean radiance, linear Rec.709.
    pub rgb: Vec<[f32; 3]>,
    /// The same from the even and from the odd samples alone: independent of each other.
    pub halves: [Vec<[f32; 3]>; 2],
    /// The sums themselves: two films are equal if these are.
    pub pixels: Vec<FilmPixel>,
    /// As shown: exposed, sRGB, opaque.
    pub picture: Vec<[u8; 4]>,
    /// Samples that every pixel has; of an adaptive film, on average.
    pub spp: u32,
    /// Mean over all pixels.
    pub mean: [f64; 3],
    /// Estimated relMSE of `rgb`; 0 where no pixel has two samples.
    pub error: FilmError,
}

/// What pictures and reports need of a film, read back: a quarter of what [`FilmImage`] takes. Those of the parts of a film come to that of
/// the whole.
#[derive(Clone, Debug)]
pub struct FilmPart {
    /// The whole film, pixels.
    pub size: UVec2,
    /// The rendered part of it.
    pub window: Crop,
    /// Mean radiance, linear Rec.709, row by row from the top of the window.
    pub rgb: Vec<[f32; 3]>,
    /// As shown: exposed, sRGB, opaque.
    pub picture: Vec<[u8; 4]>,
    /// Samples that every pixel has.
    pub spp: u32,
    /// What the mean over all pixels comes from.
    pub sum: FilmSum,
    /// What the estimated relMSE comes from.
    pub error: ErrorSums,
}

/// Reads back what is shown of the film's window, sRGB; none before anything is.
pub fn read_picture(world: &World) -> Result<Option<Vec<[u8; 4]>>, EngineError> {
    if progress(world).shown.is_none() {
        return Ok(None);
    }
    let shot = &world.resource::<Shot>().params;
    let count = (shot.window_width * shot.window_height) as usize;
    Ok(Some(world.resource::<Device>().0.read_some("picture", count)?))
}

/// Reads the film back; shows it first, if its picture is an older one or not what is viewed.
pub fn read_film(world: &mut World) -> Result<FilmImage, EngineError> {
    let (shown, picture) = show_film(world)?;
    let (exponent, joined) = (shown.exponent, shown.joined);
    let pixels: Vec<FilmPixel> = world.resource::<Device>().0.read_some("film", picture.len())?;
    let half = |h: usize| of_each(&pixels, |pixel| half_mean(&pixel.halves[h], exponent).0);
    Ok(FilmImage {
        size: shown.size,
        window: shown.window,
        rgb: of_each(&pixels, |pixel| joined_mean(pixel, exponent, joined).0),
        halves: [half(0), half(1)],
        spp: shown.spp,
        mean: joined_film_mean(&pixels, exponent, joined),
        error: joined_film_error(&pixels, shown.place, exponent, joined),
        picture,
        pixels,
    })
}

/// The same of what pictures need.
pub fn read_part(world: &mut World) -> Result<FilmPart, EngineError> {
    let (shown, picture) = show_film(world)?;
    let Shown { size, window, place, spp, exponent, joined } = shown;
    let sums = |film: &[FilmPixel]| {
        let rgb = of_each(film, |pixel| joined_mean(pixel, exponent, joined).0);
        (rgb, film_sum(film, exponent, joined), error_sums(film, place, exponent, joined))
    };
    let (rgb, sum, error) = world.resource::<Device>().0.look_at("film", picture.len(), sums)?;
    Ok(FilmPart { size, window, rgb, picture, spp, sum, error })
}

/// What is known of a film that was shown.
struct Shown {
    size: UVec2,
    window: Crop,
    place: Place,
    spp: u32,
    exponent: i32,
    joined: Joined,
}

/// Reads the film's picture back; makes it first, if there is none of the film as it is.
fn show_film(world: &mut World) -> Result<(Shown, Vec<[u8; 4]>), EngineError> {
    let before = progress(world);
    let (shot, look) = (world.resource::<Shot>(), world.resource::<Displayed>().0);
    let (whole, shot, exponent, joined) = (shot.clone(), shot.params, shot.exponent, shot.joined());
    let size = UVec2::new(shot.film_width, shot.film_height);
    let min = UVec2::new(shot.window_x, shot.window_y);
    let window = Crop { min, max: min + UVec2::new(shot.window_width, shot.window_height) };
    let count = shot.window_width * shot.window_height;
    if count == 0 {
        return Err(EngineError::EmptyFilm);
    }
    // A view that is on the screen stays there.
    let is_viewed = world.resource::<Viewed>().0 != ViewMode::Beauty;
    let held = if is_viewed { "film_picture" } else { "picture" };
    let device = &mut world.resource_mut::<Device>().0;
    device.reserve(held, u64::from(count) * 4)?;
    let mut recording = Recording::default();
    if !before.begun {
        film::record_reset(&mut recording, count);
    }
    if is_viewed || before.shown != Some(ViewMode::Beauty) || !before.begun {
        let params = whole.display_params(before.shows().unwrap_or_default(), look);
        film::record_display(&mut recording, &params).bind("picture", held);
    }
    device.play(&recording)?;
    let picture: Vec<[u8; 4]> = device.read_some(held, count as usize)?;
    if !is_viewed {
        let mut films = world.query::<&mut FilmProgress>();
        films.iter_mut(world).for_each(|mut progress| progress.shown = Some(ViewMode::Beauty));
    }
    Ok((Shown { size, window, place: place(&shot), spp: before.samples, exponent, joined }, picture))
}

/// Pixels that a thread takes at once.
const PIECE: usize = 1 << 14;

/// A colour of each pixel, rounded.
fn of_each(pixels: &[FilmPixel], colour: impl Fn(&FilmPixel) -> [f64; 3] + Sync) -> Vec<[f32; 3]> {
    let mut colours = vec![[0.0; 3]; pixels.len()];
    parallel::fill(&mut colours, PIECE, |first, piece| {
        let from = &pixels[first..];
        piece.iter_mut().zip(from).for_each(|(to, pixel)| *to = colour(pixel).map(|channel| channel as f32));
    });
    colours
}

/// The film's estimated relMSE; 0 where no pixel has two samples. Sooner known than the whole film is read.
pub fn read_error(world: &World) -> Result<FilmError, EngineError> {
    let shot = world.resource::<Shot>();
    let (size, exponent, joined) = (shot.size(), shot.exponent, shot.joined());
    match (size.min_element(), progress(world).begun) {
        (0, _) => Err(EngineError::EmptyFilm),
        (_, false) => Ok(FilmError::default()),
        (_, true) => {
            let error = |film: &[FilmPixel]| joined_film_error(film, place(&shot.params), exponent, joined);
            Ok(world.resource::<Device>().0.look_at("film", (size.x * size.y) as usize, error)?)
        }
    }
}

/// The film's robust means; none unless its samples are summed in blocks, which those of adaptive films are not, or before there are any.
pub fn read_robust(world: &World) -> Result<Option<RobustFilm>, EngineError> {
    let shot = world.resource::<Shot>();
    if !world.resource::<Robust>().0 || shot.is_adaptive() || progress(world).is_empty() {
        return Ok(None);
    }
    let count = (shot.size().x * shot.size().y) as usize;
    let means = |blocks: &[RobustPixel]| robust_film(blocks, shot.exponent);
    Ok(Some(world.resource::<Device>().0.look_at("blocks", count, means)?))
}

/// Where the window's pixels are.
fn place(params: &TraceParams) -> Place {
    Place { min: UVec2::new(params.window_x, params.window_y), width: params.window_width as usize }
}

/// How far the picture's codes are from those of the true film, by the film's own two halves.
pub fn picture_error(world: &World) -> Result<f64, EngineError> {
    let (shot, look) = (world.resource::<Shot>(), world.resource::<Displayed>().0);
    let size = shot.size();
    if size.min_element() == 0 || !progress(world).begun {
        return Err(EngineError::EmptyFilm);
    }
    let params = shot.display_params(Lattice::default(), look);
    let error = |film: &[FilmPixel]| display::error(film, &params);
    Ok(world.resource::<Device>().0.look_at("film", (size.x * size.y) as usize, error)?)
}

/// Reads the film's mean radiance alone; black where nothing was traced.
pub fn read_radiance(world: &World) -> Result<Vec<[f32; 3]>, EngineError> {
    let shot = world.resource::<Shot>();
    let (count, exponent, joined) = ((shot.size().x * shot.size().y) as usize, shot.exponent, shot.joined());
    match (count, progress(world).begun) {
        (0, _) => Err(EngineError::EmptyFilm),
        (_, false) => Ok(vec![[0.0; 3]; count]),
        (_, true) => {
            let means = |film: &[FilmPixel]| of_each(film, |pixel| joined_mean(pixel, exponent, joined).0);
            Ok(world.resource::<Device>().0.look_at("film", count, means)?)
        }
    }
}

/// How far the film has come; as one that has not begun, where there is none.
pub fn progress(world: &World) -> FilmProgress {
    let found = world.try_query::<&FilmProgress>().and_then(|mut films| films.iter(world).next().copied());
    found.unwrap_or_default()
}
