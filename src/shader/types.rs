//! Types as WGSL writes them.

use naga::{ArraySize, Handle, Module, ScalarKind, Type, TypeInner};

/// A type as WGSL writes it, without aliases.
pub fn type_text(module: &Module, handle: Handle<Type>) -> String {
    let ty = &module.types[handle];
    match (&ty.inner, &ty.name) {
        (TypeInner::Struct { .. }, Some(name)) => name.clone(),
        (inner, _) => type_name(module, inner),
    }
}

/// A type that is no struct, as WGSL writes it.
pub fn type_name(module: &Module, inner: &TypeInner) -> String {
    match inner {
        TypeInner::Scalar(scalar) => scalar_name(*scalar),
        TypeInner::Vector { size, scalar } => format!("vec{}<{}>", *size as u32, scalar_name(*scalar)),
        TypeInner::Matrix { columns, rows, scalar } => {
            format!("mat{}x{}<{}>", *columns as u32, *rows as u32, scalar_name(*scalar))
        }
        TypeInner::Atomic(scalar) => format!("atomic<{}>", scalar_name(*scalar)),
        TypeInner::Array { base, size: ArraySize::Constant(count), .. } => {
            format!("array<{}, {count}>", type_text(module, *base))
        }
        TypeInner::Array { base, .. } => format!("array<{}>", type_text(module, *base)),
        TypeInner::Pointer { base, .. } => format!("pointer to {}", type_text(module, *base)),
        TypeInner::ValuePointer { size: Some(size), scalar, .. } => {
            format!("pointer to vec{}<{}>", *size as u32, scalar_name(*scalar))
        }
        TypeInner::ValuePointer { scalar, .. } => format!("pointer to {}", scalar_name(*scalar)),
        TypeInner::Struct { .. } => "struct".to_owned(),
        _ => "resource".to_owned(),
    }
}

fn scalar_name(scalar: naga::Scalar) -> String {
    let bits = u32::from(scalar.width) * 8;
    match scalar.kind {
        ScalarKind::Sint => format!("i{bits}"),
        ScalarKind::Uint => format!("u{bits}"),
        ScalarKind::Float => format!("f{bits}"),
        ScalarKind::Bool => "bool".to_owned(),
        ScalarKind::AbstractInt => "abstract integer".to_owned(),
        ScalarKind::AbstractFloat => "abstract float".to_owned(),
    }
}
