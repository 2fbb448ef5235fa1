// Light that a map of emission sends out. Light sampling draws triangles by what their texels send on average, and looks the point up.

@if(lights) import package::gen::{LightRecord, MATERIAL_RECORD_EMISSION, MATERIAL_RECORD_STRIDE};
@if(lights) import package::gen::{TRIANGLE_MATERIAL, TRIANGLE_STRIDE, material_record_emission, triangle_material};
import package::lib::texture::{TexturePoint};
import package::passes::trace::materials::{materials};
import package::passes::trace::textures::{load_maps, load_uvs, look_up_colour, texture_point};

// What each triangle sends out on average, luminance, in scene order: 0 where it is no light that is sampled.
@if(lights) @group(0) @binding(15) var<storage, read> mean_emission: array<f32>;
@if(lights) @group(0) @binding(16) var<storage, read> triangles: array<vec4<u32>>;

// What a material's emission is multiplied by at a point.
fn emission_part(material: u32, point: TexturePoint, u: f32) -> vec3<f32> {
    let map = load_maps(material).emission;
    if (map == 0u) {
        return vec3<f32>(1.0);
    }
    return look_up_colour(map, point, u);
}

// Radiance that a sampled light sends from the point with such weights.
@if(lights)
fn emission_at(light: LightRecord, weights: vec2<f32>, u: f32) -> vec3<f32> {
    let material = triangle_material(triangles[TRIANGLE_STRIDE * light.triangle + TRIANGLE_MATERIAL]);
    let emission = material_record_emission(materials[MATERIAL_RECORD_STRIDE * material + MATERIAL_RECORD_EMISSION]);
    let point = texture_point(load_uvs(light.triangle), weights.x, weights.y);
    return emission * emission_part(material, point, u);
}

// The luminance of a triangle by which it is sampled as a light.
@if(lights)
fn mean_luminance(triangle: u32) -> f32 {
    return mean_emission[triangle];
}
