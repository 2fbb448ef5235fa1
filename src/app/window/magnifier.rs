//! The picture's pixels as large squares: how it lies on the window then.

use glam::{UVec2, Vec2};

use crate::gpu::Fit;

/// Window pixels a side of a picture's pixel, at most.
const MOST: u32 = 64;

/// How much larger pixels are shown than they are, and from where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Magnifier(Option<Fit>);

impl Magnifier {
    /// How the picture lies on the window, where it would lie by `plain` without a magnifier.
    pub fn fit(self, plain: Fit) -> Fit {
        self.0.unwrap_or(plain)
    }

    /// Shows pixels twice as large so many times, or half as large if negative, the one under the pointer in its place; at their own size
    /// the picture lies as ever.
    pub fn turn(&mut self, times: i32, pointer: Vec2, picture: UVec2, window: UVec2, plain: Fit) {
        let before = if let Some(Fit::Pixels { scale, .. }) = self.0 { scale } else { 1 };
        let exponent = (before.ilog2() as i32 + times).clamp(0, MOST.ilog2() as i32);
        let (origin, extent) = self.fit(plain).place(picture, window);
        let at = (pointer - origin) / extent * picture.as_vec2();
        let scale = 1 << exponent;
        let origin = (pointer - at * scale as f32).round().as_ivec2();
        self.0 = (scale > 1).then_some(Fit::Pixels { scale, origin });
    }

    /// Window pixels a side of a picture's pixel; none where the picture lies as ever.
    pub fn scale(self) -> Option<u32> {
        self.0.and_then(|fit| if let Fit::Pixels { scale, .. } = fit { Some(scale) } else { None })
    }
}
