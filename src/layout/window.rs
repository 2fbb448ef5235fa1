//! Parameters of the shader that draws the picture to a window.

use glam::{UVec2, Vec2};

gpu_struct! {
    /// Parameters of the drawing of a picture to a window.
    pub struct WindowParams {
        /// Top left corner of the picture, window pixels.
        pub origin: Vec2,
        /// Size of the picture on the window, window pixels.
        pub extent: Vec2,
        /// Size of `picture`; zero if there is none.
        pub size: UVec2,
    }
}
