//! Pictures that are saved, maps that are exchanged, and pictures that are not there.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use lucerna::scene;
use lucerna::watch::{Attempt, ReloadEvent, WatchedScene};

use super::{Bench, MTL, OBJ, SETTLED, save_quickly};

/// Texels of a side of the small pictures here.
const SIDE: u32 = 16;

/// A picture of so many texels a side, in stripes of a colour.
fn write_stripes(path: &Path, side: u32, colour: [u8; 3]) {
    fs::write(path, stripes(side, colour)).unwrap();
}

/// The file's bytes.
fn stripes(side: u32, colour: [u8; 3]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, side, side);
    encoder.set_color(png::ColorType::Rgb);
    let texels = (0..side * side).flat_map(|i| if i % 5 < 2 { [40, 50, 60] } else { colour });
    encoder.write_header().unwrap().write_image_data(&texels.collect::<Vec<_>>()).unwrap();
    file
}

/// The bench's scene with a picture on the floor, and another on the lamp.
fn bench() -> Bench {
    bench_by(|path| WatchedScene::file(path, Vec::new(), Box::new(|_| {})))
}

/// The same, whose scene is read again in a way of its own.
fn bench_by(watched: impl FnOnce(PathBuf) -> WatchedScene) -> Bench {
    let prepare = |root: &Path| {
        let uvs = "vt 0 0\nvt 2 0\nvt 2 2\nvt 0 2\nusemtl floor\nf 1/1 4/4 3/3 2/2\n";
        let obj = OBJ.replace("usemtl floor\nf 1 4 3 2\n", uvs).replace("f 5 6 7 8", "f 5/1 6/2 7/3 8/4");
        fs::write(root.join("room.obj"), obj).unwrap();
        let mtl = MTL.replace("Kd 0.5 0.5 0.5", "Kd 0.8 0.8 0.8\nmap_Kd floor.png");
        fs::write(root.join("room.mtl"), mtl.replace("Ke 3 3 3", "Ke 3 3 3\nmap_Ke lamp.png")).unwrap();
        write_stripes(&root.join("floor.png"), SIDE, [200, 90, 40]);
        write_stripes(&root.join("lamp.png"), SIDE, [255, 255, 200]);
        write_stripes(&root.join("other.png"), SIDE, [40, 200, 90]);
    };
    Bench::opened_by(prepare, watched)
}

/// Bytes sent to each buffer while something is done and the film finished.
fn uploads(bench: &mut Bench, work: impl FnOnce(&mut Bench)) -> BTreeMap<&'static str, u64> {
    let before = bench.engine.uploads().clone();
    work(bench);
    bench.finish();
    let after = bench.engine.uploads().clone();
    let grown = after.into_iter().map(|(buffer, bytes)| (buffer, bytes - before.get(buffer).copied().unwrap_or(0)));
    grown.filter(|(_, bytes)| *bytes > 0).collect()
}

#[test]
fn a_picture_that_is_saved_is_sent_alone() {
    let mut bench = bench();
    let bytes = bench.engine.textures().iter().map(|used| (used.name.contains("floor.png"), used.bytes));
    let of_floor = bytes.filter(|(floor, _)| *floor).map(|(_, bytes)| bytes).next().unwrap();
    let dispatched = bench.dispatches(|bench| {
        let sent = uploads(bench, |bench| {
            write_stripes(&bench.path("floor.png"), SIDE, [90, 40, 200]);
            assert_eq!(bench.reloaded(), "film");
        });
        assert_eq!(sent.keys().copied().collect::<Vec<_>>(), ["params", "texels"], "{sent:?}");
        assert_eq!(sent["texels"], of_floor, "the floor's texture, and no other");
    });
    assert!(dispatched.keys().all(|pass| ["path", "accumulate", "display"].contains(pass)), "{dispatched:?}");
    assert!(bench.film().pixels == bench.fresh_film().pixels);

    // One of another size: the picture is in another place, and the film the same as that of a fresh engine.
    write_stripes(&bench.path("floor.png"), 2 * SIDE, [90, 140, 20]);
    assert_eq!(bench.reloaded(), "film");
    assert!(bench.film().pixels == bench.fresh_film().pixels);
}

