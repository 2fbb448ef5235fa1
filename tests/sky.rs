//! Directions drawn from a picture of the sky: by the real kernel code, against the f64 twin, their density and the picture.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3, UVec2, Vec3, Vec4};
use lucerna::cpu::rng::{sample_2d, sample_key};
use lucerna::cpu::sky::{draw_sky, sky_arriving, sky_cell};
use lucerna::gpu::Runtime;
use lucerna::layout::sky::SkyTable;
use lucerna::layout::trace::TraceParams;
use lucerna::passes::{Binding, Pass, Recording, Size};
use lucerna::prepare::lighting::Lighting;
use lucerna::scene::generate::SplitMix;
use lucerna::shader::Library;

use crate::path::{against_twin, samples, small};
use crate::rooms::{Room, matte, shiny};
use crate::statistics::{CHI_SQUARE_LIMIT, chi_square_z};
use crate::support;
use crate::support::plant::planted;

const PROBE: &str = "
import package::gen::{SampleKey, TraceParams};
import package::lib::rng::{sample_2d};
import package::passes::trace::connect::{draw_from_sky};
import package::passes::trace::sky::{draw_entry, sky_pdf, sky_radiance};

@group(0) @binding(0) var<storage, read> params: TraceParams;
@group(0) @binding(1) var<storage, read_write> probed: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> counts: array<atomic<u32>>;

// What a ray that leaves the scene in a direction takes its density to be.
fn found(direction: vec3<f32>) -> f32 {
    return sky_pdf(sky_radiance(params, direction), params.sky_density);
}

@compute @workgroup_size(64)
fn draw_keys_of_sky(@builtin(global_invocation_id) id: vec3<u32>) {
    let drawn = draw_from_sky(params, sample_2d(SampleKey(id.x, 0u, 0u, params.seed), 0u));
    probed[2u * id.x] = vec4<f32>(drawn.direction, drawn.pdf);
    probed[2u * id.x + 1u] = vec4<f32>(found(drawn.direction), drawn.radiance);
}

@compute @workgroup_size(64)
fn look_at_sky(@builtin(global_invocation_id) id: vec3<u32>) {
    probed[id.x].w = found(probed[id.x].xyz);
}

// The pixel of the first row that each uniform number is for: 256 numbers an invocation.
@compute @workgroup_size(64)
fn count_pixels(@builtin(global_invocation_id) id: vec3<u32>) {
    for (var i = 0u; i < 256u; i++) {
        let u = f32(id.x * 256u + i) * 0x1p-24;
        atomicAdd(&counts[draw_entry(params.sky_height, params.sky_width, u).index], 1u);
    }
}
";

macro_rules! probe {
    ($name:ident, $entry:literal, $($binding:expr),+) => {
        static $name: Pass = Pass {
            name: $entry,
            module: "tests/sky",
            entry: $entry,
            features: &[],
            bindings: &[Binding::params("TraceParams"), $($binding),+],
            makes: &[],
            twin: lucerna::passes::Twin::None("of a test"),
        };
    };
}
probe!(
    DRAW,
    "draw_keys_of_sky",
    Binding::write("probed", "array<vec4<f32>>"),
    Binding::read("sky", "array<vec4<f32>>"),
    Binding::read("sky_cdf", "array<CdfEntry>")
);
probe!(LOOK, "look_at_sky", Binding::write("probed", "array<vec4<f32>>"), Binding::read("sky", "array<vec4<f32>>"));
probe!(
    COUNT,
    "count_pixels",
    Binding::write("counts", "array<atomic<u32>>"),
    Binding::read("sky_cdf", "array<CdfEntry>")
);

fn params_of(sky: &SkyTable) -> TraceParams {
    let mut params = TraceParams { seed: 5, ..TraceParams::default() };
    Lighting { sky: sky.size, sky_power: sky.power, ..Lighting::default() }.write(&mut params, 1.0);
    params
}

