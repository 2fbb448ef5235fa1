//! Scenes whose materials name pictures: what is read, how, how often, and what is told.

use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::{Duration, SystemTime};

use glam::UVec2;
use image::{ExtendedColorType as Colour, ImageFormat};
use lucerna::components::{Channel, Reading, Texels, Texture};
use lucerna::scene::{self, Loaded, Loading, Severity};
use tempfile::TempDir;

use super::encoded;

/// A folder with a triangle whose material has these statements; `b` is a material that no triangle has.
fn folder(statements: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let obj = "mtllib a.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    std::fs::write(folder.path().join("a.obj"), obj).unwrap();
    std::fs::write(folder.path().join("a.mtl"), format!("newmtl a\n{statements}\nnewmtl b\nmap_Kd unused.png\n"))
        .unwrap();
    std::fs::write(folder.path().join("unused.png"), "no picture, and nobody reads it").unwrap();
    folder
}

fn save(folder: &Path, name: &str, size: [u32; 2], colour: Colour, bytes: &[u8]) {
    let format = ImageFormat::from_path(name).unwrap();
    std::fs::write(folder.join(name), encoded(format, size, colour, bytes)).unwrap();
}

/// As if a file had not been touched for an hour: its stamp tells all.
fn age(path: &Path) {
    let file = std::fs::File::options().write(true).open(path).unwrap();
    file.set_modified(SystemTime::now() - Duration::from_secs(3600)).unwrap();
}

