//! A variant file, and those that it extends, as they are written: what is exchanged, and where each thing stands.

use std::path::{Path, PathBuf};

use super::family::{Chosen, Goal};
use super::sweep::{Swept, read_sweep};
use super::values::place_of;
use crate::scene::assets::Assets;
use crate::scene::define::{Define, Written};
use crate::scene::diagnostic::{Diagnostic, Diagnostics, Severity};
use crate::scene::file::{Chain, is_of_family, take_extends};
use crate::scene::read::SCENE_LIMIT;
use crate::scene::ron::{Fields, Node, Reader, parse};

/// The most samples a pixel, and seconds, of a goal.
const MOST_SPP: u32 = 1 << 24;
const MOST_SECONDS: f64 = 1e6;

/// What a chain of variant files comes to.
#[derive(Debug)]
pub struct FamilyFile {
    /// The scene at its end.
    pub scene: PathBuf,
    pub overrides: Vec<Define>,
    pub sweep: Vec<Swept>,
    pub members: Vec<ByHand>,
    pub reference: Option<(Chosen, Diagnostic)>,
    pub goal: Option<Goal>,
    /// Of the first file: an error without its message.
    pub place: Diagnostic,
}

/// A member beside the grid.
#[derive(Debug)]
pub struct ByHand {
    pub name: String,
    pub place: Diagnostic,
    pub changes: Vec<Define>,
}

/// Reads a variant file and those that it extends. `files` gets each of them.
pub fn read_family(path: &Path, assets: &Assets, files: &mut Vec<PathBuf>) -> Result<FamilyFile, Diagnostics> {
    read_next(path, assets, files, Chain::new(path))
}

fn read_next(
    path: &Path,
    assets: &Assets,
    files: &mut Vec<PathBuf>,
    mut chain: Chain,
) -> Result<FamilyFile, Diagnostics> {
    files.push(path.to_path_buf());
    let text = assets.text(path, SCENE_LIMIT);
    let text = text.as_ref().as_ref().map_err(|error| one(error.clone()))?;
    let mut root = parse(text).map_err(one)?;
    let place = Diagnostic::file(Severity::Error, path, "");
    let Some(extends) = take_extends(&mut root).map_err(one)? else {
        let error = Diagnostic { message: "the field `extends` is missing".into(), ..place };
        return Err(one(error.help("name the scene that is to be varied: extends: \"../scenes/teapot.ron\"")));
    };
    let next = chain.add(&extends).map_err(one)?;
    let base = match is_family(&next, assets) {
        true => read_next(&next, assets, files, chain)?,
        false => FamilyFile {
            scene: next,
            overrides: Vec::new(),
            sweep: Vec::new(),
            members: Vec::new(),
            reference: None,
            goal: None,
            place: place.clone(),
        },
    };
    let reader = Reader::default();
    let family = read_fields(&reader, &root, base);
    let diagnostics = reader.into_diagnostics();
    match family {
        Some(family) if !diagnostics.has_errors() => Ok(FamilyFile { place, ..family }),
        _ => Err(diagnostics),
    }
}

/// Whether a file is a variant file.
pub fn is_family(path: &Path, assets: &Assets) -> bool {
    let is_ron = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ron"));
    is_ron
        && path.is_file()
        && assets
            .text(path, SCENE_LIMIT)
            .as_ref()
            .as_ref()
            .is_ok_and(|text| parse(text).is_ok_and(|root| is_of_family(&root)))
}

