//! The judge's statistics on simulated numbers: false alarms, power, and how often intervals hold what they should.

use glam::UVec2;
use lucerna::app::judge::{Estimator, Verdict};
use lucerna::stats::blocks::Grid;
use lucerna::stats::efficiency::{Ratio, Trial, pair_error, weights};
use lucerna::stats::equal_means::{LEAST_GROUPS, Means, MeansTest, block_side};
use lucerna::stats::sign_flips::tail_bound;
use lucerna::stats::summary::{upper_quantile, upper_tail};

use crate::support::dice::Dice;

#[test]
fn quantiles_are_where_the_tail_is_what_was_asked_for() {
    for (p, degrees) in [(0.025, 1.0), (0.025, 3.0), (1e-6, 31.0), (0.3, 200.0)] {
        let found = upper_tail(upper_quantile(p, degrees), degrees);
        assert!((found / p - 1.0).abs() < 1e-6, "{found} is not {p}, {degrees} degrees");
    }
}

/// Against all 2^12 signs: never below the probability, and at most 30 times it: Chernoff's bound is off by about sqrt(2 pi) z,
/// and by what two-sidedness and jumps between few sums add.
#[test]
fn the_bound_is_above_the_exact_tail_and_near_it() {
    let mut dice = Dice(1);
    for case in 0..40 {
        let sizes: Vec<f64> =
            (0..12).map(|_| if case % 2 == 0 { dice.normal() } else { dice.log_normal(1.0) }).collect();
        let all =
            |signs: u32| (0..12).map(|i| sizes[i].abs() * if signs >> i & 1 == 1 { 1.0 } else { -1.0 }).sum::<f64>();
        let most = all(u32::MAX);
        for part in [1.0, 0.95, 0.8] {
            let sum = part * most;
            let exact =
                (0..1u32 << 12).filter(|signs| all(*signs).abs() >= sum * (1.0 - 1e-12)).count() as f64 / 4096.0;
            let bound = tail_bound(&sizes, sum);
            assert!(bound >= exact * (1.0 - 1e-6), "{bound} is below {exact}");
            assert!(bound <= 30.0 * exact || exact > 0.02, "{bound} is far above {exact}");
        }
        assert!((tail_bound(&sizes, -most) * 2048.0 - 1.0).abs() < 1e-3, "all signs agree by 2 of 4096 chances");
    }
    // However large one number is, it has one sign, and that proves nothing.
    let mut sizes = vec![1e-3; 64];
    sizes[7] = 1e6;
    assert_eq!(tail_bound(&sizes, 1e6), 1.0);
    assert_eq!((tail_bound(&[], 0.0), tail_bound(&[0.0; 40], 0.0)), (1.0, 1.0));
}

const BLOCKS: usize = 16;

/// 4 x 4 blocks.
fn grid() -> Grid {
    Grid::new(UVec2::splat(32), 8)
}

/// What a look at 32, 64, .. or `pairs` pairs of films finds, if means differ. `draw` gives the mean of a block by the old and by
/// the new estimator.
fn alarm(dice: &mut Dice, pairs: u32, alpha: f64, draw: &dyn Fn(&mut Dice, usize) -> [f64; 2]) -> Option<Means> {
    let mut test = MeansTest::new(grid(), alpha);
    for pair in 1..=pairs {
        let (old, new): (Vec<f64>, Vec<f64>) = (0..BLOCKS).map(|block| draw(dice, block).into()).unzip();
        let grey = |means: &[f64]| means.iter().map(|mean| [*mean; 3]).collect::<Vec<_>>();
        test.add_means(&grey(&old), &grey(&new));
        if pair >= 4 && pair.is_power_of_two() || pair == pairs {
            let means = test.look();
            assert!((means.spent > 0.0) == (pair as usize >= LEAST_GROUPS));
            if means.differ() {
                return Some(means);
            }
        }
    }
    None
}

/// How many runs find means that differ.
fn alarms(seed: u64, runs: u32, pairs: u32, alpha: f64, draw: &dyn Fn(&mut Dice, usize) -> [f64; 2]) -> u32 {
    let mut dice = Dice(seed);
    (0..runs).map(|_| u32::from(alarm(&mut dice, pairs, alpha, draw).is_some())).sum()
}

