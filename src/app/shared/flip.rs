//! LDR-FLIP (Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild 2020) by NVIDIA's own code.
//!
//! That takes about 150 bytes a pixel at work. FLIP looks no further than its filters reach, so large pictures are done in
//! bands of rows, with rows around them that are thrown away: the result is the same, and bands run side by side.

use std::sync::Mutex;

use glam::UVec2;

/// Rows of a band.
const BAND: usize = 128;

/// Rows around a band. At 67 pixels a degree the widest filter reaches 10 pixels (tests/compare.rs compares with one band).
const MARGIN: usize = 16;

/// FLIP of every pixel, 0 to 1, row by row. Both pictures are sRGB.
pub fn flip(test: &[[u8; 3]], reference: &[[u8; 3]], size: UVec2) -> Vec<f32> {
    let (width, height) = (size.x as usize, size.y as usize);
    let mut map = vec![0.0; width * height];
    let bands = Mutex::new(map.chunks_mut(width * BAND).enumerate());
    let work = || {
        loop {
            let next = bands.lock().expect("invariant: no thread panics").next();
            let Some((index, band)) = next else { return };
            let first = (index * BAND).saturating_sub(MARGIN);
            let end = ((index + 1) * BAND + MARGIN).min(height);
            let error = whole(&test[first * width..end * width], &reference[first * width..end * width], size.x);
            let skipped = (index * BAND - first) * width;
            band.copy_from_slice(&error[skipped..skipped + band.len()]);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    map
}

/// FLIP of a picture in one piece.
fn whole(test: &[[u8; 3]], reference: &[[u8; 3]], width: u32) -> Vec<f32> {
    let height = u32::try_from(test.len() / width as usize).expect("invariant: rows of a band");
    let image = |pixels: &[[u8; 3]]| nv_flip::FlipImageRgb8::with_data(width, height, pixels.as_flattened());
    nv_flip::flip(image(reference), image(test), nv_flip::DEFAULT_PIXELS_PER_DEGREE).to_vec()
}
