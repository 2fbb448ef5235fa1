//! Where a film's error comes from, in words: for the terminal, the panel and the report.

use serde_json::{Value, json};

use crate::components::{Integrator, Render, Reuse};
use crate::cpu::sources::{Share, Way};
use crate::engine::{ErrorSources, Source};

/// Ways that are shown.
const SHOWN: usize = 8;

/// Parts below this are not shown.
const LEAST: f64 = 0.005;

/// The part of the error that a hint is about, at least.
const WORTH_A_HINT: f64 = 0.25;

/// What a way is called.
pub fn word(way: Way) -> &'static str {
    match way {
        Way::Seen => "seen",
        Way::Sampled => "sampled",
        Way::Found => "found by chance",
        Way::Reused => "reused",
    }
}

/// The word of a way in reports.
fn key(way: Way) -> &'static str {
    match way {
        Way::Seen => "seen",
        Way::Sampled => "sampled",
        Way::Found => "found",
        Way::Reused => "reused",
    }
}

/// How light came, as in `found by chance through glass`.
fn how(way: Way, through: &Option<String>) -> String {
    let through = through.as_ref().map_or(String::new(), |name| format!(" through {name}"));
    format!("{}{through}", word(way))
}

/// The same of a way, as in `found by chance through glass, from floor`.
fn how_from(source: &Source) -> String {
    let from = source.surface.as_ref().map_or(String::new(), |name| format!(", from {name}"));
    format!("{}{from}", how(source.way, &source.through))
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

/// All of it in one sentence; none where there is no error.
pub fn sentence(sources: &ErrorSources) -> Option<String> {
    let (most, share) = sources.most.as_ref()?;
    let how = how(most.way, &most.through);
    Some(format!("{} of the error: {}, {how}, most of it at bounce {}", percent(share.share), most.light, most.bounce))
}

/// The table of the greatest parts, and of what is shown otherwise; a line each, without indentation.
pub fn lines(sources: &ErrorSources) -> Vec<String> {
    let Some(sentence) = sentence(sources) else {
        return vec!["where the error comes from: nowhere, no two samples of a pixel differ".to_owned()];
    };
    let mut lines = vec![
        sentence,
        format!("by {} more samples a pixel, whose mean has a relMSE of {:.1e}:", sources.samples, sources.relmse),
    ];
    let shown = sources.ways.iter().take(SHOWN).filter(|(_, share)| share.share >= LEAST);
    lines.extend(shown.map(|(source, share)| {
        let Share { share, deviation } = *share;
        let sure = if deviation.is_finite() { format!("+-{:.0}", 100.0 * deviation) } else { String::new() };
        format!("{:>6} {sure:<5} bounce {:<3} {}: {}", percent(share), source.bounce, source.light, how_from(source))
    }));
    lines.push(parts("by bounce", sources.by_bounce.iter().map(|(bounce, share)| (bounce.to_string(), share))));
    lines.push(parts("by way", sources.by_way.iter().map(|((way, through), share)| (how(*way, through), share))));
    lines.push(parts("by light", sources.by_light.iter().map(|(light, share)| (light.clone(), share))));
    lines.push(parts("by material", sources.by_surface.iter().map(|(name, share)| (surface(name), share))));
    lines
}

fn surface(name: &Option<String>) -> String {
    name.clone().unwrap_or_else(|| "none".to_owned())
}

fn parts<'a>(title: &str, parts: impl Iterator<Item = (String, &'a Share)>) -> String {
    let shown = parts.filter(|(_, share)| share.share >= LEAST).take(SHOWN);
    let shown: Vec<String> = shown.map(|(name, share)| format!("{name} {}", percent(share.share))).collect();
    format!("{title}: {}", shown.join(", "))
}

/// What is known to help against the greatest part; nothing where nothing is known.
pub fn hint(sources: &ErrorSources, render: &Render) -> Option<&'static str> {
    let (first, _) = sources.ways.first()?;
    let part = |picked: &dyn Fn(&Source) -> bool| -> f64 {
        sources.ways.iter().filter(|(source, _)| picked(source)).map(|(_, share)| share.share).sum()
    };
    let passed = part(&|source| source.way == Way::Found && source.through.is_some());
    let seen = part(&|source| source.way == Way::Seen);
    let sent_on = part(&|source| source.bounce > 1 && source.through.is_none() && source.way != Way::Reused);
    if passed >= WORTH_A_HINT {
        Some(
            "light sampling can't reach a light through solid glass or by a mirror; it goes straight through panes (`thin: true`), and larger lamps \
             are found more often",
        )
    } else if seen >= WORTH_A_HINT {
        Some("what the camera sees by itself, at edges and in mirrors: only more samples help")
    } else if first.way == Way::Found && render.integrator == Integrator::Bsdf {
        Some("--integrator path samples lights, and leaves less to chance")
    } else if sent_on >= WORTH_A_HINT && render.reuse == Reuse::Off {
        Some("light that surfaces send each other: where they are diffuse, --reuse tiles makes less of it")
    } else {
        None
    }
}

/// All of it, for programs. Shares are of 1.
pub fn report(sources: &ErrorSources, render: &Render) -> Value {
    // JSON has no infinity: of a picture too small to tell it is null.
    let part = |share: &Share| (share.share, Some(share.deviation).filter(|deviation| deviation.is_finite()));
    let ways: Vec<Value> = sources
        .ways
        .iter()
        .map(|(source, share)| {
            let (share, deviation) = part(share);
            json!({
                "share": share,
                "deviation": deviation,
                "bounce": source.bounce,
                "way": key(source.way),
                "light": source.light,
                "material": source.surface,
                "through": source.through,
            })
        })
        .collect();
    let listed = |name: &str, parts: Vec<(Value, &Share)>| -> Vec<Value> {
        let row = |(what, share): (Value, &Share)| {
            let (share, deviation) = part(share);
            json!({ name: what, "share": share, "deviation": deviation })
        };
        parts.into_iter().map(row).collect()
    };
    let by_way = sources.by_way.iter().map(|((way, through), share)| {
        let (share, deviation) = part(share);
        json!({ "way": key(*way), "through": through, "share": share, "deviation": deviation })
    });
    let by_way: Vec<Value> = by_way.collect();
    json!({
        "samples": sources.samples,
        "pixels": sources.pixels,
        "relmse": sources.relmse,
        "dropped": sources.dropped,
        "sentence": sentence(sources),
        "hint": hint(sources, render),
        "ways": ways,
        "by_bounce": listed("bounce", sources.by_bounce.iter().map(|(bounce, share)| (json!(bounce), share)).collect()),
        "by_way": by_way,
        "by_light": listed("light", sources.by_light.iter().map(|(light, share)| (json!(light), share)).collect()),
        "by_material":
            listed("material", sources.by_surface.iter().map(|(name, share)| (json!(name), share)).collect()),
    })
}
