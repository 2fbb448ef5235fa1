//! A material while its statements are read, and what they come to in the end.

use std::path::Path;

use glam::Vec3;

use super::exporter::Habits;
use super::maps;
use super::values::{BRIGHTEST, colour, reflectance, scalar};
use crate::components::{Material, Passage, TextureMaps};
use crate::scene::diagnostic::{Diagnostic, Tally};
use crate::scene::lines::{Line, words};
use crate::scene::suggest::did_you_mean;

/// Greatest exponent of the Phong lobe.
const SHARPEST: f32 = 1e5;

/// Statements we know, for suggestions.
const KNOWN: &[&str] = &[
    "newmtl",
    "Ka",
    "Kd",
    "Ks",
    "Ke",
    "Le",
    "Ns",
    "Ni",
    "d",
    "Tr",
    "Tf",
    "illum",
    "map_Ka",
    "map_Kd",
    "map_Ks",
    "map_Ns",
    "map_Ke",
    "map_d",
    "map_Bump",
    "bump",
    "Pr",
    "Pm",
    "norm",
    "disp",
    "decal",
    "refl",
    "sharpness",
];

/// One material so far: what was given, each with the statement's place (a warning that lacks its message).
#[derive(Debug)]
pub struct Draft {
    name: String,
    place: Diagnostic,
    kd: Option<Vec3>,
    ks: Option<Vec3>,
    ns: Option<f32>,
    ke: Option<(Vec3, Diagnostic)>,
    le: Option<(Vec3, Diagnostic)>,
    pr: Option<f32>,
    pm: Option<f32>,
    ni: Option<f32>,
    d: Option<(f32, Diagnostic)>,
    tr: Option<(f32, Diagnostic)>,
    tf: Option<(Vec3, Diagnostic)>,
    illum: Option<(u32, Diagnostic)>,
    maps: TextureMaps,
    map: Option<Diagnostic>,
}

impl Draft {
    /// A material without statements; `key` is its `newmtl`.
    pub fn new(name: &str, line: &Line, key: &str) -> Self {
        Self {
            name: name.to_owned(),
            place: line.warning(key, ""),
            kd: None,
            ks: None,
            ns: None,
            ke: None,
            le: None,
            pr: None,
            pm: None,
            ni: None,
            d: None,
            tr: None,
            tf: None,
            illum: None,
            maps: TextureMaps::default(),
            map: None,
        }
    }

    /// Takes one statement.
    pub fn read(&mut self, line: &Line, key: &str, rest: &str, folder: &Path, tally: &mut Tally) {
        let place = || line.warning(key, "");
        match key.to_ascii_lowercase().as_str() {
            "kd" => self.kd = reflectance(line, key, rest, tally).or(self.kd),
            "ks" => self.ks = reflectance(line, key, rest, tally).or(self.ks),
            "ns" => self.ns = scalar(line, key, rest, 0.0, SHARPEST, tally).or(self.ns),
            "ke" => replace(&mut self.ke, colour(line, key, rest, BRIGHTEST, tally), place),
            "le" => replace(&mut self.le, colour(line, key, rest, BRIGHTEST, tally), place),
            "pr" => self.pr = scalar(line, key, rest, 0.0, 1.0, tally).or(self.pr),
            "pm" => self.pm = scalar(line, key, rest, 0.0, 1.0, tally).or(self.pm),
            "ni" => self.ni = scalar(line, key, rest, 1.0, 100.0, tally).or(self.ni),
            "d" => self.read_dissolve(line, key, rest, tally),
            "tr" => replace(&mut self.tr, scalar(line, key, rest, 0.0, 1.0, tally), place),
            "tf" => replace(&mut self.tf, colour(line, key, rest, 1.0, tally), place),
            "illum" => self.read_illum(line, key, rest, tally),
            "ka" | "map_ka" | "sharpness" => tally.once("ambient light", || {
                line.warning(key, format!("`{key}` has no meaning in path tracing; it is left out in this whole file"))
            }),
            "map_kd" | "map_ks" | "map_ns" | "map_ke" | "map_d" | "map_bump" | "bump" => {
                self.read_map(line, key, rest, folder, tally);
            }
            "ps" | "pc" | "pcr" | "aniso" | "anisor" | "norm" | "disp" | "decal" | "refl" | "map_pr" | "map_pm"
            | "map_ps" | "map_refl" | "map_aat" => {
                tally.push("statements not honoured yet", || {
                    line.warning(key, format!("`{key}` is not honoured yet: it is left out"))
                });
            }
            _ => tally.push("unknown statements", || {
                let warning = line.warning(key, format!("unknown statement `{key}`: it is left out"));
                match did_you_mean(key, KNOWN.iter().copied()) {
                    Some(help) => warning.help(help),
                    None => warning,
                }
            }),
        }
    }

