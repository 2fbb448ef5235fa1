//! What was saved since the window opened: a row each of one height, the newest first. A click has a row's shaders run again.

use std::time::Duration;

use egui::{RichText, ScrollArea, Ui};

use super::edit_row::{self, EditRow, GREY};
use crate::app::window::edits::Edits;
use crate::app::window::edits::record::{Record, Row, RowId};
use crate::app::window::judgement::Judgement;

/// Rows that are seen at once. There is room for them from the start, so that nothing below moves when something is saved.
const ROWS: f32 = 3.0;

/// Between two looks at how long ago rows were saved.
const AGE: Duration = Duration::from_secs(60);

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
    let room = egui::vec2(ui.available_width(), ROWS * (edit_row::height(ui) + ui.spacing().item_spacing.y));
    ui.allocate_ui(room, |ui| {
        ui.set_min_size(room);
        if let [_] = rows[..] {
            ui.label(RichText::new("nothing was saved yet").color(GREY));
        } else {
            action = list(ui, shown, &rows).map(EditsAction::GoBack);
            ui.ctx().request_repaint_after(AGE);
        }
    });
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
    let height = edit_row::height(ui);
    // The line below the rows is of half a row at most.
    let below = if shown.record.dropped() > 0 { 0.5 * height } else { 0.0 };
    let all = ui.available_height() - below;
    ScrollArea::vertical().id_salt("edits").max_height(all).show_rows(ui, height, rows.len(), |ui, seen| {
        for row in &rows[seen] {
            if EditRow::of(shown.record, row, shown.rests).show(ui, height) {
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
