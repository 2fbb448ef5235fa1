//! A family of scenes that is stepped through and edited while the engine runs: shaders and scene of a member come together or not at
//! all, and every film is that of the member opened fresh.

use std::fs;
use std::path::Path;

use lucerna::app::shared::scene::SceneFlags;
use lucerna::app::window::family::Family;
use lucerna::scene::variants::plan;
use lucerna::scene::{Assets, Loading, attempt_in};
use lucerna::shader::Library;
use lucerna::{Engine, FilmImage};

use super::{Bench, MTL, OBJ, SCENE, STEP, copy};
use crate::support;

const FAMILY: &str = "\
(
    extends: \"scene.ron\",
    sweep: {
        \"materials.floor.kd\": named({ \"grey\": (0.5, 0.5, 0.5), \"red\": (0.7, 0.2, 0.2) }),
        \"shaders\": named({ \"plain\": None, \"narrow\": \"narrow\" }),
    },
)
";

/// In a folder of its own, laid over the shaders of the bench.
const NARROW: &str = "narrow/lib/sampling.wgsl";

/// An engine on a family of its own.
struct Party {
    bench: Bench,
    family: Family,
}

impl Party {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &root.join("shaders"));
        for (name, text) in [("room.obj", OBJ), ("room.mtl", MTL), ("scene.ron", SCENE), ("family.ron", FAMILY)] {
            fs::write(root.join(name), text).unwrap();
        }
        let sampling = fs::read_to_string(root.join("shaders/lib/sampling.wgsl")).unwrap();
        let narrow = sampling.replace("return Angle(sqrt(1.0 - u)", "return Angle(0.5 * sqrt(1.0 - u)");
        assert_ne!(narrow, sampling);
        fs::create_dir_all(root.join("narrow/lib")).unwrap();
        fs::write(root.join(NARROW), narrow).unwrap();
        let flags = SceneFlags { shaders: Some(root.join("shaders")), ..SceneFlags::default() };
        let (family, opened, library) = Family::open(&root.join("family.ron"), &flags).unwrap();
        let mut engine = Engine::open(support::gpu(), library.clone(), &opened.description).unwrap();
        engine.watch(family.sources(opened, library), || {}).unwrap();
        let mut bench = Bench { folder, engine, events: Vec::new() };
        bench.finish();
        Self { bench, family }
    }

    /// The member that runs.
    fn shown(&self) -> &str {
        &self.bench.engine.saved_scene().unwrap().name
    }

    fn names(&self) -> Vec<String> {
        self.family.listing().names().to_vec()
    }

    /// Wants another member, and waits until it is there. Returns what that restarts.
    fn step(&mut self, by: i32) -> String {
        self.family.step(by);
        self.bench.engine.choose_scene();
        self.bench.reloaded()
    }

    /// Finishes the film, which is to be that of the member opened fresh, to the bit.
    #[track_caller]
    fn is_as_fresh(&mut self) -> FilmImage {
        let film = self.bench.film();
        let name = self.shown().to_owned();
        assert!(film.pixels == self.fresh(&name).pixels, "{name}: not the film of an engine that is opened on it");
        film
    }

    fn fresh(&self, name: &str) -> FilmImage {
        let assets = Assets::new();
        let family = plan(&self.bench.path("family.ron"), &[], &assets).unwrap();
        let member = family.members.iter().find(|member| member.name == name).unwrap();
        let (loaded, _) = attempt_in(&family.scene, &member.defines, false, &Loading::default(), &assets);
        let base = Library::open(&self.bench.path("shaders")).unwrap();
        let library = match &member.shaders {
            Some(folder) => Library::open(folder).unwrap().laid_over(&base),
            None => base,
        };
        let mut engine = Engine::open(support::gpu(), library, &loaded.unwrap().description).unwrap();
        while !engine.step(STEP).unwrap().finished {}
        engine.film().unwrap()
    }
}

#[test]
fn steps_through_a_family_end_where_a_fresh_engine_begins() {
    let mut party = Party::new();
    assert_eq!(party.names(), ["grey_plain", "grey_narrow", "red_plain", "red_narrow"]);
    let mut films = vec![party.is_as_fresh()];
    for name in ["grey_narrow", "red_plain", "red_narrow"] {
        assert_eq!(party.step(1), "film");
        assert_eq!(party.shown(), name);
        let film = party.is_as_fresh();
        assert!(films.iter().all(|other| other.pixels != film.pixels), "{name} looks like another");
        films.push(film);
    }
    // Behind the last comes the first; and back.
    party.step(1);
    assert_eq!(party.shown(), "grey_plain");
    party.is_as_fresh();
    party.step(-1);
    assert_eq!(party.shown(), "red_narrow");
    party.is_as_fresh();
    assert_eq!(party.bench.engine.entered()["build_tree"], 1);
}

