//! Each row of stress at the size of tests (all of it with `LUCERNA_STRESS=1`); and what is planted is seen.

use lucerna::gpu::{GpuError, adapters};
use lucerna::shader::Library;
use lucerna::stats::metrics::relative_mse;
use lucerna::stress::planted::{FAULTS, caught};
use lucerna::stress::rows::two_adapters::picture;
use lucerna::stress::rows::{self, ALL};
use lucerna::stress::{Lab, Measured, Outcome, Row, Scale, StressError, Verdict, judge};

use crate::support;

/// Rows that do not hold yet: one that does is to be taken off.
const FALLS_SHORT: &[&str] = &[];

fn holds(name: &str) {
    let row = rows::named(name).unwrap_or_else(|| panic!("there is no row {name}"));
    let outcome = judge(row, &support::lab());
    if FALLS_SHORT.contains(&name) {
        assert_ne!(outcome.verdict(), Verdict::Holds, "{name} holds: it falls short no more");
        return;
    }
    // One adapter has none to be compared with.
    if name == "two-adapters" && adapters().len() == 1 {
        assert!(matches!(outcome.verdict(), Verdict::CannotTell(why) if why.contains("one adapter")), "{outcome:?}");
        return;
    }
    assert_eq!(outcome.verdict(), Verdict::Holds, "{outcome:?}");
    assert!(outcome.measured.is_ok_and(|measured| measured.samples > 0), "{name} measured nothing");
}

macro_rules! rows_that_hold {
    ($($test:ident: $name:literal),+ $(,)?) => {
        $(
            #[test]
            fn $test() {
                holds($name);
            }
        )+

        const TESTED: &[&str] = &[$($name),+];
    };
}

rows_that_hold! {
    closed_meshes_have_no_cracks: "edges",
    slivers_have_no_cracks: "slivers",
    no_path_leaves_a_closed_room: "closed-rooms",
    no_path_leaves_a_room_by_its_edges: "room-edges",
    a_scene_moved_far_away_is_hit_alike: "moved",
    a_scene_scaled_by_a_power_of_two_is_hit_in_the_same_bits: "scaled",
    every_tree_finds_what_brute_force_finds: "hard-rays",
    the_least_of_coplanar_triangles_is_hit: "coplanar",
    a_stack_that_overflows_loses_nothing: "stack",
    every_layout_of_the_kernel_makes_one_picture: "layouts",
    every_adapter_makes_one_picture: "two-adapters",
    trees_of_every_scene_are_the_twins: "trees",
    equal_centroids_make_a_tree_that_is_walked: "equal-centroids",
    runs_of_equal_codes_are_split_at_every_bit: "equal-codes",
    instances_look_as_one_mesh: "instances",
    one_thing_far_away_costs_the_rest_nothing: "far-thing",
    a_scene_moved_far_away_looks_alike: "moved-pictures",
    a_scene_of_another_size_looks_alike: "scaled-pictures",
    a_closed_furnace_is_a_geometric_series: "furnace",
    albedos_are_integrals: "albedo",
    coarse_balls_lose_hardly_any_light: "coarse-balls",
    glass_of_index_one_is_invisible: "glass-of-1",
    a_tiny_light_gives_its_irradiance: "tiny-lights",
    a_cover_hides_a_lamp_however_close: "covers",
    coincident_lamps_look_the_same_to_both_integrators: "coincident-lamps",
    veils_let_through_their_product: "veils",
    holes_let_through_their_product: "cut-outs",
    texels_are_at_the_middles_of_their_cells: "texels",
    lookups_between_texels_have_the_filtered_mean: "texel-weights",
    no_relief_makes_light_or_loses_much_of_it: "relief",
    the_kernel_equals_its_twin: "twin",
    the_engine_equals_the_oracle: "oracle",
    every_estimator_has_every_others_mean: "estimators",
    reused_paths_equal_their_twin: "reuse-twin",
    reused_paths_have_the_mean_of_others: "reuse",
    the_error_of_a_film_is_what_it_says: "claimed-error",
    adaptive_films_have_the_right_mean: "adaptive",
    edits_end_where_a_fresh_engine_begins: "random-edits",
    random_numbers_are_independent: "independence",
    a_million_equal_samples_lose_nothing: "film-sums",
    bad_samples_say_where_they_went_wrong: "bad-samples",
    bad_inputs_are_told_at_their_place: "bad-inputs",
    bad_pictures_are_told_where_they_are_named: "bad-pictures",
}

#[test]
fn every_row_is_tested() {
    let names: Vec<&str> = ALL.iter().map(|row| row.name).collect();
    assert_eq!(names, TESTED);
}

#[test]
fn every_mistake_that_is_planted_is_seen() {
    for fault in FAULTS {
        assert!(fault.seen_by.iter().all(|name| rows::named(name).is_some()), "{}: no such row", fault.name);
        let library = fault.planted(Library::shipped()).unwrap_or_else(|error| panic!("{}: {error}", fault.name));
        // The first is for this mistake; others may see it too.
        let row = rows::named(fault.seen_by[0]).expect("a row");
        let outcome = judge(row, &support::lab().with_library(library).with_unseen(fault.unseen));
        assert!(caught(&outcome), "{} went unnoticed: {outcome:?}", fault.name);
    }
}

