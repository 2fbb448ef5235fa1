//! The fixed-point film: exact sums however they are cut, and bad samples left out.

use glam::{UVec2, Vec3};
use lucerna::cpu::film::{Counted, accumulate, film_mean, fixed_point, half_mean, pixel_mean};
use lucerna::cpu::rng::{sample_1d, sample_key};
use lucerna::gpu::Runtime;
use lucerna::layout::film::{
    BAD_LOG, BadSample, FULL_SUM, FilmCounters, FilmHalf, FilmPixel, MOST_SAMPLES, UNKNOWN_BOUNCE, film_exponent,
    largest_sample,
};
use lucerna::layout::trace::{
    BAD_INFINITE, BAD_NAN, BAD_NEGATIVE, BAD_OVERFLOW, NO_MATERIAL, RadianceSample, SAMPLE_BAD, TraceParams,
};
use lucerna::passes::Recording;
use lucerna::passes::film;
use lucerna::passes::lattice::Lattice;
use lucerna::stress::tools::sums;

use crate::support;

/// A window of `width` x `height` somewhere in a larger film.
fn window(width: u32, height: u32) -> TraceParams {
    TraceParams {
        film_width: 1000,
        window_x: 30,
        window_y: 7,
        window_width: width,
        window_height: height,
        ..TraceParams::default()
    }
}

fn pixels(params: &TraceParams) -> u32 {
    params.window_width * params.window_height
}

/// An empty film for the window.
fn reset(rig: &mut Runtime, params: &TraceParams) {
    sums::reset(rig, params).unwrap();
}

/// Adds samples, as many layers as there are.
fn add(rig: &mut Runtime, params: &TraceParams, first_sample: u32, samples: &[RadianceSample], exponent: i32) {
    sums::add(rig, params, first_sample, samples, exponent).unwrap();
}

fn read(rig: &Runtime, params: &TraceParams) -> (Vec<FilmPixel>, FilmCounters) {
    sums::read(rig, params).unwrap()
}

fn twin(params: &TraceParams, samples: &[RadianceSample], exponent: i32) -> (Vec<FilmPixel>, Counted) {
    let mut film = vec![FilmPixel::default(); pixels(params) as usize];
    let batch = TraceParams { layers: samples.len() as u32 / pixels(params), ..*params };
    let params = film::accumulate_params(&batch, exponent, params);
    let counted = accumulate(&mut film, samples, &params);
    (film, counted)
}

fn grey(value: f32) -> RadianceSample {
    RadianceSample { rgb: Vec3::splat(value), info: 1 }
}

/// A number that depends on `i` and `slot` alone.
fn random(i: usize, slot: u32) -> f64 {
    sample_1d(sample_key(i as u32, 0, 42), slot)
}

/// Samples of all magnitudes, one in `one_bad_in` wrong in some way.
fn samples(count: usize, one_bad_in: f64) -> Vec<RadianceSample> {
    let value = |i: usize, slot: u32| (random(i, slot) * 40.0 - 30.0).exp2() as f32;
    let good = |i| RadianceSample {
        rgb: Vec3::new(value(i, 0), value(i, 1), if random(i, 2) < 0.1 { 0.0 } else { value(i, 2) }),
        info: (random(i, 3) * 50.0) as u32,
    };
    (0..count)
        .map(|i| {
            let mut sample = good(i);
            let pick = random(i, 4) * one_bad_in;
            match (pick * 5.0) as u32 {
                _ if pick >= 1.0 => {}
                0 => sample.rgb.x = f32::NAN,
                1 => sample.rgb.y = f32::NEG_INFINITY,
                2 => sample.rgb.z = -1e-30,
                3 => sample.rgb.x = 3e38,
                _ => {
                    sample.rgb = Vec3::new(f32::from(BAD_NAN as u8), 3.0, 5.0);
                    sample.info |= SAMPLE_BAD;
                }
            }
            sample
        })
        .collect()
}

fn sorted(mut log: Vec<BadSample>) -> Vec<BadSample> {
    log.sort_by_key(|bad| (bad.pixel, bad.sample));
    log
}

fn rays(counters: &FilmCounters) -> u64 {
    u64::from(counters.rays_hi.0) << 32 | u64::from(counters.rays_lo.0)
}

