//! Radiance HDR: headers of several programs, orientations, scan lines of all three kinds.

use std::path::PathBuf;

use glam::UVec2;
use tempfile::TempDir;

use super::{refused, shown};

/// 2 in red, 1 in green, and blue by what the pixel is: the mantissa of x + 4 y in 128ths.
fn pixel(x: u32, y: u32) -> [u8; 4] {
    [128, 64, (x + 4 * y) as u8, 130]
}

fn colour(x: u32, y: u32) -> [f32; 3] {
    [2.0, 1.0, (x + 4 * y) as f32 / 64.0]
}

fn write(folder: &TempDir, header: &str, content: &[u8]) -> PathBuf {
    let path = folder.path().join("a.hdr");
    std::fs::write(&path, [header.as_bytes(), content].concat()).unwrap();
    path
}

/// Four by three pixels, flat, from the top left.
fn flat() -> Vec<u8> {
    (0..12).flat_map(|at| pixel(at % 4, at / 4)).collect()
}

fn colours() -> Vec<[f32; 3]> {
    (0..12).map(|at| colour(at % 4, at / 4)).collect()
}

#[test]
fn headers_of_any_program_are_read() {
    let folder = tempfile::tempdir().unwrap();
    for header in [
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 4\n",
        "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 4\n",
        "#?RGBE\n\n-Y 3 +X 4\n",
        "#?rpict\nrpict -vp 0 0 1 scene.oct\nFORMAT= 32-bit_rle_rgbe\nSOFTWARE= RADIANCE\n\n-Y 3 +X 4\n",
        "#?RADIANCE\r\n# Made with 100% pure HDR Shop\r\nFORMAT=32-bit_rle_rgbe\r\nEXPOSURE=          1.0000000000000\r\n\r\n-Y 3 +X 4\r\n",
        "VIEW= -vtv\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 4\n",
        "FORMAT=32-bit_rle_rgbe\n\n-Y 3  +X 4\n",
        "#?RADIANCE\n# EXPOSURE=7\nGAMMA=1\nPRIMARIES=0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333\n\n-Y 3 +X 4\n",
        "#?RADIANCE\nCAPDATE= 2026:01:01\nK\u{fc}che=x\nno value\n\tEXPOSURE=9\n\n-Y 3 +X 4\n",
    ] {
        let found = shown(&write(&folder, header, &flat()));
        assert!(found.size == UVec2::new(4, 3) && found.warnings.is_empty(), "{header}: {:?}", found.warnings);
        assert_eq!(found.pixels, colours(), "{header}");
    }
}

#[test]
fn what_was_done_to_pixels_is_undone() {
    let folder = tempfile::tempdir().unwrap();
    for (lines, right) in [
        ("EXPOSURE=2.0\n", [0.5; 3]),
        ("EXPOSURE= 0.25\n", [4.0; 3]),
        ("EXPOSURE=2\nEXPOSURE=4e0\nEXPOSURE =.5\n", [0.25; 3]),
        ("COLORCORR= 1 2 4\n", [1.0, 0.5, 0.25]),
        ("EXPOSURE=0.5\nCOLORCORR=1.0 2.0 4.0\nCOLORCORR=0.5 0.5 0.5\n", [4.0, 2.0, 1.0]),
    ] {
        let header = format!("#?RADIANCE\n{lines}FORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 4\n");
        let found = shown(&write(&folder, &header, &flat()));
        for (found, plain) in found.pixels.iter().zip(colours()) {
            assert_eq!(*found, [0, 1, 2].map(|c| plain[c] * right[c]), "{lines}");
        }
    }
    for wrong in [
        "EXPOSURE=0",
        "EXPOSURE=-1",
        "EXPOSURE=",
        "EXPOSURE=two",
        "EXPOSURE=nan",
        "EXPOSURE=inf",
        "COLORCORR=1 2",
        "COLORCORR=1 0 1",
    ] {
        let text = refused(&write(&folder, &format!("#?RADIANCE\n{wrong}\n\n-Y 3 +X 4\n"), &flat()));
        assert!(text.contains(wrong.split('=').next().unwrap()), "{wrong}: {text}");
    }
}

