//! Files of a render: what is written can be read back, and appears whole or not at all.

use exr::prelude::{ReadChannels, ReadLayers, read};
use glam::UVec2;
use lucerna::components::Crop;
use lucerna::image::{Kind, Output, Outputs, Picture, SaveError};

/// 3x2 pixels of a 5x4 picture.
struct Sample {
    linear: Vec<[f32; 3]>,
    display: Vec<[u8; 4]>,
    metadata: Vec<(&'static str, String)>,
    report: serde_json::Value,
}

impl Sample {
    fn new() -> Self {
        let linear = vec![[0.0, 1e-30, 1.0], [0.1, 0.2, 0.3], [1e6, 2.5, 7.0], [4.0, 5.0, 6.0], [0.5; 3], [9.0; 3]];
        let display = (0..6).map(|k| [k, 2 * k, 255 - k, 77]).collect();
        let metadata = vec![("scene", "Küche/日本.ron".to_owned()), ("seed", "42".to_owned())];
        Self { linear, display, metadata, report: serde_json::json!({ "spp": 7 }) }
    }

    fn picture(&self) -> Picture<'_> {
        Picture {
            size: UVec2::new(5, 4),
            window: Crop { min: UVec2::new(1, 2), max: UVec2::new(4, 4) },
            linear: &self.linear,
            display: &self.display,
            metadata: &self.metadata,
            report: &self.report,
        }
    }
}

fn names(folder: &std::path::Path) -> Vec<String> {
    let mut names: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn png_holds_the_display_pixels_and_the_metadata() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new/folder/a.png");
    Output::new(&path).unwrap().write(&Sample::new().picture()).unwrap();
    let mut reader =
        png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&path).unwrap())).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((frame.width, frame.height, frame.color_type), (3, 2, png::ColorType::Rgb));
    let expected: Vec<u8> = (0..6).flat_map(|k| [k, 2 * k, 255 - k]).collect();
    assert_eq!(&pixels[..frame.buffer_size()], expected);
    let info = reader.info();
    assert_eq!(info.srgb, Some(png::SrgbRenderingIntent::Perceptual));
    assert_eq!(info.uncompressed_latin1_text[0].text, "42");
    assert_eq!(info.utf8_text[0].get_text().unwrap(), "Küche/日本.ron");
}

#[test]
fn exr_holds_every_bit_its_place_and_the_metadata() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    Output::new(&path).unwrap().write(&Sample::new().picture()).unwrap();
    let image = read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
    let image = exr::image::read::image::ReadImage::from_file(image, &path).unwrap();
    assert_eq!(image.attributes.display_window.size, exr::math::Vec2(5, 4));
    let layer = &image.layer_data[0];
    assert_eq!(layer.size, exr::math::Vec2(3, 2));
    assert_eq!(layer.attributes.layer_position, exr::math::Vec2(1, 2));
    for (channel, name) in [(2, "R"), (1, "G"), (0, "B")] {
        let samples = &layer.channel_data.list[channel];
        assert_eq!(samples.name.to_string(), name);
        let found: Vec<u32> = samples.sample_data.values_as_f32().map(f32::to_bits).collect();
        let expected: Vec<u32> = Sample::new().linear.iter().map(|p| p[2 - channel].to_bits()).collect();
        assert_eq!(found, expected, "channel {name}");
    }
    let text = match &layer.attributes.other[&exr::meta::attribute::Text::from("lucerna")] {
        exr::meta::attribute::AttributeValue::Text(text) => text.as_slice().to_vec(),
        other => panic!("{other:?}"),
    };
    let metadata: serde_json::Value = serde_json::from_slice(&text).unwrap();
    assert_eq!(metadata, serde_json::json!({ "scene": "Küche/日本.ron", "seed": "42" }));
}

#[test]
fn the_same_picture_gives_the_same_bytes_and_no_other_file() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.png", "b.png", "a.exr", "b.exr", "a.json", "b.JSON"] {
        Output::new(folder.path().join(name)).unwrap().write(&Sample::new().picture()).unwrap();
    }
    assert_eq!(names(folder.path()), ["a.exr", "a.json", "a.png", "b.JSON", "b.exr", "b.png"]);
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("a.png") == bytes("b.png"), "PNG files differ");
    assert!(bytes("a.exr") == bytes("b.exr"), "EXR files differ");
    assert_eq!(bytes("a.json"), bytes("b.JSON"));
    assert_eq!(serde_json::from_slice::<serde_json::Value>(&bytes("a.json")).unwrap()["spp"], 7);
}

