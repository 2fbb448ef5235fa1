//! Surfaces with holes: layers of them before the sky, and some before a lamp, with see-through ones among them.

use std::sync::Arc;

use glam::{DAffine3, DVec3, UVec2, Vec3};

use crate::components::{
    Camera, Channel, Environment, Integrator, Material, MeshData, Passage, Reading, Render, Sampler, Texels, Texture,
    TextureImage,
};
use crate::scene::{MapUse, SceneDescription, TextureMap, texture_name};
use crate::stats::agreement::{BATCHES, MOST_ERRORS};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::described::{add, empty, matte, quad};
use crate::stress::tools::films::estimates;
use crate::stress::tools::paths::{as_measured, compare};

pub static ROW: Row = Row {
    name: "cut-outs",
    holds: "1 to 1,000 layers with holes let through the product of what each does; shadow rays through some agree with paths",
    quantity: "standard errors",
    most: MOST_ERRORS,
    unit: "samples",
    sizes: [6_000_000, 12_000_000, 200_000_000],
    measure,
};

/// Pixels a side before the sky, and before the lamp.
const SIDE: u32 = 32;
const BLOCK: u32 = 8;

/// Layers, and the code of what part of each is there.
const STACKS: [(u32, u8); 7] = [(1, 128), (2, 128), (4, 128), (8, 128), (30, 8), (300, 1), (1000, 128)];

/// One in so many samples is before the sky.
const OF_SKY: u64 = 10;

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let mut all = Measured::new(0.0, 0);
    let of_stack = size / OF_SKY / STACKS.len() as u64;
    for (k, (layers, code)) in STACKS.into_iter().enumerate() {
        all = all.worst(before_the_sky(lab, layers, code, of_stack)?);
        lab.tell(k as u64 + 1, OF_SKY * STACKS.len() as u64);
    }
    Ok(all.worst(before_a_lamp(lab, size - size / OF_SKY)?))
}

/// Part of the surface that a code leaves there.
fn coverage(code: u8) -> f64 {
    f64::from(code) / 255.0
}

/// Gives a material of the scene holes by a picture of one code a texel.
fn cut(scene: &mut SceneDescription, material: &str, codes: &[u8]) {
    let image = TextureImage { size: UVec2::new(codes.len() as u32, 1), texels: Texels::Grey8(codes.to_vec()) };
    let map = TextureMap::new(material);
    let texture = Texture::new(Arc::new(image), Reading::Number(Channel::Red));
    scene.textures.insert(texture_name(&map, MapUse::Number), texture);
    if let Some(cut) = scene.materials.get_mut(material) {
        cut.maps.d = Some(map);
    }
}

/// How far what passes a stack is from the product.
fn before_the_sky(lab: &Lab, layers: u32, code: u8, size: u64) -> Result<Measured, StressError> {
    let camera = Camera { position: DVec3::new(0.0, 0.0, 3.0), fov_y: 30.0, ..Camera::default() };
    let mut scene = empty(UVec2::splat(SIDE), camera);
    scene.environment = Some(Environment::Constant(Vec3::ONE));
    let spp = size.div_ceil(u64::from(SIDE * SIDE)) as u32;
    scene.render = Render { max_depth: 2, spp, sampler: Sampler::Pcg, ..Render::default() };
    let mut stack = MeshData::default();
    for i in 0..layers {
        let z = 1.0 - 2.0 * i as f32 / layers as f32;
        let sheet = quad(Vec3::new(-9.0, -9.0, z), 18.0 * Vec3::X, 18.0 * Vec3::Y);
        let first = stack.positions.len() as u32;
        stack.positions.extend(sheet.positions);
        stack.uvs.extend(sheet.uvs);
        stack.triangles.extend(sheet.triangles.iter().map(|corners| corners.map(|corner| corner + first)));
    }
    stack.uv_triangles = stack.triangles.clone();
    add(&mut scene, "stack", stack, DAffine3::IDENTITY, matte(Vec3::ZERO));
    cut(&mut scene, "stack", &[code]);
    let mean = lab.film(&scene)?.mean[0];
    // Every sample is 0 or 1; where hardly any is 1, as many as one of them is what chance may do.
    let (right, count) = ((1.0 - coverage(code)).powi(layers as i32), f64::from(spp * SIDE * SIDE));
    let error = (right * (1.0 - right) / count).sqrt().max(1.0 / count);
    let note = format!("{layers} layers of {:.4}: {mean:.5}, the product {right:.5}", coverage(code));
    Ok(Measured::new((mean - right).abs() / error, count as u64).noted(note))
}

/// Whether light sampling and chance agree on a lamp behind holes, and behind what has holes and lets light through besides.
fn before_a_lamp(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let camera = Camera { position: DVec3::new(0.0, 0.5, 3.0), look_at: DVec3::ZERO, fov_y: 30.0, ..Camera::default() };
    let mut scene = empty(UVec2::splat(BLOCK), camera);
    let sheet = |width: f32, y: f32| {
        let half = 0.5 * width;
        quad(Vec3::new(-half, y, half), width * Vec3::X, -width * Vec3::Z)
    };
    add(&mut scene, "floor", sheet(4.0, 0.0), DAffine3::IDENTITY, matte(Vec3::splat(0.5)));
    let glow = Material { emission: Vec3::splat(5.0), ..matte(Vec3::ZERO) };
    add(&mut scene, "lamp", sheet(3.0, 1.2), DAffine3::IDENTITY, glow);
    let veil = |opacity: f32| Material { passage: Passage::SeeThrough(opacity), filter: Vec3::ONE, ..Material::BLACK };
    let sheets = [
        ("leaf", matte(Vec3::ZERO), vec![255, 0, 128, 64]),
        ("net", veil(0.5), vec![128]),
        ("veil", veil(0.3), vec![]),
    ];
    for (k, (name, material, codes)) in sheets.into_iter().enumerate() {
        add(&mut scene, name, sheet(4.0, 0.8 + 0.1 * k as f32), DAffine3::IDENTITY, material);
        if !codes.is_empty() {
            cut(&mut scene, name, &codes);
        }
    }
    let spp = size.div_ceil(2 * BATCHES as u64 * u64::from(BLOCK * BLOCK)) as u32;
    let render = Render { max_depth: 5, spp, sampler: Sampler::Pcg, roulette: false, ..Render::default() };
    let by = |integrator| SceneDescription { render: Render { integrator, ..render }, ..scene.clone() };
    let agreement =
        compare(estimates(lab, &by(Integrator::Path), 0)?, estimates(lab, &by(Integrator::Bsdf), BATCHES as u32)?)?;
    Ok(as_measured(agreement, size, "holes before a lamp, path and bsdf"))
}
