//! What a report says of where the film's error comes from, and of what hangs on single samples.

use glam::UVec2;
use serde_json::{Value, json};

use super::report::RenderSummary;
use crate::app::shared::sources;
use crate::engine::{RobustFilm, Worst};
use crate::layout::film::ROBUST_BLOCKS;

impl RenderSummary<'_> {
    /// Where the error comes from, and what helps, where that was asked.
    pub fn source_lines(&self) -> String {
        let Some(found) = self.sources else { return String::new() };
        let hint = sources::hint(found, &self.description.render).map(|hint| format!("what helps: {hint}"));
        sources::lines(found).into_iter().chain(hint).map(|line| format!("  {line}\n")).collect()
    }

    /// Where the film hangs on single samples, for programs.
    pub fn robust_report(&self, robust: &RobustFilm) -> Value {
        let worst = |worst: &Worst| {
            let pixel = self.place(worst.index);
            json!({
                "pixel": [pixel.x, pixel.y],
                "plain": worst.plain,
                "robust": worst.robust,
                "brightest": worst.brightest,
                "sample": worst.sample,
                "replay": self.described().replay(pixel, worst.sample),
            })
        };
        json!({
            "blocks": ROBUST_BLOCKS,
            "plain": robust.plain,
            "robust": robust.robust,
            "parted": robust.parted,
            "worst": robust.worst.iter().map(worst).collect::<Vec<_>>(),
        })
    }

    /// The same for users, where that was asked.
    pub fn robust_lines(&self) -> String {
        let Some(robust) = self.robust else { return String::new() };
        let mut text = format!(
            "  robust mean {:.4} beside {:.4} (luminance); {:.2} % of the pixels part by more than their blocks explain\n",
            robust.robust,
            robust.plain,
            100.0 * robust.parted
        );
        for worst in &robust.worst {
            let pixel = self.place(worst.index);
            text += &format!(
                "    {},{}: {:.3} is {:.3} without its brightest samples; the first of these is {:.3e}:\n      {}\n",
                pixel.x,
                pixel.y,
                worst.plain,
                worst.robust,
                worst.brightest,
                self.described().replay(pixel, worst.sample)
            );
        }
        text
    }

    /// A pixel of the whole film by its place in the window.
    fn place(&self, index: usize) -> UVec2 {
        let width = self.film.window.size().x.max(1);
        self.film.window.min + UVec2::new(index as u32 % width, index as u32 / width)
    }
}