#[test]
fn edits_of_file_scene_and_shaders_end_where_a_fresh_engine_begins() {
    let mut party = Party::new();
    party.step(1);
    assert_eq!(party.shown(), "grey_narrow");

    // The variant file: a member more, then the one that is shown away.
    party.bench.replace("family.ron", "\"red\":", "\"blue\": (0.1, 0.2, 0.7), \"red\":");
    assert_eq!(party.bench.reloaded(), "nothing");
    assert_eq!(party.names().len(), 6);
    assert_eq!(party.shown(), "grey_narrow");
    party.bench.replace("family.ron", "\"grey\": (0.5, 0.5, 0.5), ", "");
    party.bench.reloaded();
    // What is in its place now.
    assert_eq!((party.names().len(), party.shown()), (4, "blue_narrow"));
    party.is_as_fresh();

    // The scene that it extends, the shaders of the member, and those below them.
    party.bench.replace("scene.ron", "max_depth: 3", "max_depth: 2");
    assert_eq!(party.bench.reloaded(), "film");
    party.is_as_fresh();
    party.bench.replace(NARROW, "0.5 * sqrt", "0.7 * sqrt");
    assert_eq!(party.bench.reloaded(), "film");
    party.is_as_fresh();
    party.bench.replace("shaders/passes/display/display.wgsl", "srgb8(linear)", "srgb8(linear * 0.5)");
    assert_eq!(party.bench.reloaded(), "picture");
    party.is_as_fresh();

    // Another folder for the member that is shown.
    fs::rename(party.bench.path("narrow"), party.bench.path("other")).unwrap();
    party.bench.failed();
    party.bench.replace("family.ron", "\"narrow\": \"narrow\"", "\"other\": \"other\"");
    party.bench.reloaded();
    assert_eq!(party.shown(), "blue_other");
    assert!(party.bench.engine.problems().is_empty());
    party.is_as_fresh();
}

#[test]
fn a_broken_file_leaves_the_member_and_the_list() {
    let mut party = Party::new();
    let before = party.is_as_fresh();
    let good = party.bench.replace("family.ron", "named({ \"grey\"", "nmed({ \"grey\"");
    let (file, line, ..) = party.bench.failed();
    assert_eq!((file.as_str(), line), ("family.ron", 4));
    assert_eq!((party.names().len(), party.shown()), (4, "grey_plain"));
    assert!(party.bench.film().pixels == before.pixels);
    party.bench.write("family.ron", &good);
    assert_eq!(party.bench.reloaded(), "nothing");
    assert!(party.bench.engine.problems().is_empty());

    // A member that can't be loaded: the one that is shown stays, and one can step on from it.
    party.bench.replace("family.ron", "(0.7, 0.2, 0.2)", "(0.7, 0.2)");
    party.bench.reloaded();
    party.family.choose("red_plain");
    party.bench.engine.choose_scene();
    let (file, line, ..) = party.bench.failed();
    assert_eq!((file.as_str(), line), ("family.ron", 4));
    assert_eq!(party.shown(), "grey_plain");
    assert!(party.bench.film().pixels == before.pixels);
    party.step(-1);
    assert_eq!(party.shown(), "grey_narrow");
    assert!(party.bench.engine.problems().is_empty());
    party.is_as_fresh();
}

/// Shaders that don't compile, or don't end: neither they nor their scene are taken up, until both can be.
#[test]
fn a_member_is_never_drawn_by_the_shaders_of_another() {
    for (wrong, message) in [
        ("return Angle(0.5 * sqrt(1.0 - v)", "`v`"),
        ("while (true) { if (u > 2.0) { break; } } return Angle(0.5 * sqrt(1.0 - u)", "does not end"),
    ] {
        let mut party = Party::new();
        let before = party.is_as_fresh();
        let good = party.bench.replace(NARROW, "return Angle(0.5 * sqrt(1.0 - u)", wrong);
        // Both the scene and the shaders are others.
        party.family.choose("red_narrow");
        party.bench.engine.choose_scene();
        let (file, .., told) = party.bench.failed();
        assert!(file == NARROW && told.contains(message), "{file}: {told}");
        assert_eq!(party.shown(), "grey_plain");
        assert!(party.bench.film().pixels == before.pixels, "{message}");
        assert_eq!(party.bench.engine.problems().len(), 1);

        // The scene is saved meanwhile: it waits for the shaders.
        party.bench.replace("scene.ron", "max_depth: 3", "max_depth: 2");
        party.bench.failed();
        assert!(party.bench.film().pixels == before.pixels, "{message}: the scene came without its shaders");

        // Mended: both come, and what was saved meanwhile.
        party.bench.write(NARROW, &good);
        party.bench.reloaded();
        assert_eq!(party.shown(), "red_narrow");
        assert!(party.bench.engine.problems().is_empty());
        party.is_as_fresh();

        // Broken again and left: the member that is stepped to has its own.
        party.step(-1);
        assert_eq!(party.shown(), "red_plain");
        party.bench.replace(NARROW, "return Angle(0.5 * sqrt(1.0 - u)", wrong);
        party.family.step(1);
        party.bench.engine.choose_scene();
        party.bench.failed();
        party.step(-1);
        assert_eq!(party.shown(), "red_plain");
        assert!(party.bench.engine.problems().is_empty());
        party.is_as_fresh();
    }
}
