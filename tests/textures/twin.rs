//! The kernel with textures against its f64 twin, path by path, and the errors that this shows.

use std::time::Duration;

use glam::{DVec3, UVec2};
use lucerna::components::{Integrator, Reuse, Sampler, TextureFilter};
use lucerna::cpu::path::PathScene;
use lucerna::cpu::rng::Source;
use lucerna::engine::Engine;
use lucerna::gpu::GpuTable;
use lucerna::layout::light::{LightRecord, LightTable};
use lucerna::layout::trace::{MaterialRecord, RadianceSample, SAMPLE_BAD, Shading, TILE_BLOCK, TraceParams};
use lucerna::layout::tree::Triangle;
use lucerna::scene::SceneDescription;
use lucerna::shader::Library;
use lucerna::systems::resources::{Device, LightDensity, Shot, texture_set};

use super::garden::Garden;
use crate::rooms::{trace_batch, trace_reused_batch};
use crate::statistics::{BATCHES, Pairs, agree};
use crate::support;
use crate::support::plant::planted;

const SIZE: UVec2 = UVec2::new(24, 18);
const LAYERS: u32 = 4;

/// Radiance of all samples of a batch, and how many rays they took, by the kernel.
fn by_kernel(engine: &mut Engine, params: &TraceParams, reuse: Reuse) -> Vec<(DVec3, u32)> {
    engine.edit(|world| {
        let device = &mut world.resource_mut::<Device>().0;
        match reuse {
            Reuse::Off => trace_batch(device, params),
            Reuse::Tiles => trace_reused_batch(device, params, true),
        }
        let samples: Vec<RadianceSample> = device.read_some("radiance", (SIZE.x * SIZE.y * LAYERS) as usize).unwrap();
        assert!(samples.iter().all(|sample| sample.info & SAMPLE_BAD == 0), "a bad sample");
        samples.iter().map(|sample| (sample.rgb.as_dvec3(), sample.info)).collect()
    })
}

/// The same by the twin, on what the engine has extracted.
fn by_twin(engine: &Engine, description: &SceneDescription, params: &TraceParams) -> Vec<(DVec3, u32)> {
    engine.read(|world| {
        let triangles = world.resource::<GpuTable<Triangle>>().rows();
        let mut scene = PathScene::new(triangles, world.resource::<GpuTable<MaterialRecord>>().rows());
        scene.shading = world.resource::<GpuTable<Shading>>().rows();
        scene.sampler = match description.render.sampler {
            Sampler::Pcg => Source::Pcg,
            Sampler::Sobol => Source::Sobol,
        };
        let density = world.resource::<LightDensity>().0;
        let lights = world.resource::<GpuTable<LightRecord>>().rows().to_vec();
        scene.lights = (description.render.integrator == Integrator::Path).then_some(LightTable { lights, density });
        scene.textures = texture_set(world);
        if description.render.reuse == Reuse::Tiles {
            return by_blocks(&scene, params);
        }
        let samples =
            (0..LAYERS).flat_map(|layer| (0..SIZE.y).flat_map(move |y| (0..SIZE.x).map(move |x| (layer, x, y))));
        samples
            .map(|(layer, x, y)| {
                let traced = scene.sample(params, UVec2::new(x, y), params.first_sample + layer);
                (traced.radiance, traced.rays)
            })
            .collect()
    })
}

/// The same of paths that are reused within tiles.
fn by_blocks(scene: &PathScene, params: &TraceParams) -> Vec<(DVec3, u32)> {
    let mut all = vec![(DVec3::ZERO, 0); (SIZE.x * SIZE.y * LAYERS) as usize];
    let firsts = || {
        (0..SIZE.y).flat_map(|y| (0..SIZE.x).map(move |x| UVec2::new(x, y))).filter(|p| p % TILE_BLOCK == UVec2::ZERO)
    };
    for (layer, first) in (0..LAYERS).flat_map(|layer| firsts().map(move |first| (layer, first))) {
        for (pixel, traced) in scene.sample_block(params, first, params.first_sample + layer) {
            all[((layer * SIZE.y + pixel.y) * SIZE.x + pixel.x) as usize] = (traced.radiance, traced.rays);
        }
    }
    all
}

