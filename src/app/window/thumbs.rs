//! Small pictures of the members of a family, as they were last seen.

use std::collections::BTreeMap;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

use super::pair::Seen;
use crate::app::shared::shrink::{fitting, shrink};
use crate::image::srgb::srgb_decode;

/// The longest side of one, pixels.
pub const SIDE: u32 = 64;

/// Between two pictures of a film that grows.
const PAUSE: Duration = Duration::from_secs(1);

/// Linear light of a byte.
static LIGHT: LazyLock<[f64; 256]> = LazyLock::new(|| std::array::from_fn(|byte| srgb_decode(byte as f64 / 255.0)));

/// What a film was when its picture was made small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stand {
    /// When it started anew.
    pub began: Instant,
    pub spp: u32,
    pub finished: bool,
}

/// The small pictures, by the members' names.
#[derive(Default)]
pub struct Thumbs {
    small: BTreeMap<String, Small>,
    /// What the latest of them is of, and when it was made.
    last: Option<(String, Stand, Instant)>,
}

struct Small {
    picture: ColorImage,
    drawn: Option<TextureHandle>,
}

impl Thumbs {
    /// Whether a film is to be made small now: one that is finished, at once; one that grows, now and then.
    pub fn wants(&self, name: &str, stand: Stand, now: Instant) -> bool {
        stand.spp > 0
            && self.last.as_ref().is_none_or(|(last, then, at)| {
                (last != name || *then != stand)
                    && (last != name || stand.finished || now.saturating_duration_since(*at) >= PAUSE)
            })
    }

    /// Makes a picture small, in place of an earlier one of that member.
    pub fn take(&mut self, seen: &Seen, stand: Option<Stand>, now: Instant) {
        let size = fitting(seen.size, SIDE);
        let light = |index: usize| {
            let [r, g, b, _] = seen.pixels[index];
            [r, g, b].map(|byte| LIGHT[usize::from(byte)])
        };
        let pixels = shrink(seen.size, size, light);
        let picture = ColorImage::from_rgb([size.x as usize, size.y as usize], pixels.as_flattened());
        self.small.insert(seen.name.clone(), Small { picture, drawn: None });
        if let Some(stand) = stand {
            self.last = Some((seen.name.clone(), stand, now));
        }
    }

    /// That of a member, if it was seen, as a texture.
    pub fn texture(&mut self, context: &Context, name: &str) -> Option<&TextureHandle> {
        let Small { picture, drawn } = self.small.get_mut(name)?;
        Some(drawn.get_or_insert_with(|| context.load_texture("thumb", picture.clone(), TextureOptions::LINEAR)))
    }
}
