//! The statements of a library one by one, and how each was read: kept only for who asks.

use std::collections::BTreeMap;

use super::draft::{Draft, Habits};
use super::material::MtlMaterial;
use crate::scene::diagnostic::{Diagnostic, Tally};
use crate::scene::keys::Key;
use crate::scene::lines::Line;
use crate::scene::printable::printable_name;

/// Statements that are kept of one library.
const MOST: usize = 100_000;

/// Characters of a statement that are kept.
const SHOWN: usize = 80;

/// One statement of a material.
#[derive(Clone, Debug)]
pub struct Statement {
    /// As it is written, with what follows, in one line.
    pub text: String,
    /// What it says: a key's name in scene files, or `le`, `tr`, `disp`; none for all others.
    pub what: Option<&'static str>,
    /// A warning about it, without its message.
    pub place: Diagnostic,
    /// Its value was read.
    pub taken: bool,
    /// What was said when it was read.
    pub said: Option<String>,
    /// The line of the statement that says the same later in this material.
    pub superseded: Option<u32>,
}

/// What a library says of one material.
#[derive(Clone, Debug)]
pub struct Account {
    pub statements: Vec<Statement>,
    /// What it comes to, without a scene file.
    pub material: MtlMaterial,
    /// `illum` as it is written.
    pub illum: u32,
    /// Where both `Ke` and `Le` are given, `Le` counts.
    pub counts_le: bool,
    pub habits: Habits,
}

/// What a scene file changes of a material: keys by their names in scene files, and where.
pub type Edited = BTreeMap<&'static str, Diagnostic>;

impl Account {
    /// Whether a statement says what a key is, or `le`, `tr`, `disp`.
    pub fn says(&self, what: &str) -> bool {
        self.statements.iter().any(|statement| statement.taken && statement.what == Some(what))
    }

    /// What was read of the library otherwise than each statement says by itself.
    pub fn policies(&self) -> impl Iterator<Item = &'static str> {
        let constant = "an exporter's constant: one `illum`, `Ni` and `Tf` of glass on the whole library make none";
        let opacity = "`Tr` is opacity in this library: as transparency it would hide most of it";
        let habits = [(self.habits.glass_is_constant, constant), (self.habits.tr_is_opacity, opacity)];
        habits.into_iter().filter_map(|(is, what)| is.then_some(what))
    }
}

/// All statements of a library, by material.
#[derive(Default)]
pub struct Ledger {
    /// None where nobody asks.
    materials: Option<BTreeMap<String, Vec<Statement>>>,
    current: String,
    /// Statements so far, kept or not.
    count: usize,
}

impl Ledger {
    /// One that keeps statements.
    pub fn new() -> Self {
        Self { materials: Some(BTreeMap::new()), ..Self::default() }
    }

    /// A material begins, in the place of one of the same name.
    pub fn start(&mut self, name: &str) {
        if let Some(materials) = &mut self.materials {
            name.clone_into(&mut self.current);
            materials.insert(name.to_owned(), Vec::new());
        }
    }

    /// Keeps a statement that was just read, and what was said of it.
    pub fn note(&mut self, line: &Line, word: &str, rest: &str, taken: bool, tally: &mut Tally) {
        let Some(list) = self.materials.as_mut().and_then(|materials| materials.get_mut(&self.current)) else { return };
        let said = tally.heard().into_iter().next();
        self.count += 1;
        if self.count > MOST {
            return;
        }
        let place = line.warning(word, "");
        let what = what(word);
        if taken && what.is_some() {
            list.iter_mut().filter(|earlier| earlier.what == what).for_each(|s| s.superseded = Some(place.line));
        }
        let words: Vec<&str> = std::iter::once(word).chain(rest.split_whitespace()).collect();
        let text = printable_name(&words.join(" ").chars().take(SHOWN).collect::<String>());
        list.push(Statement { text, what, place, taken, said, superseded: None });
    }

    /// Statements that were too many to be kept.
    pub fn left_out(&self) -> usize {
        self.count.saturating_sub(MOST)
    }

    /// What was kept of a material.
    pub fn account(&self, draft: &Draft, material: MtlMaterial, habits: Habits) -> Account {
        let kept = self.materials.as_ref().and_then(|materials| materials.get(draft.name()));
        let statements = kept.cloned().unwrap_or_default();
        Account { statements, material, illum: draft.written_illum(), counts_le: draft.counts_le(), habits }
    }
}

/// Statements that say something beside the keys.
const OTHERS: [(&str, &str); 4] = [("le", "le"), ("tr", "tr"), ("disp", "disp"), ("map_disp", "disp")];

/// What a statement says.
fn what(word: &str) -> Option<&'static str> {
    let other = || OTHERS.iter().find(|(name, _)| word.eq_ignore_ascii_case(name)).map(|(_, what)| *what);
    Key::of_statement(word).map(|key| key.scene).or_else(other)
}
