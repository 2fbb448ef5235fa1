//! `lucerna bench peers`: what counts as agreement, who was sooner, and what is said where there is no peer.

use std::process::{Command, Output};

use lucerna::app::bench::light::record::{ConfigurationRecord, Run, Snapshot};
use lucerna::app::bench::peers::Answer;
use lucerna::app::bench::peers::python::numbers;
use lucerna::app::bench::peers::references::{Halves, agreement};
use lucerna::app::bench::peers::verdict::{Spread, Verdict, beside, levels, markdown};

use crate::support::dice::Dice;

/// Names the program of a Python that has Mitsuba: without it, nothing is measured beside it.
const PEER: &str = "LUCERNA_PEER";

/// Pixels of a picture.
const PIXELS: usize = 4096;

/// Two halves of a picture that is `brighter` by a factor, with noise of one part in fifty.
fn halves(brighter: f64, dice: &mut Dice) -> Halves {
    let mut half = || {
        let pixel = |i: usize, dice: &mut Dice| {
            let mean = 0.2 + (i % 7) as f64;
            [0; 3].map(|_| (mean * brighter * (1.0 + 0.02 * dice.normal())) as f32)
        };
        (0..PIXELS).map(|i| pixel(i, dice)).collect::<Vec<_>>()
    };
    Halves { pictures: [half(), half()], seconds: 1.0 }
}

#[test]
fn references_agree_through_their_noise_and_a_planted_error_is_found_in_it() {
    let mut dice = Dice(7);
    for _ in 0..20 {
        let (ours, theirs) = (halves(1.0, &mut dice), halves(1.0, &mut dice));
        let found = agreement(&ours, &theirs, 1e-3);
        // The noise is twice what is to be told.
        assert!(found.agree && found.noise.iter().all(|noise| (1.7e-4..2.2e-4).contains(noise)), "{found:?}");
        assert!(found.difference.abs() < 5.0 * found.standard_error, "{found:?}");
        // One part in fifty is a relMSE of 4e-4.
        let found = agreement(&ours, &halves(1.02, &mut dice), 1e-3);
        assert!(!found.agree && (3e-4..5e-4).contains(&found.difference), "{found:?}");
        assert!((found.mean - 0.02).abs() < 0.002, "{found:?}");
    }
    let broken = Halves { pictures: [vec![[f32::NAN; 3]; 4], vec![[1.0; 3]; 4]], seconds: 1.0 };
    assert!(!agreement(&broken, &broken, 1e-3).agree, "what is no number agrees with nothing");
}

/// Films whose error is 1 at 1 spp and falls as 1 / spp, each at its own seconds a sample.
fn record(name: &str, paces: &[f64]) -> ConfigurationRecord {
    let run = |(seed, pace): (usize, &f64)| {
        let at = |spp: u32| Snapshot {
            spp,
            seconds: pace * f64::from(spp),
            rays: 0,
            relmse: 1.0 / f64::from(spp),
            claimed: None,
        };
        Run { seed: seed as u32, snapshots: [1, 4, 16, 64, 256].map(at).to_vec() }
    };
    ConfigurationRecord::of(name.to_owned(), 0, paces.iter().enumerate().map(run).collect())
}

#[test]
fn ratios_are_run_by_run_with_median_and_spread() {
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
    assert_eq!(levels(1e-3), [1e-1, 1e-2, 1e-3]);
    assert_eq!(levels(5e-3), [1e-1, 1e-2, 5e-3]);
    // All slows down at once in the third run: the ratio does not.
    let (ours, theirs) = (record("path+sobol", &[1.0, 1.1, 10.0]), record("peer", &[2.0, 3.3, 25.0]));
    let found = beside(&ours, &theirs, 1e-3);
    let [first, second, third] = &found.levels[..] else { panic!("{found:?}") };
    let ratio = first.ratio.unwrap();
    assert!(near(ratio.median, 2.5) && near(ratio.least, 2.0) && near(ratio.most, 3.0), "{ratio:?}");
    assert!(near(second.seconds[0].unwrap().median, 110.0), "{second:?}");
    // Nobody came to it.
    assert_eq!((third.ratio, third.seconds), (None, [None, None]));
    assert_eq!(Spread::of(vec![]), None);
}

