//! How pictures are made to fit in memory together.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// How many times the sides of each picture, of so many bytes, are halved, so that all of them take `most` bytes: always the
/// largest first.
pub fn halvings(bytes: &[u64], most: u64) -> Vec<u32> {
    let mut halvings = vec![0; bytes.len()];
    let mut sum: u64 = bytes.iter().sum();
    // Of pictures alike, the first.
    let mut largest: BinaryHeap<(u64, Reverse<usize>)> =
        bytes.iter().enumerate().map(|(index, bytes)| (*bytes, Reverse(index))).collect();
    while sum > most
        && let Some((bytes, Reverse(index))) = largest.pop()
        && bytes > LEAST
    {
        halvings[index] += 1;
        sum -= bytes - bytes / 4;
        largest.push((bytes / 4, Reverse(index)));
    }
    halvings
}

/// Bytes of a picture that is not halved any more.
const LEAST: u64 = 16;
