//! Shading normals in f64: the twin of `lib/normals`.

use glam::DVec3;

use crate::layout::trace::{LEAST_FACING, Shading};

/// The interpolated normal at weights of the second and third corner, unit length; none where a corner has none or they cancel.
pub fn smooth_normal(corners: &Shading, b: [f64; 2]) -> Option<DVec3> {
    let words = [corners.n0, corners.n1, corners.n2];
    if words.contains(&0) {
        return None;
    }
    let [n0, n1, n2] = words.map(octahedral_decode);
    let n = (1.0 - b[0] - b[1]) * n0 + b[0] * n1 + b[1] * n2;
    (n.length_squared() >= 1e-6).then(|| n.normalize())
}

/// A shading normal turned towards its viewer, as little as makes it seen at all, where its facet is.
pub fn bent_to_viewer(n: DVec3, facet: DVec3, wo: DVec3) -> DVec3 {
    let least = f64::from(LEAST_FACING).min(wo.dot(facet));
    if n.dot(wo) < least { (n.reject_from_normalized(wo) + least * wo).normalize() } else { n }
}

/// A unit vector from its octahedral snorm16 pair (Cigolle et al., JCGT 3(2), 2014).
pub fn octahedral_decode(word: u32) -> DVec3 {
    let snorm = |half: u32| (f64::from(half as u16 as i16) / 32767.0).max(-1.0);
    let (x, y) = (snorm(word), snorm(word >> 16));
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    let shrink = |v: f64| if v >= 0.0 { v - fold } else { v + fold };
    DVec3::new(shrink(x), shrink(y), z).normalize()
}
