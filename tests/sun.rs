//! The sun: directions drawn from its disk by the real kernel code, and paths that find it or ask it.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3, UVec2, Vec3, Vec4};
use lucerna::components::Energy;
use lucerna::components::{Daylight, Lobe, Material, Passage};
use lucerna::cpu::rng::{sample_2d, sample_key};
use lucerna::cpu::sun::SunDisk;
use lucerna::gpu::Runtime;
use lucerna::layout::sky::{SkyTable, Sun};
use lucerna::layout::trace::TraceParams;
use lucerna::passes::{Binding, Pass, Recording, Size};
use lucerna::prepare::lighting::Lighting;
use lucerna::prepare::material;
use lucerna::prepare::sun::sun_of;
use lucerna::shader::Library;

use crate::daylight::noon;
use crate::path::{against_twin, compare_integrators, small};
use crate::rooms::{Room, matte, shiny};
use crate::statistics::{CHI_SQUARE_LIMIT, chi_square_z};
use crate::support;
use crate::support::plant::planted;

const PROBE: &str = "
import package::gen::{SampleKey, TraceParams};
import package::lib::rng::{sample_2d};
import package::passes::trace::connect::{draw_from_sun};

@group(0) @binding(0) var<storage, read> params: TraceParams;
@group(0) @binding(1) var<storage, read_write> probed: array<vec4<f32>>;

@compute @workgroup_size(64)
fn draw_keys_of_sun(@builtin(global_invocation_id) id: vec3<u32>) {
    let drawn = draw_from_sun(params, sample_2d(SampleKey(id.x, 0u, 0u, params.seed), 0u));
    probed[2u * id.x] = vec4<f32>(drawn.direction, drawn.pdf);
    probed[2u * id.x + 1u] = vec4<f32>(drawn.radiance, 0.0);
}
";

static DRAW: Pass = Pass {
    name: "draw_keys_of_sun",
    module: "tests/sun",
    entry: "draw_keys_of_sun",
    features: &[],
    bindings: &[
        Binding::params("TraceParams"),
        Binding::write("probed", "array<vec4<f32>>"),
        Binding::read("sky", "array<vec4<f32>>"),
    ],
    makes: &[],
    twin: lucerna::passes::Twin::None("of a test"),
};

/// Grey sky of two pixels, and a sun of a size in degrees.
fn rig_of(sun: Sun) -> (SkyTable, TraceParams) {
    let sky = SkyTable::new(UVec2::new(1, 2), &[Vec3::splat(0.5), Vec3::splat(0.25)], Vec3::ONE);
    let mut params = TraceParams { seed: 5, ..TraceParams::default() };
    let lighting = Lighting { sky: sky.size, sky_power: sky.power, sun: Some(sun), ..Lighting::default() };
    lighting.write(&mut params, 1.0);
    (sky, params)
}

/// Directions with their density, and radiance.
fn draws(library: Library, sun: Sun, count: usize) -> Vec<(DVec3, f64, Vec3)> {
    let (sky, params) = rig_of(sun);
    let mut rig = Runtime::new(support::gpu(), library.with("tests/sun", PROBE));
    rig.set_features(&["sky_light", "sun"]);
    rig.upload("sky", &sky.cells).unwrap();
    rig.reserve("probed", 32 * count as u64).unwrap();
    let mut recording = Recording::default();
    recording.run(&DRAW, Size::Items(count as u64)).params(&params);
    rig.play(&recording).unwrap();
    let rows: Vec<Vec4> = rig.read_some("probed", 2 * count).unwrap();
    rows.chunks_exact(2).map(|row| (row[0].truncate().as_dvec3(), row[0].w.into(), row[1].truncate())).collect()
}

fn suns() -> Vec<Sun> {
    [(0.0, 0.0, 0.533), (60.0, 200.0, 0.533), (90.0, 10.0, 0.05), (20.0, -50.0, 30.0), (45.0, 180.0, 4.0)]
        .map(|(elevation, azimuth, sun_size)| Daylight { elevation, azimuth, sun_size, turbidity: 1.5, ..noon() })
        .iter()
        .map(|day| sun_of(day).unwrap())
        .collect()
}

#[test]
fn draws_of_the_sun_equal_the_f64_twin() {
    for sun in suns() {
        let (_, params) = rig_of(sun);
        let disk = SunDisk::new(&params).unwrap();
        let count = 1 << 13;
        let mut outside = 0;
        for (i, (direction, pdf, radiance)) in draws(Library::shipped(), sun, count).into_iter().enumerate() {
            let right = disk.draw(sample_2d(sample_key(i as u32, 0, 5), 0));
            assert!(right.distance(direction) < 1e-6, "{sun:?}, draw {i}: {direction}, not {right}");
            // At the very edge rounding decides.
            if radiance.max_element() < sun.radiance.max_element() {
                outside += 1;
                continue;
            }
            // That of the sky comes in addition.
            let (least, sky) = (f64::from(params.sun_density), 0.5 * f64::from(params.sky_density));
            let good = pdf > 0.999_999 * least && pdf < 1.000_001 * (least + sky);
            assert!(good, "{sun:?}, draw {i}: {pdf}, not from {least} to {sky} more");
        }
        let share = if sun.chord_squared < 1e-5 { 100 } else { 1000 };
        assert!(outside <= count / share, "{sun:?}: {outside} directions are not in the disk");
    }
}