#[test]
fn an_older_file_is_replaced_and_a_refusal_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.json");
    std::fs::write(&path, "old").unwrap();
    let output = Output::new(&path).unwrap();
    output.prepare(&[]).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"old", "preparing must not touch what is there");
    output.write(&Sample::new().picture()).unwrap();
    assert_ne!(std::fs::read(&path).unwrap(), b"old");

    let file_as_folder = Output::new(path.join("b.png")).unwrap();
    assert!(matches!(file_as_folder.prepare(&[]), Err(SaveError::Folder { .. })));
    assert!(matches!(file_as_folder.write(&Sample::new().picture()), Err(SaveError::Folder { .. })));
    std::fs::create_dir(folder.path().join("c.png")).unwrap();
    let folder_as_file = Output::new(folder.path().join("c.png")).unwrap();
    assert!(matches!(folder_as_file.prepare(&[]), Err(SaveError::IsFolder(_))));
    assert!(matches!(folder_as_file.write(&Sample::new().picture()), Err(SaveError::IsFolder(_))));
    assert_eq!(names(folder.path()), ["a.json", "c.png"]);
}

#[test]
fn the_extension_chooses() {
    assert_eq!(Output::new("x.PNG").unwrap().kind, Kind::Png);
    assert_eq!(Output::new("a.b/x.exr").unwrap().kind, Kind::Exr);
    for bad in ["x", "x.jpg", "png", ".png", "", "x.png/"] {
        let made = Output::new(bad);
        assert!(matches!(made, Err(SaveError::Extension(_))) || bad == "x.png/", "{bad}");
    }
}

#[cfg(unix)]
#[test]
fn a_written_file_has_the_permissions_of_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let mode = |name: &str| std::fs::metadata(folder.path().join(name)).unwrap().permissions().mode() & 0o777;
    Output::new(folder.path().join("a.json")).unwrap().write(&Sample::new().picture()).unwrap();
    std::fs::write(folder.path().join("plain"), "").unwrap();
    assert_eq!(mode("a.json"), mode("plain"));
}

#[cfg(unix)]
mod links {
    use std::os::unix::fs::symlink;
    use std::path::Path;

    use super::*;

    fn is_link(path: &Path) -> bool {
        std::fs::symlink_metadata(path).unwrap().is_symlink()
    }

    /// Writes through a link; all that must then hold but where the file is.
    fn written(link: &Path) -> Vec<u8> {
        let output = Output::new(link).unwrap();
        output.prepare(&[]).unwrap();
        output.write(&Sample::new().picture()).unwrap();
        assert!(is_link(link), "{} is no link any more", link.display());
        std::fs::read(link).unwrap()
    }

