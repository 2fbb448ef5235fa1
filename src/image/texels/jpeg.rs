//! Whether a JPEG file has an end: its decoder takes what is missing for grey.
//!
//! Markers after ITU-T T.81, annex B.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use crate::image::error::Fault;
use crate::image::tail::Tail;

const END: u8 = 0xd9;

/// Whether the file has the marker that ends a picture. What follows that may be anything.
pub fn is_whole(path: &Path) -> Result<bool, Fault> {
    let mut file = BufReader::new(Tail::open(path)?);
    loop {
        let Some(marker) = marker(&mut file).map_err(Fault::Open)? else { return Ok(false) };
        match marker {
            END => return Ok(true),
            // Without a length: stuffing in scans, restarts, the start, and one that is reserved.
            0x00 | 0x01 | 0xd0..=0xd8 => {}
            _ => {
                let mut length = [0; 2];
                if file.read_exact(&mut length).is_err() {
                    return Ok(false);
                }
                let rest = u64::from(u16::from_be_bytes(length)).saturating_sub(2);
                std::io::copy(&mut (&mut file).take(rest), &mut std::io::sink()).map_err(Fault::Open)?;
            }
        }
    }
}

/// The byte after the next 0xff that is not one itself; none at the end of the file.
fn marker(file: &mut impl BufRead) -> std::io::Result<Option<u8>> {
    if file.skip_until(0xff)? == 0 {
        return Ok(None);
    }
    for byte in file.bytes() {
        match byte? {
            0xff => {}
            byte => return Ok(Some(byte)),
        }
    }
    Ok(None)
}
