//! `lucerna check`: assets and shaders, nothing rendered.

mod asked;
mod materials;
mod shaders;
mod surfaces;

use std::path::{Path, PathBuf};

use clap::Args;

use self::asked::refused;
use crate::app::shared::failure::show;
use crate::app::shared::output;
use crate::app::shared::values::MORE;
use crate::app::{Exit, Failure};
use crate::passes::table::TABLE;
use crate::scene;
use crate::shader::Library;

#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub struct CheckArguments {
    /// Assets (.ron, .obj, .mtl), or folders of them or of shaders [default: the folder assets, and the shaders in use]
    pub paths: Vec<PathBuf>,
    /// Check the shaders of this folder, as `render --shaders DIR` would draw with them
    #[arg(long, value_name = "DIR")]
    pub shaders: Option<PathBuf>,
    /// Say of every statement of every material whether it is honoured, approximated or ignored, and why
    #[arg(long, requires = "paths")]
    pub materials: bool,
    /// With --materials: as one JSON object
    #[arg(long, requires = "materials")]
    pub json: bool,
}

/// What was counted, and what there is to be said in the end.
#[derive(Default)]
struct Counts {
    files: usize,
    errors: usize,
    warnings: usize,
    /// What was checked, as the heads of the last line.
    heads: Vec<String>,
    tables: String,
}

/// Checks what was named; without names, the folder of assets and every shader.
pub fn run(arguments: &CheckArguments) -> Result<Exit, Failure> {
    if arguments.materials {
        return materials::run(&arguments.paths, arguments.json);
    }
    let mut counts = Counts::default();
    for path in &arguments.paths {
        counts.add_path(path)?;
    }
    if let Some(folder) = &arguments.shaders {
        counts.add_shaders(&Library::open(folder)?);
    }
    if arguments.paths.is_empty() && arguments.shaders.is_none() {
        counts.add_assets(scene::check(&assets()));
        counts.add_shaders(&Library::shipped());
    }
    let Counts { files, errors, warnings, mut heads, tables } = counts;
    if files > 0 || heads.is_empty() {
        heads.insert(0, format!("{files} {}", plural(files, "asset", "assets")));
    }
    let [error, warning] = [plural(errors, "error", "errors"), plural(warnings, "warning", "warnings")];
    output::print(&format!("{}: {errors} {error}, {warnings} {warning}\n{tables}", heads.join(", ")))?;
    Ok(if errors == 0 { Exit::Done } else { Exit::Failed })
}

impl Counts {
    /// Checks a file, or what a folder has of assets and of shaders.
    fn add_path(&mut self, path: &Path) -> Result<(), Failure> {
        let checked = scene::check(path);
        let without_assets = path.is_dir() && checked.files.is_empty();
        if path.is_dir()
            && let Some(library) = shaders::in_folder(path, without_assets)?
        {
            self.add_shaders(&library);
            if without_assets {
                return Ok(());
            }
        }
        self.add_assets(checked);
        Ok(())
    }

    /// Shows what is wrong with assets.
    fn add_assets(&mut self, checked: scene::Checked) {
        self.files += checked.files.len();
        for diagnostic in checked.diagnostics.list.iter().chain(&refused(&checked.asked)) {
            match diagnostic.severity {
                scene::Severity::Error => self.errors += 1,
                scene::Severity::Warning => self.warnings += 1,
            }
            show(diagnostic);
        }
        checked.tables.iter().for_each(|table| self.tables += &rendered(table));
    }

    /// Checks shaders, and shows what is wrong with them.
    fn add_shaders(&mut self, library: &Library) {
        let checked = shaders::check(library);
        self.errors += checked.errors;
        self.warnings += checked.warnings;
        self.heads.push(format!("{} passes in {} variants", TABLE.len(), checked.variants));
        self.heads.extend((!checked.lint.is_empty()).then_some(checked.lint));
    }
}

fn plural<'a>(n: usize, one: &'a str, many: &'a str) -> &'a str {
    if n == 1 { one } else { many }
}

/// A file's materials and lights, one a line: name, what it is taken as, and why.
fn rendered(table: &scene::Table) -> String {
    let width = |texts: &mut dyn Iterator<Item = usize>| texts.max().unwrap_or_default().min(40);
    let names = width(&mut table.rows.iter().map(|row| row.name.chars().count()));
    let kinds = width(&mut table.rows.iter().map(|row| row.look.kind.len()));
    let mut text = format!("\n{}\n", table.file.display());
    for scene::Row { name, look } in &table.rows {
        text += &format!("  {:names$}  {:kinds$}  {}\n", scene::printable_name(name), look.kind, look.reason);
    }
    text
}

/// The folder of assets: of the current folder, or of the source tree this was built from.
fn assets() -> PathBuf {
    let here = Path::new("assets");
    if here.is_dir() { here.to_path_buf() } else { Path::new(env!("CARGO_MANIFEST_DIR")).join("assets") }
}
