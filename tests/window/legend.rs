//! What legends say is what views show.

use std::path::Path;
use std::time::Duration;

use glam::UVec2;
use lucerna::Engine;
use lucerna::app::window::legend::{Bar, Legend, legend};
use lucerna::layout::view::{VIEW_MOST_LEVELS, VIEW_MOST_STEPS, ViewMode};
use lucerna::scene;
use lucerna::shader::Library;

use crate::support;

/// Odd sides: the middle pixel looks along the axis.
const SIZE: UVec2 = UVec2::new(33, 25);

fn engine() -> Engine {
    let mut description = scene::load(Path::new("assets/scenes/cornell-box.ron"), &[]).unwrap().description;
    description.film.size = SIZE;
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    engine.set_live(true);
    engine
}

/// What a view shows.
fn picture(engine: &mut Engine, view: ViewMode) -> Vec<[u8; 4]> {
    engine.set_view(view);
    engine.step(Duration::from_millis(20)).unwrap();
    engine.picture().unwrap().unwrap()
}

fn of(engine: &Engine, view: ViewMode) -> Legend {
    legend(view, engine.view_reach(), &engine.material_names()).unwrap()
}

/// The colour at a place of a bar from 0 to 1.
fn at(bar: &Bar, place: f64) -> [u8; 3] {
    bar.colours[(place * (bar.colours.len() - 1) as f64).round() as usize]
}

#[test]
fn depth_is_what_its_bar_says() {
    let mut engine = engine();
    let middle = SIZE / 2;
    let shown = picture(&mut engine, ViewMode::Depth)[(middle.y * SIZE.x + middle.x) as usize];
    let distance = engine.inspect(middle).unwrap().unwrap().surface.unwrap().distance;
    let Legend { bar: Some(bar), .. } = of(&engine, ViewMode::Depth) else { panic!("no bar") };
    // The numbers say which distance lies where: between two of them the bar is even in 1 / (reach + distance).
    let reach = f64::from(engine.view_reach());
    let number = |place: f32| bar.marks.iter().find(|(at, _)| *at == place).unwrap().1.clone();
    let half: f64 = number(0.5).parse().unwrap();
    assert!((half / reach - 1.0).abs() < 0.01 && number(0.0) == "0" && number(1.0) == "far", "{:?}", bar.marks);
    let told = at(&bar, distance / (reach + distance));
    assert!(told[0].abs_diff(shown[0]) <= 2, "{told:?} at {distance}, and the picture has {shown:?}");
}

#[test]
fn heat_goes_from_black_to_white_where_the_numbers_end() {
    let engine = engine();
    for (view, most) in [(ViewMode::Cost, VIEW_MOST_STEPS), (ViewMode::Level, VIEW_MOST_LEVELS)] {
        let bar = of(&engine, view).bar.unwrap();
        assert_eq!((at(&bar, 0.0), at(&bar, 1.0)), ([0; 3], [255; 3]));
        assert_eq!(bar.marks.last().unwrap(), &(1.0, format!("{most}+")));
        // A third of the way is red, two are yellow.
        assert!(at(&bar, 0.33)[0] > 240 && at(&bar, 0.33)[1] < 16 && at(&bar, 0.66)[1] > 240 && at(&bar, 0.66)[2] < 16);
        for (place, number) in &bar.marks {
            let count: f32 = number.trim_end_matches('+').parse().unwrap();
            assert!((count / most as f32 - place).abs() < 1e-6, "{number} at {place}");
        }
    }
}

#[test]
fn each_material_has_the_colour_that_it_is_shown_in() {
    let mut engine = engine();
    let shown = picture(&mut engine, ViewMode::Material);
    let named = of(&engine, ViewMode::Material).swatches;
    for pixel in [SIZE / 2, UVec2::new(4, 12), UVec2::new(28, 12), UVec2::new(16, 2)] {
        let surface = engine.inspect(pixel).unwrap().unwrap().surface.unwrap();
        let material = surface.material.unwrap();
        let (colour, _) = named.iter().find(|(_, name)| *name == material).unwrap();
        assert_eq!(shown[(pixel.y * SIZE.x + pixel.x) as usize][..3], colour[..], "{material} at {pixel}");
    }
}

#[test]
fn every_view_but_the_film_and_what_shaders_show_has_a_legend() {
    for (view, name) in ViewMode::ALL {
        let found = legend(view, 1.0, &["a".to_owned()]);
        let expected = !matches!(view, ViewMode::Beauty | ViewMode::Debug | ViewMode::Probe);
        assert_eq!(found.is_some_and(|legend| !legend.title.is_empty()), expected, "{name}");
    }
}
