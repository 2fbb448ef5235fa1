//! The worked edits of shaders/README.md, as they stand there, performed on a running engine.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use glam::{UVec2, Vec4};
use lucerna::components::{Film, Integrator, Material, Render, ShaderValue, ShaderValues};
use lucerna::engine::{ProbedValue, Probing};
use lucerna::layout::view::ViewMode;
use lucerna::passes::probe::ProbeLook;

use super::Bench;

/// One change of a file that the guide asks for.
struct Edit {
    file: String,
    /// What is to be found; None for a new file.
    old: Option<String>,
    new: String,
}

/// The edits under the heading of a number.
fn edits(number: u32) -> Vec<Edit> {
    let guide = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders/README.md")).unwrap();
    let start = guide.find(&format!("\n### {number}. ")).unwrap();
    let section = guide[start + 1..].split("\n### ").next().unwrap();
    let (mut file, mut edits) = (String::new(), Vec::new());
    let mut lines = section.lines();
    while let Some(line) = lines.next() {
        if let Some(name) = line.split('`').nth(1).filter(|_| line.ends_with("`:")) {
            file = format!("shaders/{name}");
        } else if let Some(kind) = line.strip_prefix("```") {
            let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
            let side = |marks: [char; 2]| -> String {
                let kept = block.iter().filter(|line| line.is_empty() || line.starts_with(marks));
                kept.map(|line| line.get(1..).unwrap_or("").to_owned() + "\n").collect()
            };
            edits.push(match kind {
                "diff" => Edit { file: file.clone(), old: Some(side([' ', '-'])), new: side([' ', '+']) },
                "wgsl" => Edit { file: file.clone(), old: None, new: block.join("\n") + "\n" },
                other => panic!("a block of `{other}`"),
            });
        }
    }
    assert!(!edits.is_empty());
    edits
}

/// Performs the edits of a number, in a burst, as an editor's "save all" does: the film starts anew.
fn perform(bench: &mut Bench, number: u32) {
    write(bench, number);
    assert_eq!(bench.reloaded(), "film");
}

fn write(bench: &mut Bench, number: u32) {
    for Edit { file, old, new } in edits(number) {
        match old {
            None => bench.write(&file, &new),
            Some(old) => {
                let text = bench.read(&file);
                assert_eq!(text.matches(&old).count(), 1, "{file}: not once in it:\n{old}");
                bench.write(&file, &text.replace(&old, &new));
            }
        }
    }
}

/// The scene of the other tests, larger, with lights asked directly, one of them ten times as bright.
fn bench(integrator: Integrator) -> Bench {
    let mut bench = Bench::new();
    bench.engine.edit(|world| {
        let mut films = world.query::<(&mut Film, &mut Render)>();
        for (mut film, mut render) in films.iter_mut(world) {
            film.size = UVec2::new(48, 36);
            (render.integrator, render.spp) = (integrator, 128);
        }
    });
    bench
}

/// Mean of the film, and its standard error from that of the pixels.
fn mean(bench: &mut Bench) -> (f64, f64) {
    let film = bench.film();
    let report = bench.engine.report().unwrap();
    assert_eq!(report.bad_samples, 0);
    let pixel = |rgb: &[f32; 3]| rgb.iter().map(|c| f64::from(*c)).sum::<f64>() / 3.0;
    let count = film.rgb.len() as f64;
    let mean = film.rgb.iter().map(pixel).sum::<f64>() / count;
    let halves = film.halves[0].iter().zip(&film.halves[1]);
    // The halves are independent: the variance of a pixel's mean is a quarter of their squared difference.
    let variance: f64 = halves.map(|(a, b)| 0.25 * (pixel(a) - pixel(b)).powi(2)).sum::<f64>() / (count * count);
    (mean, variance.sqrt())
}

/// Whether two means agree within five standard errors, and those are small enough to mean something.
#[track_caller]
fn agree(a: (f64, f64), b: (f64, f64)) -> bool {
    let error = a.1.hypot(b.1);
    assert!(error > 0.0 && error < 0.02 * a.0, "{a:?} {b:?}: too noisy to tell");
    (a.0 - b.0).abs() < 5.0 * error
}

#[test]
fn another_sampler_has_the_same_mean() {
    let mut bench = bench(Integrator::Path);
    let before = mean(&mut bench);
    perform(&mut bench, 1);
    let after = mean(&mut bench);
    assert!(agree(before, after), "{before:?} {after:?}");
    assert!(before != after);
}

#[test]
fn another_bsdf_is_another_surface() {
    let mut bench = bench(Integrator::Path);
    let before = mean(&mut bench);
    perform(&mut bench, 2);
    let after = mean(&mut bench);
    assert!(!agree(before, after), "{before:?} {after:?}");
    // And finding light by chance comes to the same as asking for it: value and density belong together.
    bench.engine.edit(|world| {
        let mut renders = world.query::<&mut Render>();
        for mut render in renders.iter_mut(world) {
            (render.integrator, render.spp) = (Integrator::Bsdf, 512);
        }
    });
    let found = mean(&mut bench);
    assert!(agree(after, found), "{after:?} {found:?}");
}

#[test]
fn another_choice_of_light_has_the_same_mean() {
    let mut bench = bench(Integrator::Path);
    // A second lamp, so that there is a choice, and the two choices differ.
    let dim = "newmtl dim\nKd 0 0 0\nKe 0.3 0.3 0.3\n";
    bench.write("room.mtl", &(super::MTL.to_owned() + dim));
    bench.write("room.obj", &(super::OBJ.to_owned() + "usemtl dim\nf 5 8 4 1\n"));
    bench.reloaded();
    let lamps = bench
        .engine
        .edit(|world| world.query::<&Material>().iter(world).filter(|material| material.emission.x > 0.0).count());
    assert_eq!(lamps, 2);
    let before = mean(&mut bench);
    perform(&mut bench, 3);
    let after = mean(&mut bench);
    assert!(agree(before, after), "{before:?} {after:?}");
    assert!(before != after);
}

