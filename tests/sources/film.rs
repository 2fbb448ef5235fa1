//! The film has nothing of it: neither its kernel nor its samples, and nothing runs that was not asked for.

use std::time::Duration;

use lucerna::components::Material;
use lucerna::engine::Surveyed;
use lucerna::passes::sources::SOURCES;
use lucerna::passes::trace::PATH;
use lucerna::shader::{Features, Library};

use super::{open, scene_with, surveyed};

const SMALL: [(&str, &str); 2] = [("film.size", "(40, 24)"), ("render.spp", "8")];

#[test]
fn a_survey_leaves_the_film_as_it_is_and_runs_only_when_asked() {
    let mut engine = open(&scene_with("cornell-box", &SMALL));
    let film = engine.film().unwrap();
    assert!(!engine.dispatches().contains_key(SOURCES.name));
    assert!(!engine.compiled().contains_key(SOURCES.name));
    let (first, sources) = surveyed(&mut engine);
    let windows = engine.dispatches()[SOURCES.name];
    assert!(windows > 1);
    assert_eq!(engine.film().unwrap().pixels, film.pixels);
    let (second, again) = surveyed(&mut engine);
    assert_eq!((first.tally(), first.map()), (second.tally(), second.map()), "the same bits");
    assert_eq!(sources, again);
    assert_eq!(engine.dispatches()[SOURCES.name], 2 * windows);
    // The film goes on as if nothing had been.
    engine.edit(|world| {
        for mut render in world.query::<&mut lucerna::components::Render>().iter_mut(world) {
            render.spp = 12;
        }
    });
    while !engine.step(Duration::from_secs(5)).unwrap().finished {}
    let more = scene_with("cornell-box", &[SMALL[0], ("render.spp", "12")]);
    assert_eq!(engine.film().unwrap().pixels, open(&more).film().unwrap().pixels);
}

#[test]
fn windows_of_any_size_give_the_same_parts() {
    let mut engine = open(&scene_with("cornell-data", &SMALL));
    let mut of = |most: u64| {
        let mut survey = engine.begin_survey(most).unwrap().unwrap();
        while engine.survey(&mut survey).unwrap() == Surveyed::More {}
        (survey.map(), engine.sources(&survey))
    };
    let ((map, large), (same, small)) = (of(u64::MAX), of(1));
    assert_eq!(map, same);
    assert!((large.relmse / small.relmse - 1.0).abs() < 1e-12);
    assert_eq!(large.ways.len(), small.ways.len());
}

#[test]
fn a_survey_of_a_film_that_starts_anew_is_over() {
    let mut engine = open(&scene_with("cornell-data", &SMALL));
    let mut survey = engine.begin_survey(1).unwrap().unwrap();
    assert_eq!(engine.survey(&mut survey).unwrap(), Surveyed::More);
    engine.edit(|world| {
        for mut material in world.query::<&mut Material>().iter_mut(world) {
            material.diffuse *= 0.5;
        }
    });
    while !engine.step(Duration::from_secs(5)).unwrap().finished {}
    assert_eq!(engine.survey(&mut survey).unwrap(), Surveyed::Stale);
}

#[test]
fn there_is_none_before_the_film() {
    let description = scene_with("cornell-data", &SMALL);
    let engine = lucerna::Engine::open(crate::support::gpu(), Library::shipped(), &description).unwrap();
    assert!(engine.begin_survey(1).unwrap().is_none());
}

/// Where it isn't asked for, the film's kernel is token by token what it would be if all of it were struck out.
#[test]
fn the_films_kernel_has_nothing_of_it() {
    let library = Library::shipped();
    let names: Vec<String> = library.modules().map(str::to_owned).collect();
    let mut struck = library.clone();
    let mut lines = 0;
    for name in names {
        let text = library.text(&name).unwrap();
        let is_ours = |line: &&str| line.trim_start().starts_with("@if(sources");
        lines += text.lines().filter(is_ours).count();
        let kept: String = text.lines().filter(|line| !is_ours(line)).map(|line| format!("{line}\n")).collect();
        struck = struck.with(&name, &kept);
    }
    assert!(lines > 9, "{lines}");
    let mut sets = library.feature_sets(PATH.module).unwrap();
    sets.retain(|features| !features.contains("sources"));
    for features in sets.iter().step_by(7) {
        let [ours, without] = [&library, &struck].map(|library| library.link(PATH.module, features).unwrap());
        assert_eq!(ours.fingerprint(), without.fingerprint(), "{features:?}");
        assert!(!ours.imports.iter().any(|module| module.contains("brought")));
    }
    let asked: Features = ["sources".to_owned()].into();
    let bringing = library.link(SOURCES.module, &asked).unwrap();
    assert!(bringing.imports.contains("passes/trace/brought") && bringing.text.contains("bring(light);"));
}
