//! The pass table against the WGSL, without a GPU: every row under every feature set in use.

use std::collections::BTreeSet;

use lucerna::passes::table::TABLE;
use lucerna::passes::{Access, Binding, Pass};
use lucerna::shader::{BoundResource, Features, Library, Linked, ResourceKind};

/// More conditions than this in one closure would want a list of the sets in use instead of all sets.
const MOST_FEATURES: usize = 6;

/// Every feature set that makes a difference to a pass.
fn feature_sets(library: &Library, pass: &Pass) -> Vec<Features> {
    let named: Vec<String> = match library.link(pass.module, &library.features().unwrap()) {
        Ok(linked) => linked.features.into_iter().collect(),
        Err(error) => panic!("{}: {}", pass.name, error.report()),
    };
    assert!(named.len() <= MOST_FEATURES, "{} has too many features to try: {named:?}", pass.name);
    (0..1usize << named.len())
        .map(|set| (0..named.len()).filter(|bit| set >> bit & 1 == 1).map(|bit| named[bit].clone()).collect())
        .collect()
}

fn described(bound: &BoundResource) -> (String, Access, String) {
    let access = match bound.kind {
        ResourceKind::StorageRead if bound.name == "params" => Access::Params,
        ResourceKind::StorageRead => Access::Read,
        ResourceKind::StorageReadWrite => Access::Write,
        ResourceKind::Uniform => panic!("`{}` is a uniform; parameters are storage, see Access::Params", bound.name),
    };
    (bound.name.clone(), access, bound.ty.clone())
}

fn check_row(pass: &Pass, linked: &Linked, features: &Features) {
    let entry = linked.entry(pass.entry).unwrap_or_else(|| panic!("{} has no entry `{}`", pass.module, pass.entry));
    let there = |binding: &&Binding| binding.feature.is_empty() || features.contains(binding.feature);
    let mut row: Vec<_> =
        pass.bindings.iter().filter(there).map(|b| (b.name.to_owned(), b.access, b.ty.to_owned())).collect();
    let mut wgsl: Vec<_> = entry.bindings.iter().map(described).collect();
    row.sort_by(|a, b| a.0.cmp(&b.0));
    wgsl.sort_by(|a, b| a.0.cmp(&b.0));
    assert_eq!(row, wgsl, "row (left) and WGSL (right) of {} differ under {features:?}", pass.name);
    assert!(entry.bindings.iter().all(|bound| bound.group == 0), "{} has a group beside 0", pass.name);
    assert!(entry.workgroup_size.iter().product::<u32>() <= 256, "{}: no portable workgroup size", pass.name);
}

#[test]
fn every_entry_point_links_under_every_feature_set_in_use() {
    let library = Library::shipped();
    for pass in TABLE {
        for features in feature_sets(&library, pass) {
            match library.link(pass.module, &features) {
                Ok(linked) => check_row(pass, &linked, &features),
                Err(error) => panic!("{} under {features:?}: {}", pass.name, error.report()),
            }
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
