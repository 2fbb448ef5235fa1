//! Point lights and spots: the real kernel against its twin and closed forms, files that have them, and edits.

mod draws;
mod edits;
mod files;
mod known;
mod panes;
mod picks;

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Energy, Lobe, Material, Passage, PointLight, SpotCone};
use lucerna::layout::sky::SkyTable;
use lucerna::prepare::material;
use lucerna::prepare::point::point_light;
use lucerna::shader::{Features, Library};

use crate::path::{both_ways_equal_the_twin, compare_integrators, sees_mistakes};
use crate::rooms::{Room, matte, shiny};

fn bulb(position: DVec3, intensity: Vec3) -> PointLight {
    PointLight { position, intensity, cone: None }
}

fn spot(position: DVec3, look_at: DVec3, angle: f64, blend: f64) -> PointLight {
    PointLight { position, intensity: Vec3::new(3.0, 4.0, 5.0), cone: Some(SpotCone { look_at, angle, blend }) }
}

/// A room with an open side: a bulb, two spots, a glossy ball, a mirror, and a lamp of triangles.
fn lit() -> Room {
    let mut room = Room { environment: Vec3::new(0.05, 0.1, 0.15), next_event: true, ..Room::default() };
    let white = room.material(matte(Vec3::splat(0.73), Vec3::ZERO));
    let red = room.material(matte(Vec3::new(0.63, 0.06, 0.05), Vec3::splat(0.1)));
    let glossy = room.material(shiny(Vec3::splat(0.4), Vec3::splat(0.5), 33.0));
    let mirror = Material { specular: Vec3::splat(0.8), lobe: Lobe::Mirror, ..Material::BLACK };
    let mirror = room.material(material::pack(&mirror, Energy::Preserve));
    room.walls([Some(red), Some(white), Some(white), Some(white), Some(white), None]);
    room.quad(Vec3::new(-0.9, -0.95, -0.9), Vec3::X, Vec3::Y, mirror);
    room.ball(Vec3::new(0.4, -0.5, 0.0), 0.4, glossy);
    room.lamp();
    let lights = [
        bulb(DVec3::new(-0.4, 0.3, 0.2), Vec3::new(0.5, 0.4, 0.3)),
        spot(DVec3::new(0.8, 0.9, 0.8), DVec3::new(0.3, -0.6, 0.0), 50.0, 0.4),
        spot(DVec3::new(-0.8, 0.9, 0.9), DVec3::new(-0.6, -1.0, 0.0), 25.0, 0.0),
    ];
    room.points = lights.iter().map(|light| point_light(light, DVec3::ZERO)).collect();
    room
}

/// The same with panes and a veil between lights and walls.
pub fn glazed() -> Room {
    let mut room = lit();
    let pack = |values: Material| material::pack(&values, Energy::Preserve);
    let pane = room.material(pack(Material {
        passage: Passage::Pane(1.5),
        filter: Vec3::new(0.8, 0.9, 1.0),
        ..Material::BLACK
    }));
    let veil = Material {
        passage: Passage::SeeThrough(0.6),
        filter: Vec3::new(0.9, 0.7, 0.8),
        diffuse: Vec3::splat(0.3),
        ..Material::BLACK
    };
    let veil = room.material(pack(veil));
    room.quad(Vec3::new(-0.9, -0.9, 0.5), Vec3::new(1.2, 0.0, 0.2), Vec3::Y * 1.7, pane);
    room.quad(Vec3::new(0.1, -0.1, -0.6), Vec3::new(0.8, 0.0, 0.1), Vec3::new(0.0, 0.3, 1.2), veil);
    room.shading.resize(room.triangles.len(), Default::default());
    room.ball(Vec3::new(-0.4, 0.3, 0.2), 0.15, pane);
    room
}

#[test]
fn equals_the_f64_twin() {
    both_ways_equal_the_twin(&lit());
    let pixels: Vec<Vec3> = (0..32).map(|i| Vec3::new(0.1, 0.2, 0.3) * (1.0 + (i % 3) as f32)).collect();
    both_ways_equal_the_twin(&Room { sky: Some(SkyTable::new(UVec2::new(8, 4), &pixels, Vec3::ONE)), ..lit() });
}

#[test]
fn an_error_of_one_percent_is_seen() {
    let mistakes = [
        ("passes/trace/connect", "light.power * params", "1.01 * light.power * params"),
        ("lib/point", "return light.intensity *", "return 1.01 * light.intensity *"),
        ("lib/point", "(3.0 - 2.0 * t)", "(3.1 - 2.1 * t)"),
        ("lib/point", "light.fade_end - 0.5", "light.fade_end - 0.51"),
        ("passes/trace/shadow", "select(weight, 1.0, is_point(drawn))", "select(weight, weight, is_point(drawn))"),
    ];
    sees_mistakes(&lit(), &mistakes);
}

#[test]
fn both_integrators_find_the_same() {
    // By chance the lamp is found with more noise than all else has.
    let mut room = Room { environment: Vec3::splat(3.0), ..lit() };
    room.materials.iter_mut().for_each(|material| material.emission *= 0.05);
    compare_integrators(&room).unwrap();
}

#[test]
fn a_scene_without_them_compiles_none_of_it() {
    let text = |room: &Room| {
        let features: Features = room.features().into_iter().map(str::to_owned).collect();
        Library::shipped().link("passes/trace/path", &features).unwrap().text
    };
    let names = ["point_intensity", "PointLightRecord", "is_point", "BEFORE_POINT"];
    let with = text(&glazed());
    assert!(names.iter().all(|name| with.contains(name)));
    let without = text(&Room { points: Vec::new(), ..glazed() });
    assert!(!names.iter().any(|name| without.contains(name)));
    assert!(with.contains("pass_straight"));
    assert!(!text(&lit()).contains("pass_straight"), "nothing lets light through there");
}
