//! A model as a scene: all of it in view, and lit.

use std::fmt::Write;
use std::path::Path;

use glam::{DVec3, UVec2};
use lucerna::components::{Camera, Environment};
use lucerna::scene::{Define, SceneDescription, load, reframe};

/// A box between two corners, as an OBJ file.
fn cuboid(low: DVec3, high: DVec3) -> String {
    let mut text = String::from("mtllib m.mtl\nusemtl a\n");
    for i in 0..8 {
        let at = |axis: usize| if i >> axis & 1 == 1 { high[axis] } else { low[axis] };
        writeln!(text, "v {} {} {}", at(0), at(1), at(2)).unwrap();
    }
    text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"
}

fn open(obj: &str, mtl: &str, defines: &[(&str, &str)]) -> SceneDescription {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.obj"), obj).unwrap();
    std::fs::write(folder.path().join("m.mtl"), mtl).unwrap();
    let defines: Vec<_> = defines.iter().map(|(path, value)| Define::given(*path, *value)).collect();
    load(Path::new(&folder.path().join("m.obj")), &defines).unwrap_or_else(|e| panic!("{e}")).description
}

const GREY: &str = "newmtl a\nKd 0.5 0.5 0.5\n";

/// Shapes by their corners: a cube, flat ones of each kind, long ones, tiny, huge, and far from the origin.
const SHAPES: [([f64; 3], [f64; 3]); 10] = [
    ([-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]),
    ([0.0, 0.0, 0.0], [10.0, 0.0, 10.0]),
    ([0.0, 0.0, 0.0], [4.0, 3.0, 0.0]),
    ([2.0, 0.0, 0.0], [2.0, 3.0, 5.0]),
    ([-50.0, 0.0, 0.0], [50.0, 1.0, 1.0]),
    ([0.0, 0.0, -50.0], [1.0, 1.0, 50.0]),
    ([0.0, 0.0, 0.0], [1.0, 300.0, 1.0]),
    ([0.0, 0.0, 0.0], [1e-6, 2e-6, 1e-6]),
    ([0.0, 0.0, 0.0], [1e7, 2e6, 3e6]),
    ([1e6, -1e6, 1e6], [1e6 + 1.0, -1e6 + 1.0, 1e6 + 2.0]),
];

/// Where the points of a model lie in the picture, -1 to 1 from edge to edge: the least and the most along it and up.
fn extents(description: &SceneDescription, camera: &Camera, size: UVec2) -> [[f64; 2]; 2] {
    let forward = (camera.look_at - camera.position).normalize();
    let right = forward.cross(camera.up).normalize();
    let tan = (0.5 * camera.fov_y.to_radians()).tan();
    let aspect = f64::from(size.x) / f64::from(size.y);
    let mut found = [[f64::MAX, f64::MIN]; 2];
    for mesh in description.meshes.values() {
        for point in &mesh.geometry.positions {
            let p = mesh.transform.0.transform_point3(*point) - camera.position;
            let ahead = p.dot(forward);
            assert!(ahead > 0.0, "a point is behind the camera");
            let at = [p.dot(right) / (tan * aspect), p.dot(right.cross(forward)) / tan];
            for (found, at) in found.iter_mut().zip(at) {
                *found = [found[0].min(at / ahead), found[1].max(at / ahead)];
            }
        }
    }
    found
}

fn framed(description: &SceneDescription, size: UVec2, shape: &str) {
    let camera = description.cameras[&description.active];
    let [x, y] = extents(description, &camera, size);
    assert!(x[0] > -1.0 && x[1] < 1.0 && y[0] > -1.0 && y[1] < 1.0, "{shape} at {size}: {x:?}, {y:?} by {camera:?}");
    // As near as it can be, and in the middle along what it fills.
    let fills = |[low, high]: [f64; 2]| (high - low) > 1.8 && (high + low).abs() < 0.02;
    assert!(fills(x) || fills(y), "{shape} at {size}: {x:?}, {y:?}");
    let view = camera.position - camera.look_at;
    assert!(camera.up == DVec3::Y && view.min_element() > 0.0, "{shape}: no three-quarter view: {camera:?}");
}

#[test]
fn all_of_a_model_is_in_view() {
    for (low, high) in SHAPES {
        let obj = cuboid(low.into(), high.into());
        let shape = format!("{low:?} to {high:?}");
        for size in [UVec2::splat(512), UVec2::new(1000, 100), UVec2::new(100, 1000)] {
            let given = format!("({}, {})", size.x, size.y);
            framed(&open(&obj, GREY, &[("film.size", given.as_str())]), size, &shape);
            // Of a size that is given later, such as by a flag.
            let mut later = open(&obj, GREY, &[]);
            let before = std::mem::replace(&mut later.film.size, size);
            reframe(&mut later, before);
            framed(&later, size, &shape);
        }
    }
    // A camera that somebody has moved stays where it is.
    let mut moved = open(&cuboid(DVec3::ZERO, DVec3::ONE), GREY, &[]);
    moved.cameras.values_mut().for_each(|camera| camera.position.x += 1.0);
    let before = moved.cameras.clone();
    moved.film.size = UVec2::new(7, 100);
    reframe(&mut moved, UVec2::splat(512));
    assert_eq!(moved.cameras, before);
}

#[test]
fn a_model_is_lit_by_its_lamps_or_by_day() {
    let obj = cuboid(DVec3::ZERO, DVec3::ONE);
    let glowing = "newmtl a\nKd 0.5 0.5 0.5\nKe 3 3 3\n";
    let unused = "newmtl a\nKd 0.5 0.5 0.5\nnewmtl b\nKe 3 3 3\n";
    let day = |environment: &Option<Environment>| match environment {
        Some(Environment::Daylight(day)) => Some((day.elevation, day.azimuth, day.turbidity)),
        _ => None,
    };
    for mtl in [GREY, unused] {
        assert_eq!(day(&open(&obj, mtl, &[]).environment), Some((45.0, 120.0, 3.0)));
    }
    assert_eq!(open(&obj, glowing, &[]).environment, None);
    // Whatever is asked for counts.
    let hazy = open(&obj, glowing, &[("environment.turbidity", "6")]);
    assert_eq!(day(&hazy.environment), Some((45.0, 120.0, 6.0)));
    let constant = open(&obj, GREY, &[("environment", "Constant(1)")]);
    assert!(matches!(constant.environment, Some(Environment::Constant(_))));
    assert_eq!(open(&obj, GREY, &[("environment", "None")]).environment, None);
}
