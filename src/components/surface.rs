//! What a material's numbers make of its surface: the one place where `illum` decides how it is rendered.
//!
//! `illum` says how a program was to draw, and many write one number on everything: alone it makes no glass. What else a
//! material says decides.
//!
//! | `illum` | and | is |
//! |---|---|---|
//! | 4, 6, 7, 9 | `Ni` other than 1, or a `Tf` that is neither 1 1 1 nor 0 0 0 | glass |
//! | any other, or without that | `d` below 1 | see-through |
//! | any other, or without that | `d` 1 | opaque |

use glam::Vec3;

use super::Material;

/// How light gets through a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passage {
    /// Not at all.
    Opaque,
    /// `1 - dissolve` of it goes straight on.
    SeeThrough,
    /// It is refracted, or reflected, and the surface does nothing else.
    Glass,
}

/// The shape of the specular lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Specular {
    /// Of exponent `ns`.
    Phong,
    /// Of `roughness`.
    Ggx,
    Mirror,
}

/// A material in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Appearance {
    /// `diffuse`, `glossy`, `metal`, `mirror`, `glass`, `see-through`, `light`, `black` or `invisible`.
    pub kind: &'static str,
    /// The numbers that make it so.
    pub reason: String,
}

/// Indices within this of 1 bend nothing that could be seen.
const BENDS: f32 = 5e-4;

/// A filter within this of all or nothing says no more than they do.
const FILTERS: f32 = 5e-3;

/// A surface of which no more than this is there is not seen: it changes no picture of 8 bits.
const SEEN: f32 = 1e-3;

impl Material {
    /// How light gets through.
    pub fn passage(&self) -> Passage {
        if self.asks_for_glass() && (self.bends() || self.filters()) {
            Passage::Glass
        } else if self.dissolve < 1.0 {
            Passage::SeeThrough
        } else {
            Passage::Opaque
        }
    }

    /// The specular lobe, where `ks` or `metallic` gives the surface one.
    pub fn specular(&self) -> Specular {
        match (self.roughness, self.illum) {
            (Some(_), _) => Specular::Ggx,
            (None, 3 | 5 | 8) => Specular::Mirror,
            (None, _) => Specular::Phong,
        }
    }

    /// Whether `illum` is one of a transparent surface.
    pub fn asks_for_glass(&self) -> bool {
        matches!(self.illum, 4 | 6 | 7 | 9)
    }

    /// Whether rays go through it as if it were not there.
    pub fn is_invisible(&self) -> bool {
        let clear = self.tf.min_element() >= 1.0 - FILTERS;
        self.passage() == Passage::SeeThrough && self.dissolve <= SEEN && clear && self.emission == Vec3::ZERO
    }

    fn bends(&self) -> bool {
        (self.ni - 1.0).abs() > BENDS
    }

    fn filters(&self) -> bool {
        self.tf.min_element() < 1.0 - FILTERS && self.tf.max_element() > FILTERS
    }

    /// What it looks like, and why.
    pub fn appearance(&self) -> Appearance {
        let passage = self.passage();
        let (kind, mut reason) = if self.emission != Vec3::ZERO {
            ("light", format!("Ke {}", triple(self.emission)))
        } else {
            match passage {
                Passage::Glass => ("glass", self.why_glass()),
                Passage::SeeThrough if self.is_invisible() => ("invisible", format!("d {}", short(self.dissolve))),
                Passage::SeeThrough => ("see-through", format!("d {}, {}", short(self.dissolve), self.reflects().1)),
                Passage::Opaque => self.reflects(),
            }
        };
        if self.asks_for_glass() && passage != Passage::Glass {
            let (ni, d) = (short(self.ni), short(self.dissolve));
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
        let metallic = self.metallic > 0.0 && self.kd != Vec3::ZERO;
        if self.ks == Vec3::ZERO && !metallic {
            return if self.kd == Vec3::ZERO { ("black", kd) } else { ("diffuse", kd) };
        }
        let ks = format!("{kd}, Ks {}", triple(self.ks));
        let metal = if metallic { format!(", Pm {}", short(self.metallic)) } else { String::new() };
        match self.specular() {
            Specular::Mirror => ("mirror", format!("illum {}, Ks {}{metal}", self.illum, triple(self.ks))),
            Specular::Ggx => {
                let kind = if self.metallic > 0.5 { "metal" } else { "glossy" };
                (kind, format!("{ks}, Pr {}{metal}", short(self.roughness.unwrap_or_default())))
            }
            Specular::Phong => ("glossy", format!("{ks}, Ns {}{metal}", short(self.ns))),
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
