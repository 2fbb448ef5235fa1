//! The contact sheet: rows and columns where they should be, pictures in their cells, text that can be seen.

use std::fs;

use glam::UVec2;
use lucerna::app::variants::answers::canvas::Rect;
use lucerna::app::variants::answers::lettering::Lettering;
use lucerna::app::variants::answers::sheet::{self, Sheet};
use lucerna::app::variants::answers::{self, blocks};
use lucerna::app::variants::record::{Answer, State};

use super::hand;

fn plan(answer: &Answer) -> Sheet {
    let folder = tempfile::tempdir().unwrap();
    hand::pictures(answer, folder.path());
    sheet::plan(answer, &sheet::read(answer, folder.path()), &mut Lettering::default())
}

fn rect(sheet: &Sheet, member: usize) -> Rect {
    sheet.cells.iter().find(|cell| cell.member == member).unwrap().rect
}

/// Where a label is that is said but once.
fn label(sheet: &Sheet, said: &str) -> Rect {
    let all: Vec<Rect> = sheet.labels.iter().filter(|label| label.said == said).map(|label| label.rect()).collect();
    assert_eq!(all.len(), 1, "{said}");
    all[0]
}

#[test]
fn rows_are_the_first_axis_and_columns_the_second() {
    let answer = hand::answer(0);
    let sheet = plan(&answer);
    for (member, record) in answer.records.iter().enumerate().take(6) {
        let cell = rect(&sheet, member);
        let column = label(&sheet, &answer.axes[1].labels[record.at[1]]);
        let row = label(&sheet, &answer.axes[0].labels[record.at[0]]);
        assert!(column.min.x == cell.min.x && column.max().y <= rect(&sheet, 0).min.y, "{}: column", record.name);
        assert!(
            row.max().x <= cell.min.x && row.min.y >= cell.min.y && row.max().y <= cell.max().y,
            "{}: row",
            record.name
        );
    }
    let clay = label(&sheet, "clay");
    assert!(clay.min.y >= rect(&sheet, 6).max().y && clay.min.x == rect(&sheet, 6).min.x);
}

#[test]
fn nothing_overlaps_and_all_is_on_the_sheet() {
    for blocks in 0..4 {
        let answer = hand::answer(blocks);
        let sheet = plan(&answer);
        let mut all: Vec<Rect> = sheet.cells.iter().map(|cell| cell.rect).collect();
        assert_eq!(all.len(), answer.records.len());
        all.extend(sheet.labels.iter().map(|label| label.rect()));
        for (i, a) in all.iter().enumerate() {
            assert!(a.max().cmple(sheet.size).all());
            for b in &all[i + 1..] {
                let apart = a.max().cmple(b.min).any() || b.max().cmple(a.min).any();
                assert!(apart, "{a:?} and {b:?} overlap");
            }
        }
    }
}

#[test]
fn cells_hold_the_pictures_of_their_members() {
    let mut answer = hand::answer(2);
    answer.records[3].state = State::Failed { message: "no light at all".to_owned(), file: None, line: 0, column: 0 };
    let folder = tempfile::tempdir().unwrap();
    hand::pictures(&answer, folder.path());
    let planned = plan(&answer);
    let path = folder.path().join("sheet.png");
    sheet::write(&answer, folder.path(), &path).unwrap();
    let (pixels, width) = hand::pixels(&fs::read(&path).unwrap());
    let at = |place: UVec2| pixels[place.y as usize * width + place.x as usize];
    for cell in &planned.cells {
        let middle = at((cell.rect.min + cell.rect.max()) / 2);
        if cell.member == 3 {
            let texts: Vec<[u8; 3]> = (cell.rect.min.y..cell.rect.max().y)
                .flat_map(|y| (cell.rect.min.x..cell.rect.max().x).map(move |x| at(UVec2::new(x, y))))
                .collect();
            assert!(texts.iter().any(|&[r, g, b]| r > 120 && g < 110 && b < 100), "the message is not to be seen");
        } else {
            assert_eq!(middle, hand::colour(cell.member));
        }
    }
    for label in &planned.labels {
        let rect = label.rect();
        let dark = (rect.min.y..rect.max().y)
            .flat_map(|y| (rect.min.x..rect.max().x).map(move |x| UVec2::new(x, y)))
            .filter(|&place| at(place)[0] < 160)
            .count();
        assert!(dark > 4 * label.said.chars().filter(|c| !c.is_whitespace()).count().min(20), "{}", label.said);
    }
}

#[test]
fn a_long_label_is_cut_and_a_large_picture_made_small() {
    let mut answer = hand::answer(0);
    answer.axes[0].labels[0] = "a label of very many words that nobody could ever read on a sheet ".repeat(4);
    let folder = tempfile::tempdir().unwrap();
    hand::pictures(&answer, folder.path());
    hand::picture(&folder.path().join("members/sobol-9.png"), [200, 100, 50], [1024, 512]);
    let contents = sheet::read(&answer, folder.path());
    let thumb = contents[0].as_ref().unwrap();
    assert_eq!(thumb.size, UVec2::new(256, 128));
    assert!(thumb.pixels.iter().all(|&pixel| pixel == [200, 100, 50]), "the mean of equal pixels is that pixel");
    let sheet = sheet::plan(&answer, &contents, &mut Lettering::default());
    let long = label(&sheet, &answer.axes[0].labels[0]);
    assert!(long.max().x <= rect(&sheet, 0).min.x && long.size.y < 50);
}

#[test]
fn one_axis_wraps_and_records_of_other_axes_are_shown_all_the_same() {
    let mut answer = hand::answer(0);
    answer.axes = vec![answer.axes.remove(1)];
    for record in &mut answer.records[..3] {
        record.at = vec![record.at[1]];
    }
    let shown = blocks::blocks(&answer);
    assert_eq!(shown.iter().map(|block| block.cells.len()).collect::<Vec<_>>(), [3, 4]);
    assert_eq!(shown[0].cells[2].caption, "100");
    answer.records.extend(hand::answer(2).records);
    assert_eq!(blocks::blocks(&answer)[1].extent(), [3, 6]);
}

#[test]
fn all_files_are_written_and_a_missing_picture_is_told() {
    let answer = hand::answer(0);
    let folder = tempfile::tempdir().unwrap();
    hand::pictures(&answer, folder.path());
    fs::remove_file(folder.path().join("members/clay.png")).unwrap();
    let files = answers::write(&answer, folder.path()).unwrap();
    let names: Vec<_> = files.iter().map(|file| file.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(names, ["table.csv", "table.md", "sheet.png", "index.html"]);
    assert!(files.iter().all(|file| file.is_file()));
    let page = fs::read_to_string(&files[3]).unwrap();
    assert!(page.contains("clay.png"), "the page says which picture it lacks");
    assert!(!page.contains("{{"), "all of the page is filled in");
}
