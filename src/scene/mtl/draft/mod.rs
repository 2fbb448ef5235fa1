//! A material while its statements are read, and what they come to in the end.

mod warn;

use std::collections::BTreeMap;

use glam::Vec3;

use super::maps::MapFiles;
use super::material::MtlMaterial;
use super::options::Context;
use super::texture_map::TextureMap;
use super::values::{colour, reflectance, scalar, whole};
use crate::scene::diagnostic::{Diagnostic, Tally};
use crate::scene::keys::{Colour, Key, Value, suggest_statement};
use crate::scene::lines::{Line, words};
use crate::scene::text;
use crate::scene::textures::MapUse;

/// Statements beside the keys, for suggestions: those that come before them, and after.
const FIRST: &[&str] = &["newmtl", "Ka"];
const LAST: &[&str] = &["Le", "Tr", "map_Ka", "bump", "disp", "map_Disp", "map_Ps", "decal", "refl", "sharpness"];

/// `illum` of a surface with highlights, and nothing else.
const HIGHLIGHTS: u32 = 2;

/// How a library is to be read, by all that is in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Habits {
    /// `Tr`, where there is no `d`, is opacity: as transparency it would hide most of the library.
    pub tr_is_opacity: bool,
    /// One `illum` and one `Ni` are on all materials, of whatever colour: they make no glass.
    pub glass_is_constant: bool,
}

/// One material so far. Places are warnings that lack their message.
#[derive(Debug)]
pub struct Draft {
    name: String,
    place: Diagnostic,
    /// What keys were given, over the default; and the place of each, by its name in scene files.
    given: MtlMaterial,
    places: BTreeMap<&'static str, Diagnostic>,
    le: Option<(Vec3, Diagnostic)>,
    tr: Option<(f32, Diagnostic)>,
    /// Heights that the surface was to be moved by, and their place.
    disp: Option<(TextureMap, Diagnostic)>,
}

impl Draft {
    /// A material without statements; `key` is its `newmtl`.
    pub fn new(name: &str, line: &Line, key: &str) -> Self {
        Self {
            name: name.to_owned(),
            place: line.warning(key, ""),
            given: MtlMaterial::default(),
            places: BTreeMap::new(),
            le: None,
            tr: None,
            disp: None,
        }
    }

    /// Reads one statement. Whether it says what a key, `Le`, `Tr` or `disp` is, or nothing that could be rendered.
    pub fn read(&mut self, line: &Line, key: &str, rest: &str, files: &mut MapFiles, tally: &mut Tally) -> bool {
        if let Some(known) = Key::of_statement(key) {
            let taken = self.read_key(known, line, key, rest, files, tally).is_some();
            if taken {
                self.places.insert(known.scene, line.warning(key, ""));
            }
            return taken;
        }
        let place = || line.warning(key, "");
        match key.to_ascii_lowercase().as_str() {
            "le" => {
                return replace(&mut self.le, colour(line, key, rest, Colour::Radiance.most_in_mtl(), tally), place);
            }
            "tr" => return replace(&mut self.tr, scalar(line, key, rest, 0.0, 1.0, tally), place),
            "ka" | "map_ka" | "sharpness" => tally.once("ambient light", || {
                line.warning(key, format!("`{key}` has no meaning in path tracing; it is left out in this whole file"))
            }),
            "disp" | "map_disp" => {
                let map = files.read(&Context { line, key, used: MapUse::Bump }, rest, tally);
                return replace(&mut self.disp, map, place);
            }
            "map_ps" => tally.push("statements not honoured yet", || {
                line.warning(key, format!("`{key}` is of sheen, which is not rendered: it is left out"))
            }),
            // Of nothing.
            "ps" | "aniso" if words(rest).all(|word| text::number(word) == Some(0.0)) => return true,
            // The shape of what `aniso` asks for.
            "anisor" => {}
            "ps" | "aniso" | "map_pc" | "map_pcr" | "decal" | "refl" | "map_refl" | "map_aat" => {
                tally.push("statements not honoured yet", || {
                    line.warning(key, format!("`{key}` is not honoured yet: it is left out"))
                });
            }
            _ => tally.push("unknown statements", || {
                let warning = line.warning(key, format!("unknown statement `{key}`: it is left out"));
                match suggest_statement(key, FIRST, LAST) {
                    Some(help) => warning.help(help),
                    None => warning,
                }
            }),
        }
        false
    }

    /// Reads the value of a key; none where it is wrong, and what was given before counts.
    fn read_key(
        &mut self,
        key: &Key,
        line: &Line,
        word: &str,
        rest: &str,
        files: &mut MapFiles,
        tally: &mut Tally,
    ) -> Option<()> {
        let rest = if key.scene == "d" { without_halo(line, rest, tally) } else { rest };
        let material = &mut self.given;
        match key.value {
            Value::Colour(kind, at) => {
                let read = if kind == Colour::Reflectance { reflectance } else { colour };
                *at(material) = read(line, word, rest, kind.most_in_mtl(), tally)?;
            }
            Value::Number(range, at) => *at(material) = scalar(line, word, rest, range.least, range.most, tally)?,
            Value::Optional(range, at) => {
                *at(material) = Some(scalar(line, word, rest, range.least, range.most, tally)?);
            }
            Value::Whole(most, at) => *at(material) = whole(line, word, rest, most, tally)?,
            Value::Map(used, at) => {
                *at(material) = Some(files.read(&Context { line, key: word, used }, rest, tally)?)
            }
            // MTL has none.
            Value::Switch(_) => return None,
        }
        Some(())
    }

