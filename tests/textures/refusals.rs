//! Files that are no textures: each is told what is wrong with it, and nothing panics.

use image::{ExtendedColorType as Colour, ImageFormat};
use lucerna::image::TextureFile;

use super::{encoded, file, refused};

#[test]
fn what_is_no_picture_says_so() {
    for (name, bytes, words) in [
        ("a.png", &b"# a text\n"[..], &["is text", "PNG, JPEG, TGA, BMP, WebP, TIFF, EXR and Radiance HDR"][..]),
        ("a.jpg", b"\0\x01\x02\x80\xffnothing", &["no picture of a kind"]),
        ("a.png", b"", &["is empty"]),
        ("a.png", b"\x89PN", &["cut short"]),
        ("a.png", b"RIFF\x08\0\0\0WAVEfmt ", &["no picture of a kind"]),
        ("a.jpg", b"\xff\xd8\xff", &["cut short"]),
        ("a.jpg", b"\xff\xd8\xff\xe0\0\x04ab\xff\xd9", &["can't read"]),
    ] {
        let (_folder, path) = file(name, bytes);
        let text = refused(&path);
        assert!(words.iter().all(|word| text.contains(word)), "{name}: {text}");
    }
    let folder = tempfile::tempdir().unwrap();
    assert!(refused(folder.path()).contains("is a folder"));
    assert!(refused(&folder.path().join("none.png")).contains("can't open"));
}

#[test]
fn what_is_cut_short_says_so_or_is_told() {
    use ImageFormat::{Bmp, Jpeg, Png, Tga, Tiff, WebP};
    let noise: Vec<u8> = (0..40 * 30 * 3u32).map(|at| (at.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let names = [(Png, "a.png"), (Jpeg, "a.jpg"), (Bmp, "a.bmp"), (Tga, "a.tga"), (Tiff, "a.tif"), (WebP, "a.webp")];
    for (format, name) in names {
        let bytes = encoded(format, [40, 30], Colour::Rgb8, &noise);
        // The last byte of a WebP file may be one that only fills.
        let most = bytes.len() - usize::from(format == WebP);
        for length in (1..most).step_by(bytes.len() / 97) {
            let (_folder, path) = file(name, &bytes[..length]);
            match TextureFile::open(&path).and_then(TextureFile::read) {
                Ok(picture) => {
                    let [warning] = &picture.warnings[..] else { panic!("{name} of {length} bytes is read") };
                    assert!(format == Jpeg && warning.contains("its end is missing"), "{name}: {warning}");
                }
                Err(error) => assert!(error.to_string().contains("cut short"), "{length} bytes: {error}"),
            }
        }
    }
}

#[test]
fn a_broken_jpeg_is_told_or_read() {
    let noise: Vec<u8> = (0..64 * 64 * 3u32).map(|at| (at.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let mut bytes = encoded(ImageFormat::Jpeg, [64, 64], Colour::Rgb8, &noise);
    // Tables of codes that no decoder can build.
    let table = bytes.windows(2).position(|pair| pair == [0xff, 0xc4]).unwrap();
    bytes[table + 5..table + 21].fill(0xff);
    let (_folder, path) = file("a.jpg", &bytes);
    assert!(refused(&path).contains("can't read"));
}
