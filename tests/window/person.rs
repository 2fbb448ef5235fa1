//! A person at the window: looks, moves, presses keys, leaves it alone, and quits. By real events on a display of its own.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use tempfile::TempDir;
use x11rb::protocol::xproto::Window;

use super::files::cornell_box;
use super::xvfb::{Screenshot, Xvfb, await_some};
use crate::reload::copy;
use crate::support::patience::processor_time;

const F1: u32 = 0xffbe;
const F2: u32 = 0xffbf;
const F12: u32 = 0xffc9;
const ESCAPE: u32 = 0xff1b;
const LOWER_C: u32 = 0x63;
const LOWER_W: u32 = 0x77;
const ONE: u32 = 0x31;

/// Processor time that two ticks of the system's clock, at either end of a span, may add. A single frame takes more.
pub const TICKS: Duration = Duration::from_millis(20);

/// Samples a pixel: the window has to be finished to be compared.
const SPP: &str = "6";

/// A floor and a wall, and light from everywhere.
const OBJ: &str = "\
mtllib room.mtl
v -2 0 -2
v 2 0 -2
v 2 0 2
v -2 0 2
v -2 2 -2
v 2 2 -2
usemtl grey
f 1 4 3 2
f 1 2 6 5
";
const MTL: &str = "newmtl grey\nKd 0.6 0.6 0.6\n";
const SCENE: &str = "\
(
    models: [(path: \"room.obj\")],
    cameras: { \"front\": (position: (0, 1, 5), look_at: (0, 0.7, 0), up: (0, 1, 0), fov_y: 40) },
    film: (size: (24, 16)),
    render: (integrator: Bsdf, sampler: Pcg, roulette: false, max_depth: 3),
    environment: Constant((1, 1, 1)),
)
";

/// The binary with its window, and where it was started.
pub struct Person {
    pub display: Xvfb,
    pub folder: TempDir,
    pub process: Child,
    pub window: Window,
}

impl Person {
    /// Opens the Cornell box in a small window.
    pub fn new(more: &[&str]) -> Self {
        Self::in_folder(tempfile::tempdir().unwrap(), "cornell-box", more)
    }

    /// Opens a copy of it, `scene.ron` with its model, beside a copy of the shaders: files that can be edited.
    pub fn with_files() -> Self {
        Self::in_folder(Self::files(), "scene.ron", &[])
    }

    /// The folder of those files.
    pub fn files() -> TempDir {
        let folder = cornell_box();
        copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &folder.path().join("shaders"));
        folder
    }

    /// Opens a scene file of a folder.
    pub fn in_folder(folder: TempDir, scene: &str, more: &[&str]) -> Self {
        Self::open(folder, scene, &[&["--no-panel", "--size", "192x144", "--spp", SPP], more].concat())
    }

    /// Opens the Cornell box in a window of some size, with so many samples a pixel, or as many as there is time for.
    pub fn sized(size: &str, spp: Option<&str>) -> Self {
        let spp: Vec<&str> = spp.into_iter().flat_map(|spp| ["--spp", spp]).collect();
        Self::open(
            tempfile::tempdir().unwrap(),
            "cornell-box",
            &[&["--no-panel", "--size", size, "--reuse", "off"], &*spp].concat(),
        )
    }

    /// Opens the Cornell box of that size with the panel beside it.
    pub fn with_panel(size: &str) -> Self {
        Self::open(tempfile::tempdir().unwrap(), "cornell-box", &["--size", size, "--spp", SPP])
    }

    /// Opens files that can be edited in a window of some size; its film goes on.
    pub fn files_at(size: &str) -> Self {
        Self::open(Self::files(), "scene.ron", &["--no-panel", "--size", size])
    }

    /// Opens the Cornell box of so many points on a display of two pixels a point.
    pub fn on_a_fine_display(size: &str) -> Self {
        let flags = ["--size", size, "--spp", SPP, "--no-judge"];
        Self::start("2", tempfile::tempdir().unwrap(), "cornell-box", &flags)
    }

    /// Opens files that can be edited, whose edits are judged while nobody touches the window: a scene of next to no noise, of which
    /// few films tell all.
    pub fn judging(size: &str) -> Self {
        let folder = Self::files();
        for (name, text) in [("room.obj", OBJ), ("room.mtl", MTL), ("scene.ron", SCENE)] {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        Self::start("1", folder, "scene.ron", &["--no-panel", "--size", size])
    }

    /// Edits are not judged by themselves, which would take the processor.
    fn open(folder: TempDir, scene: &str, flags: &[&str]) -> Self {
        Self::start("1", folder, scene, &[flags, &["--no-judge"]].concat())
    }

    /// `scale` is pixels a point.
    fn start(scale: &str, folder: TempDir, scene: &str, flags: &[&str]) -> Self {
        let display = Xvfb::start();
        let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
        command.args(["view", scene]).args(flags).current_dir(folder.path());
        command.env("DISPLAY", &display.name).env("WINIT_X11_SCALE_FACTOR", scale);
        command.env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        let file = |name: &str| std::fs::File::create(folder.path().join(name)).unwrap();
        command.stdin(Stdio::null()).stdout(file("stdout")).stderr(file("stderr"));
        let process = command.spawn().unwrap();
        let window = await_some(process.id(), "the window", || display.window("Lucerna"));
        display.focus(window);
        Self { display, folder, process, window }
    }

    pub fn look(&self) -> Screenshot {
        self.display.screenshot(self.window)
    }

    /// Waits for a look at the window that is as wanted. A look that never came is kept where it can be looked at.
    pub fn see(&self, what: &str, wanted: impl Fn(&Screenshot) -> bool) -> Screenshot {
        let kept = std::env::temp_dir().join(format!("lucerna-window{}.png", self.display.name.replace(':', "-")));
        let what_and_where = format!("{what}; the window is in {}", kept.display());
        let seen = await_some(self.process.id(), &what_and_where, || {
            let look = self.look();
            look.write(&kept);
            wanted(&look).then_some(look)
        });
        let _ = std::fs::remove_file(kept);
        // For whoever wants to look at what was seen.
        if let Some(folder) = std::env::var_os("LUCERNA_SCREENSHOTS") {
            seen.write(&Path::new(&folder).join(format!("{}.png", what.replace(' ', "-"))));
        }
        seen
    }

    /// Waits until the film has all its samples.
    pub fn finish(&self) {
        let done = format!("{SPP} of {SPP} spp");
        let finished = || self.display.title(self.window).contains(&done).then_some(());
        await_some(self.process.id(), "the film to be finished", finished);
    }

    /// What the process wrote to stdout.
    pub fn said(&self) -> String {
        std::fs::read_to_string(self.folder.path().join("stdout")).unwrap()
    }

    /// The same picture without a window.
    pub fn rendered(&self, size: &str, more: &[&str]) -> Screenshot {
        self.rendered_by("cornell-box", size, more)
    }

    /// A scene file of the folder without a window.
    pub fn rendered_scene(&self, scene: &str, size: &str) -> Screenshot {
        self.rendered_by(scene, size, &[])
    }

    pub fn rendered_by(&self, scene: &str, size: &str, more: &[&str]) -> Screenshot {
        let file = self.folder.path().join("rendered.png");
        let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
        command.args(["render", scene, "--quiet", "--spp", SPP, "--size", size, "-o"]).arg(&file).args(more);
        let run = command.current_dir(self.folder.path()).output().unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        Screenshot::read(&file)
    }

    /// Presses Esc, and waits for the end. Returns what the process wrote to stderr.
    pub fn quit(&mut self) -> String {
        self.display.key(ESCAPE);
        let status = await_some(self.process.id(), "the end", || self.process.try_wait().unwrap());
        let stderr = std::fs::read_to_string(self.folder.path().join("stderr")).unwrap();
        assert_eq!(status.code(), Some(0), "{stderr}");
        stderr
    }

    /// Processor time of the process so far, all threads together.
    pub fn taken(&self) -> Duration {
        processor_time(self.process.id()).unwrap()
    }

    /// Waits until the process takes no more than `most` of the processor in `time`. When it comes to rest depends on how busy the
    /// machine is, so it may take a while; one that does not rest fails.
    fn rest(&self, what: &str, time: Duration, most: Duration) {
        let spent: Vec<Duration> = (0..40)
            .map(|_| {
                let before = self.taken();
                std::thread::sleep(time);
                self.taken() - before
            })
            .take_while(|spent| *spent > most)
            .collect();
        assert!(spent.len() < 40, "{what}: it took {spent:?} in spans of {time:?}");
    }
}

impl Drop for Person {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// The camera of a printed line: what is behind the name.
pub fn camera_of(line: &str) -> &str {
    line.trim().trim_start_matches("\"front\":").trim().trim_end_matches(',')
}

#[test]
fn a_person_looks_moves_and_leaves() {
    let mut person = Person::new(&[]);
    person.finish();
    let headless = person.rendered("192x144", &[]);
    // Not up to noise: a film does not depend on how it was cut.
    person.see("the picture of the headless render", |look| *look == headless);

    stays_put(&person, &headless);

    person.display.key(F1);
    let bright = |look: &Screenshot| look.pixels.iter().filter(|pixel| pixel.iter().all(|code| *code > 180)).count();
    // The lamp, which the table covers, is brighter than any letter.
    person.see("the keys over the picture", |look| look.difference(&headless) > 10.0 && bright(look) > 100);
    person.display.key(F1);
    person.see("the picture without keys", |look| *look == headless);

    person.display.key(F2);
    person.see("the panel beside the picture", |look| look.difference(&headless) > 10.0);
    person.finish();
    // It looks at the film a last time a second after the one before.
    person.rest("the panel of a finished film", Duration::from_millis(1500), TICKS);
    person.display.key(F2);
    person.see("the picture without the panel", |look| *look == headless);

    orbits_and_resizes(&person, &headless);

    person.display.key(ONE);
    person.display.key(F12);
    let saved = person.folder.path().join("result/cornell-box-1.png");
    let is_saved = || (saved.exists() && saved.with_extension("exr").exists()).then_some(());
    await_some(person.process.id(), "the saved picture", is_saved);

    let stderr = person.quit();
    assert!(!stderr.contains("error"), "{stderr}");
}

/// Keys that were shown in a small window are all there in a large one.
#[test]
fn the_keys_grow_with_the_window() {
    let mut person = Person::sized("200x150", Some(SPP));
    person.finish();
    let bare = person.look();
    person.display.key(F1);
    person.see("some of the keys", |look| look.difference(&bare) > 10.0);
    person.display.resize(person.window, 800, 600);
    let ground = |look: &Screenshot| look.pixels.iter().filter(|pixel| **pixel == [27; 3]).count();
    person.see("all of the keys", |look| look.width == 800 && ground(look) > 150_000);
    person.quit();
}

/// A shader that doesn't compile does not end the window: its error is over the picture, and once in the terminal.
#[test]
fn a_broken_shader_is_shown_over_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    copy(Path::new("shaders"), &folder.path().join("shaders"));
    let shader = folder.path().join("shaders/passes/trace/path.wgsl");
    let broken = std::fs::read_to_string(&shader).unwrap() + "\nfn broken() -> f32 { return 1u; }\n";
    std::fs::write(&shader, broken).unwrap();
    let mut person = Person::in_folder(folder, "cornell-box", &[]);
    let reddish = |pixel: &&[u8; 3]| pixel[0] > 40 && pixel[1] < 20 && pixel[2] < 20;
    person.see("a red box with a message", |look| look.pixels.iter().filter(reddish).count() > 1000);
    // Trying again and again would take all of it.
    person.rest("what failed", Duration::from_millis(500), 6 * TICKS);
    let stderr = person.quit();
    assert_eq!(stderr.matches("shaders/passes/trace/path.wgsl:").count(), 1, "{stderr}");
}

/// A crop keeps its size and shape, with black beside it, whatever the window's.
#[test]
fn a_crop_is_letterboxed() {
    let mut person = Person::new(&["-D", "film.crop=(48, 144, 24, 120)"]);
    person.finish();
    person.display.resize(person.window, 300, 200);
    let headless = person.rendered("192x144", &["--crop", "48,144,24,120"]);
    assert_eq!((headless.width, headless.height), (96, 96));
    let look = person.see("a wider window", |look| look.width == 300 && look.pixels[100 * 300 + 150] != [0; 3]);
    let pixel = |x: u32, y: u32| look.pixels[(y * 300 + x) as usize];
    // 200 x 200 in the middle of it: the crop's pixels, each about twice as large.
    for y in 0..200 {
        assert_eq!((pixel(49, y), pixel(250, y)), ([0; 3], [0; 3]));
        for x in 0..200 {
            let [u, v] = [x, y].map(|at| (2 * at + 1) * 96 / 400);
            assert_eq!(pixel(50 + x, y), headless.pixels[(v * 96 + u) as usize], "at {x}, {y}");
        }
    }
    person.quit();
}

/// A finished film takes no processor time, and the window shows what it did.
fn stays_put(person: &Person, headless: &Screenshot) {
    person.rest("an idle window", Duration::from_millis(1500), TICKS);
    let before = person.taken();
    assert!(person.look() == *headless, "an idle window changed its picture");
    // The pointer's motion is no reason to draw either.
    for x in 20..60 {
        person.display.point(x, 20);
    }
    std::thread::sleep(Duration::from_millis(300));
    let spent = person.taken() - before;
    assert!(spent <= 2 * TICKS, "a pointer over an idle window took {spent:?}");
}

/// After an orbit, a flight and another size, the picture is that of a headless render by the camera that was printed.
fn orbits_and_resizes(person: &Person, headless: &Screenshot) {
    let display = &person.display;
    display.point(90, 70);
    display.button(1, true);
    for step in 1..=8 {
        display.point(90 + 3 * step, 70 + step);
        std::thread::sleep(Duration::from_millis(15));
    }
    display.button(1, false);
    person.see("another view", |look| look.difference(headless) > 10.0);
    display.hold(LOWER_W, true);
    std::thread::sleep(Duration::from_millis(200));
    display.hold(LOWER_W, false);
    display.resize(person.window, 200, 120);
    // It comes to rest, and back to the whole size.
    person.rest("the end of a flight", Duration::from_millis(800), TICKS);
    person.finish();
    display.key(LOWER_C);
    let line = await_some(person.process.id(), "the camera", || person.said().lines().next().map(str::to_owned));
    let define = format!("cameras.front={}", camera_of(&line));
    assert_ne!(define, "cameras.front=");
    let moved = person.rendered("200x120", &["-D", &define]);
    assert!(moved.pixels.iter().filter(|pixel| **pixel != [0; 3]).count() > moved.pixels.len() / 4);
    // Once the notice about the line is gone.
    person.see("the headless render of the printed camera", |look| *look == moved);
}
