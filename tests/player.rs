//! The player: order, parameters, folding of workgroups, counts, and the devices without optional features.

use lucerna::gpu::{Gpu, GpuError, Runtime};
use lucerna::passes::{Recording, clear};
use lucerna::shader::Library;

use crate::support;

#[test]
fn dispatches_see_what_the_ones_before_wrote() {
    let mut rig = support::rig();
    rig.upload("words", &[7u32; 1000]).unwrap();
    let mut recording = Recording::default();
    clear(&mut recording, "words", 3, 900);
    clear(&mut recording, "words", 4, 257);
    clear(&mut recording, "words", 5, 0);
    rig.play(&recording).unwrap();
    let words: Vec<u32> = rig.read("words").unwrap();
    assert_eq!(words.len(), 1000);
    assert!(words[..257].iter().all(|w| *w == 4));
    assert!(words[257..900].iter().all(|w| *w == 3));
    assert!(words[900..].iter().all(|w| *w == 7));
    assert_eq!(rig.dispatches()["clear"], 2, "a dispatch of nothing is not issued");
}

#[test]
fn long_recordings_keep_their_order() {
    let mut rig = support::rig();
    rig.upload("words", &[u32::MAX; 4096]).unwrap();
    // A real GPU would show a missing barrier only now and then, so it gets more of them.
    let dispatches = if support::stress() { 20_000 } else { 500 };
    let mut recording = Recording::default();
    for i in 0..dispatches {
        clear(&mut recording, "words", i, 4096 - i % 4096);
    }
    rig.play(&recording).unwrap();
    let words: Vec<u32> = rig.read("words").unwrap();
    let last = |word: u32| (0..dispatches).rev().find(|i| word < 4096 - i % 4096).unwrap();
    assert!((0..4096).zip(&words).all(|(word, value)| *value == last(word)));
}

#[test]
fn more_workgroups_than_a_dimension_takes_are_folded() {
    let mut rig = support::rig();
    // One more group of 256 than the 65,535 that WebGPU guarantees along x.
    let count = 65_536 * 256 - 3;
    rig.reserve("words", u64::from(count) * 4 + 12).unwrap();
    let mut recording = Recording::default();
    clear(&mut recording, "words", 9, count);
    rig.play(&recording).unwrap();
    let words: Vec<u32> = rig.read("words").unwrap();
    assert_eq!(words.iter().position(|w| *w != 9), Some(count as usize));
}

#[test]
fn a_device_without_optional_features_plays_the_same() {
    let mut rig = Runtime::new(Gpu::open_plain().unwrap(), Library::embedded());
    rig.set_timing(true);
    rig.upload("words", &[1u32; 64]).unwrap();
    let mut recording = Recording::default();
    clear(&mut recording, "words", 2, 64);
    rig.play(&recording).unwrap();
    assert_eq!(rig.read::<u32>("words").unwrap(), [2; 64]);
    assert!(rig.timings().unwrap().is_empty(), "no timestamps, no timings");
}

#[test]
fn timings_count_every_dispatch() {
    let mut rig = support::rig();
    rig.set_timing(true);
    rig.upload("words", &[1u32; 64]).unwrap();
    let mut recording = Recording::default();
    for value in 0..5 {
        clear(&mut recording, "words", value, 64);
    }
    rig.play(&recording).unwrap();
    rig.play(&recording).unwrap();
    let timings = rig.timings().unwrap();
    assert_eq!((timings[0].name, timings[0].count), ("clear", 10));
    assert!(timings[0].milliseconds > 0.0);
    assert_eq!(rig.spans().unwrap().len(), 2);
}

#[test]
fn what_does_not_fit_or_is_not_there_is_named() {
    let mut rig = support::rig();
    let limit = rig.gpu().limits.max_storage_buffer_binding_size;
    let error = rig.reserve("nodes", limit + 1).unwrap_err();
    assert!(matches!(error, GpuError::TooLarge { name: "nodes", .. }), "{error}");
    let mut recording = Recording::default();
    clear(&mut recording, "nowhere", 1, 1);
    let error = rig.play(&recording).unwrap_err();
    assert!(matches!(error, GpuError::NoBuffer { pass: "clear", buffer: "nowhere" }), "{error}");
}

