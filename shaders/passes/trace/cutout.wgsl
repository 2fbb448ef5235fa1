// Surfaces with holes: what is there of them is decided in the walk through the tree, for every ray anew, so that light passes through the
// holes on its way to a surface as to a light. Nothing is filtered but the texel: a point is there, or not.

import package::gen::{MATERIAL_MAPS_COVERAGE, MATERIAL_MAPS_OPACITY, MATERIAL_MAPS_STRIDE, NO_CHANCE, Triangle};
import package::gen::{material_maps_coverage, material_maps_opacity};
import package::lib::rng_pcg::{pcg4d};
import package::passes::trace::textures::{load_uvs, look_up_number, material_maps, texture_point};

// Sets these hashes off from those of other numbers.
const CUTOUT_STREAM: u32 = 0x63757400u;

// Whether the point of a triangle with such weights is there for a ray: a function of its number, the triangle and the point alone, so that
// hits do not depend on the tree.
fn is_there(triangle: Triangle, b1: f32, b2: f32, chance: u32) -> bool {
    let at = MATERIAL_MAPS_STRIDE * triangle.material;
    let map = material_maps_opacity(material_maps[at + MATERIAL_MAPS_OPACITY]);
    if (map == 0u) {
        return true;
    }
    let words = pcg4d(vec4<u32>(chance, triangle.index, CUTOUT_STREAM, 0u));
    let drawn = vec2<f32>(words.xy >> vec2<u32>(8u)) * 0x1p-24;
    let u = select(drawn, vec2<f32>(0.5), chance == NO_CHANCE);
    let coverage = material_maps_coverage(material_maps[at + MATERIAL_MAPS_COVERAGE]);
    let point = texture_point(load_uvs(triangle.index), b1, b2);
    return u.y < coverage * look_up_number(map, point, u.x);
}
