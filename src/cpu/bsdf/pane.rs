//! A pane of glass as one sheet: what two parallel faces reflect and let through, by the series of all crossings between them.

use glam::DVec3;

use super::dielectric::Interface;

/// What a pane of this index reflects and lets through at a cosine; `tf` is what each crossing between its faces leaves.
pub fn split(ni: f64, tf: DVec3, cos: f64) -> [DVec3; 2] {
    let r = Interface::new(ni, false).reflectance(cos);
    let split = |t: f64| {
        let passed = (1.0 - r).powi(2) * t / (1.0 - (r * t).powi(2)).max(f64::MIN_POSITIVE);
        (r + r * t * passed, passed)
    };
    let [x, y, z] = tf.to_array().map(split);
    [DVec3::new(x.0, y.0, z.0), DVec3::new(x.1, y.1, z.1)]
}
