//! What was saved since the window opened: a row each of one height, the newest first. A click has a row's shaders run again.

use std::time::Duration;

use egui::{Color32, FontId, Label, RichText, ScrollArea, Sense, Ui, UiBuilder, Vec2};

use crate::app::edits::{Kind, Lint, State, age, now};
use crate::app::window::edits::Edits;
use crate::app::window::edits::record::{Record, Row, RowId};
use crate::app::window::judgement::Judgement;

/// Rows that are seen at once.
const ROWS: f32 = 5.0;

/// Lines of a row.
const LINES: f32 = 3.0;

/// Of the letters, points.
const SIZE: f32 = 11.0;

/// Between two looks at how long ago rows were saved.
const AGE: Duration = Duration::from_secs(60);

const GREEN: Color32 = Color32::from_rgb(120, 210, 130);
const RED: Color32 = Color32::from_rgb(255, 120, 105);
const AMBER: Color32 = Color32::from_rgb(240, 190, 90);
const GREY: Color32 = Color32::from_gray(150);

/// What the section shows.
pub struct EditsShown<'a> {
    pub record: &'a Record,
    pub automatic: bool,
    /// Judging waits for the device.
    pub rests: bool,
}

impl<'a> EditsShown<'a> {
    pub fn of(edits: &'a Edits, judgement: &Judgement) -> Self {
        Self { record: &edits.record, automatic: edits.automatic, rests: judgement.is_paused() }
    }
}

/// What a user wants of the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EditsAction {
    /// The shaders of a row are to run again.
    GoBack(RowId),
    /// Edits are to be judged by themselves, or not.
    Judge(bool),
}

/// The rows, and whether edits are judged by themselves. Returns what is wanted.
pub fn show(ui: &mut Ui, shown: &EditsShown) -> Option<EditsAction> {
    let mut action = None;
    let rows: Vec<&Row> = shown.record.rows().collect();
    if let [_] = rows[..] {
        ui.label(RichText::new("nothing was saved yet").color(GREY));
    } else {
        action = list(ui, shown, &rows).map(EditsAction::GoBack);
        ui.ctx().request_repaint_after(AGE);
    }
    let mut automatic = shown.automatic;
    let help = "an edit that changes what is traced is judged by the shaders that ran before it, while the window is left alone";
    if ui.checkbox(&mut automatic, "judge edits while idle").on_hover_text(help).changed() {
        action = Some(EditsAction::Judge(automatic));
    }
    action
}

/// The rows. Returns the one that is to run again.
fn list(ui: &mut Ui, shown: &EditsShown, rows: &[&Row]) -> Option<RowId> {
    let mut clicked = None;
    let line = ui.fonts_mut(|fonts| fonts.row_height(&FontId::proportional(SIZE)));
    let height = LINES * (line + 1.0) + 6.0;
    let all = ROWS * (height + ui.spacing().item_spacing.y);
    ScrollArea::vertical().id_salt("edits").max_height(all).show_rows(ui, height, rows.len(), |ui, seen| {
        for row in &rows[seen] {
            if show_row(ui, shown, row, height) {
                clicked = Some(row.id);
            }
        }
    });
    if shown.record.dropped() > 0 {
        let text = format!("{} older are gone from here; `lucerna edits` may have them", shown.record.dropped());
        ui.label(RichText::new(text).small().color(GREY));
    }
    clicked
}

