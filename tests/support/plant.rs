//! Mistakes in shaders, which a test has to notice.

use lucerna::shader::Library;

/// The shipped shaders with `wrong` in place of `right` in a module.
pub fn planted(module: &str, right: &str, wrong: &str) -> Library {
    plant(Library::shipped(), module, right, wrong)
}

/// A library with `wrong` in place of `right` in a module.
pub fn plant(library: Library, module: &str, right: &str, wrong: &str) -> Library {
    let text = library.text(module).unwrap_or_else(|| panic!("there is no module {module}"));
    assert!(text.contains(right), "{module} has changed: plant the error elsewhere");
    let text = text.replace(right, wrong);
    library.with(module, &text)
}
