//! What can be said of the end of a ray without random numbers.

use glam::DVec3;

use super::Oracle;
use super::random::Random;

/// The end of a ray. World space, linear Rec.709.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertex {
    /// Distance from the ray's origin, in the direction's length.
    pub t: f64,
    /// Index of the triangle: meshes are in the order of their names.
    pub triangle: u32,
    /// Radiance that it sends back along the ray.
    pub emitted: DVec3,
    /// Density with which the oracle asks for this point as a light, by its own choice of lights.
    pub light_pdf: f64,
    /// Of each direction that was asked for: f * cos, and the density with which the oracle draws it, by its own choice of lobes. None
    /// where a texture decides, of which a path draws a texel.
    pub values: Option<Vec<(DVec3, f64)>>,
}

impl Oracle {
    /// What a ray hits, and what the surface there does with light from some directions; none where it hits nothing. `hit` is a triangle that
    /// is there, whatever holes it has: others with holes are taken as not there.
    pub fn vertex(&self, origin: DVec3, direction: DVec3, hit: u32, from: &[DVec3]) -> Option<Vertex> {
        // Nothing below draws: what would is left out.
        let none = &mut Random::new([0; 3]);
        let scene = &self.scene;
        let is_there = |met: &super::tree::Hit| met.triangle == hit || !scene.substance(met).has_holes();
        let met = scene.tree.closest(origin, direction, is_there)?;
        let substance = scene.substance(&met);
        let values = substance.is_the_same_everywhere().then(|| {
            let facing = scene.facing(&met, direction, none);
            let bsdf = substance.bsdf(scene.uv(&met), none);
            from.iter().map(|wi| bsdf.evaluate(&facing, *wi)).collect()
        });
        let emitted = scene.emitted(&met, direction);
        let light_pdf = if emitted == DVec3::ZERO { 0.0 } else { self.lights.pdf_of_hit(scene, &met, direction) };
        Some(Vertex { t: met.t, triangle: met.triangle, emitted, light_pdf, values })
    }

    /// Radiance from beyond the scene, and the density with which the oracle asks for it.
    pub fn beyond(&self, direction: DVec3) -> (DVec3, f64) {
        (self.lights.sky_radiance(direction), self.lights.pdf_of_sky(direction))
    }
}
