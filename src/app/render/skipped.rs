//! What a render went without, and what it was spared.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::report::RenderSummary;
use crate::app::shared::spared;
use crate::engine::TileCounts;
use crate::layout::sort::SORT_DIGITS;
use crate::passes::features::{FEATURES, Feature};
use crate::passes::table::TABLE;

impl RenderSummary<'_> {
    /// What this scene went without, by name.
    pub fn skipped(&self) -> Value {
        json!({
            "features": self.features_left_out().map(|feature| feature.name).collect::<Vec<_>>(),
            "passes": self.passes_not_run().collect::<Vec<_>>(),
            // Null where no pass sorted.
            "digits": self.report.sorted_digits.map(|digits| SORT_DIGITS - digits),
            // Tiles of an adaptive film that were quiet enough for no work in its last round. Null where all pixels have as many samples.
            "tiles": self.report.tiles.map(|tiles| tiles.idle),
            "textures": {
                "unused": self.report.spared.unused_textures,
                "unused_bytes": self.report.spared.unused_texture_bytes,
                "halved_bytes": self.report.spared.halved_texture_bytes,
            },
            // Bytes that were on the device when the film began: of one film after another, as of bands.
            "uploads": self.report.spared.uploads,
            // Passes that ran for an earlier film alone, with their milliseconds. Null where the adapter can't time passes.
            "kept_passes": self.report.spared.passes.iter().copied().collect::<BTreeMap<_, _>>(),
            // Of a tree that was built for an earlier film. Null where it was built for this one.
            "kept_tree_milliseconds": self.report.spared.build_milliseconds,
        })
    }

    /// What is not compiled, not run and not sorted.
    pub fn skipped_lines(&self) -> String {
        let left_out: Vec<&str> = self.features_left_out().map(|feature| feature.what).collect();
        let not_run: Vec<&str> = self.passes_not_run().collect();
        let mut text = format!(
            "  not compiled, for nothing needs it, {} of {}: {}\n",
            left_out.len(),
            FEATURES.len(),
            left_out.join(", ")
        );
        text += &format!("  not run, {} of {} passes: {}\n", not_run.len(), TABLE.len(), not_run.join(", "));
        if let Some(TileCounts { tiles, least, median, most, idle }) = self.report.tiles {
            text += &format!("  not traced in the last round, {idle} of {tiles} tiles: they are quiet enough\n");
            text += &format!("  samples a pixel by tile: least {least}, median {median}, most {most}\n");
        }
        if let Some(digits) = self.report.sorted_digits {
            text +=
                &format!("  not sorted, {} of {SORT_DIGITS} digits: all keys agree in them\n", SORT_DIGITS - digits);
        }
        for (what, value) in spared::rows(&self.report.spared) {
            text += &value.map_or(String::new(), |value| format!("  {what}: {value}\n"));
        }
        text
    }

    fn features_left_out(&self) -> impl Iterator<Item = &'static Feature> {
        FEATURES.iter().filter(|feature| !self.report.features.contains(feature.name))
    }

    fn passes_not_run(&self) -> impl Iterator<Item = &'static str> {
        TABLE.iter().map(|pass| pass.name).filter(|name| !self.report.dispatches.contains_key(name))
    }
}
