// Shading normals that a map of directions or of heights bends.

import package::gen::{TANGENTS_STRIDE, Tangents, TEXEL_KIND, TEXEL_SLOPES, TEXTURE_FLIP_GREEN, TextureRecord, unpack_tangents};
import package::lib::normals::{octahedral_decode};
import package::lib::texture::{TexturePoint, draw_texel};
import package::passes::trace::textures::{load_texel, load_texture};

@group(0) @binding(14) var<storage, read> tangents: array<vec4<u32>>;

// The direction that a texel says, in tangent space: away from the surface, by a little at least. Not of unit length.
fn local_normal(t: TextureRecord, texel: vec4<f32>) -> vec3<f32> {
    if ((t.format & TEXEL_KIND) == TEXEL_SLOPES) {
        return vec3<f32>(-t.gain * texel.xy, 1.0);
    }
    let n = 2.0 * texel.xyz - 1.0;
    let up = select(n.y, -n.y, (t.format & TEXTURE_FLIP_GREEN) != 0u);
    return vec3<f32>(n.x, up, max(n.z, 1e-3));
}

// A unit normal bent by a map, which is not none; itself, where the triangle has no tangents. `normal` is on the side that the mesh says.
fn relieved(map: u32, point: TexturePoint, triangle: u32, b1: f32, b2: f32, normal: vec3<f32>, u: f32) -> vec3<f32> {
    let corners = unpack_tangents(tangents[TANGENTS_STRIDE * triangle]);
    if (corners.t0 == 0u || corners.t1 == 0u || corners.t2 == 0u) {
        return normal;
    }
    let along = (1.0 - b1 - b2) * octahedral_decode(corners.t0) + b1 * octahedral_decode(corners.t1) + b2 * octahedral_decode(corners.t2);
    let across = along - dot(along, normal) * normal;
    if (dot(across, across) < 1e-6) {
        return normal;
    }
    let tangent = normalize(across);
    let bitangent = select(1.0, -1.0, corners.mirrored != 0u) * cross(normal, tangent);
    let t = load_texture(map);
    let n = local_normal(t, load_texel(t, draw_texel(t, point, u)));
    return normalize(n.x * tangent + n.y * bitangent + n.z * normal);
}
