//! Light of a point that comes through a pane or a veil.

use glam::{DVec3, Vec3};

use super::known::{floor, reflected};
use super::{bulb, glazed};
use crate::light::seen_of;
use crate::pane::{cover, sheets_to};
use crate::path::{both_ways_equal_the_twin, compare_integrators, sees_mistakes};
use crate::rooms::Room;

#[test]
fn what_arrives_has_gone_straight_on() {
    let light = bulb(DVec3::new(1.2, 1.5, 0.4), Vec3::splat(3.0));
    for (sheets, depth, part) in sheets_to(light.position) {
        let mut room = floor(&light);
        cover(&mut room, &sheets);
        // The floor's own light comes back from panes by mirrors: black materials but for it, so nothing does beside.
        let (mean, _) = seen_of(&room, 1, depth);
        let right = part * reflected(&light);
        let heights: Vec<f32> = sheets.iter().map(|(height, _)| *height).collect();
        let off = (mean - right).abs();
        assert!(off <= 2e-3 * right, "sheets at {heights:?}, {depth} segments: {mean:e} seen, {right:e} right");
    }
}

#[test]
fn equals_the_f64_twin() {
    both_ways_equal_the_twin(&glazed());
    let shadow = "passes/trace/shadow";
    let mistakes = [
        (shadow, "params.max_depth - 2u - state.bounce", "0u"),
        (shadow, "let passed = passed_straight(", "let passed = 1.02 * passed_straight("),
        (shadow, "connection.enough = 0.0;", "connection.enough *= 1.0;"),
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
