//! Whatever bytes asset files hold: no panic, little time and memory, and what is accepted keeps the promises of the components.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::path::Path;
use std::time::{Duration, Instant};

use lucerna::components::{Environment, Geometry, MeshData};
use lucerna::scene::{Define, Diagnostic, Diagnostics, Loaded, MtlMaterial, apply, check, load};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use crate::support::patience::thread_time;

/// A case is at most a few KiB, which takes milliseconds of the thread's own processor time, where the system tells it.
const TIME: Duration = Duration::from_secs(5);

/// A case of a few KiB may take this much at once; buffers of fixed size come to 0.5 MB of it.
const MEMORY: isize = 16 << 20;

/// Counts what a thread holds, so that a case can be held to its memory.
struct Counting;

thread_local! {
    /// Bytes held now and at most, by this thread.
    static HELD: Cell<(isize, isize)> = const { Cell::new((0, 0)) };
}

fn count(change: isize) {
    HELD.with(|held| {
        let (now, most) = held.get();
        held.set((now + change, most.max(now + change)));
    });
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

// SAFETY: every call goes to the system's allocator unchanged; counting allocates nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size as isize - layout.size() as isize);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

/// Runs a case within its time and memory.
fn capped<T>(case: impl FnOnce() -> T) -> T {
    let (started, taken) = (Instant::now(), thread_time());
    let (result, most) = held(case);
    let time = taken.zip(thread_time()).map_or_else(|| started.elapsed(), |(before, after)| after - before);
    assert!(time < TIME, "{time:?}");
    assert!(most < MEMORY, "{most} bytes");
    result
}

/// Runs a case, and says how many bytes this thread held at most for it.
pub fn held<T>(case: impl FnOnce() -> T) -> (T, isize) {
    let before = HELD.with(|held| {
        let (now, _) = held.get();
        held.set((now, now));
        now
    });
    let result = case();
    (result, HELD.with(|held| held.get().1) - before)
}

/// The same cases in every run. `test` says whether its files were accepted: at least `accepted` in a hundred must be, and some
/// refused, or the cases test one half only.
fn run<S: Strategy>(cases: u32, accepted: u32, strategy: &S, test: impl Fn(S::Value) -> bool) {
    let cases = if crate::support::stress() { cases * 100 } else { cases };
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let count = Cell::new(0);
    let tested = TestRunner::new_with_rng(config, rng).run(strategy, |value| {
        count.set(count.get() + u32::from(test(value)));
        Ok(())
    });
    if let Err(error) = tested {
        panic!("{error}");
    }
    assert!(count.get() * 100 >= cases * accepted && count.get() < cases, "{} of {cases} accepted", count.get());
}

/// A message must point into its file, and be printable in both ways.
fn check_message(message: &Diagnostic) {
    assert!(!message.message.is_empty());
    if message.line > 0 && message.file != Path::new("-D") {
        let bytes = std::fs::read(&message.file).expect("the file of a message");
        let lines = bytes.split(|byte| matches!(byte, b'\n' | b'\r')).count();
        assert!(message.line as usize <= lines && message.column >= 1, "{message}");
        assert!(message.column as usize <= bytes.len() + 1, "{message}");
    }
    let shown = format!("{message} {:?}", miette::Report::new(message.clone()));
    assert!(shown.len() < 4000, "{} bytes", shown.len());
}

fn check_mesh(mesh: &MeshData) {
    let within = |list: &[[u32; 3]], count: usize| list.iter().flatten().all(|index| (*index as usize) < count);
    assert!(within(&mesh.triangles, mesh.positions.len()) && !mesh.triangles.is_empty());
    assert!(within(&mesh.normal_triangles, mesh.normals.len()) && within(&mesh.uv_triangles, mesh.uvs.len()));
    for list in [&mesh.normal_triangles, &mesh.uv_triangles] {
        assert!(list.is_empty() || list.len() == mesh.triangles.len());
    }
    assert!(mesh.positions.iter().all(|point| point.abs().max_element() <= 1e12));
    assert!(mesh.uvs.iter().all(|uv| uv.is_finite()));
    let used = || mesh.normal_triangles.iter().flatten().map(|index| mesh.normals[*index as usize]);
    assert!(used().all(|normal| normal.is_normalized()));
}

fn check_material(material: &MtlMaterial) {
    for colour in [material.kd, material.ks, material.ke, material.tf] {
        assert!(colour.min_element() >= 0.0 && colour.max_element() <= 1e6, "{material:?}");
    }
    assert!((0.0..=1e5).contains(&material.ns) && (1.0..=100.0).contains(&material.ni));
    assert!((0.0..=1.0).contains(&material.d) && material.illum <= 10);
}

/// Either messages, one of them an error, or a scene that keeps every promise.
fn check_result(result: Result<Loaded, Diagnostics>) -> bool {
    let loaded = match result {
        Ok(loaded) => loaded,
        Err(errors) => {
            assert!(errors.has_errors());
            errors.list.iter().for_each(check_message);
            return false;
        }
    };
    loaded.warnings.iter().for_each(check_message);
    let scene = &loaded.description;
    assert!(scene.cameras.contains_key(&scene.active));
    for camera in scene.cameras.values() {
        let view = (camera.look_at - camera.position).normalize();
        assert!(view.is_finite() && view.cross(camera.up.normalize()).length() > 0.0, "{camera:?}");
        assert!(camera.fov_y > 0.0 && camera.fov_y < 180.0);
    }
    for mesh in scene.meshes.values() {
        check_mesh(&mesh.geometry);
        assert!(scene.materials.contains_key(&mesh.material));
        assert!(mesh.transform.0.matrix3.determinant().abs() > 0.0);
    }
    scene.materials.values().for_each(check_material);
    if let Some(Environment::Constant(radiance)) = scene.environment {
        assert!(radiance.min_element() >= 0.0 && radiance.is_finite());
    }
    let window = scene.film.window();
    assert!(window.min.cmplt(window.max).all() && window.max.cmple(scene.film.size).all());
    let mut world = bevy_ecs::world::World::new();
    apply(&mut world, scene);
    assert_eq!(world.query::<&Geometry>().iter(&world).count(), scene.meshes.len());
    true
}

/// Loads a file from a folder with the given files, and checks the folder. Whether loading succeeded.
fn load_files(files: &[(&str, &[u8])], open: &str, defines: &[Define]) -> bool {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes).expect("a file");
    }
    let path = folder.path().join(open);
    let accepted = check_result(capped(|| load(&path, defines)));
    for message in capped(|| check(folder.path())).diagnostics {
        check_message(&message);
    }
    accepted
}

