//! The f64 path tracer against what is known by other means: series, quadrature, form factors, itself without asking
//! lights, and the engine.

use std::f64::consts::{PI, TAU};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{DVec3, UVec2, Vec3};
use lucerna::Engine;
use lucerna::components::{Energy, Environment, Integrator, Material, Render, Sampler, Transform};
use lucerna::cpu::oracle::bsdf::{Bsdf, Facing};
use lucerna::cpu::oracle::{Oracle, Picture, Random};
use lucerna::scene::generate::to_mesh;
use lucerna::scene::{self, MeshEntry, SceneDescription};
use lucerna::shader::Library;

use crate::statistics::{BATCHES, Pairs, agree};
use crate::support;
use crate::support::stage::{Stage, glowing, matte, quad, sky_map};

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

/// Samples of a pixel and batch, with lights asked and without: as many as 0.3 % take.
type Samples = (u32, u32);

/// Means of batches, with lights asked and without.
struct Both {
    asked: Vec<[DVec3; 2]>,
    unasked: Vec<[DVec3; 2]>,
}

impl Both {
    fn trace(stage: &mut Stage, (asked, unasked): Samples) -> Self {
        let (with, mut without) = (stage.oracle(), stage.oracle());
        without.ask_lights = false;
        let of = |picture: Picture| halves(picture.size.x, &picture.mean);
        Self {
            asked: (0..BATCHES).map(|i| of(batch(&with, i, asked, 1))).collect(),
            unasked: (0..BATCHES).map(|i| of(batch(&without, i, unasked, 2))).collect(),
        }
    }

    /// Whether asking changes the mean, once what it found has been scaled by `planted`.
    fn agree(&self, planted: f64) -> Result<(), String> {
        compare(|i| self.asked[i].map(|v| planted * v), |i| self.unasked[i])
    }
}

const SMALL: UVec2 = UVec2::new(16, 8);

fn shiny() -> Material {
    Material { kd: Vec3::splat(0.4), ks: Vec3::splat(0.4), ns: 20.0, ..Material::default() }
}

fn rough() -> Material {
    let (kd, ks) = (Vec3::new(0.5, 0.4, 0.2), Vec3::splat(0.3));
    Material { kd, ks, roughness: Some(0.6), metallic: 0.5, ..Material::default() }
}

fn mirror() -> Material {
    Material { kd: Vec3::splat(0.1), ks: Vec3::splat(0.8), illum: 3, ..Material::default() }
}

fn glass() -> Material {
    Material { illum: 4, ni: 1.5, tf: Vec3::new(0.9, 1.0, 0.8), ..Material::default() }
}

fn veil() -> Material {
    Material { kd: Vec3::new(0.7, 0.5, 0.3), dissolve: 0.4, tf: Vec3::new(1.0, 0.8, 0.9), ..Material::default() }
}

#[test]
fn asking_lights_changes_no_mean() {
    let rooms: [(&str, [Material; 2], Option<Environment>, Samples); 3] = [
        ("shiny and rough", [shiny(), rough()], None, (450, 1000)),
        ("mirror and glass", [mirror(), glass()], Some(Environment::Constant(Vec3::new(0.3, 0.4, 0.5))), (128, 700)),
        ("veil and rough", [veil(), rough()], Some(sky_map()), (128, 700)),
    ];
    for (name, balls, sky, samples) in rooms {
        let mut stage = Stage::room(SMALL, balls);
        stage.sky(sky.unwrap_or(Environment::Constant(Vec3::ZERO)));
        let both = Both::trace(&mut stage, samples);
        both.agree(1.0).unwrap_or_else(|why| panic!("{name}: {why}"));
        // Six comparisons of at most 0.3 % each: 6.4 errors are 1.9 %.
        assert!(both.agree(1.025).is_err_and(|why| why.contains("differ")), "{name}: a planted error went unnoticed");
    }
}

#[test]
fn a_sky_alone_lights_a_floor() {
    let mut stage = Stage::new(SMALL, 3, DVec3::new(0.0, 1.0, 3.0), DVec3::ZERO);
    stage.part(&quad(Vec3::new(-2.0, 0.0, 2.0), Vec3::X * 4.0, Vec3::Z * -4.0), shiny());
    stage.sky(sky_map());
    Both::trace(&mut stage, (240, 480)).agree(1.0).unwrap();
}

