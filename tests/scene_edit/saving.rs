//! Saves as the window does them: only over the text that was read, whole, and for a model beside it.

use std::path::Path;

use glam::{DVec3, Vec3};
use lucerna::app::window::scene_file::{Kept, Unsaved, save, save_model};
use lucerna::scene::{Assets, Define, SceneDescription, load};

use super::{assert_same, folder, read};

const SCENE: &str =
    "// A square.\r\n(\r\n    models: [(path: \"square.obj\")],\r\n    film: (exposure: 1), // bright\r\n)\r\n";

fn kept(path: &Path) -> Kept {
    let (description, text) = read(path, &Assets::new());
    Kept { text, description }
}

fn exposed(kept: &Kept, exposure: f32) -> SceneDescription {
    let mut now = kept.description.clone();
    now.film.exposure = exposure;
    now
}

#[test]
fn a_save_keeps_the_mark_and_goes_out_from_the_last_one() {
    let folder = folder(&[("s.ron", &format!("\u{feff}{SCENE}"))]);
    let path = folder.path().join("s.ron");
    let taken = kept(&path);
    let first = save(&taken, None, &exposed(&taken, 2.0)).expect("a save");
    assert_eq!((first.path.as_path(), first.edited.summary().as_str()), (&*path, "1 value changed (film.exposure)"));
    let wanted = |exposure: &str| format!("\u{feff}{SCENE}").replace("exposure: 1", &format!("exposure: {exposure}"));
    assert_eq!(std::fs::read_to_string(&path).expect("a file"), wanted("2"));
    // Before the first is taken up.
    let second = save(&taken, Some(&first.kept), &exposed(&taken, 3.0)).expect("a save");
    assert_eq!(std::fs::read_to_string(&path).expect("a file"), wanted("3"));
    let nothing = save(&taken, Some(&second.kept), &exposed(&taken, 3.0)).expect("a save");
    assert_eq!(nothing.edited.summary(), "nothing to save");
}

/// What the command line says is not the file's.
#[test]
fn values_of_the_command_line_are_not_written() {
    let folder = folder(&[("s.ron", SCENE)]);
    let path = folder.path().join("s.ron");
    let defines = [("film.exposure", "3"), ("render.seed", "9"), ("materials.red.kd", "0.25")];
    let loaded = load(&path, &defines.map(|(path, value)| Define::given(path, value))).expect("a scene");
    let taken = Kept { text: loaded.text, description: loaded.description };
    let mut now = taken.description.clone();
    now.film.tone = lucerna::components::Tone::Agx;
    now.materials.get_mut("square:red").expect("a material").pm = 0.5;
    save(&taken, None, &now).expect("a save");
    let wanted = SCENE
        .replace("exposure: 1)", "exposure: 1, tone: Agx)")
        .replace("\r\n)", "\r\n    materials: {\r\n        \"red\": (pm: 0.5),\r\n    },\r\n)");
    assert_eq!(std::fs::read_to_string(&path).expect("a file"), wanted);
}

#[test]
fn a_file_that_is_another_one_now_is_not_written_over() {
    let folder = folder(&[("s.ron", SCENE)]);
    let path = folder.path().join("s.ron");
    let taken = kept(&path);
    let other = SCENE.replace("bright", "dark");
    std::fs::write(&path, &other).expect("a file");
    let refused = save(&taken, None, &exposed(&taken, 2.0)).expect_err("another text");
    assert!(matches!(refused, Unsaved::Changed(_)), "{refused}");
    assert_eq!(std::fs::read_to_string(&path).expect("a file"), other);
    std::fs::write(&path, [0xff, 0xfe]).expect("a file");
    assert!(matches!(save(&taken, None, &exposed(&taken, 2.0)), Err(Unsaved::Changed(_))));
    std::fs::remove_file(&path).expect("a file");
    assert!(matches!(save(&taken, None, &exposed(&taken, 2.0)), Err(Unsaved::Read { .. })));
}

#[test]
fn a_file_that_may_not_be_written_is_left_as_it_is() {
    let folder = folder(&[("s.ron", SCENE)]);
    let path = folder.path().join("s.ron");
    let taken = kept(&path);
    let mut permissions = std::fs::metadata(&path).expect("a file").permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&path, permissions).expect("permissions");
    let refused = save(&taken, None, &exposed(&taken, 2.0)).expect_err("a file that may not be written");
    assert!(matches!(refused, Unsaved::ReadOnly(_)), "{refused}");
    assert_eq!(std::fs::read_to_string(&path).expect("a file"), SCENE);
}

#[cfg(unix)]
#[test]
fn links_and_permissions_stay() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder(&[("real.ron", SCENE)]);
    let (real, link) = (folder.path().join("real.ron"), folder.path().join("s.ron"));
    std::fs::set_permissions(&real, PermissionsExt::from_mode(0o600)).expect("permissions");
    std::os::unix::fs::symlink("real.ron", &link).expect("a link");
    let taken = kept(&link);
    save(&taken, None, &exposed(&taken, 2.0)).expect("a save");
    assert!(link.symlink_metadata().expect("a link").is_symlink());
    assert_eq!(std::fs::read_to_string(&real).expect("a file"), SCENE.replace("exposure: 1", "exposure: 2"));
    assert_eq!(real.metadata().expect("a file").permissions().mode() & 0o777, 0o600);
}

#[test]
fn a_model_by_itself_is_saved_beside_it_as_it_is_seen() {
    let folder = folder(&[]);
    let model = folder.path().join("square.obj");
    let taken = load(&model, &[Define::given("render.seed", "5")]).expect("a model").description;
    let mut now = taken.clone();
    now.film.size = glam::UVec2::new(200, 100);
    now.cameras.get_mut("default").expect("a camera").position += DVec3::new(0.1, 1.0 / 3.0, 0.0);
    now.materials.get_mut("square:red").expect("a material").kd = Vec3::new(0.1, 0.2, 0.3);
    let saved = save_model(&model, &taken, None, &now).expect("a save");
    let path = folder.path().join("square.ron");
    assert!(saved.is_new && saved.path == path);
    let (again, text) = read(&path, &Assets::new());
    assert_same(&again, &now, text.text().expect("a text"));
    assert!(text.text().expect("a text").contains("// \"my.mat"), "what may be changed is listed");
    // Later saves go into the same file; one that somebody else made is left alone.
    let mut later = now.clone();
    later.film.exposure = 1.5;
    let second = save_model(&model, &taken, Some(&saved.kept), &later).expect("a save");
    assert!(!second.is_new);
    assert_same(&read(&path, &Assets::new()).0, &later, "");
    let refused = save_model(&model, &taken, None, &now).expect_err("a file that is there");
    assert!(matches!(refused, Unsaved::IsThere(_)), "{refused}");
}