/// Bytes with some of them changed, left out or doubled: what a broken editor or disk leaves.
fn broken(bytes: Vec<u8>, edits: Vec<(prop::sample::Index, u8, u8)>) -> Vec<u8> {
    edits.into_iter().fold(bytes, |mut bytes, (place, kind, value)| {
        if !bytes.is_empty() {
            let at = place.index(bytes.len());
            match kind % 4 {
                0 => bytes[at] = value,
                1 => drop(bytes.drain(at..(at + value as usize % 8).min(bytes.len()))),
                2 => bytes.insert(at, value),
                _ => {
                    let copy = bytes[at..(at + value as usize).min(bytes.len())].to_vec();
                    bytes.extend(copy);
                }
            }
        }
        bytes
    })
}

/// Words, from lists separated by `|`, joined into a text after `start`. Half of the texts have tame words alone and stay
/// whole, so that acceptance is tested too; the others have any, and may be broken in a few places.
fn soup(start: &'static str, tame: &'static str, wild: &[&'static str], count: usize) -> BoxedStrategy<Vec<u8>> {
    let tame: Vec<&str> = tame.split('|').collect();
    let all: Vec<&str> = wild.iter().flat_map(|words| words.split('|')).chain(tame.iter().copied()).collect();
    let joined = move |words: Vec<&str>| [start, &words.concat()].concat().into_bytes();
    let edits = vec((any::<prop::sample::Index>(), any::<u8>(), any::<u8>()), 0..4);
    let wild = (vec(select(all), 0..count), edits).prop_map(move |(words, edits)| broken(joined(words), edits));
    prop_oneof![vec(select(tame), 0..count).prop_map(joined), wild].boxed()
}

const ENDS: &str = concat!(
    " 0| 1| -1| 2| 3| -2| -3| 0.5| 1e3| -0.0| 1e308| 1e-320| nan| inf| -inf| 1e999| 2147483648| 4294967296|",
    " -9223372036854775808| 99999999999999999999| 0x10| .| +1| 1.| 1/1| 2//1| 3/1/1| -1/-1/-1| //| 1/2/3/4|\n|\n|",
    "\n|\n|\r\n|\r|\\\n|#|\t| |\u{feff}|\0|é| \\| \\ \n| 1.#QNAN| -nan(ind)| -1.#INF|\u{1a}",
);

const OBJ: &str = concat!(
    "v 0.5 0.25 1e-9\n|vn 0 0 1\n|vn 1 0 0\n|vn 0 0 0\n|vt 0 1\n|f 1 2 3\n|f 3 2 1\n|f -1 -2 -3\n|f -4 -3 -2 -1\n|",
    "f 1/1 2/1 3/1\n|f 1//1 2//1 3//1\n|f 1/1/1 2/1/1 3/1/1\n|f 1 2 3 4 5 1 3 2 5 4\n|f 1 1 1\n|o a\n|g b c\n|",
    "g\n|o\n|usemtl red\n|usemtl blue\n|mtllib m.mtl\n|mtllib .\n|s 1\n|s off\n|l 1 2\n|cstype bezier\n|# text\n|",
    "f 1 \\\n 2 3\n|\r\n|vt nan 0\n|v 1e12 0 0\n",
);

const WILD_OBJ: &str = "usemtl \"red\"\n|mtllib a.mtl m.mtl\n|mtllib M.MTL\n|mtllib \"C:\\x\\m.mtl\"\n|\nv|\nvn|\nvt|\nf|usemtl|mtllib|mtllib m.obj\n|p 1\n|what\n|v 0 0 0|f 1 2 7\n";

const MTL: &str = concat!(
    "newmtl red\n|newmtl blue\n|newmtl|\nKd|\nKs|\nKe|\nLe|\nKa|\nNs|\nNi|\nd|\nd -halo|\nTr|\nTf|\nillum|",
    "\nmap_Kd|\nmap_bump -bm|\nbump|\nrefl|\nPr| spectral| xyz| -s| -o| -clamp on| file.png| a b.png| ..\\x|",
    "\nKd 204 26 26\n|\nillum 7\n|\nNi 1.5\n|\nTr 1\n|\nKd 1 1 1\n|\nKe 5\n|\nmap_d -mm 0 1 -s 1 1 1 x.png\n|\nwhat",
);

const RON: &str = concat!(
    "film: (size: (8, 8), crop: (0, 4, 0, 4)),|render: (spp: 3),|materials: { \"red\": (kd: (1, 0, 0), ns: 5) },|",
    "environment: Constant(1),|cameras: { \"a\": (position: (0, 0, 5), look_at: (0, 0, 0)) },|// text\n|/* text */| ",
);

const RON_TOKENS: &str = concat!(
    "(|)|[|]|{|}|,|:|models:|path:|\"m.obj\"|\"scene.ron\"|transform:|scale:|translate:|rotate_x:|matrix:|",
    "cameras:|\"front\":|position:|look_at:|up:|fov_y:|camera:|\"front\"|film:|size:|crop:|exposure:|render:|",
    "integrator:|Bsdf|max_depth:|spp:|seed:|roulette:|true|energy:|Preserve|environment:|Constant|Map|materials:|",
    "\"red\":|\"m:red\":|kd:|ns:|1|0|-1|0.5|1e400|NaN|inf|4294967296|(0, 0, 1)|(1, 1)|None|Some(|'a'|b\"x\"|",
    "r#\"x\"#|// c\n|/* c */|/*|\"|\\|#![enable(implicit_some)]|\u{e9}|\0|name:|Scene|..|1..2|_",
);

const GOOD_OBJ: &[u8] = b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
const GOOD_MTL: &[u8] = b"newmtl red\nKd 1 0 0\n";
const GOOD_RON: &str = r#"(
    models: [(path: "m.obj", transform: (scale: 2, rotate_y: 30, translate: (1, 2, 3)))],
    cameras: { "front": (position: (0, 0, 5), look_at: (0, 0, 0), up: (0, 1, 0), fov_y: 30) },
    film: (size: (64, 32), crop: (0, 16, 4, 8), exposure: 1.5),
    render: (integrator: Bsdf, max_depth: 4, roulette: false, energy: AsWritten, seed: 7, spp: 8),
    environment: Constant((0.5, 0.25, 1)),
    materials: { "red": (ns: 32, ks: 0.5) },
)"#;

