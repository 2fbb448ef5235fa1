//! Which member stands in which row and column: rows are the first axis, columns the second, and each choice on the others is a
//! block of its own. Members without a place on the axes are a block at the end.

use std::collections::BTreeMap;

use crate::app::variants::record::{Answer, Record};

/// Cells in a row where there is but one axis, or none.
pub const WRAP: usize = 6;

/// Members that are shown together.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Block {
    /// What its members have in common; empty where there is one block alone.
    pub title: String,
    /// Names of the axes; empty where cells have captions of their own.
    pub row_axis: String,
    pub column_axis: String,
    /// Labels; none where cells have captions of their own.
    pub rows: Vec<String>,
    pub columns: Vec<String>,
    pub cells: Vec<Cell>,
}

/// A member's place in its block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    pub row: usize,
    pub column: usize,
    /// Among the records.
    pub member: usize,
    /// Below the picture; empty where rows and columns say it.
    pub caption: String,
}

impl Block {
    /// Rows and columns of its cells.
    pub fn extent(&self) -> [usize; 2] {
        let most = |of: fn(&Cell) -> usize| self.cells.iter().map(|cell| of(cell) + 1).max().unwrap_or(0);
        [self.rows.len().max(most(|cell| cell.row)), self.columns.len().max(most(|cell| cell.column))]
    }
}

/// All blocks of an answer, every record in one of them.
pub fn blocks(answer: &Answer) -> Vec<Block> {
    let (placed, by_hand): (Vec<usize>, Vec<usize>) =
        (0..answer.records.len()).partition(|&member| is_placed(answer, &answer.records[member]));
    let mut blocks = match answer.axes.len() {
        0 => Vec::new(),
        1 => vec![wrapped(answer.axes[0].name.clone(), &placed, |member| {
            answer.axes[0].labels[answer.records[member].at[0]].clone()
        })],
        _ => grids(answer, &placed),
    };
    blocks.retain(|block| !block.cells.is_empty());
    if !by_hand.is_empty() {
        let title = if blocks.is_empty() { String::new() } else { "by hand".to_owned() };
        blocks.push(wrapped(title, &by_hand, |member| answer.records[member].name.clone()));
    }
    blocks
}

/// Whether a record has a place on each axis.
fn is_placed(answer: &Answer, record: &Record) -> bool {
    !record.at.is_empty()
        && record.at.len() == answer.axes.len()
        && record.at.iter().zip(&answer.axes).all(|(&at, axis)| at < axis.labels.len())
}

/// Cells one after the other, each with a caption.
fn wrapped(title: String, members: &[usize], caption: impl Fn(usize) -> String) -> Block {
    let cell =
        |(i, &member): (usize, &usize)| Cell { row: i / WRAP, column: i % WRAP, member, caption: caption(member) };
    Block { title, cells: members.iter().enumerate().map(cell).collect(), ..Block::default() }
}

/// A block for each choice on the third axis and those behind it.
fn grids(answer: &Answer, members: &[usize]) -> Vec<Block> {
    let mut blocks: BTreeMap<&[usize], Block> = BTreeMap::new();
    for &member in members {
        let (at, further) = answer.records[member].at.split_at(2);
        let block = blocks.entry(further).or_insert_with(|| Block {
            title: title(answer, further),
            row_axis: answer.axes[0].name.clone(),
            column_axis: answer.axes[1].name.clone(),
            rows: answer.axes[0].labels.clone(),
            columns: answer.axes[1].labels.clone(),
            cells: Vec::new(),
        });
        block.cells.push(Cell { row: at[0], column: at[1], member, caption: String::new() });
    }
    blocks.into_values().collect()
}

fn title(answer: &Answer, further: &[usize]) -> String {
    let said = answer.axes[2..].iter().zip(further).map(|(axis, &at)| format!("{}: {}", axis.name, axis.labels[at]));
    said.collect::<Vec<_>>().join(", ")
}