#[test]
fn a_map_is_exchanged_and_one_that_is_missing_leaves_the_plain_colour() {
    let mut bench = bench();
    bench.replace("room.mtl", "floor.png", "other.png");
    assert_eq!(bench.reloaded(), "film");
    assert!(bench.film().pixels == bench.fresh_film().pixels);

    let shown = bench.film();
    bench.replace("room.mtl", "other.png", "missing.png");
    let warnings = bench.wait("reload", |event| match event {
        ReloadEvent::Reloaded { warnings, .. } => Some(warnings.iter().map(|w| w.message.clone()).collect::<Vec<_>>()),
        _ => None,
    });
    assert!(warnings.iter().any(|text| text.contains("missing.png")), "{warnings:?}");
    let plain = bench.film();
    assert!(plain.spp == shown.spp && plain.pixels != shown.pixels && plain.pixels == bench.fresh_film().pixels);
    // It comes to be.
    write_stripes(&bench.path("missing.png"), SIDE, [10, 20, 230]);
    assert_eq!(bench.reloaded(), "film");
    assert!(bench.film().pixels != plain.pixels && bench.film().pixels == bench.fresh_film().pixels);
    // And is broken.
    fs::write(bench.path("missing.png"), "no picture").unwrap();
    let warned = bench.wait("reload", |event| match event {
        ReloadEvent::Reloaded { warnings, .. } => Some(warnings.len()),
        _ => None,
    });
    assert!(warned > 0);
    assert!(bench.film().pixels == plain.pixels);
}

#[test]
fn a_scene_without_textures_binds_nothing_of_them() {
    let mut bench = bench();
    bench.write("room.mtl", MTL);
    assert_eq!(bench.reloaded(), "film");
    assert!(bench.film().pixels == bench.fresh_film().pixels);
    let features = bench.engine.features();
    assert!(["textures", "relief", "cutout", "emission_map"].iter().all(|feature| !features.contains(*feature)));
    assert!(bench.engine.textures().is_empty());
    let plain = Bench::new();
    let of_textures = ["textures", "texels", "material_maps", "uvs", "tangents", "mean_emission"];
    assert!(
        of_textures.iter().all(|buffer| !plain.engine.uploads().contains_key(buffer)),
        "{:?}",
        plain.engine.uploads()
    );
}

#[test]
fn a_picture_that_is_saved_in_two_parts_is_taken_up_once() {
    let mut bench = bench();
    let shown = bench.film();
    let floor = bench.path("floor.png");
    save_quickly(&mut bench, |tried| {
        let whole = stripes(SIDE, [90 + tried as u8, 40, 200]);
        fs::write(&floor, &whole[..whole.len() / 2]).unwrap();
        // Longer than a burst of saves is waited for, and shorter than what stays cut short.
        std::thread::sleep(Duration::from_millis(150));
        fs::write(&floor, &whole).unwrap();
    });
    assert_eq!(warnings_of_reload(&mut bench), Vec::<String>::new(), "the first half was taken up");
    assert!(bench.film().pixels == bench.fresh_film().pixels && bench.film().pixels != shown.pixels);
}

/// Of the next reload.
fn warnings_of_reload(bench: &mut Bench) -> Vec<String> {
    bench.wait("reload", |event| match event {
        ReloadEvent::Reloaded { warnings, .. } => Some(warnings.iter().map(|w| w.message.clone()).collect()),
        _ => None,
    })
}

/// Whoever saves a file empties it first: that may be just between the worker's look at its contents and the reading of the scene.
#[test]
fn a_file_that_is_saved_while_the_scene_is_read_is_taken_up_once() {
    let picture = stripes(SIDE, [90, 40, 200]);
    let materials = MTL.replace("Kd 0.5 0.5 0.5", "Kd 0.8 0.8 0.8\nmap_Kd other.png").into_bytes();
    // Of the materials, the first without its numbers: a file that is whole as far as can be told, but for a material that is missed.
    let named = materials.iter().position(|byte| *byte == b'\n').unwrap() + 1;
    for (name, whole, left) in
        [("floor.png", &picture, 0), ("floor.png", &picture, picture.len() / 2), ("room.mtl", &materials, named)]
    {
        let saved: Arc<Mutex<Option<Vec<u8>>>> = Arc::default();
        let to_save = saved.clone();
        let mut bench = bench_by(move |path| {
            let file = path.with_file_name(name);
            let read = move || {
                let whole = to_save.lock().unwrap().take();
                if let Some(whole) = &whole {
                    fs::write(&file, &whole[..left]).unwrap();
                }
                let (scene, files) = scene::attempt(&path, &[]);
                if let Some(whole) = &whole {
                    fs::write(&file, whole).unwrap();
                }
                Attempt { scene, files, shaders: None }
            };
            WatchedScene { read: Box::new(read), adjust: Box::new(|_| {}) }
        });
        let shown = bench.film();
        *saved.lock().unwrap() = Some(whole.clone());
        // Something else is saved, and that while the worker reads it.
        fs::write(bench.path(name), [whole.as_slice(), b"\n"].concat()).unwrap();
        assert_eq!(warnings_of_reload(&mut bench), Vec::<String>::new(), "{left} bytes of {name} were taken up");
        assert!(bench.film().pixels == bench.fresh_film().pixels && bench.film().pixels != shown.pixels);
        assert_eq!(bench.count_for(SETTLED), (0, 0), "{name} is taken up once, and whole");
    }
}
