// The surface at the end of a ray: how it is seen, and what it is made of.

import package::gen::{Hit, MaterialRecord, Triangle};
@if(thin && relief) import package::gen::{MATERIAL_THIN, MaterialMaps};
@if(normals) import package::gen::{Shading};
import package::lib::bsdf::frame::{ShadingFrame};
import package::lib::intersect::{surface_point};
import package::lib::math::{largest_of};
@if(normals || relief) import package::lib::normals::{bent_to_viewer, facing};
@if(normals) import package::lib::normals::{interpolate_normal};
@if(textures || relief || emission_map) import package::passes::trace::footprint::{Texturing};
@if(relief) import package::passes::trace::relief::{relieved};

@if(normals) @group(0) @binding(5) var<storage, read> shading: array<Shading>;

// The surface at the end of a ray.
struct Surface {
    frame: ShadingFrame,
    material: MaterialRecord,
    // Index of the material.
    index: u32,
    position: vec3<f32>,
    // How far each coordinate must be moved for a ray that leaves from here.
    error: vec3<f32>,
    // Distance from the ray's origin.
    t: f32,
    // By how much the shading normal turns along a unit of length.
    @if(textures || relief || emission_map) curvature: f32,
    @if(thin && relief) bent: bool,
}

// `material` is that of the point, whatever its textures are.
fn surface_at(triangle: Triangle, hit: Hit, material: MaterialRecord, frame: ShadingFrame) -> Surface {
    let at = surface_point(triangle.a, triangle.b, triangle.c, hit.b1, hit.b2);
    var surface: Surface;
    surface.frame = frame;
    surface.material = material;
    surface.index = triangle.material;
    surface.position = at.position;
    surface.error = at.error;
    surface.t = hit.t;
    return surface;
}

// How the surface at a hit is seen. `area_normal` is the triangle's normal by its winding, of any length.
fn shading_frame_at(triangle: Triangle, hit: Hit, area_normal: vec3<f32>, wo: vec3<f32>) -> ShadingFrame {
    let unit = normalize(area_normal / largest_of(abs(area_normal)));
    let back_face = dot(unit, wo) < 0.0;
    let geometric = select(unit, -unit, back_face);
    return ShadingFrame(wo, geometric, geometric, u32(back_face));
}

// The normal of the mesh, on the side of the triangle's winding; that of a flat triangle is its own.
@if(normals || relief)
fn mesh_normal_at(triangle: Triangle, hit: Hit, frame: ShadingFrame) -> vec3<f32> {
    let flat_normal = select(frame.geometric, -frame.geometric, frame.back_face != 0u);
    @if(normals) {
        return interpolate_normal(shading[triangle.index], hit.b1, hit.b2, flat_normal);
    } @else {
        return flat_normal;
    }
}

// The normal that a surface is shaded by, on the side of its viewer, before it is bent to be seen.
@if(normals || relief)
fn unbent_normal_at(triangle: Triangle, hit: Hit, frame: ShadingFrame, @if(relief) texturing: Texturing) -> vec3<f32> {
    @if(relief) {
        if (texturing.maps.relief != 0u) {
            let normal = mesh_normal_at(triangle, hit, frame);
            let side = facing(normal, frame.geometric);
            let bent = relieved(texturing.maps.relief, texturing.point, triangle.index, hit.b1, hit.b2, normal, texturing.others.x);
            // However steep a picture is, the facet is in front of what it says.
            let seen = select(bent, -bent, dot(normal, frame.geometric) < 0.0);
            return bent_to_viewer(seen, side, frame.geometric);
        }
    }
    return facing(mesh_normal_at(triangle, hit, frame), frame.geometric);
}

// The same without a relief.
@if(normals || relief)
fn mesh_shading_normal(triangle: Triangle, hit: Hit, frame: ShadingFrame) -> vec3<f32> {
    return bent_to_viewer(facing(mesh_normal_at(triangle, hit, frame), frame.geometric), frame.geometric, frame.wo);
}

// Whether a relief bends the normal by which a surface lets light pass.
@if(thin && relief)
fn is_bent(material: MaterialRecord, maps: MaterialMaps) -> bool {
    return (material.flags & MATERIAL_THIN) != 0u && maps.relief != 0u;
}
