//! What a material asks for and does not get.

use glam::Vec3;

use super::{Draft, Habits};
use crate::components::Lobe;
use crate::scene::diagnostic::{Diagnostic, Tally};
use crate::scene::keys::Key;
use crate::scene::mtl::material::MtlMaterial;

/// A reflectance of the specular lobe that hides much of the diffuse lobe's texture.
const VEIL: f32 = 0.25;

impl Draft {
    /// Warns of what can't be rendered as written; `material` is what it came to.
    pub fn warn_of(&self, material: &MtlMaterial, habits: Habits, tally: &mut Tally) {
        let glass = material.is_glass();
        if self.is_bare() && !glass {
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
        self.warn_of_maps(material, tally);
        self.warn_of_veil(material, tally);
    }

    fn warn_of_emission(&self, tally: &mut Tally) {
        let (first, second) = self.glows();
        let dark = first == Vec3::ZERO && second == Vec3::ZERO && self.given.maps.ke.is_none();
        if self.is_named_light() && dark {
            self.warn(
                tally,
                &self.place,
                "lights without emission",
                "is named a light, but emits nothing: give it `Ke` or `Le`",
            );
        }
        if first != Vec3::ZERO && second != Vec3::ZERO && first != second {
            let le_place = self.le.as_ref().map(|(_, place)| place);
            let (used, unused, place) =
                if self.is_named_light() { ("Le", "Ke", self.place("ke")) } else { ("Ke", "Le", le_place) };
            if let Some(place) = place {
                let message = format!("has both `{used}` and `{unused}`: only `{used}` counts");
                self.warn(tally, place, "emission given twice", &message);
            }
        }
    }

    fn warn_of_dissolve(&self, habits: Habits, tally: &mut Tally) {
        match (self.given_dissolve(), &self.tr) {
            (Some(d), Some((tr, place))) if (1.0 - tr - d).abs() > 1e-4 => {
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
        let maps = &self.given.maps;
        let kd = maps.kd.is_some() || self.is_lit("kd", self.given.kd);
        let ks = maps.ks.is_some() || self.is_lit("ks", self.given.ks);
        let illum = self.given.illum;
        let message = match illum {
            _ if glass && (kd || ks || self.given.pc > 0.0) => {
                format!(
                    "is glass (illum {illum}), which has no colour of its own and no coat: `Kd`, `Ks` and `Pc` are not rendered"
                )
            }
            10 => "asks for an invisible shadow catcher (illum 10): it is rendered as a surface for now".to_owned(),
            0 | 1 if ks => format!("has `illum {illum}`, which is without highlights, and yet `Ks`: `Ks` is rendered"),
            _ => String::new(),
        };
        if let Some(place) = self.illum_place().filter(|_| !message.is_empty()) {
            self.warn(tally, place, "illumination models", &message);
        }
    }

    /// Warns of maps that count otherwise than they are written.
    fn warn_of_maps(&self, material: &MtlMaterial, tally: &mut Tally) {
        let maps = &material.maps;
        let numbers =
            [("kd", &maps.kd), ("ks", &maps.ks), ("ke", &maps.ke), ("pr", &maps.pr), ("pm", &maps.pm), ("d", &maps.d)];
        for (key, map) in numbers {
            if let (Some(place), true) = (self.place(key), map.as_ref().is_some_and(|map| map.alone)) {
                let key = Key::of_statement(key).and_then(|key| key.mtl).unwrap_or(key);
                let message = format!(
                    "has `{key}` 0 beside its map, as some programs write: the map counts alone, in this whole library"
                );
                self.warn_once(tally, place, "zeros beside maps", &message);
            }
        }
        if let Some((_, place)) = &self.disp {
            let message = if self.given.maps.bump.is_some() {
                "has both `bump` and `disp`: only `bump` counts"
            } else {
                "has displacement, which is rendered as bump: no surface is moved, in this whole library"
            };
            self.warn_once(tally, place, "displacement", message);
        }
        if let (Some(place), true) = (self.place("bump"), maps.norm.is_some()) {
            self.warn(tally, place, "relief given twice", "has both `norm` and `bump`: only `norm` counts");
        }
    }

    /// Warns where a surface sends much light back past its texture, which a program that draws highlights alone never shows.
    fn warn_of_veil(&self, material: &MtlMaterial, tally: &mut Tally) {
        let maps = &material.maps;
        let meant = maps.ks.is_some() || material.lobe() == Lobe::Mirror || material.is_glass();
        let least = material.ks.min_element();
        if let (Some(place), true) = (self.place("ks"), maps.kd.is_some() && !meant && least >= VEIL) {
            let wide = if self.place("ns").is_some() && material.ns < 1.0 && material.pr.is_none() {
                format!(", and so widely by `Ns {}` that it is noisy", material.ns)
            } else {
                String::new()
            };
            let message = format!(
                "material `{}` has a `Ks` of {least} beside `map_Kd`: it reflects that part of all light, not of lamps alone, as a veil over \
                 the texture{wide}; programs write such numbers for highlights (told once for this library)",
                self.name
            );
            let help = "a plain surface reflects about 0.04: lower `Ks` here, or `ks` in the scene file's `materials`";
            tally.once("veils", || Diagnostic { message, ..place.clone() }.help(help));
        }
    }

    /// A warning about this material at a place, of a kind of which the first is enough.
    fn warn_once(&self, tally: &mut Tally, place: &Diagnostic, kind: &'static str, message: &str) {
        tally.once(kind, || Diagnostic { message: format!("material `{}` {message}", self.name), ..place.clone() });
    }

    /// A warning about this material at a place.
    fn warn(&self, tally: &mut Tally, place: &Diagnostic, kind: &'static str, message: &str) {
        tally.push(kind, || Diagnostic { message: format!("material `{}` {message}", self.name), ..place.clone() });
    }
}
