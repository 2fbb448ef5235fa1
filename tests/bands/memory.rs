//! What is told of memory: buffers by name, and the most that there was.

use std::time::Duration;

use lucerna::app::shared::memory::shown;
use lucerna::gpu::Held;
use lucerna::layout::film::FilmPixel;
use lucerna::process::peak;

use super::{lucerna, report, scene};
use crate::support;

#[test]
fn buffers_are_counted_when_they_come_grow_and_go() {
    let mut held = Held::default();
    held.add(100);
    held.add(50);
    held.take(100);
    held.add(20);
    assert_eq!(held, Held { now: 70, most: 150 });

    let mut rig = support::rig();
    assert_eq!(rig.memory(), Default::default());
    rig.upload("nodes", &[0u32; 256]).unwrap();
    rig.upload("leaves", &[0u32; 64]).unwrap();
    assert_eq!(rig.memory().buffers, [("nodes", 1024), ("leaves", 256)]);
    // One that is large enough stays; one that grows takes the place of the old.
    rig.upload("nodes", &[0u32; 128]).unwrap();
    rig.upload("leaves", &[0u32; 1024]).unwrap();
    assert_eq!(rig.memory().buffers, [("leaves", 4096), ("nodes", 1024)]);
    assert_eq!(rig.memory().held, Held { now: 5120, most: 5120 });
    // What is read through stays too, until it has to be larger.
    for (count, bytes) in [(16, 64), (8, 64), (1024, 4096)] {
        rig.read_some::<u32>("leaves", count).unwrap();
        let memory = rig.memory();
        assert!(memory.buffers.contains(&("readback", bytes)), "{memory:?}");
        assert_eq!(memory.held.now, memory.buffers.iter().map(|(_, bytes)| bytes).sum::<u64>());
    }
    assert_eq!(rig.memory().held.most, 5120 + 4096);
}

#[test]
fn a_report_names_the_buffers_and_the_most_of_all() {
    let (folder, scene) = (tempfile::tempdir().unwrap(), scene("cornell-data"));
    let arguments = ["render", &scene, "--spp", "1", "-o", "x.json"];
    let of = |size: &str| report(folder.path(), None, &[&arguments[..], &["--size", size]].concat())["memory"].clone();
    let [small, large] = ["40x30", "400x300"].map(of);
    let bytes = |told: &serde_json::Value, name: &str| told["device_buffers"][name].as_u64().unwrap();
    for (told, pixels) in [(&small, 1200), (&large, 120_000)] {
        assert_eq!(bytes(told, "film"), pixels * size_of::<FilmPixel>() as u64);
        assert_eq!(bytes(told, "picture"), pixels * 4);
        let all: u64 = told["device_buffers"].as_object().unwrap().values().map(|bytes| bytes.as_u64().unwrap()).sum();
        let most = told["device_peak"].as_u64().unwrap();
        assert!(most >= all && most < 4 * all, "{told}");
        match told["process_peak"].as_u64() {
            // A driver alone takes some megabytes, and no test has this much.
            Some(peak) => assert!(peak > 4 << 20 && peak < 64 << 30, "{peak}"),
            None => assert!(told["process_peak"].is_null() && peak().is_none(), "{told}"),
        }
    }
    assert_eq!(bytes(&small, "nodes"), bytes(&large, "nodes"));
}

/// Of a picture in bands memory is that of a band, whatever its height.
#[test]
fn a_higher_picture_takes_no_more() {
    let (folder, scene) = (tempfile::tempdir().unwrap(), scene("cornell-data"));
    let of = |size: &str| {
        let arguments = ["render", &scene, "--spp", "1", "--size", size, "-o", "x.exr", "-o", "x.png"];
        let told = report(folder.path(), Some(4 << 20), &arguments);
        assert!(told["bands"].as_array().unwrap().len() > 1);
        told["memory"].clone()
    };
    let [low, high] = ["512x256", "512x2048"].map(of);
    assert_eq!(low["device_buffers"]["film"], high["device_buffers"]["film"]);
    let most = |told: &serde_json::Value, key: &str| told[key].as_f64().unwrap();
    assert!(most(&high, "device_peak") <= 1.3 * most(&low, "device_peak"), "{low} {high}");
    if !low["process_peak"].is_null() {
        // A film of the larger one has 64 MiB, its pixels in files 16, and those are not held either.
        let more = most(&high, "process_peak") - most(&low, "process_peak");
        assert!(more < 12e6, "{more} bytes more");
    }
}

