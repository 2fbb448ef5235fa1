//! Pictures that the scene needs, as files: linear EXR, each written once.

use std::collections::HashMap;
use std::collections::hash_map::{DefaultHasher, Entry};
use std::hash::{Hash, Hasher};
use std::path::PathBuf;

use glam::{DMat4, DVec3, UVec2, Vec3};

use super::xml::Element;
use crate::components::{Channel, Crop, Reading, Texture, Wrap};
use crate::image::{Output, Picture, SaveError};
use crate::prepare::texture::Source;

/// The folder of pictures, within the scene's.
pub const FOLDER: &str = "textures";

/// Writes pictures into a scene's folder, and says what they are called.
pub struct Pictures {
    folder: PathBuf,
    /// Hashes of what was written, and the files.
    known: HashMap<u64, String>,
}

impl Pictures {
    pub fn new(folder: PathBuf) -> Self {
        Self { folder, known: HashMap::new() }
    }

    /// Writes linear pixels, row by row from the top; gives the file's name from the scene's folder.
    pub fn write(&mut self, size: UVec2, pixels: &[Vec3]) -> Result<String, SaveError> {
        let linear: Vec<[f32; 3]> = pixels.iter().map(Vec3::to_array).collect();
        let mut hasher = DefaultHasher::new();
        (size.to_array(), bytemuck::cast_slice::<_, u8>(&linear)).hash(&mut hasher);
        let next = self.known.len() + 1;
        match self.known.entry(hasher.finish()) {
            Entry::Occupied(held) => Ok(held.get().clone()),
            Entry::Vacant(free) => {
                let name = format!("{FOLDER}/{next}.exr");
                let window = Crop { min: UVec2::ZERO, max: size };
                let report = serde_json::Value::Null;
                let picture = Picture { size, window, linear: &linear, display: &[], metadata: &[], report: &report };
                Output::new(self.folder.join(&name))?.write(&picture)?;
                Ok(free.insert(name).clone())
            }
        }
    }

    /// A texture of the parameter `name`, each texel of it changed by `of`, and looked up where Lucerna looks.
    pub fn texture(&mut self, name: &str, texture: &Texture, of: &dyn Fn(Vec3) -> Vec3) -> Result<Element, SaveError> {
        let file = self.write(texture.image.size, &texels(texture).into_iter().map(of).collect::<Vec<_>>())?;
        Ok(looked_up(bitmap(name, &file), texture))
    }

    /// A colour of the parameter `name`. Mitsuba takes no reflectance above 1, but in a picture.
    pub fn colour(&mut self, name: &str, colour: Vec3) -> Result<Element, SaveError> {
        if colour.max_element() <= 1.0 {
            let text = format!("{}, {}, {}", colour.x, colour.y, colour.z);
            return Ok(Element::new("rgb").named(name).attribute("value", text));
        }
        let file = self.write(UVec2::ONE, &[colour])?;
        Ok(bitmap(name, &file))
    }
}

fn bitmap(name: &str, file: &str) -> Element {
    Element::plugin("texture", "bitmap").named(name).string("filename", file).boolean("raw", true)
}

/// The texture's scale, offset and edges. Rows go down, and v up.
fn looked_up(bitmap: Element, texture: &Texture) -> Element {
    let Texture { scale, offset, wrap, .. } = *texture;
    let (scale, offset) = (scale.as_dvec2(), offset.as_dvec2());
    let turned = DMat4::from_translation(DVec3::new(offset.x, 1.0 - offset.y, 0.0))
        * DMat4::from_scale(DVec3::new(scale.x, -scale.y, 1.0));
    let mode = if wrap == [Wrap::Clamp; 2] { "clamp" } else { "repeat" };
    bitmap.string("wrap_mode", mode).matrix("to_uv", turned)
}

/// What the texels of a texture are worth: colours, a number in all channels, or directions as codes of 0 to 1.
fn texels(texture: &Texture) -> Vec<Vec3> {
    let size = texture.image.size;
    let source = Source::new(texture);
    let places = || (0..size.y).flat_map(|y| (0..size.x).map(move |x| (x, y)));
    let valued = |value: Vec3| Vec3::splat(texture.base) + texture.gain * value;
    match texture.reading {
        Reading::Colour => places().map(|(x, y)| valued(Vec3::from_slice(&source.rgba(x, y)))).collect(),
        Reading::Number(channel) => places().map(|(x, y)| valued(Vec3::splat(source.channel(channel, x, y)))).collect(),
        Reading::Normal { flip_green } => {
            let code = |(x, y)| {
                let [r, g, b, _] = source.rgba(x, y);
                Vec3::new(r, if flip_green { 1.0 - g } else { g }, b)
            };
            places().map(code).collect()
        }
        Reading::Height { channel, depth } => places().map(|at| slope(texture, &source, channel, depth, at)).collect(),
    }
}

/// The direction that a relief of heights has at a texel, as a code: by central differences.
fn slope(texture: &Texture, source: &Source, channel: Channel, depth: f32, (x, y): (u32, u32)) -> Vec3 {
    let size = texture.image.size;
    let beside = |at: u32, by: i64, most: u32, wrap: Wrap| match wrap {
        Wrap::Repeat => (i64::from(at) + by).rem_euclid(i64::from(most)) as u32,
        Wrap::Clamp => (i64::from(at) + by).clamp(0, i64::from(most) - 1) as u32,
    };
    let height = |dx: i64, dy: i64| {
        source.channel(channel, beside(x, dx, size.x, texture.wrap[0]), beside(y, dy, size.y, texture.wrap[1]))
    };
    // Heights are in widths of the picture, and texels are squares of it.
    let scale = 0.5 * depth * size.x as f32;
    let normal = Vec3::new(scale * (height(-1, 0) - height(1, 0)), scale * (height(0, 1) - height(0, -1)), 1.0);
    0.5 + 0.5 * normal.normalize()
}

/// The mean and the greatest of what a texture's texels are worth.
pub fn mean_and_most(texture: &Texture) -> (Vec3, Vec3) {
    let all = texels(texture);
    let sum = all.iter().fold(glam::DVec3::ZERO, |sum, texel| sum + texel.as_dvec3());
    ((sum / all.len().max(1) as f64).as_vec3(), all.into_iter().fold(Vec3::ZERO, Vec3::max))
}
