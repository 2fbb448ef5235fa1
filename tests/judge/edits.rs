//! `lucerna judge` by running it: verdicts on shaders of which one line was edited.
//!
//! Pictures are small, since a processor traces a tenth of a million samples a second while all tests run.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use lucerna::shader::Library;
use serde_json::Value;
use tempfile::TempDir;

use super::table::{self, Change, edited_all};
use crate::support::stress;

/// Copies the shaders, and replaces text that stands in so many places of one of them.
fn edited(module: &str, text: &str, replacement: &str, places: usize) -> TempDir {
    edited_all(&[Change { module, text, replacement, places }])
}

/// What a run printed, after a check of its exit code.
struct Ran {
    stdout: String,
    stderr: String,
}

impl Ran {
    fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {}", self.stdout))
    }
}

/// Judges a small Cornell box.
fn judge(code: i32, new: &Path, size: &str, more: &[&str]) -> Ran {
    judge_by(code, new, &[&["--size", size], more].concat())
}

/// Judges the Cornell box.
fn judge_by(code: i32, new: &Path, more: &[&str]) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.args(["judge", "cornell-box", "--quiet", "--new"]).arg(new).args(more);
    let run = command.current_dir(env!("CARGO_MANIFEST_DIR")).stdin(Stdio::null()).output().unwrap();
    let [stdout, stderr] = [run.stdout, run.stderr].map(|text| String::from_utf8(text).unwrap());
    assert_eq!(run.status.code(), Some(code), "{more:?} said:\n{stdout}{stderr}");
    Ran { stdout, stderr }
}

/// Directions are drawn by the cosine, and weighted as if they were drawn evenly: surfaces reflect a third too much.
#[test]
fn a_wrong_pdf_is_called_wrong() {
    let new = edited("lib/bsdf/lambert", "return INV_PI * cos_theta;", "return 0.5 * INV_PI;", 1);
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("marked.png");
    let more = ["--spp", "1", "--films", "1024", "--json", "-o", picture.to_str().unwrap()];
    let found = judge(5, new.path(), "48x48", &more).json();
    assert_eq!(found["ended"], "means differ", "{found}");
    assert!(found["verdict"].as_str().unwrap().ends_with("the new one is brighter"), "{found}");
    assert!(found["means"]["whole"]["relative"].as_f64().unwrap() > 0.02, "{found}");
    // Nothing else in the picture is of that very orange.
    let marked = image::open(&picture).unwrap().to_rgb8();
    let orange = marked.pixels().filter(|pixel| pixel.0 == [230, 97, 1]).count();
    let blocks = found["means"]["differing"].as_array().unwrap().len();
    assert!((orange > 0) == (blocks > 0), "{orange} pixels for {blocks} blocks");
    assert_eq!(marked.dimensions(), (48, 48));
}

/// Half of the light that is asked for is lost: seen at the first look that can see.
#[test]
fn a_lost_light_is_called_darker_wherever_it_shone() {
    let new = edited(
        "passes/trace/connect",
        "radiance, light.triangle, point, end)",
        "0.5 * radiance, light.triangle, point, end)",
        1,
    );
    let ran = judge(5, new.path(), "32x32", &["--spp", "2", "--films", "256", "-D", "render.max_depth=2"]);
    assert!(ran.stdout.starts_with("means differ: ") && ran.stdout.contains("darker"), "{}", ran.stdout);
    assert!(ran.stdout.contains(" of 64 blocks"), "{}", ran.stdout);
}

/// Of direct light alone, stratified samples are worth far more than independent ones.
#[test]
fn a_better_sampler_is_called_better_and_not_wrong() {
    let old = edited("lib/rng", "sobol)", "never)", 5);
    let more = ["--spp", "16", "--films", "64", "--within", "5", "--json", "-D", "render.max_depth=2", "--old"];
    let more = [&more[..], &[old.path().to_str().unwrap()]].concat();
    let found = judge(0, Path::new("shaders"), "24x24", &more).json();
    let of = |key: &str| found["efficiency"][key].as_f64().unwrap();
    assert!(of("low") > 1.0 && of("low") < of("ratio") && of("ratio") < of("high"), "{found}");
}

#[test]
fn comments_change_nothing() {
    let new = edited("lib/rng", "fn sample_1d(", "/* one\n number */ fn  sample_1d( // of a sample\n", 1);
    let ran = judge(0, new.path(), "32x32", &[]);
    assert_eq!(ran.stdout, "nothing changed in what this scene runs\n");
    let json = judge(0, new.path(), "32x32", &["--json"]).json();
    assert_eq!(json["changed"], false);
    // Judged all the same, by seeds of their own, they are found equal, and not because their films are.
    let forced =
        judge(0, new.path(), "24x24", &["--force", "--spp", "1", "--films", "64", "--within", "60", "--json"]).json();
    assert!(forced["means"]["told"] == true && forced["means"]["differ"] == false, "{forced}");
    assert!(forced["means"]["whole"]["difference"].as_f64().unwrap() != 0.0, "{forced}");
    // What a scene lacks does not count either: nothing here is glass.
    let glass = edited("lib/bsdf/dielectric", "// A crossing from", "const UNUSED_HERE = 1;\n// A crossing from", 1);
    assert_eq!(judge(0, glass.path(), "32x32", &[]).stdout, "nothing changed in what this scene runs\n");
}