/// By the default alpha, 3000 runs of equal estimators are to raise at most 3 alarms (Poisson: more than 10 has a probability of 3e-4);
/// since Chernoff's and Holm's are bounds, it is fewer. That they are not far too cautious shows at a large alpha.
#[test]
fn equal_estimators_seldom_raise_an_alarm_whatever_their_tails() {
    for (seed, sigma) in [(2, 0.2), (3, 1.0), (4, 2.5)] {
        let equal = |dice: &mut Dice, _: usize| [dice.log_normal(sigma), dice.log_normal(sigma)];
        let found = alarms(seed, 1000, 100, 1e-3, &equal);
        assert!(found <= 1, "{found} false alarms of 1000 at sigma {sigma}");
    }
    let noisy = |dice: &mut Dice, _: usize| [dice.log_normal(1.0), dice.log_normal(1.0)];
    let found = alarms(5, 1000, 64, 0.5, &noisy);
    assert!((10..500).contains(&found), "{found} false alarms of 1000 at an alpha of one half");
}

/// A fifth or a third of all light comes by rare samples in the old estimator alone: one film in a hundred, or in thirty, has one
/// in a block. Symmetry does not hold then, and some alarms must be; without caution they were a tenth to two thirds of all runs.
#[test]
fn an_estimator_without_fireflies_is_seldom_called_wrong() {
    for (seed, probability, height) in [(6, 0.01, 20.0), (7, 0.03, 10.0), (8, 0.1, 5.0)] {
        let draw = |dice: &mut Dice, _: usize| [dice.firefly(probability, height), 1.0 + 0.05 * dice.normal()];
        let found = alarms(seed, 300, 100, 1e-3, &draw);
        assert!(found <= 9, "{found} of 300 with fireflies of {probability}");
    }
}

/// One percent of bias where a block's mean has 4.2 % of noise between two films, 1.1 % in the whole picture: 7.5 standard errors at
/// 64 films.
#[test]
fn a_bias_of_one_percent_is_found() {
    let draw = |dice: &mut Dice, _: usize| [1.0 + 0.03 * dice.normal(), 1.01 + 0.03 * dice.normal()];
    let found = alarms(9, 200, 64, 1e-3, &draw);
    assert!(found >= 196, "{found} of 200");
}

#[test]
fn a_bias_is_found_where_it_is() {
    let mut dice = Dice(10);
    let draw = |dice: &mut Dice, block: usize| {
        let bias = if block == 6 { 0.9 } else { 1.0 };
        [1.0 + 0.03 * dice.normal(), bias + 0.03 * dice.normal()]
    };
    for _ in 0..50 {
        let means = alarm(&mut dice, 128, 1e-3, &draw).unwrap();
        let places: Vec<UVec2> = means.differing().map(|block| block.min).collect();
        assert_eq!(places, [UVec2::new(16, 8)]);
        assert!((means.differing().next().unwrap().relative + 0.1).abs() < 0.04);
    }
}

/// Without noise, rounding is no difference, and more than rounding is one.
#[test]
fn rounding_is_no_difference() {
    let scaled = |factor: f64| move |_: &mut Dice, _: usize| [0.7, 0.7 * factor];
    assert_eq!(alarms(11, 1, 64, 1e-3, &scaled(1.0 + 1e-6)), 0);
    assert_eq!(alarms(11, 1, 64, 1e-3, &scaled(1.0 + 1e-4)), 1);
    assert_eq!(alarms(11, 1, 64, 1e-3, &|_, _| [0.0, 0.0]), 0);
}

#[test]
fn small_pictures_have_small_blocks() {
    let sides = [(512, 512), (128, 200), (64, 64), (48, 40), (3, 900)].map(|(x, y)| block_side(UVec2::new(x, y)));
    assert_eq!(sides, [16, 16, 8, 5, 4]);
    let film = vec![[1.0f32, 2.0, 3.0]; 7 * 5];
    let mut test = MeansTest::new(Grid::new(UVec2::new(7, 5), 4), 1e-3);
    test.add(&film, &film);
    let whole = test.look().whole;
    assert_eq!((whole.old, whole.channel), (1.0, 0));
}

