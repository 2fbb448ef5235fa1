//! What an entry point wants from its pass.

use naga::{AddressSpace, Module, StorageAccess};

use super::link::Linked;
use super::types::type_text;

/// An entry point of a linked module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EntryPoint {
    pub name: String,
    pub workgroup_size: [u32; 3],
    /// Only those that it uses, directly or through functions, by group and binding.
    pub bindings: Vec<BoundResource>,
}

/// A buffer that an entry point uses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoundResource {
    pub name: String,
    pub group: u32,
    pub binding: u32,
    pub kind: ResourceKind,
    /// As WGSL writes it: `array<vec2<u32>>`, `SortParams`.
    pub ty: String,
    /// Bytes; at least, if the type ends in an array without a length (one element is counted).
    pub size: u32,
}

/// How a buffer is bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResourceKind {
    /// `var<storage, read>`
    StorageRead,
    /// `var<storage, read_write>`
    StorageReadWrite,
}

impl std::fmt::Display for ResourceKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            ResourceKind::StorageRead => "var<storage, read>",
            ResourceKind::StorageReadWrite => "var<storage, read_write>",
        })
    }
}

impl Linked {
    /// The entry point of a name.
    pub fn entry(&self, name: &str) -> Option<EntryPoint> {
        let index = self.module.entry_points.iter().position(|entry| entry.name == name)?;
        let used = self.info.get_entry_point(index);
        let variables = self.module.global_variables.iter();
        let mut bindings: Vec<BoundResource> = variables
            .filter(|(handle, _)| !used[*handle].is_empty())
            .filter_map(|(_, variable)| bound_resource(&self.module, variable))
            .collect();
        bindings.sort_by_key(|bound| (bound.group, bound.binding));
        let workgroup_size = self.module.entry_points[index].workgroup_size;
        Some(EntryPoint { name: name.to_owned(), workgroup_size, bindings })
    }

    /// The names of all entry points, in the order of the text.
    pub fn entries(&self) -> impl Iterator<Item = &str> {
        self.module.entry_points.iter().map(|entry| entry.name.as_str())
    }
}

fn bound_resource(module: &Module, variable: &naga::GlobalVariable) -> Option<BoundResource> {
    let binding = variable.binding?;
    let kind = match variable.space {
        AddressSpace::Storage { access } if access.contains(StorageAccess::STORE) => ResourceKind::StorageReadWrite,
        AddressSpace::Storage { .. } => ResourceKind::StorageRead,
        _ => return None,
    };
    Some(BoundResource {
        name: variable.name.clone().unwrap_or_default(),
        group: binding.group,
        binding: binding.binding,
        kind,
        ty: type_text(module, variable.ty),
        size: module.types[variable.ty].inner.size(module.to_ctx()),
    })
}
