//! Benchmarks of light transport: their statistics on simulated numbers, and the command by running it.

use std::path::Path;
use std::process::{Command, Output, Stdio};

use lucerna::app::bench::light::against::{Change, compare};
use lucerna::app::bench::light::configuration::Configuration;
use lucerna::app::bench::light::plot::{self, Axis};
use lucerna::app::bench::light::record::{
    Bench, ConfigurationRecord, Machine, ReferenceRecord, Run, SceneRecord, Snapshot,
};
use lucerna::app::bench::light::{tables, winner};
use lucerna::app::shared::spread::spread;
use lucerna::stats::metrics::relative_mse;
use lucerna::stats::summary::{Crossing, Summary, Welch, crossing, least_squares, log_log_slope, upper_tail};
use serde_json::Value;

use crate::support::dice::Dice;

fn close(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

#[test]
fn relative_mse_is_its_definition() {
    let found = relative_mse(&[[1.0, 2.0, 0.0], [0.5, 0.5, 0.5]], &[[1.0, 1.0, 0.1], [0.5, 0.5, 0.5]]);
    close(found, (1.0 / 1.01 + 0.01 / 0.02) / 6.0, 1e-6);
}

#[test]
fn summaries_and_lines_are_those_worked_out_by_hand() {
    let summary = Summary::of(&[1.0, 2.0, 6.0]).unwrap();
    // Variance (4 + 1 + 9) / 2 = 7, over 3 values.
    close(summary.standard_error.unwrap(), (7.0_f64 / 3.0).sqrt(), 1e-12);
    assert_eq!((summary.mean, summary.min, summary.max), (3.0, 1.0, 6.0));
    assert_eq!((Summary::of(&[]), Summary::of(&[2.0]).unwrap().standard_error), (None, None));
    // x = 0, 1, 2, 3 and y = 1, 3, 2, 5: slope 5.5 / 5, residuals' squares 2.7, over 2 degrees.
    let line = least_squares(&[(0.0, 1.0), (1.0, 3.0), (2.0, 2.0), (3.0, 5.0)]).unwrap();
    close(line.slope, 1.1, 1e-12);
    close(line.standard_error.unwrap(), (2.7_f64 / 2.0 / 5.0).sqrt(), 1e-12);
    assert!(least_squares(&[(1.0, 1.0), (1.0, 2.0)]).is_none());
}

#[test]
fn crossings_are_interpolated_between_logarithms_only() {
    let points = [(1.0, 1e-1), (10.0, 1e-2), (1000.0, 1e-4)];
    match crossing(&points, 1e-3).unwrap() {
        Crossing::At(x) => close(x, 100.0, 1e-12),
        other => panic!("{other:?}"),
    }
    assert_eq!(crossing(&points, 0.5), Some(Crossing::Before(1.0)));
    assert_eq!(crossing(&points, 1e-5), Some(Crossing::After(1000.0)));
    assert_eq!((crossing(&[], 1.0), crossing(&[(1.0, -1.0)], 1.0)), (None, None));
}

#[test]
fn tails_of_students_t_are_those_of_the_tables() {
    // One and two degrees have closed forms: 1/2 - atan(t) / pi, and (1 - t / sqrt(2 + t^2)) / 2.
    for t in [-3.0_f64, -0.5, 0.1, 1.0, 12.7, 636.6] {
        close(upper_tail(t, 1.0), 0.5 - t.atan() / std::f64::consts::PI, 1e-10);
        close(upper_tail(t, 2.0), (1.0 - t / (2.0 + t * t).sqrt()) / 2.0, 1e-8);
    }
    // Quantiles as printed in tables, to four digits.
    for (t, degrees, p) in [(1.812, 10.0, 0.05), (2.228, 10.0, 0.025), (3.787, 14.0, 0.001), (3.646, 30.0, 0.0005)] {
        close(upper_tail(t, degrees), p, 2e-3);
    }
}

/// Slopes are right, and their standard errors are the spread that slopes really have: over 500 simulations of 8 runs
/// whose errors are correlated from one number of samples to the next, as those of one growing film are.
#[test]
fn the_jackknife_knows_the_spread_of_correlated_slopes() {
    let mut dice = Dice(1);
    let xs = [1.0, 4.0, 16.0, 64.0];
    let mut slopes = Vec::new();
    let mut claimed = 0.0;
    for _ in 0..500 {
        let run = |dice: &mut Dice| {
            let mut walk = 0.0;
            xs.map(|x| {
                walk = 0.7 * walk + 0.1 * dice.normal();
                walk.exp() / x
            })
            .to_vec()
        };
        let runs: Vec<Vec<f64>> = (0..8).map(|_| run(&mut dice)).collect();
        let slope = log_log_slope(&xs, &runs).unwrap();
        slopes.push(slope.slope);
        claimed += slope.standard_error.unwrap() / 500.0;
    }
    let all = Summary::of(&slopes).unwrap();
    let true_error = all.standard_error.unwrap() * 500_f64.sqrt();
    assert!((all.mean + 1.0).abs() < 5.0 * all.standard_error.unwrap() + 1e-3, "slope {}", all.mean);
    // The spread of 500 slopes is known to 3 %; the mean of a standard error of 8 runs lies a few percent below.
    assert!((0.85..1.15).contains(&(claimed / true_error)), "claimed {claimed}, true {true_error}");
}

/// A benchmark of one scene: 4 configurations, 4 snapshots, 8 seeds, errors and times with log-normal noise. From
/// configuration 1's second snapshot on, errors are multiplied by `planted`.
fn simulated(dice: &mut Dice, planted: f64) -> Bench {
    let names = ["path+sobol+roulette", "path+sobol", "path+pcg", "bsdf+pcg"];
    let configuration = |which: usize, dice: &mut Dice| {
        let runs = (0..8).map(|seed| {
            let snapshots = [1u32, 4, 16, 64].map(|spp| {
                let fault = if which == 1 && spp > 1 { planted } else { 1.0 };
                let exponent = if which < 2 { -1.25 } else { -1.0 };
                let base = [0.2, 0.25, 0.3, 2.0][which];
                let relmse = fault * base * f64::from(spp).powf(exponent) * (0.05 * dice.normal()).exp();
                let seconds = 1e-3 * f64::from(spp) * (0.01 * dice.normal()).exp();
                let claimed = (spp > 1).then_some(relmse);
                Snapshot { spp, seconds, rays: u64::from(spp) * 1000, relmse, claimed }
            });
            Run { seed, snapshots: snapshots.to_vec() }
        });
        ConfigurationRecord::of(names[which].to_owned(), 0, runs.collect())
    };
    let text = |text: &str| text.to_owned();
    let machine =
        Machine { adapter: text("none <&>"), software: true, os: text("x"), architecture: text("y"), threads: 1 };
    let reference = ReferenceRecord {
        key: text("r"),
        by: text("path+pcg"),
        seed: 9,
        spp: 4096,
        relmse: 1e-6,
        adapter: text("none"),
        seconds: 1.0,
    };
    let scene = SceneRecord {
        scene: text("simulated"),
        size: [8, 8],
        max_depth: 4,
        triangles: 1,
        key: text("k"),
        reference,
        configurations: (0..4).map(|which| configuration(which, dice)).collect(),
    };
    Bench { version: text("0"), made: 0, interrupted: false, machine, seeds: 8, spp: 64, scenes: vec![scene] }
}

#[test]
fn a_planted_loss_is_called_a_regression_and_where_it_is() {
    let mut dice = Dice(2);
    let verdict = compare(&simulated(&mut dice, 1.5), &simulated(&mut dice, 1.0), 0.05);
    let worse: Vec<(&str, u32)> = verdict.worse().map(|c| (c.configuration.as_str(), c.spp)).collect();
    assert_eq!(worse, [("path+sobol", 4), ("path+sobol", 16), ("path+sobol", 64)]);
    assert!(!verdict.passed() && verdict.markdown().contains("regression: simulated, path+sobol at 64 spp"));
    // The other way round it is a gain, and no fault.
    let gain = compare(&simulated(&mut dice, 1.0), &simulated(&mut dice, 1.5), 0.05);
    assert!(gain.passed() && gain.comparisons.iter().filter(|c| c.change == Change::Better).count() == 3);
    // Within the tolerance it is nothing.
    assert!(compare(&simulated(&mut dice, 1.1), &simulated(&mut dice, 1.0), 0.5).passed());
}

#[test]
fn what_is_no_match_is_said_and_not_passed() {
    let mut dice = Dice(3);
    let (now, mut then) = (simulated(&mut dice, 1.0), simulated(&mut dice, 1.0));
    then.scenes[0].key = "other".to_owned();
    let verdict = compare(&now, &then, 0.05);
    assert!(!verdict.passed() && verdict.notes[0].contains("another picture"), "{:?}", verdict.notes);
}

/// With a family-wise probability of 1e-3 split over both directions, a thousand pairs of equal runs should be called worse
/// 0.5 times (Poisson: more than 5 has a probability of 1e-5), and single tests at 5 % should fail 5 % of the time: 800 of
/// 16,000, whose standard deviation is 28, were they independent; those of one pair share nothing.
#[test]
fn equal_runs_are_seldom_called_worse() {
    let mut dice = Dice(4);
    let (mut alarms, mut small) = (0, 0);
    for _ in 0..1000 {
        let verdict = compare(&simulated(&mut dice, 1.0), &simulated(&mut dice, 1.0), 0.0);
        alarms += u32::from(verdict.worse().next().is_some());
        // Of the two directions, the likelier is told: 5 % each way.
        small += verdict.comparisons.iter().filter(|c| c.p < 0.05 && c.efficiency < 1.0).count();
    }
    assert!(alarms <= 5, "{alarms} false alarms in 1000");
    assert!((660..940).contains(&small), "{small} of 16,000 tests below 5 %");
}

#[test]
fn without_noise_any_loss_beyond_the_margin_counts() {
    assert_eq!(Welch::of(&[1.0, 1.0], &[0.9, 0.9], 0.0).unwrap().p(), 0.0);
    assert_eq!(Welch::of(&[1.0, 1.0], &[1.0, 1.0], 0.0).unwrap().p(), 1.0);
    assert!(Welch::of(&[1.0], &[1.0, 2.0], 0.0).is_none());
}

#[test]
fn configurations_are_named_as_they_are_read() {
    for name in ["path+sobol+roulette", "path+pcg", "bsdf+sobol", "bsdf+pcg+roulette", "path+sobol+exact"] {
        assert_eq!(name.parse::<Configuration>().unwrap().to_string(), name);
    }
    assert_eq!("rr+pcg+path".parse::<Configuration>().unwrap().to_string(), "path+pcg+roulette");
    for wrong in ["", "path", "path+bsdf+pcg", "path+path+pcg", "pth+pcg"] {
        assert!(wrong.parse::<Configuration>().is_err(), "`{wrong}`");
    }
}

#[test]
fn tables_and_plots_hold_what_was_measured() {
    let bench = simulated(&mut Dice(5), 1.0);
    let csv = tables::csv(&bench);
    assert_eq!(csv.lines().count(), 1 + 4 * 4 * 8);
    let columns = csv.lines().next().unwrap().split(',').count();
    assert!(csv.lines().all(|line| line.split(',').count() == columns));
    let table = tables::markdown(&bench);
    let slope = bench.scenes[0].configurations[0].slope.unwrap().slope;
    assert!((slope + 1.25).abs() < 0.05 && table.contains(&format!("{slope:.2}")), "{slope}\n{table}");
    for axis in [Axis::Seconds, Axis::Samples] {
        let svg = plot::svg(&bench, &bench.scenes[0], axis).unwrap();
        assert!(svg.contains("none &lt;&amp;&gt;") && !svg.contains("NaN") && !svg.contains("inf"));
        for configuration in &bench.scenes[0].configurations {
            assert!(svg.contains(&format!(">{}<", configuration.name)));
        }
    }
    let read: Bench = serde_json::from_str(&serde_json::to_string(&bench).unwrap()).unwrap();
    // Numbers are read to the last bit but one.
    let errors = |bench: &Bench| bench.scenes[0].configurations[3].at(64).map(|s| s.relmse).collect::<Vec<_>>();
    assert_eq!(errors(&read).len(), 8);
    errors(&read).iter().zip(errors(&bench)).for_each(|(found, written)| close(*found, written, 1e-15));
}

/// The one that is planted to be better is said to have won, and by how much; of equal ones, none is.
#[test]
fn a_sentence_says_who_won() {
    let bench = simulated(&mut Dice(6), 0.5);
    let said = winner::sentences(&bench);
    let by: f64 = said
        .split("won, ")
        .nth(1)
        .and_then(|rest| rest.split(' ').next())
        .unwrap_or_default()
        .parse()
        .unwrap_or_default();
    assert!(said.starts_with("simulated: path+sobol won, ") && said.contains(" ± "), "{said}");
    // 0.2 / (0.5 x 0.25).
    assert!((1.5..1.7).contains(&by) && said.ends_with("as efficient as path+sobol+roulette, the next.\n"), "{said}");
    let equal = winner::sentences(&simulated(&mut Dice(7), 0.8));
    assert!(equal.contains("can't be told apart"), "{equal}");
    assert!(tables::markdown(&bench).contains(&said), "the table's file has it too");
}

#[test]
fn a_value_and_its_spread_have_as_many_places() {
    for (value, error, written) in [
        (1.3137, 0.0512, "1.314 ± 0.051"),
        (0.00469, 0.000041, "0.004690 ± 0.000041"),
        (4.69e-6, 4.1e-8, "(4.690 ± 0.041)e-6"),
        (123_456_789.0, 1_234_567.0, "(1.235 ± 0.012)e8"),
        (12.0, 340.0, "12 ± 340"),
        (2.5, 0.0, "2.50"),
        (0.0, 0.0, "0"),
    ] {
        assert_eq!(spread(value, error), written);
    }
}

/// Programs that know no clipping draw nothing of what is clipped: all lies within the frame by itself.
#[test]
fn plots_need_no_clipping() {
    let bench = simulated(&mut Dice(8), 1.0);
    let svg = plot::svg(&bench, &bench.scenes[0], Axis::Seconds).unwrap();
    assert!(!svg.contains("clip"), "{svg}");
    let guides = svg.split("stroke-dasharray=\"1 3\">").nth(1).and_then(|rest| rest.split("</g>").next()).unwrap();
    let ends: Vec<f64> = guides.split(['M', 'L', ' ', '"']).filter_map(|word| word.parse().ok()).collect();
    assert!(ends.len() >= 8, "{guides}");
    for end in ends.chunks_exact(2) {
        assert!((57.9..428.1).contains(&end[0]) && (43.9..284.1).contains(&end[1]), "{end:?}");
    }
}

fn lucerna(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).output().unwrap()
}

