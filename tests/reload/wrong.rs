//! Wrong edits of every kind: the last good code goes on, the message has its place, and the next good save is taken.

use super::Bench;

const PATH: &str = "shaders/passes/trace/path.wgsl";

/// Makes a wrong edit while samples are traced, checks what is said of it, and that tracing went on; then mends it.
#[track_caller]
fn check(bench: &mut Bench, file: &str, (from, to): (&str, &str), at: &str, message: &str) {
    let before = bench.film();
    let good = bench.read(file);
    assert!(good.contains(from), "{file} has no `{from}`");
    bench.write(file, &good.replace(from, to));
    let (line, column) = place(&bench.read(file), at);
    let (named, found_line, found_column, found) = bench.failed();
    assert_eq!((named.as_str(), found_line, found_column), (file, line, column), "{found}");
    assert!(found.contains(message), "`{found}` does not say `{message}`");
    assert_eq!(bench.engine.problems().len(), 1, "{found} stands until it is mended");
    let after = bench.film();
    assert!(before.pixels == after.pixels && before.spp == after.spp, "{found}: the picture is not what it was");
    bench.write(file, &good);
    assert_eq!(bench.reloaded(), "nothing");
    assert!(bench.engine.problems().is_empty());
    assert!(bench.film().pixels == before.pixels);
}

/// Line and column, from 1, of a text in another.
fn place(text: &str, part: &str) -> (usize, usize) {
    let at = text.find(part).unwrap_or_else(|| panic!("no `{part}`"));
    let line = text[..at].matches('\n').count() + 1;
    (line, at - text[..at].rfind('\n').map_or(0, |newline| newline + 1) + 1)
}

#[test]
fn wrong_shaders_leave_the_picture_and_say_where() {
    let mut bench = Bench::new();
    let bench = &mut bench;
    check(
        bench,
        PATH,
        ("(*state).rays += 1u;", "(*state).rays += ;"),
        ";\n    @if(few_triangles)",
        "expected expression",
    );
    check(bench, PATH, ("(*state).rays += 1u;", "(*state).rays += 1.5f;"), "(*state).rays += 1.5f", "");
    check(bench, PATH, ("import package::lib::fault::{fault_of};", ""), "fault_of((*state)", "`fault_of`");
    check(bench, PATH, ("package::lib::fault::", "package::lib::faults::"), "fault_of};", "no module `lib/faults`");
    check(bench, PATH, ("params", "stuff"), "fn path(", "binds `params`");
    check(
        bench,
        PATH,
        ("@binding(4) var<storage, read_write>", "@binding(2) var<storage, read_write>"),
        "var<storage, read_write> radiance:",
        "@binding(2)",
    );
    check(bench, PATH, ("fn path(", "fn paths("), "// Paths from the camera", "entry point `path`");
    // A module that the scene does not need is checked too.
    let half = ("return cos_theta + sqrt(cos_theta * cos_theta + slope);", "return cos_theta + ;");
    check(bench, "shaders/lib/bsdf/ggx.wgsl", half, ";\n}\n\n// The density D", "expected expression");
    let display = "shaders/passes/display/display.wgsl";
    let written = ("var<storage, read> film", "var<storage, read_write> film");
    check(bench, display, written, written.1, "binds `film` as var<storage, read>");
    let own = "import package::gen::{DisplayParams, TONE_NONE};\nstruct FilmPixel { halves: array<vec2<u32>, 2> }";
    check(
        bench,
        display,
        ("import package::gen::{DisplayParams, FilmPixel, TONE_NONE};", own),
        "FilmPixel {",
        "shared with Rust",
    );
}

#[test]
fn a_loop_without_an_end_is_ended_and_its_place_told() {
    let mut bench = Bench::new();
    let endless = "while ((*state).rays < 4000000000u) { (*state).bounce *= 1u; }";
    let to = format!("(*state).rays += 1u; {endless}");
    check(&mut bench, PATH, ("(*state).rays += 1u;", &to), endless, "this loop does not end");
}

#[test]
fn wrong_scenes_leave_the_picture_and_say_where() {
    let mut bench = Bench::new();
    let bench = &mut bench;
    check(bench, "scene.ron", ("render: (", "render ("), "(integrator", "");
    check(bench, "scene.ron", ("max_depth: 3", "max_deep: 3"), "max_deep", "max_deep");
    check(bench, "scene.ron", ("\"room.obj\"", "\"rom.obj\""), "\"rom.obj\"", "rom.obj");
    check(bench, "room.obj", ("f 5 6 7 8", "f 5 6 7 9"), "9\n", "9");
}

#[test]
fn a_scene_that_the_engine_refuses_gives_way_to_the_last() {
    let mut bench = Bench::new();
    let before = bench.film();
    let good = bench.replace("scene.ron", "exposure: 0.0", "crop: Some((0, 40, 0, 8)), exposure: 0.0");
    let (.., message) = bench.failed();
    assert!(!message.is_empty());
    assert!(bench.film().pixels == before.pixels);
    bench.write("scene.ron", &good);
    bench.reloaded();
    assert!(bench.film().pixels == before.pixels && bench.engine.problems().is_empty());
}

