//! Adaptive films: the same however they were cut, watched or come by, and each half of a pixel that of a plain film with as many samples.

use std::collections::BTreeSet;
use std::time::Duration;

use glam::UVec2;
use lucerna::FilmImage;
use lucerna::components::{Adaptive, Camera, Crop, Film, Render, Reuse};
use lucerna::cpu::display::display;
use lucerna::cpu::film::{Joined, joined_mean};
use lucerna::engine::TileCounts;
use lucerna::layout::film::FilmPixel;
use lucerna::passes::lattice::Lattice;
use lucerna::scene::SceneDescription;
use lucerna::systems::resources::{Displayed, Shot};

use super::{LONG, describe, finish, open, plain, trace};

/// A step of the smallest batch, once the governor has learnt what one takes.
const SHORT: Duration = Duration::from_nanos(1);

/// Holds every half of every pixel to plain films. Returns how many numbers of samples there are.
fn held_to_plain(description: &SceneDescription, film: &FilmImage) -> usize {
    let counts: BTreeSet<u32> =
        film.pixels.iter().flat_map(|pixel| pixel.halves.map(|half| half.count + half.bad)).collect();
    let mut engine = open(&plain(description));
    for count in &counts {
        let other = trace(&mut engine, |render| render.spp = 2 * count);
        for (pixel, right) in film.pixels.iter().zip(&other.pixels) {
            for half in 0..2 {
                let has = pixel.halves[half].count + pixel.halves[half].bad == *count;
                assert!(!has || pixel.halves[half] == right.halves[half], "{count} samples of half {half}");
            }
        }
    }
    counts.len()
}

#[test]
fn a_half_of_a_pixel_is_that_of_a_plain_film_with_as_many_samples() {
    let crop = "(3, 40, 5, 23)";
    for (name, defines) in [
        ("cornell-box", &[][..]),
        ("teapot", &[("render.sampler", "Pcg"), ("film.crop", crop)]),
        ("cornell-box", &[("render.reuse", "Tiles"), ("film.crop", crop)]),
        ("teapot", &[("render.reuse", "Tiles")]),
    ] {
        let description = describe(name, &[&[("render.spp", "41")], defines].concat());
        let film = finish(&mut open(&description), LONG);
        let different = held_to_plain(&description, &film);
        assert!(different > 8, "{name}, {defines:?}: {different} numbers of samples");
    }
}

#[test]
fn a_film_does_not_depend_on_how_its_samples_were_cut() {
    for (name, reuse) in [("cornell-box", "Off"), ("teapot", "Tiles")] {
        let with =
            |spp: &str| describe(name, &[("render.spp", spp), ("render.reuse", reuse), ("film.size", "(24,20)")]);
        let mut engine = open(&with("35"));
        let right = finish(&mut engine, LONG);
        let counted = engine.report().unwrap();
        let mut engine = open(&with("35"));
        assert!(finish(&mut engine, SHORT).pixels == right.pixels, "{name}: by the least batches");
        let again = engine.report().unwrap();
        assert_eq!((again.rays, again.samples, again.tiles), (counted.rays, counted.samples, counted.tiles));
        let held: u64 =
            right.pixels.iter().flat_map(|pixel| pixel.halves.map(|half| u64::from(half.count + half.bad))).sum();
        assert_eq!(counted.samples, held, "{name}");
        let mut engine = open(&with("3"));
        for spp in [3, 8, 9, 16, 17, 28, 35] {
            trace(&mut engine, |render| render.spp = spp);
        }
        assert!(engine.film().unwrap().pixels == right.pixels, "{name}: resumed");
        let fewer = trace(&mut engine, |render| render.spp = 20);
        assert!(fewer.pixels == finish(&mut open(&with("20")), LONG).pixels, "{name}: fewer");
        assert!(right.pixels != finish(&mut open(&plain(&with("35"))), LONG).pixels, "{name}: it is not adaptive");
    }
}

/// Over the end of a round, where more of a half is heeded.
#[test]
fn a_film_that_goes_on_through_rounds_is_that_which_was_to_go_there_at_once() {
    let with = |spp: &str| describe("cornell-box", &[("render.spp", spp), ("film.size", "(24,16)")]);
    let right = finish(&mut open(&with("600")), LONG).pixels;
    let mut engine = open(&with("255"));
    finish(&mut engine, LONG);
    for spp in [256, 257, 512, 600] {
        trace(&mut engine, |render| render.spp = spp);
    }
    assert!(engine.film().unwrap().pixels == right);
}

#[test]
fn who_watches_gets_the_same_film_and_exposes_it_as_he_likes() {
    for reuse in ["Off", "Tiles"] {
        let description =
            describe("cornell-box", &[("film.size", "(90,70)"), ("render.spp", "19"), ("render.reuse", reuse)]);
        let right = finish(&mut open(&description), LONG);
        let mut engine = open(&description);
        engine.set_live(true);
        let mut steps = 0;
        while !engine.step(Duration::from_millis(5)).unwrap().finished {
            steps += 1;
            if steps % 5 == 0 {
                engine.edit(|world| {
                    world.query::<&mut Film>().iter_mut(world).for_each(|mut film| film.exposure += 0.25)
                });
            }
        }
        let film = engine.film().unwrap();
        assert!(film.pixels == right.pixels, "reuse {reuse}, after {steps} steps");
        engine.edit(|world| {
            world.query::<&mut Film>().iter_mut(world).for_each(|mut film| film.exposure = description.film.exposure)
        });
        engine.step(LONG).unwrap();
        assert_eq!(engine.picture().unwrap().unwrap(), right.picture);
    }
}

