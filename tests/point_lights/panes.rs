//! Light of a point that comes through a pane or a veil.

use glam::{DVec3, Vec3};
use lucerna::components::{Energy, Material, Passage, PointLight};
use lucerna::cpu::bsdf::pane;
use lucerna::layout::trace::MaterialRecord;
use lucerna::prepare::material;

use super::known::{floor, reflected};
use super::{bulb, glazed};
use crate::light::{SEEN, seen_of};
use crate::path::{both_ways_equal_the_twin, compare_integrators, sees_mistakes};
use crate::rooms::{Room, matte};

const FILTER: Vec3 = Vec3::new(0.9, 0.6, 0.3);

fn through(passage: Passage) -> MaterialRecord {
    material::pack(&Material { passage, filter: FILTER, ..Material::BLACK }, Energy::Preserve)
}

/// The floor under a light, with sheets of some materials at heights between the two.
fn under(light: &PointLight, sheets: &[(f32, MaterialRecord)]) -> Room {
    let mut room = floor(light);
    for (height, record) in sheets {
        let material = room.material(*record);
        // Above the camera, which looks at the floor from a height of a half.
        room.quad(Vec3::new(-9.0, *height, 9.0), 18.0 * Vec3::X, -18.0 * Vec3::Z, material);
    }
    room
}

#[test]
fn what_arrives_has_gone_straight_on() {
    let light = bulb(DVec3::new(1.2, 1.5, 0.4), Vec3::splat(3.0));
    let to = light.position - SEEN;
    let cos = to.y / to.length();
    let glass = pane::split(1.5, FILTER.as_dvec3(), cos)[1].x;
    let veil = 0.4 * f64::from(FILTER.x);
    let (clear, sheer) = (through(Passage::Pane(1.5)), through(Passage::SeeThrough(0.6)));
    let wall = matte(Vec3::splat(0.5), Vec3::ZERO);
    // Sheets, segments of a path, and the part that arrives.
    let cases: [(&[_], u32, f64); 8] = [
        (&[(0.7, clear)], 3, glass),
        (&[(0.7, sheer)], 3, veil),
        (&[(0.7, clear), (0.8, clear)], 4, glass * glass),
        (&[(0.7, clear), (0.8, sheer), (0.9, clear)], 5, glass * veil * glass),
        // As often as a path may go through on its way to any light.
        (&[(0.7, clear)], 2, 0.0),
        (&[(0.7, clear), (0.8, clear)], 3, 0.0),
        // A wall hides all, on either side of a pane.
        (&[(0.7, clear), (0.9, wall)], 9, 0.0),
        (&[(0.7, wall), (0.9, clear)], 9, 0.0),
    ];
    for (sheets, depth, part) in cases {
        // The floor's own light comes back from panes by mirrors: black materials but for it, so nothing does beside.
        let (mean, _) = seen_of(&under(&light, sheets), 1, depth);
        let right = part * reflected(&light);
        let heights: Vec<f32> = sheets.iter().map(|(height, _)| *height).collect();
        let off = (mean - right).abs();
        assert!(off <= 2e-3 * right, "sheets at {heights:?}, {depth} segments: {mean:e} seen, {right:e} right");
    }
}

#[test]
fn equals_the_f64_twin() {
    both_ways_equal_the_twin(&glazed());
    let path = "passes/trace/path";
    let mistakes = [
        (path, "params.max_depth - 2u - (*state).bounce", "0u"),
        (path, "(*connection).light *= passed_straight(", "(*connection).light *= 1.02 * passed_straight("),
        (path, "connection.enough = 0.0;", "connection.enough *= 1.0;"),
    ];
    sees_mistakes(&glazed(), &mistakes);
}

#[test]
fn both_integrators_find_the_same() {
    // By chance the lamp is found with more noise than all else has.
    let mut room = Room { environment: Vec3::splat(3.0), ..glazed() };
    room.materials.iter_mut().for_each(|material| material.emission *= 0.05);
    compare_integrators(&room).unwrap();
}
