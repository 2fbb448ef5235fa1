//! Animations that are wrong: each is told of at its place, with what to do.

use lucerna::scene::check;

use super::{folder, run, scene};

/// All that is said of a scene with this under `animate`, by what `lucerna check` does.
fn told(animate: &str) -> Vec<String> {
    let folder = folder(&[("a.ron", &scene(animate))]);
    let found = check(&folder.path().join("a.ron")).diagnostics;
    let text = |text: String| text.replace(&format!("{}/", folder.path().display()), "");
    found.list.iter().map(|found| text(found.to_string())).collect()
}

#[test]
fn what_is_wrong_is_told_where_it_stands() {
    let keys = |keys: &str| format!("(frames: 24, keys: {{ {keys} }})");
    let mut untold = Vec::new();
    for (animate, words) in [
        (
            "(frames: 0, keys: { \"film.exposure\": { 0: 1 } })".into(),
            "a.ron:4:23: error: animate.frames: expected a whole number from 1 to 4096, found `0`",
        ),
        (
            "(frames: 1000000000, keys: { \"film.exposure\": { 0: 1 } })".into(),
            "a.ron:4:23: error: animate.frames: expected a whole number",
        ),
        ("(keys: { \"film.exposure\": { 0: 1 } })".into(), "a.ron:4:14: error: animate: the field `frames` is missing"),
        ("(frames: 24)".into(), "a.ron:4:14: error: animate: the field `keys` is missing"),
        (
            "(frames: 24, fps: 0, keys: { \"film.exposure\": { 0: 1 } })".into(),
            "a.ron:4:32: error: animate.fps: expected a number from 0.1 to 1000",
        ),
        ("(frames: 24, key: { \"film.exposure\": { 0: 1 } })".into(), "did you mean `keys`?"),
        (keys(""), "a.ron:4:33: error: animate.keys: there is nothing that changes"),
        (keys("\"film.exposure\": {}"), "a.ron:4:52: error: keys of `film.exposure`: there is no key"),
        (keys("\"film.exposure\": Smooth({})"), "a.ron:4:59: error: keys of `film.exposure`: there is no key"),
        (keys("\"film.exposure\": 3"), "a.ron:4:52: error: keys of `film.exposure`: expected keys, found `3`"),
        (keys("\"film.exposure\": Smoth({ 0: 1 })"), "write { 0: a, 47: b }, Smooth("),
        (
            keys("\"film.exposure\": { 0: 1, 25: 2 }"),
            "a.ron:4:60: error: keys of `film.exposure`: frame 25 is beyond the end\n    help: frames are 0 to 23;",
        ),
        (
            keys("\"film.exposure\": { 0: 1, \"1.5s\": 2 }"),
            "a.ron:4:61: error: keys of `film.exposure`: frame 36 is beyond the end",
        ),
        (keys("\"film.exposure\": { -1: 1 }"), "a.ron:4:54: error: keys of `film.exposure`: `-1` is no time of a key"),
        (
            keys("\"film.exposure\": { 0.5: 1 }"),
            "a.ron:4:54: error: keys of `film.exposure`: `0.5` is no time of a key",
        ),
        (keys("\"film.exposure\": { \"soon\": 1 }"), "write the number of a frame, as 24, or seconds, as \"1.5s\""),
        (keys("\"film.exposure\": { 0: 1, 7: 2, 7: 3 }"), "a.ron:4:66: error: `7` is given twice"),
        (
            keys("\"film.exposure\": { 12: 1, \"0.5s\": 2 }"),
            "a.ron:4:62: error: keys of `film.exposure`: a second key at frame 12",
        ),
        (
            keys("\"cameras.front.position\": { 0: (0, 0, 1), 4: (0, 1) }"),
            "a.ron:4:80: error: keys of `cameras.front.position`: this has 2 numbers, and the value at frame 0 has 3 numbers",
        ),
        (keys("\"environment\": { 0: Constant(1), 4: Sky(1) }"), "this is of another form than the value at frame 0"),
        (
            keys("\"camera\": { 0: \"front\", 4: \"near\" }"),
            "a.ron:4:50: error: keys of `camera`: expected a value with numbers, which go from key to key\n    help: write Step(",
        ),
        (
            keys("\"animate.fps\": { 0: 1 }"),
            "a.ron:4:36: error: keys of `animate.fps`: what is animated can't itself be",
        ),
        (
            keys(
                "\"cameras.front\": Step({ 0: (position: (0, 0, 1), look_at: (0, 0, 0)) }), \"cameras.front.fov_y\": { 0: 1 }",
            ),
            "`cameras.front` and `cameras.front.fov_y` are changed at once",
        ),
        // What only the scene knows.
        (
            keys("\"cameras.front.positon\": { 0: (0, 0, 1) }"),
            "a.ron:4:50: error: unknown field `cameras.front.positon`\n    help: did you mean `position`?",
        ),
        (
            keys("\"cameras.frnt.position\": { 0: (0, 0, 1) }"),
            "there is no `cameras.frnt` to change\n    help: did you mean `front`?",
        ),
        (keys("\"materials.gray.kd\": { 0: 1 }"), "did you mean `grey`?"),
        (keys("\"models.1.transform.scale\": { 0: 1 }"), "`1` is none of the items 0 to 0"),
        (
            keys("\"cameras.front.fov_y\": { 0: 60, 9: 400 }"),
            // Where the wrong key is, and as it is written.
            "a.ron:4:70: error: cameras.front.fov_y: expected a number from 0.001 to 179, found `400`",
        ),
        (
            keys("\"cameras.front.position\": { 0: (0, 0, 2), 10: (0, 0, -2) }"),
            "`position` and `look_at` are the same point",
        ),
        // What no key has is told by its frame.
        (
            keys("\"render.spp\": { 0: 1, 10: 2 }"),
            "a.ron:4:54: error: at frame 1, between two keys: render.spp: expected a whole number",
        ),
    ] {
        let found = told(&animate);
        // Each mistake once.
        if found.len() > 2 || !found.iter().any(|found| found.contains(words)) {
            untold.push(format!("{animate}: {words}\n{found:#?}"));
        }
    }
    assert!(untold.is_empty(), "{}", untold.join("\n"));
}

