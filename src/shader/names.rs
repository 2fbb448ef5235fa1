//! Which files of a folder are modules, and how they are called. The build script asks it too, so std is all it knows.

use std::path::Path;

/// What a shader's file ends in.
const ENDING: &str = "wgsl";

/// Whether a file is named as shaders are.
pub fn is_shader(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == ENDING)
}

/// The module of a file, whose path is given from the folder of shaders: that path with `/`, without `.wgsl`. None where no import
/// could name it: `x.orig.wgsl`, `x (copy).wgsl` and the like are what tools leave beside modules.
pub fn module_name(below: &Path) -> Option<String> {
    let file = below.with_extension("");
    let parts: Option<Vec<&str>> = file.iter().map(|part| part.to_str().filter(|part| is_identifier(part))).collect();
    parts.map(|parts| parts.join("/")).filter(|name| !name.is_empty())
}

/// Whether a name can stand in an import. Letters beyond ASCII are left to the compiler.
fn is_identifier(name: &str) -> bool {
    let fits = |c: char| !c.is_ascii() || c.is_ascii_alphanumeric() || c == '_';
    name.chars().all(fits) && !name.starts_with(|c: char| c.is_ascii_digit())
}
