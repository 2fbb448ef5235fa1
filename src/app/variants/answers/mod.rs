//! What a family answers with: tables, a contact sheet, and a page that can be sent to somebody.
//!
//! | file | what it holds |
//! |---|---|
//! | `blocks` | which member stands in which row and column: the same on sheet and page |
//! | `numbers` | numbers as users read them; what follows from a record |
//! | `table` | `table.csv` and `table.md` |
//! | `thumb` | where a picture is, and how it is made small |
//! | `canvas`, `lettering` | pixels, and letters on them |
//! | `sheet` | `sheet.png` |
//! | `page` | `index.html`, of `page.html`, `page.css` and the scripts beside them |

pub mod blocks;
pub mod canvas;
pub mod lettering;
pub mod numbers;
pub mod page;
pub mod sheet;
pub mod table;
pub mod thumb;

use std::path::{Path, PathBuf};

use super::record::Answer;
use crate::image::{SaveError, file};

/// Writes `table.csv`, `table.md`, `sheet.png` and `index.html` into a folder whose `members` hold the pictures. Each file is
/// whole or not there.
pub fn write(answer: &Answer, folder: &Path) -> Result<Vec<PathBuf>, SaveError> {
    let [csv, markdown, sheet, page] =
        ["table.csv", "table.md", "sheet.png", "index.html"].map(|name| folder.join(name));
    file::write_text(&csv, &table::csv(answer))?;
    file::write_text(&markdown, &table::markdown(answer))?;
    sheet::write(answer, folder, &sheet)?;
    file::write_text(&page, &page::html(answer, folder))?;
    Ok(vec![csv, markdown, sheet, page])
}
