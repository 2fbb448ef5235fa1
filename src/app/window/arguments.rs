//! What `lucerna view` accepts.

use clap::Args;

use super::keys::listed;
use crate::app::shared::scene::SceneFlags;
use crate::app::shared::values::MORE;

/// The scene that opens where none is named.
pub const DEFAULT_SCENE: &str = "cornell-box";

#[derive(Debug, Args)]
#[command(after_help = format!("{}\n\n{MORE}", listed()), allow_negative_numbers = true)]
pub struct ViewArguments {
    /// A scene file (.ron), a variant file (.ron), a model (.obj), or the name of a file in assets/scenes or assets/variants
    #[arg(default_value = DEFAULT_SCENE)]
    pub scene: String,
    /// Open without the panel of numbers and settings: F2 shows it
    #[arg(long)]
    pub no_panel: bool,
    #[command(flatten)]
    pub flags: SceneFlags,
    /// Don't judge edits of shaders by themselves while the window is left alone: J judges
    #[arg(long)]
    pub no_judge: bool,
}

impl Default for ViewArguments {
    fn default() -> Self {
        Self { scene: DEFAULT_SCENE.to_owned(), no_panel: false, flags: SceneFlags::default(), no_judge: false }
    }
}
