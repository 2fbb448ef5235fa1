//! Turns in scene files.

use glam::DMat3;

use super::ron::Fields;

/// The turns `rotate_x`, `rotate_y` and `rotate_z`, degrees, one after the other in this order; none where no such field is there.
pub fn read_turn(fields: &Fields) -> Option<DMat3> {
    let angle = |name: &'static str| fields.read(name, |node| node.number(-1e6, 1e6).map(f64::to_radians));
    let (x, y, z) = (angle("rotate_x"), angle("rotate_y"), angle("rotate_z"));
    x.or(y).or(z)?;
    let by = |angle: Option<f64>| angle.unwrap_or(0.0);
    Some(DMat3::from_rotation_z(by(z)) * DMat3::from_rotation_y(by(y)) * DMat3::from_rotation_x(by(x)))
}
