//! Where the film's error comes from, as it is found out and shown in a window: in words in the panel, and as colours over the picture.

use std::time::Instant;

use egui::{Color32, Context, Rect, TextureHandle};
use glam::UVec2;

use super::beside::{WHOLE, placed, texture};
use super::panel::errors::{ErrorsShown, Over};
use crate::app::shared::sources::word;
use crate::cpu::sources::{PixelShare, Way};
use crate::cpu::view::material_colour;
use crate::engine::{SourceMap, Survey};
use crate::gpu::Fit;

/// Bounces that have a colour of their own in the legend.
const NAMED_BOUNCES: u32 = 6;

/// All of it that a session keeps.
#[derive(Default)]
pub struct Errors {
    /// Under way.
    pub(super) survey: Option<Survey>,
    /// When the film began that this is of.
    pub(super) began: Option<Instant>,
    /// What was found, in words.
    pub(super) lines: Vec<String>,
    pub(super) map: Option<SourceMap>,
    /// What is to lie over the picture.
    pub(super) over: Over,
    /// Samples of the film whose robust means are shown.
    pub(super) robust_of: u32,
    pub(super) robust: Option<(UVec2, Vec<[u8; 4]>)>,
    pub(super) drawn: Option<TextureHandle>,
}

impl Errors {
    /// For the panel.
    pub fn shown(&self) -> ErrorsShown<'_> {
        ErrorsShown {
            done: self.survey.as_ref().map(Survey::done),
            lines: &self.lines,
            over: self.over,
            legend: legend(self.over),
        }
    }

    /// The film is another one: nothing is known of it.
    pub(super) fn forget(&mut self) {
        *self = Self { over: self.over, ..Self::default() };
    }

    fn picture(&self) -> Option<(UVec2, Vec<[u8; 4]>)> {
        match self.over {
            Over::Nothing => None,
            Over::Robust => self.robust.clone(),
            over => self.map.as_ref().map(|map| (map.size, coloured(map, over))),
        }
    }

    /// Draws what is chosen over the film, as that lies on an area of the window.
    pub fn draw(&mut self, context: &Context, area: Rect, fit: Fit) {
        if self.drawn.is_none() {
            let Some((size, pixels)) = self.picture() else { return };
            self.drawn = Some(texture(context, "errors", size, &pixels));
        }
        let Some(drawn) = &self.drawn else { return };
        let size = UVec2::from_array(drawn.size().map(|side| side as u32));
        let painter = context.layer_painter(egui::LayerId::background()).with_clip_rect(area);
        painter.image(drawn.id(), placed(context, fit, size, area), WHOLE, Color32::WHITE);
    }
}

/// What the colours over the picture mean.
fn legend(over: Over) -> Vec<([u8; 3], String)> {
    match over {
        Over::Bounce => {
            (0..NAMED_BOUNCES).map(|bounce| (material_colour(bounce), format!("bounce {bounce}"))).collect()
        }
        Over::Way => {
            let ways = [Way::Seen, Way::Sampled, Way::Found, Way::Reused];
            ways.map(|way| (way_colour(way), word(way).to_owned())).into()
        }
        Over::Nothing | Over::Robust => Vec::new(),
    }
}

fn way_colour(way: Way) -> [u8; 3] {
    match way {
        Way::Seen => [90, 200, 90],
        Way::Sampled => [80, 140, 255],
        Way::Found => [255, 120, 60],
        Way::Reused => [200, 110, 230],
    }
}

/// A colour for what has most of each pixel's error, as bright as its part of that is great; black where there is no error.
fn coloured(map: &SourceMap, over: Over) -> Vec<[u8; 4]> {
    let colour = |pixel: &PixelShare| {
        let (colour, share) = match (over, pixel.way) {
            (Over::Way, Some(way)) => (way_colour(way), pixel.way_share),
            (Over::Bounce, Some(_)) => (material_colour(pixel.bounce), pixel.bounce_share),
            _ => ([0; 3], 0.0),
        };
        let [r, g, b] = colour.map(|channel| (f64::from(channel) * share).round() as u8);
        [r, g, b, 255]
    };
    map.pixels.iter().map(colour).collect()
}
