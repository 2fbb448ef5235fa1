//! The surface at the end of a ray in f64: how it is seen, and what its textures are looked up by. The twin of `passes/trace/surface` and
//! `passes/trace/footprint`.

use glam::{DVec3, DVec4};

use super::bsdf::ShadingFrame;
use super::normals::{bent_to_viewer, smooth_normal};
use super::path::PathScene;
use super::texture::TexturePoint;
use super::textured::Cone;
use super::triangles::HitF64;
use crate::layout::texture::{MaterialMaps, TEXTURE_DIMENSIONS, TEXTURE_DIMENSIONS_PER_BOUNCE};
use crate::layout::trace::{MATERIAL_THIN, MaterialRecord, SampleKey};

/// What is known of a hit before a texel is looked up, and the numbers that draw texels.
pub struct Texturing {
    pub maps: MaterialMaps,
    pub point: TexturePoint,
    pub colours: DVec4,
    pub others: DVec4,
}

impl PathScene<'_> {
    /// What is known of a hit before a texel is looked up.
    pub(super) fn texturing(
        &self,
        hit: &HitF64,
        cone: Cone,
        direction: DVec3,
        (key, bounce): (SampleKey, u32),
    ) -> Texturing {
        let maps = self.textures.maps(hit.triangle.material);
        let ahead = cone.long_axis(hit.t, hit.triangle.corners, direction);
        let point = self.textures.point_with(hit.triangle.index, hit.b, cone.width_at(hit.t), ahead);
        let first = TEXTURE_DIMENSIONS + bounce * TEXTURE_DIMENSIONS_PER_BOUNCE;
        let [colours, others] = [first, first + 4].map(|dimension| self.sampler.sample_4d(key, dimension));
        Texturing { maps, point, colours, others }
    }

    /// What a map multiplies emission by.
    pub(super) fn emission_part(&self, maps: &MaterialMaps, point: TexturePoint, u: f64) -> DVec3 {
        if maps.emission == 0 { DVec3::ONE } else { self.textures.colour(maps.emission, point, u) }
    }

    /// How a surface is seen, and the normal that it is shaded by before that is bent to its viewer.
    pub(super) fn frame(&self, hit: &HitF64, wo: DVec3, texturing: &Texturing) -> (ShadingFrame, DVec3) {
        let frame = self.mesh_frame(hit, wo);
        let Texturing { maps, point, others, .. } = texturing;
        if maps.relief == 0 {
            return (frame, self.mesh_side(hit, frame.geometric));
        }
        let (n, geometric) = (self.mesh_normal(hit), frame.geometric);
        let bent = self.textures.relieved(maps, *point, hit.triangle.index, hit.b, n, others.x);
        let [seen, side] = if n.dot(geometric) < 0.0 { [-bent, -n] } else { [bent, n] };
        let unbent = bent_to_viewer(seen, side, geometric);
        (ShadingFrame { shading: bent_to_viewer(unbent, geometric, wo), ..frame }, unbent)
    }

    /// As the mesh is, without a relief.
    pub(super) fn mesh_frame(&self, hit: &HitF64, wo: DVec3) -> ShadingFrame {
        let front = front_of(hit);
        let back_face = front.dot(wo) < 0.0;
        let geometric = if back_face { -front } else { front };
        let side = self.mesh_side(hit, geometric);
        ShadingFrame { wo, shading: bent_to_viewer(side, geometric, wo), geometric, back_face }
    }

    /// The mesh's normal on the side of a facet's.
    pub(super) fn mesh_side(&self, hit: &HitF64, geometric: DVec3) -> DVec3 {
        let n = self.mesh_normal(hit);
        if n.dot(geometric) < 0.0 { -n } else { n }
    }

    /// That of its corners, or of the flat triangle.
    pub(super) fn mesh_normal(&self, hit: &HitF64) -> DVec3 {
        let smooth = self.shading.get(hit.triangle.index as usize).and_then(|n| smooth_normal(n, hit.b));
        smooth.unwrap_or_else(|| front_of(hit))
    }
}

/// Whether a relief bends the normal by which a surface lets light pass.
pub fn is_bent(material: &MaterialRecord, maps: &MaterialMaps) -> bool {
    material.flags & MATERIAL_THIN != 0 && maps.relief != 0
}

/// A triangle's normal by its winding.
fn front_of(hit: &HitF64) -> DVec3 {
    let [a, b, c] = hit.triangle.corners;
    (b - a).cross(c - a).normalize()
}
