//! Rooms with panes.

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Daylight, Energy, Material, Passage};
use lucerna::cpu::bsdf::pane;
use lucerna::layout::sky::SkyTable;
use lucerna::layout::trace::{MaterialRecord, TraceParams};
use lucerna::prepare::material;
use lucerna::prepare::sun::sun_of;

use crate::daylight::noon;
use crate::light::{Lamp, OVERHEAD, SEEN, seen_of};
use crate::path::{both_ways_equal_the_twin, compare_integrators, inside, samples, sees_mistakes};
use crate::rooms::{Room, matte, shiny};
use crate::support;

fn thin(ni: f32, filter: Vec3) -> MaterialRecord {
    material::pack(&Material { passage: Passage::Pane(ni), filter, ..Material::BLACK }, Energy::Preserve)
}

/// Materials that let light straight on, in parts that differ by channel.
const FILTER: Vec3 = Vec3::new(0.9, 0.6, 0.3);

/// A sheet's height above the floor, and its material.
pub type Sheets = Vec<(f32, MaterialRecord)>;

/// Sheets between the point that is seen of a floor (`light::SEEN`) and a light at a position, how many segments a path has, and the part of the
/// light that arrives.
pub fn sheets_to(light: DVec3) -> Vec<(Sheets, u32, f64)> {
    let to = light - SEEN;
    let glass = pane::split(1.5, FILTER.as_dvec3(), to.y / to.length())[1].x;
    let veil = 0.4 * f64::from(FILTER.x);
    let sheer = Material { passage: Passage::SeeThrough(0.6), filter: FILTER, ..Material::BLACK };
    let (clear, sheer) = (thin(1.5, FILTER), material::pack(&sheer, Energy::Preserve));
    let wall = matte(Vec3::splat(0.5), Vec3::ZERO);
    vec![
        (vec![(0.7, clear)], 3, glass),
        (vec![(0.7, sheer)], 3, veil),
        (vec![(0.7, clear), (0.8, clear)], 4, glass * glass),
        (vec![(0.7, clear), (0.8, sheer), (0.9, clear)], 5, glass * veil * glass),
        // As often as a path may go through on its way to any light.
        (vec![(0.7, clear)], 2, 0.0),
        (vec![(0.7, clear), (0.8, clear)], 3, 0.0),
        // A wall hides all, on either side of a pane.
        (vec![(0.7, clear), (0.9, wall)], 9, 0.0),
        (vec![(0.7, wall), (0.9, clear)], 9, 0.0),
    ]
}

/// Lays sheets over the floor, above the camera, which looks at it from a height of a half.
pub fn cover(room: &mut Room, sheets: &Sheets) {
    for (height, record) in sheets {
        let material = room.material(*record);
        room.quad(Vec3::new(-9.0, *height, 9.0), 18.0 * Vec3::X, -18.0 * Vec3::Z, material);
    }
}

/// A room with an open side and a large lamp, a window in front of a corner, and a bubble.
fn glazed() -> Room {
    let mut room = Room { environment: Vec3::new(0.3, 0.4, 0.5), ..Room::default() };
    let white = room.material(matte(Vec3::splat(0.73), Vec3::ZERO));
    let red = room.material(matte(Vec3::new(0.63, 0.06, 0.05), Vec3::splat(0.5)));
    let lamp = room.material(matte(Vec3::ZERO, Vec3::new(4.0, 3.0, 2.0)));
    room.walls([Some(red), Some(white), Some(white), Some(white), Some(white), None]);
    room.quad(Vec3::new(-0.8, 0.9, -0.8), 1.6 * Vec3::X, 1.6 * Vec3::Z, lamp);
    let tinted = room.material(thin(1.5, Vec3::new(0.8, 0.9, 1.0)));
    room.quad(Vec3::new(-0.9, -0.9, 0.7), Vec3::new(1.2, 0.0, 0.2), Vec3::Y * 1.7, tinted);
    room.ball(Vec3::new(-0.45, 0.5, 0.0), 0.35, tinted);
    room
}

#[test]
fn equals_the_f64_twin() {
    both_ways_equal_the_twin(&glazed());
}

#[test]
fn an_error_of_a_few_percent_is_seen() {
    let room = glazed();
    let mistakes = [
        ("lib/bsdf/pane", "-frame.wo, 0.0, passed /", "-frame.wo, 0.0, 1.02 * passed /"),
        ("lib/bsdf/pane", "reflected / share, is", "1.05 * reflected / share, is"),
    ];
    sees_mistakes(&room, &mistakes);
}

