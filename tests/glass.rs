//! Rooms with glass, mirrors, rough metal and veils.

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Energy, Material, Passage};
use lucerna::gpu::Runtime;
use lucerna::layout::trace::{MaterialRecord, TraceParams};
use lucerna::prepare::material;
use lucerna::shader::Library;

use crate::path::{against_twin, inside, samples, sees_mistakes, small};
use crate::rooms::{Room, matte};
use crate::support;

fn glass(ni: f32) -> MaterialRecord {
    material::pack(&Material { passage: Passage::Glass(ni), ..Material::BLACK }, Energy::Preserve)
}

fn traced(room: &Room, params: &TraceParams) -> Vec<Vec3> {
    let mut rig = support::rig();
    room.load(&mut rig).unwrap();
    samples(&mut rig, params).iter().map(|sample| sample.rgb).collect()
}

#[test]
fn equals_the_f64_twin() {
    let room = Room::glass();
    against_twin(&room, Library::shipped(), &small(&room)).unwrap();
}

#[test]
fn an_error_of_one_percent_is_seen() {
    let room = Room::glass();
    let mistakes = [
        ("lib/bsdf/glass", "eta_squared(at) * m.tf, beyond", "1.01 * eta_squared(at) * m.tf, beyond"),
        (
            "lib/bsdf/mixture",
            "m.ks / m.specular_probability, is_above",
            "0.99 * m.ks / m.specular_probability, is_above",
        ),
        ("lib/bsdf/mixture", "0.0, m.tf)", "0.0, 1.01 * m.tf)"),
        ("lib/bsdf/ggx", "0.5 * density / reach_o", "0.505 * density / reach_o"),
    ];
    sees_mistakes(&room, &mistakes);
}

#[test]
fn glass_in_a_furnace_is_invisible() {
    // All around glows alike: whether a path is reflected or refracted, it ends in the same light, squeezed and widened
    // again. Of 64 segments a path between walls spends at most a few in the ball.
    for ni in [1.0, 1.5, 2.4] {
        let mut room = Room::default();
        let wall = room.material(matte(Vec3::ZERO, Vec3::splat(3.0)));
        room.walls([Some(wall); 6]);
        let shell = room.material(glass(ni));
        room.ball(Vec3::new(0.2, -0.3, -0.5), 0.4, shell);
        let got = traced(&room, &TraceParams { layers: 4, ..inside(&room, UVec2::splat(32), 64) });
        let off = got.iter().filter(|rgb| (**rgb / 3.0 - 1.0).abs().max_element() > 1e-5).count();
        // Some light is caught by total reflection for more than 64 segments.
        assert!(off * 1000 < got.len(), "Ni {ni}: {off} of {} samples are off", got.len());
        assert!(ni > 1.0 || off == 0, "Ni {ni}: {off} samples are off");
    }
}

#[test]
fn what_is_in_glass_has_an_index_of_its_own_times_that_around() {
    // Radiance in a medium of index n is n^2 times that of the open. Every surface multiplies by its own Ni, as docs/materials.md has it: so a liquid
    // in a glass needs their ratio, on the surface that they share.
    for (outer, inner, right) in
        [(1.5, 1.5, 1.5 * 1.5), (1.5, 1.33 / 1.5, 1.33), (1.33, 1.5 / 1.33, 1.5), (1.5, 1.0, 1.5)]
    {
        let mut room = Room { environment: Vec3::ONE, ..Room::default() };
        for (radius, index) in [(1.0, outer), (0.5, inner)] {
            // The front is to the side of the lower index, as Ni is never below 1; that of a ball is inside until it is turned out.
            let material = room.material(glass(f32::max(index, 1.0 / index)));
            let from = room.triangles.len();
            room.ball(Vec3::ZERO, radius, material);
            if index >= 1.0 {
                room.triangles[from..].iter_mut().for_each(|t| (t.b, t.c) = (t.c, t.b));
                room.shading[from..].iter_mut().for_each(|n| (n.n1, n.n2) = (n.n2, n.n1));
            }
        }
        let params = TraceParams { position: Vec3::ZERO, layers: 4, max_depth: 64, ..room.params(UVec2::splat(16)) };
        let got = traced(&room, &params);
        let off = got.iter().filter(|rgb| (rgb.x / (right * right) as f32 - 1.0).abs() > 1e-4).count();
        assert!(off <= 2, "{inner} in {outer}: {off} of {} samples are off, the first is {}", got.len(), got[0]);
    }
}

