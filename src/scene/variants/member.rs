//! Members of a family: the grid of its axes, and those written by hand.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::family::{Axis, Family, MOST_MEMBERS, Member};
use super::file::{ByHand, FamilyFile};
use super::label::label_of;
use super::sweep::Swept;
use super::target::change;
use crate::scene::define::{Define, Written};
use crate::scene::diagnostic::{Diagnostic, Diagnostics, Severity};
use crate::scene::suggest::did_you_mean;

/// Letters of a member's name.
const LONGEST: usize = 120;

/// All members of a family that was read.
pub fn enumerate(
    path: &Path,
    family: FamilyFile,
    defines: &[Define],
    files: Vec<PathBuf>,
) -> Result<Family, Diagnostics> {
    let fail = |diagnostic: Diagnostic| Diagnostics { list: vec![diagnostic] };
    let at = |message: String| Diagnostic { message, ..family.place.clone() };
    if family.sweep.is_empty() && family.members.is_empty() {
        let help = "give a `sweep: { \"path\": [a, b] }`, or `members: { \"name\": { \"path\": value } }`";
        return Err(fail(at("nothing is varied".into()).help(help)));
    }
    let of_grid = if family.sweep.is_empty() { Some(0) } else { product(&family.sweep) };
    let count = of_grid.and_then(|grid| grid.checked_add(family.members.len()));
    let Some(grid) = of_grid.filter(|_| count.is_some_and(|count| count <= MOST_MEMBERS)) else {
        let axis = |swept: &Swept| format!("`{}` has {}", swept.name, swept.labels.len());
        let axes: Vec<String> = family.sweep.iter().map(axis).collect();
        let many = count.map_or_else(|| "too many".to_owned(), |count| count.to_string());
        let message = format!("{many} members, where at most {MOST_MEMBERS} are rendered: {}", axes.join(", "));
        let place = family.sweep.first().map_or(family.place.clone(), |swept| swept.place.clone());
        return Err(fail(Diagnostic { severity: Severity::Error, message, ..place }.help("go through fewer values")));
    };
    let columns = family.sweep.iter().flat_map(|axis| &axis.columns);
    let columns: Vec<(&str, &Diagnostic)> = columns.map(|column| (column.path.as_str(), &column.place)).collect();
    let help = "one would write over the other: go through one of them, or through both by one axis of named({..})";
    refuse_overlaps(&columns, help).map_err(fail)?;
    let plain = plain(&family.place, family.overrides.iter().chain(defines));
    let mut members = Vec::with_capacity(grid + family.members.len());
    for index in 0..grid {
        members.push(of_grid_at(&family.sweep, index, plain.clone()));
    }
    for by_hand in &family.members {
        members.push(written(by_hand, plain.clone()).map_err(fail)?);
    }
    refuse_equal_names(&members).map_err(fail)?;
    if let Some((chosen, place)) = &family.reference
        && members.iter().all(|member| member.name != chosen.member)
    {
        let names: Vec<&str> = members.iter().map(|member| member.name.as_str()).collect();
        let help = did_you_mean(&chosen.member, names.iter().copied()).unwrap_or_else(|| {
            let some: Vec<&str> = names.iter().take(12).copied().collect();
            format!("members: {}{}", some.join(", "), if names.len() > some.len() { ", .." } else { "" })
        });
        let message = format!("reference: there is no member `{}`", chosen.member);
        return Err(fail(Diagnostic { severity: Severity::Error, message, ..place.clone() }.help(help)));
    }
    let axis = |swept: &Swept| Axis {
        name: swept.name.clone(),
        paths: swept.columns.iter().map(|column| column.path.clone()).collect(),
        labels: swept.labels.clone(),
    };
    Ok(Family {
        name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        path: path.to_path_buf(),
        scene: family.scene,
        axes: family.sweep.iter().map(axis).collect(),
        members,
        reference: family.reference.map(|(chosen, _)| chosen),
        goal: family.goal,
        fps: None,
        keyed: BTreeSet::new(),
        warnings: hidden(&columns, defines),
        files,
    })
}

