//! Rooms with coats over every lobe, and what a scene without one compiles.

use glam::{UVec2, Vec3};
use lucerna::components::{Energy, Lobe, Material, Passage};
use lucerna::layout::trace::TraceParams;
use lucerna::prepare::material;
use lucerna::shader::{Features, Library};

use crate::path::{both_ways_equal_the_twin, compare_integrators, inside, samples, sees_mistakes};
use crate::rooms::{Room, matte};
use crate::support;

/// Balls and walls under smooth and rough coats, in a room with an open side and a lamp.
fn coated() -> Room {
    let mut room = Room { environment: Vec3::new(0.3, 0.4, 0.5), ..Room::default() };
    let pack = |values: Material| material::pack(&values, Energy::Preserve);
    let white = room.material(matte(Vec3::splat(0.73), Vec3::ZERO));
    let lamp = room.material(matte(Vec3::ZERO, Vec3::new(4.0, 3.0, 2.0)));
    let base = Material { coat: 1.0, ..Material::BLACK };
    let blue = Material { diffuse: Vec3::new(0.1, 0.2, 0.7), ..base };
    let surfaces = [
        blue,
        Material { coat_roughness: 0.4, ..blue },
        Material { diffuse: Vec3::splat(0.3), specular: Vec3::splat(0.5), lobe: Lobe::Phong(30.0), coat: 0.5, ..base },
        Material {
            diffuse: Vec3::new(0.9, 0.6, 0.3),
            metallic: 1.0,
            lobe: Lobe::Ggx(0.5),
            coat_roughness: 0.2,
            passage: Passage::SeeThrough(0.8),
            ..base
        },
        Material {
            diffuse: Vec3::splat(0.2),
            specular: Vec3::splat(0.7),
            lobe: Lobe::Mirror,
            coat_roughness: 0.3,
            ..base
        },
    ];
    let [shiny, satin, plastic, metal, mirror] = surfaces.map(|values| room.material(pack(values)));
    room.walls([Some(white), Some(satin), Some(shiny), Some(white), Some(plastic), None]);
    room.quad(Vec3::new(-0.8, 0.9, -0.8), 1.6 * Vec3::X, 1.6 * Vec3::Z, lamp);
    for (i, material) in [shiny, satin, metal, mirror].into_iter().enumerate() {
        room.ball(Vec3::new(-0.45 + 0.9 * (i % 2) as f32, -0.5 + 0.9 * (i / 2) as f32, -0.2), 0.42, material);
    }
    room
}

#[test]
fn equals_the_f64_twin() {
    both_ways_equal_the_twin(&coated());
}

#[test]
fn an_error_of_one_percent_is_seen() {
    let room = Room { next_event: true, ..coated() };
    let mistakes = [
        ("lib/bsdf/coat", "return m.coat * select(", "return 1.1 * m.coat * select("),
        ("lib/bsdf/coat", "return GgxValue(m.coat * coat_fresnel", "return GgxValue(1.01 * m.coat * coat_fresnel"),
        ("lib/bsdf/coat", "return 1.0 - max(", "return 0.99 - max("),
        ("lib/bsdf/coat", "* at.value, at.pdf);", "* at.value, 1.02 * at.pdf);"),
        ("lib/bsdf/mixture", "coat_reflectance(m, cos_o) / share", "1.01 * coat_reflectance(m, cos_o) / share"),
        ("lib/bsdf/mixture", "pdf = (1.0 - share) * pdf", "pdf = (1.01 - share) * pdf"),
    ];
    sees_mistakes(&room, &mistakes);
}

#[test]
fn asking_lights_changes_no_mean() {
    compare_integrators(&coated()).unwrap();
}

#[test]
fn a_white_room_under_a_smooth_coat_is_a_geometric_series() {
    // Walls that glow by 1 and reflect all: 16 segments gather 16.
    let wall = Material { diffuse: Vec3::ONE, emission: Vec3::ONE, coat: 1.0, ..Material::BLACK };
    let mut room = Room::default();
    let wall = room.material(material::pack(&wall, Energy::Preserve));
    room.walls([Some(wall); 6]);
    let mut rig = support::rig();
    room.load(&mut rig).unwrap();
    let params = TraceParams { layers: 32, ..inside(&room, UVec2::splat(24), 16) };
    let got = samples(&mut rig, &params);
    let mean = got.iter().map(|sample| f64::from(sample.rgb.x)).sum::<f64>() / got.len() as f64;
    // A bounce's weight is from 0 to 1.015 with a mean of 1, and a deviation of 0.04; 18,432 paths of 15 bounces deviate by less than
    // 0.002 of the mean: five of that would be seen.
    assert!((mean / 16.0 - 1.0).abs() < 0.005, "{mean}, not 16");
}

#[test]
fn what_has_no_coat_compiles_none() {
    let library = Library::shipped();
    let grey = Material { diffuse: Vec3::splat(0.5), specular: Vec3::splat(0.3), ..Material::BLACK };
    for lobe in [Lobe::Phong(5.0), Lobe::Ggx(0.5), Lobe::Mirror] {
        // A roughness alone is no coat.
        let mut room = Room { next_event: true, environment: Vec3::ONE, ..Room::default() };
        let plain = Material { lobe, coat_roughness: 0.3, ..grey };
        room.material(material::pack(&plain, Energy::Preserve));
        assert_eq!(room.materials[0], material::pack(&Material { lobe, ..grey }, Energy::Preserve));
        let link = |room: &Room| {
            let features: Features = room.features().into_iter().map(str::to_owned).collect();
            library.link("passes/trace/path", &features).unwrap_or_else(|error| panic!("{}", error.report()))
        };
        let linked = link(&room);
        assert!(!linked.imports.contains("lib/bsdf/coat"), "{lobe:?}");
        room.material(material::pack(&Material { lobe, coat: 0.5, ..grey }, Energy::Preserve));
        assert!(link(&room).imports.contains("lib/bsdf/coat"));
        // The two numbers of a record, in its struct and where it is read, are all there is of it.
        let code: String = linked.text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
        let words = code.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        let of_coats = words.filter(|word| word.to_lowercase().contains("coat"));
        assert!(of_coats.clone().all(|word| matches!(word, "coat" | "coat_alpha")), "{:?}", Vec::from_iter(of_coats));
    }
}