#[test]
fn another_texture_filter_has_the_same_mean() {
    let mut bench = bench(Integrator::Path);
    // Of few texels, so that they are seen from near; the floor repeats it, so that its mean stays.
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 4, 4);
    encoder.set_color(png::ColorType::Rgb);
    let texels: Vec<u8> = (0..16).flat_map(|i| [if i % 3 == 0 { 255 } else { 90 }, 40 + 12 * i, 200]).collect();
    encoder.write_header().unwrap().write_image_data(&texels).unwrap();
    fs::write(bench.path("floor.png"), file).unwrap();
    bench.write("room.mtl", &super::MTL.replace("Kd 0.5 0.5 0.5", "Kd 0.9 0.9 0.9\nmap_Kd floor.png"));
    let floor = super::OBJ
        .replace("usemtl floor\nf 1 4 3 2", "vt 0 0\nvt 2 0\nvt 2 2\nvt 0 2\nusemtl floor\nf 1/1 4/4 3/3 2/2");
    bench.write("room.obj", &floor);
    bench.reloaded();
    assert!(bench.engine.features().contains("textures"));
    let before = mean(&mut bench);
    perform(&mut bench, 4);
    let after = mean(&mut bench);
    assert!(agree(before, after), "{before:?} {after:?}");
    assert!(before != after);
}

#[test]
fn a_number_of_ones_own_is_moved_without_compiling() {
    let mut bench = bench(Integrator::Bsdf);
    let lambert = mean(&mut bench);
    perform(&mut bench, 2);
    let rough = mean(&mut bench);
    assert!(!agree(lambert, rough), "{lambert:?} {rough:?}");
    perform(&mut bench, 5);
    assert_eq!(mean(&mut bench), rough, "the default is what stood there");
    let compiled = bench.engine.compiled();
    bench.engine.edit(|world| {
        for mut values in world.query::<&mut ShaderValues>().iter_mut(world) {
            values.0.insert("ROUGHNESS".to_owned(), ShaderValue::Number(0.0));
        }
    });
    let smooth = mean(&mut bench);
    assert!(agree(lambert, smooth), "{lambert:?} {smooth:?}");
    assert_eq!(bench.engine.compiled(), compiled);
}

#[test]
fn a_picture_of_ones_own_is_of_the_paths_that_make_the_film() {
    let mut bench = bench(Integrator::Bsdf);
    let before = bench.film();
    bench.engine.set_view(ViewMode::Debug);
    bench.finish();
    assert!(bench.engine.debug_colours().unwrap().unwrap().iter().all(|colour| *colour == Vec4::ZERO));
    // The call is nothing in the film's kernel but a save of its module: it is traced again, to the same bits.
    perform(&mut bench, 6);
    assert_eq!(bench.film().pixels, before.pixels);
    let colours = bench.engine.debug_colours().unwrap().unwrap();
    // What looks past all, or at the lamp, ends there; the floor sends a path on once, and nothing else reflects.
    let rays: BTreeSet<u32> = colours.iter().map(|colour| (8.0 * colour.x) as u32).collect();
    assert!(colours.iter().all(|colour| colour.w == 1.0), "every path is finished");
    assert_eq!(rays, BTreeSet::from([1, 2]));
}

#[test]
fn a_number_is_shown_by_view_and_replay_and_starts_nothing_anew() {
    let mut bench = bench(Integrator::Path);
    bench.engine.edit(|world| world.query::<&mut Render>().iter_mut(world).for_each(|mut render| render.spp = 4));
    let before = bench.film();
    write(&mut bench, 7);
    assert_eq!(bench.reloaded(), "nothing");
    assert_eq!(bench.film().pixels, before.pixels);
    let probes = bench.engine.probes();
    assert_eq!((probes.len(), probes[0].name.as_str()), (1, "mis weight"));
    let place = &probes[0].places[0];
    let line = place.source.text.lines().nth(place.line - 1).unwrap();
    assert!(line.contains("probe(\"mis weight\", power_heuristic("), "{line}");

    bench.engine.set_probe(Some(Probing { name: "mis weight".to_owned(), look: ProbeLook::default() }));
    bench.engine.set_view(ViewMode::Probe);
    bench.finish();
    let weights = bench.engine.probe_values().unwrap().unwrap();
    let found: Vec<usize> = (0..weights.len()).filter(|pixel| weights[*pixel].w > 0.0).collect();
    assert!(found.len() > 10, "{} paths end on something", found.len());
    // What follows from the twin's densities (Veach 1997).
    let mut compared = 0;
    for pixel in found.into_iter().step_by(3) {
        let at = UVec2::new(pixel as u32 % 48, pixel as u32 / 48);
        let replay = bench.engine.replay(at, 0).unwrap().unwrap();
        let [first, ..] = &replay.probed[..] else { panic!("{at}: nothing") };
        let ProbedValue::Numbers(numbers) = &first.value else { panic!("{first:?}") };
        assert!((numbers[0] - weights[pixel].x).abs() <= 1e-5, "{at}: {numbers:?} beside {}", weights[pixel]);
        let twin = &replay.verdict.twin[first.turn];
        if twin.found_pdf > 0.0 {
            let (p, q) = (twin.pdf.powi(2), twin.found_pdf.powi(2));
            assert!((f64::from(numbers[0]) - p / (p + q)).abs() < 1e-4, "{at}: {numbers:?} beside {}", p / (p + q));
            compared += 1;
        }
    }
    assert!(compared > 2, "{compared} paths found a light by chance");
}
