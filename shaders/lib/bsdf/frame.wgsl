// How a surface is seen, and what its BSDF says of a direction.

@if(normals && (dielectric || mirror || coat || thin)) import package::lib::bsdf::facet::{kept_above};
@if(dielectric || mirror || coat || thin) import package::lib::bsdf::mirror::{reflected};

// How a surface is seen. All unit length; both normals are on the side of `wo`.
struct ShadingFrame {
    // Away from the surface, to where the ray came from.
    wo: vec3<f32>,
    shading: vec3<f32>,
    geometric: vec3<f32>,
    // 1 where the surface is seen from its back, by its winding.
    back_face: u32,
}

struct BsdfSample {
    // World space, unit length.
    direction: vec3<f32>,
    // By solid angle, of the whole mixture; 0 where the direction is the only one that its lobe has.
    pdf: f32,
    // f * cos / pdf, or such a lobe's value by its probability; 0 where nothing is carried.
    weight: vec3<f32>,
}

struct BsdfValue {
    // f * cos.
    value: vec3<f32>,
    // By which mixture_sample() draws this direction, by solid angle.
    pdf: f32,
}

fn is_above(frame: ShadingFrame, wi: vec3<f32>) -> bool {
    return dot(wi, frame.shading) > 0.0 && dot(wi, frame.geometric) > 0.0;
}

// Where a mirror reflects to.
@if(dielectric || mirror || coat || thin)
fn mirror_direction(frame: ShadingFrame) -> vec3<f32> {
    var wi = reflected(frame.wo, frame.shading);
    @if(normals) {
        wi = kept_above(wi, frame.geometric);
    }
    return wi;
}