#[test]
fn asking_lights_changes_no_mean() {
    compare_integrators(&glazed()).unwrap();
}

/// A floor under a sky and a sun, with a lamp and a veil, behind panes that reach into each other.
fn conservatory(sun_size: f64, strength: f32) -> Room {
    let pixels: Vec<Vec3> = (0..32).map(|i| Vec3::new(0.1, 0.2, 0.3) * (1.0 + (i % 3) as f32)).collect();
    let day = Daylight { elevation: 40.0, azimuth: 150.0, sun_size, strength, ..noon() };
    let sky = SkyTable::new(UVec2::new(8, 4), &pixels, Vec3::ONE);
    let mut room = Room { sky: Some(sky), sun: sun_of(&day), ..Room::default() };
    let floor = room.material(matte(Vec3::new(0.7, 0.5, 0.3), Vec3::ZERO));
    let glossy = room.material(shiny(Vec3::splat(0.4), Vec3::splat(0.5), 33.0));
    let lamp = room.material(matte(Vec3::ZERO, Vec3::new(4.0, 3.0, 2.0)));
    let tinted = room.material(thin(1.5, Vec3::new(0.8, 0.9, 1.0)));
    let veil = Material {
        passage: Passage::SeeThrough(0.6),
        filter: Vec3::new(0.9, 0.7, 0.8),
        diffuse: Vec3::splat(0.3),
        ..Material::BLACK
    };
    let veil = room.material(material::pack(&veil, Energy::Preserve));
    room.quad(Vec3::new(-2.0, -1.0, 2.0), 4.0 * Vec3::X, -4.0 * Vec3::Z, floor);
    room.ball(Vec3::new(0.4, -0.5, 0.0), 0.4, glossy);
    room.quad(Vec3::new(-0.6, -0.4, -0.9), 1.2 * Vec3::X, 0.5 * Vec3::Y, lamp);
    room.quad(Vec3::new(-1.2, 0.3, 1.2), 2.4 * Vec3::X, Vec3::new(0.0, 0.2, -2.4), tinted);
    room.quad(Vec3::new(-1.2, -1.0, -0.7), 2.4 * Vec3::X, 1.6 * Vec3::Y, tinted);
    room.quad(Vec3::new(-1.0, -0.2, -0.8), Vec3::new(1.0, 0.3, 0.0), Vec3::new(0.0, 0.0, 1.4), veil);
    room.ball(Vec3::new(-0.5, -0.7, 0.3), 0.25, tinted);
    room
}

#[test]
fn light_behind_panes_equals_the_f64_twin() {
    both_ways_equal_the_twin(&conservatory(20.0, 0.02));
    both_ways_equal_the_twin(&conservatory(Daylight::SUN_SIZE, 0.02));
}

#[test]
fn an_error_in_what_panes_let_through_is_seen() {
    let room = Room { next_event: true, ..conservatory(20.0, 0.02) };
    let (path, shadow) = ("passes/trace/path", "passes/trace/shadow");
    let mistakes = [
        (shadow, "let passed = passed_straight(", "let passed = 1.02 * passed_straight("),
        (shadow, "params.max_depth - 2u - state.bounce", "0u"),
        (path, "select(drawn.pdf, (*state).pdf, straight)", "drawn.pdf"),
        (path, "distance += (*state).passed;", "distance += 0.0;"),
        (shadow, "connection.enough = 0.0;", "connection.enough *= 1.0;"),
        ("lib/bsdf/straight", "all(drawn.direction == -wo)", "true"),
    ];
    sees_mistakes(&room, &mistakes);
}

#[test]
fn light_behind_panes_is_the_same_by_chance() {
    let mut room = conservatory(30.0, 0.004);
    // By chance the lamp is found with more noise than all else has.
    room.materials.iter_mut().for_each(|material| material.emission *= 0.2);
    compare_integrators(&room).unwrap();
}

