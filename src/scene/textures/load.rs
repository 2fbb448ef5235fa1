//! The textures of a scene: which files there are, what comes of each, and what is told of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use miette::Diagnostic as _;

use super::cache;
use super::decode::{Job, decode};
use super::name::{MapUse, name};
use super::picture::{Header, Picture, Reduction};
use super::{budget, reading};
use crate::components::{Reading, Texture};
use crate::files::Stamp;
use crate::image::{Codes, Fault, ReadError, TextureFile};
use crate::scene::assets::Assets;
use crate::scene::diagnostic::{Diagnostic, Diagnostics, Severity};
use crate::scene::mtl::TextureMap;

/// Bytes that the pictures of a scene take, at most, unless that is said otherwise.
const MOST_BYTES: u64 = 4 << 30;

/// How a scene's pictures are loaded.
#[derive(Clone, Copy)]
pub struct Loading<'a> {
    /// Bytes that they may take in all: beyond it, the largest are halved.
    pub texture_bytes: u64,
    /// Called, if pictures are to be decoded, with how many are and how many there are: first with none, then from any thread.
    pub tell: &'a (dyn Fn(usize, usize) + Sync),
}

impl Default for Loading<'_> {
    fn default() -> Self {
        Self { texture_bytes: MOST_BYTES, tell: &|_, _| {} }
    }
}

/// What came of the maps of a scene.
#[derive(Debug, Default)]
pub struct Textures {
    /// By name, those that could be read.
    pub textures: BTreeMap<String, Texture>,
    pub messages: Diagnostics,
    /// Every file that a map names.
    pub files: Vec<PathBuf>,
    /// Those of them that are empty or cut short.
    pub unfinished: Vec<PathBuf>,
}

impl Textures {
    /// Says why there is no texture.
    fn refuse(&mut self, error: &ReadError, place: Diagnostic) {
        if matches!(error.fault, Fault::CutShort | Fault::Empty) {
            self.unfinished.push(error.path.clone());
        }
        self.messages.push(refusal(error, place));
    }
}

/// One file, whatever paths lead to it.
struct Source {
    /// As a map names it first.
    path: PathBuf,
    /// None where the picture is held already.
    stamp: Option<Stamp>,
    /// The file may be written again without another stamp: its picture is not to be taken for that of the next load.
    young: bool,
    header: Header,
    /// None where the cache has its picture.
    file: Option<TextureFile>,
    codes: Codes,
}

/// Loads what maps name. `place` is where the first statement is that names a file: a warning without its message.
pub fn load<'m>(
    maps: impl IntoIterator<Item = (&'m TextureMap, MapUse)>,
    place: &dyn Fn(&Path) -> Diagnostic,
    loading: &Loading,
    assets: &Assets,
) -> Textures {
    let mut result = Textures::default();
    let maps: BTreeMap<String, (&TextureMap, MapUse)> =
        maps.into_iter().map(|(map, used)| (name(map, used), (map, used))).collect();
    let mut sources: BTreeMap<PathBuf, Source> = BTreeMap::new();
    let mut paths: BTreeMap<&Path, Option<PathBuf>> = BTreeMap::new();
    for (map, used) in maps.values() {
        let real = paths.entry(&map.file).or_insert_with(|| {
            result.files.push(map.file.clone());
            // That a file is missing, or is none, was told where it is named.
            let real = map.file.canonicalize().ok().filter(|real| real.is_file())?;
            if !sources.contains_key(&real) {
                match open(&map.file, &real, assets) {
                    Ok(source) => drop(sources.insert(real.clone(), source)),
                    Err(error) => result.refuse(&error, place(&map.file)),
                }
            }
            sources.contains_key(&real).then_some(real)
        });
        if let Some(source) = real.as_ref().and_then(|real| sources.get_mut(real))
            && *used == MapUse::Colour
        {
            source.codes = Codes::Srgb;
        }
    }
    let pictures = pictures(sources, place, loading, assets, &mut result);
    for (name, (map, used)) in maps {
        let real = paths.get(map.file.as_path()).and_then(Option::as_ref);
        if let Some(picture) = real.and_then(|real| pictures.get(real)) {
            let (reading, told) = reading::reading(map, used, picture);
            if let Some(text) = told {
                result.messages.push(warning(place(&map.file), &map.file, &text));
            }
            result.textures.insert(name, texture(map, reading, picture));
        }
    }
    result
}

/// A file as it is held, or as it is now.
fn open(path: &Path, real: &Path, assets: &Assets) -> Result<Source, ReadError> {
    if let Some(Picture { facts, .. }) = assets.any_picture(real) {
        let (path, header) = (path.to_path_buf(), facts.header);
        return Ok(Source { path, stamp: None, young: false, header, file: None, codes: Codes::Linear });
    }
    let stamp = Stamp::of(path);
    let young = stamp.as_ref().is_ok_and(Stamp::is_young);
    let (header, file) = match stamp.as_ref().ok().and_then(|stamp| cache::header(real, stamp)) {
        Some(header) => (header, None),
        None => {
            let file = TextureFile::open(path)?;
            (Header { size: file.size, bytes: file.bytes }, Some(file))
        }
    };
    let stamp = stamp.map_err(|error| ReadError { path: path.to_path_buf(), fault: Fault::Open(error) })?;
    Ok(Source { path: path.to_path_buf(), stamp: Some(stamp), young, header, file, codes: Codes::Linear })
}

