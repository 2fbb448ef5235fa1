//! The contact sheet: all members beside each other, with rows and columns named.

use std::panic::resume_unwind;
use std::path::Path;

use glam::UVec2;

use super::blocks::{Block, Cell, blocks};
use super::canvas::{Canvas, Rect};
use super::lettering::{Lettering, Text};
use super::numbers::state;
use super::thumb::{Thumb, picture_of};
use crate::app::variants::record::{Answer, Record, State};
use crate::image::{ReadError, SaveError};

/// The longest side of a small picture, pixels; less where there are very many.
pub const SIDE: u32 = 256;

/// Pixels of all small pictures together, as far as that leaves each something to be seen.
const MOST_PIXELS: u32 = 24_000_000;

/// Pixels around all, between cells, and between blocks.
const MARGIN: u32 = 28;
const GAP: u32 = 8;
const BLOCK_GAP: u32 = 36;

/// Heights of letters.
const TITLE: u32 = 22;
const HEADING: u32 = 16;
const LABEL: u32 = 14;

/// Lines of a text, at most.
const LINES: usize = 3;

/// Room for the labels of rows.
const ROW_LABEL: u32 = 150;

/// Blocks that stand side by side are at most so wide together, unless one alone is wider.
const WIDTH: u32 = 2600;

const PAPER: [u8; 3] = [255, 255, 255];
const INK: [u8; 3] = [34, 34, 34];
const PALE: [u8; 3] = [110, 110, 110];
const NOTHING: [[u8; 3]; 2] = [[250, 244, 242], [228, 206, 200]];

/// A small picture, or why there is none.
pub type Content = Result<Thumb, String>;

/// Where everything is.
pub struct Sheet {
    pub size: UVec2,
    pub cells: Vec<Placed>,
    pub labels: Vec<Label>,
}

/// The room of a member.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed {
    /// Among the records.
    pub member: usize,
    pub rect: Rect,
}

/// A text on the sheet.
pub struct Label {
    pub said: String,
    pub at: UVec2,
    text: Text,
    colour: [u8; 3],
}

impl Label {
    /// The pixels that it takes.
    pub fn rect(&self) -> Rect {
        Rect { min: self.at, size: self.text.size() }
    }
}

/// Writes the sheet of an answer whose pictures are in the folder's `members`.
pub fn write(answer: &Answer, folder: &Path, path: &Path) -> Result<(), SaveError> {
    let contents = read(answer, folder);
    let mut lettering = Lettering::default();
    let sheet = plan(answer, &contents, &mut lettering);
    draw(&sheet, answer, &contents, &mut lettering).write(path)
}

/// The small picture of each record.
pub fn read(answer: &Answer, folder: &Path) -> Vec<Content> {
    let count = u32::try_from(answer.records.len().max(1)).unwrap_or(u32::MAX);
    let side = SIDE.min((MOST_PIXELS / count).isqrt()).max(24);
    let content = |record: &Record| match record.state {
        State::Done | State::Lost { .. } => {
            Thumb::read(&picture_of(folder, &record.name), side).map_err(|error: ReadError| error.to_string())
        }
        State::Failed { .. } | State::Missing => Err(state(record).1),
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let part = answer.records.len().div_ceil(threads).max(1);
    std::thread::scope(|scope| {
        let parts = answer.records.chunks(part);
        let parts: Vec<_> =
            parts.map(|part| scope.spawn(move || part.iter().map(content).collect::<Vec<_>>())).collect();
        parts.into_iter().flat_map(|part| part.join().unwrap_or_else(|panic| resume_unwind(panic))).collect()
    })
}

/// Gives everything its place.
pub fn plan(answer: &Answer, contents: &[Content], lettering: &mut Lettering) -> Sheet {
    let room = contents.iter().flatten().fold(UVec2::ZERO, |most, thumb| most.max(thumb.size));
    let room = if room == UVec2::ZERO { UVec2::new(SIDE, SIDE * 3 / 4) } else { room.max(UVec2::new(96, 24)) };
    let mut sheet = Sheet { size: UVec2::ZERO, cells: Vec::new(), labels: Vec::new() };
    let title = lettering.lay(&answer.name, TITLE, WIDTH, 1);
    let (mut x, mut y) = (MARGIN, MARGIN + title.size().y + GAP);
    sheet.label(answer.name.clone(), title, UVec2::splat(MARGIN), INK);
    let mut below = y;
    for block in blocks(answer) {
        let size =
            Planner { block: &block, room, at: UVec2::new(x, y), lettering, sheet: &mut sheet, dry: true }.place();
        if x > MARGIN && x + size.x > WIDTH {
            (x, y) = (MARGIN, below + BLOCK_GAP);
        }
        Planner { block: &block, room, at: UVec2::new(x, y), lettering, sheet: &mut sheet, dry: false }.place();
        below = below.max(y + size.y);
        x += size.x + BLOCK_GAP;
    }
    let corners = sheet.cells.iter().map(|cell| cell.rect.max()).chain(sheet.labels.iter().map(|l| l.rect().max()));
    sheet.size = corners.fold(UVec2::ZERO, UVec2::max) + MARGIN;
    sheet
}

impl Sheet {
    fn label(&mut self, said: String, text: Text, at: UVec2, colour: [u8; 3]) {
        self.labels.push(Label { said, at, text, colour });
    }
}

/// Places one block.
struct Planner<'a> {
    block: &'a Block,
    room: UVec2,
    at: UVec2,
    lettering: &'a mut Lettering,
    sheet: &'a mut Sheet,
    /// Only how large it is.
    dry: bool,
}

