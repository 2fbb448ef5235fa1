//! What is said about two pictures: text, JSON, and which limits they exceed.

use serde_json::{Value, json};

use super::arguments::{CompareArguments, MostZ};
use super::comparison::{Comparison, HAS_FLIP, Side};
use crate::stats::blocks::Block;

const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// A line for every --max flag that is exceeded. Whatever can't be stated exceeds its limit.
pub fn exceeded(comparison: &Comparison, arguments: &CompareArguments) -> Vec<String> {
    let difference = &comparison.difference;
    let z = arguments.max_z.and_then(|most| match most {
        MostZ::Auto => comparison.blocks.limit,
        MostZ::Fixed(most) => Some(most),
    });
    // Without a limit for z there is none that could be kept.
    let z = arguments.max_z.map(|_| z.unwrap_or(0.0));
    let limits = [
        ("relMSE", "--max-relmse", arguments.max_relmse, Some(difference.relative_mse)),
        ("MSE", "--max-mse", arguments.max_mse, Some(difference.mse)),
        ("MAE", "--max-mae", arguments.max_mae, Some(difference.mae)),
        ("FLIP", "--max-flip", arguments.max_flip, comparison.mean_flip()),
        ("|z|", "--max-z", z, comparison.blocks.largest_z()),
    ];
    let mut lines = Vec::new();
    for (name, flag, most, found) in limits {
        match (most, found) {
            (None, _) => {}
            (Some(most), Some(found)) if found <= most => {}
            (Some(most), Some(found)) => {
                let times = if most > 0.0 { format!(", {:.3} times that", found / most) } else { String::new() };
                lines.push(format!("differs: {name} is {found:.6}, {flag} is {most:.6}{times}"));
            }
            (Some(_), None) => lines.push(format!("differs: {name} can't be stated of so few pixels ({flag})")),
        }
    }
    let census = &comparison.a.census;
    let broken = census.not_a_number + census.infinite;
    if broken > 0 && limits.iter().any(|(_, _, most, _)| most.is_some()) {
        lines.push(format!("differs: {} has {broken} pixels that are NaN or infinite", comparison.a.name));
    }
    lines
}

/// What it comes to, in a sentence.
pub fn verdict(comparison: &Comparison) -> String {
    let (difference, blocks) = (&comparison.difference, &comparison.blocks);
    if difference.mse == 0.0 {
        return "equal: every pixel is the same in both".to_owned();
    }
    let mean = |of: [f64; 3]| of.iter().sum::<f64>();
    let by = 100.0 * (mean(difference.mean_a) / mean(difference.mean_b) - 1.0);
    let by = if by.is_finite() { format!("{by:+.2} %") } else { "from black".to_owned() };
    let (Some(limit), Some(whole)) = (blocks.limit, blocks.whole) else {
        return format!("can't tell a difference from noise, of so few pixels: A is {by} against B in the mean");
    };
    let whole = whole.iter().fold(0.0f64, |most, z| most.max(z.abs()));
    match blocks.beyond() {
        0 if whole <= limit => format!("no difference beyond noise: A is {by} against B in the mean"),
        0 => format!("they differ beyond noise: A is {by} against B in the mean, {whole:.1} standard errors"),
        beyond => {
            let of = blocks.list.len();
            let worst = blocks.worst().map_or(String::new(), |block| {
                format!(", by up to {:+.1} % in {}", 100.0 * block.relative, comparison.place(block))
            });
            format!("they differ beyond noise in {beyond} of {of} blocks{worst}; A is {by} against B in the mean")
        }
    }
}

