//! Numbers that code shows of itself, as colours: the twin of `passes/display/probe_colours`, and the range that `passes/trace/probe` finds.

use glam::Vec4;

use crate::layout::probe::{PROBE_LENGTH, PROBE_VEC2, ProbeColours};

/// Where no number was shown.
pub const NOTHING: [u8; 3] = [70; 3];

/// Where it is no number, or infinite.
pub const NO_NUMBER: [u8; 3] = [230, 30, 30];

/// Of viridis (Smith and van der Walt 2015), evenly spaced.
const RAMP: [[f64; 3]; 5] =
    [[68.0, 1.0, 84.0], [59.0, 82.0, 139.0], [33.0, 145.0, 140.0], [94.0, 201.0, 98.0], [253.0, 231.0, 37.0]];

/// The range of numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProbeRange {
    /// The least and the greatest; none where there is no finite number.
    pub all: Option<[f32; 2]>,
    /// The least above 0.
    pub positive: Option<f32>,
}

impl ProbeRange {
    /// Of values as `passes/trace/probe` leaves them; of vectors, a channel or the length.
    pub fn of(values: &[Vec4], part: u32) -> Self {
        let numbers = values.iter().filter_map(|value| number(*value, part)).filter(|x| x.is_finite());
        numbers.fold(Self::default(), |range, x| Self {
            all: Some(range.all.map_or([x; 2], |[least, most]| [least.min(x), most.max(x)])),
            positive: if x > 0.0 { Some(range.positive.map_or(x, |least| least.min(x))) } else { range.positive },
        })
    }

    /// What the first and the last colour stand for, where nobody says so.
    pub fn ends(&self, logarithmic: bool) -> [f32; 2] {
        match (self.all, self.positive) {
            (Some([_, most]), Some(least)) if logarithmic => [least, most],
            (Some(ends), _) if !logarithmic => ends,
            _ => [0.0; 2],
        }
    }
}

/// The one number of a value that has 1 + its type behind it: of a vector, a channel or its length; none where nothing was shown.
pub fn number(value: Vec4, part: u32) -> Option<f32> {
    let is_vector = value.w > PROBE_VEC2 as f32;
    (value.w > 0.0).then(|| match part {
        _ if !is_vector => value.x,
        part if part >= PROBE_LENGTH => value.truncate().as_dvec3().length() as f32,
        part => value[part as usize],
    })
}

/// Where a number lies between two ends, from 0 to 1; where they are one, in the middle.
pub fn place(x: f32, [low, high]: [f32; 2], logarithmic: bool) -> f64 {
    let [x, low, high] = [x, low, high].map(f64::from);
    match () {
        () if low >= high && x == low => 0.5,
        () if low >= high => f64::from(u8::from(x > low)),
        () if logarithmic => {
            let [x, low, high] = [x, low, high].map(|x| x.max(f32::MIN_POSITIVE.into()).log2());
            ((x - low) / (high - low)).clamp(0.0, 1.0)
        }
        () => ((x - low) / (high - low)).clamp(0.0, 1.0),
    }
}

/// The number at a place: the inverse of [`place`].
pub fn number_at(place: f64, [low, high]: [f32; 2], logarithmic: bool) -> f64 {
    let [low, high] = [low, high].map(f64::from);
    if logarithmic {
        let [low, high] = [low, high].map(|x| x.max(f32::MIN_POSITIVE.into()).log2());
        return (low + place * (high - low)).exp2();
    }
    low + place * (high - low)
}

/// The colour of a place from 0 to 1.
pub fn colour(place: f64) -> [u8; 3] {
    let at = 4.0 * place.clamp(0.0, 1.0);
    let from = (at as usize).min(RAMP.len() - 2);
    let part = at - from as f64;
    [0, 1, 2].map(|channel| {
        let [low, high] = [RAMP[from][channel], RAMP[from + 1][channel]];
        (low + part * (high - low) + 0.5) as u8
    })
}

/// A picture word a value: r in the lowest byte, a = 255 in the highest.
pub fn probe_colours(values: &[Vec4], params: &ProbeColours) -> Vec<u32> {
    let logarithmic = params.logarithmic != 0;
    let ends = match params.bounded {
        0 => ProbeRange::of(values, params.part).ends(logarithmic),
        _ => [params.low, params.high],
    };
    let shown = |value: &Vec4| match number(*value, params.part) {
        None => NOTHING,
        Some(x) if x.is_finite() => colour(place(x, ends, logarithmic)),
        Some(_) => NO_NUMBER,
    };
    let word = |[r, g, b]: [u8; 3]| u32::from_le_bytes([r, g, b, 255]);
    values.iter().map(|value| word(shown(value))).collect()
}

/// How often numbers of a size were shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histogram {
    /// Pixels.
    pub pixels: u32,
    /// Those that have a number, or something in its place.
    pub shown: u32,
    /// Those of them that have no number, or an infinite one: they are in no bin.
    pub broken: u32,
    /// What the first bin begins with, and the last ends with.
    pub ends: [f32; 2],
    /// The least and the greatest number; none where there is none.
    pub all: Option<[f32; 2]>,
    /// Pixels a bin; those beyond the ends are in the first and the last.
    pub bins: Vec<u32>,
}

impl Histogram {
    /// Of values as they are looked at, with so many bins.
    pub fn of(values: &[Vec4], params: &ProbeColours, bins: usize) -> Self {
        let (logarithmic, range) = (params.logarithmic != 0, ProbeRange::of(values, params.part));
        let ends = if params.bounded != 0 { [params.low, params.high] } else { range.ends(logarithmic) };
        let mut histogram = Self { pixels: values.len() as u32, ends, all: range.all, ..Self::default() };
        histogram.bins = vec![0; bins.max(1)];
        for x in values.iter().filter_map(|value| number(*value, params.part)) {
            histogram.shown += 1;
            if x.is_finite() {
                let bin = (place(x, ends, logarithmic) * bins as f64) as usize;
                histogram.bins[bin.min(bins.max(1) - 1)] += 1;
            } else {
                histogram.broken += 1;
            }
        }
        histogram
    }
}
