//! A film that is traced until its error is small enough: it is, however often was looked, and few samples are wasted.

use lucerna::parallel;
use lucerna::stats::looks::{FIRST_LOOK, next_look};

use super::model::{Model, Tail};

const RUNS: usize = 200;

/// Samples at which a model film is good enough by its own bound, its true error there, and how often it was looked at.
fn run(tail: Tail, seed: u64, wanted: f64) -> (u32, f64, u32) {
    let mut model = Model::new(tail, seed);
    let (mut spp, mut looks) = (FIRST_LOOK, 0);
    loop {
        model.trace(spp);
        looks += 1;
        let bound = model.told().bound;
        if bound <= wanted {
            return (spp, model.true_error(), looks);
        }
        spp = next_look(spp, bound / wanted);
    }
}

#[test]
fn a_film_that_stops_by_its_bound_is_good_enough_in_19_of_20_runs() {
    // How many samples more than needed, in the median. The bound is that of 9,216 pixels here, or of 576 tiles, and comes closer with more.
    for (tail, wanted, most) in [(Tail::Light, 0.005, 1.15), (Tail::Shared, 0.002, 1.2), (Tail::Heavy, 0.15, 1.15)] {
        let runs = parallel::map(RUNS, |seed| run(tail, seed as u64, wanted));
        let above = runs.iter().filter(|(_, error, _)| *error > wanted).count();
        let needed = Model::new(tail, 0).error_of_one() / wanted;
        let mut spp: Vec<u32> = runs.iter().map(|(spp, ..)| *spp).collect();
        spp.sort_unstable();
        let spent = f64::from(spp[RUNS / 2]) / needed;
        let looks = runs.iter().map(|(_, _, looks)| f64::from(*looks)).sum::<f64>() / RUNS as f64;
        println!("{tail:?}: {above} of {RUNS} above, {spent:.2} of {needed:.0} samples, {looks:.1} looks");
        assert!(above <= RUNS / 20, "{tail:?}: {above} of {RUNS} above {wanted}");
        assert!((1.0..most).contains(&spent), "{tail:?}: {spent} of the samples that are needed");
    }
}

#[test]
fn looks_are_even_numbers_of_samples_at_most_twice_as_many_as_before() {
    for times in [1.0 + 1e-9, 1.05, 1.5, 3.0, 1e6] {
        let mut spp = FIRST_LOOK;
        while spp < 100_000 {
            let next = next_look(spp, times);
            assert!(next > spp && next <= 2 * spp && next.is_multiple_of(2), "{next} after {spp}, {times} times");
            // Where hardly more is needed, hardly more is traced.
            assert!(times > 1.1 || f64::from(next) <= 1.0625 * f64::from(spp) + 2.0, "{next} after {spp}");
            spp = next;
        }
    }
    assert_eq!([16, 32, 64].map(|spp| next_look(spp, 1e3)), [32, 64, 128], "powers of two, where that is far away");
}
