//! An answer made by hand, with pictures of one colour each, so that a test can say where they are.

use std::fs;
use std::path::Path;

use lucerna::app::variants::record::{Against, Answer, AxisRecord, Record, Snapshot, State, Work};

/// Width and height of a member's picture.
pub const SIZE: [u32; 2] = [48, 32];

/// The colour of a member's picture.
pub fn colour(member: usize) -> [u8; 3] {
    [40 + 25 * member as u8, 200 - 20 * member as u8, 30 + 60 * (member % 4) as u8]
}

/// Axes of two, three and as many labels as are asked for; none of the last where that is 0. Then a member by hand.
pub fn answer(blocks: usize) -> Answer {
    let axis = |name: &str, labels: &[&str]| AxisRecord {
        name: name.to_owned(),
        labels: labels.iter().map(|&label| label.to_owned()).collect(),
    };
    let mut axes = vec![axis("sampler", &["sobol", "random"]), axis("ball.ns", &["9", "10", "100"])];
    if blocks > 0 {
        axes.push(axis("camera", &["front", "side", "above"][..blocks]));
    }
    let mut records = Vec::new();
    for row in 0..2 {
        for column in 0..3 {
            for block in 0..blocks.max(1) {
                let at = if blocks > 0 { vec![row, column, block] } else { vec![row, column] };
                let name =
                    at.iter().zip(&axes).map(|(&at, axis)| axis.labels[at].as_str()).collect::<Vec<_>>().join("-");
                let settings = vec![
                    ("render.sampler".to_owned(), axes[0].labels[row].clone()),
                    ("materials.ball.ns".to_owned(), axes[1].labels[column].clone()),
                ];
                let mut record = record(&name, settings, records.len());
                record.at = at;
                records.push(record);
            }
        }
    }
    records.push(record("clay", vec![("materials.ball.ks".to_owned(), "(0, 0, 0)".to_owned())], records.len()));
    Answer {
        version: 1,
        name: "balls & <lights>".to_owned(),
        file: "assets/variants/balls.ron".to_owned(),
        axes,
        records,
        reference: Some("clay".to_owned()),
        interrupted: false,
        remarks: Vec::new(),
    }
}

/// A member that is done; its seconds are no more in the order of its place than its error is.
pub fn record(name: &str, settings: Vec<(String, String)>, place: usize) -> Record {
    let seconds = [2.0, 0.5, 11.0, 9.0][place % 4] + place as f64 / 100.0;
    let snapshot = |part: u32| Snapshot {
        spp: 16 * part,
        seconds: seconds * f64::from(part) / 4.0,
        rays: 1_000_000 * u64::from(part),
        relmse: 0.04 / f64::from(part),
    };
    Record {
        name: name.to_owned(),
        key: "0".to_owned(),
        at: Vec::new(),
        settings,
        state: State::Done,
        snapshots: vec![snapshot(1), snapshot(4)],
        mean: [0.5; 3],
        bad_samples: 0,
        adapter: "a processor".to_owned(),
        film_of: None,
        against: Some(Against { relmse: 0.011, flip: Some(0.05), mean: [1.0, 0.99, 1.01] }),
        work: Work::default(),
        repeat: format!("lucerna render ball -D 'name={name}'"),
    }
}

/// Writes the pictures of members that are done.
pub fn pictures(answer: &Answer, folder: &Path) {
    fs::create_dir_all(folder.join("members")).unwrap();
    for (member, record) in answer.records.iter().enumerate() {
        if matches!(record.state, State::Done | State::Lost { .. }) {
            picture(&folder.join("members").join(format!("{}.png", record.name)), colour(member), SIZE);
        }
    }
}

/// A PNG of one colour.
pub fn picture(path: &Path, colour: [u8; 3], [width, height]: [u32; 2]) {
    let mut encoder = png::Encoder::new(fs::File::create(path).unwrap(), width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&colour.repeat((width * height) as usize)).unwrap();
    writer.finish().unwrap();
}

/// Pixels of a PNG, and its width.
pub fn pixels(content: &[u8]) -> (Vec<[u8; 3]>, usize) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(content)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let step = info.color_type.samples();
    assert!(step >= 3, "a picture in colour");
    (bytes.chunks_exact(step).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect(), info.width as usize)
}
