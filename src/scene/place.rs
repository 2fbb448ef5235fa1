//! Where models are: their names, and the transforms of those that move with others.

use std::collections::BTreeMap;
use std::path::Path;

use glam::DAffine3;

use super::diagnostic::{Diagnostic, Diagnostics};
use super::file::{ModelEntry, Parent};
use super::locate::stem;
use super::suggest::known_names;

/// The name of a model, and its place in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Unique.
    pub name: String,
    /// To world space.
    pub transform: DAffine3,
}

/// Places all models, one by one as they are in the scene file; none of those that can't be, which is told.
pub fn place(entries: &[ModelEntry], diagnostics: &mut Diagnostics) -> Vec<Option<Placed>> {
    let names = names(entries, diagnostics);
    let numbers: BTreeMap<&str, usize> =
        names.iter().enumerate().filter_map(|(number, name)| Some((name.as_deref()?, number))).collect();
    let models = Models { entries, names: &names, numbers };
    let mut told = Vec::new();
    let placed = names.iter().enumerate().map(|(number, name)| {
        let transform = models.transform(number).map_err(|error| {
            // All in a circle have the same to say.
            if !told.contains(&error.message) {
                told.push(error.message.clone());
                diagnostics.push(error);
            }
        });
        Some(Placed { name: name.clone()?, transform: transform.ok()? })
    });
    placed.collect()
}

/// The names of models, in their order; none for one whose name is taken.
pub fn names(entries: &[ModelEntry], diagnostics: &mut Diagnostics) -> Vec<Option<String>> {
    let mut taken = BTreeMap::new();
    let name = |entry: &ModelEntry| {
        if let Some(name) = entry.name.as_ref().filter(|name| taken.contains_key(*name)) {
            let message = format!("a model before this one is named `{name}` too");
            diagnostics.push(Diagnostic { message, ..entry.place.clone() }.help("give it another `name`"));
            return None;
        }
        let own = || stem(Path::new(&entry.path.replace('\\', "/")));
        Some(unique(entry.name.clone().unwrap_or_else(own), &mut taken))
    };
    entries.iter().map(name).collect()
}

/// The name itself, or for its second use `name-2`, and so on.
fn unique(name: String, taken: &mut BTreeMap<String, u32>) -> String {
    let count = taken.entry(name.clone()).or_insert(0);
    *count += 1;
    if *count == 1 {
        return name;
    }
    let numbered = format!("{name}-{count}");
    unique(numbered, taken)
}

/// The models of a scene, by their places in its list.
struct Models<'e> {
    entries: &'e [ModelEntry],
    names: &'e [Option<String>],
    numbers: BTreeMap<&'e str, usize>,
}

impl Models<'_> {
    /// From a model's own space to the world.
    fn transform(&self, number: usize) -> Result<DAffine3, Diagnostic> {
        let mut chain = vec![number];
        let mut transform = self.entries[number].transform;
        let mut next = self.entries[number].parent.as_ref();
        while let Some(parent) = next {
            let Some(&number) = self.numbers.get(parent.name.as_str()) else { return Err(self.missing(parent)) };
            if let Some(first) = chain.iter().position(|met| *met == number) {
                return Err(self.circle(&chain[first..]));
            }
            chain.push(number);
            transform = self.entries[number].transform * transform;
            next = self.entries[number].parent.as_ref();
        }
        let determinant = transform.matrix3.determinant();
        if !(transform.is_finite() && determinant.abs() > 1e-100) {
            let message = "this transform, with those of its parents, flattens the model".to_owned();
            return Err(Diagnostic { message, ..self.entries[number].place.clone() });
        }
        Ok(transform)
    }

    fn missing(&self, parent: &Parent) -> Diagnostic {
        let message = format!("there is no model `{}` to be a parent", parent.name);
        let help = known_names(&parent.name, self.numbers.keys().copied());
        Diagnostic { message, ..parent.place.clone() }.help(help)
    }

    /// An error about models that move with each other, at the first of them by name.
    fn circle(&self, chain: &[usize]) -> Diagnostic {
        let name = |number: &usize| self.names[*number].as_deref().unwrap_or_default();
        let start = (0..chain.len()).min_by_key(|at| name(&chain[*at])).unwrap_or(0);
        let around = chain[start..].iter().chain(&chain[..=start]);
        let shown: Vec<String> = around.map(|number| format!("`{}`", name(number))).collect();
        let place = self.entries[chain[start]].parent.as_ref().map(|parent| parent.place.clone());
        let message =
            format!("{}: these models have no place, for each moves with the next", shown.join(" moves with "));
        let place = place.unwrap_or_else(|| self.entries[chain[start]].place.clone());
        Diagnostic { message, ..place }.help("leave out one of these `parent`")
    }
}
