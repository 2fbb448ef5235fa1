//! Where a material's value belongs: a scene file may say it of a name, of one model's own, or by `model:material`.

use super::path::Step;
use super::write::follow;
use crate::scene::keys::{Key, Value as Kind};
use crate::scene::ron::Node;

/// What decides about it.
pub struct Places<'a> {
    /// The file itself.
    pub own: Node<'a>,
    /// With what it extends.
    pub merged: Node<'a>,
    /// The names of its models, in their order; none for one that has none.
    pub models: &'a [Option<String>],
}

/// A material of another model that has the same name, and what it is to be.
pub struct Sibling<'s> {
    /// `model:material`
    pub name: &'s str,
    /// It is to have the same value.
    pub agrees: bool,
}

impl Places<'_> {
    /// The path of a key of the material `name`, `model:material`, so that its value counts over all others: where it is given, if it may change there;
    /// else where the file says something of the material; else by the name alone, if all `siblings` agree.
    pub fn of(&self, name: &str, key: &Key, siblings: &[Sibling]) -> Vec<Step> {
        let bare = bare(name);
        let full = vec![Step::Field("materials"), Step::Key(name.to_owned())];
        let plain = vec![Step::Field("materials"), Step::Key(bare.to_owned())];
        let own = self.own_of(name);
        let shared = || siblings.iter().all(|other| other.agrees || self.is_said_nearer(other.name, key));
        let is_here = |path: &Vec<Step>| follow(&self.own, path).is_some_and(|node| !node.is_none());
        // A model in a file that this one extends can't be reached from here.
        let own_here = own.filter(is_here);
        let entry = match self.nearest(name, key) {
            Some(Level::Full) => full,
            Some(Level::Own) => own_here.unwrap_or(full),
            Some(Level::Plain) if shared() => plain,
            Some(Level::Plain) => full,
            None if is_here(&full) => full,
            None => match own_here {
                Some(own) => own,
                None if shared() => plain,
                None => full,
            },
        };
        [entry, vec![Step::Field(key.scene)]].concat()
    }

    /// The strongest place that gives a key of a material.
    fn nearest(&self, name: &str, key: &Key) -> Option<Level> {
        let gives = |entry: &[Step]| {
            let node = follow(&self.merged, &[entry, &[Step::Field(key.scene)]].concat());
            node.is_some_and(|node| matches!(key.value, Kind::Map(..) | Kind::Optional(..)) || !node.is_none())
        };
        let plain = [Step::Field("materials"), Step::Key(bare(name).to_owned())];
        let full = [Step::Field("materials"), Step::Key(name.to_owned())];
        // A name with a colon counts among those that name a model too: of them, the last does.
        let plain_wins = bare(name).contains(':') && bare(name) > name;
        match () {
            () if plain_wins && gives(&plain) => Some(Level::Plain),
            () if gives(&full) => Some(Level::Full),
            () if self.own_of(name).is_some_and(|own| gives(&own)) => Some(Level::Own),
            () if gives(&plain) => Some(Level::Plain),
            () => None,
        }
    }

    /// Whether what is said of its bare name does not reach a material.
    fn is_said_nearer(&self, name: &str, key: &Key) -> bool {
        matches!(self.nearest(name, key), Some(Level::Full | Level::Own))
    }

    /// What the material's model says of its own.
    fn own_of(&self, name: &str) -> Option<Vec<Step>> {
        let (model, bare) = name.split_once(':')?;
        let at = self.models.iter().position(|known| known.as_deref() == Some(model))?;
        Some(vec![Step::Field("models"), Step::Item(at), Step::Field("materials"), Step::Key(bare.to_owned())])
    }
}

/// From strong to weak.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Level {
    Full,
    Own,
    Plain,
}

/// A material's own name within `model:material`.
pub fn bare(name: &str) -> &str {
    name.split_once(':').map_or(name, |(_, bare)| bare)
}