#[test]
fn edits_end_where_a_fresh_engine_begins() {
    let mut engine = open(&describe("cornell-box", &[("render.spp", "21")]));
    for round in 0..6 {
        for _ in 0..2 * round {
            engine.step(Duration::from_millis(5)).unwrap();
        }
        engine.edit(|world| {
            world.query::<&mut Camera>().iter_mut(world).for_each(|mut camera| camera.position.x += 0.1);
            for mut render in world.query::<&mut Render>().iter_mut(world) {
                render.reuse = if round % 2 == 1 { Reuse::Off } else { Reuse::Tiles };
                render.adaptive = if round % 3 == 1 { Adaptive::Off } else { Adaptive::On };
            }
            let crop = Crop { min: UVec2::new(round, 3), max: UVec2::new(40 - round, 25) };
            world.query::<&mut Film>().iter_mut(world).for_each(|mut film| film.crop = (round != 4).then_some(crop));
        });
    }
    let fresh = open(&engine.describe("edited"));
    let [edited, fresh] = [engine, fresh].map(|mut engine| finish(&mut engine, LONG));
    assert!(edited.pixels == fresh.pixels && edited.picture == fresh.picture);
}

#[test]
fn a_film_is_the_mean_of_its_halves_and_tells_so() {
    let description = describe("teapot", &[("render.spp", "40")]);
    let mut engine = open(&description);
    let film = finish(&mut engine, LONG);
    let exponent = engine.read(|world| world.resource::<Shot>().exponent);
    let uneven = |pixel: &&FilmPixel| pixel.halves[0].count != pixel.halves[1].count;
    assert!(film.pixels.iter().filter(uneven).count() > 100);
    for (i, pixel) in film.pixels.iter().enumerate() {
        let mean = joined_mean(pixel, exponent, Joined::ByHalves).0;
        assert_eq!(film.rgb[i], mean.map(|channel| channel as f32));
        for c in 0..3 {
            let halves = 0.5 * (film.halves[0][i][c] + film.halves[1][i][c]);
            assert!((film.rgb[i][c] - halves).abs() <= 1e-6 * halves, "{i}");
        }
    }
    let shown = engine.read(|world| {
        let look = world.resource::<Displayed>().0;
        display(&film.pixels, &world.resource::<Shot>().display_params(Lattice::default(), look))
    });
    let off = |(got, right): (&[u8; 4], &u32)| (0..3).map(|c| got[c].abs_diff((right >> (8 * c)) as u8)).max();
    assert!(film.picture.iter().zip(&shown).filter_map(off).max() <= Some(1), "the picture is the twin's");
    assert_eq!(engine.radiance().unwrap(), film.rgb);
    assert_eq!(engine.film_error().unwrap(), film.error);
    let seen = engine.inspect(UVec2::new(20, 12)).unwrap().unwrap();
    assert_eq!(seen.radiance.map(|channel| channel as f32), film.rgb[12 * 45 + 20]);
}

/// What is even gets its share, which is no work as long as it has that, and what is said of it is what is held.
#[test]
fn quiet_tiles_get_no_work_and_are_told() {
    let description = lucerna::stress::scenes::uneven::half_hard(UVec2::splat(48));
    let render = Render { adaptive: Adaptive::On, spp: 64, ..description.render };
    let mut engine = open(&SceneDescription { render, ..description });
    let film = finish(&mut engine, LONG);
    let report = engine.report().unwrap();
    let TileCounts { tiles, least, median, most, idle } = report.tiles.unwrap();
    let mut counts: Vec<u32> = (0..36u32)
        .map(|tile| film.pixels[(tile / 6 * 8 * 48 + tile % 6 * 8) as usize].halves.map(|half| half.count).iter().sum())
        .collect();
    assert_eq!(counts.iter().filter(|count| **count == 16).count() as u32, idle);
    counts.sort_unstable();
    assert_eq!((tiles, least, median, most), (36, counts[0], counts[18], counts[35]));
    assert!(idle >= 6 && least == 16 && most > 128, "{counts:?}");
    let samples = 64 * 48 * 48;
    assert!(report.samples <= samples && report.samples > samples - samples / 50, "{} of {samples}", report.samples);
    assert!(report.dispatches.contains_key("tally"));
}

#[test]
fn nothing_of_it_runs_where_it_is_not_asked_for() {
    let description = plain(&describe("cornell-box", &[("render.spp", "20")]));
    let mut engine = open(&description);
    finish(&mut engine, LONG);
    assert!(!engine.features().contains("adaptive") && !engine.dispatches().contains_key("tally"));
    assert!(engine.report().unwrap().tiles.is_none());
    let systems = ["hear_tallies", "record_tiles", "accumulate_tiles", "tally_all"];
    assert!(systems.iter().all(|system| !engine.entered().contains_key(system)));
    assert!(engine.uploads().keys().all(|buffer| !buffer.contains("tile") && !buffer.contains("tall")));
}
