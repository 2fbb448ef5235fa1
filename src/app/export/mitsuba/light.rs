//! Lights without extent, and the light from beyond the scene.

use std::f64::consts::PI;

use glam::{DMat3, DMat4, DVec3, UVec2, Vec3};

use super::note::{Notes, Weight};
use super::picture::Pictures;
use super::xml::Element;
use crate::components::{Environment, PointLight};
use crate::image::SaveError;
use crate::prepare::{daylight, sun};

/// Pixels of a sky that is written, at most, along its width.
const WIDEST: u32 = 4096;

/// How far away the sun is, in radii of the scene.
const SUN_AWAY: f64 = 1e4;

/// A point light or a spot.
pub fn point(name: &str, light: &PointLight, notes: &mut Notes) -> Element {
    let Some(cone) = light.cone else {
        return Element::plugin("emitter", "point").point("position", light.position).rgb("intensity", light.intensity);
    };
    if cone.blend > 0.0 {
        let text = format!(
            "light `{name}`: towards the edge of its cone the spot grows darker by angle; in Lucerna it does by a cubic of the cosine"
        );
        notes.say(Weight::Another, &text);
    }
    // Across the axis, whatever that is.
    let up = (cone.look_at - light.position).normalize_or(DVec3::NEG_Y).any_orthonormal_vector();
    let half = 0.5 * cone.angle;
    // A cone that is as wide as its beam has no edge to divide by.
    let beam = (half * (1.0 - cone.blend)).min(half * (1.0 - 1e-4));
    Element::plugin("emitter", "spot")
        .look_at("to_world", [light.position, cone.look_at, up])
        .rgb("intensity", light.intensity)
        .float("cutoff_angle", half)
        .float("beam_width", beam)
}

/// The environment. `centre` and `radius` are those of the scene.
pub fn environment(
    environment: &Environment,
    (centre, radius): (DVec3, f64),
    pictures: &mut Pictures,
    notes: &mut Notes,
) -> Result<Vec<Element>, SaveError> {
    match environment {
        Environment::Constant(radiance) => Ok(vec![Element::plugin("emitter", "constant").rgb("radiance", *radiance)]),
        Environment::Map { image, strength, tint, turn } => {
            let factor = *strength * *tint;
            let pixels: Vec<Vec3> = image.pixels.iter().map(|pixel| factor * *pixel).collect();
            Ok(vec![sky(image.size, &pixels, *turn, pictures, notes)?])
        }
        Environment::Daylight(day) => {
            let turn = DMat3::from_rotation_y(-day.azimuth.to_radians());
            let pixels = daylight::sky_pixels(day);
            let mut all = vec![sky(daylight::SIZE, &pixels, turn, pictures, notes)?];
            if let Some(sun) = sun::sun_of(day) {
                notes.say(Weight::Slight, "the sun is a disk ten thousand radii of the scene away");
                let direction = sun.direction.as_dvec3();
                let away = SUN_AWAY * radius.max(f64::MIN_POSITIVE);
                let size = away * (0.5 * day.sun_size.clamp(0.01, 90.0)).to_radians().tan();
                let at = centre + away * direction;
                let rotation = DMat3::from_cols(
                    direction.any_orthonormal_vector(),
                    -direction.cross(direction.any_orthonormal_vector()),
                    -direction,
                );
                let place =
                    DMat4::from_translation(at) * DMat4::from_mat3(rotation) * DMat4::from_scale(DVec3::splat(size));
                all.push(
                    Element::plugin("shape", "disk")
                        .matrix("to_world", place)
                        .with(Element::plugin("bsdf", "diffuse").rgb("reflectance", Vec3::ZERO))
                        .with(Element::plugin("emitter", "area").rgb("radiance", sun.radiance)),
                );
            }
            Ok(all)
        }
    }
}

/// A picture of all directions, which Mitsuba filters linearly between texels, of which the first and last row are the poles. So it is written
/// several times as fine.
fn sky(
    size: UVec2,
    pixels: &[Vec3],
    turn: DMat3,
    pictures: &mut Pictures,
    notes: &mut Notes,
) -> Result<Element, SaveError> {
    notes.say(
        Weight::Slight,
        "Mitsuba blends a sky's picture between its pixels, over a part of one: those of Lucerna have one radiance each",
    );
    let fine = (WIDEST / size.x).clamp(1, 8);
    let (width, rows) = (size.x * fine, size.y * fine);
    let mut texels = Vec::with_capacity(width as usize * (rows as usize + 1));
    for row in 0..=rows {
        // Half a texel above and below.
        let halves = [-0.25, 0.25].map(|off| ((f64::from(row) + off).clamp(0.0, f64::from(rows) - 0.5) as u32) / fine);
        for column in 0..width {
            let [above, below] = halves.map(|row| pixels[(row * size.x + column / fine) as usize]);
            texels.push(0.5 * (above + below));
        }
    }
    let file = pictures.write(UVec2::new(width, rows + 1), &texels)?;
    // Mitsuba's pictures begin where the middle of Lucerna's is.
    let turn = DMat4::from_mat3(turn * DMat3::from_rotation_y(PI));
    Ok(Element::plugin("emitter", "envmap").string("filename", &file).matrix("to_world", turn))
}
