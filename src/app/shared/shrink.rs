//! A picture made small: each pixel is the mean light of those it covers.

use glam::UVec2;

use crate::image::srgb::srgb_byte;

/// The size of a picture within a square, of the same shape but for rounding.
pub fn fitting(size: UVec2, side: u32) -> UVec2 {
    let longest = size.max_element().max(1);
    if longest <= side {
        return size.max(UVec2::ONE);
    }
    let scaled =
        |length: u32| ((u64::from(length) * u64::from(side) + u64::from(longest) / 2) / u64::from(longest)) as u32;
    UVec2::new(scaled(size.x), scaled(size.y)).max(UVec2::ONE)
}

/// A picture of one size from one of another, sRGB. `light` is the linear light of a pixel, row by row from the top.
pub fn shrink(from: UVec2, to: UVec2, light: impl Fn(usize) -> [f64; 3]) -> Vec<[u8; 3]> {
    let (columns, rows) = (shares(from.x, to.x), shares(from.y, to.y));
    // First along rows, then along columns.
    let width = from.x as usize;
    let narrow: Vec<[f64; 3]> = (0..from.y as usize)
        .flat_map(|y| columns.iter().map(move |parts| (y * width, parts)))
        .map(|(row, parts)| mean(parts, |x| light(row + x)))
        .collect();
    let width = to.x as usize;
    rows.iter()
        .flat_map(|parts| (0..width).map(|x| mean(parts, |y| narrow[y * width + x]).map(srgb_byte)).collect::<Vec<_>>())
        .collect()
}

fn mean(parts: &[(usize, f64)], value: impl Fn(usize) -> [f64; 3]) -> [f64; 3] {
    parts.iter().fold([0.0; 3], |sum, &(at, share)| {
        let value = value(at);
        [0, 1, 2].map(|channel| sum[channel] + share * value[channel])
    })
}

/// Of each new pixel in a line: the old ones that it covers, and their shares, which sum to 1.
fn shares(from: u32, to: u32) -> Vec<Vec<(usize, f64)>> {
    let scale = f64::from(from) / f64::from(to.max(1));
    (0..to)
        .map(|i| {
            let (low, high) = (f64::from(i) * scale, (f64::from(i) + 1.0) * scale);
            let covered = low.floor() as u32..(high.ceil() as u32).min(from);
            covered
                .map(|old| (old as usize, (high.min(f64::from(old) + 1.0) - low.max(f64::from(old))) / scale))
                .filter(|part| part.1 > 1e-9)
                .collect()
        })
        .collect()
}