/// Red and green change places in every block: no mean over channels is another.
#[test]
fn colours_that_change_places_are_found() {
    let mut dice = Dice(14);
    let mut test = MeansTest::new(grid(), 1e-3);
    for _ in 0..64 {
        let mut films = |[r, g]: [f64; 2]| -> Vec<[f64; 3]> {
            (0..BLOCKS).map(|_| [r, g, 0.3].map(|channel| channel * (1.0 + 0.03 * dice.normal()))).collect()
        };
        test.add_means(&films([0.6, 0.4]), &films([0.4, 0.6]));
    }
    let means = test.look();
    assert!(means.whole.differs && means.whole.coloured && means.whole.channel < 2, "{:?}", means.whole);
    assert_eq!(means.differing().count(), BLOCKS);
}

/// What a look says that it would have found, it does find in 19 of 20 runs (of 300; 270 is 3.7 standard deviations below), half of
/// it in few, and twice of it always: of normal noise and of such as has a tail.
#[test]
fn what_would_have_been_found_is_found() {
    for (seed, sigma, pairs) in [(15, 0.1, 32), (16, 0.1, 100), (17, 1.0, 100), (18, 0.5, 300)] {
        let mut dice = Dice(seed);
        let mut look = |bias: f64| {
            let mut test = MeansTest::new(grid(), 1e-3);
            for _ in 0..pairs {
                let mut film = |more: f64| (0..BLOCKS).map(|_| [more + dice.log_normal(sigma); 3]).collect::<Vec<_>>();
                test.add_means(&film(0.0), &film(bias));
            }
            test.look()
        };
        let told: Vec<f64> = (0..20).map(|_| look(0.0).least_found.unwrap()).collect();
        let least = told.iter().sum::<f64>() / told.len() as f64;
        let mut found = |part: f64| (0..300).filter(|_| look(part * least).whole.differs).count();
        let counts = [found(0.5), found(1.0), found(2.0)];
        assert!(
            counts[0] < 150 && counts[1] >= 270 && counts[2] >= 299,
            "{counts:?} of 300, {pairs} pairs, sigma {sigma}"
        );
    }
}

/// Four times the films find half the difference; too few films, and those without light, none.
#[test]
fn what_would_be_found_falls_with_the_root_of_the_films() {
    let look = |pairs: u32, light: f64| {
        let mut dice = Dice(19);
        let mut test = MeansTest::new(grid(), 1e-3);
        for _ in 0..pairs {
            let mut film = || (0..BLOCKS).map(|_| [light * (1.0 + 0.1 * dice.normal()); 3]).collect::<Vec<_>>();
            test.add_means(&film(), &film());
        }
        test.look()
    };
    let [few, many] = [128, 512].map(|pairs| look(pairs, 1.0).least_found.unwrap());
    assert!((1.6..2.4).contains(&(few / many)), "{few} and {many}");
    assert_eq!(look(31, 1.0).least_found, None);
    let dark = look(64, 0.0);
    assert!(dark.least_found.is_none() && dark.black && !dark.differ());
}

/// Whatever the efficiency, it is told only where a difference as small as was wanted would have been found.
#[test]
fn no_efficiency_is_told_of_means_that_are_not_known() {
    let estimators = [Estimator { relmse: 8.0, seconds: 1.0 }, Estimator { relmse: 1.0, seconds: 1.0 }];
    let ratio = Some(Ratio { ratio: 8.0, low: 7.0, high: 9.0 });
    let mut dice = Dice(20);
    for (pairs, bias, noise) in
        [(16, 0.0, 0.1), (64, 0.0, 0.5), (64, 0.0, 0.01), (64, 0.01, 0.5), (64, 0.2, 0.05), (512, 0.0, 0.1)]
    {
        let mut test = MeansTest::new(grid(), 1e-3);
        for _ in 0..pairs {
            let mut film =
                |mean: f64| (0..BLOCKS).map(|_| [mean * (1.0 + noise * dice.normal()); 3]).collect::<Vec<_>>();
            test.add_means(&film(1.0), &film(1.0 + bias));
        }
        let means = test.look();
        for within in [1e-4, 0.005, 0.05, 1.0] {
            let verdict = Verdict::of(&means, within, ratio, estimators);
            let may = !means.differ() && means.least_found.is_some_and(|least| least <= within);
            assert_eq!(matches!(verdict, Verdict::Agree(_)), may, "{verdict:?} within {within} of {:?}", means.whole);
            assert_eq!(matches!(verdict, Verdict::Differ), means.differ());
        }
    }
}

