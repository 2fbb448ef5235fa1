//! Other text in the place of a shader's.

use crate::shader::Library;
use crate::stress::measured::StressError;

/// A library with `wrong` in place of `right` in a module.
pub fn plant(library: Library, module: &str, right: &str, wrong: &str) -> Result<Library, StressError> {
    let broken = |what: String| Err(StressError::Broken(what));
    let Some(text) = library.text(module) else { return broken(format!("there is no module {module}")) };
    if !text.contains(right) {
        return broken(format!("{module} has no `{right}`: the mistake is to be planted elsewhere"));
    }
    let text = text.replace(right, wrong);
    Ok(library.with(module, &text))
}
