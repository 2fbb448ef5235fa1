//! A row of the pass table against the shader it names.

use crate::passes::{Access, Pass};
use crate::shader::{EntryPoint, ErrorKind, Features, LOOP_FAULTS, Linked, ResourceKind, SHADER_VALUES, ShaderError};

/// The entry point that a row names, if the row says just what the shader uses. Everything is found by name, so only the
/// sets must agree. An error is placed at the binding, or else where the entry point is.
pub fn checked_entry(pass: &Pass, linked: &Linked, features: &Features) -> Result<EntryPoint, ShaderError> {
    let fail = |at: &str, reason: String| Err(ShaderError::of(ErrorKind::Binding, linked.place_of(at), reason));
    let Some(entry) = linked.entry(pass.entry) else {
        return fail(pass.entry, format!("pass `{}` wants an entry point `{}` here", pass.name, pass.entry));
    };
    let expected = || pass.bindings.iter().filter(|b| b.is_there(|feature| features.contains(feature)));
    for row in expected() {
        let Some(found) = entry.bindings.iter().find(|b| b.name == row.name) else {
            let reason = format!("pass `{}` binds `{}`, and `{}` does not use it", pass.name, row.name, entry.name);
            return fail(pass.entry, reason);
        };
        let kind = match row.access {
            Access::Read | Access::Params => ResourceKind::StorageRead,
            Access::Write => ResourceKind::StorageReadWrite,
        };
        if found.kind != kind || found.ty != row.ty {
            let reason = format!(
                "pass `{}` binds `{}` as {kind} of `{}`, and this is {} of `{}`",
                pass.name, row.name, row.ty, found.kind, found.ty
            );
            return fail(row.name, reason);
        }
        if found.group != 0 {
            return fail(row.name, format!("`{}` is in group {}; passes use group 0", row.name, found.group));
        }
    }
    let known = |name: &str| [LOOP_FAULTS, SHADER_VALUES].contains(&name) || expected().any(|row| row.name == name);
    match entry.bindings.iter().find(|b| !known(&b.name)) {
        Some(extra) => fail(&extra.name, format!("pass `{}` has no buffer `{}`", pass.name, extra.name)),
        None => Ok(entry),
    }
}

/// What a pass is linked with for a scene of some features.
pub fn features_of(pass: &Pass, scene: &Features) -> Features {
    scene.iter().cloned().chain(pass.features.iter().map(|own| (*own).to_owned())).collect()
}
