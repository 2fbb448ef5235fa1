//! The pass table against the WGSL, without a GPU: every row under many sets of features.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use glam::UVec2;
use lucerna::gpu::checked_entry;
use lucerna::layout::adaptive::TallyParams;
use lucerna::layout::sort::{SORT_FEW_TILES, SORT_TILE};
use lucerna::layout::trace::TraceParams;
use lucerna::layout::tree::Triangle;
use lucerna::layout::view::ViewParams;
use lucerna::passes::lattice::Lattice;
use lucerna::passes::table::TABLE;
use lucerna::passes::tree::PLAN;
use lucerna::passes::{Makes, Recording, Twin, adaptive, blocks, debug, film, probe, trace, view};
use lucerna::shader::{Features, Library, Linked};
use naga::valid::GlobalUse;

#[test]
fn every_row_is_what_its_shader_uses_whatever_the_features() {
    let library = Library::shipped();
    for pass in TABLE {
        let sets =
            library.feature_sets(pass.module).unwrap_or_else(|error| panic!("{}: {}", pass.name, error.report()));
        for features in sets {
            let linked = match library.link(pass.module, &features) {
                Ok(linked) => linked,
                Err(error) => panic!("{} under {features:?}: {}", pass.name, error.report()),
            };
            let entry = checked_entry(pass, &linked, &features).unwrap_or_else(|error| panic!("{features:?}: {error}"));
            assert!(entry.workgroup_size.iter().product::<u32>() <= 256, "{}: no portable workgroup size", pass.name);
            assert_eq!(read_unwritten(&linked, pass.entry), None, "{}: workgroup memory, {features:?}", pass.name);
        }
    }
}

/// A variable in workgroup memory, which starts as anything, that an entry point reads without ever writing it.
fn read_unwritten(linked: &Linked, entry: &str) -> Option<String> {
    let module = &linked.module;
    let index = module.entry_points.iter().position(|point| point.name == entry).unwrap();
    let uses = linked.info.get_entry_point(index);
    let mut shared = module.global_variables.iter().filter(|(_, var)| var.space == naga::AddressSpace::WorkGroup);
    let unwritten =
        shared.find(|(handle, _)| uses[*handle].contains(GlobalUse::READ) && !uses[*handle].contains(GlobalUse::WRITE));
    unwritten.map(|(_, var)| var.name.clone().unwrap_or_default())
}

#[test]
fn every_two_features_meet_in_every_way() {
    let library = Library::shipped();
    for pass in TABLE {
        let sets = library.feature_sets(pass.module).unwrap();
        let named: Vec<&String> = sets.iter().flatten().collect::<BTreeSet<_>>().into_iter().collect();
        for (i, first) in named.iter().enumerate() {
            for second in &named[..i] {
                let met: BTreeSet<_> = sets.iter().map(|set| (set.contains(*first), set.contains(*second))).collect();
                assert_eq!(met.len(), 4, "{}: {first} and {second}", pass.name);
            }
        }
        // `lucerna check` tries them all, at some 7 ms each.
        assert!(sets.len() <= 550, "{} has {} sets of features", pass.name, sets.len());
        assert_eq!(sets.iter().collect::<BTreeSet<_>>().len(), sets.len());
    }
}

#[test]
fn every_entry_point_is_in_the_table_and_every_name_once() {
    let library = Library::shipped();
    let mut names = BTreeSet::new();
    for pass in TABLE {
        assert!(names.insert(pass.name), "two passes are named {}", pass.name);
    }
    // What is drawn to a window is linked here too, but is no pass.
    for module in library.modules() {
        let linked = library.link(module, &Features::new()).unwrap_or_else(|error| panic!("{}", error.report()));
        let entries: Vec<&str> = linked.entries().collect();
        for entry in entries.into_iter().filter(|_| !module.starts_with("window/")) {
            let listed = TABLE.iter().any(|pass| pass.entry == entry && linked.imports.contains(pass.module));
            assert!(listed, "{module} has an entry point `{entry}` without a row");
        }
    }
}

/// What an engine records for one purpose, over scenes of every size that changes which passes run.
fn recordings(purpose: Makes) -> Vec<Recording> {
    let record = |work: &dyn Fn(&mut Recording)| {
        let mut recording = Recording::default();
        work(&mut recording);
        recording
    };
    match purpose {
        Makes::Tree => [1, 2, 1000, SORT_TILE * (SORT_FEW_TILES + 1)]
            .map(|count| record(&|recording| (PLAN.record)(recording, &vec![Triangle::default(); count as usize])))
            .into(),
        Makes::Film => {
            let params = TraceParams { window_width: 1, window_height: 1, layers: 1, ..TraceParams::default() };
            vec![record(&|recording| {
                film::record_reset(recording, 1);
                trace::record_reused(recording, &params, 1, false);
                let adding = film::accumulate_params(&params, 0, &params);
                film::record_accumulate(recording, &adding);
                blocks::record(recording, &adding);
                adaptive::record_tally(recording, &TallyParams { runs: 1, ..TallyParams::default() });
            })]
        }
        Makes::Picture => {
            let trace_params = TraceParams { window_width: 1, window_height: 1, ..TraceParams::default() };
            let probed = record(&|recording| {
                probe::record(recording, &trace_params);
                probe::record_colours(recording, &probe::ProbeLook::default().colours(1));
            });
            let others = record(&|recording| {
                film::record_display(
                    recording,
                    &film::display_params(UVec2::ONE, Lattice::default(), 0, film::Look::default()),
                );
                view::record(recording, &ViewParams { trace_params, ..ViewParams::default() });
                debug::record(recording, &TraceParams { layers: 1, ..trace_params });
            });
            vec![probed, others]
        }
    }
}

#[test]
fn a_pass_makes_all_that_it_is_recorded_for_and_nothing_else() {
    for purpose in [Makes::Tree, Makes::Film, Makes::Picture] {
        let recorded: BTreeSet<&str> =
            recordings(purpose).iter().flat_map(|recording| recording.calls()).map(|call| call.pass.name).collect();
        let claimed: BTreeSet<&str> =
            TABLE.iter().filter(|pass| pass.makes.contains(&purpose)).map(|pass| pass.name).collect();
        assert_eq!(recorded, claimed, "{purpose:?}");
    }
}

/// The text of every test.
fn tests_text(folder: &Path) -> String {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let text =
        |path: PathBuf| if path.is_dir() { tests_text(&path) } else { fs::read_to_string(path).unwrap_or_default() };
    entries.map(text).collect()
}

/// That a twin exists is the compiler's to say.
#[test]
fn every_pass_has_a_twin_that_a_test_calls_or_says_why_it_has_none() {
    let tests = tests_text(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests"));
    for pass in TABLE {
        match pass.twin {
            Twin::Is(path) => {
                let mut parts = path.rsplit("::").map(str::trim);
                let (function, module) = (parts.next().unwrap(), parts.last().unwrap());
                let calls = [format!("{function}("), format!("{module}::{function}")];
                let imports = tests.contains(&format!("cpu::{module}")) || tests.contains(&format!("{module}::"));
                assert!(imports && calls.iter().any(|call| tests.contains(call)), "{}: no test of {path}", pass.name);
            }
            Twin::None(why) => assert!(why.split(' ').count() > 3, "{}: `{why}` is no reason", pass.name),
        }
    }
}