#[test]
fn an_adapter_whose_kernel_differs_is_seen() {
    let picture = |library: Library| picture(&mut support::lab().with_library(library).rig(), 64).unwrap();
    let right = picture(Library::shipped());
    assert!(relative_mse(&picture(Library::shipped()), &right) == 0.0);
    // As the two adapters of a machine would differ, one of which loses what only its own walk has.
    let walk = if support::gpu().is_software() { "second-leaf" } else { "short-stack" };
    let fault = FAULTS.iter().find(|fault| fault.name == walk).unwrap();
    let off = relative_mse(&picture(fault.planted(Library::shipped()).unwrap()), &right);
    assert!(off > 1e-6, "a relMSE of {off:e}");
}

/// The rows of the page's table: name, what must hold, and the figure with what it may be.
fn listed(page: &str) -> Vec<[String; 3]> {
    let rows =
        page.lines().skip_while(|line| !line.starts_with("| row |")).skip(2).take_while(|line| line.starts_with('|'));
    let cells =
        |row: &str| -> Vec<String> { row.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect() };
    rows.map(|row| cells(row).try_into().expect("three cells")).collect()
}

#[test]
fn the_page_has_the_rows_of_the_command() {
    let page = std::fs::read_to_string("docs/stress.md").unwrap();
    let right: Vec<[String; 3]> = ALL
        .iter()
        .map(|row| [format!("`{}`", row.name), row.holds.to_owned(), format!("{}: at most {}", row.quantity, row.most)])
        .collect();
    assert_eq!(listed(&page), right);
    for fault in FAULTS {
        let line = format!("| `{}` | {} | ", fault.name, fault.wrong);
        assert!(page.contains(&line), "docs/stress.md lacks {line}");
    }
}

#[test]
fn names_are_words_and_sentences_are_short() {
    for row in ALL {
        assert!(row.name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-'), "{}", row.name);
        assert!(row.name.len() <= 18 && row.holds.len() <= 130, "{}: {} letters", row.name, row.holds.len());
        assert!(row.sizes.is_sorted(), "{}", row.name);
    }
}

fn measure_nothing(_: &Lab, size: u64) -> Result<Measured, StressError> {
    Ok(Measured::new(0.0, size))
}

static ROW: Row = Row {
    name: "nothing",
    holds: "nothing is nothing",
    quantity: "difference",
    most: 2.0,
    unit: "samples",
    sizes: [1, 2, 3],
    measure: measure_nothing,
};

#[test]
fn verdicts_are_those_of_figures() {
    let outcome = |measured| Outcome { row: &ROW, measured, seconds: 0.0 };
    let of = |value, doubt: Option<&str>| {
        outcome(Ok(Measured { doubt: doubt.map(str::to_owned), ..Measured::new(value, 9) }))
    };
    assert_eq!((of(2.0, None).verdict(), of(2.0, None).margin()), (Verdict::Holds, Some(1.0)));
    assert_eq!((of(4.0, None).verdict(), of(4.0, None).margin()), (Verdict::Fails(None), Some(0.5)));
    assert_eq!(of(f64::NAN, None).verdict(), Verdict::Fails(None), "what is no number holds nowhere");
    assert_eq!(of(1.0, Some("noise")).verdict(), Verdict::CannotTell("noise".to_owned()));
    assert_eq!(of(9.0, Some("noise")).verdict(), Verdict::Fails(None), "what is far beyond is seen through noise");
    let broken = outcome(Err(StressError::Broken("a bad sample".to_owned())));
    assert_eq!((broken.verdict(), broken.margin()), (Verdict::Fails(Some("a bad sample".to_owned())), None));
    let lost = outcome(Err(GpuError::Lost { reason: "gone".to_owned() }.into()));
    assert!(matches!(lost.verdict(), Verdict::CannotTell(why) if why.contains("gone")));
    assert_eq!([Scale::Test, Scale::Quick, Scale::Full].map(|scale| ROW.size(scale)), [1, 2, 3]);
}

#[test]
fn cases_are_taken_together_by_the_worst_or_by_their_sum() {
    let of = |value: f64, note: &str| Measured::new(value, 5).noted(note);
    let worst = of(1.0, "a").worst(of(3.0, "b")).worst(of(2.0, "c"));
    assert_eq!((worst.value, worst.samples, worst.note.as_str()), (3.0, 15, "b"));
    for nan in [f64::NAN, -f64::NAN] {
        assert!(of(nan, "a").worst(of(3.0, "b")).value.is_nan() && of(3.0, "a").worst(of(nan, "b")).value.is_nan());
    }
    let sum = of(0.0, "a").plus(of(2.0, "b")).plus(of(1.0, "c"));
    assert_eq!((sum.value, sum.samples, sum.note.as_str()), (3.0, 15, "b"));
    assert_eq!(of(0.0, "a").plus(of(0.0, "b")).note, "");
}
