//! Models that move with others, and models with materials of their own.

use glam::{DVec3, Vec3};
use lucerna::scene::{Define, Diagnostics, SceneDescription, load};

const OBJ: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\nusemtl rim\nf 3 2 1\n";
const MTL: &str = "newmtl paint\nKd 0.5 0.5 0.5\nnewmtl rim\nKd 0.1 0.1 0.1\n";

fn read(scene: &str, defines: &[(&str, &str)]) -> Result<SceneDescription, Diagnostics> {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("m.obj", OBJ), ("m.mtl", MTL), ("s.ron", scene)] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let defines: Vec<_> = defines.iter().map(|(path, value)| Define::given(*path, *value)).collect();
    load(&folder.path().join("s.ron"), &defines).map(|loaded| loaded.description)
}

/// Where a model's origin, and its x axis' end, come to.
fn places(description: &SceneDescription, model: &str) -> [DVec3; 2] {
    let mesh = description.meshes.iter().find(|(name, _)| name.split('/').next() == Some(model)).unwrap().1;
    [DVec3::ZERO, DVec3::X].map(|point| mesh.transform.0.transform_point3(point))
}

fn near(a: [DVec3; 2], b: [[f64; 3]; 2]) {
    assert!(a.iter().zip(b).all(|(a, b)| a.distance(b.into()) < 1e-12), "{a:?}, not {b:?}");
}

/// A hand on an arm on a body, in an order that is none.
const ROBOT: &str = "(models: [
    (path: \"m.obj\", name: \"hand\", parent: \"arm\", transform: (translate: (0, 0, 1))),
    (path: \"m.obj\", name: \"body\", transform: (scale: 2, translate: (10, 0, 0))),
    (path: \"m.obj\", name: \"arm\", parent: \"body\", transform: (rotate_y: 90, translate: (0, 5, 0))),
    (path: \"m.obj\"),
    (path: \"m.obj\", parent: \"m\", transform: (translate: (1, 1, 1))),
])";

#[test]
fn children_move_with_their_parents() {
    let robot = read(ROBOT, &[]).unwrap();
    near(places(&robot, "body"), [[10.0, 0.0, 0.0], [12.0, 0.0, 0.0]]);
    // Turned by 90 degrees about y: x goes to -z, z to x.
    near(places(&robot, "arm"), [[10.0, 10.0, 0.0], [10.0, 10.0, -2.0]]);
    near(places(&robot, "hand"), [[12.0, 10.0, 0.0], [12.0, 10.0, -2.0]]);
    // By the name that a model has without one.
    near(places(&robot, "m-2"), [[1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]);
    let moved = read(ROBOT, &[("models.1.transform.translate", "(0, 0, 7)")]).unwrap();
    near(places(&moved, "hand"), [[2.0, 10.0, 7.0], [2.0, 10.0, 5.0]]);
    let freed = read(ROBOT, &[("models.0.parent", "None")]).unwrap();
    near(places(&freed, "hand"), [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]]);
}

#[test]
fn parents_that_can_not_be_are_told_where_they_are_named() {
    let model = |name: &str, parent: &str| format!("(path: \"m.obj\", name: \"{name}\",\nparent: \"{parent}\")");
    let scene = |models: &[String]| format!("(models: [\n{}])", models.join(",\n"));
    for (models, at, message) in [
        (vec![model("a", "b"), model("base", "bse")], "3:9", "there is no model `b` to be a parent"),
        (vec![model("arm", "bode"), "(path: \"m.obj\", name: \"body\")".into()], "3:9", "did you mean `body`?"),
        (vec![model("a", "a")], "3:9", "`a` moves with `a`"),
        (
            vec![model("c", "a"), model("b", "c"), model("a", "b")],
            "7:9",
            "`a` moves with `b` moves with `c` moves with `a`",
        ),
        (vec!["(path: \"m.obj\", parent: 3)".into()], "2:25", "expected a string"),
        (vec!["(path: \"m.obj\", parent: \"\")".into()], "2:25", "found an empty string"),
        (vec!["(path: \"m.obj\", parrent: \"a\")".into()], "2:17", "did you mean `parent`?"),
    ] {
        let errors = read(&scene(&models), &[]).expect_err(message);
        let told = errors.to_string();
        assert!(told.contains(&format!("s.ron:{at}")) && told.contains(message), "{models:?}: {told}");
    }
    // A circle is told once, and so is not each child of it.
    let circle = [model("c", "a"), model("b", "c"), model("a", "b"), model("d", "a")];
    let errors = read(&scene(&circle), &[]).unwrap_err();
    assert_eq!(errors.list.len(), 1, "{errors}");
    let flat = "(models: [(path: \"m.obj\", name: \"a\", transform: (scale: 1e-20)),
        (path: \"m.obj\", parent: \"a\", transform: (scale: 1e-20))])";
    assert!(read(flat, &[]).unwrap_err().to_string().contains("flattens the model"));
}

const PAIR: &str = "(models: [
    (path: \"m.obj\", name: \"left\", materials: { \"paint\": (kd: (1, 0, 0), ns: 7) }),
    (path: \"m.obj\", name: \"right\", materials: { \"paint\": (kd: (0, 1, 0)), \"rim\": (kd: 1) }),
    (path: \"m.obj\", name: \"plain\"),
], materials: { \"paint\": (kd: (0, 0, 1), ks: 0.25), \"left:paint\": (ns: 9) })";

#[test]
fn models_of_one_file_have_paint_of_their_own() {
    let pair = read(PAIR, &[]).unwrap();
    let kd = |name: &str| pair.materials[name].kd;
    assert_eq!([kd("left:paint"), kd("right:paint"), kd("plain:paint")], [Vec3::X, Vec3::Y, Vec3::Z]);
    assert_eq!([kd("left:rim"), kd("right:rim")], [Vec3::splat(0.1), Vec3::ONE]);
    // What only the scene says holds for all; what it says of this one model counts over that one's own.
    assert!(pair.materials.iter().filter(|(name, _)| name.ends_with("paint")).all(|(_, m)| m.ks == Vec3::splat(0.25)));
    assert_eq!(
        (pair.materials["left:paint"].ns, pair.materials["right:paint"].ns),
        (9.0, pair.materials["plain:paint"].ns)
    );
    let changed = read(PAIR, &[("models.1.materials.paint.kd", "0.75")]).unwrap();
    assert_eq!(changed.materials["right:paint"].kd, Vec3::splat(0.75));
}

#[test]
fn mistakes_in_a_models_own_materials_are_told() {
    let scene = |own: &str| format!("(models: [(path: \"m.obj\", name: \"left\", materials: {{\n{own} }})])");
    for (own, at, message) in [
        ("\"pant\": (kd: 1)", "2:9", "did you mean `left:paint`?"),
        ("\"paint\": (kb: 1)", "2:11", "did you mean `kd`?"),
        ("\"paint\": (kd: -1)", "2:15", "models.0.materials.paint.kd: expected a number"),
        ("\"paint\": (map_kd: \"no.png\")", "2:19", "no.png"),
    ] {
        let told = read(&scene(own), &[]).expect_err(own).to_string();
        assert!(told.contains(&format!("s.ron:{at}")) && told.contains(message), "{own}: {told}");
    }
}