#[test]
fn every_size_equals_the_twin() {
    let mut rig = support::rig();
    for (width, height) in [(1, 1), (3, 5), (9, 7), (64, 1), (5, 13), (50, 20), (64, 64)] {
        let params = window(width, height);
        let samples = samples((width * height * 7) as usize, 20.0);
        reset(&mut rig, &params);
        add(&mut rig, &params, 0, &samples, 40);
        let (film, counters) = read(&rig, &params);
        let (right, counted) = twin(&params, &samples, 40);
        assert!(film == right, "the film of {width} x {height} differs from its twin");
        assert_eq!(rays(&counters), counted.rays);
        assert_eq!(counters.bad.0 as usize, counted.bad.len());
        let logged = &counters.log[..counted.bad.len().min(BAD_LOG as usize)];
        // Which of more than 64 get into the log is open; each that does must be right.
        match counted.bad.len() <= BAD_LOG as usize {
            true => assert_eq!(sorted(logged.to_vec()), sorted(counted.bad)),
            false => assert!(logged.iter().all(|bad| counted.bad.contains(bad))),
        }
    }
}

#[test]
fn no_cut_changes_a_bit() {
    let params = window(13, 5);
    let all = samples(13 * 5 * 24, 50.0);
    let mut rig = support::rig();
    let mut films = Vec::new();
    for cuts in [vec![24], vec![1; 24], vec![5, 1, 10, 8], vec![23, 1]] {
        reset(&mut rig, &params);
        let mut first = 0;
        for layers in cuts {
            let part = &all[(first * pixels(&params)) as usize..][..(layers * pixels(&params)) as usize];
            add(&mut rig, &params, first, part, 40);
            first += layers;
        }
        films.push(read(&rig, &params));
    }
    for (film, counters) in &films {
        assert!(film == &films[0].0, "a cut changed the film");
        assert_eq!(rays(counters), rays(&films[0].1));
    }
}

#[test]
fn a_batch_of_some_pixels_equals_the_twin_and_touches_no_other() {
    let mut rig = support::rig();
    let whole = TraceParams { window_x: 5, window_y: 3, film_width: 70, ..window(50, 20) };
    for (first, shift) in [((0, 0), (3, 2)), ((4, 0), (3, 3)), ((49, 19), (0, 1)), ((1, 7), (1, 0))] {
        let lattice = Lattice { first: first.into(), shift: shift.into() };
        let size = lattice.size(UVec2::new(50, 20));
        let batch = TraceParams {
            window_x: whole.window_x + lattice.first.x,
            window_y: whole.window_y + lattice.first.y,
            window_width: size.x,
            window_height: size.y,
            column_shift: lattice.shift.x,
            row_shift: lattice.shift.y,
            layers: 3,
            ..whole
        };
        let samples = samples((pixels(&batch) * 3) as usize, 20.0);
        reset(&mut rig, &whole);
        rig.upload("radiance", &samples).unwrap();
        let mut recording = Recording::default();
        film::record_accumulate(&mut recording, &film::accumulate_params(&batch, 40, &whole));
        rig.play(&recording).unwrap();
        let (film, counters) = read(&rig, &whole);
        let mut right = vec![FilmPixel::default(); pixels(&whole) as usize];
        let counted = accumulate(&mut right, &samples, &film::accumulate_params(&batch, 40, &whole));
        assert!(film == right, "{lattice:?}");
        assert_eq!(rays(&counters), counted.rays);
        assert!(counted.bad.len() <= BAD_LOG as usize);
        assert_eq!(sorted(counters.log[..counted.bad.len()].to_vec()), sorted(counted.bad));
        for (at, pixel) in (0u32..).map(|i| UVec2::new(i % 50, i / 50)).zip(&film) {
            let on_it = at.cmpge(lattice.first).all()
                && (((at - lattice.first) >> lattice.shift) << lattice.shift) + lattice.first == at;
            let count: u32 = pixel.halves.iter().map(|half| half.count + half.bad).sum();
            assert_eq!(count, if on_it { 3 } else { 0 }, "{at} of {lattice:?}");
        }
    }
}

