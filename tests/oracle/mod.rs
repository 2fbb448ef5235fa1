//! The f64 path tracer against what is known by other means: series, quadrature, form factors, itself without asking
//! lights, and the engine.

mod engine;
mod known;
mod lights;
mod pictures;
mod points;
mod surfaces;

use bevy_ecs::prelude::*;
use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Lobe, Material, Passage};
use lucerna::oracle::{Oracle, Picture};

use crate::statistics::{BATCHES, Pairs, agree};

/// The next `spp` samples of batch `i`.
fn batch(oracle: &Oracle, i: usize, spp: u32, seed: u64) -> Picture {
    let first = i as u32 * spp;
    oracle.render(first..first + spp, seed, 2, &|_, _| ())
}

/// The mean of the left and of the right half of a picture.
fn halves(width: u32, pixels: &[DVec3]) -> [DVec3; 2] {
    let mut sums = [DVec3::ZERO; 2];
    for (i, pixel) in pixels.iter().enumerate() {
        sums[usize::from(i as u32 % width >= width / 2)] += *pixel;
    }
    sums.map(|sum| sum / (0.5 * pixels.len() as f64))
}

/// Whether two estimators agree in both halves and every channel, over independent batches.
fn compare(
    mut ours: impl FnMut(usize) -> [DVec3; 2],
    mut right: impl FnMut(usize) -> [DVec3; 2],
) -> Result<(), String> {
    let batches: Vec<_> = (0..BATCHES).map(|i| (ours(i), right(i))).collect();
    for half in 0..2 {
        for c in 0..3 {
            let pairs = Pairs {
                differences: std::array::from_fn(|i| batches[i].0[half][c] - batches[i].1[half][c]),
                mean: batches.iter().map(|(_, right)| right[half][c]).sum::<f64>() / BATCHES as f64,
            };
            agree(&pairs).map_err(|why| format!("half {half}, channel {c}: {why}"))?;
        }
    }
    Ok(())
}

const SMALL: UVec2 = UVec2::new(16, 8);

fn shiny() -> Material {
    Material { diffuse: Vec3::splat(0.4), specular: Vec3::splat(0.4), lobe: Lobe::Phong(20.0), ..Material::default() }
}

fn rough() -> Material {
    let (diffuse, specular) = (Vec3::new(0.5, 0.4, 0.2), Vec3::splat(0.3));
    Material { diffuse, specular, lobe: Lobe::Ggx(0.6), metallic: 0.5, ..Material::default() }
}

fn mirror() -> Material {
    Material { diffuse: Vec3::splat(0.1), specular: Vec3::splat(0.8), lobe: Lobe::Mirror, ..Material::default() }
}

fn glass() -> Material {
    Material { passage: Passage::Glass(1.5), filter: Vec3::new(0.9, 1.0, 0.8), ..Material::default() }
}

fn pane() -> Material {
    Material { passage: Passage::Pane(1.5), ..glass() }
}

fn coated() -> Material {
    Material { diffuse: Vec3::new(0.7, 0.2, 0.1), coat: 1.0, ..Material::default() }
}

/// Under a rough coat that is not all over it.
fn satin() -> Material {
    Material { coat: 0.8, coat_roughness: 0.5, ..rough() }
}

fn veil() -> Material {
    let passage = Passage::SeeThrough(0.4);
    Material { diffuse: Vec3::new(0.7, 0.5, 0.3), passage, filter: Vec3::new(1.0, 0.8, 0.9), ..Material::default() }
}