/// A closed box of one grey, seen from inside.
fn furnace(albedo: f32, max_depth: u32) -> Oracle {
    let mut stage = Stage::new(UVec2::splat(6), max_depth, DVec3::new(0.2, -0.3, 0.1), DVec3::new(1.0, 0.5, 0.3));
    let wall = Material { emission: Vec3::splat(3.0), ..matte(Vec3::splat(albedo)) };
    stage.walls([(); 6].map(|_| Some(wall.clone())));
    stage.oracle()
}

#[test]
fn closed_furnace_is_a_geometric_series() {
    for (albedo, depth) in [(0.5, 1), (0.5, 2), (0.75, 8), (1.0, 24), (0.9, 200)] {
        let mut oracle = furnace(albedo, depth);
        let right: f64 = (0..depth).map(|i| 3.0 * f64::from(albedo).powi(i as i32)).sum();
        oracle.ask_lights = false;
        for pixel in batch(&oracle, 0, 2, 1).mean {
            assert!((pixel / right - 1.0).abs().max_element() < 1e-9, "albedo {albedo}, depth {depth}: {pixel}");
        }
        oracle.ask_lights = true;
        let means: Vec<f64> = (0..BATCHES).map(|i| batch(&oracle, i, 8, 1).mean.iter().map(|p| p.x).sum()).collect();
        let differences = std::array::from_fn(|i| means[i] / 36.0 - right);
        agree(&Pairs { differences, mean: right })
            .unwrap_or_else(|why| panic!("albedo {albedo}, depth {depth}: {why}"));
    }
}

/// A surface in the plane z = 0, seen from above at an angle from its normal.
fn seen_at(degrees: f64) -> Facing {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Facing { wo: DVec3::new(sin, 0.0, cos), shading: DVec3::Z, geometric: DVec3::Z, from_behind: false }
}

/// Integrals over the hemisphere of f cos and of the pdf, by the midpoint rule in polar coordinates about the mirror
/// direction, where lobes are narrow: the angle grows by its square.
fn quadrature(bsdf: &Bsdf, facing: &Facing) -> (DVec3, f64) {
    const STEPS: u32 = 600;
    let axis = 2.0 * facing.wo.z * DVec3::Z - facing.wo;
    let (s, t) = axis.any_orthonormal_pair();
    let (mut albedo, mut density) = (DVec3::ZERO, 0.0);
    // Half by half, for at 90 degrees from its axis a lobe may end.
    for i in 0..2 * STEPS {
        let root = (f64::from(i % STEPS) + 0.5) / f64::from(STEPS);
        let angle = 0.5 * PI * (root * root + f64::from(i / STEPS));
        let weight = angle.sin() * PI * root / f64::from(STEPS) * TAU / f64::from(STEPS);
        for j in 0..STEPS {
            let turn = TAU * (f64::from(j) + 0.5) / f64::from(STEPS);
            let wi = angle.sin() * (turn.cos() * s + turn.sin() * t) + angle.cos() * axis;
            let (value, pdf) = bsdf.evaluate(facing, wi);
            (albedo, density) = (albedo + weight * value, density + weight * pdf);
        }
    }
    (albedo, density)
}

/// Mean weight of draws that are no single direction, and how often one was drawn.
fn drawn(bsdf: &Bsdf, facing: &Facing, draws: u32, seed: u64) -> (DVec3, DVec3, f64) {
    let (mut sum, mut squares, mut hits) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    let n = f64::from(draws);
    for i in 0..draws {
        let draw = bsdf.draw(facing, &mut Random::new([seed, 0, u64::from(i)]));
        if let Some(draw) = draw.filter(|draw| draw.pdf > 0.0) {
            (sum, squares, hits) = (sum + draw.weight, squares + draw.weight * draw.weight, hits + 1.0);
        }
    }
    let mean = sum / n;
    (mean, ((squares / n - mean * mean).max(DVec3::ZERO) / n).map(f64::sqrt), hits / n)
}

