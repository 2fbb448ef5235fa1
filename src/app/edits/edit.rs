//! What is known of one edit: what was saved, and what came of it. Plain data, for the panel, for files and for the terminal.

use std::time::{SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

/// What an entry of the record is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The window opened: shaders and scene as they were then.
    Opened,
    /// Shaders were saved, alone or with the scene.
    Shaders,
    /// The scene was saved, or what it is read from.
    Scene,
}

/// What the lint of surfaces has found.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Lint {
    /// No code of surfaces was edited.
    #[default]
    NotLinted,
    Clean,
    /// Each in a line.
    Warned(Vec<String>),
}

/// How far judging is, and what came of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// There is nothing to judge: a scene, or the shaders that the window opened with.
    None,
    /// To be judged.
    Waiting,
    Judging,
    /// Another edit came before all was known.
    Left,
    /// The code that the scene runs is the same, or what is traced is not made by it.
    Unchanged,
    Agree,
    Differ,
    CannotTell,
    /// What was saved can't be used, or could not be judged.
    Failed,
}

impl State {
    /// Whether judging may still say more.
    pub fn is_open(self) -> bool {
        matches!(self, State::Waiting | State::Judging | State::Left)
    }
}

/// What judging has found, or why there is nothing to judge.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Verdict {
    pub state: State,
    /// In the few words that a row has room for.
    pub short: String,
    /// All of it.
    pub line: String,
}

impl Verdict {
    /// One whose few words say all.
    pub fn new(state: State, words: &str) -> Self {
        Self { state, short: words.to_owned(), line: words.to_owned() }
    }
}

/// One entry of the record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Edit {
    pub kind: Kind,
    /// The scene's name.
    pub scene: String,
    /// What was saved, as paths are told; none where everything was read again.
    pub files: Vec<String>,
    /// When, in seconds since 1970.
    pub saved: u64,
    /// Seconds from the save to the first pixels that came of it; none while there are none.
    pub pixels: Option<f64>,
    pub lint: Lint,
    pub verdict: Verdict,
}

impl Edit {
    /// What was saved in a few words: the first file's name, and how many more.
    pub fn what(&self) -> String {
        let name = |file: &String| file.rsplit(['/', '\\']).next().unwrap_or(file).to_owned();
        match self.files.as_slice() {
            _ if self.kind == Kind::Opened => "as the window opened".to_owned(),
            [] => "everything, read again".to_owned(),
            [one] => name(one),
            [one, others @ ..] => format!("{} and {} more", name(one), others.len()),
        }
    }

    /// The time to the first pixels.
    pub fn pixels_told(&self) -> String {
        match self.pixels {
            None => String::new(),
            Some(seconds) if seconds < 9.9995 => format!("{:.0} ms", 1e3 * seconds),
            Some(seconds) => format!("{seconds:.0} s"),
        }
    }

    /// What lint says of it in a few words; `inherited` are warnings of code before it that stand as long as nothing mends them.
    pub fn lint_told(&self, inherited: &[String]) -> String {
        let count = |warnings: &[String]| match warnings {
            [one] => without_file(one).to_owned(),
            [one, others @ ..] => format!("{} (and {} more)", without_file(one), others.len()),
            [] => String::new(),
        };
        match &self.lint {
            _ if self.verdict.state == State::Failed && self.pixels.is_none() => String::new(),
            Lint::Clean => "lint: nothing found".to_owned(),
            Lint::Warned(warnings) => format!("lint: {}", count(warnings)),
            Lint::NotLinted if !inherited.is_empty() => format!("lint, as before: {}", count(inherited)),
            Lint::NotLinted => "not linted: surfaces run the same code".to_owned(),
        }
    }
}

/// A warning without the file that it begins with.
fn without_file(warning: &str) -> &str {
    match warning.split_once(": ") {
        Some((file, message)) if file.ends_with(".wgsl") => message,
        _ => warning,
    }
}

/// How long ago a time was, both in seconds since 1970.
pub fn age(saved: u64, now: u64) -> String {
    match now.saturating_sub(saved) {
        0..60 => "just now".to_owned(),
        seconds @ 60..3600 => format!("{} min ago", seconds / 60),
        seconds @ 3600..86_400 => format!("{} h ago", seconds / 3600),
        seconds => format!("{} days ago", seconds / 86_400),
    }
}

/// Seconds since 1970.
pub fn now() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs())
}
