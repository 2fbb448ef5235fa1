//! The lookup of the f64 path tracer against values worked out by hand.

use std::sync::Arc;

use glam::{DVec2, DVec3, UVec2, Vec2};
use lucerna::components::{Channel, Reading, Texels, Texture, TextureImage, Wrap};
use lucerna::oracle::Random;
use lucerna::oracle::texture::Map;

/// 3 x 2 heights, numbers of 0 to 1 in tenths: the upper row 0, 1, 2 and the lower 3, 4, 5.
fn tenths(size: UVec2, reading: Reading, wrap: Wrap) -> Texture {
    let texels = (0..size.x * size.y).map(|i| [i as f32 / 10.0; 4]).collect();
    let image = TextureImage { size, texels: Texels::Float(texels) };
    Texture { wrap: [wrap; 2], ..Texture::new(Arc::new(image), reading) }
}

const RED: Reading = Reading::Number(Channel::Red);
const SIZE: UVec2 = UVec2::new(3, 2);

fn check(texture: &Texture, cases: &[(DVec2, f64)]) {
    let map = Map::new(texture);
    for (uv, right) in cases {
        let value = map.filtered(*uv);
        assert!((value - *right).abs().max_element() < 1e-6, "{value} at {uv}, not {right}");
        let mut random = Random::new([5, 0, 0]);
        let draws = 40_000;
        let mean = (0..draws).map(|_| map.drawn(*uv, &mut random).x).sum::<f64>() / f64::from(draws);
        // Five standard errors of values that are within 0.5.
        assert!((mean - right).abs() < 5.0 * 0.25 / f64::from(draws).sqrt(), "{mean} drawn at {uv}, not {right}");
    }
}

fn at(u: f64, v: f64) -> DVec2 {
    DVec2::new(u, v)
}

#[test]
fn texels_are_at_the_middles_of_their_cells_and_v_goes_up() {
    for wrap in [Wrap::Repeat, Wrap::Clamp] {
        let middles = [
            (at(0.5 / 3.0, 0.75), 0.0),
            (at(0.5, 0.75), 0.1),
            (at(2.5 / 3.0, 0.75), 0.2),
            (at(0.5 / 3.0, 0.25), 0.3),
            (at(2.5 / 3.0, 0.25), 0.5),
            (at(0.5, 0.5), 0.25),
            (at(1.0 / 3.0, 0.75), 0.05),
        ];
        check(&tenths(SIZE, RED, wrap), &middles);
    }
}

#[test]
fn what_lies_beyond_the_edges_is_the_picture_again_or_its_edge() {
    let repeated = [
        (at(0.0, 0.75), 0.1),
        (at(1.0, 0.75), 0.1),
        (at(0.5, 0.0), 0.25),
        (at(0.5, 1.0), 0.25),
        (at(0.0, 0.0), 0.25),
        (at(-0.5, 0.75), 0.1),
        (at(7.5, -3.75), 0.4),
        (at(1e6 + 0.5, -1e6 + 0.75), 0.1),
    ];
    check(&tenths(SIZE, RED, Wrap::Repeat), &repeated);
    let clamped = [
        (at(0.0, 1.0), 0.0),
        (at(1.0, 0.0), 0.5),
        (at(-7.0, 0.25), 0.3),
        (at(1e6, 1e6), 0.2),
        (at(0.5, -1e6), 0.4),
        (at(0.1, 0.75), 0.0),
    ];
    check(&tenths(SIZE, RED, Wrap::Clamp), &clamped);
}

#[test]
fn small_pictures_have_neighbours_too() {
    for wrap in [Wrap::Repeat, Wrap::Clamp] {
        let dot = Texture { base: 0.4, ..tenths(UVec2::ONE, RED, wrap) };
        check(&dot, &[(at(0.0, 0.0), 0.4), (at(0.7, -3.2), 0.4), (at(1e6, 1e6), 0.4)]);
    }
    let column = tenths(UVec2::new(1, 4), RED, Wrap::Repeat);
    check(&column, &[(at(0.3, 0.875), 0.0), (at(0.9, 0.125), 0.3), (at(0.0, 0.75), 0.05), (at(5.5, 1.0), 0.15)]);
    let row = tenths(UVec2::new(4, 1), RED, Wrap::Clamp);
    check(&row, &[(at(0.125, 0.3), 0.0), (at(0.25, 8.0), 0.05), (at(2.0, 0.0), 0.3)]);
}

