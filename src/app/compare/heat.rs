//! The heat map: where two pictures differ, in colours that are even to the eye.

use std::io::Write;

use colorous::Color;

use super::arguments::Heat;
use super::comparison::Comparison;
use crate::image::{Output, SaveError};
use crate::stats::metrics::{comparable, relative_error};

/// Pixels that could not be compared: a colour that no scale has.
const BAD: Color = Color { r: 0, g: 255, b: 0 };

/// Writes the heat map as PNG, of the size of what was compared.
pub fn write(comparison: &Comparison, heat: Heat, output: &Output) -> Result<(), SaveError> {
    let size = comparison.size;
    output.write_by(|out| {
        let mut encoder = png::Encoder::new(out, size.x, size.y);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        let mut stream = writer.stream_writer()?;
        for row in 0..size.y as usize {
            let first = row * size.x as usize;
            let colours = (first..first + size.x as usize).map(|pixel| colour(comparison, heat, pixel));
            stream.write_all(&colours.flat_map(Color::into_array).collect::<Vec<u8>>())?;
        }
        stream.finish()?;
        Ok(writer.finish()?)
    })
}

fn colour(comparison: &Comparison, heat: Heat, pixel: usize) -> Color {
    let (a, b) = (comparison.a.pixels[pixel], comparison.b.pixels[pixel]);
    if !comparable(a, b) {
        return BAD;
    }
    match heat {
        Heat::Flip => colorous::MAGMA.eval_continuous(comparison.flip.get(pixel).copied().unwrap_or(0.0).into()),
        Heat::Relative => {
            let sum: f64 = a.iter().zip(b).map(|(a, b)| relative_error((*a).into(), b.into())).sum();
            colorous::VIRIDIS.eval_continuous((sum / 3.0).sqrt().min(1.0))
        }
        Heat::Z => {
            let z = comparison.z_at(pixel) / comparison.blocks.limit.unwrap_or(1.0);
            colorous::RED_BLUE.eval_continuous(0.5 - 0.5 * z.clamp(-1.0, 1.0))
        }
    }
}