#[test]
fn what_is_not_undone_is_told_and_other_formats_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    for (line, word) in [("GAMMA=2.2", "GAMMA of 2.2"), ("PRIMARIES=0.7 0.3 0.17 0.8 0.13 0.05 0.33 0.33", "PRIMARIES")]
    {
        let found = shown(&write(&folder, &format!("#?RADIANCE\n{line}\n\n-Y 3 +X 4\n"), &flat()));
        assert!(found.warnings.len() == 1 && found.warnings[0].contains(word), "{:?}", found.warnings);
    }
    for format in ["32-bit_rle_xyze", "32-bit_rle_luv", "ascii"] {
        let text = refused(&write(&folder, &format!("#?RADIANCE\nFORMAT={format}\n\n-Y 3 +X 4\n"), &flat()));
        assert!(text.contains(format), "{text}");
    }
    for size in ["", "-Y 3", "-Y 3 +Z 4", "-Y three +X 4", "-Y 3 +Y 4", "-Y 3 +X 4 5", "-Y -3 +X 4", "3 4"] {
        refused(&write(&folder, &format!("#?RADIANCE\n\n{size}\n"), &flat()));
    }
    assert!(refused(&write(&folder, "#?RADIANCE\n\n-Y 0 +X 4\n", &flat())).contains("4x0 pixels is empty"));
    for size in ["-Y 3 +X 16385", "-Y 4000000000 +X 4000000000"] {
        assert!(refused(&write(&folder, &format!("#?RADIANCE\n\n{size}\n"), &flat())).contains("too large"));
    }
    let endless = "EXPOSURE=1\n".repeat(200_000);
    refused(&write(&folder, &format!("#?RADIANCE\n{endless}\n-Y 3 +X 4\n"), &flat()));
}

#[test]
fn every_orientation_is_turned_upright() {
    let folder = tempfile::tempdir().unwrap();
    for columns in [false, true] {
        for (up, left) in [(false, false), (false, true), (true, false), (true, true)] {
            let y = if up { "+Y 3" } else { "-Y 3" };
            let x = if left { "-X 4" } else { "+X 4" };
            let rows: Vec<u32> = if up { vec![2, 1, 0] } else { vec![0, 1, 2] };
            let row: Vec<u32> = if left { vec![3, 2, 1, 0] } else { vec![0, 1, 2, 3] };
            let mut content = Vec::new();
            if columns {
                row.iter().for_each(|x| rows.iter().for_each(|y| content.extend(pixel(*x, *y))));
            } else {
                rows.iter().for_each(|y| row.iter().for_each(|x| content.extend(pixel(*x, *y))));
            }
            let size = if columns { format!("{x} {y}") } else { format!("{y} {x}") };
            let found = shown(&write(&folder, &format!("#?RADIANCE\nEXPOSURE=2\n\n{size}\n"), &content));
            assert_eq!(found.size, UVec2::new(4, 3), "{size}");
            let right: Vec<[f32; 3]> = colours().iter().map(|pixel| pixel.map(|channel| channel / 2.0)).collect();
            assert_eq!(found.pixels, right, "{size}");
        }
    }
}

#[test]
fn scan_lines_of_all_three_kinds_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 300\n";
    let right: Vec<[f32; 3]> = (0..600).map(|_| [1.0, 0.5, 0.25]).collect();
    // Repeated pixels: 300 = 1 + 43 + 256.
    let old: Vec<u8> = (0..2).flat_map(|_| [128, 64, 32, 129, 1, 1, 1, 43, 1, 1, 1, 1]).collect();
    assert_eq!(shown(&write(&folder, header, &old)).pixels, right);
    // A scan line by its channels: runs of 127 and 46, and a literal.
    let mut new = Vec::new();
    for _ in 0..2 {
        new.extend([2, 2, 1, 44]);
        for value in [128, 64, 32, 129] {
            new.extend([255, value, 255, value, 128 + 44, value, 2, value, value]);
        }
    }
    assert_eq!(shown(&write(&folder, header, &new)).pixels, right);
    let flat: Vec<u8> = (0..600).flat_map(|_| [128, 64, 32, 129]).collect();
    assert_eq!(shown(&write(&folder, header, &flat)).pixels, right);
    // A run beyond its scan line.
    refused(&write(&folder, header, &[&[2, 2, 1, 44][..], &[255, 1].repeat(3)].concat()));
}
