//! Variant files that are wrong: each is told of at its place, with what to do.

use super::planning::{SCENE, folder, load_all, planned, with_family};

/// The one error of a file, as it is shown.
fn error(text: &str) -> String {
    let folder = with_family(text);
    let found = planned(folder.path()).expect_err("the file is wrong");
    assert_eq!(found.list.len(), 1, "{found:?}");
    let shown = found.list[0].to_string();
    assert!(found.list[0].help.is_some(), "{shown}: no help");
    shown.replace(&format!("{}/", folder.path().display()), "")
}

fn sweep(text: &str) -> String {
    error(&format!("(\n    extends: \"a.ron\",\n    sweep: {{ {text} }},\n)"))
}

#[test]
fn wrong_sweeps_are_told_where_they_stand() {
    for (text, words) in [
        ("", "v.ron:3:12: error: sweep: there is nothing to go through"),
        (r#""film.exposure": []"#, "v.ron:3:31: error: sweep of `film.exposure`: there is nothing to go through"),
        (
            r#""film.exposure": 3"#,
            "v.ron:3:31: error: sweep of `film.exposure`: expected what to go through, found `3`",
        ),
        (
            r#""film.exposure": range(1, 2, 0)"#,
            "v.ron:3:43: error: sweep of `film.exposure`: range: how many: expected a whole number",
        ),
        (r#""film.exposure": range(1, 2)"#, "range: expected three numbers, found 2 values"),
        (
            r#""film.exposure": log(0, 2, 3)"#,
            "v.ron:3:35: error: sweep of `film.exposure`: log: both ends must be above 0",
        ),
        (
            r#""film.exposure": [1, 2, 1]"#,
            "v.ron:3:38: error: sweep of `film.exposure`: a second value named `1`, as in line 3",
        ),
        (
            r#""both": zip({ "film.exposure": [1, 2], "render.seed": [1] })"#,
            "zip: `render.seed` has 1 values, and `film.exposure` has 2",
        ),
        (
            r#""a": range(0, 1, 1000), "b": range(0, 1, 1000)"#,
            "v.ron:3:15: error: 1000000 members, where at most 4096 are rendered: `a` has 1000, `b` has 1000",
        ),
    ] {
        let shown = sweep(text);
        assert!(shown.contains(words), "{text}: {shown}");
    }
}

#[test]
fn wrong_files_are_told_where_they_stand() {
    for (text, words) in [
        (r#"(sweep: { "film.exposure": [1] })"#, "v.ron: error: the field `extends` is missing"),
        (r#"(extends: "a.ron", overrides: {}, )"#, "v.ron: error: nothing is varied"),
        (r#"(extends: "b.ron", sweep: { "film.exposure": [1] })"#, "v.ron:1:11: error: there is no file `"),
        (r#"(extends: "a.ron", swep: {}, sweep: { "film.exposure": [1] })"#, "v.ron:1:20: error: unknown field `swep`"),
        (r#"(extends: "a.ron", members: { "m": {}, "M": {} })"#, "v.ron:1:41: error: two members are named `M`"),
        (
            r#"(extends: "a.ron", members: { "a/b": {} })"#,
            "v.ron:1:32: error: members: `a/b` can't be the name of a file",
        ),
        (
            r#"(extends: "a.ron", sweep: { "film.exposure": [1] }, members: { "1": {} })"#,
            "error: two members are named `1`",
        ),
        (
            r#"(extends: "a.ron", sweep: { "film.exposure": [1] }, reference: "2")"#,
            "v.ron:1:64: error: reference: there is no member `2`",
        ),
    ] {
        let shown = error(text);
        assert!(shown.contains(words), "{text}: {shown}");
    }
}

#[test]
fn a_chain_without_an_end_is_shown() {
    let folder = folder(&[
        ("a.ron", SCENE),
        ("v.ron", r#"(extends: "w.ron", sweep: { "film.exposure": [1] })"#),
        ("w.ron", r#"(extends: "x.ron", sweep: { "film.exposure": [1] })"#),
        ("x.ron", r#"(extends: "v.ron", sweep: { "film.exposure": [1] })"#),
    ]);
    let found = planned(folder.path()).unwrap_err();
    let shown = found.list[0].to_string();
    assert!(
        shown.contains("x.ron:1:11: error: v.ron extends w.ron extends x.ron extends v.ron: this chain has no end"),
        "{shown}"
    );
}

#[test]
fn a_path_that_leads_nowhere_is_told_in_the_variant_file() {
    for (path, place, words) in [
        ("film.exposur", 28, "unknown field `film.exposur`"),
        ("materials.b.ns", 28, "`b`"),
        ("materials.a.map_kd.scale", 28, "map_kd"),
    ] {
        let folder = with_family(&format!(r#"(extends: "a.ron", sweep: {{ "{path}": [1, 2] }})"#));
        let family = planned(folder.path()).unwrap();
        let all = load_all(&family);
        assert_eq!(all.len(), 2);
        for (name, errors) in all {
            let errors = errors.unwrap_or_else(|| panic!("{path}, {name}: loaded"));
            let shown = errors[0].to_string();
            assert!(
                errors[0].file.ends_with("v.ron") && errors[0].line == 1 && errors[0].column >= place,
                "{path}: {shown}"
            );
            assert!(shown.contains(words), "{path}: {shown}");
        }
    }
}

#[test]
fn one_member_that_is_wrong_leaves_the_others() {
    let folder = with_family(r#"(extends: "a.ron", sweep: { "render.max_depth": [1, 0, 3] })"#);
    let family = planned(folder.path()).unwrap();
    let wrong: Vec<bool> = load_all(&family).iter().map(|(_, errors)| errors.is_some()).collect();
    assert_eq!(wrong, [false, true, false]);
    let shown = load_all(&family)[1].1.as_ref().unwrap()[0].to_string();
    assert!(shown.contains("v.ron:1:53: error: ") && shown.contains("render.max_depth"), "{shown}");
}

#[test]
fn two_axes_over_one_value_are_refused_where_the_second_is() {
    for (sweep, paths) in [
        (r#""film.exposure": [2, 3], "film": [(size: (16, 16)), (size: (8, 8))]"#, "`film.exposure` and `film`"),
        (r#""film": [(exposure: 1)], "both": zip({ "film.exposure": [2, 3] })"#, "`film` and `film.exposure`"),
    ] {
        let folder = with_family(&format!(r#"(extends: "a.ron", sweep: {{ {sweep} }})"#));
        let errors = planned(folder.path()).unwrap_err();
        let shown = errors.list[0].to_string();
        assert!(shown.contains("v.ron:1:") && shown.contains(&format!("{paths} are changed at once")), "{shown}");
    }
    // A name that only begins alike is another path.
    let folder = with_family(r#"(extends: "a.ron", sweep: { "materials.a.k": [1], "materials.a.kd": [2] })"#);
    assert_eq!(planned(folder.path()).unwrap().members.len(), 1);
}

#[test]
fn a_folder_of_shaders_that_is_missing_marks_its_member() {
    let folder = with_family(r#"(extends: "a.ron", sweep: { "shaders": [None, "nope"] })"#);
    let family = planned(folder.path()).unwrap();
    let [right, wrong] = &load_all(&family)[..] else { panic!() };
    assert!(right.1.is_none());
    let shown = wrong.1.as_ref().unwrap()[0].to_string();
    assert!(shown.contains("v.ron:1:47") && shown.contains("shaders: there is no folder"), "{shown}");
}

/// A value that no shader has is told by `check` too, though no device is opened.
#[test]
fn check_tells_of_values_that_no_shader_has() {
    let folder = with_family(r#"(extends: "a.ron", sweep: { "shader.NO_SUCH_VALUE": [1, 2] })"#);
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lucerna"));
    let run = command.args(["check", "v.ron"]).current_dir(folder.path()).output().unwrap();
    let said = String::from_utf8(run.stderr).unwrap();
    assert!(run.status.code() == Some(1) && said.contains("NO_SUCH_VALUE") && said.contains("v.ron:1:"), "{said}");
}
