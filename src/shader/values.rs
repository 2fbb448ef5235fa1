//! Parameters in a linked text: each is a word of a buffer, and a name stands for reading it.
//!
//! The buffer is [`SHADER_VALUES`]; a pass that reads none does not bind it. Its words are of the parameters that the modules of
//! the text declare, in the order of the modules.

use std::collections::BTreeSet;

use naga::{Expression, Function, Module};

use super::parameter::{Parameter, ParameterKind};

/// The name of the buffer that parameters are read from.
pub const SHADER_VALUES: &str = "shader_values";

/// Its type in linked texts.
pub const STRUCT: &str = "ShaderValues";

/// What no shader binds: the true binding is the first that is free, once all others are known.
const BINDING: u32 = 999;

/// A parameter of a linked module.
#[derive(Clone, Debug)]
pub struct LinkedParameter {
    pub parameter: Parameter,
    /// An entry point depends on it.
    pub is_read: bool,
}

/// The declaration of a buffer for parameters, of which there is one at least.
pub fn declaration<'p>(parameters: impl Iterator<Item = &'p Parameter>) -> String {
    let field = |parameter: &Parameter| match parameter.kind {
        // A bool can't be in a buffer.
        ParameterKind::Switch => format!("    {}: u32,\n", parameter.name),
        kind => format!("    {}: {},\n", parameter.name, kind.wgsl()),
    };
    let fields: String = parameters.map(field).collect();
    format!(
        "struct {STRUCT} {{\n{fields}}}\n@group(0) @binding({BINDING}) var<storage, read> {SHADER_VALUES}: {STRUCT};\n"
    )
}

/// What stands in the place of a parameter's name.
pub fn access(parameter: &Parameter) -> String {
    let name = &parameter.name;
    match parameter.kind {
        ParameterKind::Switch => format!("({SHADER_VALUES}.{name} != 0u)"),
        _ => format!("{SHADER_VALUES}.{name}"),
    }
}

/// Gives the buffer the first free binding, and says which of its words anything reads.
pub fn settle(module: &mut Module) -> BTreeSet<usize> {
    let is_values = |name: &Option<String>| name.as_deref() == Some(SHADER_VALUES);
    let Some((buffer, _)) = module.global_variables.iter().find(|(_, variable)| is_values(&variable.name)) else {
        return BTreeSet::new();
    };
    let others = module.global_variables.iter().filter(|(handle, _)| *handle != buffer);
    let free = others.filter_map(|(_, other)| other.binding).map(|other| other.binding + 1).max().unwrap_or(0);
    if let Some(binding) = &mut module.global_variables.get_mut(buffer).binding {
        binding.binding = free;
    }
    let read = |function: &Function| -> Vec<usize> {
        let expressions = function.expressions.iter();
        let word = |expression: &Expression| match expression {
            Expression::AccessIndex { base, index } => {
                let of = &function.expressions[*base];
                matches!(of, Expression::GlobalVariable(of) if *of == buffer).then_some(*index as usize)
            }
            _ => None,
        };
        expressions.filter_map(|(_, expression)| word(expression)).collect()
    };
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    module.functions.iter().map(|(_, function)| function).chain(entries).flat_map(read).collect()
}