#[test]
fn coordinates_are_scaled_then_moved_and_values_multiplied_then_raised() {
    let moved = Texture {
        scale: Vec2::new(-2.0, 0.5),
        offset: Vec2::new(0.5, 0.25),
        gain: -2.0,
        base: 0.5,
        ..tenths(SIZE, RED, Wrap::Repeat)
    };
    // (0, 1) is at (0.5, 0.75) of the picture; (0.5, 0) at (-0.5, 0.25), whose 0.4 comes to less than nothing.
    check(&moved, &[(at(0.0, 1.0), 0.3), (at(0.5, 0.0), 0.0), (at(0.5, 1.0), 0.3)]);
}

#[test]
fn codes_are_read_as_what_they_say() {
    let texel = |texels, reading| Map::new(&Texture::new(Arc::new(TextureImage { size: UVec2::ONE, texels }), reading));
    let near = |map: Map, right: DVec3| {
        let value = map.filtered(DVec2::new(0.3, 0.3));
        assert!((value - right).abs().max_element() < 1e-6, "{value}, not {right}");
    };
    let codes = || Texels::Rgba8(vec![[188, 10, 255, 51]]);
    // IEC 61966-2-1: 188 is 0.502886, 10 is on the straight part, 10 / 255 / 12.92.
    near(texel(codes(), Reading::Colour), DVec3::new(0.502_886_5, 0.003_035_269_8, 1.0));
    near(texel(codes(), Reading::Number(Channel::Alpha)), DVec3::splat(0.2));
    near(texel(codes(), Reading::Number(Channel::Red)), DVec3::splat(188.0 / 255.0));
    let luminance = (0.2126 * 188.0 + 0.7152 * 10.0 + 0.0722 * 255.0) / 255.0;
    near(texel(codes(), Reading::Number(Channel::Luminance)), DVec3::splat(luminance));
    near(texel(Texels::Float(vec![[3.0, 0.5, 0.0, 0.25]]), Reading::Colour), DVec3::new(3.0, 0.5, 0.0));
    near(texel(Texels::Grey16(vec![13107]), Reading::Number(Channel::Green)), DVec3::splat(0.2));
    let direction = |flip_green| texel(Texels::Rgba8(vec![[255, 51, 0, 255]]), Reading::Normal { flip_green });
    near(direction(false), DVec3::new(1.0, -0.6, 1e-3));
    near(direction(true), DVec3::new(1.0, 0.6, 1e-3));
}

#[test]
fn heights_slope_by_their_neighbours() {
    let reading = Reading::Height { channel: Channel::Green, depth: 0.5 };
    let near = |map: &Map, uv: DVec2, right: DVec3| {
        let value = map.filtered(uv);
        assert!((value - right).abs().max_element() < 1e-6, "{value} at {uv}, not {right}");
    };
    // Half a width of 3 texels: a tenth a texel is a slope of 0.15. Upwards in the clamped picture 0.3 are lost in a texel and its edge.
    let clamped = Map::new(&tenths(SIZE, reading, Wrap::Clamp));
    near(&clamped, at(0.5, 0.75), DVec3::new(-0.15, 0.225, 1.0));
    near(&clamped, at(2.5 / 3.0, 0.25), DVec3::new(-0.075, 0.225, 1.0));
    // Around the edge 0.2 is beside 0, and both neighbours of a row are the other one.
    let repeated = Map::new(&tenths(SIZE, reading, Wrap::Repeat));
    near(&repeated, at(0.5, 0.75), DVec3::new(-0.15, 0.0, 1.0));
    near(&repeated, at(0.5 / 3.0, 0.75), DVec3::new(0.075, 0.0, 1.0));
}
