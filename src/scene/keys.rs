//! The one table of a material's keys: what MTL files, scene files, defines and the window's panel call a number, its range, and
//! where it is. docs/materials.md has the same table, by [`Key::row`].
//!
//! A new key is a row here, a field of the material, and its line in docs/materials.md.

use std::ops::RangeInclusive;

use glam::Vec3;

use super::mtl::{MtlMaterial, TextureMap};
use super::suggest::did_you_mean;
use super::textures::MapUse;

/// One number or map of a material.
#[derive(Debug)]
pub struct Key {
    /// Statement of MTL files, where they have one.
    pub mtl: Option<&'static str>,
    /// Field in a scene file, and last part of a define.
    pub scene: &'static str,
    pub value: Value,
    /// What it says, as docs/materials.md has it.
    pub doc: &'static str,
}

/// Where a material has a number: to read it, and to write it.
pub type Place<T> = fn(&mut MtlMaterial) -> &mut T;

/// What values a key has, and their place.
#[derive(Debug)]
pub enum Value {
    /// Linear Rec.709; one number is a grey.
    Colour(Colour, Place<Vec3>),
    Number(Range, Place<f32>),
    /// A number that a material may lack.
    Optional(Range, Place<Option<f32>>),
    Switch(Place<bool>),
    /// A whole number, 0 to a greatest.
    Whole(u32, Place<u32>),
    /// A picture, and what it is looked up for.
    Map(MapUse, Place<Option<TextureMap>>),
}

/// What a colour is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    Reflectance,
    Radiance,
    /// What light is multiplied by on its way through.
    Filter,
}

/// The values of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub least: f32,
    pub most: f32,
    /// Where the panel's slider begins and ends, and whether it goes by powers of ten.
    pub slider: [f32; 2],
    pub logarithmic: bool,
}

/// Greatest channel of an MTL colour: products along a path stay far within f32.
const BRIGHTEST: f32 = 1e6;

/// Other words for statements.
const ALIASES: &[(&str, &str)] = &[("bump", "map_Bump"), ("map_norm", "norm")];

const UNIT: Range = Range { least: 0.0, most: 1.0, slider: [0.0, 1.0], logarithmic: false };
const EXPONENT: Range = Range { least: 0.0, most: 1e5, slider: [1.0, 1e4], logarithmic: true };
const INDEX: Range = Range { least: 1.0, most: 100.0, slider: [1.0, 3.0], logarithmic: false };

/// All keys, in the order in which they are shown.
pub static KEYS: &[Key] = &[
    Key {
        mtl: Some("Kd"),
        scene: "kd",
        value: Value::Colour(Colour::Reflectance, |m| &mut m.kd),
        doc: "reflectance of the diffuse lobe; bytes (16 to 255) are told, and taken as written",
    },
    Key {
        mtl: Some("Ks"),
        scene: "ks",
        value: Value::Colour(Colour::Reflectance, |m| &mut m.ks),
        doc: "reflectance of the specular lobe, likewise",
    },
    Key {
        mtl: Some("Ns"),
        scene: "ns",
        value: Value::Number(EXPONENT, |m| &mut m.ns),
        doc: "exponent of the Phong lobe",
    },
    Key {
        mtl: Some("Pr"),
        scene: "pr",
        value: Value::Optional(UNIT, |m| &mut m.pr),
        doc: "roughness: the specular lobe is GGX instead",
    },
    Key {
        mtl: Some("Pm"),
        scene: "pm",
        value: Value::Number(UNIT, |m| &mut m.pm),
        doc: "metalness: this part of `Kd` moves to the specular lobe",
    },
    Key {
        mtl: Some("Pc"),
        scene: "pc",
        value: Value::Number(UNIT, |m| &mut m.pc),
        doc: "clear coat: a layer of index 1.5 over this part of the surface",
    },
    Key { mtl: Some("Pcr"), scene: "pcr", value: Value::Number(UNIT, |m| &mut m.pcr), doc: "roughness of the coat" },
    Key {
        mtl: Some("Ke"),
        scene: "ke",
        value: Value::Colour(Colour::Radiance, |m| &mut m.ke),
        doc: "emitted radiance, on both sides",
    },
    Key {
        mtl: None,
        scene: "one_sided",
        value: Value::Switch(|m| &mut m.one_sided),
        doc: "light leaves the front alone, by the winding",
    },
    Key {
        mtl: Some("Ni"),
        scene: "ni",
        value: Value::Number(INDEX, |m| &mut m.ni),
        doc: "index of refraction of glass; `Ni` alone makes none",
    },
    Key {
        mtl: None,
        scene: "thin",
        value: Value::Switch(|m| &mut m.thin),
        doc: "glass is a pane, both faces in one sheet: nothing is refracted",
    },
    Key { mtl: Some("d"), scene: "d", value: Value::Number(UNIT, |m| &mut m.d), doc: "opacity" },
    Key {
        mtl: Some("Tf"),
        scene: "tf",
        value: Value::Colour(Colour::Filter, |m| &mut m.tf),
        doc: "what passes through a surface is multiplied by, at each crossing",
    },
    Key {
        mtl: Some("illum"),
        scene: "illum",
        value: Value::Whole(10, |m| &mut m.illum),
        doc: "3, 5, 8: a mirror; 4, 6, 7, 9: glass, if the numbers say so too (below); 10 is not honoured; else nothing",
    },
    Key {
        mtl: Some("map_Kd"),
        scene: "map_kd",
        value: Value::Map(MapUse::Colour, |m| &mut m.maps.kd),
        doc: "texture that `Kd` is multiplied by, or that stands for it (`texture` of scene files)",
    },
    Key {
        mtl: Some("map_Ks"),
        scene: "map_ks",
        value: Value::Map(MapUse::Colour, |m| &mut m.maps.ks),
        doc: "texture that `Ks` is multiplied by",
    },
    Key {
        mtl: Some("map_Ns"),
        scene: "map_ns",
        value: Value::Map(MapUse::Number, |m| &mut m.maps.ns),
        doc: "texture that `Ns` is multiplied by, where there is no roughness",
    },
    Key {
        mtl: Some("map_Pr"),
        scene: "map_pr",
        value: Value::Map(MapUse::Number, |m| &mut m.maps.pr),
        doc: "texture that `Pr` is multiplied by",
    },
    Key {
        mtl: Some("map_Pm"),
        scene: "map_pm",
        value: Value::Map(MapUse::Number, |m| &mut m.maps.pm),
        doc: "texture that `Pm` is multiplied by",
    },
    Key {
        mtl: Some("map_Ke"),
        scene: "map_ke",
        value: Value::Map(MapUse::Colour, |m| &mut m.maps.ke),
        doc: "texture that `Ke` is multiplied by",
    },
    Key {
        mtl: Some("map_d"),
        scene: "map_d",
        value: Value::Map(MapUse::Number, |m| &mut m.maps.d),
        doc: "texture that `d` is multiplied by: what part of the surface is there",
    },
    Key {
        mtl: Some("norm"),
        scene: "norm",
        value: Value::Map(MapUse::Normal, |m| &mut m.maps.norm),
        doc: "texture of directions that bend the shading normal; `map_norm` too",
    },
    Key {
        mtl: Some("map_Bump"),
        scene: "bump",
        value: Value::Map(MapUse::Bump, |m| &mut m.maps.bump),
        doc: "texture of heights that bend the shading normal, or of directions; `bump` too, and without it `disp`, `map_Disp`",
    },
];