    #[test]
    fn a_link_stays_a_link_and_what_it_leads_to_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["files", "links", "links/deep"] {
            std::fs::create_dir(at(name)).unwrap();
        }
        std::fs::write(at("files/there.png"), "old").unwrap();
        // Absolute and relative, to a file and to none, through a folder that is a link, and through other links.
        symlink(at("files/there.png"), at("links/absolute.png")).unwrap();
        symlink("../files/new.exr", at("links/dangling.exr")).unwrap();
        symlink("../files/far/away/new.json", at("links/far.json")).unwrap();
        symlink("../files", at("links/folder")).unwrap();
        symlink("folder/../files/through.png", at("links/through.png")).unwrap();
        symlink("../through.png", at("links/deep/1.png")).unwrap();
        symlink("1.png", at("links/deep/2.png")).unwrap();
        symlink(at("links/deep/2.png"), at("3.png")).unwrap();
        for (link, file) in [
            ("links/absolute.png", "files/there.png"),
            ("links/dangling.exr", "files/new.exr"),
            ("links/far.json", "files/far/away/new.json"),
            ("links/through.png", "files/through.png"),
            ("3.png", "files/through.png"),
        ] {
            let bytes = written(&at(link));
            assert!(!is_link(&at(file)) && bytes == std::fs::read(at(file)).unwrap() && bytes.len() > 10, "{link}");
        }
        for link in ["links/deep/1.png", "links/deep/2.png", "links/through.png"] {
            assert!(is_link(&at(link)), "{link}");
        }
        assert_eq!(names(&at("files")), ["far", "new.exr", "there.png", "through.png"]);
        assert_eq!(names(&at("links/deep")), ["1.png", "2.png"], "no other file is left");
        // A file in a folder that is a link.
        Output::new(at("links/folder/plain.png")).unwrap().write(&Sample::new().picture()).unwrap();
        assert!(at("files/plain.png").is_file() && is_link(&at("links/folder")));
    }

    #[test]
    fn links_without_an_end_and_to_folders_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        symlink("self.png", at("self.png")).unwrap();
        symlink("b.png", at("a.png")).unwrap();
        symlink("a.png", at("b.png")).unwrap();
        symlink(folder.path(), at("folder.png")).unwrap();
        symlink("folder.png", at("again.png")).unwrap();
        symlink("/dev/null", at("device.png")).unwrap();
        let before = names(folder.path());
        for (name, word) in [
            ("self.png", "leads to no end"),
            ("a.png", "leads to no end"),
            ("folder.png", "is a folder"),
            ("again.png", "is a folder"),
            ("device.png", "device"),
            ("self.png/x.png", "can't make the folder"),
        ] {
            let output = Output::new(at(name)).unwrap();
            for result in [output.prepare(&[]), output.write(&Sample::new().picture())] {
                let text = result.unwrap_err().to_string();
                assert!(text.contains(word) && text.contains(name.split('/').next().unwrap()), "{text}");
            }
        }
        assert_eq!(names(folder.path()), before);
        assert!(is_link(&at("device.png")) && !Path::new("/dev/null").is_file());
    }

    #[test]
    fn a_file_of_several_names_is_written_once() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("deep")).unwrap();
        symlink("a.png", at("link.png")).unwrap();
        symlink("a.png", at("link.exr")).unwrap();
        let outputs =
            ["a.png", "./a.png", "deep/../a.png", "link.png", "b.exr"].map(|name| Output::new(at(name)).unwrap());
        let (prepared, failures) = Outputs::prepare(&outputs, &[]);
        assert!(failures.is_empty(), "{failures:?}");
        assert_eq!(prepared.names(), [&outputs[0], &outputs[4]].map(|output| output.path.display().to_string()));
        // Two kinds of file can't be one file.
        let outputs = ["a.png", "link.exr"].map(|name| Output::new(at(name)).unwrap());
        let (prepared, failures) = Outputs::prepare(&outputs, &[]);
        assert_eq!(prepared.names().len(), 1);
        assert!(matches!(&failures[..], [SaveError::Same(..)]), "{failures:?}");
    }
}

#[test]
fn one_file_that_fails_keeps_no_other_from_being_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let all = ["a.png", "a.exr", "a.json", "b.json", "b.png"].map(|name| Output::new(at(name)).unwrap());
    for broken in 0..all.len() {
        let (mut outputs, failures) = Outputs::prepare(&all, &[]);
        assert!(failures.is_empty());
        // Something comes in the way while it renders.
        std::fs::create_dir(&all[broken].path).unwrap();
        let sample = Sample::new();
        let report = |written: &Outputs| serde_json::json!({ "outputs": written.names() });
        let failures = outputs.write(&sample.picture(), report);
        let name = all[broken].path.display().to_string();
        assert!(failures.len() == 1 && failures[0].to_string().contains(&name), "{failures:?}");
        assert_eq!(outputs.names().len(), 4);
        for output in all.iter().filter(|output| output.path != all[broken].path) {
            assert!(output.path.is_file(), "{} is missing", output.path.display());
            std::fs::remove_file(&output.path).unwrap();
        }
        std::fs::remove_dir(&all[broken].path).unwrap();
        assert!(names(folder.path()).is_empty());
    }
}

#[test]
fn a_report_names_the_files_that_were_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let (mut outputs, _) =
        Outputs::prepare(&["a.json", "a.png", "a.exr"].map(|name| Output::new(at(name)).unwrap()), &[]);
    std::fs::create_dir(at("a.png")).unwrap();
    outputs.write(&Sample::new().picture(), |written| serde_json::json!(written.names()));
    let report: Vec<String> = serde_json::from_slice(&std::fs::read(at("a.json")).unwrap()).unwrap();
    assert_eq!(report, ["a.json", "a.exr"].map(|name| at(name).display().to_string()));
}
