//! What pixels have along a straight edge.
//!
//! The edge of a lamp may cover a few hundredths of each pixel that it runs through. With few samples one half of such a pixel has met it and the other has
//! not, and the pixel alone can't tell that from a rare bright sample of a dark one. Those beside it along the edge can: they have as much of the lamp.

use super::halves::Halves;

/// Pixels of a line on either side of the one in its middle.
const REACH: i64 = 2;

/// Steps from one pixel of a line to the next, columns and rows.
const DIRECTIONS: [(i64, i64); 4] = [(1, 0), (0, 1), (1, 1), (1, -1)];

/// An edge is where pixels of one line are so many times less spread than those of another.
const CLEAR: f64 = 100.0;

/// The pixels of one line through a pixel, without that.
#[derive(Clone, Copy, Debug, Default)]
struct Line {
    /// Variance over its pixels.
    spread: f64,
    /// The lesser one of the halves' means.
    dark: f64,
}

/// What a channel has at least along the edge that a pixel is at; 0 where it is at none. `at`: column and row.
pub fn along_edge(halves: &[Halves], width: usize, at: (usize, usize), channel: usize) -> f64 {
    let lines = DIRECTIONS.map(|step| Line::through(halves, width, at, step, channel));
    let lines = || lines.iter().flatten();
    let widest = lines().map(|line| line.spread).fold(0.0, f64::max);
    let least = lines().min_by(|a, b| a.spread.total_cmp(&b.spread));
    least.filter(|line| CLEAR * line.spread < widest).map_or(0.0, |line| line.dark)
}

impl Line {
    /// None where the film ends before the line does, or some pixel has no samples in a half.
    fn through(
        halves: &[Halves],
        width: usize,
        (x, y): (usize, usize),
        (across, down): (i64, i64),
        channel: usize,
    ) -> Option<Self> {
        let (mut sums, mut squares, mut count) = ([0.0; 2], 0.0, 0.0);
        for far in (-REACH..=REACH).filter(|far| *far != 0) {
            let column = x.checked_add_signed((far * across) as isize).filter(|column| *column < width)?;
            let row = y.checked_add_signed((far * down) as isize)?;
            let pixel = halves.get(row * width + column).filter(|pixel| pixel.is_there())?;
            let [a, b] = pixel.means.map(|mean| mean[channel]);
            sums[0] += a;
            sums[1] += b;
            squares += (0.5 * (a + b)).powi(2);
            count += 1.0;
        }
        let mean = 0.5 * (sums[0] + sums[1]) / count;
        Some(Self { spread: (squares / count - mean * mean).max(0.0), dark: sums[0].min(sums[1]) / count })
    }
}
