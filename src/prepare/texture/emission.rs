//! What a map of emission comes to: its greatest value, and its mean over a triangle, by which light sampling draws that.

use glam::{Vec2, Vec3};

use super::pyramid::{Level, half};
use super::source::Source;
use crate::components::{Texture, Wrap};

/// Points of a triangle along each of its sides that are looked up.
const POINTS: u32 = 32;

/// The largest channel of any texel.
pub fn brightest(texture: &Texture) -> f32 {
    let source = Source::new(texture);
    let size = texture.image.size;
    let value = |x, y| {
        let [r, g, b, _] = source.rgba(x, y);
        let values = [r, g, b].map(|channel| texture.base + texture.gain * channel);
        values.into_iter().fold(0.0, f32::max)
    };
    (0..size.y).flat_map(|y| (0..size.x).map(move |x| (x, y))).map(|(x, y)| value(x, y)).fold(0.0, f32::max)
}

/// A map's levels, for means over triangles.
pub struct MeanEmission {
    levels: Vec<Level<4>>,
    gain: f32,
    base: f32,
    wrap: [Wrap; 2],
    scale: Vec2,
    offset: Vec2,
}

/// Reads a map.
pub fn mean_emission(texture: &Texture) -> MeanEmission {
    let source = Source::new(texture);
    let mut levels = vec![Level::of(texture.image.size, &|x, y| source.rgba(x, y))];
    while let Some(level) = levels.last().filter(|level| half(level.size) != level.size) {
        levels.push(level.next());
    }
    let Texture { gain, base, wrap, scale, offset, .. } = *texture;
    MeanEmission { levels, gain, base, wrap, scale, offset }
}

impl MeanEmission {
    /// The mean over a triangle of such texture coordinates. By the level at which the points that are looked up are a texel apart, so that
    /// none between them is missed.
    pub fn over(&self, corners: [Vec2; 3]) -> Vec3 {
        let [a, b, c] = corners.map(|uv| uv * self.scale + self.offset);
        let sides = [b - a, c - b, a - c].map(|side| (side * self.levels[0].size.as_vec2()).length());
        let texels = sides.into_iter().fold(0.0, f32::max);
        let level = (texels / POINTS as f32).max(1.0).log2().ceil() as usize;
        let level = &self.levels[level.min(self.levels.len() - 1)];
        let (mut sum, mut count) = (Vec3::ZERO, 0.0);
        for i in 0..POINTS {
            for j in 0..POINTS - i {
                let (s, t) = ((i as f32 + 1.0 / 3.0) / POINTS as f32, (j as f32 + 1.0 / 3.0) / POINTS as f32);
                sum += self.filtered(level, a + s * (b - a) + t * (c - a));
                count += 1.0;
            }
        }
        sum / count
    }

    /// The value at a point of the picture, v up.
    fn filtered(&self, level: &Level<4>, at: Vec2) -> Vec3 {
        let size = level.size.as_vec2();
        let place = Vec2::new(self.within(at.x, 0), 1.0 - self.within(at.y, 1)) * size - 0.5;
        let (cell, part) = (place.floor(), place - place.floor());
        let mut sum = Vec3::ZERO;
        for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let weight = if dx == 0 { 1.0 - part.x } else { part.x } * if dy == 0 { 1.0 - part.y } else { part.y };
            let x = self.texel(cell.x as i64 + dx, level.size.x, 0);
            let y = self.texel(cell.y as i64 + dy, level.size.y, 1);
            let [r, g, b, _] = level.at(x, y);
            sum += weight * (self.base + self.gain * Vec3::new(r, g, b)).max(Vec3::ZERO);
        }
        sum
    }

    fn within(&self, at: f32, axis: usize) -> f32 {
        match self.wrap[axis] {
            Wrap::Repeat => at - at.floor(),
            Wrap::Clamp => at.clamp(0.0, 1.0),
        }
    }

    fn texel(&self, at: i64, most: u32, axis: usize) -> u32 {
        match self.wrap[axis] {
            Wrap::Repeat => at.rem_euclid(i64::from(most)) as u32,
            Wrap::Clamp => at.clamp(0, i64::from(most) - 1) as u32,
        }
    }
}