/// As every member of a file begins, of which `place` is an error without its message.
pub fn plain<'d>(place: &Diagnostic, defines: impl Iterator<Item = &'d Define>) -> Member {
    let mut plain = Member {
        name: String::new(),
        at: Vec::new(),
        scene: None,
        defines: Vec::new(),
        shaders: None,
        place: Diagnostic { severity: Severity::Warning, ..place.clone() },
        wrong: None,
    };
    for define in defines {
        change(&mut plain, define);
    }
    plain
}

/// How many members a grid has; none where that is beyond counting.
fn product(axes: &[Swept]) -> Option<usize> {
    axes.iter().try_fold(1usize, |product, axis| product.checked_mul(axis.labels.len()))
}

/// A member of the grid by its number, the last axis fastest.
fn of_grid_at(axes: &[Swept], index: usize, plain: Member) -> Member {
    let mut member = plain;
    let mut rest = index;
    member.at = axes.iter().rev().map(|axis| (rest % axis.labels.len(), rest /= axis.labels.len()).0).collect();
    member.at.reverse();
    for (axis, at) in axes.iter().zip(member.at.clone()) {
        for column in &axis.columns {
            let value = &column.values[at];
            let written = Written::File { path: Box::new(column.place.clone()), value: Box::new(value.place.clone()) };
            change(&mut member, &Define { path: column.path.clone(), value: value.value.clone(), written });
        }
        member.place = axis.place.clone();
    }
    let labels: Vec<&str> = axes.iter().zip(&member.at).map(|(axis, at)| axis.labels[*at].as_str()).collect();
    let name = labels.join("_");
    member.name = if name.chars().count() <= LONGEST { name } else { format!("member-{}", index + 1) };
    member
}

fn written(by_hand: &ByHand, plain: Member) -> Result<Member, Diagnostic> {
    let error = |message: String| Diagnostic { severity: Severity::Error, message, ..by_hand.place.clone() };
    let fits = label_of(&by_hand.name);
    if fits != by_hand.name || by_hand.name.chars().count() > LONGEST {
        let message = format!("members: `{}` can't be the name of a file", by_hand.name.escape_debug());
        return Err(error(message).help(format!("such as `{fits}`")));
    }
    let mut member = Member { name: by_hand.name.clone(), place: by_hand.place.clone(), ..plain };
    for define in &by_hand.changes {
        change(&mut member, define);
    }
    Ok(member)
}

/// A path that is changed twice, or of which a part is, would be what the later change says for all members. Paths have their places.
pub fn refuse_overlaps(columns: &[(&str, &Diagnostic)], help: &str) -> Result<(), Diagnostic> {
    for (i, (path, place)) in columns.iter().enumerate() {
        let is_over = |other: &str| {
            let part = other.strip_prefix(path).or(path.strip_prefix(other));
            part.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        if let Some((other, _)) = columns[..i].iter().find(|(other, _)| is_over(other)) {
            let message = format!("`{other}` and `{path}` are changed at once");
            return Err(Diagnostic { severity: Severity::Error, message, ..(*place).clone() }.help(help));
        }
    }
    Ok(())
}

/// Two members of one name would be one file; also where only the case differs, for some systems know no case.
fn refuse_equal_names(members: &[Member]) -> Result<(), Diagnostic> {
    let mut known: BTreeMap<String, &Member> = BTreeMap::new();
    for member in members {
        if let Some(first) = known.insert(member.name.to_lowercase(), member) {
            let message = format!("two members are named `{}`", member.name);
            let help =
                format!("the other one: {}:{}:{}", first.place.file.display(), first.place.line, first.place.column);
            return Err(Diagnostic { severity: Severity::Error, message, ..member.place.clone() }.help(help));
        }
    }
    Ok(())
}

/// Says which defines of the command line members write over.
pub fn hidden(columns: &[(&str, &Diagnostic)], defines: &[Define]) -> Vec<Diagnostic> {
    let over = columns.iter().filter(|(path, _)| defines.iter().any(|define| define.path == *path));
    let message = |path: &str| format!("`{path}` changes here, which writes over `-D {path}=..`");
    over.map(|(path, place)| Diagnostic { severity: Severity::Warning, message: message(path), ..(*place).clone() })
        .collect()
}
