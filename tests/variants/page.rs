//! The page in a browser: what is chosen, wiped, zoomed and sorted by real events, and that nothing is asked of any network.

use std::fs;

use lucerna::app::variants::answers::page;
use lucerna::app::variants::record::State;

use super::browser::{Browser, address};
use super::hand;

/// A browser with the page of an answer.
fn opened(change: impl FnOnce(&mut lucerna::app::variants::record::Answer)) -> (Browser, tempfile::TempDir) {
    let mut answer = hand::answer(0);
    change(&mut answer);
    let folder = tempfile::tempdir().unwrap();
    hand::pictures(&answer, folder.path());
    let path = folder.path().join("index.html");
    fs::write(&path, page::html(&answer, folder.path())).unwrap();
    let mut browser = Browser::start();
    browser.open(&address(&path));
    browser.wait("read.a !== null");
    (browser, folder)
}

/// The colour that is shown at a part of the viewer's width, in the middle of its height.
fn seen(browser: &mut Browser, part: f64) -> [u8; 3] {
    let [x, y] = browser.middle("viewer");
    let width = browser.number("viewer.clientWidth");
    let (pixels, row) = hand::pixels(&browser.screenshot());
    pixels[y as usize * row + (x + (part - 0.5) * width) as usize]
}

#[test]
fn pictures_are_chosen_wiped_and_subtracted() {
    let (mut browser, _folder) = opened(|_| {});
    browser.click("buttons.get(4)", false);
    browser.click("buttons.get(1)", true);
    browser.wait("chosen.a === 4 && chosen.b === 1 && read.a !== null");
    assert_eq!([seen(&mut browser, 0.4), seen(&mut browser, 0.6)], [hand::colour(4), hand::colour(1)]);

    let at = browser.middle("byId('line')");
    browser.mouse("mousePressed", at, false);
    browser.mouse("mouseMoved", [at[0] + 100.0, at[1]], false);
    browser.mouse("mouseMoved", [at[0] + 200.0, at[1]], false);
    browser.mouse("mouseReleased", [at[0] + 200.0, at[1]], false);
    assert_eq!([seen(&mut browser, 0.6), seen(&mut browser, 0.75)], [hand::colour(4), hand::colour(1)]);

    browser.click("document.querySelector('[data-mode=difference]')", false);
    let four = |i: usize| (hand::colour(4)[i].abs_diff(hand::colour(1)[i])).saturating_mul(4);
    assert_eq!(seen(&mut browser, 0.5), [0, 1, 2].map(four), "four times the difference");

    browser.click("document.querySelector('[data-mode=blink]')", false);
    browser.click("viewer", false);
    browser.read("viewer.focus()");
    let first = browser.read("view.blinkB");
    browser.wait(&format!("view.blinkB !== {first}"));
    browser.key(" ");
    let held = browser.read("view.blinkB") == true;
    assert_eq!(seen(&mut browser, 0.5), hand::colour(if held { 1 } else { 4 }));
}

#[test]
fn both_pictures_are_zoomed_about_the_pointer() {
    let (mut browser, _folder) = opened(|_| {});
    browser.click("document.querySelector('[data-mode=beside]')", false);
    let [x, y] = browser.middle("byId('pane-a')");
    let at = [x + 37.0, y - 21.0];
    browser.mouse("mouseMoved", at, false);
    let said = browser.text("byId('reading').textContent");
    let before = browser.number("view.scale");
    for _ in 0..6 {
        browser.wheel(at, -200.0);
    }
    browser.wait(&format!("view.scale > {}", before * 2.0));
    browser.mouse("mouseMoved", at, false);
    let now = browser.text("byId('reading').textContent");
    let pixel = |text: &str| text.split("  ").next().unwrap_or_default().to_owned();
    assert_eq!(pixel(&said), pixel(&now), "the pixel under the pointer stays there");
    assert!(said.starts_with("pixel "), "{said}");
    let stages = "[...viewer.querySelectorAll('.stage')].map((stage) => getComputedStyle(stage).transform)";
    assert_eq!(browser.read(&format!("new Set({stages}).size")), 1, "one zoom for both");
    assert_eq!(browser.text("getComputedStyle(imageC).imageRendering"), "pixelated");
}

#[test]
fn a_click_on_a_heading_sorts_numbers_as_numbers() {
    let (mut browser, _folder) = opened(|answer| {
        answer.records[2].snapshots.clear();
        answer.records[2].state =
            State::Failed { message: "</script><b>no".to_owned(), file: None, line: 0, column: 0 };
    });
    let heading = |name: &str| {
        format!("[...byId('numbers').querySelectorAll('th button')].find((b) => b.textContent.startsWith('{name}'))")
    };
    let column =
        |i: usize| format!("[...byId('numbers').tBodies[0].rows].map((row) => row.cells[{i}].textContent).join()");
    browser.click(&heading("materials.ball.ns"), false);
    assert_eq!(browser.text(&column(2)), "9,9,10,10,100,100,");
    browser.click(&heading("materials.ball.ns"), false);
    assert_eq!(browser.text(&column(2)), "100,100,10,10,9,9,", "what has none is last, either way");
    browser.click(&heading("seconds"), false);
    assert_eq!(browser.text(&column(5)), "0.510,0.550,2.00,2.04,9.03,11.1,");
    let note = "[...byId('numbers').tBodies[0].rows].at(-1).textContent";
    assert!(browser.text(note).contains("failed; </script><b>no"), "text of members is text");
    assert!(browser.text("byId('sheet').textContent").contains("</script><b>no"));
}

#[test]
fn nothing_is_asked_of_any_network() {
    let (mut browser, folder) = opened(|_| {});
    let blocked = "new Promise((tell) => { document.addEventListener('securitypolicyviolation', (e) => tell(e.blockedURI)); \
                   new Image().src = 'http://blocked.invalid/x.png'; })";
    assert_eq!(browser.text(blocked), "http://blocked.invalid/x.png");
    // The log would tell.
    let other = folder.path().join("other.html");
    fs::write(&other, "<img src='http://told.invalid/x.png'>").unwrap();
    browser.open(&address(&other));
    let requests = browser.requests();
    assert!(requests.iter().any(|url| url.contains("told.invalid")), "{requests:?}");
    let leaves = |url: &&String| !["file:", "data:"].iter().any(|kind| url.starts_with(kind));
    let left: Vec<&String> = requests.iter().filter(leaves).filter(|url| !url.contains("told.invalid")).collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn a_page_that_would_be_too_large_has_small_pictures_and_says_so() {
    let answer = hand::answer(0);
    let folder = tempfile::tempdir().unwrap();
    hand::pictures(&answer, folder.path());
    let whole = page::html(&answer, folder.path());
    let small = page::html_within(&answer, folder.path(), 100);
    assert!(whole.contains("\"small\":false") && small.contains("\"small\":true"));
    assert_eq!(small.matches("data:image/png").count(), answer.records.len());
}