#[test]
fn raw_bytes_in_place_of_any_file() {
    run(300, 0, &vec(any::<u8>(), 0..2000), |bytes| {
        load_files(&[("m.obj", &bytes)], "m.obj", &[]);
        load_files(&[("scene.ron", &bytes)], "scene.ron", &[]);
        load_files(&[("m.obj", GOOD_OBJ), ("m.mtl", &bytes)], "m.obj", &[])
    });
}

#[test]
fn obj_statements_in_any_order() {
    let start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nvn 0 0 1\nvt 0 1\nf 1 2 3\n";
    run(800, 30, &soup(start, OBJ, &[WILD_OBJ, ENDS], 120), |bytes| {
        load_files(&[("m.obj", &bytes), ("m.mtl", GOOD_MTL)], "m.obj", &[])
    });
}

#[test]
fn mtl_statements_in_any_order() {
    // Materials are forgiving: only what is no text at all is refused.
    run(800, 50, &soup("", MTL, &[ENDS], 80), |bytes| {
        load_files(&[("m.obj", GOOD_OBJ), ("m.mtl", &bytes)], "m.obj", &[])
    });
}

#[test]
fn ron_fields_in_any_order() {
    let start = "(models: [(path: \"m.obj\")],";
    let tokens = soup(start, RON, &[RON_TOKENS], 12);
    let closed = tokens.prop_map(|bytes| [bytes.as_slice(), b")"].concat());
    run(800, 5, &closed, |bytes| {
        load_files(&[("scene.ron", &bytes), ("m.obj", GOOD_OBJ), ("m.mtl", GOOD_MTL)], "scene.ron", &[])
    });
}