/// A runtime with a sky that is asked directly, and the probes.
fn rig(library: Library, sky: &SkyTable) -> Runtime {
    let mut rig = Runtime::new(support::gpu(), library.with("tests/sky", PROBE));
    rig.set_features(&["sky_light"]);
    rig.upload("sky", &sky.cells).unwrap();
    rig.upload("sky_cdf", &sky.cdf).unwrap();
    rig
}

fn play(rig: &mut Runtime, pass: &'static Pass, sky: &SkyTable, items: u64) {
    let mut recording = Recording::default();
    recording.run(pass, Size::Items(items)).params(&params_of(sky));
    rig.play(&recording).unwrap();
}

/// A direction that the kernel draws, its density, and the density that finding it would have.
struct Draw {
    direction: DVec3,
    pdf: f64,
    found: f64,
}

/// A multiple of 64 draws.
fn draws(library: Library, sky: &SkyTable, count: usize) -> Vec<Draw> {
    let mut rig = rig(library, sky);
    rig.reserve("probed", 32 * count as u64).unwrap();
    play(&mut rig, &DRAW, sky, count as u64);
    let rows: Vec<Vec4> = rig.read_some("probed", 2 * count).unwrap();
    let draw = |row: &[Vec4]| Draw {
        direction: row[0].truncate().as_dvec3(),
        pdf: f64::from(row[0].w),
        found: f64::from(row[1].x),
    };
    rows.chunks_exact(2).map(draw).collect()
}

/// Pixels of any brightness, black ones and black rows among them, and a sun of one pixel that has half of all power.
fn uneven(size: UVec2) -> SkyTable {
    let mut random = SplitMix(u64::from(size.x) << 32 | u64::from(size.y));
    let mut pixels: Vec<Vec3> = (0..size.x * size.y)
        .map(|i| {
            let grey = random.unit() as f32;
            let dark = (i / size.x) % 4 == 2 || i % 7 == 3;
            Vec3::new(grey, 0.5 + 0.5 * grey, 1.0 - grey) * if dark { 0.0 } else { grey * grey * grey }
        })
        .collect();
    let sun = (size.y / 3 * size.x + size.x / 5) as usize;
    pixels[sun] = Vec3::ZERO;
    let rest = SkyTable::new(size, &pixels, Vec3::ONE).power;
    let grey = if rest > 0.0 { rest / solid_angle(size, size.y / 3) } else { 1.0 };
    pixels[sun] = Vec3::splat(grey as f32);
    SkyTable::new(size, &pixels, Vec3::splat(0.8))
}

fn solid_angle(size: UVec2, row: u32) -> f64 {
    let cos = |row: u32| (PI * f64::from(row) / f64::from(size.y)).cos();
    TAU / f64::from(size.x) * (cos(row) - cos(row + 1))
}

const SIZES: [UVec2; 7] = [
    UVec2::new(1, 1),
    UVec2::new(1, 5),
    UVec2::new(7, 1),
    UVec2::new(8, 4),
    UVec2::new(64, 32),
    UVec2::new(257, 129),
    UVec2::new(512, 256),
];

#[test]
fn draws_equal_the_f64_twin_and_what_a_hit_finds() {
    for size in SIZES {
        let sky = uneven(size);
        let count = 1 << 14;
        let (mut strays, mut parted) = (0, 0);
        for (i, got) in draws(Library::shipped(), &sky, count).iter().enumerate() {
            let right = draw_sky(&sky, sample_2d(sample_key(i as u32, 0, 5), 0));
            assert!((got.direction.length() - 1.0).abs() < 1e-6, "{size}, draw {i}: {}", got.direction);
            assert!(right.pdf > 0.0 && got.pdf > 0.0, "{size}, draw {i}: a black pixel was drawn");
            // What is left of a number is stretched over a pixel that is drawn seldom, and its rounding with it.
            if right.direction.distance(got.direction) > 1e-5 {
                strays += 1;
                continue;
            }
            assert!((got.pdf / right.pdf - 1.0).abs() < 1e-6, "{size}, draw {i}: pdf {} not {}", got.pdf, right.pdf);
            parted += usize::from(got.found != got.pdf);
        }
        // A number within rounding of a column's threshold is another pixel's; a direction at a pixel's edge may be found in the
        // next one. Both are as rare as 2^-22 of a turn is to a pixel.
        assert!(strays <= count / 500, "{size}: {strays} draws are not the twin's");
        assert!(parted <= count / 500, "{size}: {parted} directions are found with another density");
    }
}

