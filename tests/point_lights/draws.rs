//! Which light is drawn: by its power, whatever kind it is of.

use glam::{DVec3, Vec3, Vec4};
use lucerna::gpu::Runtime;
use lucerna::layout::trace::TraceParams;
use lucerna::passes::{Binding, Pass, Recording, Size};
use lucerna::prepare::point::point_light;
use lucerna::shader::Library;

use super::{bulb, spot};
use crate::rooms::{Room, matte};
use crate::statistics::{CHI_SQUARE_LIMIT, chi_square_z};
use crate::support;
use crate::support::plant::planted;

const PROBE: &str = "
import package::gen::{SampleKey, TraceParams};
import package::lib::rng::{sample_2d};
import package::passes::trace::connect::{draw_light, is_point};

@group(0) @binding(0) var<storage, read> params: TraceParams;
@group(0) @binding(1) var<storage, read_write> probed: array<vec4<f32>>;

@compute @workgroup_size(64)
fn draw_keys_of_lights(@builtin(global_invocation_id) id: vec3<u32>) {
    let key = SampleKey(id.x, 0u, 0u, params.seed);
    let drawn = draw_light(params, vec3<f32>(0.1, -0.2, 0.3), sample_2d(key, 0u), 0.0);
    probed[2u * id.x] = vec4<f32>(drawn.radiance, f32(drawn.triangle));
    probed[2u * id.x + 1u] = vec4<f32>(drawn.point, select(0.0, 1.0, is_point(drawn)));
}
";

static DRAW: Pass = Pass {
    name: "draw_keys_of_lights",
    module: "tests/point_lights",
    entry: "draw_keys_of_lights",
    features: &[],
    bindings: &[
        Binding::params("TraceParams"),
        Binding::write("probed", "array<vec4<f32>>"),
        Binding::read("lights", "array<vec4<u32>>"),
    ],
    makes: &[],
    twin: lucerna::passes::Twin::None("of a test"),
};

/// Twenty bulbs, ten spots and ten triangles, each of another power.
fn many() -> Room {
    let mut room = Room { next_event: true, ..Room::default() };
    for i in 0..10 {
        let glow = room.material(matte(Vec3::ZERO, Vec3::splat(0.2 + 0.1 * i as f32)));
        let corner = Vec3::new(i as f32, 5.0, 0.0);
        room.triangle([corner, corner + Vec3::X, corner + Vec3::Z], glow);
    }
    let place = |i: i32| DVec3::new(f64::from(i), 3.0, f64::from(i % 7));
    let bulbs = (0..20).map(|i| bulb(place(i), Vec3::splat(0.05 * (1.0 + (i % 5) as f32))));
    let spots = (0..10).map(|i| spot(place(i), DVec3::ZERO, 10.0 + 5.0 * f64::from(i), 0.1 * f64::from(i)));
    room.points = bulbs.chain(spots).map(|light| point_light(&light, DVec3::ZERO)).collect();
    room
}

/// What was drawn: radiance and triangle, place and whether it is a point.
fn draws(library: Library, room: &Room, count: usize) -> Vec<[Vec4; 2]> {
    let params = TraceParams { seed: 5, ..room.params(glam::UVec2::ONE) };
    let mut rig = Runtime::new(support::gpu(), library.with("tests/point_lights", PROBE));
    rig.set_features(&["lights", "point_lights"]);
    rig.upload("lights", &room.lights().lights).unwrap();
    rig.reserve("probed", 32 * count as u64).unwrap();
    let mut recording = Recording::default();
    recording.run(&DRAW, Size::Items(count as u64)).params(&params);
    rig.play(&recording).unwrap();
    let rows: Vec<Vec4> = rig.read_some("probed", 2 * count).unwrap();
    rows.chunks_exact(2).map(|rows| [rows[0], rows[1]]).collect()
}

/// How many deviations the numbers of draws of each light are from its part of all power.
fn surprise(library: Library) -> f64 {
    let (room, count) = (many(), 1 << 18);
    let lights = room.lights().lights;
    let places: Vec<Vec3> = lights.iter().filter_map(|light| light.point()).map(|point| point.position).collect();
    let triangles = lights.len() - places.len();
    let powers: Vec<f64> = lights
        .iter()
        .map(|light| match light.point() {
            Some(point) => f64::from(point.power),
            None => 0.5 * f64::from(light.emission.x) * f64::from(light.sides()),
        })
        .collect();
    let all: f64 = powers.iter().sum();
    let mut observed = vec![0; lights.len()];
    for [radiance, place] in draws(library, &room, count) {
        let index = match place.w > 0.5 {
            // Two lights are in one place: told apart by what a bulb sends.
            true => {
                let grey = radiance.x == radiance.z && radiance.x > 0.0;
                let first = if grey { 0 } else { 20 };
                let found = places[first..].iter().position(|p| *p == place.truncate());
                triangles + first + found.expect("a light of the scene")
            }
            false => radiance.w as usize,
        };
        observed[index] += 1;
    }
    let expected: Vec<f64> = powers.iter().map(|power| power / all * count as f64).collect();
    chi_square_z(&observed, &expected)
}

#[test]
fn lights_are_drawn_by_their_power() {
    let z = surprise(Library::shipped());
    assert!(z < CHI_SQUARE_LIMIT, "chi-square is {z} deviations out");
    let wrong = planted("passes/trace/connect", "if (u < light_end(middle))", "if (u < 0.95 * light_end(middle))");
    let z = surprise(wrong);
    assert!(z > 2.0 * CHI_SQUARE_LIMIT, "a planted error went unnoticed: {z}");
}
