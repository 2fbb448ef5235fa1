//! The virtual module `package::gen`: the structs and constants that Rust and WGSL share, and functions that unpack such structs.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::layout::{self, GpuConst, StructLayout, Vectors};

use super::error::Source;
use super::values;

/// The file that messages name for a place in generated text.
pub const FILE: &str = "<generated layout>";

/// What `package::gen` can supply.
#[derive(Clone)]
pub struct Shared {
    structs: Vec<&'static StructLayout>,
    consts: Vec<&'static GpuConst>,
    vectors: Vec<Vectors>,
}

impl Shared {
    /// Everything that [`layout`] registers.
    pub fn registered() -> Self {
        Shared {
            structs: layout::ALL.to_vec(),
            consts: layout::CONSTS.iter().copied().flatten().collect(),
            vectors: layout::VECTORS.to_vec(),
        }
    }

    pub fn add(&mut self, structs: &[&'static StructLayout], consts: &'static [GpuConst]) {
        self.structs.extend(structs);
        self.consts.extend(consts);
    }

    pub fn add_vectors(&mut self, vectors: &[Vectors]) {
        self.vectors.extend(vectors);
    }

    pub fn is_struct(&self, name: &str) -> bool {
        self.structs.iter().any(|known| known.name == name)
    }

    pub fn knows(&self, name: &str) -> bool {
        self.is_struct(name)
            || self.consts.iter().any(|known| known.name == name)
            || self.vectors.iter().any(|vectors| vectors.declarations().any(|(known, ..)| known == name))
    }

    /// The module that declares some names and what they depend on.
    pub fn generate(&self, names: &BTreeSet<&str>) -> Generated {
        let mut text = String::new();
        let mut structs = Vec::new();
        let consts = || self.consts.iter().filter(|constant| names.contains(constant.name));
        consts().for_each(|constant| text.push_str(&constant.wgsl()));
        for layout in self.structs.iter().filter(|layout| names.contains(layout.name)) {
            declare(layout, &mut text, &mut structs);
        }
        let mut unpacking = Vec::new();
        for vectors in &self.vectors {
            for (name, wgsl, of_struct) in vectors.declarations().filter(|(name, ..)| names.contains(name.as_str())) {
                if of_struct {
                    declare(vectors.layout, &mut text, &mut structs);
                }
                text.push_str(&wgsl);
                unpacking.push(name);
            }
        }
        let names = structs.iter().map(|layout| layout.name).chain(consts().map(|constant| constant.name));
        let names = names.map(str::to_owned).chain(unpacking).collect();
        Generated { source: Arc::new(Source { file: FILE.to_owned(), text }), structs, names }
    }
}

/// The text of `package::gen` for one link.
#[derive(Clone)]
pub struct Generated {
    pub source: Arc<Source>,
    /// The structs in it, in the order of their declarations.
    pub structs: Vec<&'static StructLayout>,
    /// Everything it declares.
    pub names: Vec<String>,
}

impl Generated {
    /// With the declaration of the buffer of parameters.
    pub fn with_values(mut self, declaration: &str) -> Self {
        let source = Source { file: FILE.to_owned(), text: format!("{}{declaration}", self.source.text) };
        self.source = Arc::new(source);
        self.names.extend([values::STRUCT, values::SHADER_VALUES].map(str::to_owned));
        self
    }
}

/// Writes a struct behind those it depends on.
fn declare(layout: &'static StructLayout, text: &mut String, done: &mut Vec<&'static StructLayout>) {
    if done.iter().any(|known| known.name == layout.name) {
        return;
    }
    for part in layout.depends_on() {
        declare(part, text, done);
    }
    text.push_str(&layout.wgsl());
    done.push(layout);
}
