//! What `lucerna variants` accepts.

use std::path::PathBuf;

use clap::Args;
use glam::UVec2;

use crate::app::Failure;
use crate::app::shared::describe::quoted;
use crate::app::shared::values::{EXIT_CODES, define, seconds, size};
use crate::scene::Define;
use crate::scene::variants::{Family, Goal};

#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES, allow_negative_numbers = true)]
pub struct VariantsArguments {
    /// A variant file (.ron), or the name of one in assets/variants
    pub family: String,
    /// Samples a pixel of every member; of several numbers, it is looked at after each [default: the file's goal, or each scene's own]
    #[arg(long, value_name = "N,..", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    pub spp: Vec<u32>,
    /// Seconds of tracing of every member instead; of several, it is looked at after each
    #[arg(long, value_name = "SECONDS,..", value_delimiter = ',', value_parser = seconds, conflicts_with = "spp")]
    pub time: Vec<f64>,
    /// Trace every member until its relMSE is estimated to be at most this
    #[arg(long, value_name = "RELMSE", value_parser = error, conflicts_with_all = ["spp", "time"])]
    pub error: Option<f64>,
    /// Size of all pictures in pixels, each side 1 to 16384 [default: each scene's own]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,
    /// Change a value of every scene before members do, such as -D materials.ball.ns=64
    #[arg(short = 'D', value_name = "KEY=VALUE", value_parser = define)]
    pub define: Vec<Define>,
    /// The folder of shaders of members that have none of their own [default: ./shaders where there is one, else those that were built in]
    #[arg(long, value_name = "DIR")]
    pub shaders: Option<PathBuf>,
    /// Render these members alone; may be given several times
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
    /// Say which members there are, in the order they would be rendered in, and which are done; render nothing
    #[arg(long, conflicts_with = "json")]
    pub list: bool,
    /// Render on so many adapters at once, the first of `lucerna doctor`
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub jobs: u32,
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
    /// Print the answer to stdout as one JSON object, and nothing else there
    #[arg(long)]
    pub json: bool,
    /// No progress, and no warnings
    #[arg(long, short)]
    pub quiet: bool,
}

impl VariantsArguments {
    /// What is changed of every scene before members are: by `-D`, and by `--size`.
    pub fn defines(&self) -> Vec<Define> {
        let size = self.size.map(|size| Define::given("film.size", format!("({}, {})", size.x, size.y)));
        self.define.iter().cloned().chain(size).collect()
    }

    /// What changes films, as words of a shell, each behind a space.
    pub fn repeated(&self) -> String {
        let mut text = String::new();
        let mut flag = |name: &str, value: String| text += &format!(" {name} {}", quoted(&value));
        let list = |numbers: Vec<String>| numbers.join(",");
        if !self.spp.is_empty() {
            flag("--spp", list(self.spp.iter().map(u32::to_string).collect()));
        }
        if !self.time.is_empty() {
            flag("--time", list(self.time.iter().map(f64::to_string).collect()));
        }
        if let Some(error) = self.error {
            flag("--error", error.to_string());
        }
        if let Some(size) = self.size {
            flag("--size", format!("{}x{}", size.x, size.y));
        }
        if let Some(folder) = &self.shaders {
            flag("--shaders", folder.display().to_string());
        }
        for Define { path, value, .. } in &self.define {
            flag("-D", format!("{path}={value}"));
        }
        text
    }

    /// When a member is done: by flags, else by the file; `None` where each scene says.
    pub fn goal(&self, family: &Family) -> Option<Goal> {
        let ascending = |mut times: Vec<f64>| {
            times.sort_by(f64::total_cmp);
            times.dedup();
            times
        };
        if let Some(error) = self.error {
            return Some(Goal::Error(error));
        }
        if !self.time.is_empty() {
            return Some(Goal::Seconds(ascending(self.time.clone())));
        }
        if self.spp.is_empty() {
            return family.goal.clone();
        }
        let mut spp = self.spp.clone();
        spp.sort_unstable();
        spp.dedup();
        Some(Goal::Samples(spp))
    }

    /// Refuses names of members that there are not, and values that go with others.
    pub fn check(&self, family: &Family) -> Result<(), Failure> {
        if self.race && self.spp.len() > 1 {
            return Err(Failure::usage("--race: films have one number of samples", "give one number to --spp"));
        }
        if let Some(folder) = self.shaders.as_deref().filter(|folder| !folder.is_dir()) {
            let message = format!("--shaders: there is no folder {}", folder.display());
            return Err(Failure::usage(message, "give a folder of shaders"));
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

    /// Whether a member is to be rendered.
    pub fn wants(&self, name: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|only| only == name)
    }
}

fn error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if (1e-9..=1e3).contains(&error) => Ok(error),
        _ => Err("expected a relMSE from 1e-9 to 1e3".into()),
    }
}

fn probability(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(alpha) if (1e-12..=0.5).contains(&alpha) => Ok(alpha),
        _ => Err("expected a probability from 1e-12 to 0.5".into()),
    }
}
