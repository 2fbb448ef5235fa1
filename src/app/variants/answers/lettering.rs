//! Letters on a canvas, by the fonts of the window's user interface, drawn by the processor.

use std::sync::Arc;

use egui::epaint::text::{FontDefinitions, Fonts, LayoutJob, TextOptions};
use egui::{Color32, FontFamily, FontId, Galley};
use glam::{IVec2, UVec2};

use super::canvas::Canvas;

/// Fonts, and the letters of them that were used.
pub struct Lettering {
    fonts: Fonts,
}

/// A text whose letters have their places.
#[derive(Clone)]
pub struct Text {
    galley: Arc<Galley>,
}

impl Text {
    /// Pixels that it takes.
    pub fn size(&self) -> UVec2 {
        let size = self.galley.size();
        UVec2::new(size.x.ceil() as u32, size.y.ceil() as u32)
    }

    /// Whether something of it was left out.
    pub fn is_cut(&self) -> bool {
        self.galley.elided
    }
}

impl Default for Lettering {
    fn default() -> Self {
        Self { fonts: Fonts::new(TextOptions::default(), FontDefinitions::default()) }
    }
}

impl Lettering {
    /// Lays a text out in lines of at most `width` pixels, and at most so many: what there is no room for becomes an ellipsis.
    /// `height` of the letters in pixels.
    pub fn lay(&mut self, text: &str, height: u32, width: u32, lines: usize) -> Text {
        let font = FontId::new(height as f32, FontFamily::Proportional);
        let mut job = LayoutJob::simple(text.to_owned(), font, Color32::WHITE, width as f32);
        job.wrap.max_rows = lines;
        job.wrap.break_anywhere = lines == 1;
        Text { galley: self.fonts.with_pixels_per_point(1.0).layout_job(job) }
    }

    /// Draws a text with its top left corner there.
    pub fn draw(&self, canvas: &mut Canvas, text: &Text, at: UVec2, colour: [u8; 3]) {
        let atlas = self.fonts.texture_atlas().image();
        for row in &text.galley.rows {
            for glyph in row.glyphs.iter().filter(|glyph| !glyph.uv_rect.is_nothing()) {
                let [min, max] = [glyph.uv_rect.min, glyph.uv_rect.max].map(|corner| corner.map(usize::from));
                let place = row.pos + glyph.pos.to_vec2() + glyph.uv_rect.offset;
                let place = at.as_ivec2() + IVec2::new(place.x.round() as i32, place.y.round() as i32);
                for y in min[1]..max[1] {
                    for x in min[0]..max[0] {
                        let cover = f32::from(atlas.pixels[y * atlas.size[0] + x].a()) / 255.0;
                        canvas.mix(place + IVec2::new((x - min[0]) as i32, (y - min[1]) as i32), colour, cover);
                    }
                }
            }
        }
    }
}
