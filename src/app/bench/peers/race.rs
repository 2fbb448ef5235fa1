//! Pictures of both, by turns, each looked at as its samples grow.

use super::peer::Peer;
use super::references::error;
use crate::app::bench::BenchError;
use crate::app::bench::light::configuration::Configuration;
use crate::app::bench::light::measure::film;
use crate::app::bench::light::record::{ConfigurationRecord, Run, Snapshot};
use crate::app::bench::light::reference::Reference;
use crate::app::shared::tracer::{Monitor, Tracer};
use crate::components::Render;

/// Samples a pixel, at most: what is not there by then never is.
const MOST: u32 = 1 << 18;

/// Part of the error that is to be reached, to which the first picture is rendered: others then come to the error too.
const BEYOND: f64 = 0.7;

/// Seeds of the peer's first picture and of those that count.
const PEER_SEED: u32 = 1000;

/// Both, on one scene.
pub struct Race<'a> {
    pub tracer: &'a mut Tracer,
    pub peer: &'a mut Peer,
    pub reference: &'a Reference,
    pub monitor: &'a mut Monitor,
    /// Pixels of a picture.
    pub pixels: u64,
}

/// Numbers of samples at which pictures are looked at.
type Numbers = Vec<u32>;

impl Race<'_> {
    /// Numbers of samples at which a configuration is to be looked at, until its error is below `to`: the picture that does not count, with
    /// which all is compiled. None if a signal came.
    pub fn try_out(&mut self, configuration: Configuration, to: f64) -> Result<Option<Numbers>, BenchError> {
        let render = Render { seed: u32::MAX, ..configuration.of(&self.tracer.render) };
        let mut numbers = Vec::new();
        for spp in growing() {
            numbers.push(spp);
            let Some((run, _)) = film(self.tracer, render, &[spp], self.reference, self.monitor)? else {
                return Ok(None);
            };
            if run.snapshots.last().is_some_and(|last| last.relmse <= BEYOND * to) {
                break;
            }
        }
        Ok(Some(numbers))
    }

    /// The same of the peer.
    pub fn try_out_peer(&mut self, to: f64) -> Result<Option<Numbers>, BenchError> {
        let mut numbers = Vec::new();
        for spp in growing() {
            numbers.push(spp);
            let Some(picture) = self.peer.render(spp, PEER_SEED)? else { return Ok(None) };
            self.monitor.meter.advance(self.pixels * u64::from(spp), spp);
            if error(&picture.rgb, self.reference) <= BEYOND * to {
                break;
            }
        }
        Ok(Some(numbers))
    }

    /// All that counts: of each configuration and of the peer, so many runs by turns. Runs that were whole before a signal are kept.
    pub fn run(
        &mut self,
        configurations: &[(Configuration, Numbers)],
        (peer_name, peer_numbers): (&str, &[u32]),
        runs: u32,
    ) -> Result<Vec<ConfigurationRecord>, BenchError> {
        let mut films: Vec<(Vec<Run>, u64)> = vec![(Vec::new(), 0); configurations.len()];
        let mut pictures = Vec::new();
        'turns: for seed in 0..runs {
            let mut turn = Vec::new();
            for (configuration, numbers) in configurations {
                self.monitor.meter.rename(&configuration.to_string());
                let render = Render { seed, ..configuration.of(&self.tracer.render) };
                match film(self.tracer, render, numbers, self.reference, self.monitor)? {
                    Some(film) => turn.push(film),
                    None => break 'turns,
                }
            }
            self.monitor.meter.rename(peer_name);
            let Some(run) = self.run_of_peer(seed, peer_numbers)? else { break };
            pictures.push(run);
            for (films, (run, bad)) in films.iter_mut().zip(turn) {
                films.0.push(run);
                films.1 += bad;
            }
        }
        if pictures.is_empty() {
            return Ok(Vec::new());
        }
        let named = configurations.iter().map(|(configuration, _)| configuration.to_string());
        let ours = named.zip(films).map(|(name, (runs, bad))| ConfigurationRecord::of(name, bad, runs));
        Ok(ours.chain([ConfigurationRecord::of(peer_name.to_owned(), 0, pictures)]).collect())
    }

    /// One run of the peer's: a picture of its own for each number of samples.
    fn run_of_peer(&mut self, seed: u32, numbers: &[u32]) -> Result<Option<Run>, BenchError> {
        let mut snapshots = Vec::new();
        for (index, spp) in numbers.iter().enumerate() {
            let of_its_own = PEER_SEED + 1 + seed * 64 + index as u32;
            let Some(picture) = self.peer.render(*spp, of_its_own)? else { return Ok(None) };
            self.monitor.meter.advance(self.pixels * u64::from(*spp), *spp);
            let relmse = error(&picture.rgb, self.reference);
            snapshots.push(Snapshot { spp: *spp, seconds: picture.seconds, rays: 0, relmse, claimed: None });
        }
        Ok(Some(Run { seed, snapshots }))
    }
}

/// 1, 4, 16, ..
fn growing() -> impl Iterator<Item = u32> {
    std::iter::successors(Some(1), |spp| Some(spp * 4)).take_while(|spp| *spp <= MOST)
}
