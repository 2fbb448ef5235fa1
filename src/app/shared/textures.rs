//! What is told of textures that are not as large as their pictures.

use crate::engine::TextureUse;

/// What was told of the textures of an engine, so that each thing is told once.
#[derive(Default)]
pub struct TextureNotices {
    told: Vec<String>,
}

impl TextureNotices {
    /// What is to be told of these textures and was not: that they were halved for want of room on the device. Those that a setting
    /// made smaller are as asked. One that fits again is forgotten, and told again where it does not.
    pub fn fresh(&mut self, uses: &[TextureUse]) -> Vec<String> {
        let all: Vec<String> = uses.iter().filter(|used| used.for_room > 0).map(text).collect();
        let before = std::mem::replace(&mut self.told, all);
        self.told.iter().filter(|text| !before.contains(text)).cloned().collect()
    }
}

fn text(used: &TextureUse) -> String {
    let (width, height) = (used.size.x >> used.halvings, used.size.y >> used.halvings);
    format!(
        "the texture `{}` of {}x{} texels is halved {} to {}x{}: this adapter has no room for more (`lucerna doctor`)",
        used.name,
        used.size.x,
        used.size.y,
        if used.for_room == 1 { "once".to_owned() } else { format!("{} times", used.for_room) },
        width.max(1),
        height.max(1),
    )
}
