//! The path kernel against its f64 twin, and in rooms whose answer is known.

use std::collections::BTreeSet;

use glam::{DVec3, UVec2, Vec3};
use lucerna::cpu::rng::Source;
use lucerna::gpu::Runtime;
use lucerna::layout::trace::{NO_MATERIAL, RadianceSample, SAMPLE_BAD, TraceParams};
use lucerna::passes::trace::{Needs, View};
use lucerna::shader::Library;

use crate::rooms::{Room, matte, shiny, trace_batch};
use crate::statistics::{BATCHES, Pairs, agree};
use crate::support;

/// Pixels of a side of a block whose mean is compared.
const BLOCK: u32 = 8;

#[test]
fn a_scene_can_ask_for_every_feature_that_the_kernel_names() {
    let mut room = Room { roulette: true, next_event: true, sampler: Source::Sobol, ..Room::glass() };
    room.material(shiny(Vec3::ZERO, Vec3::ONE, 1.0));
    let library = Library::embedded();
    let named = library.link("passes/trace/path", &library.features().unwrap()).unwrap().features;
    let mut asked: BTreeSet<&str> = room.features().into_iter().collect();
    // A picture of the sky, asked directly or not.
    for sky_light in [false, true] {
        asked.extend(Needs { sky: true, sky_light, ..Needs::default() }.features());
    }
    // Of the device, not of the scene.
    asked.insert("software");
    assert_eq!(Vec::from_iter(asked), Vec::from_iter(named));
}

/// The samples of a batch: layer by layer, pixel by pixel.
pub fn samples(rig: &mut Runtime, params: &TraceParams) -> Vec<RadianceSample> {
    trace_batch(rig, params);
    let count = params.window_width * params.window_height * params.layers;
    rig.read_some("radiance", count as usize).unwrap()
}

/// Sums over the blocks of a batch, block by block: radiance and rays.
fn block_sums(params: &TraceParams, of: impl Fn(u32, UVec2) -> (DVec3, u32)) -> Vec<(DVec3, u64)> {
    let columns = params.window_width.div_ceil(BLOCK);
    let mut sums = vec![(DVec3::ZERO, 0); (columns * params.window_height.div_ceil(BLOCK)) as usize];
    for layer in 0..params.layers {
        for y in 0..params.window_height {
            for x in 0..params.window_width {
                let (radiance, rays) = of(layer, UVec2::new(x, y));
                let sum = &mut sums[(y / BLOCK * columns + x / BLOCK) as usize];
                *sum = (sum.0 + radiance, sum.1 + u64::from(rays));
            }
        }
    }
    sums
}

fn gpu_sums(rig: &mut Runtime, params: &TraceParams) -> Vec<(DVec3, u64)> {
    let got = samples(rig, params);
    block_sums(params, |layer, p| {
        let sample = got[((layer * params.window_height + p.y) * params.window_width + p.x) as usize];
        assert_eq!(sample.info & SAMPLE_BAD, 0, "a bad sample at {p}, layer {layer}: {sample:?}");
        (sample.rgb.as_dvec3(), sample.info)
    })
}

/// Whether two estimators agree in every block and channel; each gives block sums of batch `i`, the second is right.
fn compare(
    mut ours: impl FnMut(usize) -> Vec<(DVec3, u64)>,
    mut right: impl FnMut(usize) -> Vec<(DVec3, u64)>,
) -> Result<(), String> {
    let batches: Vec<_> = (0..BATCHES).map(|i| (ours(i), right(i))).collect();
    for block in 0..batches[0].0.len() {
        for c in 0..3 {
            let pairs = Pairs {
                differences: std::array::from_fn(|i| batches[i].0[block].0[c] - batches[i].1[block].0[c]),
                mean: batches.iter().map(|(_, right)| right[block].0[c]).sum::<f64>() / BATCHES as f64,
            };
            agree(&pairs).map_err(|why| format!("block {block}, channel {c}: {why}"))?;
        }
    }
    Ok(())
}

/// Batch `i` of equally large ones.
fn batch(params: &TraceParams, i: usize) -> TraceParams {
    TraceParams { first_sample: i as u32 * params.layers, ..*params }
}

