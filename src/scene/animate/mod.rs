//! Values of a scene that change with time: keys, and what is between them.

mod curve;
mod value;

pub use value::Value;

use super::define::{Define, Written};
use super::diagnostic::Diagnostic;

/// The most frames of an animation.
pub const MOST_FRAMES: u32 = 4096;

/// Frames a second where none are given, and what they may be.
pub const FPS: f64 = 24.0;
pub const FPS_RANGE: [f64; 2] = [0.1, 1000.0];

/// What a scene file says under `animate`.
#[derive(Clone, Debug)]
pub struct Animation {
    pub frames: u32,
    /// Frames a second.
    pub fps: f64,
    pub tracks: Vec<Track>,
}

/// A path of the scene file, and the values that it goes through.
#[derive(Clone, Debug)]
pub struct Track {
    pub path: String,
    /// Of the path: a warning without its message.
    pub place: Diagnostic,
    pub curve: Curve,
    /// One at least; places ascend.
    pub keys: Vec<Key>,
}

/// What a value is between two keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    Linear,
    /// The monotone cubic of Fritsch and Carlson (1980).
    Smooth,
    /// That of the key before.
    Step,
}

/// A value at a time.
#[derive(Clone, Debug)]
pub struct Key {
    /// In frames from the first.
    pub at: f64,
    /// Those of a track differ in numbers alone, but for a step's.
    pub value: Value,
    /// Of the value: a warning without its message.
    pub place: Diagnostic,
}

impl Track {
    /// Whether the value at a frame is that of no key.
    fn is_between(&self, frame: f64) -> bool {
        let (before, after) =
            (self.keys.partition_point(|key| key.at < frame), self.keys.partition_point(|key| key.at <= frame));
        self.curve != Curve::Step && before == after && before > 0 && after < self.keys.len()
    }

    /// The change of the scene that the track is at a frame.
    pub fn at(&self, frame: f64) -> Define {
        let before = self.keys.partition_point(|key| key.at <= frame).saturating_sub(1);
        let Key { value, place, .. } = &self.keys[before];
        let places: Vec<f64> = self.keys.iter().map(|key| key.at).collect();
        let between = |curve: fn(&[f64], &[f64], f64) -> f64, part: usize| {
            let values: Vec<f64> = self.keys.iter().map(|key| key.value.numbers[part]).collect();
            curve(&places, &values, frame)
        };
        let number = |part: usize| match self.curve {
            Curve::Linear => between(curve::linear, part),
            Curve::Smooth => between(curve::smooth, part),
            Curve::Step => value.numbers[part],
        };
        let value = value.with((0..value.numbers.len()).map(number));
        let mut place = place.clone();
        if self.is_between(frame) {
            // What is written there is another value.
            place.message = format!("at frame {frame}, between two keys");
        }
        let written = Written::File { path: Box::new(self.place.clone()), value: Box::new(place) };
        Define { path: self.path.clone(), value, written }
    }
}
