//! The flags of settings: made from their table, and applied over what a scene says.

use clap::builder::PossibleValue;
use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches, value_parser};
use glam::UVec2;

use super::values::{crop, size, stops};
use crate::components::Crop;
use crate::scene::settings::{SETTINGS, Setting, Settings, Value};

/// The settings that a command line gives.
#[derive(Clone, Debug, Default)]
pub struct SettingFlags {
    given: Vec<&'static Setting>,
    /// Of which those that are given count.
    values: Settings,
}

impl SettingFlags {
    /// Whether the flag of a field was given.
    pub fn gives(&self, field: &str) -> bool {
        self.given.iter().any(|setting| setting.field == field)
    }

    /// Writes what was given over other settings.
    pub fn apply(&self, settings: &mut Settings) {
        self.given.iter().for_each(|setting| setting.copy(&self.values, settings));
    }
}

/// The flag of a setting, if it has one.
fn argument(setting: &'static Setting) -> Option<Arg> {
    let flag = setting.flag?;
    let argument = Arg::new(setting.field).long(flag.name).value_name(flag.value).help(flag.help);
    Some(match setting.value {
        Value::Whole { least: 0, most: u32::MAX, .. } => argument.value_parser(value_parser!(u32)),
        Value::Whole { least, most: u32::MAX, .. } => {
            argument.value_parser(value_parser!(u32).range(i64::from(least)..))
        }
        Value::Whole { least, most, .. } => {
            argument.value_parser(value_parser!(u32).range(i64::from(least)..=i64::from(most)))
        }
        Value::Stops { .. } => argument.value_parser(stops).allow_hyphen_values(true),
        Value::Switch(_) => argument.value_parser(["on", "off"]),
        Value::Choice(at) => {
            let words = at(&mut Settings::default()).words();
            let values = words.iter().map(|word| PossibleValue::new(word.name).help(word.help));
            argument.value_parser(values.collect::<Vec<_>>())
        }
        Value::Size(_) => argument.value_parser(size),
        Value::Crop(_) => argument.value_parser(crop).allow_hyphen_values(true),
    })
}

/// Writes the value of a flag that was given to where its setting has it.
fn read(setting: &Setting, matches: &ArgMatches, values: &mut Settings) -> Option<()> {
    let word = || matches.get_one::<String>(setting.field).map(String::as_str);
    match setting.value {
        Value::Whole { at, .. } => *at(values) = *matches.get_one(setting.field)?,
        Value::Stops { at, .. } => *at(values) = *matches.get_one(setting.field)?,
        Value::Switch(at) => *at(values) = word()? == "on",
        Value::Choice(at) => {
            let (word, choice) = (word()?, at(values));
            choice.choose(choice.words().iter().position(|known| known.name == word)?);
        }
        Value::Size(at) => *at(values) = *matches.get_one::<UVec2>(setting.field)?,
        Value::Crop(at) => *at(values) = Some(*matches.get_one::<Crop>(setting.field)?),
    }
    Some(())
}

impl FromArgMatches for SettingFlags {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut flags = Self::default();
        flags.update_from_arg_matches(matches)?;
        Ok(flags)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        let flagged = SETTINGS.iter().filter(|setting| setting.flag.is_some());
        let values = &mut self.values;
        self.given.extend(flagged.filter(|setting| read(setting, matches, values).is_some()));
        Ok(())
    }
}

impl Args for SettingFlags {
    fn augment_args(command: Command) -> Command {
        command.args(SETTINGS.iter().filter_map(argument))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}