pub fn against_twin(room: &Room, library: Library, params: &TraceParams) -> Result<(), String> {
    let mut rig = Runtime::new(support::gpu(), library);
    room.load(&mut rig);
    let twin = room.twin();
    compare(
        |i| gpu_sums(&mut rig, &batch(params, i)),
        |i| {
            let params = batch(params, i);
            block_sums(&params, |layer, p| {
                let traced = twin.sample(&params, p, params.first_sample + layer);
                (traced.radiance, traced.rays)
            })
        },
    )
}

/// 24 x 24 pixels and 4 samples a batch: 128 samples a pixel in all.
pub fn small(room: &Room) -> TraceParams {
    TraceParams { layers: 4, ..room.params(UVec2::splat(24)) }
}

#[test]
fn equals_the_f64_twin() {
    for (roulette, sampler, next_event) in [
        (false, Source::Pcg, false),
        (true, Source::Sobol, false),
        (false, Source::Pcg, true),
        (true, Source::Sobol, true),
    ] {
        let room = Room { roulette, sampler, next_event, ..Room::cornell() };
        against_twin(&room, Library::shipped(), &small(&room))
            .unwrap_or_else(|why| panic!("roulette {roulette}, {sampler:?}, lights asked {next_event}: {why}"));
    }
}

/// A room whose light is large enough to be found by chance.
fn plain_room() -> Room {
    let mut room = Room::default();
    let white = room.material(matte(Vec3::splat(0.73), Vec3::ZERO));
    let red = room.material(matte(Vec3::new(0.63, 0.06, 0.05), Vec3::ZERO));
    let block = room.material(shiny(Vec3::splat(0.4), Vec3::splat(0.5), 33.0));
    let light = room.material(matte(Vec3::ZERO, Vec3::new(4.0, 3.0, 2.0)));
    room.walls([Some(red), Some(white), Some(white), Some(white), Some(block), None]);
    room.quad(Vec3::new(-0.8, 0.9, -0.8), 1.6 * Vec3::X, 1.6 * Vec3::Z, light);
    room.quad(Vec3::new(-0.5, -0.4, -0.5), Vec3::new(0.8, 0.1, 0.2), Vec3::new(-0.1, 0.1, 0.9), block);
    room
}

#[test]
fn asking_lights_changes_no_mean() {
    let room = plain_room();
    // 330,000 paths: the standard error stays below 0.3 %.
    let params = TraceParams { layers: 160, ..room.params(UVec2::splat(8)) };
    let mut found = support::rig();
    room.load(&mut found);
    let asking = Room { next_event: true, ..plain_room() };
    let asking_params = TraceParams { layers: 160, ..asking.params(UVec2::splat(8)) };
    let mut agree = |library: Library| {
        let mut asked = Runtime::new(support::gpu(), library);
        asking.load(&mut asked);
        compare(
            |i| gpu_sums(&mut asked, &TraceParams { seed: 2, ..batch(&asking_params, i) }),
            |i| gpu_sums(&mut found, &batch(&params, i)),
        )
    };
    agree(Library::shipped()).unwrap();
    // Two independent estimates of a quarter of a percent each, 6.4 errors apart; one percent is seen against the twin, which draws
    // the same numbers.
    let text = std::fs::read_to_string("shaders/lib/light.wgsl").unwrap();
    let (right, wrong) = ("return 1.0 / (1.0 + ratio * ratio);", "return 1.03 / (1.0 + ratio * ratio);");
    assert!(text.contains(right), "lib/light has changed: plant the error elsewhere");
    assert!(
        agree(Library::shipped().with("lib/light", &text.replace(right, wrong))).is_err(),
        "{wrong} went unnoticed"
    );
}

#[test]
fn samplers_agree() {
    let room = Room { roulette: true, next_event: true, ..plain_room() };
    let params = TraceParams { layers: 160, ..room.params(UVec2::splat(8)) };
    let mut pcg = support::rig();
    room.load(&mut pcg);
    let mut sobol = support::rig();
    let room = Room { sampler: Source::Sobol, ..room };
    room.load(&mut sobol);
    compare(
        |i| gpu_sums(&mut sobol, &batch(&params, i)),
        |i| gpu_sums(&mut pcg, &TraceParams { seed: 2, ..batch(&params, i) }),
    )
    .unwrap();
}

