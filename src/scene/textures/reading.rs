//! What the texels of a map say, by what the map is for and what its picture has.

use super::name::MapUse;
use super::picture::Picture;
use super::relief::has_directions;
use crate::components::{Channel, Reading, Texels};
use crate::image::Alpha;
use crate::scene::mtl::TextureMap;

/// Height of white above black for a `bump` of 1, in widths of the picture.
const BUMP: f32 = 0.01;

/// How a map's picture is read, and what is to be told of that.
pub fn reading(map: &TextureMap, used: MapUse, picture: &Picture) -> (Reading, Option<String>) {
    let directions = Reading::Normal { flip_green: map.flip_green };
    match used {
        MapUse::Colour => (Reading::Colour, None),
        MapUse::Normal => {
            let grey =
                is_grey(picture).then(|| "is grey: it has heights, not directions; name it by `bump`".to_owned());
            (directions, grey)
        }
        MapUse::Number => {
            let own = if picture.facts.alpha == Alpha::Partial { Channel::Alpha } else { brightness(picture) };
            (Reading::Number(map.channel.unwrap_or(own)), unfit(map, picture))
        }
        MapUse::Bump if map.channel.is_none() && has_directions(&picture.image) => {
            let text = "looks like a map of directions, and is read as one; `norm` says so without a warning";
            (directions, Some(text.to_owned()))
        }
        MapUse::Bump => {
            let channel = map.channel.unwrap_or(brightness(picture));
            (Reading::Height { channel, depth: map.bump * BUMP }, unfit(map, picture))
        }
    }
}

/// What is told where a map asks for what its picture does not have.
fn unfit(map: &TextureMap, picture: &Picture) -> Option<String> {
    match map.channel? {
        Channel::Alpha if picture.facts.alpha == Alpha::None => {
            Some("has no alpha, which is asked for: it counts as 1 everywhere".to_owned())
        }
        channel @ (Channel::Green | Channel::Blue) if is_grey(picture) => {
            let name = if channel == Channel::Green { "green" } else { "blue" };
            Some(format!("is grey, and has no {name}, which is asked for: its grey is taken"))
        }
        _ => None,
    }
}

/// The channel that says how bright a texel is.
fn brightness(picture: &Picture) -> Channel {
    if is_grey(picture) { Channel::Red } else { Channel::Luminance }
}

fn is_grey(picture: &Picture) -> bool {
    matches!(picture.image.texels, Texels::Grey8(_) | Texels::Grey16(_))
}