/// Draws a row. Whether it was clicked, and there is something to go back to.
fn show_row(ui: &mut Ui, shown: &EditsShown, row: &Row, height: f32) -> bool {
    let runs = shown.record.running().id == row.id;
    let waits = shown.record.wanted() == Some(row.id);
    let can = row.shaders.is_some() && !runs;
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), height), Sense::click());
    let visuals = ui.visuals();
    let fill = match (runs, can && response.hovered()) {
        (true, _) => visuals.selection.bg_fill.gamma_multiply(0.55),
        (false, true) => visuals.widgets.hovered.weak_bg_fill,
        (false, false) => visuals.faint_bg_color,
    };
    ui.painter().rect_filled(rect, 3.0, fill);
    let mut inner = ui.new_child(UiBuilder::new().max_rect(rect.shrink2(Vec2::new(5.0, 3.0))));
    inner.spacing_mut().item_spacing.y = 1.0;
    let mut say = |text: String, colour: Color32| {
        inner.add(
            Label::new(RichText::new(text).size(SIZE).color(colour))
                .truncate()
                .show_tooltip_when_elided(false)
                .selectable(false),
        );
    };
    say(heading(row, runs, waits), Color32::from_gray(230));
    let before = row.before.as_ref().and_then(|(before, _)| shown.record.row(*before)?.number);
    let (text, colour) = verdict(row, before, shown.rests && runs);
    say(text, colour);
    let inherited = shown.record.inherited(row);
    let lint_colour = match (&row.edit.lint, inherited) {
        (Lint::Warned(_), _) => AMBER,
        (Lint::NotLinted, [_, ..]) => AMBER,
        _ => GREY,
    };
    if matches!(row.edit.kind, Kind::Shaders) {
        say(row.edit.lint_told(inherited), lint_colour);
    }
    let clicked = response.clicked();
    response.on_hover_ui(|ui| explain(ui, row, before, (runs, can), inherited));
    clicked && can
}

/// Number, files, age, time to pixels.
fn heading(row: &Row, runs: bool, waits: bool) -> String {
    let number = row.number.map_or(String::new(), |number| format!("{number}  "));
    let pixels = Some(row.edit.pixels_told()).filter(|pixels| !pixels.is_empty());
    let mark = match (runs, waits) {
        (_, true) => "  (compiling)",
        (true, _) => "  (runs)",
        _ => "",
    };
    let parts = [Some(row.edit.what()), Some(age(row.edit.saved, now())), pixels];
    number + &parts.into_iter().flatten().collect::<Vec<_>>().join(", ") + mark
}

/// What judging found, and by which row, by the number of that.
fn verdict(row: &Row, before: Option<u32>, rests: bool) -> (String, Color32) {
    let verdict = &row.edit.verdict;
    let colour = match verdict.state {
        State::Agree => GREEN,
        State::Differ | State::Failed => RED,
        State::CannotTell => AMBER,
        State::Judging => Color32::from_gray(205),
        State::None | State::Waiting | State::Left | State::Unchanged => GREY,
    };
    let text = match (verdict.state, rests) {
        (State::Judging, true) => verdict.short.replacen("judging", "judging rests", 1),
        _ => verdict.short.clone(),
    };
    let judged = matches!(verdict.state, State::Agree | State::Differ | State::CannotTell);
    let text = match before.filter(|_| judged) {
        Some(before) => format!("vs {before}: {text}"),
        None => text,
    };
    (text, colour)
}

/// All that a row has no room for.
fn explain(ui: &mut Ui, row: &Row, before: Option<u32>, (runs, can): (bool, bool), inherited: &[String]) {
    ui.set_max_width(420.0);
    let edit = &row.edit;
    for file in &edit.files {
        ui.monospace(file);
    }
    if !edit.verdict.line.is_empty() {
        ui.label(&edit.verdict.line);
    }
    if row.traces {
        let by = before
            .map_or("the shaders that ran before".to_owned(), |before| format!("edit {before}, which ran before"));
        ui.label(format!("judged by {by}"));
    }
    let own = match &edit.lint {
        Lint::Warned(warnings) => warnings,
        _ => inherited,
    };
    for warning in own {
        ui.label(RichText::new(warning).color(AMBER));
    }
    if runs {
        let judged = if row.traces { "; J judges them" } else { "" };
        ui.label(format!("these shaders run{judged}"));
    } else if can {
        ui.label("click: run these shaders again; no file is written");
    } else if edit.kind == Kind::Scene {
        ui.label("a scene's text is not kept");
    }
}
