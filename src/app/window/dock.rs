//! What the window gives to the picture, and what to the panel at its right. Pure.

use glam::UVec2;

/// Width of the panel at first, points.
pub const WIDTH: f32 = 300.0;

/// The narrowest that a hand can make it, points.
const LEAST: f32 = 220.0;

/// The part of the window's width that the panel takes at most.
const LARGEST_PART: f32 = 0.6;

/// A screen of less width has no room for both at first, points.
const LEAST_SCREEN: f64 = 640.0;

/// The widths that the panel may have in a window of some width, both in points.
pub fn widths(window: f32) -> [f32; 2] {
    let most = LARGEST_PART * window;
    [LEAST.min(most), most]
}

/// Pixels of a window, from its top left, that are left to the picture beside a panel that wants to be so many points wide; none is
/// closed. A point is `scale` pixels.
pub fn picture_area(window: UVec2, panel: Option<f32>, scale: f32) -> UVec2 {
    let Some(wanted) = panel else { return window };
    let [least, most] = widths(window.x as f32 / scale);
    let taken = (wanted.clamp(least, most) * scale).round() as u32;
    UVec2::new(window.x.saturating_sub(taken).max(1), window.y)
}

/// A window that is to open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opened {
    /// Inner size, points.
    pub size: [f64; 2],
    /// The panel stands beside the picture.
    pub panel: bool,
}

/// The window for a film of a size: as many points as that has pixels, and the panel beside it where it is wanted; less in the same
/// shape where the screen has no room for it. A screen of unknown size has room for all.
pub fn opened(film: UVec2, screen: Option<[f64; 2]>, wants_panel: bool) -> Opened {
    let panel = wants_panel && screen.is_none_or(|[width, _]| width >= LEAST_SCREEN);
    let [width, height] = film.as_dvec2().to_array();
    // Beside a small film, no more than it may have.
    let part = f64::from(LARGEST_PART);
    let beside = if panel { f64::from(WIDTH).min(width * part / (1.0 - part)) } else { 0.0 };
    let factor = screen.map_or(1.0, |[room, high]| ((room - beside) / width).min(high / height).min(1.0));
    let [width, height] = [width, height].map(|side| (side * factor).max(1.0));
    Opened { size: [width + beside, height], panel }
}