#[test]
fn an_endless_loop_of_the_display_leaves_the_film() {
    let mut bench = Bench::new();
    let before = bench.film();
    let display = "shaders/passes/display/display.wgsl";
    let endless = "while (params.pixels > 0u) { linear *= 1.0; }";
    let good = bench.replace(display, "picture[pixel] =", &format!("{endless}\n    picture[pixel] ="));
    let dispatches = bench.dispatches(|bench| {
        let (file, line, ..) = bench.failed();
        assert_eq!((file.as_str(), line), (display, place(&bench.read(display), endless).0));
    });
    assert!(!dispatches.contains_key("path"), "{dispatches:?}");
    bench.write(display, &good);
    bench.reloaded();
    let after = bench.film();
    assert!(before.pixels == after.pixels && before.picture == after.picture);
}

/// A pipeline outlives edits of comments, and the places of its loops go with the text.
/// The batch that was recorded beside the tree was never traced: its samples are not counted.
#[test]
fn an_endless_loop_of_the_tree_costs_no_sample() {
    let mut bench = Bench::new();
    let more = |bench: &mut Bench, spp: u32| {
        bench.engine.edit(|world| {
            world.query::<&mut lucerna::components::Render>().iter_mut(world).for_each(|mut render| render.spp = spp);
        });
    };
    more(&mut bench, u32::MAX);
    bench.step();
    let nodes = "shaders/passes/tree/nodes.wgsl";
    let from = "    let origin = Origin(node,";
    let endless = "var rounds = 0u; while (params.count > 0u) { rounds += 1u; }";
    bench.replace(nodes, from, &format!("    {endless}\n{from}"));
    let (file, .., message) = bench.failed();
    assert!(file == nodes && message.contains("does not end"), "{file}: {message}");
    let spp = bench.engine.samples().0 + 8;
    more(&mut bench, spp);
    let mut fresh = Bench::new();
    more(&mut fresh, spp);
    fresh.finish();
    assert!(bench.film().pixels == fresh.film().pixels);
}

#[test]
fn a_loop_is_told_where_it_is_now() {
    use lucerna::components::{Film, Render};
    let mut bench = Bench::new();
    // Nothing loops until there is a tenth sample.
    let from = "(*state).rays += 1u;";
    let endless = "while ((*state).key.index >= 5u) { (*state).bounce *= 1u; }";
    bench.replace(PATH, from, &format!("{from}\n{endless}"));
    assert_eq!(bench.reloaded(), "film");
    bench.finish();
    bench.replace(PATH, "// Paths from", "// One\n// two\n// three\n// Paths from");
    assert_eq!(bench.reloaded(), "nothing");
    bench.engine.edit(|world| {
        let mut films = world.query_filtered::<&mut Render, bevy_ecs::prelude::With<Film>>();
        films.iter_mut(world).for_each(|mut render| render.spp = 40);
    });
    let (file, line, ..) = bench.failed();
    assert_eq!((file.as_str(), line), (PATH, place(&bench.read(PATH), endless).0));
}

#[test]
fn a_scene_that_first_asks_for_an_endless_loop_gives_way_to_the_last() {
    let mut bench = Bench::new();
    let before = bench.film();
    let file = "shaders/lib/bsdf/dielectric.wgsl";
    let squeeze = "return (at.a / at.b) * (at.a / at.b);";
    let endless = "var a = at.a; while (a > 0.0) { a = at.a + at.b; } return a;";
    let good = bench.replace(file, squeeze, endless);
    assert_eq!(bench.reloaded(), "nothing");
    let mtl = bench.replace("room.mtl", "Kd 0.5 0.5 0.5", "Kd 0.5 0.5 0.5\nillum 7\nNi 1.5");
    let (found, .., message) = bench.failed();
    assert!(found == file && message.contains("does not end"), "{found}: {message}");
    assert!(bench.film().pixels == before.pixels || bench.engine.report().unwrap().bad_samples == 0);
    bench.write(file, &good);
    bench.reloaded();
    bench.write("room.mtl", &(mtl + "# mended\n"));
    bench.reloaded();
    assert!(bench.film().pixels == before.pixels && bench.engine.problems().is_empty());
}

#[test]
fn the_good_half_of_a_burst_is_taken_up_and_told_before_the_other() {
    use lucerna::watch::ReloadEvent;
    let mut bench = Bench::new();
    bench.replace("shaders/lib/sampling.wgsl", "return Angle(sqrt(1.0 - u)", "return Angle(0.5 * sqrt(1.0 - u)");
    bench.replace("scene.ron", "max_depth: 3", "max_deep: 3");
    let names = |files: &[std::path::PathBuf]| -> Vec<String> {
        files.iter().map(|file| file.file_name().unwrap().to_string_lossy().into_owned()).collect()
    };
    let good = bench.wait("reload", |event| match event {
        ReloadEvent::Reloaded { files, .. } => Some(names(files)),
        ReloadEvent::Failed { .. } => panic!("told first"),
        _ => None,
    });
    assert_eq!(good, ["sampling.wgsl"]);
    let bad = bench.wait("failure", |event| match event {
        ReloadEvent::Failed { files, .. } => Some(names(files)),
        _ => None,
    });
    assert_eq!(bad, ["scene.ron"]);
}
