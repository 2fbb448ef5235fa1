// A smooth dielectric, and nothing else: the surface of a solid.

import package::gen::{MaterialRecord};
import package::lib::bsdf::dielectric::{eta_squared, fresnel, interface_of, refracted};
@if(normals) import package::lib::bsdf::facet::{kept_above};
import package::lib::bsdf::frame::{BsdfSample, ShadingFrame, is_above};
@if(dielectric) import package::lib::bsdf::frame::{mirror_direction};

// Reflected or refracted by Fresnel's probability, which leaves a weight of 1, but for the filter, and for radiance being
// squeezed into or out of a narrower cone.
@if(dielectric)
fn dielectric_sample(m: MaterialRecord, seen: ShadingFrame, pick: f32) -> BsdfSample {
    var frame = seen;
    let at = interface_of(m.ni, frame.back_face != 0u);
    var split = fresnel(at, dot(frame.wo, frame.shading));
    @if(normals) {
        // Total reflection about a smooth normal can catch light for ever. Where the surface itself would let some out, it does.
        let own = fresnel(at, dot(frame.wo, frame.geometric));
        if (split.cos_transmitted == 0.0 && own.cos_transmitted > 0.0) {
            split = own;
            frame.shading = frame.geometric;
        }
    }
    if (pick < split.reflectance) {
        let wi = mirror_direction(frame);
        return BsdfSample(wi, 0.0, vec3<f32>(select(0.0, 1.0, is_above(frame, wi))));
    }
    var wi = refracted(at, frame.wo, frame.shading, split.cos_transmitted);
    @if(normals) {
        wi = -kept_above(-wi, frame.geometric);
    }
    let beyond = dot(wi, frame.shading) < 0.0 && dot(wi, frame.geometric) < 0.0;
    return BsdfSample(wi, 0.0, select(vec3<f32>(0.0), eta_squared(at) * m.tf, beyond));
}
