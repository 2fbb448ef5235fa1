//! Calls as the linker takes them: names and places, errors, and nothing of them where nobody listens.

use lucerna::passes::probe::PROBE;
use lucerna::passes::replay::REPLAY;
use lucerna::passes::table::TABLE;
use lucerna::passes::trace::PATH;
use lucerna::shader::{ErrorKind, Library};

use super::path_with;
use crate::shader::{features, library};

const PASS: &str = "import package::t::a::double;
@range(0.0, 4.0) override TIMES: f32 = 2.0;
@group(0) @binding(0) var<storage, read_write> out: array<f32>;
@compute @workgroup_size(1)
fn main() {
    let x = TIMES * double(out[0]);
    probe(\"times two\", TIMES * double(x)); // \"no\" name
    @if(some) probe(\"some\", vec2f(x, TIMES));
    if (x > 1.0) { probe(\"above, (one)\", x > 2.0); }
    out[0] = x;
}
";
const DOUBLE: &str =
    "fn double(x: f32) -> f32 { probe(\"doubled\", vec3f(x)); probe(\"times two\", u32(x)); return x * 2.0; }\n";

#[test]
fn names_are_listed_in_order_with_all_their_places() {
    let probes = library(&[("t/p", PASS), ("t/a", DOUBLE)]).probes();
    let listed: Vec<(&str, Vec<String>)> = probes
        .iter()
        .map(|probe| {
            let place = |p: &lucerna::shader::Place| format!("{}:{}:{}", p.source.file, p.line, p.column);
            (probe.name.as_str(), probe.places.iter().map(place).collect())
        })
        .collect();
    let at = |place: &str| format!("shaders/t/{place}");
    assert_eq!(
        listed,
        [
            ("above, (one)", vec![at("p.wgsl:9:20")]),
            ("doubled", vec![at("a.wgsl:1:28")]),
            ("some", vec![at("p.wgsl:8:15")]),
            ("times two", vec![at("a.wgsl:1:56"), at("p.wgsl:7:5")]),
        ]
    );
    assert!(Library::shipped().probes().is_empty());
}

#[test]
fn calls_and_their_arguments_are_nothing_where_nobody_listens() {
    let modules = library(&[("t/p", PASS), ("t/a", DOUBLE)]);
    let bare = |text: &str| -> String {
        let calls =
            ["probe(\"times two\", TIMES * double(x)); // \"no\" name", "@if(some) probe(\"some\", vec2f(x, TIMES));"];
        let others =
            ["probe(\"above, (one)\", x > 2.0);", "probe(\"doubled\", vec3f(x));", "probe(\"times two\", u32(x));"];
        calls.iter().chain(&others).fold(text.to_owned(), |text, call| text.replace(call, ""))
    };
    let without = library(&[("t/p", &bare(PASS)), ("t/a", &bare(DOUBLE))]);
    for on in [&[][..], &["some"]] {
        let [ours, right] = [&modules, &without].map(|library| library.link("t/p", &features(on)).unwrap());
        assert_eq!(ours.fingerprint(), right.fingerprint());
        assert!(!ours.text.contains("probe") && !ours.imports.contains("lib/probe"), "{}", ours.text);
    }
}

#[test]
fn a_call_that_is_heard_has_the_number_of_its_name_and_the_function_of_its_type() {
    let modules = library(&[("t/p", PASS), ("t/a", DOUBLE)]);
    for listener in ["probe_view", "record"] {
        let linked = modules.link("t/p", &features(&[listener, "some"])).unwrap();
        for call in [
            "probe_f32(3u, shader_values.TIMES * double(x));",
            "probe_vec2f(2u, vec2f(x, shader_values.TIMES));",
            "probe_bool(0u, x > 2.0);",
            "probe_vec3f(1u, vec3f(x));",
            "probe_u32(3u, u32(x));",
        ] {
            assert!(linked.text.contains(call), "no `{call}`:\n{}", linked.text);
        }
        assert!(linked.features.contains(listener), "the text is another one than without");
    }
}

/// Each is told by whoever links the module, and whoever listens.
#[test]
fn wrong_calls_are_told_where_they_stand() {
    let body = |call: &str| {
        format!(
            "@group(0) @binding(0) var<storage, read_write> out: array<f32>;\n@compute @workgroup_size(1)\nfn main() {{\n  {call}\n}}\n"
        )
    };
    let long = format!("probe(\"{}\", 1.0);", "n".repeat(41));
    for (call, column, kind, message) in [
        ("probe(name, 1.0);", 9, ErrorKind::Probe, "wants a name in quotes here"),
        ("probe();", 9, ErrorKind::Probe, "wants a name in quotes here"),
        ("probe(\"a\");", 12, ErrorKind::Probe, "wants a comma and a value"),
        ("probe(\"a\", );", 14, ErrorKind::Probe, "wants a value behind the name"),
        ("probe(\"\", 1.0);", 9, ErrorKind::Probe, "1 to 40 characters"),
        ("probe(\"a\\n\", 1.0);", 9, ErrorKind::Probe, "no `\\`"),
        (long.as_str(), 9, ErrorKind::Probe, "1 to 40 characters"),
        ("let x = probe(\"a\", 1.0);", 11, ErrorKind::Probe, "a statement by itself"),
        ("for (; probe(\"a\", 1.0);) {}", 10, ErrorKind::Probe, "a statement by itself"),
        ("probe(\"a\", 1.0) + 2.0;", 19, ErrorKind::Probe, "it wants a `;` here"),
        ("probe(\"a\", 3);", 14, ErrorKind::Probe, "f32, vec2f, vec3f, u32 or bool, and this is i32"),
        ("probe(\"a\", vec4f(1.0));", 14, ErrorKind::Probe, "and this is vec4<f32>"),
        ("probe(\"a\", mat2x2f());", 14, ErrorKind::Probe, "and this is mat2x2<f32>"),
        ("probe(\"a\", out[0] + y);", 23, ErrorKind::Type, "no definition in scope for identifier: `y`"),
        ("probe(\"a\", 1.0, 2.0);", 17, ErrorKind::Syntax, "expected `)`"),
        ("probe(\"a\n\", 1.0);", 9, ErrorKind::Probe, "wants a name in quotes here"),
    ] {
        let modules = library(&[("t/p", &body(call))]);
        for on in [&[][..], &["probe_view"], &["record"]] {
            let error = modules.link("t/p", &features(on)).unwrap_err();
            assert_eq!((error.kind, error.line_column()), (kind, Some((4, column))), "{call} under {on:?}: {error}");
            assert!(error.message.contains(message), "{call} under {on:?}: {error}");
            assert!(kind != ErrorKind::Probe || error.help.is_some(), "{call}");
        }
    }
    let taken = library(&[("t/p", "fn probe(x: f32) {}\n")]).link("t/p", &features(&[])).unwrap_err();
    assert_eq!((taken.kind, taken.line_column()), (ErrorKind::Probe, Some((1, 4))), "{taken}");
    let imported =
        library(&[("t/p", "import package::lib::probe::{probe};\n")]).link("t/p", &features(&[])).unwrap_err();
    assert!(imported.report().contains("needs no import"), "{imported:?}");
}

#[test]
fn more_names_than_a_list_shows_are_refused_at_the_first_that_is_too_much() {
    let calls = |count: usize| -> String {
        let call = |i: usize| format!("  probe(\"n{i:03}\", f32({i}));\n  probe(\"n{i:03}\", true);\n");
        let calls: String = (0..count).map(call).collect();
        format!("@compute @workgroup_size(1)\nfn main() {{\n{calls}}}\n")
    };
    library(&[("t/p", &calls(64))]).link("t/p", &features(&["record"])).unwrap();
    for on in [&[][..], &["record"]] {
        let error = library(&[("t/p", &calls(65))]).link("t/p", &features(on)).unwrap_err();
        assert_eq!((error.kind, error.line_column()), (ErrorKind::Probe, Some((3 + 2 * 64, 3))), "{error}");
        assert!(error.message.contains("`n064` is one of 65 names"), "{error}");
    }
}

/// Every kernel that can be linked links with a call in each module that it is made of, and only those that listen have anything of it.
#[test]
fn any_code_of_the_kernels_may_call() {
    let shipped = Library::shipped();
    let calling =
        shipped.modules().map(str::to_owned).collect::<Vec<_>>().into_iter().fold(shipped.clone(), |library, name| {
            let text = library.text(&name).unwrap().to_owned();
            let is_function = |line: &&str| line.starts_with("fn ") && line.ends_with('{');
            let probe = format!("\n    probe(\"{name}\", 1.0);");
            let is_traced = ["lib/", "passes/trace/"].iter().any(|folder| name.starts_with(folder));
            match text.lines().find(is_function).filter(|_| is_traced && !name.starts_with("lib/probe")) {
                Some(line) => library.with(&name, &text.replacen(line, &format!("{line}{probe}"), 1)),
                None => library,
            }
        });
    assert!(calling.probes().len() > 30, "{:?}", calling.probes().len());
    let mut heard = 0;
    for pass in TABLE {
        let on = features(pass.features);
        let linked = calling.link(pass.module, &on).unwrap_or_else(|error| panic!("{}: {}", pass.name, error.report()));
        let listens = [PROBE.name, REPLAY.name].contains(&pass.name);
        assert_eq!(linked.text.contains("probe_f32("), listens, "{}", pass.name);
        heard += usize::from(listens);
        if !listens {
            let bare = shipped.link(pass.module, &on).unwrap();
            assert_eq!(linked.fingerprint(), bare.fingerprint(), "{}", pass.name);
        }
    }
    assert_eq!(heard, 2);
}

#[test]
fn a_call_in_the_path_changes_nothing_of_the_films_kernel() {
    let edited = path_with(&[
        ("fn finish(state", "fn unused(x: f32) { probe(\"unused\", x); }\nfn finish(state"),
        (
            "    let extent = scene_extent(params.root);\n",
            "    let extent = scene_extent(params.root);\n    probe(\"extent\", extent);\n",
        ),
    ]);
    let mut sets = Library::shipped().feature_sets(PATH.module).unwrap();
    sets.retain(|set| !set.contains("record") && !set.contains("probe_view"));
    for on in sets.iter().step_by(17) {
        let [ours, right] = [&edited, &Library::shipped()].map(|library| library.link(PATH.module, on).unwrap());
        // A function that nobody calls is in the text, and in no kernel.
        let text = ours.text.replace("fn unused(x: f32) {", "").replacen("}\nfn finish(state", "fn finish(state", 1);
        assert!(!text.contains("probe"), "{on:?}");
        assert_eq!(ours.module.functions.len(), right.module.functions.len());
        assert_eq!(ours.module.global_variables.len(), right.module.global_variables.len());
    }
}
