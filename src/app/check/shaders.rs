//! What `lucerna check` does with shaders: it links and validates every entry point under every set of features, holds it to its row of
//! the pass table, and asks surfaces that are other code than the built-in ones whether sampling and evaluation agree.

use std::collections::BTreeSet;
use std::path::Path;

use super::surfaces::surfaces;
use crate::app::Failure;
use crate::app::shared::failure::show;
use crate::app::shared::output;
use crate::gpu::{Gpu, Values, checked_entry};
use crate::passes::Pass;
use crate::passes::table::TABLE;
use crate::shader::{Features, Library, ShaderError};
use crate::watch::lint::Surfaces;
use crate::watch::lint_edit;

/// What a check of a library has found, all of which was shown.
#[derive(Debug, Default)]
pub struct CheckedShaders {
    /// Linked in all, over the passes.
    pub variants: usize,
    pub errors: usize,
    pub warnings: usize,
    /// What came of the lint, in a few words; empty where there was nothing to lint.
    pub lint: String,
}

/// The shaders of a folder; none where it holds none of ours. What a part of a library lacks is taken from `./shaders`, or from those that
/// were built in, as in a family of scenes. `else_empty`: there is nothing else in it, so that any shader is meant as one of ours.
pub fn in_folder(folder: &Path, else_empty: bool) -> Result<Option<Library>, ShaderError> {
    let library = Library::open(folder)?;
    if folder.join("passes").is_dir() && folder.join("lib").is_dir() {
        return Ok(Some(library));
    }
    let built_in = Library::embedded();
    let ours = library.modules().any(|module| else_empty || built_in.modules().any(|other| other == module));
    Ok(ours.then(|| library.laid_over(&Library::shipped())))
}

/// Checks all of a library, and shows what is wrong.
pub fn check(library: &Library) -> CheckedShaders {
    let mut variants = 0;
    // One mistake in a shared module would be reported once a pass.
    let (mut errors, mut warnings) = (BTreeSet::new(), BTreeSet::new());
    let mut wrong = |error: ShaderError| {
        if errors.insert(error.to_string()) {
            show(&error);
        }
    };
    for pass in TABLE {
        match check_pass(library, pass) {
            Ok((count, slow)) => {
                variants += count;
                slow.iter().filter(|warning| warnings.insert(warning.to_string())).for_each(|warning| show(warning));
            }
            Err(error) => wrong(error),
        }
    }
    // What no pass imports, and what is drawn to a window.
    let plain = library.modules().map(|module| library.link(module, &Features::new()));
    plain.filter_map(Result::err).for_each(&mut wrong);
    let mut checked = CheckedShaders { variants, errors: errors.len(), warnings: warnings.len(), lint: String::new() };
    if checked.errors == 0 && !library.is_same(&Library::embedded()) {
        checked.lint(library);
    }
    checked
}

/// How many variants a pass has, if all are right, and what of them is slow to compile.
fn check_pass(library: &Library, pass: &Pass) -> Result<(usize, Vec<ShaderError>), ShaderError> {
    let sets = library.feature_sets(pass.module)?;
    let mut slow = Vec::new();
    for features in &sets {
        let linked = library.link(pass.module, features)?;
        slow.extend(linked.large_variables());
        checked_entry(pass, &linked, features)?;
    }
    Ok((sets.len(), slow))
}

impl CheckedShaders {
    /// Lints surfaces of every kind, where there is a device for it and their code is other than the built-in one.
    fn lint(&mut self, library: &Library) {
        let gpu = match Gpu::open() {
            Ok(gpu) => gpu,
            Err(error) => {
                self.warnings += 1;
                output::note("warning: surfaces were not linted, for there is nothing to draw with:");
                Failure::from(error).show();
                return;
            }
        };
        let materials = surfaces();
        let surfaces = Surfaces { materials: &materials, reused: true };
        match lint_edit(&gpu, [&Library::embedded(), library], &Values::new(), surfaces, || true) {
            None => {
                self.errors += 1;
                output::note("error: the code of surfaces links, and can't be run: they were not linted");
            }
            Some(None) => {}
            Some(Some((found, took))) => {
                found.iter().for_each(|problem| show(&*problem.diagnostic));
                self.warnings += found.len();
                let agree =
                    if found.is_empty() { "sampling and evaluation of surfaces agree" } else { "surfaces linted" };
                self.lint = format!("{agree} ({:.1} s)", took.as_secs_f64());
            }
        }
    }
}
