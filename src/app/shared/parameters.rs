//! What a scene sets of shaders' parameters: refused where no shader has it, told where nothing that runs reads it.

use std::collections::BTreeMap;

use crate::app::Failure;
use crate::components::{ShaderValue, ShaderValues};
use crate::engine::Engine;
use crate::scene::{Diagnostic, Diagnostics, Severity, ShaderPlace};
use crate::shader::Library;
use crate::watch::values::{takes, unfit};

/// What is wrong with the values of a scene, and with the parameters of the library that draws it, which is told at `place`.
pub fn wrong(
    values: &ShaderValues,
    places: &BTreeMap<String, ShaderPlace>,
    library: &Library,
    place: &Diagnostic,
) -> Vec<Diagnostic> {
    match library.parameters() {
        Ok(parameters) => unfit(values, places, &parameters),
        Err(error) => vec![Diagnostic { severity: Severity::Error, message: error.to_string(), ..place.clone() }],
    }
}

/// Refuses values that no parameter of a library can be. `places` are where they are set.
pub fn check(values: &ShaderValues, places: &BTreeMap<String, ShaderPlace>, library: &Library) -> Result<(), Failure> {
    let list = unfit(values, places, &library.parameters()?);
    if list.is_empty() { Ok(()) } else { Err(Diagnostics { list }.into()) }
}

/// The same of two libraries that draw one scene: each value is to fit one of them.
pub fn check_either(
    values: &ShaderValues,
    places: &BTreeMap<String, ShaderPlace>,
    [old, new]: [&Library; 2],
) -> Result<(), Failure> {
    let known = old.parameters()?;
    let fits_old = |name: &str, value: ShaderValue| known.iter().any(|own| own.name == *name && takes(own, value));
    let rest = values.0.iter().filter(|(name, value)| !fits_old(name, **value));
    check(&ShaderValues(rest.map(|(name, value)| (name.clone(), *value)).collect()), places, new)
}

/// Warnings of values that no pass reads of all that was run.
pub fn unread(values: &ShaderValues, engine: &Engine) -> Vec<String> {
    let unread = values.0.keys().filter(|name| !engine.reads(name));
    unread.map(|name| format!("shader.{name} is set, and nothing that this scene needs reads it")).collect()
}
