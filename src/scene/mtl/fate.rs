//! What becomes of each statement of a material: whether what is rendered is what it says.

use glam::Vec3;

use super::ledger::{Account, Edited, Statement};
use super::material::MtlMaterial;
use super::texture_map::TextureMap;
use crate::components::{DiffuseMap, Energy, Lobe, Passage, Render};
use crate::scene::diagnostic::Diagnostic;

/// How a statement is rendered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// As it says.
    Honoured,
    /// Otherwise, but so that it counts.
    Approximated,
    /// Not at all.
    Ignored,
}

/// What becomes of a statement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// As it is written.
    pub statement: String,
    /// A warning about it, without its message.
    pub place: Diagnostic,
    pub fate: Fate,
    /// Empty where there is nothing to say.
    pub why: String,
}

/// A fate, and why.
type Judged = (Fate, String);

fn honoured(why: impl Into<String>) -> Judged {
    (Fate::Honoured, why.into())
}

fn approximated(why: impl Into<String>) -> Judged {
    (Fate::Approximated, why.into())
}

fn ignored(why: impl Into<String>) -> Judged {
    (Fate::Ignored, why.into())
}

/// Why glass has no use for a number.
const GLASS: &str = "glass reflects and refracts by `Ni` and `Tf` alone";

/// Why a number of the specular lobe is of no use.
const NO_LOBE: &str = "there is no specular lobe: `Ks` is 0, and so is `Pm`";

impl Account {
    /// What becomes of all statements. `material` is what is rendered, `edited` what a scene file changed of it.
    pub fn verdicts(&self, material: &MtlMaterial, edited: &Edited, render: &Render) -> Vec<Verdict> {
        let judge = Judge { account: self, material, edited, render };
        let verdict = |statement: &Statement| {
            let (fate, why) = judge.fate(statement);
            Verdict { statement: statement.text.clone(), place: statement.place.clone(), fate, why }
        };
        self.statements.iter().map(verdict).collect()
    }
}

struct Judge<'a> {
    account: &'a Account,
    material: &'a MtlMaterial,
    edited: &'a Edited,
    render: &'a Render,
}

