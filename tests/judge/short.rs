//! What the judge says in few words, and its rests.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::UVec2;
use lucerna::app::judge::{Analysis, Estimator, Pause, Verdict};
use lucerna::stats::blocks::Grid;
use lucerna::stats::efficiency::Ratio;
use lucerna::stats::equal_means::{Means, MeansTest, block_side};

use crate::support::dice::Dice;

/// Means of so many pairs of films of a gray picture, the new ones brighter by a factor.
fn means(pairs: u32, factor: f64) -> Means {
    let size = UVec2::splat(8);
    let mut test = MeansTest::new(Grid::new(size, block_side(size)), 1e-3);
    let mut dice = Dice(7);
    for _ in 0..pairs {
        let mut film = |mean: f64| vec![[(mean + 0.01 * dice.normal()) as f32; 3]; 64];
        let (old, new) = (film(1.0), film(factor));
        test.add(&old, &new);
    }
    test.look()
}

fn analysis(means: Means, ratio: Option<Ratio>, within: f64) -> Analysis {
    let estimators = [Estimator { relmse: 1.0, seconds: 1.0 }; 2];
    Analysis {
        films: 64,
        spp: 4,
        size: UVec2::splat(8),
        verdict: Verdict::of(&means, within, ratio, estimators),
        means,
        within,
        bad_samples: [0; 2],
        seconds: [1.0, 1.0],
        ended: None,
    }
}

#[test]
fn verdicts_in_few_words() {
    let better = Some(Ratio { ratio: 1.8, low: 1.7, high: 1.9 });
    let agrees = analysis(means(64, 1.0), better, 0.1);
    let short = agrees.short();
    assert!(short.starts_with("agrees within 0.") && short.ends_with(" %, 1.80x more efficient"), "{short}");
    assert!(agrees.so_far().starts_with("no difference above "), "{}", agrees.so_far());
    let worse = Some(Ratio { ratio: 0.5, low: 0.4, high: 0.6 });
    assert!(analysis(means(64, 1.0), worse, 0.1).short().ends_with(", 2.00x less efficient"));
    assert!(analysis(means(64, 1.0), None, 0.1).short().ends_with(", no noise to compare"));

    let differs = analysis(means(64, 1.12), better, 0.1).short();
    assert!(differs.starts_with("DIFFERS by 12 %"), "{differs}");
    let coarse = analysis(means(64, 1.0), better, 1e-9).short();
    assert!(coarse.starts_with("can't tell: nothing below ") && coarse.ends_with(" would show"), "{coarse}");
    assert_eq!(analysis(means(2, 1.0), None, 0.1).short(), "can't tell: 64 films are too few");
}

#[test]
fn a_rest_lasts_until_it_is_over_and_is_counted() {
    let pause = Arc::new(Pause::default());
    pause.wait();
    assert_eq!(pause.rested(), Duration::ZERO);
    pause.set(true);
    pause.set(true);
    let waiting = std::thread::spawn({
        let pause = pause.clone();
        move || {
            pause.wait();
            Instant::now()
        }
    });
    std::thread::sleep(Duration::from_millis(50));
    assert!(!waiting.is_finished() && pause.rested() >= Duration::from_millis(50));
    let ends = Instant::now();
    pause.set(false);
    assert!(waiting.join().unwrap() >= ends);
    let rested = pause.rested();
    std::thread::sleep(Duration::from_millis(10));
    assert_eq!(pause.rested(), rested, "it runs");
}
