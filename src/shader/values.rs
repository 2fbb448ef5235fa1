//! Values of shaders that are set from outside: `override NAME: T = ..;` of a module.

use std::collections::{BTreeMap, BTreeSet};

use super::error::ErrorKind;
use super::{Library, ShaderError};

/// A declaration of such a value.
struct Declared<'a> {
    name: &'a str,
    /// Of the type.
    kind: &'a str,
}

impl Library {
    /// The library with values written in the place of those that modules declare by `override`: numbers, or true and false.
    pub fn with_values(mut self, values: &BTreeMap<String, String>) -> Result<Self, ShaderError> {
        let modules: Vec<String> = self.modules().map(str::to_owned).collect();
        let (mut set, mut known) = (BTreeSet::new(), BTreeSet::new());
        for module in modules {
            let Some(text) = self.text(&module) else { continue };
            let mut written = String::with_capacity(text.len());
            let mut changed = false;
            for line in text.split_inclusive('\n') {
                let declared = declared(line);
                known.extend(declared.iter().map(|declared| declared.name.to_owned()));
                match declared.and_then(|declared| Some((values.get_key_value(declared.name)?, declared))) {
                    Some(((name, value), Declared { kind, .. })) => {
                        let value = checked(name, kind, value)?;
                        let end = if line.ends_with('\n') { "\n" } else { "" };
                        written += &format!("const {name}: {kind} = {kind}({value});{end}");
                        set.insert(name.clone());
                        changed = true;
                    }
                    None => written += line,
                }
            }
            if changed {
                self = self.with(&module, &written);
            }
        }
        match values.keys().find(|name| !set.contains(*name)) {
            None => Ok(self),
            Some(name) => {
                let error = ShaderError::nowhere(ErrorKind::Import, format!("no module has `override {name}`"));
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                Err(error.help(match known.as_slice() {
                    [] => {
                        "no module has any value that can be set: write `override NAME: f32 = 1.0;` in one".to_owned()
                    }
                    known => format!("known here: {}", known.join(", ")),
                }))
            }
        }
    }
}

/// What a line declares, if that is such a value.
fn declared(line: &str) -> Option<Declared<'_>> {
    let rest = line.trim_start().strip_prefix("override ")?;
    let (name, rest) = rest.split_once(':')?;
    let (kind, _) = rest.split_once('=')?;
    let declared = Declared { name: name.trim(), kind: kind.trim() };
    ["f32", "u32", "i32", "bool"].contains(&declared.kind).then_some(declared)
}

/// A value as WGSL, if it is of the type.
fn checked(name: &str, kind: &str, value: &str) -> Result<String, ShaderError> {
    let value = value.trim();
    let fits = match kind {
        "f32" => value.parse::<f32>().is_ok_and(f32::is_finite),
        "u32" => value.parse::<u32>().is_ok(),
        "i32" => value.parse::<i32>().is_ok(),
        _ => value.parse::<bool>().is_ok(),
    };
    if fits {
        return Ok(value.to_owned());
    }
    Err(ShaderError::nowhere(ErrorKind::Type, format!("`{value}` is no {kind}, as `override {name}` needs it")))
}