#[test]
fn fixed_point_is_exact_for_every_exponent() {
    // Every binade, denormals too, at the ends of the range of exponents; the film is one pixel a value.
    let mut values: Vec<f32> = (0..255u32)
        .flat_map(|e| [0, 1, 0x40_0000, 0x7f_ffff, 0x2a_aaab].map(|m| f32::from_bits(e << 23 | m)))
        .collect();
    values.push(-0.0);
    let params = window(values.len() as u32, 1);
    let samples: Vec<_> = values.iter().map(|&v| grey(v)).collect();
    let mut rig = support::rig();
    for exponent in [-70, 0, 17, 40, 110] {
        reset(&mut rig, &params);
        add(&mut rig, &params, 0, &samples, exponent);
        let (film, _) = read(&rig, &params);
        for (pixel, value) in film.iter().zip(&values) {
            let half = &pixel.halves[0];
            let sum = u64::from(half.sum[0].y) << 32 | u64::from(half.sum[0].x);
            match fixed_point(*value, exponent) {
                Some(right) => assert_eq!((sum, half.count, half.bad), (right, 1, 0), "{value:e} * 2^{exponent}"),
                None => assert_eq!((sum, half.count, half.bad), (0, 0, 1), "{value:e} * 2^{exponent}"),
            }
        }
    }
}

#[test]
fn the_exponent_fits_the_scene() {
    for emission in [1e-6f32, 0.1, 1.0, 10.0, 1023.0, 1e20] {
        let scaled = fixed_point(emission, film_exponent(emission)).unwrap();
        assert!((1 << 40..1 << 41).contains(&scaled), "{emission} becomes {scaled}");
        let largest = largest_sample(film_exponent(emission));
        assert_eq!(fixed_point(largest, film_exponent(emission)), None);
        assert!(fixed_point(largest.next_down(), film_exponent(emission)).is_some());
    }
    assert_eq!(film_exponent(0.0), film_exponent(1.0));
}

#[test]
fn bad_samples_are_counted_logged_and_left_out() {
    let params = window(2, 2);
    let mut batch = vec![grey(0.5); 4 * 6];
    // Layer 1 of pixel 3, layer 2 of pixel 0, and so on.
    let planted = [(1, 3, f32::NAN, BAD_NAN), (2, 0, f32::INFINITY, BAD_INFINITE), (3, 1, -1.0, BAD_NEGATIVE)];
    for (layer, pixel, value, _) in planted {
        batch[layer * 4 + pixel].rgb.y = value;
    }
    batch[4 * 4 + 2] = RadianceSample { rgb: Vec3::new(f32::from(BAD_OVERFLOW as u8), 6.0, 9.0), info: 7 | SAMPLE_BAD };
    let mut rig = support::rig();
    reset(&mut rig, &params);
    add(&mut rig, &params, 10, &batch, 40);
    let (film, counters) = read(&rig, &params);
    assert_eq!(counters.bad.0, 4);
    assert_eq!(rays(&counters), 23 + 7);
    let place = |pixel: usize| (7 + pixel as u32 / 2) * 1000 + 30 + pixel as u32 % 2;
    let mut right: Vec<_> = planted
        .map(|(layer, pixel, _, kind)| BadSample {
            pixel: place(pixel),
            sample: 10 + layer as u32,
            bounce: UNKNOWN_BOUNCE,
            material: NO_MATERIAL,
            kind,
        })
        .to_vec();
    right.push(BadSample { pixel: place(2), sample: 14, bounce: 6, material: 9, kind: BAD_OVERFLOW });
    assert_eq!(sorted(counters.log[..4].to_vec()), sorted(right));
    for (pixel, at) in film.iter().zip(0..) {
        let odd = u32::from([3, 1].contains(&at));
        assert_eq!(pixel.halves.map(|half| half.bad), [1 - odd, odd]);
        assert_eq!(pixel.halves.map(|half| half.count), [2 + odd, 3 - odd]);
        assert_eq!(pixel_mean(pixel, 40), ([0.5; 3], 5));
    }
}

#[test]
fn a_full_half_takes_no_more() {
    let params = window(1, 1);
    let mut rig = support::rig();
    reset(&mut rig, &params);
    let just = UVec2::new(u32::MAX, FULL_SUM - 1);
    let almost = FilmHalf { sum: [UVec2::ZERO, just, UVec2::ZERO], count: 9, bad: 0 };
    rig.write("film", 0, &[FilmPixel { halves: [almost; 2] }]).unwrap();
    // The even half gets one that is dark where it is almost full; the odd one is full with its first, and gets a dark one then.
    let batch =
        [RadianceSample { rgb: Vec3::X, info: 1 }, grey(1.0), grey(1.0), RadianceSample { rgb: Vec3::X, info: 1 }];
    add(&mut rig, &params, 0, &batch[..2], 0);
    let (film, counters) = read(&rig, &params);
    assert_eq!(film[0].halves[0], FilmHalf { sum: [UVec2::X, just, UVec2::ZERO], count: 10, bad: 0 });
    let full = FilmHalf { sum: [UVec2::X, UVec2::new(0, FULL_SUM), UVec2::X], count: 10, bad: 0 };
    assert_eq!(film[0].halves[1], full);
    assert_eq!((counters.bad.0, counters.full.0, rays(&counters)), (0, 1, 2));
    add(&mut rig, &params, 2, &batch[2..], 0);
    let (film, counters) = read(&rig, &params);
    assert_eq!(film[0].halves[1], full, "neither bright samples nor dark ones");
    assert_eq!((film[0].halves[0].count, counters.bad.0, counters.full.0, rays(&counters)), (11, 0, 2, 4));
}

