//! EXR: which channels of which layer and part are the picture, and what is said where none are.

use std::path::Path;

use exr::meta::attribute::Chromaticities;
use exr::prelude::*;

use super::{refused, shown};

/// A part's name, and those of its channels.
type Part<'a> = (&'a str, &'a [&'a str]);

/// A pixel a channel: its value is its place in the list, from 1.
fn write(path: &Path, parts: &[Part]) {
    let mut number = 0.0;
    let mut layer = |(name, channels): &Part| {
        let channel = |name: &&str| {
            number += 1.0;
            AnyChannel::new(*name, FlatSamples::F16(vec![f16::from_f32(number)]))
        };
        let channels = AnyChannels::sort(channels.iter().map(channel).collect());
        let attributes = if parts.len() > 1 { LayerAttributes::named(*name) } else { LayerAttributes::default() };
        Layer::new((1, 1), attributes, Encoding::UNCOMPRESSED, channels)
    };
    let layers: Layers<_> = parts.iter().map(&mut layer).collect();
    Image::from_layers(ImageAttributes::with_size((1, 1)), layers).write().to_file(path).unwrap();
}

#[test]
fn colours_are_found_in_layers_of_any_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let cases: [(&[Part], [f32; 3]); 15] = [
        (&[("", &["R", "G", "B", "A"])], [1.0, 2.0, 3.0]),
        (
            &[("", &["ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B", "ViewLayer.Combined.A"])],
            [1.0, 2.0, 3.0],
        ),
        (&[("", &["beauty.red", "beauty.green", "beauty.blue"])], [1.0, 2.0, 3.0]),
        (&[("", &["r", "g", "b"])], [1.0, 2.0, 3.0]),
        (&[("", &["rgba_R", "rgba_G", "rgba_B"])], [1.0, 2.0, 3.0]),
        (&[("", &["a b:c/R", "a b:c/G", "a b:c/B"])], [1.0, 2.0, 3.0]),
        (&[("", &["Red", "Green", "Blue"])], [1.0, 2.0, 3.0]),
        // Without a layer goes before any layer, and the whole before its parts, wherever they are in the file.
        (&[("", &["albedo.R", "albedo.G", "albedo.B", "R", "G", "B"])], [4.0, 5.0, 6.0]),
        (
            &[(
                "",
                &[
                    "albedo.R",
                    "albedo.G",
                    "albedo.B",
                    "v.Combined.R",
                    "v.Combined.G",
                    "v.Combined.B",
                    "z.R",
                    "z.G",
                    "z.B",
                ],
            )],
            [4.0, 5.0, 6.0],
        ),
        (&[("depth", &["Z"]), ("left", &["R", "G", "B"]), ("right", &["R", "G", "B"])], [2.0, 3.0, 4.0]),
        (&[("diffuse", &["R", "G", "B"]), ("beauty", &["R", "G", "B"])], [4.0, 5.0, 6.0]),
        (&[("ViewLayer.Depth", &["Z"]), ("ViewLayer.Combined", &["R", "G", "B", "A"])], [2.0, 3.0, 4.0]),
        // Colour goes before grey; a Y with an X is no luminance.
        (&[("grey", &["Y"]), ("odd", &["some.R", "some.G", "some.B"])], [2.0, 3.0, 4.0]),
        (&[("", &["N.X", "N.Y", "N.Z", "Y"])], [4.0; 3]),
        (&[("", &["L.Y", "L.A"])], [1.0; 3]),
    ];
    for (parts, right) in cases {
        write(&path, parts);
        assert_eq!(shown(&path).pixels, [right], "{parts:?}");
    }
}

#[test]
fn a_choice_between_layers_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    write(&path, &[("", &["diffuse.R", "diffuse.G", "diffuse.B", "gloss.R", "gloss.G", "gloss.B"])]);
    let found = shown(&path);
    assert_eq!(found.pixels, [[1.0, 2.0, 3.0]]);
    let [warning] = &found.warnings[..] else { panic!("{:?}", found.warnings) };
    assert!(warning.contains("`diffuse` is read, not `gloss`"), "{warning}");
    write(&path, &[("left", &["R", "G", "B"]), ("right", &["R", "G", "B"])]);
    assert!(shown(&path).warnings[0].contains("`left` is read, not `right`"));
    // Where there is but one that it can be, nothing needs to be told but what is left out.
    write(&path, &[("", &["R", "G", "B", "Z", "gloss.R", "gloss.G", "gloss.B"])]);
    let found = shown(&path);
    assert!(found.warnings.is_empty() && found.notes[0].contains("Z, gloss.B, gloss.G, gloss.R"), "{:?}", found.notes);
}

#[test]
fn where_no_channels_fit_all_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    for channels in
        [&["Z"][..], &["R", "G"], &["P.X", "P.Y", "P.Z"], &["u.R", "v.G", "w.B"], &["RY", "BY"], &["A", "R"]]
    {
        write(&path, &[("", channels)]);
        let text = refused(&path);
        assert!(channels.iter().all(|name| text.contains(name)), "{channels:?}: {text}");
    }
    write(&path, &[("one", &["Z"]), ("two", &["id"])]);
    assert!(refused(&path).contains("Z, id"));
}

/// RY = (R - Y) / Y and BY alike (Kainz, Bogart, "Technical Introduction to OpenEXR"); Y by Rec.709's weights.
#[test]
fn luminance_and_chroma_become_colours() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    for [r, g, b] in [[0.5f32, 0.25, 2.0], [1.0, 1.0, 1.0], [0.0, 3.0, 0.0], [0.0; 3]] {
        let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let chroma = |channel: f32| if y > 0.0 { (channel - y) / y } else { 0.0 };
        let channel = |(name, value): (&'static str, f32)| AnyChannel::new(name, FlatSamples::F32(vec![value]));
        let list = [("Y", y), ("RY", chroma(r)), ("BY", chroma(b))].map(channel);
        let channels = AnyChannels::sort(list.into_iter().collect());
        Image::from_channels((1, 1), channels).write().to_file(&path).unwrap();
        let found = shown(&path);
        let far = found.pixels[0].iter().zip([r, g, b]).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(far < 1e-5, "{:?} is not {:?}", found.pixels[0], [r, g, b]);
        assert!(found.notes[0].contains("chroma"), "{:?}", found.notes);
    }
}

#[test]
fn colours_of_other_primaries_and_cubes_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let write = |colours: Option<Chromaticities>, cube: bool| {
        let channels = SpecificChannels::rgb(|_: Vec2<usize>| (1.0f32, 2.0f32, 3.0f32));
        let environment_map = cube.then_some(exr::meta::attribute::EnvironmentMap::Cube);
        let attributes = LayerAttributes { environment_map, ..LayerAttributes::default() };
        let mut image = Image::from_layer(Layer::new((1, 1), attributes, Encoding::UNCOMPRESSED, channels));
        image.attributes.chromaticities = colours;
        exr::image::write::WritableImage::write(&image).to_file(&path).unwrap();
        shown(&path).warnings
    };
    let rec_709 = Chromaticities {
        red: Vec2(0.64, 0.33),
        green: Vec2(0.3, 0.6),
        blue: Vec2(0.15, 0.06),
        white: Vec2(0.3127, 0.329),
    };
    let aces = Chromaticities { red: Vec2(0.7347, 0.2653), green: Vec2(0.0, 1.0), ..rec_709 };
    assert!(write(None, false).is_empty() && write(Some(rec_709), false).is_empty());
    assert!(write(Some(aces), false)[0].contains("chromaticities"));
    assert!(write(None, true)[0].contains("cube"));
}
