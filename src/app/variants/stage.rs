//! One engine that members take turns on.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::code::Codes;
use super::record::Work;
use super::survey::Subject;
use crate::components::Render;
use crate::engine::{Engine, EngineError};
use crate::gpu::{Code, Gpu};
use crate::scene::SceneDescription;

/// An engine, and the code that it ran and may run again.
pub struct Stage {
    pub engine: Engine,
    pub adapter: String,
    /// Code that is not run now, with all that was compiled of it.
    aside: BTreeMap<usize, Code>,
    /// The number of the code that is run.
    now: usize,
}

/// What an engine has done by now.
pub struct Tally {
    uploads: BTreeMap<&'static str, u64>,
    trees: u64,
    compiled: BTreeMap<&'static str, u64>,
    films: u64,
}

impl Stage {
    /// Opens an engine on the first member. Nothing is traced yet.
    pub fn open(gpu: Arc<Gpu>, codes: &Codes, subject: &Subject) -> Result<Self, EngineError> {
        let adapter = gpu.name();
        let engine = Engine::open(gpu, codes.library(subject.code).clone(), &subject.description)?;
        Ok(Self { engine, adapter, aside: BTreeMap::new(), now: subject.code })
    }

    /// Exchanges what a member has otherwise than the one before it; of its settings, `render`.
    pub fn put(&mut self, codes: &Codes, subject: &Subject, render: Render) -> Result<(), EngineError> {
        if subject.code != self.now {
            let next = match self.aside.remove(&subject.code) {
                Some(code) => code,
                None => self.engine.remake(codes.library(subject.code).clone())?,
            };
            let before = self.engine.run(next);
            self.aside.insert(std::mem::replace(&mut self.now, subject.code), before);
        }
        self.engine.apply(&SceneDescription { render, ..subject.description.clone() });
        Ok(())
    }

    pub fn tally(&self) -> Tally {
        let entered = |name: &str| self.engine.entered().get(name).copied().unwrap_or(0);
        Tally {
            uploads: self.engine.uploads().clone(),
            trees: entered("build_tree"),
            compiled: self.engine.compiled(),
            films: entered("begin_film"),
        }
    }

    /// What was done since `before`, of a member that so many files were read for.
    pub fn work(&self, before: &Tally, read: u32) -> Work {
        let now = self.tally();
        let since = |now: &BTreeMap<&'static str, u64>, before: &BTreeMap<&'static str, u64>| {
            let more = now.iter().map(|(name, count)| (*name, count - before.get(name).copied().unwrap_or(0)));
            more.filter(|(_, count)| *count > 0).map(|(name, count)| (name.to_owned(), count)).collect()
        };
        Work {
            read,
            uploaded: since(&now.uploads, &before.uploads),
            trees: now.trees - before.trees,
            compiled: since(&now.compiled, &before.compiled),
        }
    }

    /// Whether something was compiled since.
    pub fn compiled(&self, before: &Tally) -> bool {
        self.engine.compiled() != before.compiled
    }

    /// Whether a film was begun since.
    pub fn began(&self, before: &Tally) -> bool {
        self.tally().films > before.films
    }
}
