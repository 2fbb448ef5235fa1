//! What came of a race: records, pictures, and a table.

use super::Raced;
use super::racer::Racer;
use crate::app::shared::describe::Described;
use crate::app::shared::key::hash;
use crate::app::variants::blank::blank;
use crate::app::variants::jobs::repeat;
use crate::app::variants::record::{Record, Snapshot, State};
use crate::app::variants::survey::Survey;
use crate::engine::{FilmError, FilmImage};
use crate::image::srgb::srgb_byte;
use crate::scene::variants::Family;

/// A film, and the metadata of its files.
pub type Pictured = (FilmImage, Vec<(&'static str, String)>);

impl Raced<'_> {
    /// The record and the film of every member that has one: its mean over all rounds. `relmse` is of that picture.
    pub fn records(&self, family: &Family, survey: &Survey) -> Vec<(usize, Record, Option<Pictured>)> {
        let one = |(number, racer): (usize, &Racer)| {
            let wrong = self.wrong.get(&number).map(|other| different(self.racers[*other].name()));
            let state = match (racer.error.clone().or(wrong), self.lost.iter().find(|lost| lost.member == number)) {
                (Some(message), _) => State::Failed {
                    message,
                    file: Some(family.path.display().to_string()),
                    line: racer.subject.member.place.line,
                    column: racer.subject.member.place.column,
                },
                (None, Some(lost)) => State::Lost { seconds: racer.seconds, confidence: lost.confidence },
                (None, None) if racer.films() == 0 => State::Missing,
                (None, None) => State::Done,
            };
            let film = racer.picture().map(|rgb| film(racer, rgb));
            let mut record = Record { state, ..blank(racer.subject) };
            // Not what the same member is without a race: it is not taken for that.
            record.key = format!("{:016x}", hash(("race", &record.key, racer.spp)));
            let Some(film) = film else { return (racer.index, record, None) };
            let described = Described {
                path: family.scene_of(&racer.subject.member),
                description: &racer.subject.description,
                defines: &racer.subject.member.defines,
                shaders: survey.shaders.as_deref(),
                window: film.window,
                spp: film.spp,
                adapter: &self.adapter,
            };
            let snapshot =
                Snapshot { spp: film.spp, seconds: racer.seconds, rays: racer.rays, relmse: film.error.relmse };
            let record = Record {
                snapshots: vec![snapshot],
                mean: film.mean,
                bad_samples: racer.bad_samples,
                adapter: self.adapter.clone(),
                repeat: repeat(family, survey, racer.subject, &described),
                ..record
            };
            (racer.index, record, Some((film, described.metadata())))
        };
        self.racers.iter().enumerate().map(one).collect()
    }
}

/// The mean of a member's films.
fn film(racer: &Racer, rgb: Vec<[f32; 3]>) -> FilmImage {
    let film = racer.subject.description.film;
    let scale = f64::from(film.exposure).exp2();
    let byte = |channel: f32| srgb_byte(f64::from(channel) * scale);
    let picture = rgb.iter().map(|[r, g, b]| [byte(*r), byte(*g), byte(*b), 255]).collect();
    let pixels = rgb.len().max(1) as f64;
    let mean = std::array::from_fn(|c| rgb.iter().map(|pixel| f64::from(pixel[c])).sum::<f64>() / pixels);
    FilmImage {
        size: film.size,
        window: film.window(),
        rgb,
        halves: [Vec::new(), Vec::new()],
        pixels: Vec::new(),
        picture,
        spp: racer.spp,
        mean,
        // What a race's pairs of films say comes without a bound.
        error: FilmError { relmse: racer.relmse(), bound: f64::INFINITY },
    }
}

/// What is wrong with a member that isn't slow.
fn different(other: &str) -> String {
    format!("its mean differs from that of {other}, which is to be the same picture")
}

/// A line a member, the best first; and what was saved.
pub fn text(raced: &Raced) -> String {
    let loss = |number: &usize| raced.race.average(*number).map_or(f64::INFINITY, |lap| lap.loss());
    let mut order: Vec<usize> = (0..raced.racers.len()).collect();
    order.sort_by(|a, b| loss(a).total_cmp(&loss(b)));
    let mut text = format!(
        "race of {} members, {} rounds of two films of {} spp; {:.0} % of the time saved\n",
        raced.racers.len(),
        raced.rounds,
        raced.spp,
        100.0 * raced.saved.max(0.0),
    );
    for number in order {
        let racer = &raced.racers[number];
        let told = match (&racer.error, raced.lost.iter().find(|lost| lost.member == number)) {
            (Some(error), _) => format!("failed: {error}"),
            (None, Some(lost)) => {
                let times = lost.ratio.map_or(String::new(), |ratio| {
                    format!(", {:.2} ({:.2} to {:.2}) times as efficient", ratio.ratio, ratio.low, ratio.high)
                });
                let by = raced.racers[lost.by].name();
                let confidence = 100.0 * lost.confidence;
                format!(
                    "ended after round {} and {:.2} s: worse than {by}{times}, with a confidence of {confidence:.3} %",
                    lost.rounds, racer.seconds
                )
            }
            (None, None) => format!("in the race to its end, {:.2} s", racer.seconds),
        };
        let told = match raced.wrong.get(&number) {
            Some(other) => format!("wrong, not slow: {}", different(raced.racers[*other].name())),
            None => told,
        };
        text += &format!("  {}: {told}\n", racer.name());
    }
    let key = &raced.racers[0].picture_key;
    if raced.racers.iter().any(|racer| racer.picture_key != *key) {
        text += "  members have other pictures: their efficiencies are those of unlike tasks\n";
    }
    text
}
