//! Tables of a family: numbers, what is missing, and text that could break them.

use lucerna::app::variants::answers::{numbers, table};
use lucerna::app::variants::record::State;

use super::hand;

#[test]
fn a_flat_file_has_a_row_a_snapshot() {
    let answer = hand::answer(0);
    let text = table::csv(&answer);
    let lines: Vec<&str> = text.lines().collect();
    let head = "member,render.sampler,materials.ball.ns,materials.ball.ks,spp,seconds,rays,error,efficiency,relmse,flip,mean_r,mean_g,mean_b,film_of,state,message";
    assert_eq!(lines[0], head);
    assert_eq!(lines.len(), 1 + 2 * answer.records.len());
    assert_eq!(lines[1], "sobol-9,sobol,9,,16,5e-1,1000000,4e-2,5e1,,,,,,,done,");
    assert_eq!(lines[2], "sobol-9,sobol,9,,64,2e0,4000000,1e-2,5e1,1.1e-2,5e-2,1e0,9.9e-1,1.01e0,,done,");
    assert!(lines[13].starts_with("clay,,,\"(0, 0, 0)\",16,"), "{}", lines[13]);
}

#[test]
fn what_is_missing_is_empty_and_what_failed_says_where() {
    let mut answer = hand::answer(0);
    let record = &mut answer.records[1];
    record.state = State::Failed {
        message: "unknown field `nz`, \"ns\" was meant".to_owned(),
        file: Some("balls.ron".to_owned()),
        line: 4,
        column: 9,
    };
    (record.snapshots, record.against) = (Vec::new(), None);
    let text = table::csv(&answer);
    let row = text.lines().nth(3).unwrap();
    assert_eq!(row, "sobol-10,sobol,10,,,,,,,,,,,,,failed,\"balls.ron:4:9: unknown field `nz`, \"\"ns\"\" was meant\"");
    let markdown = table::markdown(&answer);
    assert!(markdown.contains("| sobol-10 | sobol | 10 |  | failed | | | | | | | |\n"), "{markdown}");
    assert!(markdown.contains("- `sobol-10`: balls.ron:4:9: unknown field"), "{markdown}");
}

#[test]
fn every_row_of_a_table_has_all_columns() {
    for reference in [true, false] {
        let mut answer = hand::answer(2);
        answer.records[0].settings[0].1 = "a|b".to_owned();
        answer.records[2].snapshots.clear();
        answer.records[2].state = State::Missing;
        answer.records[3].against = None;
        if !reference {
            answer.reference = None;
        }
        let text = table::markdown(&answer);
        let columns = |line: &str| line.replace("\\|", "").matches('|').count();
        let main: Vec<&str> =
            text.lines().skip_while(|l| !l.starts_with('|')).take_while(|l| l.starts_with('|')).collect();
        assert_eq!(main.len(), 2 + answer.records.len());
        for line in &main {
            assert_eq!(columns(line), columns(main[0]), "{line}");
        }
    }
}

#[test]
fn a_shared_film_a_lost_race_and_bad_samples_are_told() {
    let mut answer = hand::answer(0);
    answer.records[1].film_of = Some("sobol-9".to_owned());
    answer.records[2].state = State::Lost { seconds: 3.25, confidence: 0.9996 };
    answer.records[3].bad_samples = 7;
    answer.interrupted = true;
    let text = table::markdown(&answer);
    assert!(text.contains("- `sobol-10` is the film of `sobol-9`"), "{text}");
    assert!(text.contains("- `sobol-100`: lost the race after 3.25 s, with 99.9 % confidence"), "{text}");
    assert!(text.contains("- `random-9`: 7 samples were no numbers"), "{text}");
    assert!(text.contains("Ended early: not all was rendered."), "{text}");
}

#[test]
fn numbers_have_three_digits() {
    let said = [0.0, 0.012345, 0.98765, 4.5612, 45.612, 123.4, 98765.4, 2.5e7, 1.25e-5, f64::NAN].map(numbers::short);
    assert_eq!(said, ["0", "0.0123", "0.988", "4.56", "45.6", "123", "98765", "2.50e7", "1.25e-5", "-"]);
}

#[test]
fn efficiency_is_known_where_error_and_time_are() {
    let mut snapshot = hand::answer(0).records[0].snapshots[1];
    assert_eq!(numbers::efficiency(&snapshot), Some(50.0));
    for relmse in [0.0, f64::NAN, f64::INFINITY] {
        snapshot.relmse = relmse;
        assert_eq!(numbers::efficiency(&snapshot), None);
    }
}
