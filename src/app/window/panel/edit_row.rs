//! One row of the section Edits, and all that it has no room for.

use egui::{Color32, FontId, Label, RichText, Sense, Ui, UiBuilder, Vec2};

use crate::app::edits::{Kind, Lint, State, age, now};
use crate::app::window::edits::record::{Record, Row};

/// Lines of a row.
const LINES: f32 = 3.0;

/// Of the letters, points.
const SIZE: f32 = 11.0;

const GREEN: Color32 = Color32::from_rgb(120, 210, 130);
const RED: Color32 = Color32::from_rgb(255, 120, 105);
const AMBER: Color32 = Color32::from_rgb(240, 190, 90);
pub const GREY: Color32 = Color32::from_gray(150);

/// A row, and what the record says of it.
pub struct EditRow<'a> {
    row: &'a Row,
    /// The number of the row that it is judged by.
    before: Option<u32>,
    /// Its shaders run.
    runs: bool,
    /// Its shaders are being compiled to run again.
    waits: bool,
    /// Its judging waits for the device.
    rests: bool,
    /// There is something to go back to.
    can_run: bool,
    /// Warnings of edits before it that still stand.
    inherited: &'a [String],
}

/// Height of a row, points.
pub fn height(ui: &Ui) -> f32 {
    let line = ui.fonts_mut(|fonts| fonts.row_height(&FontId::proportional(SIZE)));
    LINES * (line + 1.0) + 6.0
}

impl<'a> EditRow<'a> {
    /// `rests` is whether judging waits for the device.
    pub fn of(record: &'a Record, row: &'a Row, rests: bool) -> Self {
        let runs = record.running().id == row.id;
        Self {
            row,
            before: row.before.as_ref().and_then(|(before, _)| record.row(*before)?.number),
            runs,
            waits: record.wanted() == Some(row.id),
            rests: rests && runs,
            can_run: row.shaders.is_some() && !runs,
            inherited: record.inherited(row),
        }
    }

    /// Draws it. Says whether it was clicked, and there is something to go back to.
    pub fn show(&self, ui: &mut Ui, height: f32) -> bool {
        let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), height), Sense::click());
        let visuals = ui.visuals();
        let fill = match (self.runs, self.can_run && response.hovered()) {
            (true, _) => visuals.selection.bg_fill.gamma_multiply(0.55),
            (false, true) => visuals.widgets.hovered.weak_bg_fill,
            (false, false) => visuals.faint_bg_color,
        };
        ui.painter().rect_filled(rect, 3.0, fill);
        let mut inner = ui.new_child(UiBuilder::new().max_rect(rect.shrink2(Vec2::new(5.0, 3.0))));
        inner.spacing_mut().item_spacing.y = 1.0;
        let lines = [Some((self.heading(), Color32::from_gray(230))), Some(self.verdict()), self.lint()];
        for (text, colour) in lines.into_iter().flatten() {
            let text = RichText::new(text).size(SIZE).color(colour);
            inner.add(Label::new(text).truncate().show_tooltip_when_elided(false).selectable(false));
        }
        let clicked = response.clicked();
        response.on_hover_ui(|ui| self.explain(ui));
        clicked && self.can_run
    }

    /// Number, files, age, time to pixels.
    fn heading(&self) -> String {
        let Self { row, .. } = self;
        let number = row.number.map_or(String::new(), |number| format!("{number}  "));
        let pixels = Some(row.edit.pixels_told()).filter(|pixels| !pixels.is_empty());
        let mark = match (self.runs, self.waits) {
            (_, true) => "  (compiling)",
            (true, _) => "  (runs)",
            _ => "",
        };
        let parts = [Some(row.edit.what()), Some(age(row.edit.saved, now())), pixels];
        number + &parts.into_iter().flatten().collect::<Vec<_>>().join(", ") + mark
    }

    /// What judging found, and by which row, by the number of that.
    fn verdict(&self) -> (String, Color32) {
        let verdict = &self.row.edit.verdict;
        let colour = match verdict.state {
            State::Agree => GREEN,
            State::Differ | State::Failed => RED,
            State::CannotTell => AMBER,
            State::Judging => Color32::from_gray(205),
            State::None | State::Waiting | State::Left | State::Unchanged => GREY,
        };
        let text = match (verdict.state, self.rests) {
            (State::Judging, true) => verdict.short.replacen("judging", "judging rests", 1),
            _ => verdict.short.clone(),
        };
        let judged = matches!(verdict.state, State::Agree | State::Differ | State::CannotTell);
        let text = match self.before.filter(|_| judged) {
            Some(before) => format!("vs {before}: {text}"),
            None => text,
        };
        (text, colour)
    }

    /// What lint found, where shaders were saved.
    fn lint(&self) -> Option<(String, Color32)> {
        let edit = &self.row.edit;
        let colour = match (&edit.lint, self.inherited) {
            (Lint::Warned(_), _) | (Lint::NotLinted, [_, ..]) => AMBER,
            _ => GREY,
        };
        (edit.kind == Kind::Shaders).then(|| (edit.lint_told(self.inherited), colour))
    }

    /// All that the row has no room for.
    fn explain(&self, ui: &mut Ui) {
        ui.set_max_width(420.0);
        let Self { row, .. } = self;
        for file in &row.edit.files {
            ui.monospace(file);
        }
        if !row.edit.verdict.line.is_empty() {
            ui.label(&row.edit.verdict.line);
        }
        if row.traces {
            let by = self
                .before
                .map_or("the shaders that ran before".to_owned(), |before| format!("edit {before}, which ran before"));
            ui.label(format!("judged by {by}"));
        }
        let warnings = match &row.edit.lint {
            Lint::Warned(warnings) => warnings,
            _ => self.inherited,
        };
        for warning in warnings {
            ui.label(RichText::new(warning).color(AMBER));
        }
        if self.runs {
            let judged = if row.traces { "; J judges them" } else { "" };
            ui.label(format!("these shaders run{judged}"));
        } else if self.can_run {
            ui.label("click: run these shaders again; no file is written");
        } else if row.edit.kind == Kind::Scene {
            ui.label("a scene's text is not kept");
        }
    }
}