#[test]
fn draws_carry_what_quadrature_says() {
    let plain = |ks: f32, ns: f32| Material { kd: Vec3::splat(0.3), ks: Vec3::splat(ks), ns, ..Material::default() };
    let ggx = |pr: f32| Material { roughness: Some(pr), ..plain(0.7, 1.0) };
    let surfaces = [
        plain(0.0, 1.0),
        plain(0.5, 0.0),
        plain(0.7, 30.0),
        plain(0.7, 1000.0),
        ggx(1.0),
        ggx(0.5),
        ggx(0.2),
        rough(),
        veil(),
    ];
    for (case, material) in surfaces.iter().enumerate() {
        let bsdf = Bsdf::new(material, Energy::Preserve);
        for degrees in [0.0, 40.0, 80.0] {
            let facing = seen_at(degrees);
            let (albedo, density) = quadrature(&bsdf, &facing);
            let (mean, error, hits) = drawn(&bsdf, &facing, 40_000, case as u64);
            // 27 cases of 3 channels, and as many rates: 5 standard errors are passed by chance with 1e-4. What the
            // quadrature leaves is below 1e-4 where the horizon cuts a lobe.
            let off = (mean - albedo).abs() - 5.0 * error;
            assert!(off.max_element() < 2e-4, "case {case} at {degrees}: {mean} drawn, {albedo} by quadrature");
            let rate_error = 5.0 * (hits * (1.0 - hits) / 40_000.0).sqrt();
            assert!((hits - density).abs() < rate_error + 2e-4, "case {case} at {degrees}: {hits} drawn, {density}");
        }
    }
}

/// Fresnel's reflectance by the sines and tangents of the angles (Born and Wolf, section 1.5.2).
fn reflectance(index: f64, angle: f64) -> f64 {
    let beyond = (angle.sin() / index).asin();
    let (less, more) = (angle - beyond, angle + beyond);
    0.5 * ((less.sin() / more.sin()).powi(2) + (less.tan() / more.tan()).powi(2))
}

#[test]
fn glass_reflects_and_refracts_by_the_laws() {
    let bsdf = Bsdf::new(&glass(), Energy::Preserve);
    for (degrees, from_behind) in
        [(20.0, false), (56.3, false), (85.0, false), (20.0, true), (40.0, true), (60.0, true)]
    {
        let facing = Facing { from_behind, ..seen_at(degrees) };
        let index: f64 = if from_behind { 1.0 / 1.5 } else { 1.5 };
        let sin = f64::to_radians(degrees).sin();
        let right = if sin < index { reflectance(index, f64::to_radians(degrees)) } else { 1.0 };
        let (mut reflected, draws) = (0.0, 40_000);
        for i in 0..draws {
            let draw = bsdf.draw(&facing, &mut Random::new([3, 0, i])).unwrap();
            assert!(draw.pdf == 0.0 && (draw.wi.length() - 1.0).abs() < 1e-12);
            if draw.wi.z > 0.0 {
                reflected += 1.0;
                assert_eq!((draw.wi.x, draw.wi.z, draw.weight), (-facing.wo.x, facing.wo.z, DVec3::ONE));
            } else {
                assert!((draw.wi.x + sin / index).abs() < 1e-12, "Snell's law at {degrees}");
                let kept = glass().tf.as_dvec3() / (index * index);
                assert!((draw.weight - kept).abs().max_element() < 1e-12);
            }
        }
        let rate = reflected / draws as f64;
        let allowed = 5.0 * (right * (1.0 - right) / draws as f64).sqrt() + 1e-12;
        assert!((rate - right).abs() <= allowed, "{rate} reflected at {degrees}, not {right}");
    }
}

#[test]
fn a_shell_of_index_one_and_a_clear_veil_are_invisible() {
    for material in
        [Material { ni: 1.0, tf: Vec3::ONE, ..glass() }, Material { dissolve: 0.0, tf: Vec3::ONE, ..veil() }]
    {
        let picture = |ball: bool| {
            let mut stage = Stage::new(SMALL, 4, DVec3::Z * 3.0, DVec3::ZERO);
            stage.sky(sky_map());
            if ball {
                stage.ball(DVec3::ZERO, 0.9, material.clone());
            }
            stage.oracle().render(0..4, 1, 1, &|_, _| ())
        };
        let (with, without) = (picture(true), picture(false));
        let off = with.mean.iter().zip(&without.mean).map(|(a, b)| (*a - *b).abs().max_element()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{off}");
    }
}

#[test]
fn glass_gives_back_the_sky_around_it() {
    // In a sky of 1 a clear solid is as bright as the sky: what refraction takes on the way in it gives on the way out.
    let mut stage = Stage::new(SMALL, 200, DVec3::Z * 3.0, DVec3::ZERO);
    // A cube: on smooth normals some directions contradict the facets, and are lost.
    for (axis, outward) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0), (2, 1.0), (2, -1.0)] {
        let (e, f) = (Vec3::AXES[(axis + 1) % 3] * outward, Vec3::AXES[(axis + 2) % 3]);
        let corner = Vec3::AXES[axis] * outward - e - f;
        stage.part(&quad(0.6 * corner, 1.2 * e, 1.2 * f), Material { tf: Vec3::ONE, ..glass() });
    }
    stage.sky(Environment::Constant(Vec3::ONE));
    for pixel in stage.oracle().render(0..16, 1, 2, &|_, _| ()).mean {
        assert!((pixel - 1.0).abs().max_element() < 1e-9, "{pixel}");
    }
}

