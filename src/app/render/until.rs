//! When a render is finished: after so many samples, after so long, or once it is good enough.

use super::arguments::RenderArguments;
use crate::app::shared::looks::{MOST_SPP, next_look};
use crate::app::shared::progress::Goal;
use crate::app::shared::quality::Quality;

/// The first look at a film whose error is to be small enough: the estimate of fewer samples is no use.
const FIRST_LOOK: u32 = 16;

/// What ends a render; whichever comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Until {
    /// Samples a pixel.
    pub spp: Option<u32>,
    /// Seconds of tracing.
    pub seconds: Option<f64>,
    /// Without those of the command line or the scene: how good the picture is to be.
    pub quality: Option<Quality>,
}

/// How tracing ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// Every pixel has its samples.
    Samples,
    /// The time is up.
    Time,
    /// The film's error is as small as it was to be.
    Error,
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
        let by_flag = arguments.flags.gives_samples();
        match (arguments.time, arguments.quality) {
            // The scene's own number of samples is no limit.
            (Some(seconds), _) => Self { spp: of_scene.filter(|_| by_flag), seconds: Some(seconds), quality: None },
            (None, Some(quality)) => Self { spp: None, seconds: None, quality: Some(quality) },
            (None, None) if of_scene.is_some() => Self { spp: of_scene, seconds: None, quality: None },
            (None, None) => Self { spp: None, seconds: None, quality: Some(Quality::default()) },
        }
    }

    /// Samples a pixel that the film is to have first.
    pub fn first(&self) -> u32 {
        self.spp.unwrap_or(if self.quality.is_some() { FIRST_LOOK } else { u32::MAX })
    }

    /// Samples that a finished film is to have next; none where it is as good as it is to be.
    pub fn next(&self, spp: u32, error: f64) -> Option<u32> {
        let wanted = self.quality.filter(|quality| error > quality.error() && spp < MOST_SPP);
        wanted.map(|_| next_look(spp))
    }

    /// What is shown as progress, of a picture of so many pixels. `spent` are the seconds that the process has run.
    pub fn goal(&self, pixels: u64, spent: f64) -> Goal {
        Goal {
            samples: self.spp.map(|spp| pixels.saturating_mul(u64::from(spp))),
            seconds: self.seconds.or(self.quality.map(|quality| (quality.seconds() - spent).max(0.0))),
            error: self.quality.map(Quality::error),
        }
    }

    /// What the picture's quality comes to, for a user; nothing where samples or time were given. `error` is none where the film is too
    /// young to know it.
    pub fn line(&self, ended: Ended, error: Option<f64>) -> Option<String> {
        let quality = self.quality.filter(|_| ended != Ended::Interrupted)?;
        let error = error.map_or("unknown".to_owned(), |error| format!("{error:.1e}"));
        let after = match ended {
            Ended::Time => format!(", ended after {} s", quality.seconds()),
            Ended::Samples | Ended::Error | Ended::Interrupted => String::new(),
        };
        let (name, wanted) = (quality.name(), quality.error());
        Some(format!("{name}: error {error}, wanted {wanted:.0e}{after}; --quality, --spp or --time choose otherwise"))
    }
}