    /// `d 0.5`, or `d -halo 0.5`, whose halo is not honoured.
    fn read_dissolve(&mut self, line: &Line, key: &str, rest: &str, tally: &mut Tally) {
        let halo = rest.strip_prefix("-halo");
        if halo.is_some() {
            tally.push("halos", || line.warning(rest, "`-halo` is not honoured: the whole surface gets this `d`"));
        }
        let value = scalar(line, key, halo.unwrap_or(rest), 0.0, 1.0, tally);
        replace(&mut self.d, value, || line.warning(key, ""));
    }

    /// A whole number from 0 to 10.
    fn read_illum(&mut self, line: &Line, key: &str, rest: &str, tally: &mut Tally) {
        let word = words(rest).next().unwrap_or_default();
        match word.parse::<u32>() {
            Ok(model) if model <= 10 => self.illum = Some((model, line.warning(key, ""))),
            _ => tally.push("illumination models", || {
                line.warning(key, format!("`illum` is a whole number from 0 to 10, not `{word}`: it is left out"))
            }),
        }
    }

    /// An image file.
    fn read_map(&mut self, line: &Line, key: &str, rest: &str, folder: &Path, tally: &mut Tally) {
        let Some(path) = maps::path(line, key, rest, folder, tally) else { return };
        let slot = match key.to_ascii_lowercase().as_str() {
            "map_kd" => &mut self.maps.kd,
            "map_ks" => &mut self.maps.ks,
            "map_ns" => &mut self.maps.ns,
            "map_ke" => &mut self.maps.ke,
            "map_d" => &mut self.maps.dissolve,
            _ => &mut self.maps.bump,
        };
        *slot = Some(path);
        self.map.get_or_insert_with(|| line.warning(key, ""));
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// `Tr`, where no `d` says what it means, and its place.
    pub fn tr_alone(&self) -> Option<(f32, &Diagnostic)> {
        self.tr.as_ref().filter(|_| self.d.is_none()).map(|(tr, place)| (*tr, place))
    }

    /// Where `illum` is given.
    pub fn illum_place(&self) -> Option<&Diagnostic> {
        self.illum.as_ref().map(|(_, place)| place)
    }

    /// The material these statements describe.
    pub fn material(&self, habits: Habits) -> Material {
        let default = Material::default();
        let missing_kd = match &self.maps.kd {
            // What a map is multiplied by.
            Some(_) => Vec3::ONE,
            None if self.is_bare() => default.kd,
            None => Vec3::ZERO,
        };
        let illum = match &self.illum {
            // A surface with highlights.
            Some((4 | 6 | 7 | 9, _)) if habits.glass_is_constant => 2,
            Some((illum, _)) => *illum,
            None => default.illum,
        };
        Material {
            kd: self.kd.unwrap_or(missing_kd),
            ks: self.ks.unwrap_or(Vec3::ZERO),
            ns: self.ns.unwrap_or(default.ns),
            roughness: self.pr,
            metallic: self.pm.unwrap_or(default.metallic),
            emission: self.emission(),
            one_sided: false,
            ni: self.ni.unwrap_or(default.ni),
            dissolve: self.dissolve(habits),
            tf: self.tf.as_ref().map_or(default.tf, |(tf, _)| *tf),
            illum,
            maps: self.maps.clone(),
        }
    }

    /// Warns of what can't be rendered as written; `material` is what it came to.
    pub fn warn_of(&self, material: &Material, habits: Habits, tally: &mut Tally) {
        let glass = material.passage() == Passage::Glass;
        if self.is_bare() && !glass && self.maps == TextureMaps::default() {
            self.warn(
                tally,
                &self.place,
                "materials without colour",
                "has neither Kd, Ks, Ke nor Le: it is rendered grey",
            );
        }
        self.warn_of_emission(tally);
        self.warn_of_dissolve(habits, tally);
        self.warn_of_unrendered(glass, tally);
    }

    /// Whether nothing says which light it sends back.
    fn is_bare(&self) -> bool {
        self.kd.is_none() && self.ks.is_none() && self.ke.is_none() && self.le.is_none()
    }

    /// Whether the name says that it is a light, as in the Cornell box family of files.
    fn is_named_light(&self) -> bool {
        self.name.ends_with("_light")
    }

    /// `Ke` and `Le`, 0 where they are not given; the one that counts first.
    fn glows(&self) -> (Vec3, Vec3) {
        let glow = |given: &Option<(Vec3, Diagnostic)>| given.as_ref().map_or(Vec3::ZERO, |(colour, _)| *colour);
        let (ke, le) = (glow(&self.ke), glow(&self.le));
        if self.is_named_light() { (le, ke) } else { (ke, le) }
    }

    /// `Ke` or `Le`: where both glow, `Le` counts in a material named `*_light`, else `Ke`.
    fn emission(&self) -> Vec3 {
        let (first, second) = self.glows();
        if first == Vec3::ZERO { second } else { first }
    }

    fn warn_of_emission(&self, tally: &mut Tally) {
        let (first, second) = self.glows();
        if self.is_named_light() && first == Vec3::ZERO && second == Vec3::ZERO {
            self.warn(
                tally,
                &self.place,
                "lights without emission",
                "is named a light, but emits nothing: give it `Ke` or `Le`",
            );
        }
        if first != Vec3::ZERO && second != Vec3::ZERO && first != second {
            let (used, unused, place) =
                if self.is_named_light() { ("Le", "Ke", &self.ke) } else { ("Ke", "Le", &self.le) };
            if let Some((_, place)) = place {
                let message = format!("has both `{used}` and `{unused}`: only `{used}` counts");
                self.warn(tally, place, "emission given twice", &message);
            }
        }
    }

    /// `d`, else 1 - `Tr`, else opaque. Where `Tr` is opacity, one of 0 was not meant to hide the material.
    fn dissolve(&self, habits: Habits) -> f32 {
        match (&self.d, &self.tr) {
            (Some((d, _)), _) => *d,
            (None, Some((tr, _))) if habits.tr_is_opacity && *tr > 0.0 => *tr,
            (None, Some((tr, _))) if !habits.tr_is_opacity => 1.0 - tr,
            _ => 1.0,
        }
    }

    fn warn_of_dissolve(&self, habits: Habits, tally: &mut Tally) {
        match (&self.d, &self.tr) {
            (Some((d, _)), Some((tr, place))) if (1.0 - tr - d).abs() > 1e-4 => {
                let message =
                    format!("has `Tr {tr}` beside `d {d}`: `d` counts, since exporters write `Tr` both ways round");
                self.warn(tally, place, "Tr beside d", &message);
            }
            (None, Some((tr, place))) if *tr > 0.0 && !habits.tr_is_opacity => {
                let message = format!("has `Tr {tr}` and no `d`: it is taken as `d {}`", 1.0 - tr);
                self.warn(tally, place, "Tr without d", &message);
            }
            _ => {}
        }
    }

    /// One warning for each thing that this material asks for and does not get.
    fn warn_of_unrendered(&self, glass: bool, tally: &mut Tally) {
        let lit = |colour: Option<Vec3>| colour.is_some_and(|colour| colour != Vec3::ZERO);
        let warning = match &self.illum {
            Some((model, place)) if glass && (lit(self.kd) || lit(self.ks)) => Some((
                place,
                format!("is glass (illum {model}), which has no colour of its own: `Kd` and `Ks` are not rendered"),
            )),
            Some((10, place)) => Some((
                place,
                "asks for an invisible shadow catcher (illum 10): it is rendered as a surface for now".to_owned(),
            )),
            Some((model @ (0 | 1), place)) if lit(self.ks) => Some((
                place,
                format!("has `illum {model}`, which is without highlights, and yet `Ks`: `Ks` is rendered"),
            )),
            _ => None,
        };
        if let Some((place, message)) = warning {
            self.warn(tally, place, "illumination models", &message);
        }
        if let Some(place) = &self.map {
            self.warn(tally, place, "textures", "has textures, which are not rendered yet: its plain colours are");
        }
    }

    /// A warning about this material at a place.
    fn warn(&self, tally: &mut Tally, place: &Diagnostic, kind: &'static str, message: &str) {
        tally.push(kind, || Diagnostic { message: format!("material `{}` {message}", self.name), ..place.clone() });
    }
}

/// Takes a new value with its place, if there is one.
fn replace<T>(slot: &mut Option<(T, Diagnostic)>, value: Option<T>, place: impl FnOnce() -> Diagnostic) {
    if let Some(value) = value {
        *slot = Some((value, place()));
    }
}