const BENCH: &[&str] = &[
    "bench",
    "cornell-box",
    "--size=16x16",
    "--depth=4",
    "--spp=16",
    "--seeds=3",
    "--configs=bsdf+pcg,path+pcg+rr",
    "--reference-spp=64",
    "--quiet",
    "--json",
];

#[test]
fn the_command_writes_all_its_files_and_compares_itself() {
    let folder = tempfile::tempdir().unwrap();
    let run = lucerna(folder.path(), BENCH);
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    let bench: Value = serde_json::from_slice(&run.stdout).unwrap();
    let out = folder.path().join("result/bench");
    assert_eq!(serde_json::from_slice::<Value>(&std::fs::read(out.join("bench.json")).unwrap()).unwrap(), bench);
    for file in ["bench.csv", "bench.md", "cornell-box-seconds.svg", "cornell-box-spp.svg"] {
        assert!(out.join(file).metadata().unwrap().len() > 100, "{file}");
    }
    let scene = &bench["scenes"][0];
    assert_eq!((&scene["size"], &scene["max_depth"]), (&serde_json::json!([16, 16]), &4.into()));
    let own = scene["reference"]["relmse"].as_f64().unwrap();
    for configuration in scene["configurations"].as_array().unwrap() {
        assert_eq!(configuration["runs"].as_array().unwrap().len(), 3);
        let snapshots = configuration["snapshots"].as_array().unwrap();
        assert_eq!(snapshots.iter().map(|s| s["spp"].as_u64().unwrap()).collect::<Vec<_>>(), [1, 4, 16]);
        let (first, last) = (&snapshots[0]["relmse"]["mean"], &snapshots[2]["relmse"]["mean"]);
        // 16 times the samples: a sixteenth of the error, but for rare bright samples, which 1 spp may miss or meet.
        let ratio = first.as_f64().unwrap() / last.as_f64().unwrap();
        assert!((3.0..100.0).contains(&ratio), "errors {first} and {last}");
        assert!(own < last.as_f64().unwrap(), "the reference is no better than the film");
        assert!(snapshots[2]["seconds"]["mean"].as_f64().unwrap() > snapshots[0]["seconds"]["mean"].as_f64().unwrap());
    }
    // The reference is found again, and a run against itself has no regression beyond ten times.
    let reference = |folder: &Path| {
        let entries = std::fs::read_dir(folder.join("result/bench/reference")).unwrap();
        entries
            .map(|e| e.unwrap().path())
            .map(|p| (p.clone(), p.metadata().unwrap().modified().unwrap()))
            .collect::<Vec<_>>()
    };
    let kept = reference(folder.path());
    std::fs::copy(out.join("bench.json"), folder.path().join("then.json")).unwrap();
    let again = [BENCH, &["--against=then.json", "--tolerance=1000"]].concat();
    let run = lucerna(folder.path(), &again);
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    assert_eq!(reference(folder.path()), kept);
    assert_eq!(kept.len(), 2);
}

#[test]
fn what_bench_cannot_do_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let cases: &[(&[&str], i32, &str)] = &[
        (&["bench", "no-such-scene"], 1, "cornell-box"),
        (&["bench", "cornell-box", "--configs", "pth+pcg"], 2, "pth"),
        (&["bench", "cornell-box", "--seeds", "0"], 2, "--seeds"),
        (&["bench", "cornell-box", "--against", "none.json"], 1, "none.json"),
    ];
    for (arguments, code, word) in cases {
        let run = lucerna(folder.path(), arguments);
        let text = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(*code), "{arguments:?}: {text}");
        assert!(text.contains(word) && text.matches("error:").count() == 1, "{arguments:?}: {text}");
    }
}
