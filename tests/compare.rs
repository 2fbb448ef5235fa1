//! `lucerna compare`, by running it: files of every kind, values worked out by hand, limits and exit codes, heat maps.

use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};

use exr::prelude::*;
use serde_json::Value;
use tempfile::TempDir;

const HAS_FLIP: bool = cfg!(feature = "flip");

/// Exit code, stdout and stderr of a run in a folder.
fn lucerna(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    let run = command.args(arguments).current_dir(folder).stdin(Stdio::null()).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (run.status.code().unwrap(), text(run.stdout), text(run.stderr))
}

/// The JSON of a comparison that ends with a code.
fn compared(code: i32, folder: &TempDir, arguments: &[&str]) -> Value {
    let (found, out, err) = lucerna(folder.path(), &[&["compare", "--json"], arguments].concat());
    assert_eq!(found, code, "{arguments:?} said:\n{out}{err}");
    serde_json::from_str(&out).unwrap()
}

/// The message of a comparison that is refused.
fn refused(code: i32, folder: &TempDir, arguments: &[&str]) -> String {
    let (found, out, err) = lucerna(folder.path(), &[&["compare"], arguments].concat());
    assert_eq!((found, out.as_str()), (code, ""), "{arguments:?} said:\n{err}");
    assert!(!err.contains("panicked") && err.matches("error:").count() == 1, "{err}");
    err
}

/// Writes R, G and B as 32-bit floats.
fn write_rgb(folder: &TempDir, name: &str, width: usize, pixels: &[[f32; 3]]) {
    let pixel = |x: usize, y: usize| pixels[y * width + x].into();
    write_rgb_file(folder.path().join(name), width, pixels.len() / width, pixel).unwrap();
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} in {value}"))
}

fn close(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} is not {expected}");
}

#[test]
fn metrics_of_files_are_those_worked_out_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    write_rgb(&folder, "a.exr", 2, &[[1.0, 0.0, 0.5], [2.0, 1.0, 0.0]]);
    write_rgb(&folder, "b.exr", 2, &[[0.5, 0.0, 1.0], [2.0, 3.0, 0.0]]);
    let found = compared(0, &folder, &["a.exr", "b.exr"]);
    close(number(&found, "mse"), 0.75, 1e-12);
    close(number(&found, "mae"), 0.5, 1e-12);
    close(number(&found, "relmse"), (0.25 / 0.26 + 0.25 / 1.01 + 4.0 / 9.01) / 6.0, 1e-12);
    assert_eq!(found["a"]["mean"], serde_json::json!([1.5, 0.5, 0.25]));
    // The display sees 188 against 255 (0.5 is 187.52 in sRGB) twice, and nothing else.
    close(number(&found, "psnr"), 10.0 * (255f64.powi(2) * 6.0 / (2.0 * 67f64.powi(2))).log10(), 1e-9);
    let same =
        compared(0, &folder, &["a.exr", "a.exr", "--max-mse", "0", "--max-flip", "0"][..if HAS_FLIP { 6 } else { 4 }]);
    assert_eq!([number(&same, "mse"), number(&same, "mae"), number(&same, "relmse")], [0.0; 3]);
    assert!(same["psnr"].is_null());
}

#[test]
fn limits_that_are_exceeded_end_with_4_and_say_by_how_much() {
    let folder = tempfile::tempdir().unwrap();
    write_rgb(&folder, "a.exr", 16, &[[0.75; 3]; 256]);
    write_rgb(&folder, "b.exr", 16, &[[0.5; 3]; 256]);
    for (flag, kept, broken, said) in [
        ("--max-mse", "0.0625", "0.0624", "MSE is 0.0625"),
        ("--max-mae", "0.25", "0.125", "2.000 times"),
        ("--max-relmse", "0.2404", "0.2403", "relMSE is 0.2403"),
        ("--max-z", "1e6", "auto", "|z| is 1000000"),
    ] {
        compared(0, &folder, &["a.exr", "b.exr", flag, kept]);
        let (code, _, err) = lucerna(folder.path(), &["compare", "a.exr", "b.exr", flag, broken]);
        assert!(code == 4 && err.contains(flag) && err.contains(said), "{code}: {err}");
    }
    for bad in
        [&["--max-mse", "-1"][..], &["--max-z", "many"], &["--block", "7"], &["-o", "heat.exr"], &["--heat", "z"]]
    {
        refused(2, &folder, &[&["a.exr", "b.exr"], bad].concat());
    }
}

