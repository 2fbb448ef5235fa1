//! Parts of the error, and how sure they are.

use std::collections::BTreeMap;

use super::class::Class;
use super::tally::{GROUPS, Tally};

/// A part of all of the error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// Of 1; below 0 where it takes from the error.
    pub share: f64,
    /// Standard error of that: by leaving out a group of pixels after the other (jackknife).
    pub deviation: f64,
}

/// The parts of classes that have the same key, the greatest first. They add up to 1; none where there is no error.
pub fn shares<K: Ord + Clone>(tally: &Tally, key: impl Fn(&Class) -> K) -> Vec<(K, Share)> {
    let mut by_key: BTreeMap<K, [f64; GROUPS]> = BTreeMap::new();
    let mut all = [0.0; GROUPS];
    for (class, sums) in &tally.classes {
        let own = by_key.entry(key(class)).or_insert([0.0; GROUPS]);
        for group in 0..GROUPS {
            own[group] += sums[group];
            all[group] += sums[group];
        }
    }
    if all.iter().sum::<f64>() <= 0.0 {
        return Vec::new();
    }
    let mut parts: Vec<(K, Share)> = by_key.into_iter().map(|(key, own)| (key, Share::of(&own, &all))).collect();
    parts.sort_by(|a, b| b.1.share.total_cmp(&a.1.share).then_with(|| a.0.cmp(&b.0)));
    parts
}

impl Share {
    fn of(own: &[f64; GROUPS], all: &[f64; GROUPS]) -> Self {
        let (sum, whole): (f64, f64) = (own.iter().sum(), all.iter().sum());
        // Groups of small pictures may be empty, and say nothing.
        let there = all.iter().zip(own).filter(|(all, _)| **all != 0.0);
        let without: Vec<f64> =
            there.filter(|(all, _)| whole > **all).map(|(all, own)| (sum - own) / (whole - all)).collect();
        let count = without.len() as f64;
        let mean = without.iter().sum::<f64>() / count.max(1.0);
        let spread: f64 = without.iter().map(|share| (share - mean) * (share - mean)).sum();
        let deviation = if count > 1.0 { (spread * (count - 1.0) / count).sqrt() } else { f64::INFINITY };
        Self { share: sum / whole, deviation }
    }
}
