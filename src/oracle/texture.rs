//! Textures in f64: a picture's texels as what they say, and lookups between them.

use glam::{DVec2, DVec3, DVec4};

use super::choice::luminance;
use super::random::Random;
use crate::components::{Channel, Reading, Texels, Texture, TextureImage, Wrap};

/// Least part of a direction that is away from the surface.
const LEAST_UP: f64 = 1e-3;

/// A texture, decoded: a colour, a number in all three channels, or a direction in tangent space, not of unit length.
pub struct Map {
    /// Row by row from the top.
    texels: Vec<DVec3>,
    width: i64,
    height: i64,
    wrap: [Wrap; 2],
    scale: DVec2,
    offset: DVec2,
}

impl Map {
    pub fn new(texture: &Texture) -> Self {
        let image = &*texture.image;
        let (gain, base) = (f64::from(texture.gain), f64::from(texture.base));
        let worth = |value: DVec3| (base + gain * value).max(DVec3::ZERO);
        let parts = parts(image);
        let texels = match texture.reading {
            Reading::Colour if matches!(image.texels, Texels::Float(_)) => {
                parts.iter().map(|rgba| worth(rgba.truncate())).collect()
            }
            Reading::Colour => parts.iter().map(|rgba| worth(rgba.truncate().map(linear))).collect(),
            Reading::Number(channel) => parts.iter().map(|rgba| worth(DVec3::splat(number(*rgba, channel)))).collect(),
            Reading::Normal { flip_green } => parts.iter().map(|rgba| direction(rgba.truncate(), flip_green)).collect(),
            Reading::Height { channel, .. } => parts.iter().map(|rgba| DVec3::splat(number(*rgba, channel))).collect(),
        };
        let (width, height) = (i64::from(image.size.x), i64::from(image.size.y));
        let (scale, offset) = (texture.scale.as_dvec2(), texture.offset.as_dvec2());
        let map = Self { texels, width, height, wrap: texture.wrap, scale, offset };
        match texture.reading {
            Reading::Height { depth, .. } => map.sloping(f64::from(depth)),
            _ => map,
        }
    }

    /// A map of heights of 0 to 1 as directions; `depth` of 1 is as high as the picture is wide, and texels are squares.
    fn sloping(self, depth: f64) -> Self {
        let per_texel = depth * self.width as f64;
        let height = |x: i64, y: i64| self.texel(x, y).x;
        let normal = |x: i64, y: i64| {
            let (along_u, along_v) = (height(x + 1, y) - height(x - 1, y), height(x, y - 1) - height(x, y + 1));
            DVec3::new(-0.5 * per_texel * along_u, -0.5 * per_texel * along_v, 1.0)
        };
        let texels = (0..self.height).flat_map(|y| (0..self.width).map(move |x| (x, y))).map(|(x, y)| normal(x, y));
        Self { texels: texels.collect(), ..self }
    }

    /// The largest that each channel comes to.
    pub fn most(&self) -> DVec3 {
        self.texels.iter().copied().fold(DVec3::ZERO, DVec3::max)
    }

    /// The value at texture coordinates, filtered linearly.
    pub fn filtered(&self, uv: DVec2) -> DVec3 {
        let (x, y, part) = self.cell(uv);
        let row = |y: i64| (1.0 - part.x) * self.texel(x, y) + part.x * self.texel(x + 1, y);
        (1.0 - part.y) * row(y) + part.y * row(y + 1)
    }

    /// One of the texels around texture coordinates, by its weight in the filtered value.
    pub fn drawn(&self, uv: DVec2, random: &mut Random) -> DVec3 {
        let (x, y, part) = self.cell(uv);
        let x = if random.unit() < part.x { x + 1 } else { x };
        let y = if random.unit() < part.y { y + 1 } else { y };
        self.texel(x, y)
    }

    /// The upper left of the four texels around texture coordinates, and how far from its middle they are, 0 to 1.
    fn cell(&self, uv: DVec2) -> (i64, i64, DVec2) {
        let at = uv * self.scale + self.offset;
        let within = |at: f64, wrap: Wrap| match wrap {
            Wrap::Repeat => at - at.floor(),
            Wrap::Clamp => at.clamp(0.0, 1.0),
        };
        // From the upper left corner, in texels.
        let x = within(at.x, self.wrap[0]) * self.width as f64;
        let y = (1.0 - within(at.y, self.wrap[1])) * self.height as f64;
        let from_middle = DVec2::new(x, y) - 0.5;
        let cell = from_middle.floor();
        (cell.x as i64, cell.y as i64, from_middle - cell)
    }

    /// A texel of the picture, or of what continues it.
    fn texel(&self, x: i64, y: i64) -> DVec3 {
        let within = |at: i64, count: i64, wrap: Wrap| match wrap {
            Wrap::Repeat => at.rem_euclid(count),
            Wrap::Clamp => at.clamp(0, count - 1),
        };
        let (x, y) = (within(x, self.width, self.wrap[0]), within(y, self.height, self.wrap[1]));
        self.texels[(y * self.width + x) as usize]
    }
}

/// Red, green, blue and alpha as parts of the greatest code, or as they are.
fn parts(image: &TextureImage) -> Vec<DVec4> {
    let grey = |code: f64| DVec3::splat(code).extend(1.0);
    match &image.texels {
        Texels::Rgba8(codes) => codes.iter().map(|rgba| DVec4::from(rgba.map(f64::from)) / 255.0).collect(),
        Texels::Grey8(codes) => codes.iter().map(|code| grey(f64::from(*code) / 255.0)).collect(),
        Texels::Grey16(codes) => codes.iter().map(|code| grey(f64::from(*code) / 65535.0)).collect(),
        Texels::Rgba16(codes) => codes.iter().map(|rgba| DVec4::from(rgba.map(f64::from)) / 65535.0).collect(),
        Texels::Float(values) => values.iter().map(|rgba| DVec4::from(rgba.map(f64::from))).collect(),
    }
}

/// From sRGB, 0 to 1 (IEC 61966-2-1).
fn linear(code: f64) -> f64 {
    if code <= 0.04045 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}

fn number(rgba: DVec4, channel: Channel) -> f64 {
    match channel {
        Channel::Red => rgba.x,
        Channel::Green => rgba.y,
        Channel::Blue => rgba.z,
        Channel::Alpha => rgba.w,
        Channel::Luminance => luminance(rgba.truncate()),
    }
}

fn direction(rgb: DVec3, flip_green: bool) -> DVec3 {
    let n = 2.0 * rgb - 1.0;
    DVec3::new(n.x, if flip_green { -n.y } else { n.y }, n.z.max(LEAST_UP))
}
