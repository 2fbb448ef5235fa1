//! What kind of asset a file is: by its ending, else by what is in it.

use std::io::Read;
use std::path::Path;

use super::diagnostic::{Diagnostic, Severity};
use super::lines::words;
use super::obj::is_statement;
use super::text::{self, lenient};

/// The kinds of assets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A scene file (RON).
    Scene,
    /// A model (OBJ).
    Model,
    /// A library of materials (MTL).
    Library,
}

/// Bytes at the start of a file that are looked at.
const LOOKED_AT: u64 = 1 << 16;

/// First bytes of files of other kinds, and what they are.
const OTHERS: &[(&[u8], &str)] = &[
    (b"glTF", "a binary glTF model"),
    (b"Kaydara FBX", "an FBX model"),
    (b"; FBX", "an FBX model"),
    (b"ply\n", "a PLY model"),
    (b"ply\r", "a PLY model"),
    (b"solid ", "an STL model"),
    (b"BLENDER", "a Blender file"),
    (b"#usda", "a USD scene"),
    (b"PXR-USDC", "a USD scene"),
    (b"<?xml", "an XML file"),
    (b"{", "a JSON file"),
    (b"PK\x03\x04", "a ZIP archive"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"\x28\xb5\x2f\xfd", "a compressed (zstd) file"),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"\x76\x2f\x31\x01", "an EXR picture"),
    (b"#?", "a Radiance HDR picture"),
];

impl Kind {
    /// The kind that a path's ending names.
    pub fn by_ending(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        match ending.as_str() {
            "ron" => Some(Self::Scene),
            "obj" => Some(Self::Model),
            "mtl" => Some(Self::Library),
            _ => None,
        }
    }

    /// The kind of a file; `None` for text that is none of them. An error where there is nothing to read, or no text.
    pub fn of(path: &Path) -> Result<Option<Self>, Diagnostic> {
        if let Some(kind) = Self::by_ending(path) {
            return Ok(Some(kind));
        }
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("wgsl")) {
            return Err(Diagnostic::file(Severity::Error, path, "this is a shader, not an asset")
                .help("`lucerna check` of its folder checks all shaders there"));
        }
        let mut start = Vec::new();
        let file = text::open(path, u64::MAX)?;
        file.take(LOOKED_AT).read_to_end(&mut start).map_err(|error| text::cannot_read(path, &error))?;
        let other = OTHERS.iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, what)| *what);
        let binary = start.contains(&0).then_some("a binary file");
        match other.or(binary) {
            Some(what) => Err(Diagnostic::file(Severity::Error, path, format!("this is {what}"))
                .help("scenes are .ron files and models .obj files: export the model as OBJ")),
            None => Ok(by_content(&lenient(&start))),
        }
    }
}

/// The kind of a text, which may be cut off at its end.
fn by_content(text: &str) -> Option<Kind> {
    let whole = text.rfind(['\n', '\r']).map_or(text, |end| &text[..end]);
    let lines = whole.trim_start_matches('\u{feff}').lines().flat_map(|line| line.split('\r'));
    let mut statements = lines.map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')).peekable();
    let first = *statements.peek()?;
    if ["(", "//", "/*", "Scene("].iter().any(|start| first.starts_with(start)) {
        return Some(Kind::Scene);
    }
    if first.split_whitespace().next() == Some("newmtl") {
        return Some(Kind::Library);
    }
    // Prose may begin with a word that is a statement: not all its lines do, and none is a vertex.
    let mut vertices = false;
    for line in statements.take(100) {
        let mut parts = words(line);
        let key = parts.next().unwrap_or_default();
        if !is_statement(key) {
            return None;
        }
        vertices |= key == "mtllib" || key == "v" && parts.filter(|word| text::number(word).is_some()).count() >= 3;
    }
    vertices.then_some(Kind::Model)
}
