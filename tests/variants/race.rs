//! Races of simulated estimators: how often the best one is ended, and what is saved.

use lucerna::stats::race::{Lap, Race, even_weights};

use crate::support::dice::Dice;

/// Probability that the best is ended, by default.
const ALPHA: f64 = 1e-3;

/// Rounds of a race, by default.
const ROUNDS: u32 = 64;

/// How a race ended.
struct Ended {
    /// Member 0, the best, left.
    wrong: bool,
    /// Members that left.
    left: usize,
    /// Part of all laps that were not run.
    saved: f64,
}

/// Races until one is left, or all rounds are over. `error` draws the error of a member's film; every film takes about a second.
fn race(dice: &mut Dice, members: usize, alpha: f64, error: &dyn Fn(&mut Dice, usize) -> f64) -> Ended {
    let mut race = Race::new(members, alpha);
    let (mut laps, mut left) = (0, Vec::new());
    for _ in 0..ROUNDS {
        // What slows one film slows all of a round.
        let busy = dice.log_normal(0.1);
        let alive: Vec<usize> = race.alive().collect();
        let mut round = vec![None; members];
        for member in &alive {
            let seconds = busy * dice.log_normal(0.02);
            round[*member] = Some(Lap { error: error(dice, *member), seconds });
        }
        laps += alive.len();
        left.extend(race.add(&round));
        if race.alive().count() <= 1 {
            break;
        }
    }
    let wrong = left.iter().any(|lost| lost.member == 0);
    Ended { wrong, left: left.len(), saved: 1.0 - laps as f64 / (members as f64 * f64::from(ROUNDS)) }
}

/// Of many races: how often the best was ended, members that left of each, and the part of all laps that was saved.
fn many(seed: u64, runs: u32, members: usize, alpha: f64, error: &dyn Fn(&mut Dice, usize) -> f64) -> (u32, f64, f64) {
    let mut dice = Dice(seed);
    let mut sum = (0, 0.0, 0.0);
    for _ in 0..runs {
        let ended = race(&mut dice, members, alpha, error);
        sum = (sum.0 + u32::from(ended.wrong), sum.1 + ended.left as f64, sum.2 + ended.saved);
    }
    (sum.0, sum.1 / f64::from(runs), sum.2 / f64::from(runs))
}

/// One of four is better by 1.5: it is never ended, the others nearly always are, and at least a third of the time is saved.
#[test]
fn the_best_of_four_stays_and_a_third_of_the_time_is_saved() {
    for (seed, sigma) in [(1, 0.1), (2, 0.2), (3, 0.3)] {
        let error = |dice: &mut Dice, member: usize| dice.log_normal(sigma) * if member == 0 { 1.0 } else { 1.5 };
        let (wrong, left, saved) = many(seed, 2000, 4, ALPHA, &error);
        assert_eq!(wrong, 0, "sigma {sigma}");
        assert!(left > 2.9 && saved > 1.0 / 3.0, "sigma {sigma}: {left} left, {saved} saved");
    }
}

/// Whatever the tails are, one of equal members is ended in at most alpha of all races for each that could be: here any of four.
#[test]
fn equal_members_all_stay() {
    for (seed, sigma) in [(4, 0.1), (5, 0.5), (6, 2.0)] {
        let error = |dice: &mut Dice, _: usize| dice.log_normal(sigma);
        let (_, left, saved) = many(seed, 2000, 4, ALPHA, &error);
        assert!(left <= 0.004 && saved < 0.01, "sigma {sigma}: {left} left, {saved} saved");
    }
    // That the bound is not far too cautious shows at a large alpha.
    let (wrong, ..) = many(7, 2000, 4, 0.5, &|dice, _| dice.log_normal(0.5));
    assert!((20..1000).contains(&wrong), "{wrong} of 2000 at an alpha of one half");
}

/// The best has now and then a firefly that is worth ten films; or all others do, who are better in most of their films, but not on the
/// whole.
#[test]
fn fireflies_end_nobody_who_is_the_best() {
    let own = |dice: &mut Dice, member: usize| match member {
        0 => dice.firefly(0.02, 10.0) * dice.log_normal(0.1),
        _ => 1.2 * dice.log_normal(0.2),
    };
    let others = |dice: &mut Dice, member: usize| match member {
        0 => dice.log_normal(0.2),
        _ => 0.8 * dice.log_normal(0.2) + if dice.unit() < 0.3 { 2.0 } else { 0.0 },
    };
    let (wrong, ..) = many(8, 2000, 4, ALPHA, &own);
    assert!(wrong <= 2, "{wrong} of 2000 where the best has fireflies");
    // Fireflies that have not come yet can't be known of: in one race of a hundred there are none before round 13.
    let (wrong, ..) = many(9, 2000, 4, ALPHA, &others);
    assert!(wrong <= 100, "{wrong} of 2000 where the others have fireflies");
}

/// Who leaves is told with by whom, when, and a confidence that is as large as was asked for; the ratio is near the true one.
#[test]
fn who_leaves_is_told_why() {
    let mut dice = Dice(10);
    let mut race = Race::new(2, ALPHA);
    let lost = loop {
        let mut lap = |error: f64| Some(Lap { error: error * dice.log_normal(0.1), seconds: 0.5 });
        let lost = race.add(&[lap(1.0), lap(2.0)]);
        if let [lost] = lost[..] {
            break lost;
        }
        assert!(race.rounds(0) < 60);
    };
    assert_eq!((lost.member, lost.by, lost.rounds), (1, 0, race.rounds(1)));
    assert!(lost.confidence >= 1.0 - ALPHA && lost.confidence < 1.0);
    let ratio = lost.ratio.unwrap();
    assert!(ratio.low < 2.0 && ratio.high > 2.0 && ratio.spread() < 0.3, "{ratio:?}");
    assert_eq!((race.alive().collect::<Vec<_>>(), race.leader()), (vec![0], Some(0)));
    // What it took after it left counts no more.
    race.add(&[None, Some(Lap { error: 0.0, seconds: 1.0 })]);
    assert_eq!(race.rounds(1), lost.rounds);
}

/// Without noise, equal members stay and any difference counts; what is no number is no round.
#[test]
fn members_without_noise() {
    let lap = |error: f64| Some(Lap { error, seconds: 1.0 });
    let mut race = Race::new(3, ALPHA);
    for _ in 0..64 {
        race.add(&[lap(1.0), lap(1.0), lap(1.1)]);
    }
    assert_eq!(race.alive().collect::<Vec<_>>(), [0, 1]);
    race.remove(1);
    race.add(&[lap(f64::NAN), None, None]);
    assert_eq!(race.alive().count(), 1);
    assert!(Race::new(1, ALPHA).add(&[lap(1.0)]).is_empty());
}

#[test]
fn every_block_counts_alike() {
    let weights = even_weights(&[[1.0, 2.0, 4.0]; 4], &[2.0, 0.0], |pixel| pixel / 2);
    assert_eq!(weights[0], [0.5, 1.0, 2.0]);
    assert_eq!(weights[3], [100.0, 200.0, 400.0], "a block without error counts as one of a hundredth");
    assert_eq!(even_weights(&[[1.0; 3]], &[0.0], |_| 0), [[1.0; 3]]);
}
