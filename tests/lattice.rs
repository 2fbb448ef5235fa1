//! The order in which pixels get their first sample.

use glam::UVec2;
use lucerna::passes::lattice::{COARSEST, Lattice, corners, level_within, refinement};

/// How often a lattice has each pixel of a window.
fn add(counts: &mut [u32], window: UVec2, lattice: Lattice) {
    let size = lattice.size(window);
    for y in 0..size.y {
        for x in 0..size.x {
            let at = lattice.first + (UVec2::new(x, y) << lattice.shift);
            assert!(at.cmplt(window).all(), "{lattice:?} leaves a window of {window}");
            counts[(at.y * window.x + at.x) as usize] += 1;
        }
    }
}

#[test]
fn from_any_level_on_every_pixel_comes_once() {
    for window in [(1, 1), (1, 40), (40, 1), (7, 5), (16, 16), (33, 20), (64, 47)].map(UVec2::from) {
        for begin in 0..=COARSEST {
            let mut counts = vec![0; (window.x * window.y) as usize];
            add(&mut counts, window, corners(begin));
            for level in (0..begin).rev() {
                add(&mut counts, window, refinement(level));
                // Level by level they are the corners of its blocks.
                let mut right = vec![0; counts.len()];
                add(&mut right, window, corners(level));
                assert_eq!(counts, right, "{window} at level {level} from {begin} on");
            }
            assert!(counts.iter().all(|count| *count == 1), "{window} from {begin} on");
        }
    }
}

#[test]
fn levels_double_in_pixels_down_to_a_256th() {
    let window = UVec2::new(1024, 768);
    for level in 0..=COARSEST {
        assert_eq!(corners(level).pixels(window) << level, 1024 * 768);
    }
    assert_eq!(corners(6).shift, UVec2::splat(3), "a 64th: blocks of 8 by 8");
    assert_eq!([786_432, 786_431, 12_288, 12_287, 1].map(|most| level_within(window, most)), [0, 1, 6, 7, COARSEST]);
}
