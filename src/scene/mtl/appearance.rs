//! Materials in words: what each is rendered as, and the numbers that make it so.

use glam::Vec3;

use super::MtlMaterial;
use crate::components::{Lobe, Passage};

/// A material in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Appearance {
    /// `diffuse`, `glossy`, `metal`, `mirror`, `glass`, `see-through`, `light`, `black` or `invisible`.
    pub kind: &'static str,
    /// The numbers that make it so.
    pub reason: String,
}

impl MtlMaterial {
    /// What it looks like, and why.
    pub fn appearance(&self) -> Appearance {
        let passage = self.passage();
        let (kind, mut reason) = if self.ke != Vec3::ZERO {
            ("light", format!("Ke {}", triple(self.ke)))
        } else {
            match passage {
                Passage::Glass(_) => ("glass", self.why_glass()),
                Passage::SeeThrough(_) if self.material().is_invisible() => {
                    ("invisible", format!("d {}", short(self.d)))
                }
                Passage::SeeThrough(_) => ("see-through", format!("d {}, {}", short(self.d), self.reflects().1)),
                Passage::Opaque => self.reflects(),
            }
        };
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

    /// The kind of its reflection, and what makes it that.
    fn reflects(&self) -> (&'static str, String) {
        let kd = format!("Kd {}", triple(self.kd));
        let metallic = self.pm > 0.0 && self.kd != Vec3::ZERO;
        if self.ks == Vec3::ZERO && !metallic {
            return if self.kd == Vec3::ZERO { ("black", kd) } else { ("diffuse", kd) };
        }
        let ks = format!("{kd}, Ks {}", triple(self.ks));
        let metal = if metallic { format!(", Pm {}", short(self.pm)) } else { String::new() };
        match self.lobe() {
            Lobe::Mirror => ("mirror", format!("illum {}, Ks {}{metal}", self.illum, triple(self.ks))),
            Lobe::Ggx(roughness) => {
                let kind = if self.pm > 0.5 { "metal" } else { "glossy" };
                (kind, format!("{ks}, Pr {}{metal}", short(roughness)))
            }
            Lobe::Phong(exponent) => ("glossy", format!("{ks}, Ns {}{metal}", short(exponent))),
        }
    }
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
