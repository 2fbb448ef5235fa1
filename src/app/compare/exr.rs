//! EXR files of any program: half, float and integer channels, whatever else they hold.

use std::path::Path;

use exr::image::read::layers::ReadChannels;
use exr::image::read::specific_channels::ReadSpecificChannel;
use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::attribute::Text;
use exr::meta::header::Header;
use exr::prelude::{ReadLayers, read};
use glam::{IVec2, UVec2};

use super::read::{Pixel, ReadError, broken};
use crate::components::Crop;

/// Names of the channels that make a pixel.
#[derive(Clone, Debug)]
enum Channels {
    Colour([Text; 3]),
    Luminance(Text),
}

/// What the header of an EXR file says.
#[derive(Debug)]
pub struct ExrFile {
    /// Of the data window, pixels.
    pub size: UVec2,
    /// Top left of the data window, from that of the display window.
    pub place: IVec2,
    pub notes: Vec<String>,
    channels: Channels,
}

impl ExrFile {
    /// Chooses the channels: R, G and B of the first part that has them, else those of its only layer with a name, else Y.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let meta = MetaData::read_from_file(path, false).map_err(|error| broken(path, error))?;
        let mut flat = meta.headers.iter().filter(|header| !header.deep);
        let mut flat_again = flat.clone();
        let coloured = flat.find_map(|header| Some((header, colour(header)?)));
        let found = coloured.or_else(|| flat_again.find_map(|header| Some((header, luminance(header)?))));
        let Some((header, channels)) = found else {
            let names = meta.headers.iter().flat_map(|header| &header.channels.list).map(|c| c.name.to_string());
            let channels = names.collect::<Vec<_>>().join(", ");
            return Err(ReadError::Channels { path: path.to_path_buf(), channels });
        };
        if header.channels.list.iter().any(|channel| channel.sampling != Vec2(1, 1)) {
            return Err(ReadError::Subsampled(path.to_path_buf()));
        }
        let side = |pixels: usize| u32::try_from(pixels).unwrap_or(u32::MAX);
        let size = UVec2::new(side(header.layer_size.x()), side(header.layer_size.y()));
        let from = header.shared_attributes.display_window.position;
        let at = header.own_attributes.layer_position;
        let place = IVec2::new(at.x().saturating_sub(from.x()), at.y().saturating_sub(from.y()));
        let notes = told(header, &channels, meta.headers.len());
        Ok(Self { size, place, notes, channels })
    }

    /// The pixels of a window of the data window, row by row.
    pub fn read(&self, path: &Path, window: Crop) -> Result<Vec<Pixel>, ReadError> {
        let size = window.size();
        let none = vec![[f32::NAN; 3]; size.x as usize * size.y as usize];
        let set = move |pixels: &mut Vec<Pixel>, at: Vec2<usize>, pixel: Pixel| {
            let column = at.x().checked_sub(window.min.x as usize).filter(|x| *x < size.x as usize);
            let row = at.y().checked_sub(window.min.y as usize).filter(|y| *y < size.y as usize);
            if let (Some(x), Some(y)) = (column, row) {
                pixels[y * size.x as usize + x] = pixel;
            }
        };
        // The reader wants a function that makes the room; it calls it once, for the layer that it reads.
        let room = std::cell::Cell::new(none);
        let levels = read().no_deep_data().largest_resolution_level();
        let pixels = match &self.channels {
            Channels::Colour([r, g, b]) => levels
                .specific_channels()
                .required(r.clone())
                .required(g.clone())
                .required(b.clone())
                .collect_pixels(
                    |_, _| room.take(),
                    move |pixels, at, (r, g, b): (f32, f32, f32)| set(pixels, at, [r, g, b]),
                )
                .first_valid_layer()
                .all_attributes()
                .from_file(path)
                .map(|image| image.layer_data.channel_data.pixels),
            Channels::Luminance(y) => levels
                .specific_channels()
                .required(y.clone())
                .collect_pixels(|_, _| room.take(), move |pixels, at, (y,): (f32,)| set(pixels, at, [y; 3]))
                .first_valid_layer()
                .all_attributes()
                .from_file(path)
                .map(|image| image.layer_data.channel_data.pixels),
        };
        pixels.map_err(|error| broken(path, error))
    }
}

fn names(header: &Header) -> impl Iterator<Item = &Text> {
    header.channels.list.iter().map(|channel| &channel.name)
}

/// R, G and B, plain or as `layer.R`, if there is but one such layer.
fn colour(header: &Header) -> Option<Channels> {
    let find = |name: &str| names(header).find(|own| *own == name).cloned();
    let all =
        |layer: &str| Some([find(&format!("{layer}R"))?, find(&format!("{layer}G"))?, find(&format!("{layer}B"))?]);
    if let Some(plain) = all("") {
        return Some(Channels::Colour(plain));
    }
    let texts: Vec<String> = names(header).map(Text::to_string).collect();
    let layers = texts.iter().filter_map(|name| name.strip_suffix('R')).filter(|layer| layer.ends_with('.'));
    let mut whole = layers.filter_map(all);
    match (whole.next(), whole.next()) {
        (Some(only), None) => Some(Channels::Colour(only)),
        _ => None,
    }
}

fn luminance(header: &Header) -> Option<Channels> {
    names(header).find(|name| *name == "Y").cloned().map(Channels::Luminance)
}

/// What of the file is left out.
fn told(header: &Header, channels: &Channels, parts: usize) -> Vec<String> {
    let mut notes = Vec::new();
    let used: Vec<&Text> = match channels {
        Channels::Colour(names) => names.iter().collect(),
        Channels::Luminance(name) => vec![name],
    };
    let others: Vec<String> = names(header).filter(|name| !used.contains(name)).map(|name| name.to_string()).collect();
    if !others.is_empty() {
        notes.push(format!("its channels {} are ignored", others.join(", ")));
    }
    if parts > 1 {
        notes.push(format!("the first fitting of its {parts} parts is read"));
    }
    notes
}
