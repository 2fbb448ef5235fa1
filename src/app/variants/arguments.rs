//! What `lucerna variants` accepts.

use std::path::PathBuf;

use clap::Args;

use super::flags::FamilyFlags;
use super::wanted::Wanted;
use crate::app::Failure;
use crate::app::shared::values::MORE;
use crate::scene::variants::Family;

#[derive(Debug, Args)]
#[command(after_help = MORE, allow_negative_numbers = true)]
pub struct VariantsArguments {
    /// A variant file (.ron), or the name of one in assets/variants
    pub family: String,
    #[command(flatten)]
    pub flags: FamilyFlags,
    /// Render these members alone; may be given several times
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
    /// Let members compete by efficiency, and end those early that are certain to lose
    #[arg(long, conflicts_with_all = ["jobs", "error", "list"])]
    pub race: bool,
    /// With --race, the probability that the best member is ended
    #[arg(long, value_name = "P", default_value = "1e-3", value_parser = probability)]
    pub alpha: f64,
    /// With --race, rounds of two films a member, at most
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(4..=1 << 20))]
    pub rounds: u32,
    /// The folder that gets a folder of the family's name
    #[arg(long, value_name = "DIR", default_value = "result/variants")]
    pub out: PathBuf,
}

impl VariantsArguments {
    /// Refuses names of members that there are not, and values that go with others.
    pub fn check(&self, family: &Family) -> Result<(), Failure> {
        if self.race && self.flags.spp.len() > 1 {
            return Err(Failure::usage("--race: films have one number of samples", "give one number to --spp"));
        }
        let known = |name: &&String| family.members.iter().any(|member| member.name == **name);
        match self.only.iter().find(|name| !known(name)) {
            None => Ok(()),
            Some(name) => {
                let names: Vec<&str> = family.members.iter().map(|member| member.name.as_str()).collect();
                let help = match names.len() {
                    0..=24 => format!("its members are: {}", names.join(", ")),
                    _ => "`lucerna variants FILE --list` names its members".to_owned(),
                };
                Err(Failure::usage(format!("--only: there is no member `{name}`"), help))
            }
        }
    }

    /// Which members are to be rendered.
    pub fn wanted(&self) -> Wanted {
        if self.only.is_empty() { Wanted::All } else { Wanted::Named(self.only.clone()) }
    }
}

fn probability(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(alpha) if (1e-12..=0.5).contains(&alpha) => Ok(alpha),
        _ => Err("expected a probability from 1e-12 to 0.5".into()),
    }
}
