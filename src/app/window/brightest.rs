//! The paths that bring a pixel most: which they are, and their lines in the scene and over the picture. Pure, in f64.

use glam::{DVec2, DVec3, UVec2, Vec3};

use super::outline::segment;
use crate::components::Camera;
use crate::cpu::probe::colour;
use crate::cpu::turn::{RayKind, Turn};
use crate::engine::TracedPath;

/// Samples of a pixel that are traced again.
pub const SAMPLES: u32 = 64;

/// Paths that are kept of them.
pub const KEPT: usize = 8;

/// Pieces of a line that something hides or does not, each by its middle.
const PIECES: usize = 12;

/// Radiance below this part of the brightest path's has the colour of that.
const DIMMEST: f64 = 1e-2;

/// A path as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct BrightPath {
    pub sample: u32,
    /// What it brings, linear Rec.709.
    pub radiance: Vec3,
    /// Rays, those that bring nothing included.
    pub rays: usize,
    /// From the first surface on; none where all it brings is seen directly.
    pub pieces: Vec<Piece>,
}

/// A part of a ray, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    pub from: DVec3,
    pub to: DVec3,
    /// Of a ray to a light that was sampled, and not of the path's own.
    pub to_light: bool,
}

impl Piece {
    pub fn middle(&self) -> DVec3 {
        0.5 * (self.from + self.to)
    }

    /// Where it is on the film, pixels from its top left, as far as it is before the camera.
    pub fn on_film(&self, camera: &Camera, film: UVec2) -> Option<[DVec2; 2]> {
        // Much nearer than any piece is long: what is closer to the camera is cut off.
        let nearest = 1e-3 * self.from.distance(self.to).max(f64::MIN_POSITIVE);
        segment(camera, film, [self.from, self.to], nearest)
    }
}

/// Those that bring most, the brightest first; of equals the earlier sample. Rays that meet nothing are drawn so far.
pub fn brightest(paths: &[TracedPath], reach: f64) -> Vec<BrightPath> {
    let brings = |path: &&TracedPath| path.radiance.is_some_and(|radiance| radiance.max_element() > 0.0);
    let mut bright: Vec<BrightPath> = paths.iter().filter(brings).map(|path| drawn(path, reach)).collect();
    bright.sort_by(|a, b| size(b.radiance).total_cmp(&size(a.radiance)).then(a.sample.cmp(&b.sample)));
    bright.truncate(KEPT);
    bright
}

/// The colours of paths, by the logarithm of what they bring.
pub fn colours(paths: &[BrightPath]) -> Vec<[u8; 3]> {
    let most = paths.first().map_or(1.0, |path| size(path.radiance));
    // The darkest colours can't be told from a dark picture.
    let place = |path: &BrightPath| 1.0 - 0.75 * (size(path.radiance) / most).log(DIMMEST).clamp(0.0, 1.0);
    paths.iter().map(|path| colour(place(path))).collect()
}

/// Luminance.
fn size(radiance: Vec3) -> f64 {
    f64::from(radiance.dot(Vec3::new(0.2126, 0.7152, 0.0722)))
}

fn drawn(path: &TracedPath, reach: f64) -> BrightPath {
    let pieces = lines(path, reach).into_iter().flat_map(cut).collect();
    BrightPath { sample: path.sample, radiance: path.radiance.unwrap_or_default(), rays: path.turns.len(), pieces }
}

/// Whole rays behind the first surface, up to the last that brings anything; to lights only where the light is seen.
fn lines(path: &TracedPath, reach: f64) -> Vec<Piece> {
    let Some(last) = path.turns.iter().rposition(|turn| turn.added != DVec3::ZERO) else { return Vec::new() };
    let turns = &path.turns[..=last];
    let line = |turn: &Turn| {
        let from = path.origin + turn.origin;
        let to = from + turn.direction * turn.met.map_or(reach, |met| met.t);
        Piece { from, to, to_light: turn.kind == RayKind::Shadow }
    };
    // A light that is seen through panes has a ray a pane: those before the last add nothing, and belong to it.
    let leads_on = |at: usize| {
        let rest = turns[at..].iter().take_while(|turn| turn.kind == RayKind::Shadow);
        rest.last().is_some_and(|turn| turn.added != DVec3::ZERO)
    };
    let is_drawn = |(at, turn): &(usize, &Turn)| match turn.kind {
        RayKind::Segment => turn.bounce > 0,
        RayKind::Shadow => leads_on(*at),
    };
    turns.iter().enumerate().filter(is_drawn).map(|(_, turn)| line(turn)).collect()
}

fn cut(line: Piece) -> impl Iterator<Item = Piece> {
    let at = move |piece: usize| line.from.lerp(line.to, piece as f64 / PIECES as f64);
    (0..PIECES).map(move |piece| Piece { from: at(piece), to: at(piece + 1), ..line })
}
