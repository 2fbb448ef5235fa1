//! Parses and validates a joined text with naga, and compares the shared structs' layouts.

use std::ops::Range;

use naga::compact::KeepUnused;
use naga::valid::{
    Capabilities, GlobalVariableError, ModuleInfo, ShaderStages, SubgroupOperationSet, ValidationError,
    ValidationFlags, Validator,
};
use naga::{AddressSpace, Handle, Module, Span, Type, TypeInner, WithSpan};

use crate::layout::StructLayout;

use super::error::{ErrorKind, ShaderError};
use super::generated::{FILE, Generated};
use super::library::Library;
use super::source_map::SourceMap;
use super::{Features, depth, message, seek, site};

/// The feature of code that subgroups of 32 threads run.
pub const BALLOTS: &str = "ballots";

/// Makes naga's module of a joined text: valid, of the layout that Rust has, and without what no entry point uses.
pub fn check(
    text: &str,
    map: &SourceMap,
    generated: &Generated,
    library: &Library,
    features: &Features,
) -> Result<(Module, ModuleInfo), ShaderError> {
    let mut module = parse(text, map, library, features)?;
    validate(&module, text, map, features)?;
    check_bindings(&module, map)?;
    for layout in &generated.structs {
        check_layout(&module, layout, generated)?;
    }
    naga::compact::compact(&mut module, KeepUnused::No);
    let info = validate(&module, text, map, features)?;
    Ok((module, info))
}

/// Makes naga's module of a joined text, no deeper than a stack carries.
pub fn parse(text: &str, map: &SourceMap, library: &Library, features: &Features) -> Result<Module, ShaderError> {
    let module =
        naga::front::wgsl::parse_str(text).map_err(|error| parse_error(&error, text, map, library, features))?;
    match depth::check_module(&module) {
        Some((range, message)) => {
            Err(map.error(ErrorKind::Type, range.unwrap_or_else(|| map.first_declaration()), message))
        }
        None => Ok(module),
    }
}

/// Validates for an adapter without optional features: what a shader needs beyond has no place in a portable engine, but in code that
/// is compiled where a feature says that the adapter has it.
pub fn validate(module: &Module, text: &str, map: &SourceMap, features: &Features) -> Result<ModuleInfo, ShaderError> {
    let optional = if features.contains(BALLOTS) { Capabilities::SUBGROUP } else { Capabilities::empty() };
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::default() | optional);
    if features.contains(BALLOTS) {
        validator.subgroup_stages(ShaderStages::COMPUTE).subgroup_operations(SubgroupOperationSet::all());
    }
    validator.validate(module).map_err(|error| validation_error(&error, module, text, map))
}

fn parse_error(
    error: &naga::front::wgsl::ParseError,
    text: &str,
    map: &SourceMap,
    library: &Library,
    features: &Features,
) -> ShaderError {
    let message = message::without_handles(error.message());
    let labels: Vec<Range<usize>> = error.labels().filter_map(|(span, _)| span.to_range()).collect();
    // What is made from Rust is right: the mistake is where it is used.
    let labelled = labels.iter().find(|range| !map.is_generated(range)).or(labels.first()).cloned();
    let sought = labelled.or_else(|| seek::place(text, &message));
    let range = sought.unwrap_or_else(|| map.first_declaration());
    let message = message.replace("found \"\"", "found the end of the file");
    // naga has one type for all errors of its front end: those of the grammar say what they expected.
    let syntax = message.starts_with("expected") || message.contains("reserved keyword");
    let kind = if syntax { ErrorKind::Syntax } else { ErrorKind::Type };
    let unknown = message.starts_with("no definition in scope").then(|| text.get(range.clone())).flatten();
    let located = map.error(kind, range, message);
    if let Some((name, module)) = unknown.and_then(|name| Some((name, declaring_module(library, features, name)?))) {
        return located.help(format!("import package::{}::{name};", module.replace('/', "::")));
    }
    // One line a type that would do is more than a reader wants.
    let notes: Vec<&str> = error.notes().map(|note| note.trim_start_matches("allowed type: ")).collect();
    if notes.is_empty() { located } else { located.help(notes.join(", ").replacen(":, ", ": ", 1)) }
}

