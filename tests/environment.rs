//! Pictures of the sky from files: what is no radiance is mended and told, and never reaches the film.

use std::path::Path;
use std::time::Duration;

use exr::prelude::write_rgb_file;
use glam::Vec3;
use lucerna::Engine;
use lucerna::components::{Environment, Integrator};
use lucerna::scene::{self, Loaded, Severity};
use lucerna::shader::Library;
use tempfile::TempDir;

use crate::support;

const OBJ: &str = "mtllib a.mtl\nusemtl grey\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
const MTL: &str = "newmtl grey\nKd 0.6 0.6 0.6\n";
const SIDES: (usize, usize) = (8, 4);

/// A folder with a scene whose sky is a picture of these pixels, and black where there are no more.
fn folder(strength: &str, pixels: &[(f32, f32, f32)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let scene = format!(
        "(\n    models: [(path: \"a.obj\")],\n    film: (size: (24, 16)),\n    render: (spp: 16, max_depth: 3),\n    \
         environment: Map(path: \"sky.exr\", strength: {strength}),\n)\n"
    );
    for (file, text) in [("a.ron", scene.as_str()), ("a.obj", OBJ), ("a.mtl", MTL)] {
        std::fs::write(folder.path().join(file), text).unwrap();
    }
    let pixel = |x: usize, y: usize| pixels.get(y * SIDES.0 + x).copied().unwrap_or_default();
    write_rgb_file(folder.path().join("sky.exr"), SIDES.0, SIDES.1, pixel).unwrap();
    folder
}

fn load(folder: &Path) -> Loaded {
    scene::load(&folder.join("a.ron"), &[]).unwrap_or_else(|error| panic!("{error:?}"))
}

/// The mean of the film, which has no bad sample.
fn rendered(loaded: &Loaded, integrator: Integrator) -> Vec3 {
    let mut description = loaded.description.clone();
    description.render.integrator = integrator;
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    while !engine.step(Duration::from_secs(1)).unwrap().finished {}
    let film = engine.film().unwrap();
    let report = engine.report().unwrap();
    assert_eq!(report.bad_samples, 0, "{integrator:?}: {:?}", report.bad_log);
    film.rgb.iter().map(|rgb| Vec3::from(*rgb)).sum::<Vec3>() / film.rgb.len() as f32
}

const WRONG: [(f32, f32, f32); 8] = [
    (f32::NAN, 1.0, 1.0),
    (1.0, f32::INFINITY, 1.0),
    (1.0, 1.0, f32::NEG_INFINITY),
    (-1.0, 2.0, 3.0),
    (1e6, 1.0, 1e7),
    (f32::MAX, f32::MIN, f32::NAN),
    (-1e-30, 0.5, 0.5),
    (-f32::NAN, -f32::NAN, -f32::NAN),
];

#[test]
fn texels_that_are_no_radiance_are_mended_with_a_warning() {
    for at in 0..WRONG.len() {
        let mut pixels = [(0.25, 0.5, 0.75); SIDES.0 * SIDES.1];
        pixels[at] = WRONG[at];
        let folder = folder("1", &pixels);
        let loaded = load(folder.path());
        let [warning] = &loaded.warnings[..] else { panic!("{:?}: not one warning: {:?}", WRONG[at], loaded.warnings) };
        assert_eq!((warning.severity, warning.line, warning.column), (Severity::Warning, 5, 28));
        let text = warning.to_string();
        assert!(text.contains("a.ron:5:28") && text.contains("1 pixel of") && text.contains("sky.exr"), "{text}");
        let Some(Environment::Map { image, .. }) = &loaded.description.environment else { panic!("no picture") };
        let (r, g, b) = WRONG[at];
        let right = [r, g, b].map(|c| if c.is_nan() || c < 0.0 { 0.0 } else { c.min(1e6) });
        assert_eq!(image.pixels[at].to_array(), right);
        assert_eq!(image.pixels[SIDES.0 + at].to_array(), [0.25, 0.5, 0.75], "a good pixel was changed");
        for integrator in [Integrator::Path, Integrator::Bsdf] {
            assert!(rendered(&loaded, integrator).min_element() > 0.0);
        }
    }
}

#[test]
fn all_that_is_wrong_is_one_warning() {
    let folder = folder("1", &WRONG);
    let loaded = load(folder.path());
    assert_eq!(loaded.warnings.len(), 1);
    assert!(loaded.warnings[0].message.starts_with("8 pixels of"), "{}", loaded.warnings[0].message);
    assert!(rendered(&loaded, Integrator::Path).is_finite());
    // A picture that is right has none.
    let good = self::folder("1", &[(1.0, 2.0, 3.0), (0.0, 1e6, 1e-40), (-0.0, 0.0, 0.0)]);
    assert!(load(good.path()).warnings.is_empty());
}

#[test]
fn a_sky_of_any_strength_has_no_bad_samples() {
    let pixels = [(1.0, 0.5, 0.25), (0.0, 0.0, 0.0), (1e6, 1e6, 1e6), (1e-40, 0.0, 1e-30), (-0.0, 1e-3, 0.0)];
    for strength in ["1e6", "1", "1e-6", "1e-30", "1e-38", "1e-42", "1e-60", "0"] {
        let folder = folder(strength, &pixels);
        let loaded = load(folder.path());
        for integrator in [Integrator::Path, Integrator::Bsdf] {
            let mean = rendered(&loaded, integrator);
            assert!(mean.is_finite(), "strength {strength}: {mean}");
        }
    }
    // Nothing but what is almost black.
    let folder = folder("1e-6", &[(1e-33, 0.0, 0.0), (0.0, 1e-34, 0.0)]);
    rendered(&load(folder.path()), Integrator::Path);
}

/// The picture of a scene whose sky is a file of this content, and the warnings.
fn sky_of(name: &str, content: &[u8]) -> (Vec<[f32; 3]>, Vec<String>) {
    let folder = folder("1", &[]);
    let text = std::fs::read_to_string(folder.path().join("a.ron")).unwrap().replace("sky.exr", name);
    std::fs::write(folder.path().join("a.ron"), text).unwrap();
    std::fs::write(folder.path().join(name), content).unwrap();
    let loaded = load(folder.path());
    let Some(Environment::Map { image, .. }) = &loaded.description.environment else { panic!("no picture") };
    let pixels = image.pixels.iter().map(Vec3::to_array).collect();
    (pixels, loaded.warnings.iter().map(ToString::to_string).collect())
}

#[test]
fn skies_are_read_like_any_picture() {
    let hdr =
        |lines: &str| [format!("#?RGBE\n{lines}\n-Y 1 +X 2\n").as_bytes(), &[128, 64, 32, 129, 0, 0, 0, 0]].concat();
    assert_eq!(sky_of("sky.hdr", &hdr("")), (vec![[1.0, 0.5, 0.25], [0.0; 3]], Vec::new()));
    assert_eq!(sky_of("sky.pic", &hdr("EXPOSURE=4\n")).0[0], [0.25, 0.125, 0.0625]);
    let (_, warnings) = sky_of("sky.hdr", &hdr("GAMMA=2\n"));
    assert!(
        warnings.len() == 1 && warnings[0].contains("a.ron:5:28: warning: `") && warnings[0].contains("GAMMA"),
        "{warnings:?}"
    );
    // A file of which this is a part of the picture: a bright texel at its place, black around it.
    let path = tempfile::tempdir().unwrap().path().join("part.exr");
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    let channels = exr::prelude::SpecificChannels::rgb(|_: exr::math::Vec2<usize>| (900.0f32, 800.0f32, 700.0f32));
    let attributes = exr::meta::header::LayerAttributes {
        layer_position: exr::math::Vec2(2, 1),
        ..exr::meta::header::LayerAttributes::default()
    };
    let layer = exr::image::Layer::new((1, 1), attributes, exr::image::Encoding::UNCOMPRESSED, channels);
    let mut image = exr::image::Image::from_layer(layer);
    image.attributes.display_window = exr::meta::attribute::IntegerBounds::from_dimensions((4, 2));
    exr::image::write::WritableImage::write(&image).to_file(&path).unwrap();
    let (pixels, warnings) = sky_of("sky.exr", &std::fs::read(&path).unwrap());
    assert!(pixels.len() == 8 && pixels[6] == [900.0, 800.0, 700.0], "{pixels:?}");
    assert!(warnings.len() == 1 && warnings[0].contains("the rest is black"), "{warnings:?}");
}

#[test]
fn a_sky_that_can_not_be_read_is_told_at_its_line() {
    for (name, content, word) in [
        ("sky.exr", &b"\x76\x2f\x31\x01\x02\0\0\0"[..], "cut short"),
        ("sky.hdr", b"#?RADIANCE\n\n-Y 1 +X 2\n", "cut short"),
        ("sky.hdr", b"#?RADIANCE\n\n-Y 1 +X 99999\n", "99999x1"),
        ("sky.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n", "xyze"),
        ("sky.png", b"\x89PNG", "cut short"),
        ("sky.jpg", b"\xff\xd8\xff", "no picture"),
        ("sky.png", b"", "empty"),
    ] {
        let folder = folder("1", &[]);
        let text = std::fs::read_to_string(folder.path().join("a.ron")).unwrap().replace("sky.exr", name);
        std::fs::write(folder.path().join("a.ron"), text).unwrap();
        std::fs::write(folder.path().join(name), content).unwrap();
        let errors = scene::load(&folder.path().join("a.ron"), &[]).unwrap_err();
        let [error] = &errors.list[..] else { panic!("{errors}") };
        let text = error.to_string();
        assert!(text.contains("a.ron:5:28: error:") && text.contains(name) && text.contains(word), "{text}");
        assert!(error.help.as_ref().is_some_and(|help| !help.contains("triangles")), "{text}");
    }
}

#[test]
fn a_map_is_turned_as_models_are_and_tinted() {
    let fields = "2, tint: (1, 0.5, 0.25), rotate_z: 30, rotate_x: -40, rotate_y: 1000";
    let folder = folder(fields, &[(1.0, 2.0, 3.0)]);
    let text = std::fs::read_to_string(folder.path().join("a.ron")).unwrap();
    let turned = "path: \"a.obj\", transform: (rotate_x: -40, rotate_y: 1000, rotate_z: 30)";
    std::fs::write(folder.path().join("a.ron"), text.replace("path: \"a.obj\"", turned)).unwrap();
    let description = load(folder.path()).description;
    let Some(Environment::Map { strength, tint, turn, .. }) = &description.environment else { panic!("no picture") };
    assert_eq!((*strength, *tint), (2.0, Vec3::new(1.0, 0.5, 0.25)));
    assert_eq!(*turn, description.meshes.values().next().unwrap().transform.0.matrix3);
    assert!((turn.determinant() - 1.0).abs() < 1e-12);
    // Tint and strength are factors of what is seen.
    let plain = rendered(&load(self::folder("1", &[(1.0, 2.0, 3.0)]).path()), Integrator::Bsdf);
    let tinted = self::folder("2, tint: (1, 0.5, 0.25)", &[(1.0, 2.0, 3.0)]);
    let tinted = rendered(&load(tinted.path()), Integrator::Bsdf);
    assert!((tinted / plain).abs_diff_eq(Vec3::new(2.0, 1.0, 0.5), 1e-5), "{tinted} of {plain}");
}

#[test]
fn wrong_fields_of_a_map_are_told_where_they_are() {
    for (fields, place, words) in [
        ("1, tint: (1, -1, 1)", "a.ron:5:58", ["environment.tint", "0 to 1000"]),
        ("1, rotate_y: north", "a.ron:5:62", ["environment.rotate_y", "number"]),
        ("1, rotate: 3", "a.ron:5:52", ["unknown field `environment.rotate`", "rotate_x"]),
    ] {
        let folder = folder(fields, &[]);
        let errors = scene::load(&folder.path().join("a.ron"), &[]).unwrap_err();
        let [error] = &errors.list[..] else { panic!("{errors}") };
        let text = format!("{error} {}", error.help.as_deref().unwrap_or(""));
        assert!(text.contains(place) && words.iter().all(|word| text.contains(word)), "{text}");
    }
}
