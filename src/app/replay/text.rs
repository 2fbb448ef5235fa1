//! A path for a reader: a block a vertex, the GPU's numbers beside the twin's, in 100 columns.

use std::fmt::Write;
use std::path::Path;

use super::names;
use super::numbers::{column, number, part};
use super::third::{Beside, Third};
use super::told::Told;
use crate::cpu::replay::{Values, numbers_of};
use crate::cpu::turn::{RayKind, Turn};
use crate::engine::ProbedNumber;
use crate::layout::trace::{RadianceSample, SAMPLE_BAD};

/// All of it; `bundle` is the folder that was written.
pub fn text(told: &Told, bundle: Option<&Path>) -> String {
    let mut text = head(told);
    for (i, turn) in told.replay.gpu.iter().enumerate() {
        text += "\n";
        text += &block(told, i, turn);
        text += &shown(told, i);
    }
    if told.replay.rays as usize > told.replay.gpu.len() {
        let _ = writeln!(text, "\nand {} rays more", told.replay.rays as usize - told.replay.gpu.len());
    }
    let behind = shown(told, told.replay.rays as usize);
    if !behind.is_empty() {
        let _ = write!(text, "\nbehind the last ray\n{behind}");
    }
    let (kept, all) = (told.replay.probed.len(), told.replay.all_probed as usize);
    if all > kept {
        let _ = writeln!(text, "\nand {} numbers more that code shows: {kept} are kept", all - kept);
    }
    if let Some(folder) = bundle {
        let _ = writeln!(text, "\nwritten to {}: its README.md has the command", folder.display());
    }
    text
}

fn head(told: &Told) -> String {
    let (replay, size) = (told.replay, told.description.film.size);
    let mut text = format!(
        "{}: pixel {},{} of {}x{}, sample {}, seed {}: {} rays\n  {}\n",
        told.description.name,
        replay.pixel.x,
        replay.pixel.y,
        size.x,
        size.y,
        replay.sample,
        told.description.render.seed,
        replay.rays,
        told.adapter,
    );
    let _ = writeln!(text, "radiance  {}", sample(&replay.replayed));
    let _ = match replay.is_exact() {
        true if replay.reuses => {
            writeln!(text, "  the film's kernel has the same, to the bit, before the pixel gathers")
        }
        true => writeln!(text, "  the film gets the same, to the bit"),
        false => writeln!(text, "  the film's kernel is compiled otherwise, and has {}", sample(&replay.traced)),
    };
    if replay.reuses {
        let _ = writeln!(
            text,
            "paths are reused: this is the pixel's own path, without what it gathers; with that the film gets\n          {}",
            sample(&replay.film)
        );
    }
    text += &verdict(told);
    text
}

/// Radiance, or what is wrong with it.
fn sample(sample: &RadianceSample) -> String {
    let [x, y, z] = sample.rgb.to_array();
    match sample.info & SAMPLE_BAD {
        0 => format!("{} {} {}", number(x.into()), number(y.into()), number(z.into())),
        _ => format!("none: a bad sample, {}, at vertex {}", names::fault(x as u32), y as u32 + 1),
    }
}

/// Whether the two are one path.
fn verdict(told: &Told) -> String {
    let replay = told.replay;
    let comparison = &replay.verdict.comparison;
    let rows = || comparison.turns.iter().flat_map(|turn| &turn.rows);
    let most = rows().map(|row| row.difference).filter(|difference| difference.is_finite()).fold(0.0, f64::max);
    let Some(parting) = &comparison.parting else {
        let explained = rows().map(|row| row.explained).fold(0.0, f64::max);
        return format!("GPU and twin agree to {} to the end; rounding explains {}\n", part(most), part(explained));
    };
    let turn = replay.gpu.get(parting.turn).or(replay.verdict.twin.get(parting.turn));
    let at = turn.map_or("the end".to_owned(), names::ray);
    let mut text = format!("GPU and twin part at {at}: ");
    match &parting.row {
        Some(row) => {
            let list = |values: &Values| values.numbers().iter().map(|x| number(*x)).collect::<Vec<_>>().join(" ");
            let (ours, right) = (list(&row.gpu), list(&row.twin));
            let _ = writeln!(text, "{}\n  {ours} beside {right} (twin)", row.name);
            let _ = write!(text, "  {} apart, rounding explains {}", part(row.difference), part(row.explained));
        }
        None => {
            let _ = write!(text, "{}\n  {}", parting.name, names::decided(replay, parting));
        }
    }
    if let Some(why) = &replay.verdict.why {
        let _ = write!(text, "\n  {}", names::why(why));
    }
    if let Some(degrees) = replay.verdict.twin.get(parting.turn).and_then(names::grazes) {
        let _ = write!(text, "\n  the ray grazes the twin's triangle at {degrees:.2} degrees");
    }
    text += "\n";
    text
}

