//! Scene files as nobody writes them: any white space, comments anywhere, commas at ends or not.

use lucerna::scene::Assets;
use lucerna::scene::edit::edit;

use super::changes::{KINDS, change};
use super::{assert_same, folder, read};
use crate::support::dice::Dice;

const SCENE: &str = r#"(
    models: [(path: "square.obj", name: "a"), (path: "square.obj", name: "b", transform: (translate: (2, 0, 0)), materials: { "red": (ns: 5) })],
    cameras: {
        "front": (position: (0, 1, 5), look_at: (0, 0, 0), fov_y: 40, focus: Distance(4)),
        "si/*de": (position: (5, 0, 0), look_at: (0, 0, 0), aperture: 0.25, focus: At((0, 0, 0))),
    },
    camera: "front",
    film: (size: (64, 48)),
    render: (),
    lights: { "lamp": Spot(position: (0, 3, 0), look_at: (0, 0, 0), intensity: (9, 8, 7)), "bulb": Point(position: (0, 2, 0), intensity: 4) },
    environment: Sky(sun: (45, 10), ground: 0.2),
    materials: { "red": (kd: (0.5, 0.25, 0.125), ks: 0.5), "b:red": (), "my.mat \"x\"": (pr: 0.5) },
    shader: { "WIDTH": 2, "ON": true },
)"#;

/// The words, strings, numbers and signs of a text.
fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '"' => {
                let mut escaped = false;
                let end = rest[1..].find(|c| {
                    let ends = c == '"' && !escaped;
                    escaped = c == '\\' && !escaped;
                    ends
                });
                2 + end.expect("the end of a string")
            }
            '(' | ')' | '[' | ']' | '{' | '}' | ',' | ':' => 1,
            _ => rest.find(|c: char| " \n()[]{},:".contains(c)).unwrap_or(rest.len()),
        };
        tokens.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    tokens
}

/// The same tokens, set at random. Each comment has a number.
fn scrambled(dice: &mut Dice, comments: f64) -> String {
    let all = tokens(SCENE);
    let mut text = String::new();
    let mut count = 0;
    let mut space = |text: &mut String, dice: &mut Dice| {
        for _ in 0..(dice.unit() * 3.0) as usize {
            let of = if dice.unit() < comments { 3 } else { 0 };
            count += usize::from(of > 0);
            *text += &match of + (dice.unit() * 3.0) as usize {
                0 => " ".to_owned(),
                1 => "\n  ".to_owned(),
                2 => "\t".to_owned(),
                3 => format!("// c{count}; \" }} ), {{ */ /*\n"),
                4 => format!("/* c{count}; , /* nested ) */ \" */"),
                _ => format!("/* c{count};\n // ) */"),
            };
        }
    };
    for (at, token) in all.iter().enumerate() {
        let closes = |token: Option<&&str>| token.is_some_and(|token| matches!(*token, ")" | "]" | "}"));
        let next = all.get(at + 1);
        if *token == "," && closes(next) && dice.unit() < 0.5 {
            continue;
        }
        space(&mut text, dice);
        text += token;
        // A comma more is one where a value ends a block.
        let ends = closes(next) && !matches!(*token, "," | "(" | "[" | "{");
        if ends && dice.unit() < 0.3 {
            space(&mut text, dice);
            text += ",";
        }
    }
    space(&mut text, dice);
    text + "\n"
}

/// The numbers of the comments, in their order.
fn numbers(text: &str) -> Vec<&str> {
    text.split("* c")
        .flat_map(|part| part.split("// c"))
        .skip(1)
        .filter_map(|part| part.split_once(';'))
        .map(|(number, _)| number)
        .collect()
}

#[test]
fn odd_layouts_are_edited_and_keep_their_comments() {
    let assets = Assets::new();
    let mut dice = Dice(7);
    let mut edits = 0;
    for seed in 0..120 {
        let text = scrambled(&mut dice, [0.0, 0.1, 0.5][seed % 3]);
        let folder = folder(&[("s.ron", &text)]);
        let path = folder.path().join("s.ron");
        let (mut before, mut text) = read(&path, &assets);
        for _ in 0..6 {
            let mut after = before.clone();
            for _ in 0..3 {
                change(&mut after, (dice.unit() * KINDS as f64) as usize, &mut dice);
            }
            let old = text.text().expect("a text").to_owned();
            let edited = edit(&text, &before, &after).unwrap_or_else(|error| panic!("{error}\n{old}"));
            assert!(edited.left_out.is_empty(), "{:?}\n{old}\n{}", edited.left_out, edited.text);
            std::fs::write(&path, &edited.text).expect("a file");
            let (again, again_text) = read(&path, &assets);
            assert_same(&again, &after, &edited.text);
            assert_eq!(numbers(&old), numbers(&edited.text), "{old}\n{}", edited.text);
            edits += edited.changed + edited.added;
            (before, text) = (again, again_text);
        }
    }
    assert!(edits > 800, "{edits}");
}
