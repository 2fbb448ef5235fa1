//! Lookups between texels: at their edges, at the picture's, anywhere.

use glam::{DVec2, DVec3};

use crate::components::Wrap;
use crate::oracle::Random;
use crate::oracle::texture::Map;
use crate::stats::agreement::{MOST_ERRORS, greatest};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::tools::lookups::{looked_up, texture};

pub static ROW: Row = Row {
    name: "texel-weights",
    holds: "lookups at edges of texels and of the picture, and anywhere between, have the filtered value as their mean",
    quantity: "standard errors from the f64 value",
    most: MOST_ERRORS,
    unit: "lookups",
    sizes: [200_000, 2_000_000, 400_000_000],
    measure,
};

const SIZES: [[u32; 2]; 4] = [[4, 8], [7, 5], [1, 6], [5, 1]];

/// Draws that tell the deviation of one.
const DRAWS: u32 = 2_000;

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let mut places = vec![DVec2::ZERO, DVec2::ONE, DVec2::new(0.5, 0.0), DVec2::new(0.0, 0.25), DVec2::new(1.0, 0.99)];
    let mut random = Random::new([7, 0, 0]);
    places.extend((0..20).map(|_| DVec2::new(4.0 * random.unit() - 2.0, 4.0 * random.unit() - 2.0)));
    let spp = size.div_ceil((4 * 2 * SIZES.len() * places.len()) as u64).min(1 << 20) as u32;
    let lookups = 4 * u64::from(spp);
    let mut all = Measured::new(0.0, 0);
    for (k, picture) in SIZES.into_iter().enumerate() {
        for wrap in [Wrap::Repeat, Wrap::Clamp] {
            let texture = texture(picture.into(), wrap);
            let map = Map::new(&texture);
            for (place, got) in places.iter().zip(looked_up(lab, &texture, &places, spp)?) {
                let place = place.as_vec2().as_dvec2();
                let right = map.filtered(place);
                let squares = (0..DRAWS).map(|_| (map.drawn(place, &mut random) - right).powf(2.0)).sum::<DVec3>();
                let errors = (squares / f64::from(DRAWS) / lookups as f64).map(f64::sqrt);
                // What single precision rounds is far below the noise, but where there is none.
                let beyond = (got - right).abs() - 1e-6;
                let off = greatest((beyond / errors.max(DVec3::splat(1e-7))).to_array());
                let note = format!("{} x {}, {wrap:?}, at {place:.3}", picture[0], picture[1]);
                all = all.worst(Measured::new(off, lookups).noted(note));
            }
        }
        lab.tell(k as u64 + 1, SIZES.len() as u64);
    }
    Ok(all)
}
