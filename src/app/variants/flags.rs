//! What every command accepts that renders a family.

use std::path::PathBuf;

use clap::Args;
use glam::UVec2;

use crate::app::Failure;
use crate::app::shared::describe::quoted;
use crate::app::shared::values::{define, error, seconds, size};
use crate::scene::Define;
use crate::scene::variants::{Family, Goal};

#[derive(Debug, Args)]
pub struct FamilyFlags {
    /// Samples a pixel of every member; of several numbers, it is looked at after each [default: the file's goal, or each scene's own]
    #[arg(long, value_name = "N,..", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    pub spp: Vec<u32>,
    /// Seconds of tracing of every member instead; of several, it is looked at after each
    #[arg(long, value_name = "SECONDS,..", value_delimiter = ',', value_parser = seconds, conflicts_with = "spp")]
    pub time: Vec<f64>,
    /// Trace every member until its relMSE is at most this, with 95 % confidence
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
    /// Say which members there are, in the order they would be rendered in, and which are done; render nothing
    #[arg(long, conflicts_with = "json")]
    pub list: bool,
    /// Render on so many adapters at once, the first of `lucerna doctor`
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub jobs: u32,
    /// Print the answer to stdout as one JSON object, and nothing else there
    #[arg(long)]
    pub json: bool,
    /// No progress, and no warnings
    #[arg(long, short)]
    pub quiet: bool,
}

impl FamilyFlags {
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

    /// Refuses a folder of shaders that there is not.
    pub fn check(&self) -> Result<(), Failure> {
        match self.shaders.as_deref().filter(|folder| !folder.is_dir()) {
            None => Ok(()),
            Some(folder) => {
                let message = format!("--shaders: there is no folder {}", folder.display());
                Err(Failure::usage(message, "give a folder of shaders"))
            }
        }
    }
}
