//! One row of the pass table.

use super::Twin;

/// A compute pass: what runs, and on which buffers.
///
/// The row is checked against naga's reflection of the linked module: the names, access and types of the bindings that the
/// entry point uses must be exactly these. Workgroup sizes come from the reflection alone.
#[derive(Debug)]
pub struct Pass {
    /// Unique; what timings and dispatch counts are listed under.
    pub name: &'static str,
    /// Shader module, as `passes/sort/count`.
    pub module: &'static str,
    /// Entry point in that module.
    pub entry: &'static str,
    /// What is switched on for it beside the scene's features.
    pub features: &'static [&'static str],
    /// In the order of the WGSL, all in group 0.
    pub bindings: &'static [Binding],
    /// What is to be made anew when the pass's code changes: all that it is recorded for.
    pub makes: &'static [Makes],
    /// What its results are held against.
    pub twin: Twin,
}

/// What a pass has a part in: a film is traced through the tree, and a picture shows the film, but each is still good where
/// only the code of those before it changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Makes {
    /// Morton codes to tree.
    Tree,
    /// Samples and their sums.
    Film,
    /// The film as it is shown.
    Picture,
}

/// One binding of a pass, by its name in the WGSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Binding {
    pub name: &'static str,
    pub access: Access,
    /// WGSL type, as naga prints it: `array<vec2<u32>>`.
    pub ty: &'static str,
    /// The binding is in the module where any of these features is on; none: always.
    pub features: &'static [&'static str],
    /// And where all of these are.
    pub all: &'static [&'static str],
}

impl Binding {
    /// A storage buffer that is only read.
    pub const fn read(name: &'static str, ty: &'static str) -> Self {
        Self { name, access: Access::Read, ty, features: &[], all: &[] }
    }

    /// A storage buffer that is read and written.
    pub const fn write(name: &'static str, ty: &'static str) -> Self {
        Self { name, access: Access::Write, ty, features: &[], all: &[] }
    }

    /// The pass's parameters: `var<storage, read> params`.
    pub const fn params(ty: &'static str) -> Self {
        Self { name: "params", access: Access::Params, ty, features: &[], all: &[] }
    }

    /// Only there where one of these features is in use.
    pub const fn when(mut self, features: &'static [&'static str]) -> Self {
        self.features = features;
        self
    }

    /// Only there where all of these are in use too.
    pub const fn and(mut self, features: &'static [&'static str]) -> Self {
        self.all = features;
        self
    }

    /// Parts of a row's bindings, one after another: `N` in all, or it does not compile.
    pub const fn list<const N: usize>(parts: &[&[Self]]) -> [Self; N] {
        let mut all = [Self::read("", ""); N];
        let (mut part, mut count) = (0, 0);
        while part < parts.len() {
            let mut at = 0;
            while at < parts[part].len() {
                all[count] = parts[part][at];
                (at, count) = (at + 1, count + 1);
            }
            part += 1;
        }
        assert!(count == N, "the parts have another number of bindings");
        all
    }

    /// Whether it is in a module that is linked with some features.
    pub fn is_there(&self, on: impl Fn(&str) -> bool) -> bool {
        let any = self.features.is_empty() || self.features.iter().any(|feature| on(feature));
        any && self.all.iter().all(|feature| on(feature))
    }
}

/// How a pass uses a binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// `var<storage, read>`
    Read,
    /// `var<storage, read_write>`
    Write,
    /// `var<storage, read>`, filled from the call's own parameters. Not a uniform: lavapipe compiles a shader anew for
    /// each value of a uniform that one of its loops or branches depends on.
    Params,
}
