//! The radix sort, stage by stage as on the GPU, and a plain stable sort as the judge of both.

use crate::layout::sort::{
    SORT_BINS, SORT_DIGITS, SORT_IN_BACK, SORT_IN_FRONT, SORT_MOST_GROUPS, SORT_TILE, SortDigit, SortPlan, scan_groups,
    tiles,
};

/// Bits `8 * digit .. 8 * digit + 8` of a key.
pub fn digit_of(key: u64, digit: u32) -> usize {
    (key >> (8 * digit)) as usize & (SORT_BINS as usize - 1)
}

/// AND and OR of all keys.
pub fn agree(keys: &[u64]) -> (u64, u64) {
    keys.iter().fold((u64::MAX, 0), |(and, or), key| (and & key, or | key))
}

/// What the GPU has to decide about a sort of these keys.
pub fn plan(keys: &[u64]) -> SortPlan {
    let (and, or) = agree(keys);
    let tiles = tiles(keys.len() as u32);
    let mut plan = SortPlan { result: SORT_IN_FRONT, ..Default::default() };
    for digit in 0..SORT_DIGITS {
        let entry = &mut plan.digits[digit as usize];
        *entry = SortDigit { source: plan.result, skipped: 1, ..Default::default() };
        if digit_of(or & !and, digit) == 0 {
            continue;
        }
        entry.skipped = 0;
        [entry.tiles_x, entry.tiles_y, entry.tiles_z] =
            [tiles.min(SORT_MOST_GROUPS), tiles.div_ceil(SORT_MOST_GROUPS), 1];
        [entry.bins_x, entry.bins_y, entry.bins_z] = [scan_groups(tiles), 1, 1];
        plan.digits_run += 1;
        plan.result = SORT_IN_FRONT + SORT_IN_BACK - plan.result;
    }
    plan
}

/// Histogram of a digit over each tile: bin by bin, and tile by tile in a bin.
pub fn count(keys: &[u64], digit: u32) -> Vec<u32> {
    let tiles = tiles(keys.len() as u32) as usize;
    let mut counts = vec![0; SORT_BINS as usize * tiles];
    for (tile, keys) in keys.chunks(SORT_TILE as usize).enumerate() {
        for key in keys {
            counts[digit_of(*key, digit) * tiles + tile] += 1;
        }
    }
    counts
}

/// Replaces each bin's counts by their exclusive prefix sums over tiles. Returns the total of each bin.
pub fn scan(counts: &mut [u32]) -> Vec<u32> {
    let tiles = counts.len() / SORT_BINS as usize;
    let sum = |row: &mut [u32]| {
        row.iter_mut().fold(0, |before, count| {
            let after = before + *count;
            *count = before;
            after
        })
    };
    counts.chunks_mut(tiles.max(1)).map(sum).collect()
}

/// Moves pairs to their places by a digit, from the results of [`scan`].
pub fn scatter(keys: &[u64], payload: &[u32], digit: u32, counts: &[u32], totals: &[u32]) -> (Vec<u64>, Vec<u32>) {
    let tiles = tiles(keys.len() as u32) as usize;
    let (mut keys_out, mut payload_out) = (vec![0; keys.len()], vec![0; keys.len()]);
    for (tile, keys_in) in keys.chunks(SORT_TILE as usize).enumerate() {
        let mut before = 0;
        let mut next: Vec<u32> = Vec::with_capacity(SORT_BINS as usize);
        for (bin, total) in totals.iter().enumerate() {
            next.push(before + counts[bin * tiles + tile]);
            before += total;
        }
        for (i, key) in keys_in.iter().enumerate() {
            let place = &mut next[digit_of(*key, digit)];
            keys_out[*place as usize] = *key;
            payload_out[*place as usize] = payload[tile * SORT_TILE as usize + i];
            *place += 1;
        }
    }
    (keys_out, payload_out)
}

/// The whole sort as the GPU does it: planned digits only, count, scan, scatter.
pub fn sort(keys: &[u64], payload: &[u32]) -> (Vec<u64>, Vec<u32>) {
    let plan = plan(keys);
    let mut pairs = (keys.to_vec(), payload.to_vec());
    for digit in (0..SORT_DIGITS).filter(|d| plan.digits[*d as usize].skipped == 0) {
        let mut counts = count(&pairs.0, digit);
        let totals = scan(&mut counts);
        pairs = scatter(&pairs.0, &pairs.1, digit, &counts, &totals);
    }
    pairs
}

/// The judge: a stable sort by key, by the standard library.
pub fn stable(keys: &[u64], payload: &[u32]) -> (Vec<u64>, Vec<u32>) {
    let mut pairs: Vec<(u64, u32)> = keys.iter().copied().zip(payload.iter().copied()).collect();
    pairs.sort_by_key(|pair| pair.0);
    pairs.into_iter().unzip()
}

/// PCG's output permutation over one step of its generator (Jarzynski and Olano 2020).
fn pcg(seed: u32) -> u32 {
    let state = seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// The random 63-bit key that the fill pass gives to pair `index`. One in 16 repeats the key of an earlier pair.
pub fn random_key(index: u32) -> u64 {
    let low = pcg(if index % 16 == 15 { index / 2 } else { index });
    let high = pcg(low ^ 0x9e37_79b9) & 0x7fff_ffff;
    u64::from(high) << 32 | u64::from(low)
}
