//! What is saved while the engine runs: taken up whole, or not at all, and only what depends on it starts anew.

mod again;
mod family;
mod guide;
#[cfg(unix)]
mod links;
mod lint;
mod many;
mod parameters;
mod purposes;
mod saves;
mod scenes;
mod slow;
mod table;
mod textures;
mod watch;
mod wrong;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use lucerna::scene;
use lucerna::shader::{Layers, Library};
use lucerna::watch::{ReloadEvent, SceneSource, Sources, WatchedScene};
use lucerna::{Engine, FilmImage};

use crate::support;
use crate::support::patience::Patience;

const STEP: Duration = Duration::from_millis(20);

const OBJ: &str = "\
mtllib room.mtl
v -2 0 -2
v 2 0 -2
v 2 0 2
v -2 0 2
v -1 2 -1
v 1 2 -1
v 1 2 1
v -1 2 1
usemtl floor
f 1 4 3 2
usemtl lamp
f 5 6 7 8
";

const MTL: &str = "newmtl floor\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 3 3 3\n";

/// Kernels without lights asked and without tables compile soonest.
const SCENE: &str = "\
(
    models: [(path: \"room.obj\")],
    cameras: { \"front\": (position: (0, 1, 5), look_at: (0, 1, 0), up: (0, 1, 0), fov_y: 40) },
    film: (size: (24, 16), exposure: 0.0),
    render: (integrator: Bsdf, sampler: Pcg, roulette: false, max_depth: 3, spp: 4),
    materials: { \"floor\": (ns: 1.0) },
)
";

/// Longer than a burst, and than the patience with half-saved files.
const SETTLED: Duration = Duration::from_millis(800);

/// A save that takes longer than this, on a busy machine, may be taken for two.
const QUICK: Duration = Duration::from_millis(300);

/// Saves, and saves again if that was not quick. What is written is another text each time: `save` is told how often it was tried.
fn save_quickly(bench: &mut Bench, mut save: impl FnMut(usize)) {
    for tried in 0..100 {
        let begin = Instant::now();
        save(tried);
        if begin.elapsed() < QUICK {
            return;
        }
        bench.count_for(SETTLED);
    }
    panic!("this machine is too busy to save a file");
}

/// An engine that watches files of its own.
struct Bench {
    folder: tempfile::TempDir,
    engine: Engine,
    events: Vec<ReloadEvent>,
}

impl Bench {
    /// Opens a small scene with a copy of the shipped shaders, and renders it to the end.
    fn new() -> Self {
        Self::opened(|_| {})
    }

    /// The same, of which something is made otherwise before it is opened.
    fn opened(prepare: impl FnOnce(&Path)) -> Self {
        Self::opened_by(prepare, |path| WatchedScene::file(path, Vec::new(), Box::new(|_| {})))
    }

    /// The same, whose scene is read again in a way of its own.
    fn opened_by(prepare: impl FnOnce(&Path), watched: impl FnOnce(PathBuf) -> WatchedScene) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &root.join("shaders"));
        for (name, text) in [("room.obj", OBJ), ("room.mtl", MTL), ("scene.ron", SCENE)] {
            fs::write(root.join(name), text).unwrap();
        }
        prepare(root);
        let path = root.join("scene.ron");
        let loaded = scene::load(&path, &[]).unwrap();
        let library = Library::open(&root.join("shaders")).unwrap();
        let mut engine = Engine::open(support::gpu(), library.clone(), &loaded.description).unwrap();
        let watched = watched(path);
        let scene::Loaded { description, text, files, .. } = loaded;
        let sources = Sources {
            shaders: Some((Layers::folder(root.join("shaders")), library)),
            scene: Some(SceneSource { watched, description, text, files }),
        };
        engine.watch(sources, || {}).unwrap();
        let mut bench = Bench { folder, engine, events: Vec::new() };
        bench.finish();
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// Replaces a part of a file that must be there. Returns the text as it was.
    fn replace(&self, name: &str, from: &str, to: &str) -> String {
        let text = self.read(name);
        assert!(text.contains(from), "{name} has no `{from}`");
        self.write(name, &text.replacen(from, to, 1));
        text
    }

    fn step(&mut self) -> bool {
        let progress = self.engine.step(STEP).unwrap();
        self.events.extend(self.engine.events());
        progress.finished && progress.dispatches == 0
    }

    /// Steps until nothing is left to do.
    fn finish(&mut self) {
        while !self.step() {}
    }

    /// Steps until an event comes that `wanted` takes; returns what it makes of it. Events before it are dropped.
    #[track_caller]
    fn wait<T>(&mut self, what: &str, wanted: impl Fn(&ReloadEvent) -> Option<T>) -> T {
        let mut patience = Patience::here();
        loop {
            for (i, event) in self.events.iter().enumerate() {
                if let Some(found) = wanted(event) {
                    self.events.drain(..=i);
                    return found;
                }
            }
            let moment = patience.moment(&format!("a {what}; only {:?} came", self.events));
            if self.step() {
                std::thread::sleep(moment);
            }
        }
    }

    /// Waits for a reload; returns what it restarts.
    #[track_caller]
    fn reloaded(&mut self) -> String {
        self.wait("reload", |event| match event {
            ReloadEvent::Reloaded { restarts, .. } => Some(restarts.to_string()),
            ReloadEvent::Failed { problems, .. } => panic!("{problems:?}"),
            ReloadEvent::Compiling { .. } | ReloadEvent::FirstPixels { .. } | ReloadEvent::Linted { .. } => None,
        })
    }

    /// Waits for a refusal; returns file, line, column and message of its first problem.
    #[track_caller]
    fn failed(&mut self) -> (String, usize, usize, String) {
        let root = self.folder.path().display().to_string();
        self.wait("failure", |event| match event {
            ReloadEvent::Failed { problems, .. } => {
                let problem = &problems[0];
                let file = problem.file.clone().unwrap_or_default().replace(&root, "");
                let file = file.trim_start_matches(['/', '\\']).to_owned();
                Some((file, problem.line, problem.column, problem.message.clone()))
            }
            _ => None,
        })
    }

    /// Waits for so long, and says how many reloads and failures there were.
    fn count_for(&mut self, time: Duration) -> (usize, usize) {
        let begin = Instant::now();
        while begin.elapsed() < time {
            self.step();
            std::thread::sleep(Duration::from_millis(2));
        }
        let events = std::mem::take(&mut self.events);
        let count = |test: fn(&ReloadEvent) -> bool| events.iter().filter(|event| test(event)).count();
        (
            count(|event| matches!(event, ReloadEvent::Reloaded { .. })),
            count(|event| matches!(event, ReloadEvent::Failed { .. })),
        )
    }

    /// Finishes the film, and returns it.
    fn film(&mut self) -> FilmImage {
        self.finish();
        self.engine.film().unwrap()
    }

    /// The film of an engine that is opened on the files as they are.
    fn fresh_film(&self) -> FilmImage {
        let library = Library::open(&self.path("shaders")).unwrap();
        let description = scene::load(&self.path("scene.ron"), &[]).unwrap().description;
        let mut engine = Engine::open(support::gpu(), library, &description).unwrap();
        while !engine.step(STEP).unwrap().finished {}
        engine.film().unwrap()
    }

    /// Dispatches of each pass while `work` is done and the film finished.
    fn dispatches(&mut self, work: impl FnOnce(&mut Self)) -> BTreeMap<&'static str, u64> {
        let before = self.engine.dispatches().clone();
        work(self);
        self.finish();
        let after = self.engine.dispatches().clone();
        let grown = after.into_iter().map(|(pass, count)| (pass, count - before.get(pass).copied().unwrap_or(0)));
        grown.filter(|(_, count)| *count > 0).collect()
    }
}

/// Copies a folder with all that is in it.
pub fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &target);
        } else {
            fs::write(target, fs::read(&path).unwrap()).unwrap();
        }
    }
}
