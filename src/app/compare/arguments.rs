//! What `lucerna compare` accepts.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::app::shared::values::{MORE, crop, stops};
use crate::components::Crop;
use crate::image::{Kind, Output};

const HELP: &str = "\
Files are known by their content: EXR (linear; R, G, B or Y, also of a layer), Radiance HDR (linear), PNG (taken as sRGB).
Pixels that are NaN, infinite or negative in either file are counted, and left out of everything.

  MSE, MAE  mean of (A-B)^2 and of |A-B| over pixels and channels
  relMSE    mean of (A-B)^2 / (B^2 + 0.01)
  PSNR      of both as 8-bit sRGB at --exposure, the peak being white
  FLIP      mean LDR-FLIP (Andersson et al. 2020) of the same, at 67 pixels a degree: 0 alike, 1 black against white
  z         mean of A-B over a block in standard errors. The files carry no variance, so the standard error is that of
            A-B over the block's pixels, and at least that of the blocks around. It holds for pixels of independent
            noise: a box filter, no denoiser. The limit is passed by any block or channel of two pictures of equal
            expectation with a probability of 1e-4 in all; few samples with rare bright ones can do so more often.

";

#[derive(Debug, Args)]
#[command(after_help = format!("{HELP}{MORE}"))]
pub struct CompareArguments {
    /// The picture to be judged
    pub a: PathBuf,
    /// The reference
    pub b: PathBuf,
    /// Compare these pixels only, of the whole picture: from X0 up to but not X1, from Y0 up to but not Y1
    #[arg(long, value_name = "X0,X1,Y0,Y1", value_parser = crop, allow_hyphen_values = true)]
    pub crop: Option<Crop>,
    /// Side of a block in pixels, at least 8 [default: the longer side in 16]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(i64::from(super::comparison::LEAST_SIDE)..))]
    pub block: Option<u32>,
    /// Brighten both by so many stops for FLIP and PSNR, -64 to 64 [default: what B was rendered at, or A, else 0]
    #[arg(long, value_name = "STOPS", value_parser = stops, allow_hyphen_values = true)]
    pub exposure: Option<f32>,
    /// Exit with 4 if relMSE is above X, or A has a pixel that is NaN or infinite; so do the next four
    #[arg(long, value_name = "X", value_parser = most)]
    pub max_relmse: Option<f64>,
    /// ... if MSE is above X
    #[arg(long, value_name = "X", value_parser = most)]
    pub max_mse: Option<f64>,
    /// ... if MAE is above X
    #[arg(long, value_name = "X", value_parser = most)]
    pub max_mae: Option<f64>,
    /// ... if FLIP is above X
    #[arg(long, value_name = "X", value_parser = most)]
    pub max_flip: Option<f64>,
    /// ... if |z| of any block, or of the whole picture, is above X; `auto` is the limit that is printed
    #[arg(long, value_name = "X|auto", value_parser = most_z)]
    pub max_z: Option<MostZ>,
    /// Write a heat map to this .png
    #[arg(short, value_name = "FILE", value_parser = heat_map)]
    pub output: Option<Output>,
    /// What the heat map shows [default: flip, where it is built in, else relative]
    #[arg(long, value_enum, requires = "output")]
    pub heat: Option<Heat>,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// The largest |z| that is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MostZ {
    /// The family-wise limit.
    Auto,
    Fixed(f64),
}

/// What a heat map shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Heat {
    /// FLIP, black 0 to white 1
    Flip,
    /// Root of a pixel's relMSE, dark 0 to bright 1 and more
    Relative,
    /// z of blocks, blue where A is darker, red where it is brighter, full at the limit
    Z,
}

fn most(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(most) if most >= 0.0 && most.is_finite() => Ok(most),
        _ => Err("expected a number of at least 0".into()),
    }
}

fn most_z(text: &str) -> Result<MostZ, String> {
    match text {
        "auto" => Ok(MostZ::Auto),
        number => most(number).map(MostZ::Fixed).map_err(|error| format!("{error}, or `auto`")),
    }
}

fn heat_map(text: &str) -> Result<Output, String> {
    match Output::new(text) {
        Ok(output) if output.kind == Kind::Png => Ok(output),
        _ => Err("expected the name of a .png".into()),
    }
}
