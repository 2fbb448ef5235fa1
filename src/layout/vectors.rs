//! Structs that kernels read as arrays of vectors of four words, and the WGSL that unpacks them.
//!
//! lavapipe reads each member of a struct by a loop of its own over its lanes, with a branch for each, and four words by one.

use super::types::{FieldLayout, FieldType, StructLayout};

/// A struct that WGSL may read as so many `vec4<u32>`.
///
/// Its size is a multiple of 16 bytes, and its fields are scalars and vectors; [`Vectors::of`] refuses anything else, and Rust does not
/// compile where that is in a constant.
#[derive(Clone, Copy, Debug)]
pub struct Vectors {
    pub layout: &'static StructLayout,
}

/// Bytes of a vector of four words.
const VECTOR: u32 = 16;

impl Vectors {
    pub const fn of(layout: &'static StructLayout) -> Self {
        assert!(
            layout.size.is_multiple_of(VECTOR),
            "read by four words, a struct's size is a multiple of 16 bytes: fill its end"
        );
        let mut i = 0;
        while i < layout.fields.len() {
            let FieldType::Plain(_) = layout.fields[i].ty else {
                panic!("read by four words, a struct has scalars and vectors alone");
            };
            i += 1;
        }
        Self { layout }
    }

    /// Vectors of one struct, and from one to the next.
    pub const fn stride(&self) -> u32 {
        self.layout.size / VECTOR
    }

    /// What `package::gen` declares of it, as (name, WGSL, whether that needs the struct itself): `THING_STRIDE`; `unpack_thing`, from
    /// its vectors in order; and of each field the number of its vector, `THING_FIELD`, and `thing_field`, from that vector.
    pub fn declarations(&self) -> impl Iterator<Item = (String, String, bool)> {
        let snake = snake_case(self.layout.name);
        let stride_name = format!("{}_STRIDE", snake.to_uppercase());
        let stride = format!("const {stride_name}: u32 = {}u;\n", self.stride());
        let unpack_name = format!("unpack_{snake}");
        let whole = [(stride_name, stride, false), (unpack_name.clone(), self.unpacker(&unpack_name), true)];
        whole.into_iter().chain(self.layout.fields.iter().flat_map(move |field| accessor(&snake, field)))
    }

    fn unpacker(&self, function: &str) -> String {
        let name = self.layout.name;
        let arguments: Vec<String> = (0..self.stride()).map(|i| format!("v{i}: vec4<u32>")).collect();
        let values: Vec<String> =
            self.layout.fields.iter().map(|field| value(field, &format!("v{}", field.offset / VECTOR))).collect();
        format!("fn {function}({}) -> {name} {{\n    return {name}({});\n}}\n", arguments.join(", "), values.join(", "))
    }
}

/// The two declarations of a field.
fn accessor(snake: &str, field: &FieldLayout) -> [(String, String, bool); 2] {
    let function = format!("{snake}_{}", field.name);
    let place = function.to_uppercase();
    let at = format!("const {place}: u32 = {}u;\n", field.offset / VECTOR);
    let (ty, value) = (field.ty.wgsl(), value(field, "v"));
    let body = format!("fn {function}(v: vec4<u32>) -> {ty} {{\n    return {value};\n}}\n");
    [(place, at, false), (function, body, false)]
}

/// A field's value, of the vector that it lies in.
fn value(field: &FieldLayout, vector: &str) -> String {
    let first = field.offset % VECTOR / 4;
    let words = &"xyzw"[first as usize..(first + field.size / 4) as usize];
    let bits = if words.len() == 4 { vector.to_owned() } else { format!("{vector}.{words}") };
    let ty = field.ty.wgsl();
    if ty.contains("u32") { bits } else { format!("bitcast<{ty}>({bits})") }
}

/// `MaterialRecord` as `material_record`.
fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    for (i, letter) in name.char_indices() {
        if letter.is_uppercase() && i > 0 {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}