/// What a file writes over what it extends.
fn read_fields(reader: &Reader, root: &Node, base: FamilyFile) -> Option<FamilyFile> {
    let fields = Fields::open(reader, root, "")?;
    let mut family = base;
    if let Some(node) = fields.get("overrides") {
        family.overrides.extend(changes(reader, node, "overrides")?);
    }
    if let Some(node) = fields.get("sweep") {
        for swept in read_sweep(reader, node)? {
            match family.sweep.iter().position(|held| held.name == swept.name) {
                Some(at) => family.sweep[at] = swept,
                None => family.sweep.push(swept),
            }
        }
    }
    for member in members(reader, fields.get("members"))? {
        match family.members.iter().position(|held| held.name == member.name) {
            Some(at) => family.members[at] = member,
            None => family.members.push(member),
        }
    }
    if let Some(node) = fields.get("reference") {
        family.reference = Some((read_reference(reader, node)?, place_of(node)));
    }
    if let Some(node) = fields.get("goal") {
        family.goal = Some(read_goal(reader, node)?);
    }
    fields.finish().then_some(family)
}

/// Changes of values, by their paths.
fn changes(reader: &Reader, node: &Node, about: &str) -> Option<Vec<Define>> {
    let fields = node.fields().map_err(|message| reader.error(node, about, message)).ok()?;
    let define = |(path, place, value): &(String, &str, Node)| Define {
        path: path.clone(),
        value: value.source.to_owned(),
        written: Written::File {
            path: Box::new(node.text.at(Severity::Warning, place, "")),
            value: Box::new(place_of(value)),
        },
    };
    Some(fields.iter().map(define).collect())
}

fn members(reader: &Reader, node: Option<&Node>) -> Option<Vec<ByHand>> {
    let Some(node) = node else { return Some(Vec::new()) };
    let fields = node.fields().map_err(|message| reader.error(node, "members", message)).ok()?;
    let member = |(name, place, value): &(String, &str, Node)| {
        let changes = changes(reader, value, &format!("members.{name}"))?;
        Some(ByHand { name: name.clone(), place: node.text.at(Severity::Warning, place, ""), changes })
    };
    fields.iter().map(member).collect()
}

/// `"name"`, or `(member: "name", spp: 4096)`.
fn read_reference(reader: &Reader, node: &Node) -> Option<Chosen> {
    if let Ok(member) = node.string() {
        return Some(Chosen { member, spp: None });
    }
    let fields = Fields::open(reader, node, "reference")?;
    let member = fields.require("member", Node::string);
    let spp = fields.read("spp", |node| node.integer(1, MOST_SPP));
    fields.finish().then_some(Chosen { member: member?, spp })
}

/// `(spp: ..)`, `(time: ..)` or `(error: ..)`.
fn read_goal(reader: &Reader, node: &Node) -> Option<Goal> {
    let fields = Fields::open(reader, node, "goal")?;
    let samples = fields.read("spp", |node| ascending(node, |node| node.integer(1, MOST_SPP))).map(Goal::Samples);
    let seconds =
        fields.read("time", |node| ascending(node, |node| node.number(1e-3, MOST_SECONDS))).map(Goal::Seconds);
    let error = fields.read("error", |node| node.number(1e-9, 1e3)).map(Goal::Error);
    let goals: Vec<Goal> = [samples, seconds, error].into_iter().flatten().collect();
    if ["spp", "time", "error"].into_iter().filter(|name| fields.get(name).is_some()).count() != 1 {
        fields.fail("exactly one of `spp`, `time` and `error` is needed");
    }
    fields.finish().then_some(goals.into_iter().next()?)
}

/// One value, or a list of them, each above the one before.
fn ascending<'a, T: PartialOrd>(
    node: &Node<'a>,
    read: impl Fn(&Node<'a>) -> Result<T, String>,
) -> Result<Vec<T>, String> {
    let values = match node.items() {
        Ok(items) => items.iter().map(&read).collect::<Result<Vec<T>, String>>()?,
        Err(_) => vec![read(node)?],
    };
    match !values.is_empty() && values.windows(2).all(|pair| pair[0] < pair[1]) {
        true => Ok(values),
        false => Err("expected values that ascend".into()),
    }
}

fn one(diagnostic: Diagnostic) -> Diagnostics {
    diagnostic.into()
}
