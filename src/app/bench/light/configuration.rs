//! What is compared: an integrator, a sampler, and roulette or not, by a name such as `path+sobol+roulette`.

use std::fmt;
use std::str::FromStr;

use crate::components::{Integrator, Render, Sampler};

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

impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let integrator = match self.integrator {
            Integrator::Path => "path",
            Integrator::Bsdf => "bsdf",
        };
        let sampler = match self.sampler {
            Sampler::Sobol => "sobol",
            Sampler::Pcg => "pcg",
        };
        write!(f, "{integrator}+{sampler}{}", if self.roulette { "+roulette" } else { "" })
    }
}

impl FromStr for Configuration {
    type Err = String;

    /// Words in any order, one integrator and one sampler among them; `rr` is short for `roulette`.
    fn from_str(text: &str) -> Result<Self, String> {
        let (mut integrator, mut sampler, mut roulette) = (None, None, None);
        for word in text.split('+') {
            let again = match word.trim() {
                "path" => integrator.replace(Integrator::Path).is_some(),
                "bsdf" => integrator.replace(Integrator::Bsdf).is_some(),
                "sobol" => sampler.replace(Sampler::Sobol).is_some(),
                "pcg" => sampler.replace(Sampler::Pcg).is_some(),
                "roulette" | "rr" => roulette.replace(true).is_some(),
                other => return Err(format!("`{other}` is none of path, bsdf, sobol, pcg, roulette")),
            };
            if again {
                return Err(format!("`{}` says twice what it says once", word.trim()));
            }
        }
        match (integrator, sampler) {
            (Some(integrator), Some(sampler)) => Ok(Self { integrator, sampler, roulette: roulette.is_some() }),
            _ => Err("expected an integrator and a sampler, such as path+sobol or bsdf+pcg+roulette".into()),
        }
    }
}
