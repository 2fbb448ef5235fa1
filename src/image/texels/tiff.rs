//! Whether the tables of a TIFF file are within it: its decoder takes memory for what they say before it looks.
//!
//! TIFF 6.0, section 2; and BigTIFF, whose numbers are twice as wide.

use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use crate::image::error::Fault;
use crate::image::tail::Tail;

/// How numbers are written in a file.
struct Numbers {
    file: BufReader<Tail>,
    little: bool,
}

/// Refuses a file whose first picture has tables that reach beyond its end.
pub fn check_tables(path: &Path) -> Result<(), Fault> {
    let file = Tail::open(path)?;
    let length = file.length()?;
    let mut file = Numbers { file: BufReader::new(file), little: false };
    match file.tables(length) {
        Ok(true) => Ok(()),
        Ok(false) => Err(Fault::CutShort),
        Err(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => Err(Fault::CutShort),
        Err(error) => Err(Fault::Open(error)),
    }
}

impl Numbers {
    /// Whether all tables end before the file does.
    fn tables(&mut self, length: u64) -> std::io::Result<bool> {
        self.little = self.number(2)? == 0x4949;
        let big = self.number(2)? == 43;
        let (wide, count) = if big { (8, 8) } else { (4usize, 2) };
        if big {
            // How wide offsets are, which is 8, and nothing.
            self.number(4)?;
        }
        let start = self.number(wide)?;
        self.file.seek(SeekFrom::Start(start))?;
        for _ in 0..self.number(count)? {
            let (_tag, kind) = (self.number(2)?, self.number(2)?);
            let (values, at) = (self.number(wide)?, self.number(wide)?);
            let bytes = values.saturating_mul(size(kind));
            if bytes > wide as u64 && at.saturating_add(bytes) > length {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn number(&mut self, bytes: usize) -> std::io::Result<u64> {
        let mut number = [0; 8];
        self.file.read_exact(&mut number[..bytes])?;
        if !self.little {
            number[..bytes].reverse();
        }
        Ok(u64::from_le_bytes(number))
    }
}

/// Bytes of a value of a kind.
fn size(kind: u64) -> u64 {
    match kind {
        3 | 8 => 2,
        4 | 9 | 11 | 13 => 4,
        5 | 10 | 12 | 16 | 17 | 18 => 8,
        _ => 1,
    }
}
