//! Which of an EXR file's channels are the picture.
//!
//! A channel is a layer's name, a separator and a colour: `R`, `ViewLayer.Combined.R`, `beauty.red`. The first of these that
//! there is, is read; of several alike, the first in the order of the file:
//! 1. colours without a layer: in a file of many parts, of a part without a name or with a [name of the whole](WHOLE);
//! 2. colours of a layer with such a name;
//! 3. colours without a layer, of any part;
//! 4. colours of any layer;
//! 5. Y, in the same order, with RY and BY where they are there.

use exr::meta::header::Header;

/// Last names of layers and parts that hold the finished picture, in small letters.
const WHOLE: [&str; 12] =
    ["beauty", "combined", "rgba", "rgb", "color", "colour", "c", "ci", "main", "image", "composite", "final"];

/// How programs name the channels of a colour.
const COLOURS: [[&str; 3]; 5] =
    [["R", "G", "B"], ["r", "g", "b"], ["red", "green", "blue"], ["Red", "Green", "Blue"], ["RED", "GREEN", "BLUE"]];

/// How programs name alpha.
const ALPHA: [&str; 5] = ["A", "a", "alpha", "Alpha", "ALPHA"];

/// The channels that make a pixel, as indices of the part's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channels {
    Colour([usize; 3]),
    /// Y, RY = (R - Y) / Y, and BY.
    Chroma([usize; 3]),
    Luminance(usize),
}

impl Channels {
    pub fn indices(&self) -> &[usize] {
        match self {
            Channels::Colour(all) | Channels::Chroma(all) => all,
            Channels::Luminance(y) => std::slice::from_ref(y),
        }
    }
}

/// A layer that could be read.
#[derive(Clone, Debug)]
pub struct Layer {
    pub part: usize,
    /// Part and layer as a user would name them; empty where neither has a name.
    pub name: String,
    pub channels: Channels,
    /// The layer's alpha, as an index of the part's list.
    pub alpha: Option<usize>,
    rank: usize,
}

/// The layer that is read, and the others that rank as it does: what was chosen among. Deep parts have none.
pub fn choose(headers: &[Header]) -> Option<(Layer, Vec<Layer>)> {
    let mut layers: Vec<Layer> = (0..headers.len()).flat_map(|part| layers(headers, part)).collect();
    layers.sort_by_key(|layer| layer.rank);
    let mut alike = layers.into_iter();
    let first = alike.next()?;
    let others = alike.take_while(|layer| layer.rank == first.rank).collect();
    Some((first, others))
}

/// Every layer of a part that could be read, in the order of its channels.
fn layers(headers: &[Header], part: usize) -> Vec<Layer> {
    let header = &headers[part];
    if header.deep {
        return Vec::new();
    }
    let names: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
    let mut prefixes: Vec<&str> = Vec::new();
    for name in &names {
        let prefix = prefix(name);
        if !prefixes.contains(&prefix) {
            prefixes.push(prefix);
        }
    }
    let own = header.own_attributes.layer_name.as_ref().filter(|_| headers.len() > 1).map(ToString::to_string);
    let own = own.unwrap_or_default();
    let layer = |prefix: &str| {
        let channels = channels(&names, prefix)?;
        let layer = prefix.trim_end_matches(is_separator);
        let rank = match (layer.is_empty(), is_whole(layer), own.is_empty() || is_whole(&own)) {
            (true, _, true) => 0,
            (false, true, _) => 1,
            (true, ..) => 2,
            (false, ..) => 3,
        };
        let rank = if matches!(channels, Channels::Colour(_)) { rank } else { rank + 4 };
        let both: Vec<&str> = [own.as_str(), layer].into_iter().filter(|name| !name.is_empty()).collect();
        Some(Layer { part, name: both.join(", "), channels, alpha: alpha(&names, prefix), rank })
    };
    prefixes.into_iter().filter_map(layer).collect()
}

fn is_separator(c: char) -> bool {
    ".:/_- ".contains(c)
}

/// All up to the last dot; or up to the last of the other separators, where there is no dot.
fn prefix(name: &str) -> &str {
    let end = name.rfind('.').or_else(|| name.rfind(is_separator)).map_or(0, |at| at + 1);
    &name[..end]
}

fn is_whole(layer: &str) -> bool {
    let last = layer.rsplit(is_separator).next().unwrap_or(layer);
    WHOLE.contains(&last.to_lowercase().as_str())
}

fn alpha(names: &[String], prefix: &str) -> Option<usize> {
    let find = |last: &str| names.iter().position(|name| name.strip_prefix(prefix) == Some(last));
    ALPHA.into_iter().find_map(find)
}

fn channels(names: &[String], prefix: &str) -> Option<Channels> {
    let find = |last: &str| names.iter().position(|name| name.strip_prefix(prefix) == Some(last));
    let all = |[a, b, c]: [&str; 3]| Some([find(a)?, find(b)?, find(c)?]);
    if let Some(colour) = COLOURS.into_iter().find_map(all) {
        return Some(Channels::Colour(colour));
    }
    // Beside an X, a Y is a coordinate.
    let luminance = find("Y").filter(|_| find("X").is_none())?;
    Some(all(["Y", "RY", "BY"]).map_or(Channels::Luminance(luminance), Channels::Chroma))
}