/// How many deviations the directions drawn are from an even disk, in 8 rings of equal solid angle by 16 parts of a turn.
fn surprise(library: Library, sun: Sun) -> f64 {
    let count = 1 << 18;
    let mut observed = vec![0; 128];
    let n = sun.direction.as_dvec3().normalize();
    let (t, b) = n.any_orthonormal_pair();
    for (direction, ..) in draws(library, sun, count) {
        let ring = 8.0 * direction.distance_squared(n) / f64::from(sun.chord_squared);
        let turn = 16.0 * (direction.dot(b).atan2(direction.dot(t)) / TAU + 0.5);
        observed[(ring as usize).min(7) * 16 + (turn as usize).min(15)] += 1;
    }
    chi_square_z(&observed, &vec![count as f64 / 128.0; 128])
}

#[test]
fn draws_cover_the_disk_evenly() {
    let all = suns();
    for sun in [all[1], all[3]] {
        let z = surprise(Library::shipped(), sun);
        assert!(z < CHI_SQUARE_LIMIT, "{sun:?}: chi-square is {z} deviations out");
    }
    for (right, wrong) in
        [("0.5 * chord_squared * u.x", "0.49 * chord_squared * u.x"), ("turns(u.y)", "turns(0.98 * u.y)")]
    {
        let z = surprise(planted("lib/sun", right, wrong), all[1]);
        assert!(z > 2.0 * CHI_SQUARE_LIMIT, "{wrong} went unnoticed: {z}");
    }
}

/// A floor, a glossy ball and a mirror under a dim sky and a sun of so many degrees, with a lamp or without.
fn outdoors(size: f64, lamp: bool) -> Room {
    let pixels: Vec<Vec3> = (0..32).map(|i| Vec3::new(0.1, 0.2, 0.3) * (1.0 + (i % 3) as f32)).collect();
    let sky = SkyTable::new(UVec2::new(8, 4), &pixels, Vec3::ONE);
    let day = Daylight { elevation: 40.0, azimuth: 150.0, sun_size: size, strength: 0.05, ..noon() };
    let mut room = Room {
        next_event: true,
        sky: Some(sky),
        sky_turn: DMat3::from_rotation_y(0.7),
        sun: sun_of(&day),
        ..Room::default()
    };
    let pack = |values: Material| material::pack(&values, Energy::Preserve);
    let floor = room.material(matte(Vec3::new(0.7, 0.5, 0.3), Vec3::ZERO));
    let glossy = room.material(shiny(Vec3::splat(0.4), Vec3::splat(0.5), 33.0));
    let veil =
        room.material(pack(Material { passage: Passage::SeeThrough(0.5), filter: Vec3::ONE, ..Material::BLACK }));
    let mirror = Material { specular: Vec3::splat(0.8), lobe: Lobe::Mirror, ..Material::BLACK };
    let mirror = room.material(pack(mirror));
    room.quad(Vec3::new(-2.0, -1.0, 2.0), 4.0 * Vec3::X, -4.0 * Vec3::Z, floor);
    room.quad(Vec3::new(-1.5, -1.0, -1.5), 3.0 * Vec3::X, 2.0 * Vec3::Y, mirror);
    room.quad(Vec3::new(-1.5, 0.0, 0.3), Vec3::X, Vec3::Y, veil);
    room.ball(Vec3::new(0.4, -0.3, 0.0), 0.6, glossy);
    if lamp {
        room.lamp();
    }
    room
}

#[test]
fn paths_under_a_sun_equal_the_f64_twin() {
    for (size, lamp) in [(20.0, false), (20.0, true), (Daylight::SUN_SIZE, true)] {
        let room = outdoors(size, lamp);
        assert!(room.features().contains(&"sun"));
        against_twin(&room, Library::shipped(), &small(&room))
            .unwrap_or_else(|why| panic!("{size} degrees, lamp {lamp}: {why}"));
    }
    let found = Room { next_event: false, ..outdoors(20.0, true) };
    against_twin(&found, Library::shipped(), &small(&found)).unwrap();
    let room = outdoors(20.0, true);
    for (module, right, wrong) in [
        ("passes/trace/connect", "pdf += params.sun_density", "pdf += 1.01 * params.sun_density"),
        ("passes/trace/connect", "u.x < params.sun_end", "u.x < 0.98 * params.sun_end"),
        ("passes/trace/connect", "radiance += params.sun_radiance", "radiance += 1.01 * params.sun_radiance"),
    ] {
        let failed = against_twin(&room, planted(module, right, wrong), &small(&room)).is_err();
        assert!(failed, "{wrong} in {module} went unnoticed");
    }
}

#[test]
fn asking_the_sun_finds_the_same_as_hitting_it() {
    compare_integrators(&outdoors(30.0, false)).unwrap();
}