#[test]
fn bad_pixels_are_told_and_break_every_limit() {
    let folder = tempfile::tempdir().unwrap();
    write_rgb(&folder, "a.exr", 2, &[[0.5; 3], [f32::NAN, 1.0, 1.0], [0.5; 3], [f32::INFINITY; 3]]);
    write_rgb(&folder, "b.exr", 2, &[[0.5; 3], [1.0; 3], [-1.0, 0.0, 0.0], [1.0; 3]]);
    let found = compared(0, &folder, &["a.exr", "b.exr"]);
    assert_eq!((number(&found, "pixels"), number(&found, "mse")), (1.0, 0.0));
    assert_eq!(found["a"]["first_bad"], serde_json::json!([1, 0]));
    assert_eq!((number(&found["a"], "infinite"), number(&found["b"], "negative")), (1.0, 1.0));
    let found = compared(4, &folder, &["a.exr", "b.exr", "--max-mse", "1"]);
    assert!(found["exceeded"][0].as_str().unwrap().contains("2 pixels"), "{found}");
    compared(0, &folder, &["b.exr", "b.exr", "--max-mse", "1"]);
    write_rgb(&folder, "none.exr", 2, &[[f32::NAN; 3]; 4]);
    assert!(refused(1, &folder, &["none.exr", "b.exr"]).contains("none.exr"));
}

#[test]
fn exr_files_of_other_programs_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let grey = [[0.25f32; 3]; 64];
    write_rgb(&folder, "b.exr", 8, &grey);
    let samples = |kind: &str| match kind {
        "half" => FlatSamples::F16(vec![f16::from_f32(0.25); 64]),
        "uint" => FlatSamples::U32(vec![3; 64]),
        _ => FlatSamples::F32(vec![0.25; 64]),
    };
    let write = |name: &str, channels: &[(&str, &str)]| {
        let channels = channels.iter().map(|(name, kind)| AnyChannel::new(*name, samples(kind)));
        let channels = AnyChannels::sort(channels.collect());
        Image::from_channels((8, 8), channels).write().to_file(folder.path().join(name)).unwrap();
    };
    write("half.exr", &[("R", "half"), ("G", "float"), ("B", "half"), ("A", "uint"), ("Z", "float")]);
    write("layer.exr", &[("beauty.R", "half"), ("beauty.G", "half"), ("beauty.B", "half"), ("depth.Z", "uint")]);
    write("grey.exr", &[("Y", "float"), ("A", "half")]);
    for name in ["half.exr", "layer.exr", "grey.exr"] {
        assert_eq!(number(&compared(0, &folder, &[name, "b.exr"]), "mae"), 0.0, "{name}");
    }
    write("uint.exr", &[("R", "uint"), ("G", "uint"), ("B", "uint")]);
    assert_eq!(number(&compared(0, &folder, &["uint.exr", "b.exr"]), "mae"), 2.75);
    write("depth.exr", &[("Z", "float"), ("R", "half")]);
    let text = refused(1, &folder, &["depth.exr", "b.exr"]);
    assert!(text.contains("depth.exr") && text.contains("R, Z"), "{text}");
}

fn write_png(folder: &TempDir, name: &str, colour: png::ColorType, depth: png::BitDepth, data: &[u8]) {
    let mut encoder = png::Encoder::new(File::create(folder.path().join(name)).unwrap(), 1, 1);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    encoder.write_header().unwrap().write_image_data(data).unwrap();
}