#[test]
fn memory_is_told_in_stats() {
    let (folder, scene) = (tempfile::tempdir().unwrap(), scene("cornell-data"));
    let run = lucerna(folder.path(), None, &["render", &scene, "--spp", "1", "--stats", "-o", "x.json"]);
    let out = String::from_utf8(run.stdout).unwrap();
    let line = out.lines().find(|line| line.contains("memory: ")).unwrap_or_else(|| panic!("{out}"));
    assert!(line.contains("film 16.0 MiB") && line.contains("at most ("), "{line}");
    assert_eq!(line.contains("; process "), peak().is_some(), "{line}");
    assert_eq!(
        [0, 1023, 1024, 1 << 20, 5 << 30].map(shown),
        ["0 bytes", "1023 bytes", "1.0 KiB", "1.0 MiB", "5.00 GiB"]
    );
}

/// The most that was resident is no less than what is: a list is made, filled and dropped.
#[test]
fn the_process_knows_its_peak() {
    let Some(before) = peak() else { return };
    let size = 64 << 20;
    let filled: Vec<u8> = (0..size).map(|i| i as u8).collect();
    std::thread::sleep(Duration::from_millis(1));
    assert_eq!(filled.len(), size);
    let after = peak().unwrap();
    assert!(after >= before && after >= size as u64, "{before} {after}");
}

/// Bytes of an element of each array that grows, by the code.
fn elements() -> Vec<(&'static str, usize)> {
    use lucerna::layout::{cdf, light, texture, trace, tree};
    vec![
        ("film", size_of::<FilmPixel>()),
        ("picture", 4),
        ("readback", size_of::<FilmPixel>()),
        ("film_aside", size_of::<FilmPixel>()),
        ("film_picture", 4),
        ("debug_colours", size_of::<glam::Vec4>()),
        ("radiance", size_of::<trace::RadianceSample>()),
        ("gather_points", size_of::<trace::GatherPoint>()),
        ("lent_points", size_of::<trace::LentPoint>()),
        ("gather_materials", size_of::<trace::MaterialRecord>()),
        ("triangles", size_of::<tree::Triangle>()),
        ("leaves", of_tree("leaves")),
        ("nodes", of_tree("nodes")),
        ("boxes", of_tree("boxes")),
        ("treelets", of_tree("treelets")),
        ("keys", of_tree("keys")),
        ("payload", of_tree("payload")),
        ("shading", size_of::<trace::Shading>()),
        ("uvs", size_of::<texture::CornerUvs>()),
        ("tangents", size_of::<texture::Tangents>()),
        ("materials", size_of::<trace::MaterialRecord>()),
        ("lights", size_of::<light::LightRecord>()),
        ("sky", size_of::<glam::Vec4>()),
        ("sky_cdf", size_of::<cdf::CdfEntry>()),
        ("texels", 4),
    ]
}

/// Bytes that the tree has for each triangle more.
fn of_tree(buffer: &str) -> usize {
    let plan = lucerna::passes::tree::PLAN;
    ((plan.bytes(buffer, 2 << 20) - plan.bytes(buffer, 1 << 20)) >> 20) as usize
}

#[test]
fn the_page_has_the_bytes_of_the_code() {
    let page = std::fs::read_to_string("docs/memory.md").unwrap();
    let rows = page.lines().skip_while(|line| !line.starts_with("| on the device |")).skip(2);
    let listed: Vec<(String, usize)> = rows
        .take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            (cells[1].trim_matches('`').to_owned(), cells[2].parse().unwrap_or_else(|_| panic!("{line}")))
        })
        .collect();
    let known: Vec<(String, usize)> = elements().into_iter().map(|(name, bytes)| (name.to_owned(), bytes)).collect();
    assert_eq!(listed, known);
}