impl Planner<'_> {
    /// Returns the size of the block.
    fn place(&mut self) -> UVec2 {
        let [rows, columns] = self.block.extent().map(|n| u32::try_from(n).unwrap_or(u32::MAX));
        let (start, room) = (self.at, self.room);
        let wide = columns.saturating_mul(room.x + GAP).max(room.x);
        let mut at = start;
        if !self.block.title.is_empty() {
            let labels = if self.block.rows.is_empty() { 0 } else { ROW_LABEL };
            at.y += self.say(&self.block.title.clone(), HEADING, labels + wide, at, INK).y + GAP;
        }
        let grid = !self.block.rows.is_empty();
        if grid {
            let corner = format!("rows: {}, columns: {}", self.block.row_axis, self.block.column_axis);
            at.y += self.say(&corner, LABEL, ROW_LABEL + wide, at, PALE).y + GAP;
            at.x += ROW_LABEL;
            let labels = self.block.columns.clone();
            let heights = labels.iter().zip(0..).map(|(label, column)| {
                let place = UVec2::new(at.x + column * (room.x + GAP), at.y);
                self.say(label, LABEL, room.x, place, INK).y
            });
            at.y += heights.max().unwrap_or(0) + GAP / 2;
            for (label, row) in self.block.rows.clone().iter().zip(0..) {
                let place = UVec2::new(start.x, at.y + row * (room.y + GAP) + room.y / 2 - LABEL.min(room.y / 2));
                self.say(label, LABEL, ROW_LABEL - GAP, place, INK);
            }
        }
        let caption = if grid { 0 } else { 2 * LABEL + GAP };
        let step = room + UVec2::new(GAP, GAP + caption);
        for Cell { row, column, member, caption } in self.block.cells.clone() {
            let place = at + UVec2::new(column as u32, row as u32) * step;
            if !self.dry {
                self.sheet.cells.push(Placed { member, rect: Rect { min: place, size: room } });
            }
            if !caption.is_empty() {
                self.say(&caption, LABEL, room.x, place + UVec2::new(0, room.y + GAP / 2), INK);
            }
        }
        at + UVec2::new(columns, rows) * step - start
    }

    /// Puts a text there; returns its size.
    fn say(&mut self, said: &str, height: u32, width: u32, at: UVec2, colour: [u8; 3]) -> UVec2 {
        let text = self.lettering.lay(said, height, width, LINES);
        let size = text.size();
        if !self.dry {
            self.sheet.label(said.to_owned(), text, at, colour);
        }
        size
    }
}

/// Draws the sheet.
pub fn draw(sheet: &Sheet, answer: &Answer, contents: &[Content], lettering: &mut Lettering) -> Canvas {
    let mut canvas = Canvas::new(sheet.size, PAPER);
    for Placed { member, rect } in &sheet.cells {
        match &contents[*member] {
            Ok(thumb) => canvas.put(rect.min + (rect.size - thumb.size) / 2, thumb.size, &thumb.pixels),
            Err(why) => {
                canvas.hatch(*rect, NOTHING[0], NOTHING[1]);
                say_over(&mut canvas, lettering, why, *rect, [150, 40, 20]);
            }
        }
        if let State::Lost { .. } = answer.records[*member].state {
            say_over(&mut canvas, lettering, &state(&answer.records[*member]).1, *rect, INK);
        }
    }
    for label in &sheet.labels {
        lettering.draw(&mut canvas, &label.text, label.at, label.colour);
    }
    canvas
}

/// A text within a cell, on paper of its own.
fn say_over(canvas: &mut Canvas, lettering: &mut Lettering, said: &str, rect: Rect, colour: [u8; 3]) {
    let width = rect.size.x.saturating_sub(2 * GAP);
    let lines = (rect.size.y.saturating_sub(2 * GAP) / (LABEL + 4)).clamp(1, 5) as usize;
    let text = lettering.lay(said, LABEL, width, lines);
    let size = text.size().min(rect.size.saturating_sub(UVec2::splat(GAP)));
    let min = rect.min + UVec2::splat(GAP / 2);
    canvas.fill(Rect { min, size: size + GAP / 2 }, PAPER);
    lettering.draw(canvas, &text, min + GAP / 4, colour);
}