#[test]
fn png_and_hdr_are_read_as_linear_light() {
    use png::{BitDepth, ColorType};
    let folder = tempfile::tempdir().unwrap();
    // sRGB 188 / 255 is 0.502886 of light (IEC 61966-2-1).
    write_rgb(&folder, "b.exr", 1, &[[0.502_886_5; 3]]);
    write_png(&folder, "rgb.png", ColorType::Rgb, BitDepth::Eight, &[188; 3]);
    write_png(&folder, "grey.png", ColorType::Grayscale, BitDepth::Eight, &[188]);
    write_png(&folder, "alpha.png", ColorType::Rgba, BitDepth::Eight, &[188, 188, 188, 9]);
    write_png(&folder, "deep.png", ColorType::Rgb, BitDepth::Sixteen, &[188; 6]);
    write_png(&folder, "grey_alpha.png", ColorType::GrayscaleAlpha, BitDepth::Sixteen, &[188, 188, 0, 9]);
    for name in ["rgb.png", "grey.png", "alpha.png", "deep.png", "grey_alpha.png"] {
        close(number(&compared(0, &folder, &[name, "b.exr"]), "mae"), 0.0, 2e-7);
    }
    assert!(lucerna(folder.path(), &["compare", "alpha.png", "b.exr"]).2.contains("alpha.png: alpha is ignored"));
    // RGBE: 128 / 256 * 2^(129 - 128) = 1, and 64 is half of that.
    for word in ["RADIANCE", "RGBE"] {
        let mut file = format!("#?{word}\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n").into_bytes();
        file.extend([128, 64, 0, 129]);
        std::fs::write(folder.path().join("a.hdr"), file).unwrap();
        let found = compared(0, &folder, &["a.hdr", "b.exr"]);
        assert_eq!(found["a"]["mean"], serde_json::json!([1.0, 0.5, 0.0]), "{word}");
    }
}

#[test]
fn what_is_no_picture_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    write_rgb(&folder, "a.exr", 8, &[[0.5; 3]; 64]);
    write_rgb(&folder, "b.exr", 4, &[[0.5; 3]; 64]);
    let text = refused(1, &folder, &["a.exr", "b.exr"]);
    assert!(text.contains("8x8") && text.contains("4x16"), "{text}");
    assert!(refused(1, &folder, &["a.exr", "missing.exr"]).contains("missing.exr"));
    assert!(refused(1, &folder, &[".", "a.exr"]).contains("folder"));
    let whole = std::fs::read(folder.path().join("a.exr")).unwrap();
    for (name, content) in [
        ("text.png", &b"no picture"[..]),
        ("empty.exr", b""),
        ("cut.exr", &whole[..whole.len() - 9]),
        ("head.exr", &whole[..40]),
    ] {
        std::fs::write(folder.path().join(name), content).unwrap();
        assert!(refused(1, &folder, &[name, "a.exr"]).contains(name));
    }
    // The content decides, not the name.
    std::fs::write(folder.path().join("exr.png"), &whole).unwrap();
    compared(0, &folder, &["exr.png", "a.exr", "--max-mse", "0"]);
}

/// Renders the Cornell box into a folder.
fn render(folder: &TempDir, more: &[&str]) {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/scenes/cornell-box.ron");
    let (code, _, err) =
        lucerna(folder.path(), &[&["render", scene, "--quiet", "--spp", "2", "--exposure", "0"], more].concat());
    assert_eq!(code, 0, "{err}");
}

#[test]
fn renders_compare_with_their_own_parts() {
    let folder = tempfile::tempdir().unwrap();
    render(&folder, &["--size", "64x48", "-o", "a.exr", "-o", "a.png"]);
    // Half a step of 8 bits is 0.0045 of light at most, in the brightest tones.
    let found = compared(0, &folder, &["a.png", "a.exr", "--crop", "0,64,30,48"]);
    assert_eq!((&found["size"], &found["origin"]), (&serde_json::json!([64, 18]), &serde_json::json!([0, 30])));
    assert_eq!(found["psnr"], Value::Null, "the same bytes are displayed");
    render(&folder, &["--size", "64x48", "--crop", "10,42,8,40", "-o", "part.exr"]);
    assert!(refused(1, &folder, &["a.exr", "part.exr"]).contains("32x32"));
    let found = compared(0, &folder, &["part.exr", "a.exr", "--crop", "12,40,8,30"]);
    assert_eq!((number(&found, "mse"), number(&found, "pixels")), (0.0, 28.0 * 22.0));
    assert!(refused(1, &folder, &["part.exr", "a.exr", "--crop", "9,40,8,30"]).contains("part.exr"));
    render(&folder, &["--size", "64x48", "--crop", "0,32,0,32", "-o", "other.exr"]);
    assert!(refused(1, &folder, &["other.exr", "part.exr"]).contains("10,8"));
}

