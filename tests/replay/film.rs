//! A replay and the film: the same radiance, and nothing of it in the film's kernel.

use glam::UVec2;
use lucerna::cpu::film::fixed_point;
use lucerna::layout::trace::SAMPLE_BAD;
use lucerna::passes::replay::REPLAY;
use lucerna::passes::trace::PATH;
use lucerna::shader::{Features, Library};
use lucerna::systems::resources::Shot;

use super::{SIZE, open, scene_with};

/// A film of one sample has in every pixel what the replay of that sample says.
#[test]
fn the_film_has_what_is_replayed_to_the_bit() {
    for (name, defines) in [
        ("cornell-data", &[][..]),
        ("glass", &[("render.sampler", "Pcg"), ("render.integrator", "Bsdf")]),
        ("cornell-box", &[("render.reuse", "Tiles")]),
    ] {
        let mut engine = open(Library::shipped(), &scene_with(name, defines));
        let film = engine.film().unwrap();
        let exponent = engine.read(|world| world.resource::<Shot>().exponent);
        let pixels: Vec<UVec2> = (0..24).map(|i| UVec2::new(i, (i * 7) % SIZE.y)).collect();
        let samples: Vec<_> = pixels.iter().map(|pixel| (*pixel, 0)).collect();
        let replays = engine.replay_all(&samples).unwrap();
        assert_eq!(engine.film().unwrap().pixels, film.pixels, "a replay changes no film");
        let mut lit = 0;
        for (pixel, replay) in pixels.iter().zip(&replays) {
            let half = film.pixels[(pixel.y * SIZE.x + pixel.x) as usize].halves[0];
            assert_eq!((half.count, replay.film.info & SAMPLE_BAD), (1, 0));
            let right = replay.film.rgb.to_array().map(|channel| fixed_point(channel, exponent).unwrap());
            let held = half.sum.map(|sum| u64::from(sum.y) << 32 | u64::from(sum.x));
            assert_eq!(held, right, "{name}, {pixel}");
            lit += u32::from(held[0] > 0);
            // lavapipe compiles the same arithmetic in both kernels alike.
            let difference = (replay.replayed.rgb - replay.traced.rgb).abs().max_element();
            assert!(difference <= 1e-5 * replay.traced.rgb.max_element(), "{name}, {pixel}: {replay:?}");
            let last = replay.gpu.last().unwrap();
            assert_eq!(last.radiance, replay.replayed.rgb.as_dvec3());
        }
        assert!(lit > 8, "{name}: {lit} pixels have light");
    }
}

#[test]
fn pixels_that_are_not_there_are_none() {
    let mut engine = open(Library::shipped(), &scene_with("cornell-data", &[]));
    assert!(engine.replay(UVec2::new(SIZE.x, 0), 0).unwrap().is_none());
    assert!(engine.replay(UVec2::new(0, SIZE.y - 1), 0).unwrap().is_some());
}

/// Where nothing is recorded, the film's kernel is token by token what it would be if all of recording were struck out.
#[test]
fn the_films_kernel_has_nothing_of_it() {
    let library = Library::shipped();
    let names: Vec<String> = library.modules().map(str::to_owned).collect();
    let mut struck = library.clone();
    let mut lines = 0;
    for name in names {
        let text = library.text(&name).unwrap();
        let is_record = |line: &&str| line.trim_start().starts_with("@if(record");
        lines += text.lines().filter(is_record).count();
        let kept: String = text.lines().filter(|line| !is_record(line)).map(|line| format!("{line}\n")).collect();
        struck = struck.with(&name, &kept);
    }
    assert!(lines > 15, "{lines}");
    let mut sets = library.feature_sets(PATH.module).unwrap();
    sets.retain(|features| !features.contains("record") && !features.contains("probe_view"));
    for features in sets.iter().step_by(7) {
        let [ours, without] = [&library, &struck].map(|library| library.link(PATH.module, features).unwrap());
        assert_eq!(ours.fingerprint(), without.fingerprint(), "{features:?}");
        assert!(!ours.imports.iter().any(|module| module.contains("record")));
    }
    let record: Features = ["record".to_owned()].into();
    let recording = library.link(REPLAY.module, &record).unwrap();
    assert!(recording.imports.contains("lib/record") && recording.text.contains("end_turn(state);"));
}