/// Whether both agree in the means of thirds of the picture, and how many samples are alike.
fn compare(description: &SceneDescription, library: Library) -> Result<f64, String> {
    let mut engine = Engine::open(support::gpu(), library, description).unwrap();
    engine.step(Duration::ZERO).unwrap();
    let shot = engine.read(|world| world.resource::<Shot>().params);
    let (mut alike, mut all) = (0.0, 0.0);
    let mut sums: Vec<[[DVec3; 3]; 2]> = Vec::new();
    for batch in 0..BATCHES as u32 {
        let params = TraceParams { first_sample: batch * LAYERS, layers: LAYERS, ..shot };
        let (ours, right) =
            (by_kernel(&mut engine, &params, description.render.reuse), by_twin(&engine, description, &params));
        let close = |a: DVec3, b: DVec3| (a - b).abs().max_element() <= 1e-3 * (1.0 + b.max_element());
        alike += ours.iter().zip(&right).filter(|(a, b)| close(a.0, b.0) && a.1 == b.1).count() as f64;
        all += ours.len() as f64;
        sums.push([thirds(&ours), thirds(&right)]);
    }
    for third in 0..3 {
        for channel in 0..3 {
            let pairs = Pairs {
                differences: std::array::from_fn(|i| (sums[i][0][third] - sums[i][1][third])[channel]),
                mean: sums.iter().map(|pair| pair[1][third][channel]).sum::<f64>() / BATCHES as f64,
            };
            agree(&pairs).map_err(|why| format!("third {third}, channel {channel}: {why}"))?;
        }
    }
    Ok(alike / all)
}

/// Means over the upper, middle and lower third of the picture.
fn thirds(samples: &[(DVec3, u32)]) -> [DVec3; 3] {
    let rows = SIZE.y as usize / 3;
    let width = SIZE.x as usize;
    let mut sums = [DVec3::ZERO; 3];
    for (i, (radiance, _)) in samples.iter().enumerate() {
        sums[(i / width % SIZE.y as usize) / rows] += *radiance;
    }
    sums.map(|sum| sum * (3.0 / samples.len() as f64))
}

#[test]
fn equals_the_f64_twin() {
    for (integrator, sampler, filter, reuse) in [
        (Integrator::Path, Sampler::Sobol, TextureFilter::Footprint, Reuse::Off),
        (Integrator::Bsdf, Sampler::Pcg, TextureFilter::Exact, Reuse::Off),
        (Integrator::Path, Sampler::Sobol, TextureFilter::Footprint, Reuse::Tiles),
    ] {
        let mut description = Garden::full(SIZE).description;
        description.render.roulette = false;
        description.render.integrator = integrator;
        description.render.sampler = sampler;
        description.render.texture_filter = filter;
        description.render.reuse = reuse;
        let alike = compare(&description, Library::shipped()).unwrap_or_else(|why| panic!("{integrator:?}: {why}"));
        // Where a number lies between two texels within rounding, a path may take the other; then all pixels of its tile do.
        let least = if reuse == Reuse::Tiles { 0.9 } else { 0.99 };
        assert!(alike > least, "{integrator:?}, {filter:?}, {reuse:?}: {alike} of the samples are alike");
    }
}

#[test]
fn a_small_error_is_seen() {
    for (module, right, wrong) in [
        ("lib/texture", "* vec2<f32>(size) - 0.5;", "* vec2<f32>(size);"),
        ("lib/texture", "point.width + t.density", "point.width + t.density + 1.0"),
        ("passes/trace/textures", "if ((t.format & TEXTURE_SRGB) != 0u) {", "if (t.format == 77777u) {"),
        ("passes/trace/cutout", "u.y < coverage", "u.y < 0.5 * coverage"),
        ("passes/trace/relief", "-t.gain * texel.xy", "t.gain * texel.xy"),
        ("passes/trace/emission", "emission * emission_part", "1.02 * emission * emission_part"),
        ("passes/trace/textured", "part * part", "part"),
    ] {
        let mut description = Garden::full(SIZE).description;
        description.render.roulette = false;
        let found = compare(&description, planted(module, right, wrong));
        assert!(found.as_ref().map_or(true, |alike| *alike < 0.985), "{wrong} in {module} went unnoticed: {found:?}");
    }
}
