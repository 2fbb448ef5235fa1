//! What each kind of edit makes start anew, by the dispatches that follow it.

use super::Bench;

/// Makes an edit; returns what the reload says it restarts, and the passes that ran until the film was finished again.
#[track_caller]
fn after(bench: &mut Bench, file: &str, from: &str, to: &str) -> (String, Vec<&'static str>) {
    let mut restarts = String::new();
    let dispatches = bench.dispatches(|bench| {
        bench.replace(file, from, to);
        restarts = bench.reloaded();
    });
    (restarts, dispatches.into_keys().collect())
}

const FILM: [&str; 3] = ["accumulate", "display", "path"];

const TREE: [&str; 12] = [
    "bounds",
    "clear",
    "leaves",
    "morton",
    "nodes",
    "pyramid",
    "sort_agree",
    "sort_count",
    "sort_plan",
    "sort_scan",
    "sort_scatter",
    "treelets",
];

#[test]
fn an_edit_restarts_what_depends_on_it_and_no_more() {
    let mut bench = Bench::new();
    let bench = &mut bench;
    let is_tree = |passes: &[&str]| {
        passes.iter().all(|pass| TREE.contains(pass) || pass.starts_with("sort"))
            && ["bounds", "morton", "nodes", "treelets"].iter().all(|pass| passes.contains(pass))
    };

    let comment = after(bench, "shaders/lib/sampling.wgsl", "// Cosine-weighted", "// Weighted by the cosine");
    assert_eq!(comment, ("nothing".into(), vec![]), "a comment");
    let unused = after(bench, "shaders/lib/bsdf/ggx.wgsl", "fn ", "fn unused_here() {}\nfn ");
    assert_eq!(unused, ("nothing".into(), vec![]), "code that the scene does not need");
    let touched = after(bench, "scene.ron", "models:", "models :");
    assert_eq!(touched, ("nothing".into(), vec![]), "white space of a scene");

    let display = after(bench, "shaders/passes/display/display.wgsl", "srgb8(linear)", "srgb8(linear * 0.5)");
    assert_eq!(display, ("picture".into(), vec!["display"]), "display code");
    let exposure = after(bench, "scene.ron", "exposure: 0.0", "exposure: 1.0");
    assert_eq!(exposure, ("picture".into(), vec!["display"]), "exposure");

    let (restarts, passes) =
        after(bench, "shaders/lib/sampling.wgsl", "return Angle(sqrt(1.0 - u)", "return Angle(0.5 * sqrt(1.0 - u)");
    assert_eq!((restarts.as_str(), passes.as_slice()), ("film", FILM.as_slice()), "trace code");
    let (restarts, passes) = after(bench, "room.mtl", "Kd 0.5 0.5 0.5", "Kd 0.4 0.5 0.5");
    assert_eq!((restarts.as_str(), passes.as_slice()), ("film", FILM.as_slice()), "a material's numbers");
    let (restarts, passes) = after(bench, "scene.ron", "look_at: (0, 1, 0)", "look_at: (0, 1.1, 0)");
    assert_eq!((restarts.as_str(), passes.as_slice()), ("film", FILM.as_slice()), "a camera");
    let (restarts, passes) = after(bench, "scene.ron", "(24, 16)", "(16, 24)");
    assert_eq!((restarts.as_str(), passes.as_slice()), ("film", FILM.as_slice()), "the film's size");
    let (_, passes) = after(bench, "scene.ron", "spp: 4", "spp: 6");
    assert_eq!(passes, ["accumulate", "display", "path"], "more samples");

    let (restarts, passes) = after(
        bench,
        "shaders/passes/morton/morton.wgsl",
        "fn cells_per_metre(extent: f32) -> f32 {\n",
        "fn cells_per_metre(extent: f32) -> f32 {\n    if (extent < 0.0) { return 1.0; }\n",
    );
    assert_eq!(restarts, "tree", "build code");
    assert!(is_tree(&passes), "build code: {passes:?}");

    let (restarts, passes) = after(bench, "room.obj", "v -1 2 -1", "v -1 2.5 -1");
    assert_eq!(restarts, "tree and film", "a vertex");
    assert!(passes.contains(&"path") && passes.contains(&"morton"), "a vertex: {passes:?}");
    let (restarts, passes) =
        after(bench, "scene.ron", "\"room.obj\")", "\"room.obj\", transform: (translate: (0.1, 0, 0)))");
    assert_eq!(restarts, "tree and film", "a transform");
    assert!(passes.contains(&"path") && passes.contains(&"morton"), "a transform: {passes:?}");

    // All of them together end where a fresh engine begins.
    assert!(bench.film().pixels == bench.fresh_film().pixels);
}

#[test]
fn what_is_edited_beside_the_files_survives_a_reload_of_other_things() {
    use lucerna::components::{Camera, Material};
    let mut bench = Bench::new();
    bench.engine.edit(|world| {
        let mut cameras = world.query::<&mut Camera>();
        cameras.iter_mut(world).for_each(|mut camera| camera.position.x = 0.7);
    });
    bench.replace("room.mtl", "Ke 3 3 3", "Ke 5 5 5");
    assert_eq!(bench.reloaded(), "film");
    let (x, brightest) = bench.engine.edit(|world| {
        let x = world.query::<&Camera>().iter(world).next().unwrap().position.x;
        (x, world.query::<&Material>().iter(world).map(|material| material.emission.x).fold(0.0, f32::max))
    });
    assert_eq!((x, brightest), (0.7, 5.0));
    // A camera that is itself edited in the file is the file's.
    bench.replace("scene.ron", "position: (0, 1, 5)", "position: (0, 1, 6)");
    assert_eq!(bench.reloaded(), "film");
    let position = bench.engine.edit(|world| world.query::<&Camera>().iter(world).next().unwrap().position);
    assert_eq!(position.to_array(), [0.0, 1.0, 6.0]);
}

/// Whoever built the tree before: an edit of its passes takes effect, is told as any other, and can be taken back.
#[test]
fn code_of_the_tree_takes_effect_and_goes_back() {
    let mut bench = Bench::new();
    let before = bench.film();
    let nodes = "shaders/passes/tree/nodes.wgsl";
    let (restarts, passes) = after(&mut bench, nodes, "// The box of the leaves", "// The box of all leaves");
    assert_eq!((restarts.as_str(), passes.as_slice()), ("nothing", [].as_slice()), "a comment");
    let far = "result.low += vec4<f32>(64.0);\n    return result;\n";
    let (restarts, passes) = after(&mut bench, nodes, "return result;\n", far);
    assert!(restarts == "tree" && passes.contains(&"nodes"), "{restarts}: {passes:?}");
    // Boxes far away hide what is in them from a film that is begun after.
    let (restarts, _) = after(&mut bench, "scene.ron", "spp: 4", "spp: 3");
    assert!(!restarts.is_empty());
    assert!(bench.film().pixels == bench.fresh_film().pixels && bench.film().rgb != before.rgb);
    let (restarts, passes) = after(&mut bench, nodes, far, "return result;\n");
    assert_eq!(restarts, "tree");
    assert!(passes.is_empty() || passes.contains(&"nodes"), "{passes:?}");
    after(&mut bench, "scene.ron", "spp: 3", "spp: 4");
    after(&mut bench, "scene.ron", "look_at: (0, 1, 0)", "look_at: (0, 1.1, 0)");
    after(&mut bench, "scene.ron", "look_at: (0, 1.1, 0)", "look_at: (0, 1, 0)");
    assert!(bench.film().pixels == before.pixels);
}