#[test]
fn a_film_that_is_full_keeps_its_mean() {
    // As bright as a sample may be, and black, by turns in each half: a half is full with its 256th bright one.
    let bright = largest_sample(40).next_down();
    let samples: Vec<_> = (0..2000).map(|i| grey(if i & 2 == 0 { bright } else { 0.0 })).collect();
    let params = window(1, 1);
    let mut rig = support::rig();
    let (right, counted) = twin(&params, &samples, 40);
    assert_eq!((counted.full, counted.bad.len()), (2, 0));
    for cuts in [vec![2000], vec![3, 997, 1, 999]] {
        reset(&mut rig, &params);
        let mut first = 0;
        for layers in cuts {
            add(&mut rig, &params, first as u32, &samples[first..first + layers], 40);
            first += layers;
        }
        let (film, counters) = read(&rig, &params);
        assert!(film == right, "a film that is full differs from its twin");
        assert_eq!((counters.bad.0, counters.full.0), (0, 2));
    }
    let (mean, count) = pixel_mean(&right[0], 40);
    assert!((mean[0] / f64::from(bright) - 0.5).abs() < 1.0 / f64::from(count), "{count} samples: {}", mean[0]);
}

#[test]
fn as_many_samples_fit_as_are_promised() {
    // Each just below twice the least that the largest emission becomes; all but the last of them added beforehand.
    let params = window(1, 1);
    let mut rig = support::rig();
    reset(&mut rig, &params);
    let value = 2f32.next_down();
    let before = u64::from(MOST_SAMPLES / 2 - 1);
    let sum = before * fixed_point(value, film_exponent(value)).unwrap();
    let half = FilmHalf { sum: [UVec2::new(sum as u32, (sum >> 32) as u32); 3], count: before as u32, bad: 0 };
    rig.write("film", 0, &[FilmPixel { halves: [half; 2] }]).unwrap();
    add(&mut rig, &params, 0, &[grey(value); 2], film_exponent(value));
    let (film, counters) = read(&rig, &params);
    assert_eq!((pixel_mean(&film[0], film_exponent(value)).1, counters.bad.0), (MOST_SAMPLES, 0));
}

#[test]
fn rays_are_counted_beyond_32_bits() {
    let params = window(1, 1);
    let mut rig = support::rig();
    reset(&mut rig, &params);
    for i in 0..5 {
        let many = RadianceSample { rgb: Vec3::ONE, info: 0x7fff_ffff };
        add(&mut rig, &params, i, &[many], 40);
    }
    assert_eq!(rays(&read(&rig, &params).1), 5 * 0x7fff_ffff);
}

#[test]
fn means_come_from_the_halves() {
    let exponent = 40;
    let params = window(64, 64);
    // A uniform number around 1.
    let batch: Vec<_> = (0..64 * 64 * 8)
        .map(|i| RadianceSample { rgb: Vec3::from_array([0, 1, 2].map(|c| 0.5 + random(i, c) as f32)), info: 1 })
        .collect();
    let (film, _) = twin(&params, &batch, exponent);
    assert!(film_mean(&film, exponent).iter().all(|m| (m - 1.0).abs() < 0.01));
    let ([even, odd], whole) = (film[0].halves.map(|half| half_mean(&half, exponent)), pixel_mean(&film[0], exponent));
    assert_eq!((even.1, odd.1, whole.1), (4, 4, 8));
    assert!((whole.0[0] - 0.5 * (even.0[0] + odd.0[0])).abs() < 1e-12);
    assert_eq!(film_mean(&[FilmPixel::default()], exponent), [0.0; 3]);
}
