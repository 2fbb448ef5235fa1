//! A verdict as text, and as JSON.

use std::path::Path;

use serde_json::{Value, json};

use super::arguments::JudgeArguments;
use super::folder;
use super::look::{End, Estimator, Look};
use crate::cpu::equal_means::Difference;
use crate::scene::SceneDescription;

/// All there is to say.
pub struct Account<'a> {
    pub arguments: &'a JudgeArguments,
    /// The scene file.
    pub path: &'a Path,
    pub description: &'a SceneDescription,
    pub adapter: String,
    /// Whether the scene runs other code than before.
    pub changed: bool,
    pub look: &'a Look,
}

/// Of code that is the same, where nothing was traced.
pub fn unchanged(text: &str, json: bool) -> String {
    match json {
        true => format!("{}\n", json!({ "verdict": text, "changed": false })),
        false => format!("{text}\n"),
    }
}

impl Account<'_> {
    pub fn json(&self, outputs: &[String]) -> Value {
        let (look, means) = (self.look, &self.look.means);
        let size = self.description.film.window().size();
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "scene": self.description.name,
            "scene_file": self.path.display().to_string(),
            "adapter": self.adapter,
            "old_shaders": folder(self.arguments.old.as_deref()),
            "new_shaders": folder(Some(&self.arguments.new)),
            "size": size.to_array(),
            "seed": self.arguments.seed,
            "spp": look.spp,
            "films": look.films,
            "changed": self.changed,
            "verdict": look.line(),
            "ended": look.ended.map_or("interrupted", |end| match end {
                End::Differ => "means differ",
                End::Narrow => "efficiency is known",
                End::Time => "time is over",
                End::Films => "all films are traced",
            }),
            // Null where films have no noise.
            "efficiency": look.ratio.map(|ratio| json!({ "ratio": ratio.ratio, "low": ratio.low, "high": ratio.high })),
            "old": estimator(&look.old),
            "new": estimator(&look.new),
            "means": {
                // With too few films nothing is told, and nothing differs.
                "told": look.tells(),
                "differ": means.differ(),
                "alpha": self.arguments.alpha,
                "alpha_of_look": means.spent,
                "whole": difference(&means.whole),
                "blocks": means.blocks.len(),
                "differing": means.differing().map(difference).collect::<Vec<_>>(),
            },
            "outputs": outputs,
        })
    }

    /// The verdict, and what it rests on.
    pub fn text(&self, outputs: &[String]) -> String {
        let (look, size) = (self.look, self.description.film.window().size());
        let mut text = format!(
            "{}\n  {}: {} films of each by turns, {} spp, {}x{}\n  a film's relMSE {:.2e} -> {:.2e}, its time {:.1} -> {:.1} ms\n",
            look.line(),
            self.description.name,
            look.films,
            look.spp,
            size.x,
            size.y,
            look.old.relmse,
            look.new.relmse,
            1e3 * look.old.seconds,
            1e3 * look.new.seconds,
        );
        for output in outputs {
            text += &format!("  {output}\n");
        }
        text
    }

    /// What was left out of the films, and what to do about too few of them.
    pub fn warnings(&self) -> Vec<String> {
        let named = [("old", &self.look.old), ("new", &self.look.new)];
        let bad = named.into_iter().filter(|(_, estimator)| estimator.bad_samples > 0);
        let line = |(name, estimator): (&str, &Estimator)| {
            let count = estimator.bad_samples;
            format!("warning: {count} samples of the {name} one were no numbers, or too large, and were left out")
        };
        let few = (!self.look.tells())
            .then(|| "help: give more --time or --films, a smaller --size or fewer --spp".to_owned());
        bad.map(line).chain(few).collect()
    }

    /// For the files.
    pub fn metadata(&self) -> Vec<(&'static str, String)> {
        vec![
            ("Software", concat!("Lucerna ", env!("CARGO_PKG_VERSION")).to_owned()),
            ("scene", self.path.display().to_string()),
            ("old", folder(self.arguments.old.as_deref())),
            ("new", folder(Some(&self.arguments.new))),
            ("verdict", self.look.line()),
        ]
    }
}

fn estimator(estimator: &Estimator) -> Value {
    json!({ "relmse": estimator.relmse, "seconds": estimator.seconds, "bad_samples": estimator.bad_samples })
}

fn difference(at: &Difference) -> Value {
    json!({
        "block": [at.min.x, at.max.x, at.min.y, at.max.y],
        "old": at.old,
        "difference": at.difference,
        "standard_error": at.standard_error,
        "relative": at.relative,
        "p": at.p,
        "differs": at.differs,
    })
}