/// A ray.
fn block(told: &Told, i: usize, turn: &Turn) -> String {
    let replay = told.replay;
    let comparison = &replay.verdict.comparison;
    let parted = comparison.parting.as_ref().map_or(usize::MAX, |parting| parting.turn);
    let compared = comparison.turns.get(i);
    let mut text = format!("{}: {}\n", names::ray(turn), seen(told, turn));
    if i == 0 {
        let _ = writeln!(text, "  {:<21}{:<30}{:<30}differ, rounding", "", "GPU", "twin");
    }
    // Beyond the parting the twin's ray of that number is another.
    let right = replay.verdict.twin.get(i).filter(|_| i <= parted);
    let rights: Vec<(&str, Values)> = right.into_iter().flat_map(numbers_of).collect();
    for (name, ours) in numbers_of(turn) {
        let twin = rights.iter().find(|(known, _)| *known == name).map(|(_, values)| values);
        if name != "radiance" && ours.largest() == 0.0 && twin.is_none_or(|twin| twin.largest() == 0.0) {
            continue;
        }
        let row = compared.and_then(|compared| compared.rows.iter().find(|row| row.name == name));
        let differ = row.map_or(String::new(), |row| match row.agrees() {
            true => format!("{}, {}", part(row.difference), part(row.explained)),
            false => format!("{}, {} !", part(row.difference), part(row.explained)),
        });
        let line = format!("  {name:<21}{}{}{differ}", column(Some(&ours)), column(twin));
        text += line.trim_end();
        text += "\n";
    }
    if let Some(Some(third)) = told.third.get(i) {
        text += &oracle(third);
    }
    text
}

/// The numbers that code shows of a ray, in the order of its calls.
fn shown(told: &Told, turn: usize) -> String {
    let of_turn = told.replay.probed.iter().filter(|probed| probed.turn == turn);
    let line = |probed: &ProbedNumber| {
        format!("  probe {:<29} {}\n", format!("\"{}\"", probed.name), names::probed(&probed.value))
    };
    of_turn.map(line).collect()
}

/// What a ray came to.
fn seen(told: &Told, turn: &Turn) -> String {
    let replay = told.replay;
    match turn.kind {
        RayKind::Segment => names::end(replay, turn),
        RayKind::Shadow if turn.is_seen() => "seen".to_owned(),
        RayKind::Shadow => format!("hidden by {}", names::end(replay, turn)),
    }
}

/// What the oracle says of a segment's end.
fn oracle(third: &Third) -> String {
    let colour = |v: glam::DVec3| v.to_array().map(number).join(" ");
    let mut text = String::from("  oracle: ");
    match &third.vertex {
        Some(vertex) => text += &format!("t {}", number(vertex.t)),
        None => text += "hits nothing",
    }
    if third.emitted != glam::DVec3::ZERO {
        text += &format!(", emitted {}", colour(third.emitted));
    }
    if let Some(vertex) = third.vertex.as_ref().filter(|vertex| vertex.light_pdf > 0.0) {
        text += &format!(", its pdf of that light {}", number(vertex.light_pdf));
    }
    text += "\n";
    let value = |name: &str, beside: &Option<Beside>| {
        beside.as_ref().map_or(String::new(), |at| {
            let (value, off, pdf) = (colour(at.value), part(at.difference()), number(at.pdf));
            format!("    f cos {name}: {value}, the GPU's is {off} off; its own pdf {pdf}\n")
        })
    };
    text + &value("of the light", &third.light) + &value("of the drawn", &third.drawn)
}
