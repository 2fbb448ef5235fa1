//! Numbers that code shows of a path that is replayed: in the order of its calls, and where the twin has the same number, equal to it.

use glam::UVec2;
use lucerna::cpu::turn::{RayKind, Turn};
use lucerna::engine::{ProbedNumber, ProbedValue, Replay};
use lucerna::layout::probe::MOST_PROBED_OF_TURN;
use lucerna::shader::Library;

use super::{open, path_with};

const SMALL: [(&str, &str); 2] = [("film.size", "(24, 18)"), ("render.spp", "1")];

fn number(probed: &ProbedNumber) -> f64 {
    match &probed.value {
        ProbedValue::Numbers(numbers) if numbers.len() == 1 => numbers[0].into(),
        other => panic!("{other:?}"),
    }
}

fn of<'a>(replay: &'a Replay, name: &'a str) -> impl Iterator<Item = &'a ProbedNumber> {
    replay.probed.iter().filter(move |probed| probed.name == name)
}

/// The number of the twin's ray that a probe was on.
fn twin<'a>(replay: &'a Replay, probed: &ProbedNumber) -> &'a Turn {
    let turn = &replay.verdict.twin[probed.turn];
    assert_eq!((turn.bounce, turn.kind), (probed.bounce, RayKind::Segment), "{probed:?}");
    turn
}

#[test]
fn weights_and_densities_are_the_twins() {
    let library = path_with(&[(
        "    if (alive) {\n        (*state).origin",
        "    probe(\"bsdf pdf\", drawn.pdf);\n    probe(\"u\", u);\n    if (alive) {\n        (*state).origin",
    )]);
    let text = library.text("passes/trace/shadow").unwrap().to_owned();
    let weight = "        let arriving = drawn.radiance * (weight / drawn.pdf);\n";
    assert!(text.contains(weight));
    let shown = format!("        probe(\"mis weight\", weight);\n        probe(\"light pdf\", drawn.pdf);\n{weight}");
    let library = library.with("passes/trace/shadow", &text.replace(weight, &shown));
    let mut engine = open(library, "cornell-data", &SMALL);
    let samples: Vec<(UVec2, u32)> = (0..8).map(|i| (UVec2::new(3 + 2 * i, 3 + i), i)).collect();
    let (mut weights, mut densities) = (0, 0);
    for replay in engine.replay_all(&samples).unwrap() {
        assert_eq!(replay.probed.len(), replay.all_probed as usize);
        // Every vertex with a surface drew a direction, and each was heard once.
        let drew = replay.gpu.iter().filter(|turn| turn.drawn.is_some()).count();
        assert_eq!(of(&replay, "bsdf pdf").count(), drew);
        if replay.verdict.comparison.parting.is_some() {
            // By rounding: what follows is of two paths.
            continue;
        }
        let near = |ours: f64, right: f64, what: &str| {
            assert!((ours - right).abs() <= 1e-3 * right.abs().max(1e-3), "{what}: {ours} beside {right}");
        };
        for probed in of(&replay, "mis weight") {
            // What is not sent on is none to the twin.
            if let Some(light) = twin(&replay, probed).light.filter(|light| light.weight > 0.0) {
                near(number(probed), light.weight, "weight");
                weights += 1;
            }
        }
        for probed in of(&replay, "light pdf") {
            if let Some(light) = twin(&replay, probed).light.filter(|light| light.weight > 0.0) {
                near(number(probed), light.pdf, "pdf of the light");
            }
        }
        for probed in of(&replay, "bsdf pdf") {
            if let Some(drawn) = twin(&replay, probed).drawn.filter(|drawn| drawn.pdf > 0.0) {
                near(number(probed), drawn.pdf, "pdf of the direction");
                densities += 1;
            }
        }
        for probed in of(&replay, "u") {
            let u = twin(&replay, probed).drawn.unwrap().u;
            assert_eq!(probed.value, ProbedValue::Numbers(vec![u.x as f32, u.y as f32]));
        }
    }
    assert!(weights > 6 && densities > 10, "{weights} weights, {densities} densities");
}

#[test]
fn calls_are_told_in_their_order_with_their_types() {
    let library = path_with(&[
        (
            "    var state = begin(pixel, sample);\n",
            "    var state = begin(pixel, sample);\n    probe(\"begins\", state.bounce == 0u);\n",
        ),
        ("    return finish(&state);", "    probe(\"rays\", state.rays);\n    return finish(&state);"),
        (
            "    let missed = hit.triangle == NO_HIT;\n",
            "    let missed = hit.triangle == NO_HIT;\n    probe(\"throughput\", (*state).throughput);\n",
        ),
    ]);
    let mut engine = open(library, "cornell-data", &SMALL);
    let replay = engine.replay(UVec2::new(12, 9), 0).unwrap().unwrap();
    let (first, last) = (&replay.probed[0], replay.probed.last().unwrap());
    assert_eq!((first.name.as_str(), &first.value, first.turn), ("begins", &ProbedValue::Switch(true), 0));
    assert_eq!((last.name.as_str(), &last.value), ("rays", &ProbedValue::Whole(replay.rays)));
    assert_eq!(last.turn, replay.rays as usize, "behind the last ray");
    let segments: Vec<&Turn> = replay.gpu.iter().filter(|turn| turn.kind == RayKind::Segment).collect();
    let shown: Vec<&ProbedNumber> = of(&replay, "throughput").collect();
    assert!(segments.len() > 1 && shown.len() == segments.len());
    for (segment, probed) in segments.iter().zip(shown) {
        let right = segment.throughput.as_vec3().to_array().to_vec();
        assert_eq!((&probed.value, probed.bounce), (&ProbedValue::Numbers(right), segment.bounce));
    }
    assert_eq!(engine.replay(UVec2::new(12, 9), 0).unwrap().unwrap().probed, replay.probed);
}

#[test]
fn what_finds_no_room_is_counted() {
    let calls = "    for (var i = 0u; i < 100u; i++) {\n        probe(\"many\", i);\n    }\n";
    let missed = "    let missed = hit.triangle == NO_HIT;\n";
    let mut engine = open(path_with(&[(missed, &format!("{missed}{calls}"))]), "cornell-data", &SMALL);
    let replay = engine.replay(UVec2::new(12, 9), 0).unwrap().unwrap();
    let segments = replay.gpu.iter().filter(|turn| turn.kind == RayKind::Segment).count();
    assert_eq!(replay.all_probed as usize, 100 * segments);
    assert_eq!(replay.probed.len(), MOST_PROBED_OF_TURN as usize * segments);
    let of_first: Vec<ProbedValue> =
        replay.probed.iter().filter(|probed| probed.turn == 0).map(|p| p.value.clone()).collect();
    assert_eq!(of_first, (0..MOST_PROBED_OF_TURN).map(ProbedValue::Whole).collect::<Vec<_>>(), "the first are kept");
}

#[test]
fn shaders_that_show_nothing_have_nothing() {
    let mut engine = open(Library::shipped(), "cornell-data", &SMALL);
    let replay = engine.replay(UVec2::new(12, 9), 0).unwrap().unwrap();
    assert!(replay.probed.is_empty() && replay.all_probed == 0 && engine.probes().is_empty());
}
