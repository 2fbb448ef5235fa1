//! What a scene sets of shaders' parameters, held against what shaders declare.

use std::collections::BTreeMap;
use std::path::Path;

use crate::components::{ShaderValue, ShaderValues};
use crate::scene::{Diagnostic, Severity, ShaderPlace, did_you_mean};
use crate::shader::{Parameter, ParameterKind};

/// Whether a parameter takes a value as it is written.
pub fn takes(parameter: &Parameter, value: ShaderValue) -> bool {
    let is_switch = matches!(value, ShaderValue::Switch(_));
    is_switch == (parameter.kind == ParameterKind::Switch) && parameter.fits(value.number())
}

/// What is wrong with the values of a scene: an error for each that no shader has, or that it can't be. `places` are where they are set.
pub fn unfit(
    values: &ShaderValues,
    places: &BTreeMap<String, ShaderPlace>,
    parameters: &[Parameter],
) -> Vec<Diagnostic> {
    let anywhere = || Diagnostic::file(Severity::Error, Path::new("the scene"), "");
    let wrong = |(name, value): (&String, &ShaderValue)| {
        let place = places.get(name);
        match parameters.iter().find(|parameter| parameter.name == *name) {
            Some(parameter) if takes(parameter, *value) => None,
            Some(parameter) => {
                let message = format!("shader.{name}: expected {}, found `{value}`", parameter.wanted());
                let of = &parameter.place;
                let declared = format!("{}:{}:{} has `{parameter}`", of.source.file, of.line, of.column);
                let place = place.map_or_else(anywhere, |place| place.value.clone());
                Some(Diagnostic { message, ..place }.help(declared))
            }
            None => {
                let message = format!("shader.{name}: no module has `override {name}`");
                let place = place.map_or_else(anywhere, |place| place.name.clone());
                Some(Diagnostic { message, ..place }.help(known(name, parameters)))
            }
        }
    };
    values.0.iter().filter_map(wrong).collect()
}

/// What a wrong name may have meant.
fn known(wrong: &str, parameters: &[Parameter]) -> String {
    let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    match names.as_slice() {
        [] => "no module has any value that can be set: write `override NAME: f32 = 1.0;` in one".to_owned(),
        names => {
            did_you_mean(wrong, names.iter().copied()).unwrap_or_else(|| format!("known here: {}", names.join(", ")))
        }
    }
}
