//! Alias tables: what they draw is what their weights say, exactly.

use lucerna::cpu::alias::alias_pick;
use lucerna::layout::alias::AliasColumn;
use lucerna::prepare::alias::alias_table;
use lucerna::scene::generate::SplitMix;

/// The probability of each index, as the table says: of its own column, and of those it is the alias of.
fn chances(table: &[AliasColumn]) -> Vec<f64> {
    let mut chances = vec![0.0; table.len()];
    for (i, column) in table.iter().enumerate() {
        let own = f64::from(column.threshold);
        assert!((0.0..=1.0).contains(&own), "column {i}: a threshold of {own}");
        chances[i] += own / table.len() as f64;
        if own < 1.0 {
            assert!((column.other as usize) < table.len(), "column {i}: index {} is out of range", column.other);
            chances[column.other as usize] += (1.0 - own) / table.len() as f64;
        }
    }
    chances
}

/// Whether a table draws by its weights, to 1e-6 of each probability.
///
/// Below a column's rounding in f64, which all columns that lean on one heavy index add up in, no probability can be told from
/// others; what weighs nothing is never drawn.
fn follows(table: &[AliasColumn], weights: &[f64]) -> Result<(), String> {
    if table.len() != weights.len() {
        return Err(format!("{} columns for {} weights", table.len(), weights.len()));
    }
    let total: f64 = weights.iter().sum();
    for (i, (got, weight)) in chances(table).iter().zip(weights).enumerate() {
        let right = weight / total;
        if *weight == 0.0 && *got != 0.0 {
            return Err(format!("index {i} of weight 0 is drawn with {got:e}"));
        }
        if (got - right).abs() > 1e-6 * right + f64::EPSILON {
            return Err(format!("index {i}: {got:e} instead of {right:e}"));
        }
    }
    Ok(())
}

fn check(name: &str, weights: &[f64]) {
    follows(&alias_table(weights), weights).unwrap_or_else(|why| panic!("{name}, {} weights: {why}", weights.len()));
}

/// Sizes 1 to 130, and around the powers of two where a column's number gets another bit.
fn sizes() -> impl Iterator<Item = usize> {
    (1..=130).chain([1000, (1 << 16) - 1, 1 << 16, (1 << 16) + 1])
}

#[test]
fn every_size_draws_by_its_weights() {
    for size in sizes() {
        let mut random = SplitMix(size as u64);
        let mut drawn = |of: &dyn Fn(f64) -> f64| (0..size).map(|_| of(random.unit())).collect::<Vec<f64>>();
        check("uniform", &vec![3.5; size]);
        check("random", &drawn(&|u| u));
        check("twelve orders of magnitude", &drawn(&|u| 10f64.powf(12.0 * u - 6.0)));
        check("large", &drawn(&|u| 1e300 * u / size as f64));
        check("small", &drawn(&|u| 1e-300 * u));
        check("the least numbers", &vec![5e-324; size]);
        let mut half_black = drawn(&|u| if u < 0.5 { 0.0 } else { u });
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
        assert!(alias_table(&weights).is_empty(), "{weights:?}");
    }
    // A sum that is no number draws nothing either.
    for weights in [vec![f64::MAX, f64::MAX], vec![f64::NAN, 1.0], vec![f64::INFINITY]] {
        assert!(alias_table(&weights).is_empty(), "{weights:?}");
    }
}

#[test]
fn planted_errors_are_seen() {
    let weights = [3.0, 1.0, 0.0, 2.0, 5.0];
    let right = alias_table(&weights);
    follows(&right, &weights).unwrap();
    for (i, column) in right.iter().enumerate().filter(|(_, column)| column.threshold < 1.0) {
        let mut wrong = right.clone();
        wrong[i].threshold += 4e-6;
        assert!(follows(&wrong, &weights).is_err(), "column {i}: a threshold off by 4e-6 passes");
        wrong[i] = AliasColumn { other: (column.other + 1) % 5, ..*column };
        assert!(follows(&wrong, &weights).is_err(), "column {i}: another alias passes");
    }
}

#[test]
fn uniform_numbers_stay_in_the_table() {
    let step = 2f64.powi(-24);
    for size in sizes().chain([1 << 24]) {
        for u in [0.0, step, 0.5 - step, 0.5, 1.0 - 2.0 * step, 1.0 - step] {
            let (column, rest) = alias_pick(u, size);
            assert!(column < size && (0.0..=1.0).contains(&rest), "{u} of {size}: {column}, {rest}");
        }
    }
    // The numbers of a column lie evenly about its middle.
    let (first, last) = (alias_pick(0.5, 1 << 14).1, alias_pick(0.5 + 1023.0 * step, 1 << 14).1);
    assert!((first + last - 1.0).abs() < 1e-12, "{first} and {last}");
}
