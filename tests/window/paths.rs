//! The brightest paths of a pixel: which they are, where they lie on the picture, and what a person does with them.

use std::time::Duration;

use glam::{DVec2, DVec3, UVec2, Vec3};
use lucerna::Engine;
use lucerna::app::window::brightest::{BrightPath, KEPT, SAMPLES, brightest, colours};
use lucerna::app::window::outline::segment;
use lucerna::components::Camera;
use lucerna::cpu::turn::{Met, RayKind, Turn};
use lucerna::engine::TracedPath;
use lucerna::scene;
use lucerna::shader::Library;

#[cfg(target_os = "linux")]
use super::person::Person;
#[cfg(target_os = "linux")]
use super::xvfb::Screenshot;
use crate::support;

const FILM: UVec2 = UVec2::new(64, 48);

fn met(t: f64) -> Option<Met> {
    Some(Met { t, triangle: 0, material: 0, b: DVec2::ZERO })
}

fn ray(kind: RayKind, bounce: u32, from: DVec3, to: DVec3, added: f64) -> Turn {
    let direction = (to - from).normalize();
    Turn {
        kind,
        bounce,
        origin: from,
        direction,
        met: met(from.distance(to)),
        added: DVec3::splat(added),
        ..Turn::default()
    }
}

fn path(sample: u32, radiance: f32, turns: Vec<Turn>) -> TracedPath {
    TracedPath { sample, turns, radiance: Some(Vec3::splat(radiance)), origin: DVec3::new(10.0, 0.0, 0.0) }
}

#[test]
fn the_eight_that_bring_most_are_kept_in_order() {
    let mut paths: Vec<TracedPath> = (0..20).map(|i| path(i, ((i * 7) % 20) as f32, Vec::new())).collect();
    paths.push(TracedPath { radiance: None, ..path(20, 1e9, Vec::new()) });
    paths.push(path(21, 19.0, Vec::new()));
    let bright = brightest(&paths, 1.0);
    let brought: Vec<f32> = bright.iter().map(|path| path.radiance.x).collect();
    assert_eq!(brought, [19.0, 19.0, 18.0, 17.0, 16.0, 15.0, 14.0, 13.0]);
    assert_eq!((bright.len(), bright[1].sample), (KEPT, 21), "of equals the earlier is first");
    let seen = colours(&bright);
    assert_eq!(seen[0], [253, 231, 37]);
    let brightness = |[r, g, b]: [u8; 3]| 2 * u32::from(r) + 5 * u32::from(g) + u32::from(b);
    assert!(seen.windows(2).all(|pair| brightness(pair[0]) >= brightness(pair[1])), "{seen:?}");
    assert!(brightest(&[path(0, 0.0, Vec::new())], 1.0).is_empty(), "what brings nothing is none");
}

/// The ends of the rays that are drawn of a path.
fn ends(path: &BrightPath) -> Vec<(DVec3, DVec3, bool)> {
    path.pieces.chunks(12).map(|ray| (ray[0].from, ray[11].to, ray[0].to_light)).collect()
}

#[test]
fn rays_are_drawn_from_the_first_surface_to_the_last_that_brings_anything() {
    use RayKind::{Segment, Shadow};
    let [eye, a, b, c, lamp] = [0.0, 1.0, 2.0, 3.0, 4.0].map(|x| DVec3::new(x, x * x, -x));
    let turns = vec![
        ray(Segment, 0, eye, a, 0.0),
        // Hidden, and not drawn.
        ray(Shadow, 0, a, lamp, 0.0),
        ray(Segment, 1, a, b, 0.0),
        // Through a pane, and then seen.
        ray(Shadow, 1, b, c, 0.0),
        ray(Shadow, 1, c, lamp, 0.5),
        // Brings nothing more.
        ray(Segment, 2, b, c, 0.0),
    ];
    let origin = DVec3::new(10.0, 0.0, 0.0);
    let drawn = brightest(&[path(3, 1.0, turns)], 1.0).remove(0);
    let right = [(a, b, false), (b, c, true), (c, lamp, true)];
    let found = ends(&drawn);
    assert_eq!((drawn.rays, found.len()), (6, 3));
    for ((from, to, to_light), (right_from, right_to, light)) in found.into_iter().zip(right) {
        assert!(from.distance(origin + right_from) < 1e-9 && to.distance(origin + right_to) < 1e-9);
        assert_eq!(to_light, light);
    }
    // To a sky, as far as is said; and what is seen directly has no line.
    let away = Turn { met: None, ..ray(Segment, 1, a, b, 2.0) };
    let drawn = brightest(&[path(0, 2.0, vec![ray(Segment, 0, eye, a, 0.0), away])], 5.0).remove(0);
    let (from, to, _) = ends(&drawn)[0];
    assert!((from.distance(to) - 5.0).abs() < 1e-9);
    assert!(brightest(&[path(0, 2.0, vec![ray(Segment, 0, eye, a, 2.0)])], 1.0)[0].pieces.is_empty());
}

