//! Normal and height maps where all around is equally bright, seen straight on and grazing.

use std::sync::Arc;

use glam::{DAffine3, DVec3, UVec2, Vec2, Vec3};

use crate::components::{Camera, Channel, Environment, Lobe, Material, Reading, Render, Texels, Texture, TextureImage};
use crate::scene::{MapUse, SceneDescription, TextureMap, texture_name};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::described::{add, empty, quad};

pub static ROW: Row = Row {
    name: "relief",
    holds: "a white surface with normals that lean up to 70 degrees, or with heights, gives back no more than it gets, and most",
    quantity: "energy beyond 1, or short of what its lobe keeps",
    most: 1e-3,
    unit: "samples",
    sizes: [32 * 65_536, 32 * 65_536, 32 * 1_000_000],
    measure,
};

const SIDE: u32 = 16;

/// How often the map is repeated over the surface.
const REPEATS: f32 = 40.0;

/// A picture by a function of column and row.
fn picture(size: UVec2, texel: impl Fn(u32, u32) -> [u8; 4]) -> Arc<TextureImage> {
    let places = (0..size.y).flat_map(|y| (0..size.x).map(move |x| (x, y)));
    Arc::new(TextureImage { size, texels: Texels::Rgba8(places.map(|(x, y)| texel(x, y)).collect()) })
}

/// Directions that lean up to 70 degrees, every way.
fn directions() -> Texture {
    let picture = picture(UVec2::splat(32), |x, y| {
        let at = Vec2::new(x as f32, y as f32) / 31.0 * 2.0 - 1.0;
        let lean = at.clamp_length_max(1.0) * 0.94;
        let n = lean.extend((1.0 - lean.length_squared()).sqrt());
        let code = |v: f32| (127.5 * (v + 1.0) + 0.5) as u8;
        [code(n.x), code(n.y), code(n.z), 255]
    });
    Texture::new(picture, Reading::Normal { flip_green: false })
}

fn heights() -> Texture {
    let picture = picture(UVec2::new(63, 31), |x, y| {
        let value = ((x as f32 * 0.4).sin() * (y as f32 * 0.6).sin() * 100.0 + 128.0) as u8;
        [value, value, value, 255]
    });
    Texture::new(picture, Reading::Height { channel: Channel::Luminance, depth: 0.4 })
}

/// The surface in a sky of 1, seen at an angle from its normal: it fills the picture.
fn scene(material: Material, relief: &Texture, degrees: f64, spp: u32) -> SceneDescription {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let position = 10.0 * DVec3::new(sin, 0.0, cos);
    let camera = Camera { position, look_at: DVec3::ZERO, up: DVec3::Y, fov_y: 2.0, ..Camera::default() };
    let mut scene = empty(UVec2::splat(SIDE), camera);
    scene.environment = Some(Environment::Constant(Vec3::ONE));
    scene.render = Render { max_depth: 64, spp, roulette: false, ..Render::default() };
    let mut mesh = quad(Vec3::new(-30.0, -30.0, 0.0), 60.0 * Vec3::X, 60.0 * Vec3::Y);
    mesh.uvs.iter_mut().for_each(|uv| *uv *= REPEATS);
    add(&mut scene, "plane", mesh, DAffine3::IDENTITY, material);
    let map = TextureMap::new("relief");
    scene.textures.insert(texture_name(&map, MapUse::Bump), relief.clone());
    scene.materials.values_mut().for_each(|material| material.maps.bump = Some(map.clone()));
    scene
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let white = Material { diffuse: Vec3::ONE, ..Material::BLACK };
    let shiny = |lobe| Material { specular: Vec3::ONE, lobe, ..Material::BLACK };
    // What each keeps at least: facets of rough lobes shadow each other.
    let surfaces = [
        ("diffuse", white, 1.0),
        ("mirror", shiny(Lobe::Mirror), 1.0),
        ("GGX of 0.3", shiny(Lobe::Ggx(0.3)), 0.9),
        ("GGX of 0.8", shiny(Lobe::Ggx(0.8)), 0.4),
    ];
    let spp = size.div_ceil(32 * u64::from(SIDE * SIDE)) as u32;
    let mut all = Measured::new(0.0, 0);
    for (k, (name, material, least)) in surfaces.into_iter().enumerate() {
        for (kind, relief) in [("directions", directions()), ("heights", heights())] {
            for degrees in [0.0, 60.0, 85.0, 89.5] {
                let film = lab.film(&scene(material, &relief, degrees, spp))?;
                let mean = film.mean[0];
                let note = format!("{name}, {kind}, {degrees} degrees: {mean:.5}");
                let off = (mean - 1.0).max(least - mean);
                all = all.worst(Measured::new(off, u64::from(spp * SIDE * SIDE)).noted(note));
            }
        }
        lab.tell(k as u64 + 1, surfaces.len() as u64);
    }
    Ok(all)
}