/// The first module of the library that declares a name.
fn declaring_module<'a>(library: &'a Library, features: &Features, name: &str) -> Option<&'a str> {
    if library.shared().knows(name) {
        return Some("gen");
    }
    library.modules().find(|module| {
        let scanned = library.scan(module, features);
        scanned.is_ok_and(|scanned| scanned.declarations.iter().any(|declared| declared.name == name))
    })
}

/// naga's first label of a type error is the whole function: the narrowest is where the error is.
fn validation_error(error: &WithSpan<ValidationError>, module: &Module, text: &str, map: &SourceMap) -> ShaderError {
    let ranges = error.spans().filter_map(|(span, _)| span.to_range());
    let narrowest = ranges.filter(|range| !range.is_empty()).min_by_key(|range| (map.is_generated(range), range.len()));
    let range = match (narrowest, site::of(error.as_inner(), module).and_then(Span::to_range)) {
        (Some(range), Some(site)) if site.start <= range.start && range.end <= site.end => range,
        (range, site) => site
            .or(range)
            .or_else(|| site::of_type(error.as_inner(), module).and_then(Span::to_range))
            .or_else(|| site::in_text(error.as_inner(), text))
            .unwrap_or_else(|| map.first_declaration()),
    };
    let kind = match error.as_inner() {
        ValidationError::GlobalVariable { source: GlobalVariableError::InvalidBinding, .. } => ErrorKind::Binding,
        ValidationError::EntryPoint { source: naga::valid::EntryPointError::BindingCollision(_), .. } => {
            ErrorKind::Binding
        }
        _ => ErrorKind::Type,
    };
    map.error(kind, range, message::validation(error.as_inner(), module, text))
}

/// Passes have storage buffers, nothing else.
fn check_bindings(module: &Module, map: &SourceMap) -> Result<(), ShaderError> {
    for (handle, variable) in module.global_variables.iter() {
        let known =
            matches!(variable.space, AddressSpace::Private | AddressSpace::WorkGroup | AddressSpace::Storage { .. });
        if !known {
            let name = variable.name.as_deref().unwrap_or("_");
            let range = module.global_variables.get_span(handle).to_range().unwrap_or(0..0);
            let message = format!("`{name}` is not a storage buffer: passes have no other bindings");
            return Err(map.error(ErrorKind::Binding, range, message));
        }
    }
    Ok(())
}

/// Compares a struct with what naga made of its generated text.
fn check_layout(module: &Module, layout: &StructLayout, generated: &Generated) -> Result<(), ShaderError> {
    let at = |name: &str, message: String| {
        let struct_start = generated.source.text.find(&format!("struct {} {{", layout.name)).unwrap_or(0);
        let range = generated.source.text[struct_start..]
            .find(&format!(" {name}"))
            .map_or(struct_start..struct_start, |at| struct_start + at + 1..struct_start + at + 1 + name.len());
        ShaderError::at(ErrorKind::Layout, &generated.source, range, message)
    };
    let named = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(layout.name));
    let Some((handle, Type { inner: TypeInner::Struct { members, span }, .. })) = named else {
        let message = format!("naga lost the struct `{}` of {FILE}", layout.name);
        return Err(at(layout.name, message));
    };
    for (member, field) in members.iter().zip(layout.fields) {
        let size = module.types[member.ty].inner.size(module.to_ctx());
        if (member.offset, size) != (field.offset, field.size) {
            let message = format!(
                "`{}.{}` is {} bytes at offset {} in Rust, {size} at {} in WGSL",
                layout.name, field.name, field.size, field.offset, member.offset
            );
            return Err(at(field.name, message));
        }
    }
    let align = alignment(module, handle);
    if (*span, align, members.len()) != (layout.size, layout.align, layout.fields.len()) {
        let message = format!(
            "`{}` is {} bytes aligned to {} in Rust, {span} aligned to {align} in WGSL",
            layout.name, layout.size, layout.align
        );
        return Err(at(layout.name, message));
    }
    Ok(())
}

fn alignment(module: &Module, handle: Handle<Type>) -> u32 {
    let mut layouter = naga::proc::Layouter::default();
    match layouter.update(module.to_ctx()) {
        Ok(()) => layouter[handle].alignment.round_up(1),
        Err(_) => 0,
    }
}