/// What is said in a sentence of two pictures with independent noise.
#[test]
fn a_sentence_says_whether_they_differ() {
    let folder = tempfile::tempdir().unwrap();
    let mut dice = crate::support::dice::Dice(11);
    let mut noisy = |mean: f64| -> Vec<[f32; 3]> {
        (0..64 * 64).map(|_| std::array::from_fn(|_| (mean * (1.0 + 0.1 * dice.normal())) as f32)).collect()
    };
    let (a, b, mut c) = (noisy(0.5), noisy(0.5), noisy(0.5));
    (0..16).for_each(|y| (0..16).for_each(|x| c[y * 64 + x] = c[y * 64 + x].map(|value| 1.2 * value)));
    for (name, pixels) in [("a.exr", &a), ("b.exr", &b), ("c.exr", &c), ("d.exr", &noisy(0.55))] {
        write_rgb(&folder, name, 64, pixels);
    }
    write_rgb(&folder, "few.exr", 2, &a[..4]);
    write_rgb(&folder, "few too.exr", 2, &b[..4]);
    let said = |a: &str, b: &str| {
        let (code, out, err) = lucerna(folder.path(), &["compare", a, b]);
        assert_eq!(code, 0, "{err}");
        let said = out.lines().next().unwrap().to_owned();
        assert_eq!(compared(0, &folder, &[a, b])["verdict"].as_str(), Some(&*said));
        said
    };
    assert_eq!(said("a.exr", "a.exr"), "equal: every pixel is the same in both");
    assert!(said("b.exr", "a.exr").starts_with("no difference beyond noise: A is "));
    let part = said("c.exr", "a.exr");
    assert!(part.starts_with("they differ beyond noise in 4 of 64 blocks, by up to +"), "{part}");
    let whole = said("d.exr", "a.exr");
    assert!(whole.starts_with("they differ beyond noise") && whole.contains("A is +"), "{whole}");
    assert!(said("few.exr", "few too.exr").starts_with("can't tell a difference from noise"));
}