#[test]
fn a_small_light_gives_its_form_factor() {
    for side in [0.2f32, 2e-6] {
        // A square light above a parallel floor, and a camera that sees only the point below its middle.
        let mut stage = Stage::new(UVec2::splat(2), 2, DVec3::new(0.0, 0.5, 1.0), DVec3::ZERO);
        stage.fov_y(1e-3);
        stage.part(&quad(Vec3::new(-9.0, 0.0, 9.0), Vec3::X * 18.0, Vec3::Z * -18.0), matte(Vec3::splat(0.5)));
        let corner = Vec3::new(-0.5 * side, 1.0, -0.5 * side);
        stage.part(&quad(corner, Vec3::X * side, Vec3::Z * side), glowing(Vec3::splat(7.0)));
        let mean = stage.oracle().render(0..60_000, 1, 2, &|_, _| ()).mean.iter().sum::<DVec3>().x / 4.0;
        // From a point to a parallel square straight above (Siegel and Howell, configuration 11 of appendix C), four corners.
        let x = 0.5 * f64::from(side);
        let factor = 4.0 / TAU * 2.0 * x / (1.0 + x * x).sqrt() * (x / (1.0 + x * x).sqrt()).atan();
        let right = 0.5 * 7.0 * factor;
        assert!((mean / right - 1.0).abs() < 1e-3, "a side of {side}: {mean}, not {right}");
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let mut stage = Stage::room(SMALL, [glass(), rough()]);
    stage.sky(sky_map());
    let oracle = stage.oracle();
    let one = oracle.render(0..8, 5, 1, &|_, _| ());
    let rows = std::sync::Mutex::new(Vec::new());
    let two = oracle.render(0..8, 5, 2, &|done, all| rows.lock().unwrap().push((done, all)));
    assert_eq!(one, two);
    let mut rows = rows.into_inner().unwrap();
    rows.sort();
    assert_eq!(rows, (1..=8).map(|done| (done, 8)).collect::<Vec<_>>());
    assert_ne!(one, oracle.render(0..8, 6, 1, &|_, _| ()), "another seed");
}

#[test]
fn the_stated_error_is_that_of_the_mean() {
    let mut stage = Stage::room(SMALL, [shiny(), rough()]);
    stage.sky(sky_map());
    let oracle = stage.oracle();
    let batches: Vec<Picture> = (0..BATCHES).map(|i| batch(&oracle, i, 16, 1)).collect();
    let (mut stated, mut seen) = (0.0, 0.0);
    for pixel in 0..batches[0].mean.len() {
        let mean = batches.iter().map(|b| b.mean[pixel].y).sum::<f64>() / BATCHES as f64;
        seen += batches.iter().map(|b| (b.mean[pixel].y - mean).powi(2)).sum::<f64>() / (BATCHES as f64 - 1.0);
        stated += batches.iter().map(|b| b.error[pixel].y.powi(2)).sum::<f64>() / BATCHES as f64;
    }
    // 128 pixels of 32 batches: the ratio of both is known to a few percent.
    assert!((stated / seen - 1.0).abs() < 0.2, "variance {stated} stated, {seen} seen");
}

/// A scene of `assets/scenes` at a size that the oracle can bear.
fn shipped(name: &str, side: u32) -> SceneDescription {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/scenes/{name}.ron"));
    let size = format!("({side},{side})");
    let defines = [("film.size", size.as_str()), ("render.max_depth", "5")].map(|(k, v)| (k.to_owned(), v.to_owned()));
    scene::load(&path, &defines).unwrap_or_else(|e| panic!("{e:?}")).description
}

/// The Cornell box without its light, and a thousand small ones in a grid below its ceiling, in three colours.
fn thousand_lights(side: u32) -> SceneDescription {
    let mut description = shipped("cornell-box", side);
    description.materials.values_mut().for_each(|material| material.emission = Vec3::ZERO);
    for (colour, emission) in
        [Vec3::new(9.0, 2.0, 1.0), Vec3::new(1.0, 8.0, 2.0), Vec3::new(2.0, 3.0, 30.0)].into_iter().enumerate()
    {
        let triangles: Vec<[Vec3; 3]> = (0..1000)
            .filter(|i| i % 3 == colour)
            .map(|i| Vec3::new((i % 10) as f32, (i / 100) as f32, (i / 10 % 10) as f32) * Vec3::new(0.15, -0.04, 0.15))
            .map(|at| at + Vec3::new(-0.7, 0.9, -0.7))
            .map(|at| [at, at + 0.01 * Vec3::X, at + 0.01 * (Vec3::Z + 0.3 * Vec3::Y)])
            .collect();
        let name = format!("lamps:{colour}");
        description.materials.insert(name.clone(), Material { emission, ..matte(Vec3::splat(0.3)) });
        let geometry = Arc::new(to_mesh(&triangles));
        let mesh = MeshEntry { geometry, transform: Transform::default(), material: name };
        description.meshes.insert(format!("lamps/{colour}"), mesh);
    }
    description
}

/// Whether the engine and the oracle agree on a scene, `spp` samples of each a pixel and batch; and whether an error of 2.5 % in
/// the one is seen: 6.4 standard errors of 0.3 % are 1.9 %.
fn judge(name: &str, mut description: SceneDescription, integrator: Integrator, sampler: Sampler, spp: u32) {
    description.render = Render { integrator, sampler, spp, roulette: true, ..description.render };
    let width = description.film.size.x;
    let mut world = World::new();
    scene::apply(&mut world, &description);
    let oracle = Oracle::new(&mut world).unwrap();
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    let rights: Vec<_> = (0..BATCHES as u32)
        .map(|i| halves(width, &oracle.render(i * spp..(i + 1) * spp, 1, threads, &|_, _| ()).mean))
        .collect();
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    let films: Vec<_> = (0..BATCHES as u32)
        .map(|seed| {
            engine.edit(|world| world.query::<&mut Render>().iter_mut(world).for_each(|mut render| render.seed = seed));
            while !engine.step(Duration::from_millis(100)).unwrap().finished {}
            halves(width, &engine.film().unwrap().rgb.iter().map(|p| Vec3::from(*p).as_dvec3()).collect::<Vec<_>>())
        })
        .collect();
    compare(|i| films[i], |i| rights[i]).unwrap_or_else(|why| panic!("{name}, {integrator:?}, {sampler:?}: {why}"));
    let planted = compare(|i| films[i].map(|v| 0.975 * v), |i| rights[i]);
    assert!(planted.is_err_and(|why| why.contains("differ")), "{name}: a planted error went unnoticed");
}

#[test]
fn equals_the_engine() {
    judge("cornell-box", shipped("cornell-box", 16), Integrator::Path, Sampler::Sobol, 256);
    let mut under_sky = shipped("teapot", 12);
    under_sky.environment = Some(sky_map());
    judge("teapot under a sky", under_sky, Integrator::Path, Sampler::Sobol, 100);
    if !support::stress() {
        return;
    }
    // Each estimator on each kind of scene: on a GPU, and on more than two cores.
    for sampler in [Sampler::Sobol, Sampler::Pcg] {
        judge("teapot", shipped("teapot", 24), Integrator::Path, sampler, 256);
        judge("glass", shipped("glass", 24), Integrator::Path, sampler, 2048);
        judge("a thousand lights", thousand_lights(24), Integrator::Path, sampler, 6144);
        let mut under_sky = shipped("glass", 24);
        under_sky.environment = Some(sky_map());
        judge("glass under a sky", under_sky, Integrator::Path, sampler, 2048);
        judge("cornell-box", shipped("cornell-box", 24), Integrator::Bsdf, sampler, 1024);
        judge("teapot", shipped("teapot", 24), Integrator::Bsdf, sampler, 1024);
    }
}
