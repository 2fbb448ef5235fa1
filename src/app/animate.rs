//! `lucerna animate`: the frames of a scene that changes with time, and a movie of them. A frame is a member of a family.

use std::ops::Range;
use std::path::PathBuf;

use clap::Args;

use super::shared::interrupt::Interrupt;
use super::shared::values::MORE;
use super::variants::flags::FamilyFlags;
use super::variants::produce::{Request, produce};
use super::variants::wanted::Wanted;
use super::{Exit, Failure};
use crate::scene::variants::{Family, frames};
use crate::scene::{self, Assets, Define, Diagnostic, Severity};

#[derive(Debug, Args)]
#[command(after_help = MORE, allow_negative_numbers = true)]
pub struct AnimateArguments {
    /// A scene file (.ron) with `animate`, or the name of one in assets/scenes
    pub scene: String,
    #[command(flatten)]
    pub flags: FamilyFlags,
    /// Render these frames alone, from A up to but not B: 10..20, ..20, 10.. or 10
    #[arg(long, value_name = "A..B", value_parser = range)]
    pub frames: Option<Range<usize>>,
    /// Frames a second of the movie, and of keys in seconds [default: the scene's]
    #[arg(long, value_name = "N")]
    pub fps: Option<f64>,
    /// The folder that gets a folder of the scene's name
    #[arg(long, short, value_name = "DIR", default_value = "result/animate")]
    pub out: PathBuf,
}

/// Renders the frames that are not done, and makes a movie of them.
pub fn run(arguments: &AnimateArguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Interrupted);
    let path = scene::find(&arguments.scene)?;
    let assets = Assets::new();
    let fps = arguments.fps.map(|fps| Define::given("animate.fps", fps.to_string()));
    let defines: Vec<Define> = arguments.flags.defines().into_iter().chain(fps).collect();
    let Some(family) = frames(&path, &defines, &assets)? else {
        let error = Diagnostic::file(Severity::Error, &path, "nothing of this scene is animated");
        let help = "write animate: (frames: 48, keys: { \"film.exposure\": { 0: -4, 47: 0 } }) into it";
        return Err(error.help(help).into());
    };
    arguments.flags.check()?;
    let wanted = arguments.wanted(&family)?;
    let folder = arguments.out.join(&family.name);
    produce(&Request { family: &family, flags: &arguments.flags, wanted, folder }, assets, interrupt)
}

impl AnimateArguments {
    /// The frames that are to be rendered. Refuses a range without any.
    fn wanted(&self, family: &Family) -> Result<Wanted, Failure> {
        let Some(Range { start, end }) = self.frames.clone() else { return Ok(Wanted::All) };
        let count = family.members.len();
        if start < end.min(count) && (end <= count || end == usize::MAX) {
            return Ok(Wanted::Range(start..end));
        }
        let message = format!("--frames: there are only the frames 0 to {}", count - 1);
        Err(Failure::usage(message, format!("all of them are --frames 0..{count}")))
    }
}

/// `A..B`, `A..`, `..B`, or `A` alone.
fn range(text: &str) -> Result<Range<usize>, String> {
    let number = |text: &str, without: usize| match text {
        "" => Some(without),
        text => text.parse::<u32>().ok().map(|number| number as usize),
    };
    let ends = match text.split_once("..") {
        Some((start, end)) => number(start, 0).zip(number(end, usize::MAX)),
        None => text.parse::<u32>().ok().map(|frame| (frame as usize, frame as usize + 1)),
    };
    match ends {
        Some((start, end)) if start < end => Ok(start..end),
        _ => Err("expected A..B with A < B, such as 0..24: frame A up to but not B".into()),
    }
}