#[test]
fn a_line_is_cut_where_the_camera_is() {
    let camera =
        Camera { position: DVec3::ZERO, look_at: DVec3::NEG_Z, up: DVec3::Y, fov_y: 90.0, ..Camera::default() };
    let line = |from, to| segment(&camera, FILM, [from, to], 1e-3);
    let ahead = line(DVec3::new(0.0, 0.0, -2.0), DVec3::new(2.0, 2.0, -2.0)).unwrap();
    assert!(
        ahead[0].distance(DVec2::new(32.0, 24.0)) < 1e-9 && ahead[1].distance(DVec2::new(56.0, 0.0)) < 1e-9,
        "{ahead:?}"
    );
    let cut = line(DVec3::new(0.0, 0.0, -2.0), DVec3::new(0.5, 0.0, 2.0)).unwrap();
    assert!(cut.iter().all(|end| end.is_finite()) && cut[0].distance(DVec2::new(32.0, 24.0)) < 1e-9);
    assert!(cut[1].x > 1000.0, "its end lies beside the camera: {cut:?}");
    assert_eq!(line(DVec3::Z, DVec3::new(1.0, 0.0, 3.0)), None);
}

fn open() -> Engine {
    let defines = [("film.size", "(64, 48)"), ("render.spp", "1")];
    let defines = defines.map(|(path, value)| scene::Define::given(path, value));
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/cornell-data.ron");
    let description = scene::load(&path, &defines).unwrap_or_else(|errors| panic!("{errors}")).description;
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    while !engine.step(Duration::from_millis(100)).unwrap().finished {}
    engine
}

#[test]
fn they_are_what_replays_say() {
    let mut engine = open();
    let film = engine.film().unwrap().pixels;
    let pixel = UVec2::new(20, 30);
    let paths = engine.trace_paths(pixel, 0..6).unwrap();
    let replays = engine.replay_all(&(0..6).map(|sample| (pixel, sample)).collect::<Vec<_>>()).unwrap();
    for (path, replay) in paths.iter().zip(&replays) {
        assert_eq!((path.sample, &path.turns), (replay.sample, &replay.gpu));
        assert_eq!((path.radiance, path.origin), (Some(replay.replayed.rgb), replay.origin));
    }
    assert_eq!((paths.len(), engine.film().unwrap().pixels), (6, film), "the film is left alone");
    assert!(engine.trace_paths(FILM, 0..1).unwrap().is_empty(), "there is no such pixel");

    let bright = brightest(&engine.trace_paths(pixel, 0..SAMPLES).unwrap(), 10.0);
    assert_eq!(bright.len(), KEPT);
    // All rays of a scene begin on surfaces, which hide what is just behind them, and not what is on them.
    let (_, camera) = engine.camera().unwrap();
    let first: Vec<DVec3> = bright.iter().filter_map(|path| path.pieces.first()).map(|piece| piece.from).collect();
    assert!(first.len() > 4);
    assert!(engine.hidden(&first).unwrap().iter().all(|hidden| !hidden), "the pixel sees its first surface");
    for path in bright.iter().filter(|path| !path.pieces.is_empty()) {
        let [at, _] = path.pieces[0].on_film(&camera, FILM).unwrap();
        assert!(at.distance(pixel.as_dvec2() + 0.5) < 0.75, "{at} of sample {}", path.sample);
    }
    let behind: Vec<DVec3> = first.iter().map(|point| camera.position + (*point - camera.position) * 1.01).collect();
    assert!(engine.hidden(&behind).unwrap().iter().all(|hidden| *hidden));
    assert_eq!(engine.hidden(&[]).unwrap(), Vec::<bool>::new());
}

#[cfg(target_os = "linux")]
const LOWER_P: u32 = 0x70;
#[cfg(target_os = "linux")]
const LOWER_B: u32 = 0x62;

/// Pixels of the colour of the brightest path: no other is so yellow.
#[cfg(target_os = "linux")]
fn yellow(look: &Screenshot) -> usize {
    let is = |pixel: &&[u8; 3]| pixel[0] > 235 && pixel[1] > 210 && pixel[2] < 70;
    look.pixels.iter().filter(is).count()
}

#[cfg(target_os = "linux")]
#[test]
fn a_person_sees_paths_and_takes_them_away() {
    let mut person = Person::sized("320x240", Some("6"));
    person.finish();
    let bare = person.look();
    assert_eq!(yellow(&bare), 0);
    person.display.point(110, 150);
    std::thread::sleep(Duration::from_millis(150));
    person.display.key(LOWER_P);
    let shown = person.see("the brightest paths of a pixel", |look| yellow(look) > 40);
    assert!(person.display.title(person.window).contains("6 of 6 spp"), "the film is left alone");
    // Esc takes them away, and does not end the window.
    person.display.key(0xff1b);
    person.see("no paths after Esc", |look| *look == bare);
    person.display.key(LOWER_P);
    person.see("the paths again", |look| yellow(look) > 40);
    // The way the film is shown is no edit of the scene.
    person.display.key(LOWER_B);
    person.see("the paths over a brighter picture", |look| yellow(look) > 40 && look.difference(&shown) > 3.0);
    person.display.key(LOWER_P);
    person.see("no paths after P", |look| yellow(look) == 0);
    let stderr = person.quit();
    assert!(!stderr.contains("error"), "{stderr}");
}

#[cfg(target_os = "linux")]
#[test]
fn an_edit_of_the_scene_takes_paths_away() {
    let mut person = Person::files_at("320x240");
    person.see("a picture", |look| !look.is_black());
    person.display.point(110, 150);
    std::thread::sleep(Duration::from_millis(150));
    person.display.key(LOWER_P);
    person.see("the paths before an edit", |look| yellow(look) > 40);
    let scene = person.folder.path().join("cornell-box.mtl");
    let text = std::fs::read_to_string(&scene).unwrap();
    let edited = text.replacen("\nKd ", "\nKd 0.5 0.5 0.5\n# ", 1);
    assert!(edited != text);
    std::fs::write(&scene, edited).unwrap();
    person.see("no paths after the edit", |look| yellow(look) == 0);
    person.quit();
}
