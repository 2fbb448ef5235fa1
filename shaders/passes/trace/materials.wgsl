// Materials as every query reads them: binding 3 is theirs.

import package::gen::{MATERIAL_RECORD_STRIDE, MaterialRecord, unpack_material_record};

// By four words, as nodes are read.
@group(0) @binding(3) var<storage, read> materials: array<vec4<u32>>;

fn load_material(index: u32) -> MaterialRecord {
    let at = MATERIAL_RECORD_STRIDE * index;
    return unpack_material_record(materials[at], materials[at + 1u], materials[at + 2u], materials[at + 3u], materials[at + 4u]);
}
