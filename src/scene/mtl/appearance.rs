//! Materials in words: what each is rendered as, and the numbers that make it so.

use glam::Vec3;

use super::material::MtlMaterial;
use super::texture_map::TextureMap;
use crate::components::{Lobe, Passage};
use crate::scene::printable::printable_name;

/// A material in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Appearance {
    /// `diffuse`, `glossy`, `metal`, `mirror`, `coated`, `glass`, `pane`, `see-through`, `light`, `black` or `invisible`.
    pub kind: &'static str,
    /// The numbers that make it so.
    pub reason: String,
}

impl MtlMaterial {
    /// What it looks like, and why.
    pub fn appearance(&self) -> Appearance {
        let passage = self.passage();
        let (kind, mut reason) = if self.ke != Vec3::ZERO {
            ("light", format!("Ke {}{}", triple(self.ke), times(&self.maps.ke)))
        } else {
            match passage {
                Passage::Glass(_) => ("glass", self.why_glass()),
                Passage::Pane(_) => ("pane", format!("{}, thin", self.why_glass())),
                Passage::SeeThrough(_) if self.material().is_invisible() => {
                    ("invisible", format!("d {}", short(self.d)))
                }
                Passage::SeeThrough(_) => ("see-through", format!("{}, {}", self.dissolve(), self.reflects().1)),
                Passage::Opaque if is_on(&self.maps.d) => {
                    let (kind, reason) = self.reflects();
                    (kind, format!("{}, {reason}", self.dissolve()))
                }
                Passage::Opaque => self.reflects(),
            }
        };
        // One of them counts.
        for (word, map) in [("norm", &self.maps.norm), ("bump", &self.maps.bump)] {
            if let Some(map) = map.as_ref().filter(|map| !map.off) {
                reason += &format!(", {word} {}", file(map));
                break;
            }
        }
        if self.asks_for_glass() && !self.is_glass() {
            let (ni, d) = (short(self.ni), short(self.d));
            reason += &format!("; illum {} alone makes no glass (Ni {ni}, Tf {}, d {d})", self.illum, triple(self.tf));
        }
        Appearance { kind, reason }
    }

    /// What makes it glass.
    fn why_glass(&self) -> String {
        let index = self.bends().then(|| format!(", Ni {}", short(self.ni)));
        let filter = self.filters().then(|| format!(", Tf {}", triple(self.tf)));
        format!("illum {}{}{}", self.illum, index.unwrap_or_default(), filter.unwrap_or_default())
    }

    fn dissolve(&self) -> String {
        format!("d {}{}", short(self.d), times(&self.maps.d))
    }

    /// The kind of its reflection, and what makes it that. A metal or a mirror is one under a coat too.
    fn reflects(&self) -> (&'static str, String) {
        let (kind, reason) = self.base();
        match self.pc > 0.0 {
            true if matches!(kind, "metal" | "mirror") => (kind, format!("{reason}, {}", self.coat())),
            true => ("coated", format!("{reason}, {}", self.coat())),
            false => (kind, reason),
        }
    }

    fn coat(&self) -> String {
        format!("Pc {}, Pcr {}", short(self.pc), short(self.pcr))
    }

    /// The same of what is below a coat.
    fn base(&self) -> (&'static str, String) {
        let kd = format!("Kd {}{}", triple(self.kd), times(&self.maps.kd));
        let metallic = self.pm > 0.0 && self.kd != Vec3::ZERO;
        if self.ks == Vec3::ZERO && !metallic {
            return if self.kd == Vec3::ZERO { ("black", kd) } else { ("diffuse", kd) };
        }
        let specular = format!("Ks {}{}", triple(self.ks), times(&self.maps.ks));
        let ks = format!("{kd}, {specular}");
        let metal = format!(", Pm {}{}", short(self.pm), times(&self.maps.pm));
        let metal = if metallic { metal } else { String::new() };
        match self.lobe() {
            Lobe::Mirror => ("mirror", format!("illum {}, {specular}{metal}", self.illum)),
            Lobe::Ggx(roughness) => {
                let kind = if self.pm > 0.5 { "metal" } else { "glossy" };
                (kind, format!("{ks}, Pr {}{}{metal}", short(roughness), times(&self.maps.pr)))
            }
            Lobe::Phong(exponent) => ("glossy", format!("{ks}, Ns {}{}{metal}", short(exponent), times(&self.maps.ns))),
        }
    }
}

/// ` x wood.png`, where there is a map that is on.
fn times(map: &Option<TextureMap>) -> String {
    map.as_ref().filter(|map| !map.off).map_or_else(String::new, |map| format!(" x {}", file(map)))
}

fn is_on(map: &Option<TextureMap>) -> bool {
    map.as_ref().is_some_and(|map| !map.off)
}

/// A map's file, without its folder.
fn file(map: &TextureMap) -> String {
    let name = map.file.file_name().unwrap_or(map.file.as_os_str());
    printable_name(&name.to_string_lossy())
}

/// A number to three places.
fn short(value: f32) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "0" && value != 0.0 { format!("{value:.1e}") } else { text.to_owned() }
}

/// A colour's three numbers.
fn triple(colour: Vec3) -> String {
    colour.to_array().map(short).join(" ")
}
