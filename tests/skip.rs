//! What a scene does not need is not compiled, and having it compiled in changes no picture.

use std::collections::BTreeSet;
use std::path::Path;
use std::time::Duration;

use lucerna::Engine;
use lucerna::passes::features::FEATURES;
use lucerna::passes::trace::{GATHER, PATH};
use lucerna::scene::{self, Define};
use lucerna::shader::Library;
use lucerna::stats::metrics::relative_mse;

use crate::support;

/// Features of the device, of a replay, of a probe's view, or of a look at the error's sources, not of scenes.
const OF_OTHERS: [&str; 6] = ["ballots", "halves", "probe_view", "record", "software", "sources"];

#[test]
fn the_list_has_every_feature_of_the_trace_kernels() {
    let library = Library::shipped();
    let all = library.features().unwrap();
    let named: BTreeSet<String> =
        [&PATH, &GATHER].into_iter().flat_map(|pass| library.link(pass.module, &all).unwrap().features).collect();
    let of_scenes: Vec<&str> = named.iter().map(String::as_str).filter(|name| !OF_OTHERS.contains(name)).collect();
    assert_eq!(of_scenes, FEATURES.map(|feature| feature.name));
}

#[test]
fn what_could_be_idle_changes_no_film() {
    for name in ["cornell-box-original", "glass", "teapot-daylight"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(name).with_extension("ron");
        let changes = [("film.size", "(48,32)"), ("render.spp", "4")].map(|(path, value)| Define::given(path, value));
        let description = scene::load(&path, &changes).unwrap_or_else(|error| panic!("{error:?}")).description;
        let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
        let mut film = |general: bool| {
            engine.set_general(general);
            while !engine.step(Duration::from_millis(100)).unwrap().finished {}
            (engine.film().unwrap().rgb, engine.features().clone())
        };
        let (needed, features) = film(false);
        let (general, more) = film(true);
        let idle = FEATURES.iter().filter(|feature| feature.can_be_idle);
        assert!(idle.clone().all(|feature| more.contains(feature.name)));
        assert!(features.is_subset(&more) && features != more, "{name}: {features:?}");
        let difference = relative_mse(&general, &needed);
        assert!(difference < 1e-6, "{name}: a relMSE of {difference:.1e}");
        assert_eq!(film(false), (needed, features), "{name}: as before");
    }
}
