//! What an exporter writes on every material of a library says nothing about any of them.

use glam::Vec3;

use super::draft::{Draft, Habits};
use super::material::MtlMaterial;
use crate::scene::diagnostic::{Diagnostic, Tally};

/// Materials of one library that may well all be glass.
const FEW: usize = 3;

impl Habits {
    /// Judges the materials of one library.
    pub fn of(drafts: &[Draft]) -> Self {
        let read = |habits: Self| -> Vec<MtlMaterial> { drafts.iter().map(|draft| draft.material(habits)).collect() };
        let glass_is_constant = is_glass_constant(drafts, &read(Self::default()));
        let habits = Self { glass_is_constant, ..Self::default() };
        Self { tr_is_opacity: is_tr_opacity(drafts, &read(habits)), ..habits }
    }

    /// Says once for the library what it is read as, and which materials are less than their `illum` asks for.
    pub fn warn(self, drafts: &[Draft], materials: &[MtlMaterial], tally: &mut Tally) {
        let count = drafts.len();
        let mut say = |place: Option<&Diagnostic>, message: String, help: &str| {
            if let Some(place) = place {
                tally.push("habits of exporters", || Diagnostic { message, ..place.clone() }.help(help));
            }
        };
        if self.tr_is_opacity {
            let place = drafts.iter().find_map(|draft| draft.tr_alone().map(|(_, place)| place));
            let message =
                "`Tr` as transparency would hide most of this library, and programs write it both ways round: \
                           here it is taken as opacity, as `d` is"
                    .to_owned();
            say(place, message, "write `d`, which all programs read alike");
        }
        if self.glass_is_constant {
            let place = drafts.iter().find_map(Draft::illum_place);
            let message = format!(
                "one `illum`, one `Ni` and one `Tf` of glass are on all {count} materials of this library, of several colours: they are \
                 an exporter's constant, and make no glass"
            );
            say(place, message, "what is glass gets a `Tf` of its own, or an `illum` in the scene file's `materials`");
        }
        let lit = |material: &MtlMaterial| material.kd.max(material.ks).max_element() > 0.0;
        let opaque = |material: &MtlMaterial| material.asks_for_glass() && !material.is_glass();
        let mut alone = drafts
            .iter()
            .zip(materials)
            .filter(|(_, material)| opaque(material) && lit(material) && material.ke == Vec3::ZERO);
        if let Some((draft, material)) = alone.next() {
            let others = match alone.count() {
                0 => String::new(),
                more => format!("; nor of {more} more"),
            };
            let (name, illum, look) = (draft.name(), material.illum, material.appearance().kind);
            let message = format!("`illum {illum}` alone makes no glass of material `{name}`, which is {look}{others}");
            say(draft.illum_place(), message, "glass has an `Ni` other than 1, or a `Tf` of its own");
        }
    }
}

/// Whether most materials would not be seen; or some, where all have `Tr` alone and none would be hidden the other way round.
fn is_tr_opacity(drafts: &[Draft], materials: &[MtlMaterial]) -> bool {
    let alone = || drafts.iter().zip(materials).filter_map(|(draft, material)| Some((draft.tr_alone()?.0, material)));
    let hidden = alone().filter(|(_, material)| material.material().is_invisible()).count();
    let all = alone().count() == drafts.len() && alone().all(|(tr, _)| tr > 0.0);
    hidden > 0 && (2 * hidden > drafts.len() || all)
}

/// Whether all materials are glass by the same numbers, and yet have colours that differ, which glass has no use for.
fn is_glass_constant(drafts: &[Draft], materials: &[MtlMaterial]) -> bool {
    let Some((first, others)) = materials.split_first().filter(|(_, others)| others.len() + 1 >= FEW) else {
        return false;
    };
    let same = |other: &MtlMaterial| (other.illum, other.ni, other.tf) == (first.illum, first.ni, first.tf);
    let plain = |(draft, material): (&Draft, &MtlMaterial)| {
        let opaque = material.d >= 1.0 || draft.tr_alone().is_some_and(|(tr, _)| tr >= 1.0);
        material.is_glass() && opaque && material.kd.max_element() > 0.0
    };
    let coloured = others.iter().any(|other| (other.kd, &other.maps.kd) != (first.kd, &first.maps.kd));
    coloured && others.iter().all(same) && drafts.iter().zip(materials).all(plain)
}
