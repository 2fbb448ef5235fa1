//! View "debug": what code shows of itself is the picture, and costs nothing anywhere else.

use std::path::Path;
use std::time::Duration;

use glam::{Vec3, Vec4};
use lucerna::Engine;
use lucerna::components::Film;
use lucerna::engine::DebugRange;
use lucerna::layout::view::ViewMode;
use lucerna::passes::debug::DEBUG;
use lucerna::passes::trace::PATH;
use lucerna::scene;
use lucerna::shader::{Features, Library};

use crate::support;

const WIDTH: usize = 12;
const HEIGHT: usize = 9;

/// The shipped shaders, of which a path shows something where it begins: the second call is the one that counts.
fn showing(colour: &str) -> Library {
    let library = Library::shipped();
    let path = library.text("passes/trace/path").unwrap();
    let import = "import package::lib::fault::{fault_of};";
    let begin = "    state.throughput = vec3<f32>(1.0);\n";
    assert!(path.contains(import) && path.contains(begin));
    let shown = format!("    debug(vec3f(-7.0));\n    debug({colour});\n{begin}");
    let text =
        path.replace(import, &format!("{import}\nimport package::lib::debug::{{debug}};")).replace(begin, &shown);
    library.clone().with("passes/trace/path", &text)
}

fn open(library: Library) -> Engine {
    open_scene(library, "cornell-box", "4")
}

/// Without light sampling, so that its kernels compile soon.
fn open_scene(library: Library, scene: &str, spp: &str) -> Engine {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(scene).with_extension("ron");
    let size = format!("({WIDTH},{HEIGHT})");
    let defines =
        [("film.size", size.as_str()), ("render.spp", spp), ("render.integrator", "Bsdf"), ("render.sampler", "Pcg")];
    let defines = defines.map(|(path, value)| scene::Define::given(path, value));
    let description = scene::load(&path, &defines).unwrap_or_else(|e| panic!("{e:?}")).description;
    Engine::open(support::gpu(), library, &description).unwrap()
}

fn finish(engine: &mut Engine) {
    while !engine.step(Duration::from_millis(100)).unwrap().finished {}
}

fn drawn(engine: &Engine) -> [u64; 2] {
    ["debug", "path"].map(|pass| engine.dispatches().get(pass).copied().unwrap_or(0))
}

#[test]
fn the_picture_is_what_the_first_sample_showed_last() {
    let mut engine = open(showing("vec3f(f32(pixel.x), 0.5, f32(sample + pixel.y) / 8.0)"));
    finish(&mut engine);
    let film = engine.film().unwrap();
    let [_, paths] = drawn(&engine);
    assert_eq!(engine.debug_colours().unwrap(), None, "nothing was asked for");

    engine.set_view(ViewMode::Debug);
    finish(&mut engine);
    assert_eq!(drawn(&engine), [1, paths], "the film is left alone");
    let colours = engine.debug_colours().unwrap().unwrap();
    let right = |i: usize| Vec4::new((i % WIDTH) as f32, 0.5, (i / WIDTH) as f32 / 8.0, 1.0);
    assert!(colours.iter().enumerate().all(|(i, colour)| *colour == right(i)), "{colours:?}");
    let range = DebugRange::of(&colours);
    let pixels = (WIDTH * HEIGHT) as u32;
    let (least, most) = (Vec3::new(0.0, 0.5, 0.0), Vec3::new((WIDTH - 1) as f32, 0.5, 1.0));
    assert_eq!(range, DebugRange { pixels, shown: pixels, broken: 0, least, most });
    // Light as it is, clamped: 0.5 is 188 in sRGB, and no exposure changes that.
    let picture = engine.picture().unwrap().unwrap();
    assert_eq!((picture[0], picture[1]), ([0, 188, 0, 255], [255, 188, 0, 255]));
    engine.edit(|world| world.query::<&mut Film>().iter_mut(world).for_each(|mut film| film.exposure += 2.0));
    finish(&mut engine);
    assert_eq!((drawn(&engine), engine.picture().unwrap().unwrap()), ([1, paths], picture));
    assert_eq!(engine.film().unwrap().pixels, film.pixels);
}

#[test]
fn few_triangles_are_traced_as_for_the_film() {
    let library = Library::shipped();
    let text = library.text("passes/trace/path").unwrap();
    let (import, end) = ("import package::lib::fault::{fault_of};", "    return RadianceSample((*state).radiance,");
    assert!(text.contains(import) && text.contains(end));
    let text = text
        .replace(import, &format!("{import}\nimport package::lib::debug::{{debug}};"))
        .replace(end, &format!("    debug((*state).radiance);\n{end}"));
    let mut engine = open_scene(library.clone().with("passes/trace/path", &text), "cornell-data", "1");
    // The view first: no other kernel has left anything in workgroup memory.
    engine.set_view(ViewMode::Debug);
    engine.step(Duration::from_millis(100)).unwrap();
    let colours = engine.debug_colours().unwrap().unwrap();
    finish(&mut engine);
    assert!(engine.features().contains("few_triangles"));
    let film = engine.film().unwrap().rgb;
    assert!(film.iter().any(|pixel| pixel[0] > 0.0), "some path finds the light");
    let differs = |(pixel, colour): (&[f32; 3], &Vec4)| (Vec3::from(*pixel) - colour.truncate()).abs().max_element();
    let worst = film.iter().zip(&colours).map(differs).fold(0.0, f32::max);
    assert!(worst < 1e-5, "{worst}");
}

#[test]
fn code_that_shows_nothing_has_a_black_view_and_says_so() {
    let mut engine = open(Library::shipped());
    engine.set_view(ViewMode::Debug);
    finish(&mut engine);
    let colours = engine.debug_colours().unwrap().unwrap();
    assert!(colours.iter().all(|colour| *colour == Vec4::ZERO));
    assert_eq!(DebugRange::of(&colours).shown, 0);
    assert!(engine.picture().unwrap().unwrap().iter().all(|pixel| *pixel == [0, 0, 0, 255]));
}

#[test]
fn broken_colours_are_counted_and_count_for_no_bound() {
    let colour = |r: f32| Vec4::new(r, 1.0, 1.0, 1.0);
    let range = DebugRange::of(&[colour(2.0), colour(f32::NAN), Vec4::ZERO, colour(-1.0)]);
    let (least, most) = (Vec3::new(-1.0, 1.0, 1.0), Vec3::new(2.0, 1.0, 1.0));
    assert_eq!(range, DebugRange { pixels: 4, shown: 3, broken: 1, least, most });
}

/// The film's kernel has nothing of it, called or not; only the view's own has.
#[test]
fn what_is_shown_is_compiled_for_the_view_alone() {
    let has = |library: &Library, module: &str, features: &[&str]| {
        let features: Features = features.iter().map(|name| (*name).to_owned()).collect();
        let linked = library.link(module, &features).unwrap();
        let variables = linked.module.global_variables.iter();
        let variable = variables.filter(|(_, variable)| variable.name.as_deref() == Some("debug_colour")).count();
        (variable, linked.text.contains("debug_colour = "))
    };
    let edited = showing("vec3f(1.0)");
    assert_eq!(has(&edited, PATH.module, PATH.features), (0, false));
    assert_eq!(has(&edited, DEBUG.module, DEBUG.features), (1, true));
    let shipped = Library::shipped().link(PATH.module, &Features::new()).unwrap();
    assert!(!shipped.imports.contains("lib/debug") && !shipped.text.contains("debug"));
}