#[test]
fn an_error_of_one_percent_is_seen() {
    let found = Room::cornell();
    let asked = Room { next_event: true, ..Room::cornell() };
    for (room, module, right, wrong) in [
        (&found, "lib/bsdf/mixture", "at.value / at.pdf", "1.01 * at.value / at.pdf"),
        (&found, "lib/light", "select(material.emission,", "select(0.99 * material.emission,"),
        (&found, "lib/bsdf/phong", "0.5 * INV_PI * (n + 1.0)", "0.505 * INV_PI * (n + 1.0)"),
        (&asked, "lib/light", "return 1.0 / (1.0 + ratio * ratio);", "return 1.01 / (1.0 + ratio * ratio);"),
        (&asked, "passes/trace/connect", "return area_pdf * (t * t", "return 1.02 * area_pdf * (t * t"),
        (&asked, "lib/bsdf/lambert", "return kd * (INV_PI", "return kd * (1.01 * INV_PI"),
    ] {
        let text = std::fs::read_to_string(format!("shaders/{module}.wgsl")).unwrap();
        assert!(text.contains(right), "{module} has changed: plant the error elsewhere");
        let library = Library::shipped().with(module, &text.replace(right, wrong));
        assert!(against_twin(room, library, &small(room)).is_err(), "{wrong} in {module} went unnoticed");
    }
}

#[test]
fn a_single_material_needs_no_other_features() {
    // Without `glossy`, `emitters` and `normals` the kernel is another module; the environment alone gives light.
    let mut room = Room { environment: Vec3::new(1.0, 2.0, 0.5), ..Room::default() };
    let grey = room.material(matte(Vec3::new(0.5, 0.7, 0.2), Vec3::ZERO));
    room.walls([Some(grey), Some(grey), Some(grey), Some(grey), Some(grey), None]);
    assert_eq!(room.features(), ["environment"]);
    against_twin(&room, Library::shipped(), &small(&room)).unwrap();
}

#[test]
fn roulette_changes_no_mean() {
    let mut room = Room { environment: Vec3::splat(1.0), ..Room::default() };
    let grey = room.material(matte(Vec3::new(0.8, 0.5, 0.2), Vec3::splat(0.5)));
    let glossy = room.material(shiny(Vec3::splat(0.3), Vec3::splat(0.5), 20.0));
    room.walls([Some(grey), Some(glossy), Some(grey), Some(grey), Some(grey), None]);
    // 16 x 16 pixels, 16 samples a batch, so 32,768 paths a block: the standard error stays below 0.3 %.
    let params = TraceParams { layers: 16, max_depth: 16, ..room.params(UVec2::splat(16)) };
    let mut rig = support::rig();
    room.load(&mut rig);
    let mut with = support::rig();
    let room = Room { roulette: true, ..room };
    room.load(&mut with);
    let (mut fewer, mut all) = (0, 0);
    compare(
        |i| {
            let sums = gpu_sums(&mut with, &batch(&params, i));
            fewer += sums.iter().map(|s| s.1).sum::<u64>();
            sums
        },
        |i| {
            let sums = gpu_sums(&mut rig, &batch(&params, i));
            all += sums.iter().map(|s| s.1).sum::<u64>();
            sums
        },
    )
    .unwrap();
    assert!(fewer < all, "roulette ended no path");
}

/// A closed box of one material: the inside of every ray.
fn furnace(albedo: f32, emission: f32) -> Room {
    let mut room = Room::default();
    let wall = room.material(matte(Vec3::splat(albedo), Vec3::splat(emission)));
    room.walls([Some(wall); 6]);
    room
}

pub fn inside(room: &Room, size: UVec2, max_depth: u32) -> TraceParams {
    TraceParams { position: Vec3::new(0.2, -0.3, 0.1), max_depth, ..room.params(size) }
}

#[test]
fn closed_furnace_has_no_variance() {
    for (albedo, depth) in [(0.5, 1), (0.5, 2), (0.7, 8), (0.9, 16), (1.0, 24), (0.99, 200)] {
        let room = furnace(albedo, 3.0);
        let mut rig = support::rig();
        room.load(&mut rig);
        let params = inside(&room, UVec2::splat(24), depth);
        let rho = f64::from(albedo);
        // Of `depth` segments each ends on a wall: a geometric series of as many terms.
        let right = 3.0 * (0..depth).map(|i| rho.powi(i as i32)).sum::<f64>();
        for sample in samples(&mut rig, &TraceParams { layers: 2, ..params }) {
            assert_eq!(sample.info, depth, "a path left the box");
            let off = (sample.rgb.as_dvec3() / right - 1.0).abs().max_element();
            assert!(off < 1e-5, "albedo {albedo}, depth {depth}: {} instead of {right}", sample.rgb);
        }
    }
}

