//! View "probe": one number of each pixel, chosen by data alone.

use glam::{UVec2, Vec4};
use lucerna::Engine;
use lucerna::cpu::probe::{Histogram, ProbeRange, colour, number, number_at, place, probe_colours};
use lucerna::engine::Probing;
use lucerna::layout::probe::{PROBE_BOOL, PROBE_F32, PROBE_LENGTH, PROBE_U32, PROBE_VEC2, PROBE_VEC3};
use lucerna::layout::view::ViewMode;
use lucerna::passes::probe::ProbeLook;
use lucerna::shader::Library;

use super::{finish, open, path_with};

const SIZE: UVec2 = UVec2::new(24, 18);
const PLAIN: [(&str, &str); 4] =
    [("film.size", "(24, 18)"), ("render.spp", "2"), ("render.integrator", "Bsdf"), ("render.sampler", "Pcg")];

/// Paths that show where they are, twice, and how far they have come.
fn showing() -> Library {
    let missed = "    let missed = hit.triangle == NO_HIT;\n";
    path_with(&[
        (
            "    var state = begin(pixel, sample);\n",
            "    var state = begin(pixel, sample);\n    probe(\"pixel\", vec2f(pixel));\n    probe(\"pixel\", vec2f(-1.0));\n",
        ),
        (
            missed,
            &format!(
                "{missed}    probe(\"bounce\", (*state).bounce);\n    probe(\"t\", hit.t);\n    if (!missed) {{ probe(\"hit\", true); }}\n"
            ),
        ),
    ])
}

fn look(name: &str, look: ProbeLook) -> Option<Probing> {
    Some(Probing { name: name.to_owned(), look })
}

fn choose(engine: &mut Engine, name: &str, shown: ProbeLook) -> Vec<Vec4> {
    engine.set_probe(look(name, shown));
    engine.set_view(ViewMode::Probe);
    finish(engine);
    engine.probe_values().unwrap().unwrap()
}

fn dispatched(engine: &Engine) -> [u64; 3] {
    ["path", "probe", "probe colours"].map(|pass| engine.dispatches().get(pass).copied().unwrap_or(0))
}

#[test]
fn a_pixel_shows_its_first_number_and_another_name_compiles_nothing() {
    let mut engine = open(showing(), "cornell-data", &PLAIN);
    let film = engine.film().unwrap().pixels;
    let [paths, ..] = dispatched(&engine);
    assert_eq!(engine.probe_values().unwrap(), None, "nothing was asked for");
    assert_eq!(dispatched(&engine), [paths, 0, 0]);
    assert!(!engine.compiled().contains_key("probe"), "what nobody looks at is not compiled");

    let pixels = choose(&mut engine, "pixel", ProbeLook::default());
    let right = |i: usize| Vec4::new((i % 24) as f32, (i / 24) as f32, 0.0, (PROBE_VEC2 + 1) as f32);
    assert!(pixels.iter().enumerate().all(|(i, value)| *value == right(i)), "{pixels:?}");
    assert_eq!(dispatched(&engine), [paths, 1, 1], "the film is left alone");
    let compiled = engine.compiled();

    // Another name, bounce and part: data.
    let first = choose(&mut engine, "bounce", ProbeLook::default());
    let whole = (PROBE_U32 + 1) as f32;
    assert!(first.iter().all(|value| *value == Vec4::new(0.0, 0.0, 0.0, whole)));
    let second = choose(&mut engine, "bounce", ProbeLook { bounce: Some(1), ..ProbeLook::default() });
    assert!(second.iter().all(|value| [Vec4::ZERO, Vec4::new(1.0, 0.0, 0.0, whole)].contains(value)));
    assert!(second.iter().any(|value| value.w > 0.0));
    let hit = choose(&mut engine, "hit", ProbeLook::default());
    assert!(
        hit.iter().all(|value| *value == Vec4::ZERO || *value == Vec4::new(1.0, 0.0, 0.0, (PROBE_BOOL + 1) as f32))
    );
    let none = choose(&mut engine, "no such name", ProbeLook::default());
    assert!(none.iter().all(|value| *value == Vec4::ZERO));
    assert_eq!(engine.compiled(), compiled);
    assert_eq!(dispatched(&engine), [paths, 5, 5]);

    // Other colours of the same numbers trace nothing.
    choose(&mut engine, "t", ProbeLook::default());
    choose(&mut engine, "t", ProbeLook { logarithmic: true, ..ProbeLook::default() });
    choose(&mut engine, "t", ProbeLook { range: Some([1.0, 2.0]), ..ProbeLook::default() });
    assert_eq!(dispatched(&engine), [paths, 6, 8]);
    finish(&mut engine);
    assert_eq!(dispatched(&engine), [paths, 6, 8], "what is shown is shown once");
    assert_eq!(engine.compiled(), compiled);
    assert_eq!(engine.film().unwrap().pixels, film);
    engine.set_view(ViewMode::Beauty);
    finish(&mut engine);
    assert_eq!(engine.probe_values().unwrap(), None);
}

