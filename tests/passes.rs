//! The pass table against the WGSL, without a GPU: every row under many sets of features.

use std::collections::BTreeSet;

use lucerna::gpu::checked_entry;
use lucerna::passes::table::TABLE;
use lucerna::shader::{Features, Library};

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
        }
    }
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
        // A link takes 25 ms; so many are tried by `lucerna check` in three seconds.
        assert!(sets.len() <= 125, "{} has {} sets of features", pass.name, sets.len());
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
