//! `--list`: which members there are, and what would be done about them. Opens no device.

use std::path::Path;

use super::shelf;
use super::survey::{Survey, order};
use super::wanted::Wanted;
use crate::app::shared::output;
use crate::app::{Exit, Failure};
use crate::scene::variants::Family;

/// Prints a line a member, in the order that they would be rendered in; those that are broken come last.
pub fn print(family: &Family, survey: &Survey, folder: &Path, wanted: &Wanted) -> Result<Exit, Failure> {
    let mut text = String::new();
    let mut broken = false;
    let width = family.members.iter().map(|member| member.name.chars().count()).max().unwrap_or(0);
    for index in order(&survey.found) {
        let Ok(subject) = &survey.found[index] else { continue };
        let state = match shelf::find(folder, subject) {
            Some(_) => "done",
            None if subject.is_reference || wanted.has(index, &subject.member.name) => "to be rendered",
            None => "not wanted",
        };
        let what = if subject.is_reference { ", the reference's own film" } else { "" };
        text += &format!("{:width$}  {state}{what}\n", subject.member.name);
    }
    for found in survey.found.iter().filter_map(|found| found.as_ref().err()) {
        broken = true;
        text += &format!("{:width$}  {}\n", found.member.name, found.error);
    }
    let trees: std::collections::BTreeSet<usize> =
        survey.found.iter().flatten().map(|subject| subject.keys.geometry).collect();
    text += &format!(
        "{} {}, {} trees, {} libraries of shaders, {} files read\n",
        family.members.len(),
        family.word(),
        trees.len(),
        survey.codes.len(),
        survey.files.len(),
    );
    output::print(&text)?;
    Ok(if broken { Exit::Failed } else { Exit::Done })
}
