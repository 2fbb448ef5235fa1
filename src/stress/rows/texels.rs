//! Lookups at the middles of texels, in the picture and far beyond it.

use glam::{DVec2, UVec2};

use crate::components::Wrap;
use crate::oracle::texture::Map;
use crate::stats::agreement::greatest;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::tools::lookups::{looked_up, texture};

pub static ROW: Row = Row {
    name: "texels",
    holds: "a lookup at a texel's middle is that texel: v up, repeated and clamped, of 1x1 and 1xN, at 1e6",
    quantity: "difference from the f64 lookup",
    most: 1e-5,
    unit: "lookups",
    sizes: [1, 20_000, 2_000_000],
    measure,
};

/// Sizes of pictures: powers of two alone have middles that floats of 1e6 can say.
const SIZES: [[u32; 2]; 5] = [[4, 8], [7, 5], [1, 1], [1, 6], [5, 1]];

/// The middles of all texels, in the picture and in those around it; where floats can say them, a million away as well.
fn middles(size: UVec2) -> Vec<DVec2> {
    let texels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| UVec2::new(x, y)));
    let middles: Vec<DVec2> = texels.map(|texel| (texel.as_dvec2() + 0.5) / size.as_dvec2()).collect();
    let mut shifts = vec![DVec2::ZERO, DVec2::new(1.0, -1.0), DVec2::new(-3.0, 2.0)];
    if size.x.is_power_of_two() && size.y.is_power_of_two() {
        shifts.push(DVec2::new(1e6, -1e6));
    }
    shifts.iter().flat_map(|shift| middles.iter().map(move |middle| middle + shift)).collect()
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let mut all = Measured::new(0.0, 0);
    for (k, picture) in SIZES.into_iter().enumerate() {
        for wrap in [Wrap::Repeat, Wrap::Clamp] {
            let texture = texture(picture.into(), wrap);
            let places = middles(picture.into());
            let spp = (size / (4 * 10 * places.len() as u64)).clamp(2, 1024) as u32;
            let map = Map::new(&texture);
            for (place, got) in places.iter().zip(looked_up(lab, &texture, &places, spp)?) {
                // As single precision says the place.
                let place = place.as_vec2().as_dvec2();
                let off = greatest((got - map.filtered(place)).abs().to_array());
                let note = format!("{} x {}, {wrap:?}, at {place}", picture[0], picture[1]);
                all = all.worst(Measured::new(off, 4 * u64::from(spp)).noted(note));
            }
        }
        lab.tell(k as u64 + 1, SIZES.len() as u64);
    }
    Ok(all)
}