#[test]
fn a_scene_that_is_not_the_same_has_no_verdict() {
    let mut dice = Dice(3);
    let agreement = agreement(&halves(1.0, &mut dice), &halves(1.2, &mut dice), 1e-3);
    let verdict = Verdict {
        scene: "s".to_owned(),
        peer: "mitsuba 3.9.1, scalar_rgb".to_owned(),
        agreement,
        notes: vec!["a.mtl:3: m: its coat".to_owned()],
        beside: Vec::new(),
    };
    let text = markdown(&[verdict]);
    assert!(text.contains("s: no verdict") && text.contains("a.mtl:3: m: its coat"), "{text}");
    assert_eq!(
        text.lines().filter(|line| line.starts_with('|')).count(),
        2,
        "a row though there is no verdict:\n{text}"
    );
}

#[test]
fn answers_are_read_and_mistakes_are_errors() {
    assert_eq!(Answer::of(r#"{"seconds": 1.5}"#).unwrap().seconds, Some(1.5));
    let error = Answer::of(r#"{"error": "it has no variant x", "known": ["a", "b"]}"#).unwrap_err().to_string();
    assert!(error.contains("no variant x; it has a, b"), "{error}");
    assert!(Answer::of("Traceback").unwrap_err().to_string().contains("Traceback"));
    assert_eq!(
        [numbers("3.9.1"), numbers("3.10"), numbers("0.6"), numbers("three")],
        [Some([3, 9]), Some([3, 10]), Some([0, 6]), None]
    );
}

fn peers(arguments: &[&str]) -> Output {
    let out = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.args(["bench", "peers", "--out"]).arg(out.path()).args(arguments);
    command.output().unwrap()
}

#[test]
fn a_python_that_is_not_there_or_has_no_mitsuba_is_told_with_what_to_do() {
    let run = peers(&["--peer", "no/such/python"]);
    let text = String::from_utf8(run.stderr).unwrap();
    assert!(run.status.code() == Some(1) && text.contains("can't be started") && text.contains("--peer"), "{text}");
    // A program that is no Python knows nothing of `-c` and a module.
    let run = peers(&["--peer", env!("CARGO_BIN_EXE_lucerna")]);
    let text = String::from_utf8(run.stderr).unwrap();
    assert!(run.status.code() == Some(1) && text.contains("-m pip install mitsuba"), "{text}");
}

/// Run by hand: `LUCERNA_PEER=venv/bin/python cargo test --release -- peers`.
#[test]
fn mitsuba_renders_the_same_picture() {
    let Some(python) = std::env::var_os(PEER) else { return };
    let python = python.into_string().unwrap();
    let arguments = ["cornell-data", "--size", "32x32", "--to", "0.03", "--runs", "2", "--json", "-q"];
    let run = peers(&[&arguments[..], &["--variant", "scalar_rgb", "--peer", &python]].concat());
    let (text, said) = (String::from_utf8(run.stdout).unwrap(), String::from_utf8(run.stderr).unwrap());
    assert_eq!(run.status.code(), Some(0), "{said}");
    let value: serde_json::Value = serde_json::from_str(&text).unwrap();
    let verdict = &value["verdicts"][0];
    assert_eq!(verdict["agreement"]["agree"], true, "{verdict}");
    assert!(verdict["agreement"]["mean"].as_f64().unwrap().abs() < 0.01, "{verdict}");
    let levels = verdict["beside"][0]["levels"].as_array().unwrap();
    assert!(levels.iter().any(|level| level["ratio"]["median"].as_f64().is_some_and(|ratio| ratio > 0.0)), "{verdict}");
    // One that asks for what is not the same is told so.
    let arguments = ["glass", "--size", "16x16", "--to", "1", "--runs", "2", "-q", "--variant", "no_such"];
    assert_eq!(peers(&[&arguments[..], &["--peer", &python]].concat()).status.code(), Some(2));
}