#[test]
fn a_broken_shader_is_told_where_it_is_broken() {
    let new = edited("lib/sampling", "return Angle(sqrt(1.0 - u), sqrt(u));", "return Angle(sqrt(1.0 - u), u5);", 1);
    let ran = judge(1, new.path(), "32x32", &[]);
    assert!(ran.stderr.contains("lib/sampling.wgsl:13:") && ran.stderr.contains("error:"), "{}", ran.stderr);
    assert!(ran.stdout.is_empty(), "{}", ran.stdout);
    let ran = judge(1, Path::new("no-such-folder"), "32x32", &[]);
    assert!(ran.stderr.contains("no-such-folder"), "{}", ran.stderr);
}

#[test]
fn too_few_films_tell_nothing() {
    let new = edited("lib/rng", "fn sample_1d(", "fn  sample_1d(", 1);
    let ran = judge(6, new.path(), "32x32", &["--force", "--spp", "4", "--films", "30"]);
    assert!(ran.stdout.contains("30 films of each at 32x32 are too few to tell of means"), "{}", ran.stdout);
    assert!(!ran.stdout.contains("efficient") && !ran.stdout.contains("relMSE"), "{}", ran.stdout);
    judge(2, new.path(), "32x32", &["--alpha", "2"]);
    judge(2, new.path(), "32x32", &["--within", "0"]);
    judge(2, new.path(), "32x32", &["--camera", "nowhere"]);
}

/// What is wrong by less than could be seen is not praised: it is said what would have been seen, and when one percent would be.
#[test]
fn a_mistake_below_the_power_is_not_praised() {
    let new = edited("lib/bsdf/lambert", "INV_PI * cos_theta)", "0.99 * INV_PI * cos_theta)", 1);
    let more = ["--spp", "1", "--films", "64"];
    let said = judge(6, new.path(), "24x24", &more).stdout;
    assert!(said.starts_with("can't tell: a difference of at least ") && said.contains("0.50 % takes "), "{said}");
    assert!(!said.contains("efficient") && !said.contains("agree") && !said.contains("relMSE"), "{said}");
    let found = judge(6, new.path(), "24x24", &[&more[..], &["--json"]].concat()).json();
    assert!(found["efficiency"].is_null() && found["new"]["relmse"].is_null() && found["means"]["told"] == false);
    assert!(found["means"]["least_found"].as_f64().unwrap() > 0.01, "{found}");
    assert!(found["means"]["seconds_to_within"].as_f64().unwrap() > found["seconds"].as_f64().unwrap(), "{found}");
}

/// Nothing is said of size, samples or time but that there is plenty: a person's first try. The small films that come first show it.
#[test]
fn gross_mistakes_are_found_by_small_films_first() {
    for edit in table::WRONG.iter().filter(|edit| edit.gross) {
        let new = edited_all(edit.changes);
        let found = judge_by(5, new.path(), &["--time", "3000", "--json"]).json();
        assert_eq!(found["size"], serde_json::json!([32, 32]), "{}: {found}", edit.name);
        assert_eq!(found["films"], 32, "{}: {found}", edit.name);
        assert!(found["efficiency"].is_null(), "{}: {found}", edit.name);
    }
}

/// The time is looked at within a film: of these, none would ever end.
#[test]
fn the_time_is_kept_however_long_a_film_is() {
    let new = edited("lib/bsdf/lambert", "INV_PI * cos_theta)", "0.5 * INV_PI * cos_theta)", 1);
    let said = judge(6, new.path(), "512x512", &["--spp", "16777216", "--time", "3"]).stdout;
    // Where shaders take longer than that to compile, it is the smallest film that is not finished.
    assert!(said.starts_with("can't tell: 0 films of each at ") && said.contains(" are too few"), "{said}");
}

/// What the forty replace is there, and what they put in its place is code.
#[test]
fn each_of_the_forty_edits_is_code() {
    for edit in table::WRONG.iter().chain(table::RIGHT) {
        let library = Library::open(edited_all(edit.changes).path()).unwrap();
        let features = library.features().unwrap();
        library.link("passes/trace/path", &features).unwrap_or_else(|error| panic!("{}: {error}", edit.name));
    }
}

/// All forty, as long as a person waits by default: each wrong edit is found, or it is said what would have been, and no right one is
/// called wrong. Prints what was found of each.
#[test]
fn forty_edits_are_judged_rightly() {
    if !stress() {
        return;
    }
    let mut mistakes = Vec::new();
    let kinds = [("wrong", table::WRONG), ("right", table::RIGHT)];
    for (kind, edit) in kinds.into_iter().flat_map(|(kind, edits)| edits.iter().map(move |edit| (kind, edit))) {
        let new = edited_all(edit.changes);
        let begin = Instant::now();
        let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
        command.args(["judge", "cornell-box", "--quiet", "--new"]).arg(new.path());
        let run = command.current_dir(env!("CARGO_MANIFEST_DIR")).stdin(Stdio::null()).output().unwrap();
        let (seconds, code) = (begin.elapsed().as_secs_f64(), run.status.code());
        let [said, stderr] = [run.stdout, run.stderr].map(|text| String::from_utf8(text).unwrap());
        let line = said.lines().next().unwrap_or_default();
        println!("{kind} | {} | {seconds:.1} s | {} | {line}", edit.name, code.unwrap_or(-1));
        let well = match kind {
            "wrong" => matches!(code, Some(5 | 6)) && !said.contains("efficient"),
            _ => matches!(code, Some(0 | 6)),
        };
        // A tenth more than the default, and a second for the process to start and end.
        if !well || seconds > 34.0 {
            mistakes.push(format!("{kind}: {}: {seconds:.1} s, {code:?}: {said}{stderr}", edit.name));
        }
    }
    assert!(mistakes.is_empty(), "{}", mistakes.join("\n"));
}
