//! `lucerna check`: assets and shaders, nothing rendered.

mod materials;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::app::shared::failure::show;
use crate::app::shared::output;
use crate::app::shared::values::EXIT_CODES;
use crate::app::{Exit, Failure};
use crate::gpu::checked_entry;
use crate::passes::Pass;
use crate::passes::table::TABLE;
use crate::scene;
use crate::shader::{Library, ShaderError};

#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct CheckArguments {
    /// Assets (.ron, .obj, .mtl) or folders of them [default: the folder assets, and all shaders]
    pub paths: Vec<PathBuf>,
    /// Say of every statement of every material whether it is honoured, approximated or ignored, and why
    #[arg(long, requires = "paths")]
    pub materials: bool,
    /// With --materials: as one JSON object
    #[arg(long, requires = "materials")]
    pub json: bool,
}

/// Checks what was named; without names, the folder of assets and every shader.
pub fn run(arguments: &CheckArguments) -> Result<Exit, Failure> {
    if arguments.materials {
        return materials::run(&arguments.paths, arguments.json);
    }
    let mut errors = 0;
    let mut warnings = 0;
    let mut files = 0;
    let mut tables = String::new();
    let paths = if arguments.paths.is_empty() { vec![assets()] } else { arguments.paths.clone() };
    for path in &paths {
        let checked = scene::check(path);
        files += checked.files.len();
        for diagnostic in &checked.diagnostics.list {
            match diagnostic.severity {
                scene::Severity::Error => errors += 1,
                scene::Severity::Warning => warnings += 1,
            }
            show(diagnostic);
        }
        checked.tables.iter().for_each(|table| tables += &rendered(table));
    }
    let mut text = format!("{files} {}", plural(files, "asset", "assets"));
    if arguments.paths.is_empty() {
        let (variants, wrong, slow) = check_shaders();
        errors += wrong;
        warnings += slow;
        text += &format!(", {} passes in {variants} variants", TABLE.len());
    }
    text += &format!(
        ": {errors} {}, {warnings} {}\n",
        plural(errors, "error", "errors"),
        plural(warnings, "warning", "warnings")
    );
    output::print(&(text + &tables))?;
    Ok(if errors == 0 { Exit::Done } else { Exit::Failed })
}

fn plural<'a>(n: usize, one: &'a str, many: &'a str) -> &'a str {
    if n == 1 { one } else { many }
}

/// A file's materials and lights, one a line: name, what it is taken as, and why.
fn rendered(table: &scene::Table) -> String {
    let shown = |name: &str| -> String { name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect() };
    let width = |texts: &mut dyn Iterator<Item = usize>| texts.max().unwrap_or_default().min(40);
    let names = width(&mut table.rows.iter().map(|row| row.name.chars().count()));
    let kinds = width(&mut table.rows.iter().map(|row| row.look.kind.len()));
    let mut text = format!("\n{}\n", table.file.display());
    for scene::Row { name, look } in &table.rows {
        text += &format!("  {:names$}  {:kinds$}  {}\n", shown(name), look.kind, look.reason);
    }
    text
}

/// The folder of assets: of the current folder, or of the source tree this was built from.
fn assets() -> PathBuf {
    let here = Path::new("assets");
    if here.is_dir() { here.to_path_buf() } else { Path::new(env!("CARGO_MANIFEST_DIR")).join("assets") }
}

/// Links every pass under every set of features its modules name, and checks its row. How many variants were right, how
/// many mistakes there are, and how many warnings.
fn check_shaders() -> (usize, usize, usize) {
    let library = Library::shipped();
    let mut variants = 0;
    // One mistake in a shared module would be reported once a pass.
    let (mut errors, mut warnings) = (BTreeSet::new(), BTreeSet::new());
    for pass in TABLE {
        match check_pass(&library, pass) {
            Ok((count, slow)) => {
                variants += count;
                slow.iter().filter(|warning| warnings.insert(warning.to_string())).for_each(|warning| show(warning));
            }
            Err(error) => {
                if errors.insert(error.to_string()) {
                    show(&error);
                }
            }
        }
    }
    (variants, errors.len(), warnings.len())
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
