//! What is compared: an integrator, a sampler, and roulette or not, by a name such as `path+sobol+roulette`.

use std::fmt;
use std::str::FromStr;

use crate::components::{Integrator, Render, Sampler};
use crate::scene::settings::Named;

/// The parts of the settings that change how light is estimated, and not what is estimated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Configuration {
    pub integrator: Integrator,
    pub sampler: Sampler,
    pub roulette: bool,
}

/// What is compared unless `--configs` says otherwise.
pub const DEFAULT: &str = "path+sobol+roulette,path+sobol,path+pcg,bsdf+pcg";

impl Configuration {
    /// The settings with these parts exchanged.
    pub fn of(&self, render: &Render) -> Render {
        Render { integrator: self.integrator, sampler: self.sampler, roulette: self.roulette, ..*render }
    }
}

/// The words of a configuration.
fn known() -> Vec<&'static str> {
    let integrators = Integrator::WORDS.iter().map(|word| word.name);
    integrators.chain(Sampler::WORDS.iter().map(|word| word.name)).chain(["roulette"]).collect()
}

impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (integrator, sampler) = (self.integrator.name(), self.sampler.name());
        write!(f, "{integrator}+{sampler}{}", if self.roulette { "+roulette" } else { "" })
    }
}

impl FromStr for Configuration {
    type Err = String;

    /// Words in any order, one integrator and one sampler among them; `rr` is short for `roulette`.
    fn from_str(text: &str) -> Result<Self, String> {
        let (mut integrator, mut sampler, mut roulette) = (None, None, None);
        for word in text.split('+') {
            let word = word.trim();
            let again = if let Some(found) = Integrator::named(word) {
                integrator.replace(found).is_some()
            } else if let Some(found) = Sampler::named(word) {
                sampler.replace(found).is_some()
            } else if matches!(word, "roulette" | "rr") {
                roulette.replace(true).is_some()
            } else {
                return Err(format!("`{word}` is none of {}", known().join(", ")));
            };
            if again {
                return Err(format!("`{word}` says twice what it says once"));
            }
        }
        match (integrator, sampler) {
            (Some(integrator), Some(sampler)) => Ok(Self { integrator, sampler, roulette: roulette.is_some() }),
            _ => Err("expected an integrator and a sampler, such as path+sobol or bsdf+pcg+roulette".into()),
        }
    }
}