#[test]
fn a_sky_too_dim_for_a_density_has_no_power() {
    for (grey, power) in [(1e-37, true), (1e-40, false), (0.0, false)] {
        let sky = SkyTable::new(UVec2::new(2, 1), &[Vec3::splat(grey), Vec3::ZERO], Vec3::ONE);
        assert_eq!(sky.power > 0.0, power, "{grey:e}");
        assert!(params_of(&sky).sky_density.is_finite());
    }
}

/// Density times solid angle over an even grid of directions, as the kernel finds it.
fn integral(library: Library, sky: &SkyTable) -> f64 {
    const SIDE: u32 = 512;
    let angles = |i: u32| (DVec2::new(f64::from(i % SIDE), f64::from(i / SIDE)) + 0.5) * PI / f64::from(SIDE);
    let direction = |i: u32| {
        let DVec2 { x: half_turn, y: angle } = angles(i);
        let (sin, cos) = (2.0 * half_turn).sin_cos();
        DVec3::new(angle.sin() * sin, angle.cos(), angle.sin() * cos)
    };
    let directions: Vec<Vec4> = (0..SIDE * SIDE).map(|i| direction(i).as_vec3().extend(0.0)).collect();
    let mut rig = rig(library, sky);
    rig.upload("probed", &directions).unwrap();
    play(&mut rig, &LOOK, sky, directions.len() as u64);
    let found: Vec<Vec4> = rig.read_some("probed", directions.len()).unwrap();
    let mut sum = 0.0;
    for (i, found) in found.iter().enumerate() {
        let right = sky_arriving(sky, found.truncate().as_dvec3()).1;
        assert!((f64::from(found.w) - right).abs() <= 1e-6 * right, "direction {i}: {} found, {right} right", found.w);
        sum += f64::from(found.w) * angles(i as u32).y.sin();
    }
    sum * 2.0 * PI * PI / f64::from(SIDE * SIDE)
}

#[test]
fn the_density_integrates_to_one() {
    for size in [(1, 1), (8, 4), (64, 32), (512, 256)] {
        // The midpoint rule is off by 2e-6 of a sine at this step.
        let whole = integral(Library::shipped(), &uneven(UVec2::from(size)));
        assert!((whole - 1.0).abs() < 1e-5, "{size:?}: {whole}");
    }
}

/// How many deviations the directions drawn are from their density, counted in quarters of pixels.
fn surprise(library: Library, sky: &SkyTable, density: impl Fn(UVec2) -> f64) -> f64 {
    let count = 1 << 20;
    let fine = 2 * sky.size;
    let mut observed = vec![0; (fine.x * fine.y) as usize];
    for draw in draws(library, sky, count) {
        let cell = sky_cell(draw.direction.normalize(), fine);
        observed[(cell.y * fine.x + cell.x) as usize] += 1;
    }
    let expected: Vec<f64> = (0..fine.x * fine.y)
        .map(|i| (UVec2::new(i % fine.x, i / fine.x), solid_angle(fine, i / fine.x)))
        .map(|(cell, angle)| count as f64 * angle * density(cell))
        .collect();
    chi_square_z(&observed, &expected)
}

/// The density of a quarter of a pixel, from the picture alone.
fn density_of(sky: &SkyTable) -> impl Fn(UVec2) -> f64 {
    let power: f64 = (0..sky.size.x * sky.size.y)
        .map(|i| brightness(sky, UVec2::new(i % sky.size.x, i / sky.size.x)) * solid_angle(sky.size, i / sky.size.x))
        .sum();
    move |cell| brightness(sky, cell / 2) / power
}