#[test]
fn rays_are_counted_as_the_twin_counts_them() {
    let room = Room { roulette: true, ..Room::cornell() };
    let mut rig = support::rig();
    room.load(&mut rig);
    // Deep enough to show lavapipe's limit of loop iterations, were it ever crossed.
    let params = TraceParams { max_depth: 1024, layers: 4, ..room.params(UVec2::splat(24)) };
    let rays: u64 = gpu_sums(&mut rig, &params).iter().map(|s| s.1).sum();
    let twin = room.twin();
    let right: u64 = block_sums(&params, |layer, p| {
        let traced = twin.sample(&params, p, layer);
        (traced.radiance, traced.rays)
    })
    .iter()
    .map(|s| s.1)
    .sum();
    // Of these 2,304 paths a handful may part at an edge, by a few rays each.
    assert!(rays.abs_diff(right) <= right / 500, "{rays} rays, the twin {right}");

    let white = furnace(1.0, 1.0);
    white.load(&mut rig);
    let params = inside(&white, UVec2::splat(8), 1024);
    assert!(samples(&mut rig, &params).iter().all(|s| s.info == 1024), "a path of 1,024 segments was cut short");
}

#[test]
fn samples_do_not_depend_on_batch_or_crop() {
    let room = Room { roulette: true, ..Room::cornell() };
    let mut rig = support::rig();
    room.load(&mut rig);
    let params = TraceParams { layers: 6, ..room.params(UVec2::new(21, 13)) };
    let whole = samples(&mut rig, &params);
    let pixels = (params.window_width * params.window_height) as usize;
    assert!(whole == samples(&mut rig, &params), "the same seed gave other samples");
    assert!(whole != samples(&mut rig, &TraceParams { seed: 2, ..params }), "another seed gave the same samples");
    for (first, layers) in [(0u32, 1u32), (1, 2), (3, 3)] {
        let part = samples(&mut rig, &TraceParams { first_sample: first, layers, ..params });
        assert!(part == whole[first as usize * pixels..][..layers as usize * pixels], "a cut at {first}");
    }
    for (min, max) in [((0, 0), (1, 1)), ((5, 3), (16, 12)), ((20, 12), (21, 13))] {
        let (min, max) = (UVec2::from(min), UVec2::from(max));
        let mut cropped = params;
        cropped.crop(min, max);
        let size = max - min;
        for (i, sample) in samples(&mut rig, &cropped).into_iter().enumerate() {
            let i = i as u32;
            let (layer, x, y) = (i / (size.x * size.y), i % size.x, i / size.x % size.y);
            let at = (layer * params.window_height + y + min.y) * params.window_width + x + min.x;
            assert_eq!(sample, whole[at as usize], "crop {min} to {max}, pixel {x}, {y}, layer {layer}");
        }
    }
}

#[test]
fn every_size_is_traced_to_its_last_pixel() {
    let room = furnace(0.0, 2.0);
    let mut rig = support::rig();
    room.load(&mut rig);
    for (width, height) in [(1, 1), (3, 5), (7, 8), (8, 8), (9, 8), (8, 9), (17, 1)] {
        let params = TraceParams { layers: 3, ..inside(&room, UVec2::new(width, height), 4) };
        rig.upload("radiance", &vec![RadianceSample::default(); (width * height * 3) as usize]).unwrap();
        let right = RadianceSample { rgb: Vec3::splat(2.0), info: 1 };
        assert!(samples(&mut rig, &params).iter().all(|&s| s == right), "{width} x {height}");
    }
}

#[test]
fn few_triangles_make_a_picture() {
    for count in 0..4 {
        let mut room = Room { environment: Vec3::ONE, ..Room::default() };
        let grey = room.material(matte(Vec3::splat(0.5), Vec3::ZERO));
        for i in 0..count {
            let z = -0.1 * i as f32;
            room.triangle([Vec3::new(-1.0, -1.0, z), Vec3::new(1.0, -1.0, z), Vec3::new(0.0, 1.0, z)], grey);
        }
        let mut rig = support::rig();
        room.load(&mut rig);
        let got = samples(&mut rig, &room.params(UVec2::splat(9)));
        let [corner, centre] = [got[0], got[4 * 9 + 4]];
        assert_eq!(corner, RadianceSample { rgb: Vec3::ONE, info: 1 });
        let hit = if count == 0 { (1.0, 1) } else { (0.5, 2) };
        assert_eq!(centre, RadianceSample { rgb: Vec3::splat(hit.0), info: hit.1 });
    }
}

