//! When a render is finished: after so many samples, after so long, or once it is good enough.

use super::arguments::RenderArguments;
use crate::app::shared::progress::Goal;
use crate::app::shared::quality::Quality;
use crate::engine::FilmError;
use crate::stats::looks::{FIRST_LOOK, MOST_SPP, next_look};

/// What ends a render; whichever comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Until {
    /// Samples a pixel.
    pub spp: Option<u32>,
    /// Seconds of tracing.
    pub seconds: Option<f64>,
    /// The relMSE that the picture is at most to have.
    pub error: Option<f64>,
    /// What it is called where no flag gave it as a number; then its seconds count, from the start of the process.
    pub quality: Option<Quality>,
}

/// How tracing ended; what is more a pity comes later.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ended {
    /// The film's error is as small as it was to be.
    Error,
    /// Every pixel has its samples.
    Samples,
    /// The time is up.
    Time,
    Interrupted,
}

impl Ended {
    /// What reports call it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Samples => "samples",
            Self::Time => "time",
            Self::Error => "error",
            Self::Interrupted => "interrupted",
        }
    }
}

impl Until {
    /// What flags say, over what the scene does: `of_scene` are its samples a pixel, where it gives them.
    pub fn of(arguments: &RenderArguments, of_scene: Option<u32>) -> Self {
        let RenderArguments { time, error, quality, .. } = *arguments;
        let by_flag = of_scene.filter(|_| arguments.flags.gives_samples());
        match (time.is_some() || error.is_some(), quality) {
            // The scene's own number of samples is no limit.
            (true, _) => Self { spp: by_flag, seconds: time, error, quality: None },
            (false, Some(quality)) => Self::good_enough(quality),
            (false, None) if of_scene.is_some() => Self { spp: of_scene, seconds: None, error: None, quality: None },
            (false, None) => Self::good_enough(Quality::default()),
        }
    }

    fn good_enough(quality: Quality) -> Self {
        Self { spp: None, seconds: None, error: Some(quality.error()), quality: Some(quality) }
    }

    /// Samples a pixel that the film is to have first.
    pub fn first(&self) -> u32 {
        let most = self.spp.unwrap_or(u32::MAX);
        if self.error.is_some() { most.min(FIRST_LOOK) } else { most }
    }

    /// What becomes of a film that has the samples it was to have: it ends, or is to have more. `error` is asked where it matters.
    pub fn next<E>(&self, spp: u32, error: impl FnOnce() -> Result<FilmError, E>) -> Result<Next, E> {
        let Some(wanted) = self.error else { return Ok(Next::End(Ended::Samples)) };
        let bound = error()?.bound;
        let most = self.spp.unwrap_or(MOST_SPP);
        Ok(match (bound <= wanted && spp > 1, spp >= most) {
            (true, _) => Next::End(Ended::Error),
            (false, true) => Next::End(Ended::Samples),
            (false, false) => Next::Samples(next_look(spp, bound / wanted).min(most)),
        })
    }

    /// The flags that say so: names, and values.
    pub fn flags(&self) -> Vec<(&'static str, String)> {
        if let Some(quality) = self.quality {
            return vec![("--quality", quality.name().to_owned())];
        }
        let spp = self.spp.map(|spp| ("--spp", spp.to_string()));
        let error = self.error.map(|error| ("--error", format!("{error:e}")));
        let seconds = self.seconds.map(|seconds| ("--time", seconds.to_string()));
        spp.into_iter().chain(error).chain(seconds).collect()
    }

    /// What is shown as progress, of a picture of so many pixels. `spent` are the seconds that the process has run.
    pub fn goal(&self, pixels: u64, spent: f64) -> Goal {
        Goal {
            samples: self.spp.map(|spp| pixels.saturating_mul(u64::from(spp))),
            seconds: self.seconds.or(self.quality.map(|quality| (quality.seconds() - spent).max(0.0))),
            error: self.error,
        }
    }

    /// Whether the picture is what was wanted, for a user; nothing where no error was to be reached. `error` is none where the film is too
    /// young to know it.
    pub fn line(&self, ended: Ended, error: Option<FilmError>) -> Option<String> {
        let wanted = self.error.filter(|_| ended != Ended::Interrupted)?;
        let error = error.map_or("unknown".to_owned(), |error| format!("at most {:.1e}", error.bound));
        let after = match (ended, self.quality) {
            (Ended::Time, Some(quality)) => format!(", ended after {} s", quality.seconds()),
            (Ended::Time, None) => ", ended by --time".to_owned(),
            (Ended::Samples, _) => ", ended by its samples".to_owned(),
            (Ended::Error | Ended::Interrupted, _) => String::new(),
        };
        Some(match self.quality {
            Some(quality) => format!(
                "{}: error {error}, wanted {wanted:.0e}{after}; --quality, --error, --spp or --time choose otherwise",
                quality.name()
            ),
            None => format!("error {error}, wanted {wanted:e}{after}"),
        })
    }
}

/// What becomes of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    End(Ended),
    /// It is to have so many samples a pixel.
    Samples(u32),
}
