//! What is told of textures that are not as large as their pictures.

use crate::engine::{Engine, TextureUse};

/// Warnings of textures that were halved for want of room on the device, as they are now. Those that a setting made smaller are as asked.
pub fn warnings(engine: &Engine) -> Vec<String> {
    let text = |used: &TextureUse| {
        let (width, height) = (used.size.x >> used.halvings, used.size.y >> used.halvings);
        format!(
            "warning: the texture `{}` of {}x{} texels is halved {} to {}x{}: this adapter has no room for more (`lucerna doctor`)",
            used.name,
            used.size.x,
            used.size.y,
            if used.for_room == 1 { "once".to_owned() } else { format!("{} times", used.for_room) },
            width.max(1),
            height.max(1),
        )
    };
    engine.textures().iter().filter(|used| used.for_room > 0).map(text).collect()
}