#[test]
fn one_sided_light_leaves_the_front_only() {
    for one_sided in [false, true] {
        for (facing, e, f) in [(true, Vec3::X, Vec3::Y), (false, Vec3::Y, Vec3::X)] {
            let mut room = Room::default();
            let mut record = matte(Vec3::ZERO, Vec3::ONE);
            record.flags = u32::from(one_sided);
            let light = room.material(record);
            room.quad(Vec3::new(-1.0, -1.0, 0.0), 2.0 * e, 2.0 * f, light);
            let mut rig = support::rig();
            room.load(&mut rig);
            let got = samples(&mut rig, &room.params(UVec2::ONE))[0].rgb.x;
            assert_eq!(got, if facing || !one_sided { 1.0 } else { 0.0 }, "facing {facing}, one-sided {one_sided}");
        }
    }
}

#[test]
fn bad_samples_say_where_they_went_wrong() {
    // A wall that emits NaN, seen directly or after a bounce off the others.
    for (value, kind) in [(f32::NAN, 1), (f32::INFINITY, 2), (-100.0, 3), (1e38, 4)] {
        let mut room = furnace(0.5, 1.0);
        let broken = room.material(matte(Vec3::ZERO, Vec3::splat(value)));
        room.triangles[8].material = broken;
        room.triangles[9].material = broken;
        let mut rig = support::rig();
        room.load(&mut rig);
        let size = UVec2::splat(16);
        let mut params = TraceParams { layers: 2, ..inside(&room, size, 3) };
        // Into the edge of the broken wall and a good one.
        let edge = DVec3::new(1.0, 0.0, -1.0);
        params.aim(&View { position: DVec3::ZERO, look_at: edge, up: DVec3::Y, fov_y: 42.0 }, size, DVec3::ZERO);
        params.fit_film(40);
        let mut by_bounce = [0; 3];
        for sample in samples(&mut rig, &params) {
            if sample.info & SAMPLE_BAD == 0 {
                assert!(sample.rgb.is_finite() && sample.rgb.min_element() >= 0.0);
                continue;
            }
            let [got, bounce, material] = sample.rgb.to_array().map(|v| v as u32);
            assert_eq!((got, material), (kind, broken));
            assert_eq!(sample.info & !SAMPLE_BAD, bounce + 1, "rays up to the one that went wrong");
            by_bounce[bounce as usize] += 1;
        }
        assert!(by_bounce.iter().all(|&n| n > 0), "{by_bounce:?} of kind {kind}");
    }
    // The environment is no material.
    let room = Room { environment: Vec3::splat(1e30), ..Room::default() };
    let mut rig = support::rig();
    room.load(&mut rig);
    let mut params = room.params(UVec2::ONE);
    params.fit_film(40);
    let sample = samples(&mut rig, &params)[0];
    assert_eq!(sample, RadianceSample { rgb: Vec3::new(4.0, 0.0, NO_MATERIAL as f32), info: 1 | SAMPLE_BAD });
}

#[test]
fn dim_light_is_no_overflow() {
    // The throughput of 1 is far above all radiance that such a film holds.
    let room = furnace(0.5, 1e-12);
    let mut rig = support::rig();
    room.load(&mut rig);
    let sample = samples(&mut rig, &inside(&room, UVec2::ONE, 2))[0];
    assert!(sample.info == 2 && (sample.rgb.x / 1.5e-12 - 1.0).abs() < 1e-5, "{sample:?}");
}

#[test]
fn a_broken_bsdf_is_reported_at_its_material() {
    let room = furnace(0.5, 1.0);
    let text = std::fs::read_to_string("shaders/lib/bsdf/mixture.wgsl").unwrap();
    // A NaN that is no constant, since that would be refused.
    let nan = "vec3<f32>(bitcast<f32>(0x7fc00000u + m.flags)), true";
    let broken = text.replace("m.kd, at.pdf > 0.0", nan);
    assert_ne!(text, broken);
    let mut rig = Runtime::new(support::gpu(), Library::shipped().with("lib/bsdf/mixture", &broken));
    room.load(&mut rig);
    for sample in samples(&mut rig, &inside(&room, UVec2::splat(4), 4)) {
        assert_eq!(sample, RadianceSample { rgb: Vec3::new(1.0, 0.0, 0.0), info: 1 | SAMPLE_BAD });
    }
}