/// The lines for users.
pub fn text(comparison: &Comparison) -> String {
    let (a, b, difference) = (&comparison.a, &comparison.b, &comparison.difference);
    let mut text = format!("{}\n", verdict(comparison));
    text += &format!("{} against {}: {}x{}", a.name, b.name, comparison.size.x, comparison.size.y);
    text += &format!(" from {},{}, {} pixels compared\n", comparison.origin.x, comparison.origin.y, difference.pixels);
    text += &bad(a, comparison);
    text += &bad(b, comparison);
    let mut line = |name: &str, value: String| text += &format!("  {name:<10} {value}\n");
    let rgb = |mean: [f64; 3]| mean.map(|channel| format!("{channel:.6}")).join(" ");
    line("mean of A", rgb(difference.mean_a));
    line("mean of B", rgb(difference.mean_b));
    line("MSE", format!("{:.6e}", difference.mse));
    line("MAE", format!("{:.6e}", difference.mae));
    line("relMSE", format!("{:.6e}", difference.relative_mse));
    let exposure = comparison.exposure;
    let psnr = comparison.psnr.map_or("equal pictures".to_owned(), |psnr| format!("{psnr:.3} dB"));
    line("PSNR", format!("{psnr} (as 8-bit sRGB, exposure {exposure})"));
    match comparison.mean_flip() {
        Some(flip) => line("FLIP", format!("{flip:.6} (mean LDR-FLIP, exposure {exposure})")),
        None => line("FLIP", "not built in".to_owned()),
    }
    let blocks = &comparison.blocks;
    line("blocks", format!("{}x{}", blocks.grid.count.x, blocks.grid.count.y));
    if let Some(block) = blocks.most_different() {
        line(
            "",
            format!("largest relative difference {:+.4} % in {}", 100.0 * block.relative, comparison.place(block)),
        );
    }
    if let (Some(limit), Some(whole), Some(block)) = (blocks.limit, blocks.whole, blocks.worst()) {
        let [r, g, b] = whole;
        line("z", format!("whole picture {r:+.2} {g:+.2} {b:+.2}; |z| above {limit:.2} is a difference (1e-4)"));
        let (z, channel) = block.worst().unwrap_or_default();
        line("", format!("{} of {} blocks above", blocks.beyond(), blocks.list.len()));
        line("", format!("worst {z:+.2} ({}) in {}", CHANNELS[channel], comparison.place(block)));
    } else {
        line("z", "too few pixels".to_owned());
    }
    text
}

/// One object for programs. What is infinite or unknown is null.
pub fn json(comparison: &Comparison, arguments: &CompareArguments, exceeded: &[String]) -> Value {
    let (difference, blocks) = (&comparison.difference, &comparison.blocks);
    let side = |side: &Side, mean: [f64; 3]| {
        let census = &side.census;
        json!({
            "file": side.name,
            "mean": mean,
            "not_a_number": census.not_a_number,
            "infinite": census.infinite,
            "negative": census.negative,
            "first_bad": census.first.map(|index| comparison.position(index)),
        })
    };
    let block = |block: &Block| {
        json!({
            "crop": comparison.corners(block),
            "pixels": block.pixels,
            "mean_a": block.mean_a,
            "mean_b": block.mean_b,
            "relative": block.relative,
            "z": block.z,
        })
    };
    json!({
        "verdict": verdict(comparison),
        "a": side(&comparison.a, difference.mean_a),
        "b": side(&comparison.b, difference.mean_b),
        "size": [comparison.size.x, comparison.size.y],
        "origin": [comparison.origin.x, comparison.origin.y],
        "pixels": difference.pixels,
        "mse": difference.mse,
        "mae": difference.mae,
        "relmse": difference.relative_mse,
        "exposure": comparison.exposure,
        "psnr": comparison.psnr,
        "flip": comparison.mean_flip(),
        "has_flip": HAS_FLIP,
        "blocks": {
            "count": [blocks.grid.count.x, blocks.grid.count.y],
            "z_limit": blocks.limit,
            "beyond": blocks.beyond(),
            "whole_z": blocks.whole,
            "worst": blocks.worst().map(block),
            "most_different": blocks.most_different().map(block),
        },
        "heat_map": arguments.output.as_ref().map(|output| output.path.display().to_string()),
        "exceeded": exceeded,
    })
}

/// The bad pixels of one picture; nothing if there are none.
fn bad(side: &Side, comparison: &Comparison) -> String {
    let census = &side.census;
    let Some(first) = census.first else { return String::new() };
    let [x, y] = comparison.position(first);
    format!(
        "  {}: {} pixels NaN, {} infinite, {} negative, left out; the first at {x},{y}\n",
        side.name, census.not_a_number, census.infinite, census.negative
    )
}

impl Comparison {
    /// Of a pixel, in what --crop counts.
    fn position(&self, index: usize) -> [i64; 2] {
        let width = self.size.x as usize;
        let [x, y] = [index % width, index / width].map(|at| i64::try_from(at).unwrap_or(i64::MAX));
        [x + i64::from(self.origin.x), y + i64::from(self.origin.y)]
    }

    /// X0, X1, Y0, Y1 of a block, in what --crop counts.
    fn corners(&self, block: &Block) -> [i64; 4] {
        let (x, y) = (i64::from(self.origin.x), i64::from(self.origin.y));
        let [x0, x1] = [block.min.x, block.max.x].map(|at| x + i64::from(at));
        let [y0, y1] = [block.min.y, block.max.y].map(|at| y + i64::from(at));
        [x0, x1, y0, y1]
    }

    fn place(&self, block: &Block) -> String {
        self.corners(block).map(|corner| corner.to_string()).join(",")
    }
}