/// Trials of films of `pixels` log-normal pixels: the old one's of `sigma`, the new one's of 0.3, at half the speed.
fn trial(dice: &mut Dice, pixels: usize, sigma: f64) -> Trial {
    let ones = vec![[1.0f32; 3]; pixels];
    let weights = weights(&ones, &ones);
    let mut error = |sigma: f64| {
        let mut film = || (0..pixels).map(|_| [dice.log_normal(sigma) as f32; 3]).collect::<Vec<_>>();
        pair_error(&film(), &film(), &weights)
    };
    let relmse = [error(sigma), error(0.3)];
    Trial { relmse, seconds: [0.01, 0.02].map(|seconds| seconds * (1.0 + 0.05 * dice.normal())) }
}

/// By the variance of log-normal numbers of mean 1.
fn true_ratio(sigma: f64) -> f64 {
    ((sigma * sigma).exp() - 1.0) / ((0.3f64 * 0.3).exp() - 1.0) / 2.0
}

/// Intervals of 95 % hold the ratio in 90 to 99 % of 500 runs: of films of few and of many pixels, of little noise and of a
/// pixel variance twice the squared mean, whose own fourth moment is a hundred times its squared second.
#[test]
fn intervals_hold_the_ratio_as_often_as_they_say() {
    let mut dice = Dice(12);
    for (pixels, sigma) in [(10, 0.3), (100, 0.3), (100, 1.0)] {
        for trials in [2, 4, 16, 64] {
            let runs = 500;
            let holds = |dice: &mut Dice| {
                let list: Vec<Trial> = (0..trials).map(|_| trial(dice, pixels, sigma)).collect();
                let ratio = Ratio::of(&list).unwrap();
                (ratio.low..=ratio.high).contains(&true_ratio(sigma))
            };
            let held = (0..runs).filter(|_| holds(&mut dice)).count() as f64 / f64::from(runs);
            assert!((0.9..=0.99).contains(&held), "{held} for {pixels} pixels, sigma {sigma}, {trials} trials");
        }
    }
}

/// The same if the end is chosen by how narrow the interval is, which favours those that are too narrow.
#[test]
fn intervals_hold_the_ratio_where_narrowness_ended_it() {
    let mut dice = Dice(13);
    let runs = 300;
    let holds = |dice: &mut Dice| {
        let mut list: Vec<Trial> = (0..32).map(|_| trial(dice, 30, 0.5)).collect();
        while list.len() < 128 && Ratio::of(&list).unwrap().spread() > 0.12 {
            let more = (0..list.len()).map(|_| trial(dice, 30, 0.5)).collect::<Vec<_>>();
            list.extend(more);
        }
        let ratio = Ratio::of(&list).unwrap();
        (ratio.low..=ratio.high).contains(&true_ratio(0.5))
    };
    let held = (0..runs).filter(|_| holds(&mut dice)).count() as f64 / f64::from(runs);
    assert!((0.9..=0.99).contains(&held), "{held}");
}

#[test]
fn what_has_no_noise_or_too_few_trials_has_no_ratio() {
    let trial = |relmse: [f64; 2]| Trial { relmse, seconds: [1.0, 2.0] };
    assert_eq!(Ratio::of(&[]), None);
    assert_eq!(Ratio::of(&[trial([1.0, 1.0])]), None);
    assert_eq!(Ratio::of(&[trial([0.0, 0.0]); 4]), None);
    let exact = Ratio::of(&[trial([8.0, 1.0]); 4]).unwrap();
    assert!((exact.ratio - 4.0).abs() < 1e-12 && (exact.high / exact.low - 1.0).abs() < 1e-6, "{exact:?}");
}