impl Judge<'_> {
    fn fate(&self, statement: &Statement) -> Judged {
        let Statement { what, taken, said, superseded, .. } = statement;
        let said = || said.clone().unwrap_or_default();
        let Some(what) = what else {
            return if *taken { honoured("0: nothing to render") } else { ignored(self.unknown(statement)) };
        };
        if !taken {
            return ignored(said());
        }
        if let Some(line) = superseded {
            return ignored(format!("line {line} says it again, and counts"));
        }
        let field = match *what {
            "le" => "ke",
            "tr" => "d",
            "disp" => "bump",
            key => key,
        };
        if let Some(place) = self.edited.get(field) {
            let (file, line) = (place.file.display(), place.line);
            return ignored(format!("{file}:{line} gives another `{field}`"));
        }
        match (self.of(what), said()) {
            ((Fate::Honoured, _), said) if !said.is_empty() => approximated(said),
            ((Fate::Approximated, why), said) if !said.is_empty() => approximated(format!("{said}; {why}")),
            (judged, _) => judged,
        }
    }

    /// Why a statement that says nothing is left out.
    fn unknown(&self, statement: &Statement) -> String {
        let word = statement.text.split_whitespace().next().unwrap_or_default();
        match (&statement.said, word.to_ascii_lowercase().as_str()) {
            (_, "ka" | "map_ka" | "sharpness") => "it has no meaning in path tracing".to_owned(),
            (Some(said), _) => said.clone(),
            (None, _) => "what it is the shape of is not rendered".to_owned(),
        }
    }

    /// What becomes of a value that was read.
    fn of(&self, what: &str) -> Judged {
        let m = self.material;
        match what {
            "kd" | "map_kd" if m.is_glass() => ignored(GLASS),
            "ks" | "map_ks" | "pm" | "map_pm" | "pc" | "pcr" | "d" | "tr" if m.is_glass() => ignored(GLASS),
            "kd" if self.replaces() => ignored("`map_Kd` stands for it (`texture: Replace`)"),
            "kd" => self.reflectance(&m.maps.kd),
            "ks" => self.reflectance(&m.maps.ks),
            "ke" | "le" => self.emission(what),
            "ns" | "map_ns" => self.exponent(what),
            "pr" | "map_pr" => self.lobe_needs(what),
            "pcr" if m.pc == 0.0 => ignored("there is no coat: `Pc` is 0"),
            "pm" if m.kd == Vec3::ZERO => ignored("there is no `Kd` that could move to the specular lobe"),
            "ni" if !m.is_glass() => ignored(format!("only glass refracts, and this is {}", m.appearance().kind)),
            "tf" if m.passage() == Passage::Opaque => ignored("nothing passes through what is opaque"),
            "tr" => self.transparency(),
            "illum" => self.illumination(),
            "bump" if m.maps.norm.is_some() => ignored("`norm` counts"),
            "disp" if self.account.says("bump") || m.maps.norm.is_some() => ignored("`norm` or `bump` counts"),
            "disp" => approximated("rendered as bump: no surface is moved"),
            _ => self.map(what),
        }
    }

    /// Whether the diffuse texture takes the place of `Kd`.
    fn replaces(&self) -> bool {
        self.render.diffuse_map == DiffuseMap::Replace && self.material.maps.kd.as_ref().is_some_and(|map| !map.off)
    }

    /// Of `Kd` and `Ks`, with their map.
    fn reflectance(&self, map: &Option<TextureMap>) -> Judged {
        let sum = self.material.energy();
        if map.as_ref().is_some_and(|map| map.alone) {
            approximated("0 beside its map: the map counts alone")
        } else if self.render.energy == Energy::Preserve && sum > 1.0 {
            approximated(format!("divided by {}: `Kd` + `Ks` is above 1 (`energy: Preserve`)", short(sum)))
        } else {
            honoured("")
        }
    }

    fn emission(&self, what: &str) -> Judged {
        let m = self.material;
        let both = self.account.says("ke") && self.account.says("le");
        let counts = if self.account.counts_le { "le" } else { "ke" };
        match what {
            _ if both && what != counts => ignored("the other of `Ke` and `Le` counts"),
            _ if m.maps.ke.as_ref().is_some_and(|map| map.alone) => {
                approximated("0 beside its map: the map counts alone")
            }
            "le" => honoured("as `Ke`"),
            _ => honoured(""),
        }
    }

    /// Of what shapes a Phong lobe.
    fn exponent(&self, what: &str) -> Judged {
        match self.material.lobe() {
            _ if self.material.is_glass() => ignored(GLASS),
            Lobe::Ggx(_) => ignored("the lobe is GGX, by `Pr`"),
            Lobe::Mirror => ignored("a mirror has no exponent"),
            Lobe::Phong(_) => self.lobe_needs(what),
        }
    }

    /// Of what shapes the specular lobe, where there is one.
    fn lobe_needs(&self, what: &str) -> Judged {
        let m = self.material;
        let shiny = m.ks != Vec3::ZERO || m.pm > 0.0 && m.kd != Vec3::ZERO;
        match shiny {
            _ if m.is_glass() => ignored(GLASS),
            false => ignored(NO_LOBE),
            true => self.map(what),
        }
    }

    fn transparency(&self) -> Judged {
        let d = short(self.material.d);
        match self.account.habits.tr_is_opacity {
            _ if self.account.says("d") => ignored("`d` counts"),
            true => approximated(format!("taken as opacity, as `d {d}`")),
            false => honoured(format!("as `d {d}`")),
        }
    }

    fn illumination(&self) -> Judged {
        let (m, illum) = (self.material, self.account.illum);
        match illum {
            4 | 6 | 7 | 9 if m.is_glass() => honoured("glass, by Fresnel's equations"),
            4 | 6 | 7 | 9 if self.account.habits.glass_is_constant => {
                ignored("an exporter's constant: it is on the whole library")
            }
            4 | 6 | 7 | 9 => ignored("alone makes no glass: `Ni` is 1, and `Tf` filters nothing"),
            3 | 5 | 8 => match m.lobe() {
                Lobe::Ggx(_) => ignored("the lobe is GGX, by `Pr`"),
                _ if m.is_glass() => ignored(GLASS),
                _ if m.ks == Vec3::ZERO && m.pm == 0.0 => ignored(NO_LOBE),
                _ if illum == 5 => approximated("a mirror of one reflectance, `Ks`, at every angle"),
                _ => honoured("a mirror"),
            },
            10 => approximated("a shadow catcher: rendered as a surface"),
            0 | 1 if m.ks != Vec3::ZERO && !m.is_glass() => {
                approximated("it is without highlights, and `Ks` is rendered")
            }
            _ => honoured(""),
        }
    }

    /// Of a map: whether its picture is there. All else is as it says.
    fn map(&self, what: &str) -> Judged {
        let maps = &self.material.maps;
        let map = match what {
            "map_kd" => &maps.kd,
            "map_ks" => &maps.ks,
            "map_ns" => &maps.ns,
            "map_ke" => &maps.ke,
            "map_d" => &maps.d,
            "map_pr" => &maps.pr,
            "map_pm" => &maps.pm,
            "norm" => &maps.norm,
            "bump" => &maps.bump,
            _ => return honoured(""),
        };
        match map {
            Some(map) if !map.file.is_file() => ignored(format!("there is no file `{}`", map.file.display())),
            _ => honoured(""),
        }
    }
}

impl MtlMaterial {
    /// The largest channel of what both lobes reflect together, before the energy policy; 0 of glass, which has neither.
    pub fn energy(&self) -> f32 {
        if self.is_glass() { 0.0 } else { (self.kd + self.ks).max_element() }
    }
}

/// A number to three places.
fn short(value: f32) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
