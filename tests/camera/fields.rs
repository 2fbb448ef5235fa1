//! Lenses in scene files, and what is told of wrong ones.

use glam::{DVec2, DVec3};
use lucerna::components::{Camera, Focus, Lens};
use lucerna::scene::{Define, load};

fn read(fields: &str, defines: &[(&str, &str)]) -> Result<Camera, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.ron");
    let text = format!("(cameras: {{ \"a\": (position: (0, 0, 5), look_at: (0, 0, 0),\n{fields}) }})");
    std::fs::write(&path, text).unwrap();
    let defines: Vec<_> = defines.iter().map(|(path, value)| Define::given(*path, *value)).collect();
    load(&path, &defines).map(|loaded| loaded.description.cameras["a"]).map_err(|errors| errors.to_string())
}

#[test]
fn lenses_are_read() {
    let pinhole = Lens::default();
    for (fields, lens) in [
        ("", pinhole),
        ("aperture: 0.5", Lens { aperture: 0.5, ..pinhole }),
        ("aperture: None, focus: LookAt", pinhole),
        ("focus: Distance(12)", Lens { focus: Focus::Distance(12.0), ..pinhole }),
        ("focus: At((1, 2, 3))", Lens { focus: Focus::At(DVec3::new(1.0, 2.0, 3.0)), ..pinhole }),
        ("focus: At(1, 2, 3)", Lens { focus: Focus::At(DVec3::new(1.0, 2.0, 3.0)), ..pinhole }),
        ("shift: (0.25, -1)", Lens { shift: DVec2::new(0.25, -1.0), ..pinhole }),
    ] {
        assert_eq!(read(fields, &[]).map(|camera| camera.lens), Ok(lens), "{fields}");
    }
    let given = read("aperture: 1", &[("cameras.a.aperture", "0.25"), ("cameras.a.focus", "Distance(3)")]).unwrap();
    assert_eq!(given.lens, Lens { aperture: 0.25, focus: Focus::Distance(3.0), ..pinhole });
}

#[test]
fn wrong_lenses_are_told_where_they_are() {
    for (fields, at, message) in [
        ("aperture: -1", "2:11", "expected a number from 0 to"),
        ("aperture: wide", "2:11", "expected a number"),
        ("aperure: 1", "2:1", "did you mean `aperture`"),
        ("focus: 12", "2:8", "expected Distance(12), At((x, y, z)) or LookAt, found `12`"),
        ("focus: Distance(0)", "2:8", "expected a number from"),
        ("focus: Distance(1, 2)", "2:8", "expected a number"),
        ("focus: At((0, 0))", "2:8", "expected 3 numbers"),
        ("focus: At((0, 0, 6))", "2:8", "not in front of the camera"),
        ("shift: 1", "2:8", "expected 2 numbers"),
        ("shift: (0, 11)", "2:8", "from -10 to 10"),
    ] {
        let told = read(fields, &[]).expect_err(fields);
        assert!(told.contains(&format!("s.ron:{at}")) && told.contains(message), "{fields}: {told}");
    }
}

#[test]
fn the_sharp_plane_is_across_the_view() {
    let camera = Camera { position: DVec3::ZERO, look_at: DVec3::NEG_Z * 5.0, ..Camera::default() };
    let distance = |focus: Focus| Camera { lens: Lens { focus, ..camera.lens }, ..camera }.focus_distance();
    assert_eq!(distance(Focus::LookAt), 5.0);
    assert_eq!(distance(Focus::Distance(2.0)), 2.0);
    assert_eq!(distance(Focus::At(DVec3::new(9.0, 9.0, -3.0))), 3.0);
    // A camera that has passed it.
    assert_eq!(distance(Focus::At(DVec3::new(0.0, 0.0, 3.0))), 5.0);
}
