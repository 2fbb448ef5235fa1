//! What a scene file says of values that change with time.

use std::collections::BTreeSet;

use crate::scene::animate::{Animation, Curve, FPS, FPS_RANGE, Key, MOST_FRAMES, Track, Value};
use crate::scene::diagnostic::{Diagnostic, Severity};
use crate::scene::ron::{Fields, Kind, Node, Reader};

/// What all values of a track may be.
const SHAPES: &str = "write { 0: a, 47: b }, Smooth({ 0: a, 47: b }), or Step({ 0: a, 47: b })";

/// `(frames: 48, fps: 24, keys: { "path": { 0: a, 47: b }, .. })`
pub fn read_animation(reader: &Reader, node: &Node, path: &str) -> Option<Animation> {
    let fields = Fields::open(reader, node, path)?;
    let frames = fields.require("frames", |node| node.integer(1, MOST_FRAMES));
    let [least, most] = FPS_RANGE;
    let fps = fields.read("fps", |node| node.number(least, most)).unwrap_or(FPS);
    let keys = fields.get("keys");
    if keys.is_none() {
        fields.fail("the field `keys` is missing");
    }
    let tracks = keys.and_then(|keys| read_tracks(reader, keys, Times { frames: frames.unwrap_or(MOST_FRAMES), fps }));
    fields.finish().then_some(Animation { frames: frames?, fps, tracks: tracks? })
}

/// How long an animation is.
#[derive(Clone, Copy)]
struct Times {
    frames: u32,
    fps: f64,
}

/// All tracks; what is wrong is reported.
fn read_tracks(reader: &Reader, node: &Node, times: Times) -> Option<Vec<Track>> {
    let fields = node.fields().map_err(|message| reader.error(node, "animate.keys", message)).ok()?;
    let fields: Vec<_> = fields.iter().filter(|(.., node)| !node.is_none()).collect();
    if fields.is_empty() {
        let error = node.text.error(node.source, "animate.keys: there is nothing that changes");
        reader.push(error.help("write { \"cameras.front.position\": { 0: (0, 1, 5), 47: (3, 1, 4) } }"));
        return None;
    }
    let track = |(path, place, node): &(String, &str, Node)| {
        let track = read_track(path, node.text.at(Severity::Warning, place, ""), node, times);
        let about = |error: Diagnostic| Diagnostic { message: format!("keys of `{path}`: {}", error.message), ..error };
        track.map_err(|error| reader.push(about(error))).ok()
    };
    let tracks: Vec<_> = fields.into_iter().map(track).collect();
    tracks.into_iter().collect()
}

fn read_track(path: &str, place: Diagnostic, node: &Node, times: Times) -> Result<Track, Diagnostic> {
    if path.split('.').next() == Some("animate") {
        let error =
            Diagnostic { severity: Severity::Error, message: "what is animated can't itself be".into(), ..place };
        return Err(error.help("name another value of the scene"));
    }
    let (curve, content) = match &node.kind {
        Kind::Variant("Smooth", Some(content)) => (Curve::Smooth, content.inner()),
        Kind::Variant("Step", Some(content)) => (Curve::Step, content.inner()),
        _ => (Curve::Linear, node),
    };
    let error = |node: &Node, message: String| node.text.error(node.source, message);
    let Kind::Fields(entries) = &content.kind else {
        let none = matches!(&content.kind, Kind::Items(items) if items.is_empty());
        let message = if none { "there is no key".into() } else { format!("expected keys, found {}", node.describe()) };
        return Err(error(content, message).help(SHAPES));
    };
    let mut keys: Vec<Key> = Vec::new();
    // What holds until the next key may be nothing.
    let is_key = |node: &Node| curve == Curve::Step || !node.is_none();
    let mut known = BTreeSet::new();
    for (time, place, node) in entries.iter().filter(|(.., node)| is_key(node)) {
        let wrong = |message: String| content.text.error(place, message);
        let at = read_time(time, times).map_err(|(message, help)| wrong(message).help(help))?;
        if !known.insert(at.to_bits()) {
            return Err(wrong(format!("a second key at frame {at}")).help("leave one of them out"));
        }
        let value = Value::of(node);
        if curve != Curve::Step {
            check_value(&value, keys.first()).map_err(|(message, help)| error(node, message).help(help))?;
        }
        keys.push(Key { at, value, place: node.text.at(Severity::Warning, node.source, "") });
    }
    if keys.is_empty() {
        return Err(error(content, "there is no key".into()).help(SHAPES));
    }
    keys.sort_by(|a, b| a.at.total_cmp(&b.at));
    Ok(Track { path: path.to_owned(), place, curve, keys })
}

/// Whether there is something between a value and those of a track; else what is wrong, and what to do.
fn check_value(value: &Value, first: Option<&Key>) -> Result<(), (String, String)> {
    if value.numbers.is_empty() {
        let help = "write Step({ 0: a, 24: b }) for what changes at once".into();
        return Err(("expected a value with numbers, which go from key to key".into(), help));
    }
    let Some(first) = first.filter(|first| !first.value.is_like(value)) else { return Ok(()) };
    let [has, had] = [value, &first.value].map(|value| match value.numbers.len() {
        1 => "one number".to_owned(),
        count => format!("{count} numbers"),
    });
    let message = match has == had {
        true => format!("this is of another form than the value at frame {}", first.at),
        false => format!("this has {has}, and the value at frame {} has {had}", first.at),
    };
    Err((message, "all values of a path differ in their numbers alone".into()))
}

/// When a key is, in frames; else what is wrong, and what to do.
fn read_time(time: &str, Times { frames, fps }: Times) -> Result<f64, (String, String)> {
    let seconds = time.strip_suffix('s').and_then(|seconds| seconds.trim().parse::<f64>().ok()).map(|at| at * fps);
    let at = time.parse::<u32>().ok().map(f64::from).or(seconds).filter(|at| at.is_finite() && *at >= 0.0);
    let Some(at) = at else {
        let help = "write the number of a frame, as 24, or seconds, as \"1.5s\"".into();
        return Err((format!("`{}` is no time of a key", time.escape_debug()), help));
    };
    if at > f64::from(frames) {
        // The one behind the last is where a loop closes.
        let help =
            format!("frames are 0 to {}; a key may also be at {frames}, where the next round begins", frames - 1);
        return Err((format!("frame {at} is beyond the end"), help));
    }
    // A zero of either sign is one frame.
    Ok(at + 0.0)
}
