//! How a surface is seen, which directions that leaves, and a way on in one of them.

use glam::{DMat3, DVec3};

/// How a surface is seen. Both normals are on the side of `wo`.
///
/// Where they differ, what a specular lobe sends into the true surface is mirrored by it, and a diffuse one is made stronger by as much as
/// the true surface hides of it.
#[derive(Clone, Copy, Debug)]
pub struct Facing {
    pub wo: DVec3,
    pub shading: DVec3,
    pub geometric: DVec3,
    /// Seen from the side where the winding is clockwise.
    pub from_behind: bool,
}

/// A way on.
#[derive(Clone, Copy, Debug)]
pub struct Draw {
    pub wi: DVec3,
    /// f cos / pdf.
    pub weight: DVec3,
    /// By solid angle; 0 where the direction is the only one that its lobe has.
    pub pdf: f64,
}

impl Facing {
    /// `wo` reflected about the shading normal.
    pub fn mirror(&self) -> DVec3 {
        2.0 * self.wo.dot(self.shading) * self.shading - self.wo
    }

    pub fn cos_viewer(&self) -> f64 {
        self.wo.dot(self.shading)
    }

    /// What becomes of a direction that a specular lobe has drawn.
    pub fn drawn(&self, wi: DVec3) -> Option<DVec3> {
        (wi.dot(self.shading) > 0.0).then(|| self.leaving(wi))
    }

    /// A direction reflected by the true surface, from above or from below.
    pub fn off_surface(&self, wi: DVec3) -> DVec3 {
        wi.reflect(self.geometric)
    }

    /// A direction of the viewer's side, once the true surface has reflected it if it must.
    pub fn leaving(&self, wi: DVec3) -> DVec3 {
        if wi.dot(self.geometric) < 0.0 { self.off_surface(wi) } else { wi }
    }

    /// Part of a cosine lobe about the shading normal that is above the true surface.
    pub fn visible_part(&self) -> f64 {
        0.5 + 0.5 * self.shading.dot(self.geometric)
    }

    /// The cosine to the shading normal that a direction would have if the true surface hid nothing: seen along the shading normal, what it
    /// leaves of each chord of the unit disc is stretched to the whole.
    pub fn cos_unhidden(&self, wi: DVec3) -> f64 {
        let cos = wi.dot(self.shading);
        let Some(lean) = self.geometric.reject_from_normalized(self.shading).try_normalize() else { return cos };
        // Half the chord, and where the direction is on it. It is hidden from -1 to minus the cosine between the normals, in halves.
        let half = (1.0 - wi.dot(lean.cross(self.shading)).powi(2)).max(0.0).sqrt();
        let part = (wi.dot(lean) / half + self.shading.dot(self.geometric)) / (2.0 * self.visible_part());
        half * (1.0 - (2.0 * part - 1.0).powi(2)).max(0.0).sqrt()
    }

    /// Columns: two tangents and the shading normal.
    pub fn frame(&self) -> DMat3 {
        let (s, t) = self.shading.any_orthonormal_pair();
        DMat3::from_cols(s, t, self.shading)
    }
}