/// FLIP and PSNR are of the pictures as they were shown.
#[test]
fn the_exposure_is_that_of_the_files() {
    let folder = tempfile::tempdir().unwrap();
    render(&folder, &["--size", "32x24", "-o", "a.exr"]);
    render(&folder, &["--size", "32x24", "--seed", "1", "-o", "plain.exr"]);
    let render = |name: &str, stops: &str| {
        let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/scenes/cornell-box.ron");
        let flags = ["--quiet", "--spp", "2", "--size", "32x24", "--seed", "1", "--exposure", stops, "-o", name];
        assert_eq!(lucerna(folder.path(), &[&["render", scene], &flags[..]].concat()).0, 0);
    };
    render("bright.exr", "2.5");
    let found = compared(0, &folder, &["bright.exr", "bright.exr"]);
    assert_eq!(found["exposure"], 2.5);
    // B's counts, and that they differ is told.
    let (_, out, err) = lucerna(folder.path(), &["compare", "a.exr", "bright.exr", "--json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert!(found["exposure"] == 2.5 && err.contains("a.exr was rendered at exposure 0, bright.exr at 2.5"), "{err}");
    let given = compared(0, &folder, &["a.exr", "plain.exr", "--exposure", "2.5"]);
    assert_eq!((&given["psnr"], &given["flip"]), (&found["psnr"], &found["flip"]));
    // What says nothing of it is shown as it is.
    write_rgb(&folder, "other.exr", 1, &[[0.5; 3]]);
    assert_eq!(compared(0, &folder, &["other.exr", "other.exr"])["exposure"], 0.0);
}

/// A heat map that can't be written doesn't take the figures along.
#[test]
fn figures_are_told_where_no_heat_map_can_be_written() {
    let folder = tempfile::tempdir().unwrap();
    write_rgb(&folder, "a.exr", 2, &[[0.5; 3]; 4]);
    let (code, out, err) = lucerna(folder.path(), &["compare", "a.exr", "a.exr", "-o", "a.exr/heat.png"]);
    assert!(code == 1 && out.contains("relMSE") && err.matches("error:").count() == 1, "{out}{err}");
}

#[test]
fn heat_maps_show_where() {
    let folder = tempfile::tempdir().unwrap();
    let b = vec![[0.2f32; 3]; 40 * 24];
    let mut a = b.clone();
    (8..16).for_each(|y| (8..16).for_each(|x| a[y * 40 + x] = [0.3; 3]));
    a[0] = [f32::NAN; 3];
    write_rgb(&folder, "a.exr", 40, &a);
    write_rgb(&folder, "b.exr", 40, &b);
    for heat in ["flip", "relative", "z"] {
        if heat == "flip" && !HAS_FLIP {
            assert!(refused(2, &folder, &["a.exr", "b.exr", "-o", "flip.png", "--heat", heat]).contains("FLIP"));
            continue;
        }
        let name = format!("{heat}.png");
        compared(0, &folder, &["a.exr", "b.exr", "--block", "8", "-o", &name, "--heat", heat]);
        let map = image::open(folder.path().join(name)).unwrap().into_rgb8();
        assert_eq!(map.dimensions(), (40, 24), "{heat}");
        assert_eq!(map.get_pixel(0, 0).0, [0, 255, 0], "{heat}: a bad pixel");
        assert_ne!(map.get_pixel(12, 12), map.get_pixel(39, 23), "{heat}");
        assert_eq!(map.get_pixel(39, 0), map.get_pixel(39, 23), "{heat}: nothing differs there");
    }
}

/// Black against white is 1, equal pictures are 0, and bands (160 rows are two) join without a seam.
#[cfg(feature = "flip")]
#[test]
fn flip_is_that_of_its_authors() {
    let folder = tempfile::tempdir().unwrap();
    let size = (48usize, 160usize);
    let word = |i: usize, c: usize| ((i * 2_654_435_761 + c * 40_503) >> 7 & 255) as u8;
    let picture = |shift: usize| -> Vec<[u8; 3]> {
        (0..size.0 * size.1).map(|i| std::array::from_fn(|c| word(i / 3 + shift, c))).collect()
    };
    let write = |name: &str, pixels: &[[u8; 3]]| {
        let bytes = pixels.as_flattened();
        image::save_buffer(folder.path().join(name), bytes, 48, 160, image::ColorType::Rgb8).unwrap();
    };
    let (a, b) = (picture(0), picture(7));
    for (name, pixels) in
        [("a.png", &a), ("b.png", &b), ("black.png", &vec![[0; 3]; a.len()]), ("white.png", &vec![[255; 3]; a.len()])]
    {
        write(name, pixels);
    }
    let found = |a: &str, b: &str| number(&compared(0, &folder, &[a, b]), "flip");
    assert_eq!(found("a.png", "a.png"), 0.0);
    // Black and white are not the farthest colours, green and blue are: 100^0.7 of 41.28 in the metric of Andersson et al. 2020,
    // section 4.1.3, whose last step maps 0.4 to 1 of that to 0.95 to 1.
    close(found("black.png", "white.png"), 0.95 + 0.05 * (100f64.powf(0.7) / 41.276 - 0.4) / 0.6, 1e-3);
    let whole = |pixels: &[[u8; 3]]| nv_flip::FlipImageRgb8::with_data(48, 160, pixels.as_flattened());
    let map = nv_flip::flip(whole(&b), whole(&a), nv_flip::DEFAULT_PIXELS_PER_DEGREE).to_vec();
    let mean = map.iter().map(|error| f64::from(*error)).sum::<f64>() / map.len() as f64;
    assert!(mean > 0.1, "{mean} shows nothing");
    assert_eq!(found("a.png", "b.png"), mean);
}
