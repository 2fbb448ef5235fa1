//! The brightest paths of a pixel, as a session keeps them and as they lie over the picture. Knows no session.

use egui::{Color32, Context, Pos2, Rect, Stroke};
use glam::UVec2;

use super::brightest::BrightPath;
use super::legend::Legend;
use super::legend::short;
use crate::components::Camera;
use crate::scene::SceneDescription;

/// Paths that are shown, or are to be.
#[derive(Default)]
pub struct Paths {
    /// The pixel of the whole film whose paths are to be traced again once that is said.
    pub asked: Option<Asked>,
    pub shown: Option<ShownPaths>,
}

/// A pixel of the whole film, and whether a frame has said that it is looked at.
pub struct Asked {
    pub pixel: UVec2,
    pub told: bool,
}

/// The brightest paths of a pixel.
pub struct ShownPaths {
    /// Of the whole film.
    pub pixel: UVec2,
    pub paths: Vec<BrightPath>,
    pub colours: Vec<[u8; 3]>,
    /// Samples that are no radiance, and are not among them.
    pub bad: usize,
    /// The command that replays each; none of a member of a family.
    pub commands: Vec<Option<String>>,
    /// The scene that they are of, and how often its film had started anew when that was last looked at.
    pub scene: SceneDescription,
    pub restarts: u64,
    /// Of each piece of all paths whether it is hidden, from a view.
    pub hidden: Vec<bool>,
    pub seen_from: Option<Camera>,
}

/// Lines over the picture, in points of the window.
#[derive(Clone, Debug, Default)]
pub struct PathLines {
    pub lines: Vec<PathLine>,
}

/// A piece of a path.
#[derive(Clone, Copy, Debug)]
pub struct PathLine {
    pub ends: [Pos2; 2],
    pub colour: [u8; 3],
    /// To a light that was sampled.
    pub to_light: bool,
    /// Something is before it.
    pub hidden: bool,
}

impl Paths {
    /// Whether there is anything to take away.
    pub fn is_shown(&self) -> bool {
        self.shown.is_some() || self.asked.is_some()
    }
}

impl ShownPaths {
    /// What the colours mean: a line a path.
    pub fn legend(&self) -> Legend {
        let name = |path: &BrightPath| {
            let [r, g, b] = path.radiance.to_array().map(|channel| short(channel.into()));
            format!("sample {}: {r} {g} {b}", path.sample)
        };
        let swatches = self.colours.iter().copied().zip(self.paths.iter().map(name)).collect();
        Legend { title: "the brightest paths of the pixel", bar: None, swatches }
    }
}

/// Draws lines over the picture: those to lights thinner, what is hidden faint.
pub fn draw(context: &Context, picture: Rect, drawn: &PathLines) {
    let painter = context.layer_painter(egui::LayerId::background()).with_clip_rect(picture);
    for PathLine { ends, colour: [r, g, b], to_light, hidden } in &drawn.lines {
        let width = if *to_light { 1.0 } else { 1.75 };
        if *hidden {
            let faint = Color32::from_rgba_unmultiplied(*r, *g, *b, 70);
            painter.line_segment(*ends, Stroke::new(width, faint));
        } else {
            painter.line_segment(*ends, Stroke::new(width + 1.5, Color32::from_black_alpha(130)));
            painter.line_segment(*ends, Stroke::new(width, Color32::from_rgb(*r, *g, *b)));
        }
    }
}