/// The pictures of files, from the cache or decoded, small enough together.
fn pictures(
    sources: BTreeMap<PathBuf, Source>,
    place: &dyn Fn(&Path) -> Diagnostic,
    loading: &Loading,
    assets: &Assets,
    result: &mut Textures,
) -> BTreeMap<PathBuf, Picture> {
    let bytes: Vec<u64> = sources.values().map(|source| source.header.bytes).collect();
    let halvings = budget::halvings(&bytes, loading.texture_bytes);
    let (mut pictures, mut jobs, mut waiting) = (BTreeMap::new(), Vec::new(), Vec::new());
    for ((real, source), halvings) in sources.into_iter().zip(halvings) {
        let Source { path, stamp, young, file, codes, .. } = source;
        let reduction = Reduction { halvings, codes };
        if let Some(picture) = assets.picture(&real, reduction) {
            pictures.insert(real, (path, codes, picture));
            continue;
        }
        if let Some(picture) = stamp.as_ref().and_then(|stamp| cache::find(&real, stamp, reduction)) {
            assets.keep_picture(&real, stamp.as_ref(), &picture, false);
            pictures.insert(real, (path, codes, picture));
            continue;
        }
        match file.map_or_else(|| TextureFile::open(&path), Ok) {
            Ok(file) => {
                jobs.push(Job { file, reduction });
                waiting.push((real, path, stamp.filter(|_| !young), codes));
            }
            Err(error) => result.refuse(&error, place(&path)),
        }
    }
    for ((real, path, stamp, codes), picture) in waiting.into_iter().zip(decode(jobs, loading.tell)) {
        match picture {
            Ok(picture) => {
                if let Some(stamp) = &stamp {
                    cache::keep(&real, stamp, &picture);
                }
                assets.keep_picture(&real, stamp.as_ref(), &picture, true);
                pictures.insert(real, (path, codes, picture));
            }
            Err(error) => result.refuse(&error, place(&path)),
        }
    }
    let told = |(real, (path, codes, picture)): (PathBuf, (PathBuf, Codes, Picture))| {
        let texts = texts(&picture, codes, loading.texture_bytes);
        result.messages.list.extend(texts.iter().map(|text| warning(place(&path), &path, text)));
        (real, picture)
    };
    pictures.into_iter().map(told).collect()
}

/// What is told of a picture.
fn texts(picture: &Picture, codes: Codes, most: u64) -> Vec<String> {
    let facts = &picture.facts;
    let mut texts = facts.warnings.clone();
    if codes == Codes::Srgb {
        texts.extend(facts.colours.iter().cloned());
    }
    if facts.mended > 0 {
        let (count, noun) = (facts.mended, if facts.mended == 1 { "texel" } else { "texels" });
        texts.push(format!(
            "has {count} {noun} with a value that is negative, no number or above 65504: it is 0, or 65504"
        ));
    }
    if facts.reduction.halvings > 0 {
        let (from, to) = (facts.header.size, picture.image.size);
        texts.push(format!(
            "is made smaller, from {}x{} to {}x{}: the textures of this scene would take more than {:.1} GiB",
            from.x,
            from.y,
            to.x,
            to.y,
            most as f64 / (1u64 << 30) as f64
        ));
    }
    texts
}

fn texture(map: &TextureMap, reading: Reading, picture: &Picture) -> Texture {
    let TextureMap { wrap, scale, offset, gain, base, .. } = *map;
    Texture { image: picture.image.clone(), reading, wrap, scale, offset, gain, base }
}

/// What is told of a file: "`a.png` is grey", or "`a.png`: its end is missing".
fn warning(place: Diagnostic, path: &Path, text: &str) -> Diagnostic {
    let colon = if text.starts_with("its ") || text.starts_with("it ") { ":" } else { "" };
    Diagnostic { severity: Severity::Warning, message: format!("`{}`{colon} {text}", path.display()), ..place }
}

/// Why there is no texture, and what to do.
fn refusal(error: &ReadError, place: Diagnostic) -> Diagnostic {
    let message = format!("can't use `{}` as a texture: {}", error.path.display(), error.fault);
    let help = match (&error.fault, error.help()) {
        (Fault::Open(_) | Fault::Folder, _) | (_, None) => {
            "name a picture: a PNG, JPEG, TGA, BMP, WebP, TIFF, EXR or HDR file".to_owned()
        }
        (_, Some(help)) => help.to_string(),
    };
    Diagnostic { severity: Severity::Warning, message, ..place }
        .help(format!("{help}; without it, the plain colour is rendered"))
}
