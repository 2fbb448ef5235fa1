//! What is seen of a point below a lamp.

use super::paths::samples;
use crate::layout::trace::SAMPLE_BAD;
use crate::stress::lab::Lab;
use crate::stress::measured::StressError;
use crate::stress::scenes::lamp::Lamp;
use crate::stress::scenes::room::Room;

/// The mean radiance that leaves the point the camera sees by paths of so many segments, and its standard error.
pub fn seen(lab: &Lab, room: &Room, layers: u32, max_depth: u32) -> Result<(f64, f64), StressError> {
    let mut rig = lab.rig();
    room.load(&mut rig)?;
    let got = samples(&mut rig, &Lamp::params(room, layers, max_depth))?;
    if let Some(bad) = got.iter().find(|sample| sample.info & SAMPLE_BAD != 0) {
        return Err(StressError::Broken(format!("a bad sample: {bad:?}")));
    }
    let n = got.len() as f64;
    let values = || got.iter().map(|sample| f64::from(sample.rgb.x));
    let mean = values().sum::<f64>() / n;
    let squares = values().map(|value| value * value).sum::<f64>();
    Ok((mean, ((squares / n - mean * mean).max(0.0) / n).sqrt()))
}
