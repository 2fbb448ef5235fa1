//! What is compared: an integrator, a sampler, roulette or not, reuse of paths or not, adaptive or not, and how textures are filtered, by a name such as `path+sobol+roulette`.

use std::fmt;
use std::str::FromStr;

use crate::components::{Adaptive, Integrator, Render, Reuse, Sampler, TextureFilter};
use crate::scene::settings::Named;

/// The parts of the settings that change how light is estimated, and not what is estimated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Configuration {
    pub integrator: Integrator,
    pub sampler: Sampler,
    pub roulette: bool,
    pub reuse: Reuse,
    pub adaptive: Adaptive,
    /// None for the scene's own.
    pub texture_filter: Option<TextureFilter>,
}

/// What is compared unless `--configs` says otherwise.
pub const DEFAULT: &str = "path+sobol+roulette,path+sobol,path+pcg,bsdf+pcg";

/// The word for reuse of paths within tiles.
const REUSE: &str = "reuse";

/// The word for adaptive films.
const ADAPTIVE: &str = "adaptive";

impl Configuration {
    /// The settings with these parts exchanged.
    pub fn of(&self, render: &Render) -> Render {
        let texture_filter = self.texture_filter.unwrap_or(render.texture_filter);
        let Self { integrator, sampler, roulette, reuse, adaptive, .. } = *self;
        Render { integrator, sampler, roulette, reuse, adaptive, texture_filter, ..*render }
    }
}

/// The words of a configuration.
fn known() -> Vec<&'static str> {
    let integrators = Integrator::WORDS.iter().map(|word| word.name);
    let samplers = Sampler::WORDS.iter().map(|word| word.name);
    let filters = TextureFilter::WORDS.iter().map(|word| word.name);
    integrators.chain(samplers).chain(["roulette", REUSE, ADAPTIVE]).chain(filters).collect()
}

impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (integrator, sampler) = (self.integrator.name(), self.sampler.name());
        write!(f, "{integrator}+{sampler}{}", if self.roulette { "+roulette" } else { "" })?;
        if self.reuse == Reuse::Tiles {
            write!(f, "+{REUSE}")?;
        }
        if self.adaptive == Adaptive::On {
            write!(f, "+{ADAPTIVE}")?;
        }
        self.texture_filter.map_or(Ok(()), |filter| write!(f, "+{}", filter.name()))
    }
}

impl FromStr for Configuration {
    type Err = String;

    /// Words in any order, one integrator and one sampler among them; `rr` is short for `roulette`.
    fn from_str(text: &str) -> Result<Self, String> {
        let (mut integrator, mut sampler, mut roulette, mut texture_filter) = (None, None, None, None);
        let (mut reuse, mut adaptive) = (None, None);
        for word in text.split('+') {
            let word = word.trim();
            let again = if let Some(found) = Integrator::named(word) {
                integrator.replace(found).is_some()
            } else if let Some(found) = Sampler::named(word) {
                sampler.replace(found).is_some()
            } else if let Some(found) = TextureFilter::named(word) {
                texture_filter.replace(found).is_some()
            } else if matches!(word, "roulette" | "rr") {
                roulette.replace(true).is_some()
            } else if word == REUSE {
                reuse.replace(Reuse::Tiles).is_some()
            } else if word == ADAPTIVE {
                adaptive.replace(Adaptive::On).is_some()
            } else {
                return Err(format!("`{word}` is none of {}", known().join(", ")));
            };
            if again {
                return Err(format!("`{word}` says twice what it says once"));
            }
        }
        match (integrator, sampler) {
            (Some(integrator), Some(sampler)) => {
                let (roulette, reuse) = (roulette.is_some(), reuse.unwrap_or_default());
                let adaptive = adaptive.unwrap_or_default();
                Ok(Self { integrator, sampler, roulette, reuse, adaptive, texture_filter })
            }
            _ => Err("expected an integrator and a sampler, such as path+sobol or bsdf+pcg+roulette".into()),
        }
    }
}
