//! What is told of textures, and of a sky, that are not as large as their pictures.

use glam::UVec2;

use crate::engine::TextureUse;

/// What was told of the pictures of an engine, so that each thing is told once.
#[derive(Default)]
pub struct TextureNotices {
    told: Vec<String>,
}

impl TextureNotices {
    /// What is to be told of these textures, and of a sky of some size that was halved so often, and was not: that they were halved for want
    /// of room on the device. Those that a setting made smaller are as asked. One that fits again is forgotten, and told again where it
    /// does not.
    pub fn fresh(&mut self, uses: &[TextureUse], sky: Option<(UVec2, u32)>) -> Vec<String> {
        let texture = |used: &TextureUse| {
            text(
                &format!("texture `{}` of {}x{} texels", used.name, used.size.x, used.size.y),
                used.size,
                used.halvings,
                used.for_room,
            )
        };
        let sky = sky.map(|(size, halvings)| {
            text(&format!("environment's picture of {}x{} pixels", size.x, size.y), size, halvings, halvings)
        });
        let all: Vec<String> = uses.iter().filter(|used| used.for_room > 0).map(texture).chain(sky).collect();
        let before = std::mem::replace(&mut self.told, all);
        self.told.iter().filter(|text| !before.contains(text)).cloned().collect()
    }
}

/// Halved `halvings` times in all, of these `for_room` for want of room.
fn text(what: &str, size: UVec2, halvings: u32, for_room: u32) -> String {
    let times = if for_room == 1 { "once".to_owned() } else { format!("{for_room} times") };
    let [width, height] = size.to_array().map(|side| (side >> halvings).max(1));
    format!("the {what} is halved {times} to {width}x{height}: this adapter has no room for more (`lucerna doctor`)")
}
