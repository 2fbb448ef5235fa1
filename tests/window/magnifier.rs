//! Pixels as large squares: the one under the pointer stays there.

use glam::{UVec2, Vec2};
use lucerna::app::window::magnifier::Magnifier;
use lucerna::gpu::Fit;

#[test]
fn the_pixel_under_the_pointer_stays_there() {
    let (picture, window) = (UVec2::new(640, 480), UVec2::new(640, 480));
    let pointer = Vec2::new(123.0, 321.0);
    let under = |fit: Fit| {
        let (origin, extent) = fit.place(picture, window);
        ((pointer - origin) / extent * picture.as_vec2(), extent.x / picture.x as f32)
    };
    let mut magnifier = Magnifier::default();
    assert_eq!((magnifier.fit(Fit::Fill), magnifier.scale()), (Fit::Fill, None));
    let mut scale = 1.0;
    for _ in 0..9 {
        magnifier.turn(1, pointer, picture, window, Fit::Fill);
        scale = f32::min(2.0 * scale, 64.0);
        let (at, pixel) = under(magnifier.fit(Fit::Fill));
        assert!(at.distance(pointer) < 0.51 && pixel == scale, "{at} at {pixel}");
    }
    assert_eq!(magnifier.scale(), Some(64));
    magnifier.turn(-5, pointer, picture, window, Fit::Fill);
    assert_eq!(magnifier.scale(), Some(2));
    magnifier.turn(-9, pointer, picture, window, Fit::Fill);
    assert_eq!(magnifier, Magnifier::default());
}

#[test]
fn a_crop_is_magnified_from_where_it_lies() {
    let (picture, window) = (UVec2::new(96, 96), UVec2::new(300, 200));
    let mut magnifier = Magnifier::default();
    // The middle of the picture and of the window.
    magnifier.turn(3, Vec2::new(150.0, 100.0), picture, window, Fit::Letterbox);
    let (origin, extent) = magnifier.fit(Fit::Letterbox).place(picture, window);
    assert_eq!((origin, extent), (Vec2::new(-234.0, -284.0), Vec2::splat(768.0)));
}
