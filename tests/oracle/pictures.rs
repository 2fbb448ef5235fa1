//! Pictures: the same with any number of threads, and as uncertain as they say.

use lucerna::oracle::Picture;

use crate::statistics::BATCHES;
use crate::support::stage::{Stage, sky_map};

use super::{SMALL, batch, glass, rough, shiny};

#[test]
fn threads_do_not_change_a_bit() {
    let mut stage = Stage::room(SMALL, [glass(), rough()]);
    stage.sky(sky_map());
    let oracle = stage.oracle();
    let one = oracle.render(0..8, 5, 1, &|_, _| ());
    let rows = std::sync::Mutex::new(Vec::new());
    let two = oracle.render(0..8, 5, 2, &|done, all| rows.lock().unwrap().push((done, all)));
    assert_eq!(one, two);
    let mut rows = rows.into_inner().unwrap();
    rows.sort();
    assert_eq!(rows, (1..=8).map(|done| (done, 8)).collect::<Vec<_>>());
    assert_ne!(one, oracle.render(0..8, 6, 1, &|_, _| ()), "another seed");
}

#[test]
fn the_stated_error_is_that_of_the_mean() {
    let mut stage = Stage::room(SMALL, [shiny(), rough()]);
    stage.sky(sky_map());
    let oracle = stage.oracle();
    let batches: Vec<Picture> = (0..BATCHES).map(|i| batch(&oracle, i, 16, 1)).collect();
    let (mut stated, mut seen) = (0.0, 0.0);
    for pixel in 0..batches[0].mean.len() {
        let mean = batches.iter().map(|b| b.mean[pixel].y).sum::<f64>() / BATCHES as f64;
        seen += batches.iter().map(|b| (b.mean[pixel].y - mean).powi(2)).sum::<f64>() / (BATCHES as f64 - 1.0);
        stated += batches.iter().map(|b| b.error[pixel].y.powi(2)).sum::<f64>() / BATCHES as f64;
    }
    // 128 pixels of 32 batches: the ratio of both is known to a few percent.
    assert!((stated / seen - 1.0).abs() < 0.2, "variance {stated} stated, {seen} seen");
}