fn load(folder: &Path) -> Loaded {
    scene::load(&folder.join("a.obj"), &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// The only texture of a scene.
fn texture(loaded: &Loaded) -> &Texture {
    let mut textures = loaded.description.textures.values();
    let texture = textures.next().unwrap_or_else(|| panic!("no texture: {:?}", loaded.warnings));
    assert!(textures.next().is_none());
    texture
}

fn told(loaded: &Loaded, words: &[&str]) -> bool {
    let texts: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    texts.iter().any(|text| words.iter().all(|word| text.contains(word)))
}

#[test]
fn maps_of_materials_that_are_seen_are_read() {
    let folder = folder("map_Kd wood.png");
    save(folder.path(), "wood.png", [2, 1], Colour::Rgb8, &[1, 2, 3, 4, 5, 6]);
    let loaded = load(folder.path());
    let texture = texture(&loaded);
    assert_eq!(texture.image.texels, Texels::Rgba8(vec![[1, 2, 3, 255], [4, 5, 6, 255]]));
    assert_eq!(texture.reading, Reading::Colour);
    assert!(loaded.files.contains(&folder.path().join("wood.png")));
    assert!(!loaded.files.contains(&folder.path().join("unused.png")) && !told(&loaded, &["unused"]));
}

#[test]
fn numbers_are_alpha_where_that_says_something() {
    for (name, colour, bytes, channel) in [
        ("a.png", Colour::Rgba8, vec![9, 9, 9, 100], Channel::Alpha),
        ("a.png", Colour::Rgba8, vec![9, 9, 9, 255], Channel::Luminance),
        ("a.png", Colour::Rgb8, vec![9, 9, 9], Channel::Luminance),
        ("a.png", Colour::L8, vec![9], Channel::Red),
        ("a.png", Colour::La8, vec![9, 8], Channel::Alpha),
    ] {
        let folder = folder("map_d a.png");
        save(folder.path(), name, [1, 1], colour, &bytes);
        assert_eq!(texture(&load(folder.path())).reading, Reading::Number(channel), "{colour:?} {bytes:?}");
    }
}

#[test]
fn pictures_of_directions_are_told_from_heights() {
    let directions: Vec<u8> = (0..64).flat_map(|at| [(100 + at) as u8, (160 - at) as u8, 245]).collect();
    let bright: Vec<u8> = (0..64).flat_map(|at| [192 + at as u8 / 2; 3]).collect();
    let wood: Vec<u8> = (0..64).flat_map(|at| [120 + at as u8, 80 + at as u8 / 2, 40]).collect();
    for (bytes, heights) in [(directions, false), (bright, true), (wood, true)] {
        let folder = folder("bump a.png");
        save(folder.path(), "a.png", [8, 8], Colour::Rgb8, &bytes);
        let loaded = load(folder.path());
        let reading = texture(&loaded).reading;
        let right = match heights {
            true => Reading::Height { channel: Channel::Luminance, depth: 0.01 },
            false => Reading::Normal { flip_green: false },
        };
        assert_eq!(reading, right);
        assert_eq!(told(&loaded, &["a.png", "map of directions"]), !heights, "{:?}", loaded.warnings);
    }
}

#[test]
fn a_picture_that_can_not_be_read_leaves_the_plain_colour() {
    for (bytes, words) in [(&b"a text"[..], "is text"), (b"\xff\xd8\xff\xe0", "cut short"), (b"", "is empty")] {
        let folder = folder("Kd 0.5 0.5 0.5\nmap_Kd a.png");
        std::fs::write(folder.path().join("a.png"), bytes).unwrap();
        let loaded = load(folder.path());
        assert!(loaded.description.textures.is_empty());
        assert!(told(&loaded, &["can't use `", "a.png` as a texture", words, "help"]), "{:?}", loaded.warnings);
        assert!(loaded.warnings.iter().all(|warning| warning.severity == Severity::Warning));
    }
}

#[test]
fn a_missing_picture_is_looked_for() {
    let folder = folder("map_Kd a.png");
    let loaded = load(folder.path());
    assert!(loaded.description.textures.is_empty() && told(&loaded, &["a.png"]));
    assert!(loaded.files.contains(&folder.path().join("a.png")));
    save(folder.path(), "a.png", [1, 1], Colour::L8, &[3]);
    assert_eq!(texture(&load(folder.path())).image.texels, Texels::Grey8(vec![3]));
}

#[test]
fn a_file_is_decoded_once() {
    let folder = folder("map_Kd a.png\nmap_Ks ./a.png\nmap_d b.png\nmap_Ns b.png");
    save(folder.path(), "a.png", [1, 1], Colour::Rgb8, &[3, 4, 5]);
    save(folder.path(), "b.png", [1, 1], Colour::L8, &[3]);
    for name in ["a.png", "b.png"] {
        age(&folder.path().join(name));
    }
    let counts = Mutex::new(Vec::new());
    let tell = |done, all| counts.lock().unwrap().push((done, all));
    let loading = Loading { tell: &tell, ..Loading::default() };
    let read = || scene::load_with(&folder.path().join("a.obj"), &[], &loading).unwrap();
    let images = |loaded: &Loaded| {
        let mut images: Vec<_> = loaded.description.textures.values().map(|texture| texture.image.clone()).collect();
        images.dedup_by(|a, b| Arc::ptr_eq(a, b));
        images
    };
    let first = read();
    assert_eq!((first.description.textures.len(), images(&first).len()), (3, 2), "{:?}", first.description.textures);
    let mut told = std::mem::take(&mut *counts.lock().unwrap());
    told.sort();
    assert_eq!(told, [(0, 2), (1, 2), (2, 2)]);
    // What did not change is not decoded again.
    let second = read();
    assert!(counts.lock().unwrap().is_empty());
    let same = |(a, b): (&Arc<_>, &Arc<_>)| Arc::ptr_eq(a, b);
    assert!(images(&first).iter().zip(&images(&second)).all(same));
    // What did, is, alone.
    save(folder.path(), "b.png", [2, 1], Colour::L8, &[3, 4]);
    let third = read();
    assert_eq!(*counts.lock().unwrap(), [(0, 1), (1, 1)]);
    let shared = images(&third).iter().filter(|image| images(&first).iter().any(|old| Arc::ptr_eq(old, image))).count();
    assert_eq!(shared, 1);
    // Nobody but the scenes holds the memory.
    let held = Arc::downgrade(&images(&first)[0]);
    drop((first, second, third));
    assert!(held.upgrade().is_none());
}

#[test]
fn a_file_saved_twice_within_a_moment_is_read_anew() {
    let folder = folder("map_Kd a.png");
    for code in 0..20 {
        save(folder.path(), "a.png", [1, 1], Colour::L8, &[code]);
        let loaded = load(folder.path());
        assert_eq!(texture(&loaded).image.texels, Texels::Grey8(vec![code]));
    }
}

#[test]
fn pictures_beyond_the_bound_are_halved_and_told() {
    let folder = folder("map_Kd large.png\nmap_Ks small.png");
    save(folder.path(), "large.png", [64, 32], Colour::Rgb8, &[200; 64 * 32 * 3]);
    save(folder.path(), "small.png", [8, 8], Colour::Rgb8, &[100; 8 * 8 * 3]);
    let sizes = |texture_bytes: u64| {
        let loading = Loading { texture_bytes, ..Loading::default() };
        let loaded = scene::load_with(&folder.path().join("a.obj"), &[], &loading).unwrap();
        let sizes: Vec<UVec2> = loaded.description.textures.values().map(|texture| texture.image.size).collect();
        (sizes, loaded)
    };
    let (large, small) = (64 * 32 * 4, 8 * 8 * 4);
    let (all, loaded) = sizes(large + small);
    assert!(all == [UVec2::new(64, 32), UVec2::new(8, 8)] && !told(&loaded, &["smaller"]));
    let (all, loaded) = sizes(large + small - 1);
    assert_eq!(all, [UVec2::new(32, 16), UVec2::new(8, 8)]);
    assert!(told(&loaded, &["large.png` is made smaller, from 64x32 to 32x16"]), "{:?}", loaded.warnings);
    let Texels::Rgba8(texels) = &loaded.description.textures.values().next().unwrap().image.texels else { panic!() };
    assert!(texels.iter().all(|texel| *texel == [200, 200, 200, 255]));
    let (all, _) = sizes(small);
    assert!(all[0].element_product() + all[1].element_product() <= 64, "{all:?}");
    // Whatever the bound, something is left.
    assert_eq!(sizes(0).0.len(), 2);
}