fn brightness(sky: &SkyTable, cell: UVec2) -> f64 {
    let pixel = sky.cells[(cell.y * sky.size.x + cell.x) as usize].truncate().as_dvec3();
    pixel.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

#[test]
fn draws_follow_the_density() {
    for size in [(8, 4), (64, 32), (257, 129)] {
        let sky = uneven(UVec2::from(size));
        let density = density_of(&sky);
        let z = surprise(Library::shipped(), &sky, &density);
        assert!(z < CHI_SQUARE_LIMIT, "{size:?}: chi-square is {z} deviations out");
    }
}

#[test]
fn an_error_of_three_percent_is_seen() {
    let sky = uneven(UVec2::new(16, 8));
    let density = density_of(&sky);
    // Of a density that is too high in half of the sky, and of pixels drawn too often, or unevenly within.
    let tilted = |cell: UVec2| density(cell) * if cell.x < sky.size.x { 1.03 } else { 1.0 };
    let z = surprise(Library::shipped(), &sky, tilted);
    assert!(z > 2.0 * CHI_SQUARE_LIMIT, "a density wrong by 3 % passes: {z}");
    for (module, right, wrong) in [
        ("passes/trace/sky", "(u < sky_cdf[first + middle].end)", "(u < 1.03 * sky_cdf[first + middle].end)"),
        ("lib/sky", "mix(upper * upper, lower * lower, u.y)", "pow(mix(upper, lower, u.y), 2.0)"),
        ("lib/sky", "(f32(cell.x) + u.x)", "(f32(cell.x) + 0.97 * u.x)"),
    ] {
        let z = surprise(planted(module, right, wrong), &sky, &density);
        assert!(z > 2.0 * CHI_SQUARE_LIMIT, "{wrong} in {module} went unnoticed: {z}");
    }
    let scaled = planted("passes/trace/sky", "luminance(radiance) * density", "1.03 * luminance(radiance) * density");
    assert!(std::panic::catch_unwind(|| integral(scaled, &sky)).is_err());
}

#[test]
fn a_sun_of_one_pixel_in_a_wide_row_gets_its_share() {
    // 2^24 numbers leave 1,024 to a column here: rounded up, the share of each dim pixel would take 5e-4 from the sun's.
    let size = UVec2::new(1 << 14, 1);
    let mut random = SplitMix(7);
    let mut pixels: Vec<Vec3> = (0..size.x).map(|_| Vec3::splat(random.unit() as f32)).collect();
    let sun = 4567;
    pixels[sun] = Vec3::splat(1e5);
    pixels[sun + 1] = Vec3::ZERO;
    let sky = SkyTable::new(size, &pixels, Vec3::ONE);
    let mut rig = rig(Library::shipped(), &sky);
    rig.upload("counts", &vec![0u32; size.x as usize]).unwrap();
    play(&mut rig, &COUNT, &sky, 1 << 16);
    let counts: Vec<u32> = rig.read_some("counts", size.x as usize).unwrap();
    assert_eq!(counts.iter().map(|&n| u64::from(n)).sum::<u64>(), 1 << 24);
    assert_eq!(counts[sun + 1], 0, "a black pixel is drawn");
    let right =
        |i: usize| f64::from(1 << 24) * brightness(&sky, UVec2::new(i as u32, 0)) * solid_angle(size, 0) / sky.power;
    let off = f64::from(counts[sun]) / right(sun) - 1.0;
    assert!(off.abs() < 2e-5, "the sun's share is off by {off:e}");
    for i in (0..counts.len()).filter(|i| *i != sun) {
        assert!((f64::from(counts[i]) - right(i)).abs() <= 1.0, "pixel {i}: {} of {}", counts[i], right(i));
    }
}

/// A floor and a ball of two lobes under an uneven sky, with a lamp or without.
fn outdoors(lamp: bool) -> Room {
    let mut room = Room { next_event: true, sky: Some(uneven(UVec2::new(16, 8))), ..Room::default() };
    let floor = room.material(matte(Vec3::new(0.7, 0.5, 0.3), Vec3::ZERO));
    let glossy = room.material(shiny(Vec3::splat(0.4), Vec3::splat(0.5), 33.0));
    room.quad(Vec3::new(-2.0, -1.0, 2.0), 4.0 * Vec3::X, -4.0 * Vec3::Z, floor);
    room.ball(Vec3::new(0.2, -0.3, 0.0), 0.6, glossy);
    if lamp {
        room.lamp();
    }
    room
}

#[test]
fn paths_under_a_sky_equal_the_f64_twin() {
    for lamp in [false, true] {
        let room = outdoors(lamp);
        against_twin(&room, Library::shipped(), &small(&room)).unwrap_or_else(|why| panic!("lamp {lamp}: {why}"));
    }
    let sky_turn = tilt();
    for lamp in [false, true] {
        let room = Room { sky_turn, ..outdoors(lamp) };
        against_twin(&room, Library::shipped(), &small(&room))
            .unwrap_or_else(|why| panic!("turned, lamp {lamp}: {why}"));
    }
    let found = Room { next_event: false, sky_turn, ..outdoors(true) };
    against_twin(&found, Library::shipped(), &small(&found)).unwrap();
    let found = Room { next_event: false, ..outdoors(true) };
    against_twin(&found, Library::shipped(), &small(&found)).unwrap();
    let room = outdoors(true);
    for (module, right, wrong) in [
        ("passes/trace/sky", "luminance(radiance) * density", "1.03 * luminance(radiance) * density"),
        ("passes/trace/connect", "u.x >= params.light_share", "u.x >= 1.03 * params.light_share"),
    ] {
        let failed = against_twin(&room, planted(module, right, wrong), &small(&room)).is_err();
        assert!(failed, "{wrong} in {module} went unnoticed");
    }
}

/// A turn about no axis of the picture.
fn tilt() -> DMat3 {
    DMat3::from_rotation_z(-0.9) * DMat3::from_rotation_y(2.2) * DMat3::from_rotation_x(0.4)
}

#[test]
fn a_turned_sky_is_drawn_from_and_found_where_it_is() {
    let turned =
        planted("passes/trace/sky", "SkySample(to_scene(params, direction)", "SkySample(to_picture(params, direction)");
    let unturned = planted("passes/trace/sky", "sky_cell(to_picture(params, direction)", "sky_cell((direction)");
    let room = Room { sky_turn: tilt(), ..outdoors(false) };
    for (wrong, library) in [("drawn the wrong way round", turned), ("found unturned", unturned)] {
        assert!(against_twin(&room, library, &small(&room)).is_err(), "a sky {wrong} went unnoticed");
    }
}

#[test]
fn a_sky_that_is_not_turned_is_the_same_to_the_bit_as_without_turns() {
    let text = std::fs::read_to_string("shaders/passes/trace/sky.wgsl").unwrap();
    let plain = text
        .replace("to_picture(params, direction),", "direction,")
        .replace("to_scene(params, direction),", "direction,");
    assert_eq!(text.matches("(params, direction),").count(), 2, "the turns are elsewhere");
    let room = outdoors(true);
    let traced = |library: Library| {
        let mut rig = Runtime::new(support::gpu(), library);
        room.load(&mut rig).unwrap();
        let params = TraceParams { layers: 8, ..room.params(UVec2::splat(64)) };
        samples(&mut rig, &params).iter().map(|s| (s.rgb.to_array().map(f32::to_bits), s.info)).collect::<Vec<_>>()
    };
    assert!(traced(Library::shipped()) == traced(Library::shipped().with("passes/trace/sky", &plain)));
}