#[test]
fn roulette_spares_paths_inside_glass() {
    // Clear glass in walls of 1 that light comes from at the end: no path is dim, so that none may be ended, though radiance within
    // is less than half of that outside.
    let mut room = Room { roulette: true, ..Room::default() };
    let wall = room.material(matte(Vec3::ONE, Vec3::ZERO));
    room.walls([Some(wall); 6]);
    let clear = room.material(glass(1.5));
    let (low, side) = (Vec3::splat(-0.9), 0.8);
    for axis in 0..3 {
        let (e, f) = (side * Vec3::AXES[(axis + 1) % 3], side * Vec3::AXES[(axis + 2) % 3]);
        room.quad(low, f, e, clear);
        room.quad(low + side * Vec3::AXES[axis], e, f, clear);
    }
    let rays = |library: Library| {
        let mut rig = Runtime::new(support::gpu(), library);
        room.load(&mut rig).unwrap();
        let got = samples(&mut rig, &TraceParams { layers: 4, ..inside(&room, UVec2::splat(16), 24) });
        got.iter().filter(|sample| sample.info < 24).count()
    };
    // A rounding below 1 ends one path in 2^22.
    assert_eq!(rays(Library::shipped()), 0, "paths ended early");
    let text = std::fs::read_to_string("shaders/passes/trace/path.wgsl").unwrap();
    let wrong = text.replace("largest_of(most) * (*state).eta_scale", "largest_of(most)");
    assert_ne!(text, wrong);
    assert!(rays(Library::shipped().with("passes/trace/path", &wrong)) > 100, "no path was in the glass");
}

#[test]
fn roulette_equals_the_f64_twin() {
    for next_event in [false, true] {
        let room = Room { roulette: true, next_event, ..Room::glass() };
        against_twin(&room, Library::shipped(), &small(&room)).unwrap();
    }
}

#[test]
fn a_veil_lets_its_part_through() {
    let mut room = Room { environment: Vec3::new(1.0, 2.0, 4.0), ..Room::default() };
    let tf = Vec3::new(1.0, 0.5, 0.25);
    let values =
        Material { diffuse: Vec3::splat(0.5), passage: Passage::SeeThrough(0.3), filter: tf, ..Material::BLACK };
    let veil = room.material(material::pack(&values, Energy::Preserve));
    room.quad(Vec3::new(-9.0, -9.0, 0.0), Vec3::X * 18.0, Vec3::Y * 18.0, veil);
    let mean_of = |rig: &mut Runtime| {
        room.load(rig).unwrap();
        let got = samples(rig, &TraceParams { layers: 64, ..room.params(UVec2::splat(64)) });
        got.iter().map(|sample| sample.rgb.as_dvec3()).sum::<DVec3>() / got.len() as f64
    };
    // What is reflected sees the environment as well.
    let right = (0.3 * 0.5 + 0.7 * tf.as_dvec3()) * room.environment.as_dvec3();
    let worst = |mean: DVec3| (mean / right - 1.0).abs().max_element();
    // A sample is one of two values, at most 1/2 apart in a mean of 0.3: 2^18 of them deviate by 9e-4 of it; five of that.
    let off = worst(mean_of(&mut support::rig()));
    assert!(off < 4.5e-3, "{off}");
    let text = std::fs::read_to_string("shaders/lib/bsdf/mixture.wgsl").unwrap();
    let wrong = text.replace("if (pick < m.transparency)", "if (pick < 1.02 * m.transparency)");
    assert_ne!(text, wrong);
    let mut rig = Runtime::new(support::gpu(), Library::shipped().with("lib/bsdf/mixture", &wrong));
    assert!(worst(mean_of(&mut rig)) > 4.5e-3, "a part wrong by 2 % passes");
}
