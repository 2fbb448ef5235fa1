//! Work in pieces: each done once, results in order, and a panic is one of who asked.

use std::panic::{catch_unwind, panic_any};

use lucerna::parallel::{fill, map, on_threads};

#[test]
fn pieces_are_done_once_and_come_in_order() {
    for count in [0, 1, 2, 3, 7, 100, 1000] {
        assert_eq!(map(count, |piece| piece * piece), (0..count).map(|piece| piece * piece).collect::<Vec<_>>());
    }
    for (count, size) in [(0, 3), (1, 3), (3, 3), (4, 3), (1000, 7), (5, 100), (5, 0)] {
        let mut items = vec![0; count];
        fill(&mut items, size, |first, piece| {
            assert!(piece.len() <= size.max(1));
            piece.iter_mut().zip(first..).for_each(|(item, index)| *item += index + 1);
        });
        assert_eq!(items, (1..=count).collect::<Vec<_>>(), "{count} in pieces of {size}");
    }
}

#[test]
fn no_more_threads_than_are_asked_for() {
    assert_eq!(on_threads(1, || 5), [5]);
    assert_eq!(on_threads(0, || 5), [5], "this thread works in any case");
    assert!((1..=3).contains(&on_threads(3, || 5).len()));
}

#[test]
fn a_panic_goes_on_where_the_work_was_asked_for() {
    let work = |piece| {
        if piece == 60 {
            panic_any("the sixtieth");
        }
    };
    let panicked = catch_unwind(|| map(100, work)).unwrap_err();
    assert_eq!(panicked.downcast_ref(), Some(&"the sixtieth"));
}
