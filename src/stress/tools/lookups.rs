//! Textures looked up by the whole engine at given coordinates: each is all over a patch of its own.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3, UVec2, Vec2, Vec3};

use crate::components::{
    Camera, Material, MeshData, Reading, Render, Sampler, Texels, Texture, TextureFilter, TextureImage, Wrap,
};
use crate::scene::{MapUse, SceneDescription, TextureMap, texture_name};
use crate::stress::lab::Lab;
use crate::stress::measured::StressError;
use crate::stress::scenes::described::{add, empty};

/// Pixels of a patch's side. Of each the inner ones are looked at, which see nothing of its neighbours.
const PATCH: u32 = 4;

/// Colours of 8 bits, no two of them alike.
pub fn texture(size: UVec2, wrap: Wrap) -> Texture {
    let code = |i: u32| (i.wrapping_mul(0x9e37_79b1) >> 24) as u8;
    let texels =
        (0..size.element_product()).map(|i| [code(3 * i + 1), code(3 * i + 2), code(3 * i + 3), 255]).collect();
    let image = TextureImage { size, texels: Texels::Rgba8(texels) };
    Texture { wrap: [wrap; 2], ..Texture::new(Arc::new(image), Reading::Colour) }
}

/// A wall of patches that glow as the texture says at each place.
fn wall(texture: &Texture, places: &[DVec2], spp: u32) -> (SceneDescription, UVec2) {
    let count = places.len() as u32;
    let columns = (f64::from(count)).sqrt().ceil() as u32;
    let grid = UVec2::new(columns, count.div_ceil(columns));
    let mut mesh = MeshData::default();
    for (i, place) in places.iter().enumerate() {
        let corner = DVec3::new((i as u32 % columns) as f64, f64::from(grid.y - 1 - i as u32 / columns), 0.0);
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y].map(|edge| corner + edge));
        mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        mesh.uvs.push(Vec2::new(place.x as f32, place.y as f32));
        mesh.uv_triangles.extend([[i as u32; 3]; 2]);
    }
    let (middle, distance) = (DVec3::new(f64::from(grid.x) / 2.0, f64::from(grid.y) / 2.0, 0.0), 10.0);
    let fov_y = 2.0 * (f64::from(grid.y) / 2.0 / distance).atan().to_degrees();
    let camera =
        Camera { position: middle + distance * DVec3::Z, look_at: middle, up: DVec3::Y, fov_y, ..Camera::default() };
    let mut scene = empty(PATCH * grid, camera);
    let glow = Material { diffuse: Vec3::ZERO, emission: Vec3::ONE, ..Material::default() };
    add(&mut scene, "wall", mesh, DAffine3::IDENTITY, glow);
    let map = TextureMap { wrap: texture.wrap, ..TextureMap::new("texels") };
    scene.textures.insert(texture_name(&map, MapUse::Colour), texture.clone());
    scene.materials.values_mut().for_each(|material| material.maps.ke = Some(map.clone()));
    let texture_filter = TextureFilter::Exact;
    scene.render = Render { max_depth: 1, spp, texture_filter, sampler: Sampler::Pcg, ..Render::default() };
    (scene, grid)
}

/// The mean of `4 * spp` lookups at each place.
pub fn looked_up(lab: &Lab, texture: &Texture, places: &[DVec2], spp: u32) -> Result<Vec<DVec3>, StressError> {
    let (scene, grid) = wall(texture, places, spp);
    let film = lab.film(&scene)?;
    let at = |x: u32, y: u32| DVec3::from(film.rgb[(y * PATCH * grid.x + x) as usize].map(f64::from));
    let mean = |i: u32| {
        let corner = PATCH * UVec2::new(i % grid.x, i / grid.x);
        let inner = (1..PATCH - 1).flat_map(|y| (1..PATCH - 1).map(move |x| (x, y)));
        inner.map(|(x, y)| at(corner.x + x, corner.y + y)).sum::<DVec3>() / f64::from((PATCH - 2) * (PATCH - 2))
    };
    Ok((0..places.len() as u32).map(mean).collect())
}