#[test]
fn scene_files_with_a_few_wrong_bytes() {
    let edits = vec((any::<prop::sample::Index>(), any::<u8>(), any::<u8>()), 1..4);
    run(800, 2, &edits, |edits| {
        let bytes = broken(GOOD_RON.as_bytes().to_vec(), edits);
        load_files(&[("scene.ron", &bytes), ("m.obj", GOOD_OBJ), ("m.mtl", GOOD_MTL)], "scene.ron", &[])
    });
}

#[test]
fn any_defines() {
    let paths = "film.size|film.exposure|render.spp|materials.red.ns|materials.\"m:red\".kd|models.0.name|camera|models.1.path|\
                 models||.|film.|é|\"|cameras.a|environment|materials.red";
    let path = select(paths.split('|').collect::<Vec<_>>());
    let values: Vec<&str> = "1|(1, 1)|0.5|front|None|(1, 0, 0)".split('|').chain(RON_TOKENS.split('|')).collect();
    let pair = (path, select(values)).prop_map(|(path, value)| Define::given(path, value));
    run(800, 5, &vec(pair, 0..3), |defines| {
        let files = [("scene.ron", GOOD_RON.as_bytes()), ("m.obj", GOOD_OBJ), ("m.mtl", GOOD_MTL)];
        load_files(&files, "scene.ron", &defines)
    });
}

#[test]
fn deep_nesting_is_refused() {
    for (open, close) in [("(", ")"), ("[", "]"), ("{\"a\":", "}"), ("Some(", ")"), ("(a:", ")")] {
        for depth in [20, 30, 200, 20_000] {
            let text = format!("(film: {}1{})", open.repeat(depth), close.repeat(depth));
            load_files(&[("scene.ron", text.as_bytes())], "scene.ron", &[]);
        }
    }
}

/// A file of a gigabyte is read as a stream: what is held stays in proportion to what is in it.
#[test]
fn a_gigabyte_is_read_or_refused() {
    if !crate::support::stress() {
        return;
    }
    use std::io::Write;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("m.obj");
    let fill = |statement: &[u8]| {
        let mut file = std::io::BufWriter::new(std::fs::File::create(&path).expect("a file"));
        let block = statement.repeat(1 + (1 << 20) / statement.len());
        for _ in 0..1024 {
            file.write_all(&block).expect("space for a gigabyte");
        }
    };
    let fan = ["v 0 0 0\nf", &" 1".repeat(40), "\n"].concat();
    let statements: [(&[u8], bool); 6] = [
        (b"v 0.123456 0.234567 0.345678\nv 1.234567 0 0.123456\nv 0 1.123456 0.123456\nf -1 -2 -3\n", true),
        (fan.as_bytes(), false),
        (b"v 0.1 0.2 0.3\n", false),
        (b"# text\n", false),
        (b"\0", false),
        (b"x", false),
    ];
    for (statement, accepted) in statements {
        fill(statement);
        let before = HELD.with(|held| held.get().0);
        HELD.with(|held| held.set((before, before)));
        let started = Instant::now();
        let result = load(&path, &[]);
        let most = HELD.with(|held| held.get().1) - before;
        eprintln!("{}: {} MB, {:?}", statement.escape_ascii(), most >> 20, started.elapsed());
        assert_eq!(result.is_ok(), accepted);
        // Positions three times over, in pieces, in the file's list and in meshes, and what a growing list copies.
        assert!(most < 6 << 30, "{most} bytes");
    }
}
