//! The pass table against the WGSL, without a GPU: every row under every feature set in use.

use std::collections::BTreeSet;

use lucerna::gpu::checked_entry;
use lucerna::passes::table::TABLE;
use lucerna::shader::{Features, Library};

#[test]
fn every_row_is_what_its_shader_uses_under_every_feature_set() {
    let library = Library::shipped();
    for pass in TABLE {
        let sets =
            library.feature_sets(pass.module).unwrap_or_else(|error| panic!("{}: {}", pass.name, error.report()));
        assert!(sets.len().is_power_of_two(), "{} has too many features to try every set", pass.name);
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
fn every_entry_point_is_in_the_table_and_every_name_once() {
    let library = Library::shipped();
    let mut names = BTreeSet::new();
    for pass in TABLE {
        assert!(names.insert(pass.name), "two passes are named {}", pass.name);
    }
    for module in library.modules() {
        let linked = library.link(module, &Features::new()).unwrap_or_else(|error| panic!("{}", error.report()));
        let entries: Vec<&str> = linked.entries().collect();
        for entry in entries {
            let listed = TABLE.iter().any(|pass| pass.entry == entry && linked.imports.contains(pass.module));
            assert!(listed, "{module} has an entry point `{entry}` without a row");
        }
    }
}
