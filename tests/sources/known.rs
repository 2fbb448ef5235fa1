//! Scenes whose answer is known.

use lucerna::cpu::sources::Way;
use lucerna::engine::ErrorSources;

use super::{load, open, surveyed};

/// A floor that is seen from above, two lamps over it of 0.2 by 0.2 at a height of 1, behind the camera's back, and a ball of glass or none.
const FLOOR: &str = "mtllib a.mtl
v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9
v -0.4 1 -0.1\nv -0.2 1 -0.1\nv -0.2 1 0.1\nv -0.4 1 0.1
v 0.2 1 -0.1\nv 0.4 1 -0.1\nv 0.4 1 0.1\nv 0.2 1 0.1
o floor\nusemtl grey\nf 1 2 3\nf 1 3 4
o noisy\nusemtl bright\nf 5 6 7\nf 5 7 8
o quiet\nusemtl dim\nf 9 10 11\nf 9 11 12\n";

const MATERIALS: &str = "newmtl grey\nKd 0.5 0.5 0.5\nnewmtl bright\nKd 0 0 0\nKe 2 2 2\nnewmtl dim\nKd 0 0 0\nKe 1 1 1\nnewmtl glass\nillum 7\nNi 1.5\n";

fn of(more: &str, defines: &[(&str, &str)]) -> ErrorSources {
    with_lights("", more, defines)
}

/// The same with lights of the scene's file.
fn with_lights(lights: &str, more: &str, defines: &[(&str, &str)]) -> ErrorSources {
    let folder = tempfile::tempdir().unwrap();
    let scene = "(models: [(path: \"a.obj\")], cameras: { \"down\": (position: (0, 0.5, 0), look_at: (0, 0, 0), up: (0, 0, 1), fov_y: 1) },
        film: (size: (96, 96)), render: (spp: 32, max_depth: 2, sampler: Pcg))";
    for (name, text) in [
        ("a.ron", &scene.replace("film:", &format!("{lights} film:"))),
        ("a.obj", &format!("{FLOOR}{more}")),
        ("a.mtl", &MATERIALS.to_owned()),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    surveyed(&mut open(&load(&folder.path().join("a.ron"), defines))).1
}

#[test]
fn of_two_lamps_the_noisy_one_has_its_part_as_binomials_do() {
    let sources = of("", &[("render.integrator", "Bsdf")]);
    // A lamp is found with probability p: cos cos' A / (pi d^2), of its middle, within a hundredth. What is found is 1 or 1/2 there.
    let square = 1.0 + 0.3f64.powi(2);
    let p = 0.04 / (std::f64::consts::PI * square * square);
    let (variance, covariance) = (p - p * p, -p * p);
    let right = (4.0 * variance + 2.0 * covariance) / (5.0 * variance + 4.0 * covariance);
    let (light, share) = &sources.by_light[0];
    assert_eq!((light.as_str(), sources.by_light.len()), ("a/noisy/0", 2));
    assert!(share.deviation < 0.01 && (share.share - right).abs() < 4.0 * share.deviation + 1e-3, "{share:?}, {right}");
    let (way, whole) = &sources.ways[0];
    assert_eq!((way.bounce, way.way, way.surface.as_deref()), (1, Way::Found, Some("a:grey")));
    assert_eq!((way.light.as_str(), whole.share), ("a/noisy/0", share.share));
}

#[test]
fn with_one_way_there_is_one_part() {
    let sources = of("", &[("materials.dim.ke", "(0, 0, 0)")]);
    // MIS: the same light is sampled and found, at one bounce from one surface.
    assert_eq!(sources.by_light.iter().map(|(light, _)| light.as_str()).collect::<Vec<_>>(), ["a/noisy/0"]);
    assert_eq!(sources.by_bounce.iter().map(|(bounce, _)| *bounce).collect::<Vec<_>>(), [1]);
    assert_eq!(sources.by_surface.iter().map(|(name, _)| name.as_deref()).collect::<Vec<_>>(), [Some("a:grey")]);
    assert!(sources.by_light[0].1.share == 1.0);
}

#[test]
fn a_lamp_behind_glass_is_found_through_it() {
    // A slab of glass below the lamps: their light is bent, so light sampling has none of it.
    let slab = "v -9 0.8 -9\nv -9 0.8 9\nv 9 0.8 9\nv 9 0.8 -9\nv -9 0.9 -9\nv -9 0.9 9\nv 9 0.9 9\nv 9 0.9 -9
        o slab\nusemtl glass\nf 13 16 15\nf 13 15 14\nf 17 18 19\nf 17 19 20\n";
    let sources = of(slab, &[("render.max_depth", "5"), ("materials.grey.kd", "(0.2, 0.2, 0.2)")]);
    let (way, share) = &sources.ways[0];
    assert_eq!((way.bounce, way.way, way.surface.as_deref()), (3, Way::Found, Some("a:grey")), "{:?}", sources.ways);
    assert_eq!((way.through.as_deref(), way.light.as_str()), (Some("a:glass"), "a/noisy/0"));
    assert!(share.share > 0.5);
    let (most, whole) = sources.most.unwrap();
    assert_eq!((most.light.as_str(), most.way, most.bounce), ("a/noisy/0", Way::Found, 3));
    assert!(most.through.as_deref() == Some("a:glass") && whole.share >= share.share);
}

#[test]
fn point_lights_have_their_own_names() {
    // One row of the table each, by name; what does not shine has none.
    let scene = "lights: { \"a dark\": Point(position: (0, 1, 0), intensity: 0), \"b\": Point(position: (0, 2, 0.2), intensity: 1),
        \"c\": Point(position: (0, 1, -0.2), intensity: 9) },";
    let sources = with_lights(scene, "", &[("materials.dim.ke", "(0, 0, 0)"), ("materials.bright.ke", "(0, 0, 0)")]);
    let [(near, most), (far, least)] = &sources.by_light[..] else { panic!("{:?}", sources.by_light) };
    // Each sample has one of them, drawn by power: the far one is there where the other, which brings more, is not.
    assert_eq!((near.as_str(), far.as_str()), ("c", "b"));
    assert!(
        most.share > 1.0 && least.share < 0.0 && (most.share + least.share - 1.0).abs() < 1e-9,
        "{most:?} {least:?}"
    );
    assert_eq!(sources.ways[0].0.way, Way::Sampled);
}