#[test]
fn what_is_right_is_not_told_of() {
    for animate in [
        "(frames: 1, keys: { \"film.exposure\": { 0: 1 } })",
        "(frames: 2, fps: 1000, keys: { \"film.exposure\": Smooth({ 2: 1, 0: 0 }), \"camera\": Step({ 0: near, 1: front }) })",
        "(frames: 3, keys: { \"models.0.transform.rotate_y\": { 0: 0, 3: 360 }, \"render.seed\": { 0: 0, 2: 2 } })",
    ] {
        assert_eq!(told(animate), Vec::<String>::new(), "{animate}");
    }
}

/// The command tells the same once, and renders nothing.
#[test]
fn the_command_refuses_what_can_not_be_meant() {
    let folder = folder(&[
        ("a.ron", &scene("(frames: 9, keys: { \"cameras.front.positon\": { 0: (0, 0, 1), 8: (0, 0, 2) } })")),
        ("still.ron", &scene("None")),
    ]);
    let wrong = run(folder.path(), &[]);
    let said = String::from_utf8(wrong.stderr).unwrap();
    assert!(wrong.status.code() == Some(1) && said.matches("error:").count() == 1, "{said}");
    assert!(said.contains("a.ron:4") && said.contains("did you mean `position`?"), "{said}");
    std::fs::write(folder.path().join("a.ron"), scene("(frames: 9, keys: { \"film.exposure\": { 0: 1 } })")).unwrap();
    for (arguments, says) in [
        (&["--frames", "4..4"] as &[&str], "A up to but not B"),
        (&["--frames", "4..99"], "there are only the frames 0 to 8"),
        (&["--frames", "9"], "there are only the frames 0 to 8"),
        (&["--spp", "4", "--time", "1"], "cannot be used with"),
        (&["--shaders", "nowhere"], "there is no folder nowhere"),
    ] {
        let run = run(folder.path(), arguments);
        let said = String::from_utf8(run.stderr).unwrap();
        assert!(run.status.code() == Some(2) && said.contains(says), "{arguments:?}: {said}");
    }
    let slow = run(folder.path(), &["--fps", "0"]);
    assert!(String::from_utf8(slow.stderr).unwrap().contains("animate.fps: expected a number from 0.1 to 1000"));
    std::fs::rename(folder.path().join("still.ron"), folder.path().join("a.ron")).unwrap();
    let still = run(folder.path(), &[]);
    let said = String::from_utf8(still.stderr).unwrap();
    assert!(still.status.code() == Some(1) && said.contains("nothing of this scene is animated"), "{said}");
    assert!(!folder.path().join("result").exists());
}
