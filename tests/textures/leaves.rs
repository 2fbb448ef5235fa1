//! Patches with holes and with light of their own, below a lamp with a picture, behind a leaf.

use glam::{DAffine3, Vec2, Vec3};
use lucerna::components::{Channel, DiffuseMap, Lobe, Material, Passage, Render, Texture, Wrap};

use super::board::{Scene, Textures, colour, directions, number, patch, quad};

/// Patches a side.
pub const COLUMNS: usize = 3;

/// Layers of one patch.
const LAYERS: usize = 10;

/// Opacity of 0.1 to 0.7, but for what is below 0.
fn holes(size: [u32; 2]) -> Texture {
    Texture { gain: 2.0, base: -0.8, ..number(size, Channel::Red) }
}

/// Diffuse maps take the place of diffuse colours.
pub fn leaves(render: Render) -> Scene {
    let render = Render { diffuse_map: DiffuseMap::Replace, max_depth: 4, ..render };
    let mut scene = Scene::new(2 * COLUMNS as u32, render);
    let glow = |texture| Textures { emission: Some(texture), ..Textures::default() };
    scene.lamp(Vec3::new(6.0, 5.0, 4.0), glow(Texture { gain: 2.0, base: -0.3, ..colour([4, 3]) }));
    let unit = [Vec2::ZERO, Vec2::splat(0.8)];
    let plain = Material { diffuse: Vec3::new(0.6, 0.5, 0.4), ..Material::default() };
    let behind = Textures { diffuse: Some(colour([3, 4])), ..Textures::default() };
    let leaf = Textures { opacity: Some(holes([5, 4])), ..behind.clone() };
    let still = DAffine3::IDENTITY;
    // Before the lamp, as the wall sees it.
    let shade = quad(Vec3::new(-0.5, 1.2, 0.6), Vec3::X, 0.9 * Vec3::Z, unit);
    scene.part("shade", shade, still, Material { passage: Passage::SeeThrough(0.7), ..plain }, leaf.clone());
    for i in 0..COLUMNS * COLUMNS {
        scene.part(&format!("patch {i}"), patch(i, COLUMNS, unit), still, plain, behind.clone());
    }
    let mut before = |i: usize, layer: usize, material: Material, maps: &Textures| {
        let mut mesh = patch(i, COLUMNS, unit);
        // Not to be seen before its neighbours.
        let middle = mesh.positions.iter().sum::<glam::DVec3>() / 4.0;
        for at in &mut mesh.positions {
            *at = middle + 0.97 * (*at - middle);
            at.z = 0.004 * (layer + 1) as f64;
        }
        if i == 6 {
            (mesh.uvs, mesh.uv_triangles) = (Vec::new(), Vec::new());
        }
        scene.part(&format!("before {i}, {layer}"), mesh, DAffine3::IDENTITY, material, maps.clone());
    };
    let glowing = Material { emission: Vec3::new(0.4, 0.5, 0.6), ..plain };
    before(0, 0, glowing, &glow(colour([4, 5])));
    let coloured = Material { filter: Vec3::new(1.0, 0.2, 0.2), passage: Passage::SeeThrough(0.7), ..plain };
    before(1, 0, coloured, &leaf);
    for layer in 0..LAYERS {
        before(2, layer, plain, &leaf);
    }
    before(3, 0, Material { passage: Passage::Glass(1.3), ..plain }, &leaf);
    before(
        4,
        0,
        plain,
        &Textures { opacity: Some(Texture { wrap: [Wrap::Clamp; 2], ..holes([1, 6]) }), ..Textures::default() },
    );
    before(5, 0, coloured, &behind);
    before(6, 0, glowing, &Textures { opacity: Some(holes([3, 3])), ..glow(colour([4, 5])) });
    before(
        7,
        0,
        Material { one_sided: true, ..glowing },
        &Textures { opacity: Some(holes([3, 3])), ..glow(colour([2, 5])) },
    );
    let all = Textures {
        specular: Some(colour([2, 4])),
        lobe: Some(number([4, 4], Channel::Red)),
        metallic: Some(number([3, 5], Channel::Alpha)),
        relief: Some(directions([6, 3], true)),
        emission: Some(colour([4, 5])),
        ..leaf.clone()
    };
    before(8, 0, Material { specular: Vec3::splat(0.5), metallic: 0.8, lobe: Lobe::Ggx(0.9), ..glowing }, &all);
    scene
}