/// What to do is about that which the array grows with, and says how much of it fits.
#[test]
fn an_array_that_is_too_large_says_what_to_make_smaller() {
    use miette::Diagnostic;
    let mut rig = support::rig();
    let limits = &rig.gpu().limits;
    let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    for (name, word, bytes) in [
        ("sky", "smaller picture of the environment", 16),
        ("sky_cdf", "smaller picture of the environment", 8),
        ("film", "smaller film", size_of::<lucerna::layout::film::FilmPixel>() as u64),
        ("picture", "smaller film", 4),
        ("triangles", "fewer triangles", size_of::<lucerna::layout::tree::Triangle>() as u64),
        ("shading", "fewer triangles", size_of::<lucerna::layout::trace::Shading>() as u64),
        ("leaves", "fewer triangles", size_of::<lucerna::layout::tree::Triangle>() as u64),
        ("nodes", "fewer triangles", size_of::<lucerna::layout::tree::Node>() as u64),
        // Of runs of 1, 2, 4, .. leaves.
        ("boxes", "fewer triangles", 2 * size_of::<lucerna::layout::tree::LeafBox>() as u64),
        ("keys_back", "fewer triangles", 8),
        ("payload", "fewer triangles", 4),
        ("lights", "triangles that emit", size_of::<lucerna::layout::light::LightRecord>() as u64),
        ("materials", "fewer materials", size_of::<lucerna::layout::trace::MaterialRecord>() as u64),
        ("sort_counts", "smaller scene or film", 0),
    ] {
        let error = rig.reserve(name, limit + 1).unwrap_err();
        let help = error.help().unwrap().to_string();
        assert!(error.to_string().contains(name) && help.contains(word), "{name}: {help}");
        assert_eq!(help.starts_with("use fewer triangles:"), word == "fewer triangles", "{name}: {help}");
        let most = limit.checked_div(bytes).unwrap_or(0);
        if word.contains("environment") {
            let sides: Vec<u64> = help.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok()).collect();
            let [width, height] = sides[..] else { panic!("{help}") };
            assert!(width == 2 * height && width * height <= most && (width + 2) * (height + 1) > most, "{help}");
        } else if bytes > 0 {
            assert!(help.contains(&most.to_string()), "{name}: {help} has no {most}");
        }
    }
}

/// What is kept of recordings keeps buffers that nothing names any more, and with them their memory.
#[test]
fn a_buffer_that_gives_way_is_let_go() {
    let mut rig = support::rig();
    let play = |rig: &mut Runtime, count: u32, value: u32| {
        let mut recording = Recording::default();
        clear(&mut recording, "words", value, count);
        clear(&mut recording, "others", value, 4);
        rig.play(&recording).unwrap();
    };
    rig.upload("others", &[0u32; 4]).unwrap();
    rig.upload("words", &[0u32; 100]).unwrap();
    play(&mut rig, 100, 1);
    assert_eq!(rig.bind_groups(), 2);
    // A smaller one is bound anew, and is the same buffer.
    rig.reserve("words", 200).unwrap();
    assert_eq!(rig.bind_groups(), 2);
    for (round, count) in [1000u32, 10_000, 100_000].into_iter().enumerate() {
        rig.reserve("words", u64::from(count) * 4).unwrap();
        assert_eq!(rig.bind_groups(), 1, "those of the old one");
        play(&mut rig, count, 7 + round as u32);
        assert!(rig.read::<u32>("words").unwrap().iter().all(|word| *word == 7 + round as u32));
    }
    let before = rig.memory().held.now;
    rig.release("words");
    assert_eq!((rig.bind_groups(), rig.memory().held.now), (1, before - 400_000));
    // One of the same size as another had is not taken for that.
    rig.upload("words", &[0u32; 100]).unwrap();
    play(&mut rig, 100, 3);
    assert_eq!(rig.read::<u32>("words").unwrap(), [3; 100]);
}
