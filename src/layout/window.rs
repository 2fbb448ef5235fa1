//! Parameters of the shader that draws the picture to a window.

use glam::{UVec2, Vec2};

gpu_struct! {
    /// Parameters of the drawing of a picture to a window.
    pub struct WindowParams {
        /// Top left corner of the picture, window pixels.
        pub origin: Vec2,
        /// Size of the picture on the window, window pixels.
        pub extent: Vec2,
        /// Size of `picture`.
        pub size: UVec2,
        /// Size of `last`; zero if there is none.
        pub last_size: UVec2,
        /// Rows of `picture`, from the top, that show something; `last` is seen through the others.
        pub rows: u32,
        pub pad: u32,
    }
}