#[test]
fn the_picture_is_the_twins_and_its_range_is_that_of_the_numbers() {
    let mut engine = open(showing(), "cornell-data", &PLAIN);
    for shown in [
        ProbeLook::default(),
        ProbeLook { logarithmic: true, ..ProbeLook::default() },
        ProbeLook { range: Some([2.0, 3.0]), ..ProbeLook::default() },
    ] {
        for name in ["t", "pixel", "hit"] {
            let values = choose(&mut engine, name, shown);
            let picture: Vec<[u8; 4]> = engine.picture().unwrap().unwrap();
            let right = probe_colours(&values, &shown.colours(SIZE.x * SIZE.y));
            for ((ours, right), value) in picture.iter().zip(right).zip(&values) {
                let right = right.to_le_bytes();
                assert!(
                    (0..4).all(|c| ours[c].abs_diff(right[c]) <= 1),
                    "{ours:?}, {right:?} of {value} for {shown:?}"
                );
            }
            let has_colours = picture.iter().any(|pixel| *pixel != picture[0]);
            assert!(has_colours || name == "hit" || shown.range.is_some(), "{name}: one colour");
        }
    }
}

#[test]
fn a_pixel_tells_its_numbers_by_bounce() {
    let mut engine = open(showing(), "cornell-data", &PLAIN);
    assert_eq!(engine.probe_pixel(UVec2::ZERO).unwrap(), None, "no name is chosen");
    let whole = choose(&mut engine, "t", ProbeLook::default());
    let picture = dispatched(&engine);
    let compiled = engine.compiled();
    let at = UVec2::new(11, 9);
    let numbers = engine.probe_pixel(at).unwrap().unwrap();
    assert_eq!(numbers.len(), engine.settings().unwrap().1.max_depth as usize);
    assert_eq!(numbers[0], whole[(at.y * SIZE.x + at.x) as usize]);
    let replay = engine.replay(at, 0).unwrap().unwrap();
    let segments: Vec<f32> = replay.gpu.iter().map(|turn| turn.met.map_or(f32::MAX, |met| met.t as f32)).collect();
    for (bounce, value) in numbers.iter().enumerate() {
        match segments.get(bounce) {
            // The kernel that is replayed is another module to the driver.
            Some(t) if *t < f32::MAX => assert!((value.x - t).abs() < 1e-4 * t, "bounce {bounce}: {value} beside {t}"),
            Some(_) => assert!(value.w > 0.0),
            None => assert_eq!(*value, Vec4::ZERO, "the path has ended"),
        }
    }
    assert!(segments.len() > 1);
    // The numbers of the picture are what they were.
    assert_eq!(engine.probe_values().unwrap().unwrap(), whole);
    assert_eq!(dispatched(&engine)[2], picture[2]);
    assert_eq!(engine.compiled().get("probe"), compiled.get("probe"));
    assert_eq!(engine.probe_pixel(SIZE).unwrap(), None, "there is no such pixel");
    engine.set_probe(look("no such name", ProbeLook::default()));
    assert_eq!(engine.probe_pixel(at).unwrap(), None);
}

fn value(x: f32) -> Vec4 {
    Vec4::new(x, 0.0, 0.0, (PROBE_F32 + 1) as f32)
}

#[test]
fn numbers_that_are_none_are_counted_and_are_in_no_range() {
    let values = [value(2.0), value(f32::NAN), Vec4::ZERO, value(-1.0), value(f32::INFINITY), value(0.5)];
    let range = ProbeRange::of(&values, 0);
    assert_eq!(range, ProbeRange { all: Some([-1.0, 2.0]), positive: Some(0.5) });
    assert_eq!([range.ends(false), range.ends(true)], [[-1.0, 2.0], [0.5, 2.0]]);
    let histogram = Histogram::of(&values, &ProbeLook::default().colours(6), 3);
    assert_eq!((histogram.pixels, histogram.shown, histogram.broken), (6, 5, 2));
    assert_eq!((histogram.ends, histogram.bins), ([-1.0, 2.0], vec![1, 1, 1]));
    let none = Histogram::of(&[Vec4::ZERO; 4], &ProbeLook::default().colours(4), 3);
    assert_eq!((none.shown, none.all, none.bins), (0, None, vec![0; 3]));
}

#[test]
fn a_place_and_its_number_belong_together() {
    for (ends, logarithmic) in [([-2.0, 6.0], false), ([0.001, 1000.0], true)] {
        for part in [0.0, 0.125, 0.5, 0.8, 1.0] {
            let x = number_at(part, ends, logarithmic) as f32;
            assert!((place(x, ends, logarithmic) - part).abs() < 1e-6, "{part} {x}");
        }
        assert_eq!([place(-1e30, ends, logarithmic), place(1e30, ends, logarithmic)], [0.0, 1.0]);
    }
    assert_eq!([place(1.0, [1.0; 2], false), place(2.0, [1.0; 2], true), place(0.0, [1.0; 2], false)], [0.5, 1.0, 0.0]);
    assert_eq!((colour(0.0), colour(1.0), colour(0.5)), ([68, 1, 84], [253, 231, 37], [33, 145, 140]));
    let vector = Vec4::new(3.0, 4.0, 12.0, (PROBE_VEC3 + 1) as f32);
    assert_eq!([0, 1, 2, PROBE_LENGTH].map(|part| number(vector, part).unwrap()), [3.0, 4.0, 12.0, 13.0]);
}
