//! The path kernel against its f64 twin.

use lucerna::shader::{Features, Library};

/// Every feature that the kernel knows.
const FEATURES: [&str; 5] = ["emitters", "environment", "glossy", "normals", "roulette"];

#[test]
fn links_under_every_set_of_features() {
    let library = Library::embedded();
    for set in 0..1u32 << FEATURES.len() {
        let features: Features =
            FEATURES.iter().enumerate().filter(|(i, _)| set >> i & 1 != 0).map(|(_, f)| f.to_string()).collect();
        library.link("passes/trace/path", &features).unwrap_or_else(|error| panic!("{features:?}: {error}"));
    }
    for module in ["passes/film/accumulate", "passes/display/display"] {
        library.link(module, &Features::new()).unwrap_or_else(|error| panic!("{error}"));
    }
}