    /// Where a key was given, by its name in scene files.
    fn place(&self, key: &str) -> Option<&Diagnostic> {
        self.places.get(key)
    }

    /// The colour of a key that was given.
    fn is_lit(&self, key: &str, colour: Vec3) -> bool {
        self.place(key).is_some() && colour != Vec3::ZERO
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// `illum` as it is written, whatever it is taken as.
    pub fn written_illum(&self) -> u32 {
        self.given.illum
    }

    /// `Tr`, where no `d` says what it means, and its place.
    pub fn tr_alone(&self) -> Option<(f32, &Diagnostic)> {
        self.tr.as_ref().filter(|_| self.place("d").is_none()).map(|(tr, place)| (*tr, place))
    }

    /// Where `illum` is given.
    pub fn illum_place(&self) -> Option<&Diagnostic> {
        self.place("illum")
    }

    /// The material these statements describe: what was given, but for what statements say together.
    pub fn material(&self, habits: Habits) -> MtlMaterial {
        let constant = habits.glass_is_constant && self.given.asks_for_glass();
        let mut material = MtlMaterial {
            kd: if self.place("kd").is_some() { self.given.kd } else { self.missing_kd() },
            ke: self.emission(),
            d: self.dissolve(habits),
            illum: if constant { HIGHLIGHTS } else { self.given.illum },
            ..self.given.clone()
        };
        if material.maps.bump.is_none() {
            material.maps.bump = self.disp.as_ref().map(|(map, _)| map.clone());
        }
        material.mark_alone(|key| self.is_given(key));
        material
    }

    /// Whether a statement says the number of a key.
    fn is_given(&self, key: &str) -> bool {
        let other = match key {
            "ke" => self.le.is_some(),
            "d" => self.tr.is_some(),
            _ => false,
        };
        other || self.place(key).is_some()
    }

    /// `Kd` where neither it nor a map is given.
    fn missing_kd(&self) -> Vec3 {
        if self.is_bare() { MtlMaterial::default().kd } else { Vec3::ZERO }
    }

    /// Whether nothing says which light it sends back.
    fn is_bare(&self) -> bool {
        let said = ["kd", "ks", "ke", "map_kd", "map_ks", "map_ke"];
        said.iter().all(|key| self.place(key).is_none()) && self.le.is_none()
    }

    /// Whether the name says that it is a light, as in the Cornell box family of files.
    fn is_named_light(&self) -> bool {
        self.name.ends_with("_light")
    }

    /// `Ke` and `Le`, 0 where they are not given; the one that counts first.
    fn glows(&self) -> (Vec3, Vec3) {
        let (ke, le) = (self.given.ke, self.le.as_ref().map_or(Vec3::ZERO, |(colour, _)| *colour));
        if self.is_named_light() { (le, ke) } else { (ke, le) }
    }

    /// Whether `Le` is what it emits.
    pub fn counts_le(&self) -> bool {
        let (ke, le) = (self.given.ke, self.le.as_ref().map_or(Vec3::ZERO, |(colour, _)| *colour));
        le != Vec3::ZERO && (self.is_named_light() || ke == Vec3::ZERO)
    }

    /// `Ke` or `Le`: where both glow, `Le` counts in a material named `*_light`, else `Ke`.
    fn emission(&self) -> Vec3 {
        let (first, second) = self.glows();
        if first == Vec3::ZERO { second } else { first }
    }

    /// `d`, where it is given.
    fn given_dissolve(&self) -> Option<f32> {
        self.place("d").map(|_| self.given.d)
    }

    /// `d`, else 1 - `Tr`, else opaque. Where `Tr` is opacity, one of 0 was not meant to hide the material.
    fn dissolve(&self, habits: Habits) -> f32 {
        match (self.given_dissolve(), &self.tr) {
            (Some(d), _) => d,
            (None, Some((tr, _))) if habits.tr_is_opacity && *tr > 0.0 => *tr,
            (None, Some((tr, _))) if !habits.tr_is_opacity => 1.0 - tr,
            _ => 1.0,
        }
    }
}

/// The value of `d -halo 0.5`, whose halo is not honoured.
fn without_halo<'a>(line: &Line, rest: &'a str, tally: &mut Tally) -> &'a str {
    let Some(value) = rest.strip_prefix("-halo") else { return rest };
    tally.push("halos", || line.warning(rest, "`-halo` is not honoured: the whole surface gets this `d`"));
    value
}

/// Keeps a new value with its place, if there is one. Whether there is.
fn replace<T>(slot: &mut Option<(T, Diagnostic)>, value: Option<T>, place: impl FnOnce() -> Diagnostic) -> bool {
    let given = value.is_some();
    if let Some(value) = value {
        *slot = Some((value, place()));
    }
    given
}