impl Key {
    /// The key of an MTL statement, in letters of any case.
    pub fn of_statement(word: &str) -> Option<&'static Self> {
        let word = ALIASES.iter().find(|(alias, _)| alias.eq_ignore_ascii_case(word)).map_or(word, |(_, mtl)| *mtl);
        KEYS.iter().find(|key| key.mtl.is_some_and(|mtl| mtl.eq_ignore_ascii_case(word)))
    }

    /// What the panel calls it.
    pub fn label(&self) -> String {
        self.mtl.map_or_else(|| self.scene.replace('_', " "), str::to_owned)
    }

    /// Writes one material's value over another's.
    pub fn copy(&self, from: &MtlMaterial, to: &mut MtlMaterial) {
        fn copy<T: Clone>(at: Place<T>, from: &mut MtlMaterial, to: &mut MtlMaterial) {
            *at(to) = at(from).clone();
        }
        let from = &mut from.clone();
        match self.value {
            Value::Colour(_, at) => copy(at, from, to),
            Value::Number(_, at) => copy(at, from, to),
            Value::Optional(_, at) => copy(at, from, to),
            Value::Switch(at) => copy(at, from, to),
            Value::Whole(_, at) => copy(at, from, to),
            Value::Map(_, at) => copy(at, from, to),
        }
    }

    /// Its line in docs/materials.md.
    pub fn row(&self) -> String {
        let mtl = self.mtl.map_or(String::new(), |mtl| format!("`{mtl}`"));
        format!("| {mtl} | `{}` | {} | {} |", self.scene, self.value.describe(), self.doc)
    }
}

impl Value {
    /// What values there are, in words.
    fn describe(&self) -> String {
        match self {
            Self::Colour(colour, _) if colour.most_in_mtl() != colour.most_in_scene() => {
                format!("colour, 0 to {}; in a scene file to {}", colour.most_in_mtl(), colour.most_in_scene())
            }
            Self::Colour(colour, _) => format!("colour, 0 to {}", colour.most_in_mtl()),
            Self::Number(range, _) => format!("{} to {}", range.least, range.most),
            Self::Optional(range, _) => format!("{} to {}, or `None`", range.least, range.most),
            Self::Switch(_) => "true or false".to_owned(),
            Self::Whole(most, _) => format!("0 to {most}, whole"),
            Self::Map(..) => "a file, with options; or `None`".to_owned(),
        }
    }
}

impl Colour {
    /// Greatest channel in MTL files: what is above is moved there, with a warning.
    pub fn most_in_mtl(self) -> f32 {
        if self == Self::Filter { 1.0 } else { BRIGHTEST }
    }

    /// Greatest channel in scene files and in the panel.
    pub fn most_in_scene(self) -> f32 {
        match self {
            Self::Reflectance => 1e3,
            Self::Radiance => BRIGHTEST,
            Self::Filter => 1.0,
        }
    }
}

impl Range {
    /// The values that the panel's slider reaches.
    pub fn of_slider(self) -> RangeInclusive<f32> {
        let [begin, end] = self.slider;
        begin..=end
    }
}

/// `did you mean `Kd`?`, by the statements that are keys and by others that are known.
pub fn suggest_statement(wrong: &str, first: &[&'static str], last: &[&'static str]) -> Option<String> {
    let keys = KEYS.iter().filter_map(|key| key.mtl);
    did_you_mean(wrong, first.iter().copied().chain(keys).chain(last.iter().copied()))
}