/// Panes in the plane of a lamp, before and behind it in the order of triangles, which says what is hit.
#[test]
fn a_lamp_in_the_plane_of_panes_is_the_same_by_chance() {
    let mut room = Room { environment: Vec3::splat(0.5), ..Room::default() };
    let white = room.material(matte(Vec3::splat(0.73), Vec3::ZERO));
    let tinted = room.material(thin(1.5, Vec3::new(0.8, 0.9, 1.0)));
    let lamp = room.material(matte(Vec3::ZERO, Vec3::new(4.0, 3.0, 2.0)));
    room.walls([Some(white), Some(white), Some(white), None, Some(white), None]);
    room.quad(Vec3::new(-0.8, 0.5, -0.8), 0.8 * Vec3::X, 1.6 * Vec3::Z, tinted);
    room.quad(Vec3::new(-0.8, 0.5, -0.8), 1.6 * Vec3::X, 1.6 * Vec3::Z, lamp);
    room.quad(Vec3::new(-0.8, 0.5, 0.2), 1.6 * Vec3::X, 0.6 * Vec3::Z, tinted);
    compare_integrators(&room).unwrap();
}

#[test]
fn a_tiny_light_shines_through_panes() {
    let lamp = Lamp { centre: DVec3::new(0.3, 1.5, 0.1), ..OVERHEAD };
    for (sheets, depth, part) in sheets_to(lamp.centre) {
        let mut room = lamp.room();
        let right = part * lamp.reflected(&room);
        cover(&mut room, &sheets);
        let (mean, error) = seen_of(&room, 16, depth);
        let heights: Vec<f32> = sheets.iter().map(|(height, _)| *height).collect();
        assert!(
            error <= 1e-4 * right,
            "sheets at {heights:?}: the standard error {error:e} proves nothing of {right:e}"
        );
        let off = (mean - right).abs();
        assert!(off <= 2e-3 * right, "sheets at {heights:?}, {depth} segments: {mean:e} seen, {right:e} right");
    }
}

#[test]
fn clear_panes_in_a_furnace_are_invisible() {
    for ni in [1.0, 1.5] {
        let mut room = Room::default();
        let wall = room.material(matte(Vec3::ZERO, Vec3::splat(3.0)));
        room.walls([Some(wall); 6]);
        let clear = room.material(thin(ni, Vec3::ONE));
        room.ball(Vec3::new(0.2, -0.3, -0.5), 0.4, clear);
        room.quad(Vec3::new(-0.9, -0.9, -0.6), 1.8 * Vec3::X, 1.8 * Vec3::Y, clear);
        let mut rig = support::rig();
        room.load(&mut rig).unwrap();
        let got = samples(&mut rig, &TraceParams { layers: 4, ..inside(&room, UVec2::splat(24), 64) });
        let off = got.iter().filter(|sample| (sample.rgb / 3.0 - 1.0).abs().max_element() > 1e-5).count();
        assert!(off * 1000 < got.len(), "Ni {ni}: {off} of {} samples are off", got.len());
    }
}

#[test]
fn a_window_lets_through_what_it_should_and_bends_nothing() {
    // A glowing wall behind a pane in an empty black room: what is seen is what goes through, seen head on.
    let mut room = Room::default();
    let wall = room.material(matte(Vec3::ZERO, Vec3::new(1.0, 2.0, 4.0)));
    room.quad(Vec3::new(-9.0, -9.0, -1.0), 18.0 * Vec3::X, 18.0 * Vec3::Y, wall);
    let filter = Vec3::new(0.9, 0.6, 0.3);
    let window = room.material(thin(1.5, filter));
    room.quad(Vec3::new(-9.0, -9.0, 0.0), 18.0 * Vec3::X, 18.0 * Vec3::Y, window);
    let mut rig = support::rig();
    room.load(&mut rig).unwrap();
    let mut params = TraceParams { layers: 64, ..room.params(UVec2::splat(32)) };
    (params.position, params.forward) = (Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z);
    (params.right, params.up) = (0.01 * Vec3::X, 0.01 * Vec3::Y);
    let got = samples(&mut rig, &params);
    let mean = got.iter().map(|sample| sample.rgb.as_dvec3()).sum::<glam::DVec3>() / got.len() as f64;
    let right = pane::split(1.5, filter.as_dvec3(), 1.0)[1] * glam::DVec3::new(1.0, 2.0, 4.0);
    // 65,536 samples that are all or nothing, with a part of 0.13 mirrored: a deviation of 0.0015 of the mean; five of it.
    assert!((mean / right - 1.0).abs().max_element() < 7.5e-3, "{mean}, not {right}");
}
