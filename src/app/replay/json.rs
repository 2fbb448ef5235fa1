//! A path as one JSON object.

use std::path::Path;

use serde_json::{Map, Value, json};

use super::names;
use super::third::{Beside, Third};
use super::told::Told;
use crate::cpu::replay::{Parting, Values, numbers_of};
use crate::cpu::turn::{RayKind, Turn};
use crate::engine::{ProbedNumber, ProbedValue};
use crate::layout::trace::{RadianceSample, SAMPLE_BAD};

/// All of it. Numbers that are none are texts.
pub fn json(told: &Told, bundle: Option<&Path>) -> Value {
    let (replay, scene) = (told.replay, told.description);
    let comparison = &replay.verdict.comparison;
    let turns: Vec<Value> = replay.gpu.iter().enumerate().map(|(i, turn)| of_turn(told, i, turn)).collect();
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "scene": scene.name,
        "adapter": told.adapter,
        "size": [scene.film.size.x, scene.film.size.y],
        "pixel": [replay.pixel.x, replay.pixel.y],
        "sample": replay.sample,
        "seed": scene.render.seed,
        "rays": replay.rays,
        "radiance": sample(&replay.replayed),
        "film_kernel": sample(&replay.traced),
        "film": sample(&replay.film),
        "exact": replay.is_exact(),
        "reuse": replay.reuses,
        "agrees": comparison.parting.is_none(),
        "explained": replay.verdict.is_explained(),
        "parting": comparison.parting.as_ref().map(|parting| of_parting(told, parting)),
        "turns": turns,
        "probed": replay.probed.iter().map(|probed| of_probed(replay.rays, probed)).collect::<Vec<Value>>(),
        "all_probed": replay.all_probed,
        "repeat": told.repeat,
        "bundle": bundle.map(|folder| folder.display().to_string()),
    })
}

fn sample(sample: &RadianceSample) -> Value {
    let [x, y, z] = sample.rgb.to_array();
    match sample.info & SAMPLE_BAD {
        0 => json!({ "rgb": [x, y, z], "rays": sample.info }),
        _ => json!({
            "bad": names::fault(x as u32),
            "vertex": y as u32 + 1,
            "material": z as u32,
            "rays": sample.info & !SAMPLE_BAD,
        }),
    }
}

fn of_parting(told: &Told, parting: &Parting) -> Value {
    let why = told.replay.verdict.why.as_ref();
    let row = parting.row.as_ref();
    let turn = told.replay.gpu.get(parting.turn).or(told.replay.verdict.twin.get(parting.turn));
    json!({
        "turn": parting.turn,
        "vertex": turn.map(|turn| turn.bounce + 1),
        "what": parting.name,
        "gpu": row.map(|row| numbers(&row.gpu)),
        "twin": row.map(|row| numbers(&row.twin)),
        "difference": row.map(|row| number(row.difference)),
        "rounding": row.map(|row| number(row.explained)),
        "decided": row.is_none().then(|| names::decided(told.replay, parting)),
        "why": why.map(names::why),
    })
}

fn of_turn(told: &Told, i: usize, turn: &Turn) -> Value {
    let replay = told.replay;
    let twin = replay.verdict.twin.get(i);
    let compared = replay.verdict.comparison.turns.get(i);
    let mut quantities = Map::new();
    for (name, ours) in numbers_of(turn) {
        let right = twin.and_then(|twin| numbers_of(twin).find(|(known, _)| *known == name)).map(|(_, values)| values);
        let row = compared.and_then(|compared| compared.rows.iter().find(|row| row.name == name));
        let value = json!({
            "gpu": numbers(&ours),
            "twin": right.map(|values| numbers(&values)),
            "difference": row.map(|row| number(row.difference)),
            "rounding": row.map(|row| number(row.explained)),
        });
        quantities.insert(name.to_owned(), value);
    }
    let place = turn.met.and_then(|met| replay.place(met.triangle));
    json!({
        "ray": if turn.kind == RayKind::Segment { "segment" } else { "shadow" },
        "vertex": turn.bounce + 1,
        "seen": (turn.kind == RayKind::Shadow).then(|| turn.is_seen()),
        "mesh": place.map(|place| &place.mesh),
        "material": place.map(|place| &place.material),
        "triangle": turn.met.map(|met| met.triangle),
        "triangle_of_mesh": place.map(|place| place.of_mesh),
        "light": turn.light.and_then(|light| light.triangle).map(|triangle| names::triangle(replay, triangle)),
        "goes_on": turn.drawn.map(|drawn| drawn.goes_on),
        "growth": compared.map(|compared| number(compared.growth)),
        "numbers": quantities,
        "oracle": told.third.get(i).and_then(Option::as_ref).map(of_oracle),
    })
}

/// A number that code shows; behind the last ray it is of none.
fn of_probed(rays: u32, probed: &ProbedNumber) -> Value {
    let value = match &probed.value {
        ProbedValue::Numbers(numbers) if numbers.len() == 1 => number(numbers[0].into()),
        ProbedValue::Numbers(numbers) => numbers.iter().map(|x| number((*x).into())).collect(),
        ProbedValue::Whole(whole) => json!(whole),
        ProbedValue::Switch(on) => json!(on),
    };
    let turn = (probed.turn < rays as usize).then_some(probed.turn);
    json!({ "name": probed.name, "vertex": probed.bounce + 1, "turn": turn, "value": value })
}

fn of_oracle(third: &Third) -> Value {
    let beside = |at: &Option<Beside>| {
        at.map(|at| {
            let difference = number(at.difference());
            json!({ "f_cos": at.value.to_array().map(number), "own_pdf": number(at.pdf), "difference": difference })
        })
    };
    json!({
        "t": third.vertex.as_ref().map(|vertex| number(vertex.t)),
        "triangle": third.vertex.as_ref().map(|vertex| vertex.triangle),
        "own_light_pdf": third.vertex.as_ref().map(|vertex| number(vertex.light_pdf)),
        "emitted": third.emitted.to_array().map(number),
        "light": beside(&third.light),
        "drawn": beside(&third.drawn),
    })
}

fn numbers(values: &Values) -> Vec<Value> {
    values.numbers().iter().map(|x| number(*x)).collect()
}

fn number(x: f64) -> Value {
    if x.is_finite() { json!(x) } else { json!(super::numbers::number(x)) }
}
