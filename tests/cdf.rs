//! Tables of sums: what they draw is what their weights say, in order, to half a step of the uniform numbers.

use lucerna::cpu::cdf::{draw_index, left_over};
use lucerna::layout::cdf::CdfEntry;
use lucerna::prepare::cdf::cdf_table;
use lucerna::scene::generate::SplitMix;

/// Step of the uniform numbers.
const STEP: f64 = 1.0 / (1 << 24) as f64;

/// The index of a number by all sums, one after another.
fn by_hand(table: &[CdfEntry], u: f64) -> usize {
    table.iter().position(|entry| u < f64::from(entry.end)).expect("the last sum is 1")
}

fn drawn(table: &[CdfEntry], u: f64) -> (usize, f64) {
    draw_index(table.len(), u, |index| (table[index].end, table[index].first))
}

/// Whether a table draws by its weights: each probability to a step, and all up to an index to half of one; what weighs nothing is never drawn.
fn follows(table: &[CdfEntry], weights: &[f64]) -> Result<(), String> {
    if table.len() != weights.len() {
        return Err(format!("{} entries for {} weights", table.len(), weights.len()));
    }
    let total: f64 = weights.iter().sum();
    let (mut sum, mut before) = (0.0, 0.0);
    for (i, (entry, weight)) in table.iter().zip(weights).enumerate() {
        sum += weight / total;
        let end = f64::from(entry.end);
        if (end - sum).abs() > 0.5001 * STEP {
            return Err(format!("the sum up to {i} is {end:e} instead of {sum:e}"));
        }
        if end < before || (*weight == 0.0 && end != before) {
            return Err(format!("index {i} of weight {weight:e} lies from {before:e} to {end:e}"));
        }
        before = end;
    }
    let last = (before - 1.0).abs();
    if last == 0.0 { Ok(()) } else { Err(format!("the last sum is off by {last:e}")) }
}

/// Whether the search finds what all sums say, at the edges of all entries and buckets.
fn finds(table: &[CdfEntry]) -> Result<(), String> {
    let buckets = 1u32 << table.len().ilog2();
    // Of large tables every so many, the first and the last ones among them.
    let some = |count: usize| (0..count).step_by(1 + count / 300).chain(count.saturating_sub(3)..count);
    let edges = some(table.len()).map(|i| f64::from(table[i].end));
    let begins = some(buckets as usize).map(|bucket| bucket as f64 / f64::from(buckets));
    for edge in edges.chain(begins) {
        for u in [edge - STEP, edge, edge + STEP].into_iter().filter(|u| (0.0..1.0).contains(u)) {
            let ((index, rest), right) = (drawn(table, u), by_hand(table, u));
            if index != right || !(0.0..1.0).contains(&rest) {
                return Err(format!("{u} is {index} with {rest} left, and by hand {right}"));
            }
        }
    }
    Ok(())
}

fn check(name: &str, weights: &[f64]) {
    let table = cdf_table(weights);
    let held = follows(&table, weights).and_then(|()| finds(&table));
    held.unwrap_or_else(|why| panic!("{name}, {} weights: {why}", weights.len()));
}

/// Sizes 1 to 130, and around the powers of two where there are more buckets.
fn sizes() -> impl Iterator<Item = usize> {
    (1..=130).chain([1000, (1 << 16) - 1, 1 << 16, (1 << 16) + 1])
}

#[test]
fn every_size_draws_by_its_weights() {
    for size in sizes() {
        let mut random = SplitMix(size as u64);
        let mut weights = |of: &dyn Fn(f64) -> f64| (0..size).map(|_| of(random.unit())).collect::<Vec<f64>>();
        check("uniform", &vec![3.5; size]);
        check("random", &weights(&|u| u));
        check("twelve orders of magnitude", &weights(&|u| 10f64.powf(12.0 * u - 6.0)));
        check("large", &weights(&|u| 1e300 * u / size as f64));
        check("small", &weights(&|u| 1e-300 * u));
        check("the least numbers", &vec![5e-324; size]);
        let mut half_black = weights(&|u| if u < 0.5 { 0.0 } else { u });
        half_black[size / 2] = 1.0;
        check("half of them zero", &half_black);
        for heavy in [0, size / 3, size - 1] {
            let mut weights = vec![1e-12; size];
            weights[heavy] = 1.0;
            check("one heavy", &weights);
            let mut weights = vec![0.0; size];
            weights[heavy] = 1e-12;
            check("a single one", &weights);
        }
        let mut weights = vec![1.0; size];
        weights[size - 1] = 0.0;
        if size > 1 {
            check("one zero", &weights);
        }
    }
}

#[test]
fn two_entries_draw_by_their_weights() {
    for (a, b) in [(1.0, 1.0), (1.0, 2.0), (1e-12, 1.0), (1.0, 1e-12), (0.0, 1.0), (1.0, 0.0), (1e300, 1.0), (0.1, 0.3)]
    {
        check("two", &[a, b]);
    }
}

#[test]
fn without_weight_there_is_no_table() {
    for weights in [vec![], vec![0.0], vec![0.0; 77], vec![-0.0, 0.0]] {
        assert!(cdf_table(&weights).is_empty(), "{weights:?}");
    }
    // A sum that is no number draws nothing either.
    for weights in [vec![f64::MAX, f64::MAX], vec![f64::NAN, 1.0], vec![f64::INFINITY]] {
        assert!(cdf_table(&weights).is_empty(), "{weights:?}");
    }
}

#[test]
fn planted_errors_are_seen() {
    let weights = [3.0, 1.0, 0.0, 2.0, 5.0];
    let right = cdf_table(&weights);
    follows(&right, &weights).and_then(|()| finds(&right)).unwrap();
    for i in 0..5 {
        let mut wrong = right.clone();
        wrong[i].end -= 2.0 * STEP as f32;
        assert!(follows(&wrong, &weights).is_err(), "a sum up to {i} that is off by two steps passes");
    }
    // The table has four buckets; the last one begins at the last index.
    for bucket in 0..3 {
        let mut wrong = right.clone();
        wrong[bucket].first += 1;
        assert!(finds(&wrong).is_err(), "a bucket {bucket} that begins too late passes");
    }
}

#[test]
fn numbers_in_order_give_draws_in_order() {
    let mut random = SplitMix(3);
    let table = cdf_table(&(0..77).map(|_| random.unit()).collect::<Vec<f64>>());
    let places: Vec<f64> =
        (0..4096).map(|i| drawn(&table, f64::from(i) / 4096.0)).map(|(i, rest)| i as f64 + rest).collect();
    assert!(places.is_sorted(), "an index, and what is left of the number, grow with it");
}

#[test]
fn what_is_left_lies_evenly_about_the_middle() {
    let (start, end) = (0.5, 0.5 + 1024.0 * STEP);
    let (first, last) = (left_over(start, start, end), left_over(end - STEP, start, end));
    assert!((first + last - 1.0).abs() < 1e-12, "{first} and {last}");
    assert!(left_over(1.0 - STEP, 0.0, 1.0) < 1.0);
}
