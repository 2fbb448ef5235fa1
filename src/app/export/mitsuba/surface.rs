//! Materials as Mitsuba's surfaces: as they are where a plugin says the same, else by the nearest, and told.

use glam::Vec3;

use super::note::{Notes, Weight};
use super::picture::{Pictures, mean_and_most};
use super::xml::Element;
use crate::components::{DiffuseMap, Energy, Lobe, Material, Passage, Texture};
use crate::image::SaveError;
use crate::scene::{MapUse, MtlMaterial, SceneDescription, TextureMap, texture_name};

/// Least alpha of a rough conductor, as the definition of `roughness` has it.
const LEAST_ALPHA: f32 = 1e-4;

/// The textures that a material looks up.
struct Found<'a> {
    diffuse: Option<&'a Texture>,
    specular: Option<&'a Texture>,
    lobe: Option<&'a Texture>,
    metallic: Option<&'a Texture>,
    emission: Option<&'a Texture>,
    opacity: Option<&'a Texture>,
    relief: Option<&'a Texture>,
}

impl<'a> Found<'a> {
    fn of(numbers: &MtlMaterial, scene: &'a SceneDescription) -> Self {
        let find = |map: &Option<TextureMap>, used| {
            let map = map.as_ref().filter(|map| !map.off)?;
            scene.textures.get(&texture_name(map, used))
        };
        let maps = &numbers.maps;
        let lobe = if matches!(numbers.lobe(), Lobe::Ggx(_)) { &maps.pr } else { &maps.ns };
        Self {
            diffuse: find(&maps.kd, MapUse::Colour),
            specular: find(&maps.ks, MapUse::Colour),
            lobe: find(lobe, MapUse::Number),
            metallic: find(&maps.pm, MapUse::Number),
            emission: find(&maps.ke, MapUse::Colour),
            opacity: find(&maps.d, MapUse::Number),
            relief: find(&maps.norm, MapUse::Normal).or_else(|| find(&maps.bump, MapUse::Bump)),
        }
    }
}

/// A reflectance: of one texture's texels, or one colour for all.
struct Paint<'a> {
    texture: Option<&'a Texture>,
    /// From a texel; from 1 without a texture.
    of: Box<dyn Fn(Vec3) -> Vec3 + 'a>,
    /// The greatest channel anywhere.
    most: f32,
}

impl<'a> Paint<'a> {
    fn new(texture: Option<&'a Texture>, of: impl Fn(Vec3) -> Vec3 + 'a) -> Self {
        let texel = texture.map_or(Vec3::ONE, |texture| mean_and_most(texture).1);
        let most = of(texel).max_element();
        Self { texture, of: Box::new(of), most }
    }

    /// As a parameter, divided by the part of a mixture that it has.
    fn element(&self, name: &str, part: f32, pictures: &mut Pictures) -> Result<Element, SaveError> {
        match self.texture {
            Some(texture) => pictures.texture(name, texture, &|texel| (self.of)(texel) / part),
            None => pictures.colour(name, (self.of)(Vec3::ONE) / part),
        }
    }
}

/// Writes materials.
pub struct Surfaces<'a> {
    pub scene: &'a SceneDescription,
    pub pictures: &'a mut Pictures,
    pub notes: &'a mut Notes,
}

impl Surfaces<'_> {
    /// The surface of a material, to be referred to by `id`.
    pub fn bsdf(&mut self, id: &str, name: &str, numbers: &MtlMaterial) -> Result<Element, SaveError> {
        let (material, found) = (numbers.material(), Found::of(numbers, self.scene));
        let element = match material.passage {
            Passage::Glass(index) => self.glass("dielectric", index, &material)?,
            Passage::Pane(index) => {
                if material.filter != Vec3::ONE {
                    let text = "light that a tinted pane sends to and fro within is filtered once in Mitsuba, and at each crossing in Lucerna";
                    self.notes.say_of(name, "tf", text.to_owned());
                }
                self.glass("thindielectric", index, &material)?
            }
            Passage::Opaque | Passage::SeeThrough(_) => self.reflecting(name, &material, &found)?,
        };
        // The attribute that others refer to comes first.
        Ok(element.attribute("id", id))
    }

    /// Radiance of a material, where it has any.
    pub fn radiance(&mut self, numbers: &MtlMaterial) -> Result<Option<Element>, SaveError> {
        let emission = numbers.ke;
        if emission == Vec3::ZERO {
            return Ok(None);
        }
        let radiance = match Found::of(numbers, self.scene).emission {
            Some(texture) => {
                Element::plugin("emitter", "area")
                    .with(self.pictures.texture("radiance", texture, &|texel| emission * texel)?)
            }
            None => Element::plugin("emitter", "area").rgb("radiance", emission),
        };
        Ok(Some(radiance))
    }

    fn glass(&mut self, plugin: &str, index: f32, material: &Material) -> Result<Element, SaveError> {
        let element = Element::plugin("bsdf", plugin).float("int_ior", index.into()).float("ext_ior", 1.0);
        Ok(element.with(self.pictures.colour("specular_transmittance", material.filter)?))
    }

    /// What reflects, with its relief, on both sides; and what it lets through.
    fn reflecting(&mut self, name: &str, material: &Material, found: &Found) -> Result<Element, SaveError> {
        let mut inner = self.mixture(name, material, found)?;
        if let Some(relief) = found.relief {
            self.notes.say(
                Weight::Slight,
                "maps of relief are written as directions about each triangle's own tangents; Lucerna's are MikkTSpace's, and its facets mirror what would run into them",
            );
            let map = self.pictures.texture("normalmap", relief, &|code| code)?;
            inner = Element::plugin("bsdf", "normalmap").with(map).with(inner);
        }
        let both_sides = Element::plugin("bsdf", "twosided").with(inner);
        let there = if let Passage::SeeThrough(opacity) = material.passage { opacity } else { 1.0 };
        if let Some(texture) = found.opacity {
            let map =
                self.pictures.texture("opacity", texture, &|texel| (there * texel).clamp(Vec3::ZERO, Vec3::ONE))?;
            return Ok(Element::plugin("bsdf", "mask").with(map).with(both_sides));
        }
        Ok(match material.passage {
            Passage::SeeThrough(opacity) if material.filter == Vec3::ONE => {
                Element::plugin("bsdf", "mask").float("opacity", opacity.into()).with(both_sides)
            }
            // A pane that bends nothing reflects nothing either: light goes straight on, filtered.
            Passage::SeeThrough(opacity) => Element::plugin("bsdf", "blendbsdf")
                .float("weight", (1.0 - opacity).into())
                .with(both_sides)
                .with(self.glass("thindielectric", 1.0, material)?),
            _ => both_sides,
        })
    }

    /// The lobes of a surface, on its front side.
    fn mixture(&mut self, name: &str, material: &Material, found: &Found) -> Result<Element, SaveError> {
        let [diffuse, specular] = self.paints(name, material, found);
        let (kd, ks) = (diffuse.most.max(0.0), specular.most.max(0.0));
        if material.coat > 0.0 {
            return self.coated(name, material, &diffuse, ks);
        }
        if ks == 0.0 {
            return self.diffuse(&diffuse, 1.0);
        }
        let part = ks / (kd + ks);
        let lobe = self.specular(name, material, found, &specular, part)?;
        if kd == 0.0 {
            return Ok(lobe);
        }
        let below = self.diffuse(&diffuse, 1.0 - part)?;
        Ok(Element::plugin("bsdf", "blendbsdf").float("weight", part.into()).with(below).with(lobe))
    }

    fn diffuse(&mut self, paint: &Paint, part: f32) -> Result<Element, SaveError> {
        Ok(Element::plugin("bsdf", "diffuse").with(paint.element("reflectance", part, self.pictures)?))
    }

    /// The reflectances of both lobes.
    fn paints<'b>(&mut self, name: &str, material: &Material, found: &Found<'b>) -> [Paint<'b>; 2] {
        let (energy, replaced) = (self.scene.render.energy, self.scene.render.diffuse_map == DiffuseMap::Replace);
        let kd = if replaced && found.diffuse.is_some() { Vec3::ONE } else { material.diffuse };
        let ks = material.specular;
        let metallic = match found.metallic {
            Some(texture) if material.metallic > 0.0 => {
                self.notes.say_of(name, "map_pm", "its map of metalness counts by its mean".to_owned());
                material.metallic * mean_and_most(texture).0.x
            }
            _ => material.metallic,
        };
        // Both lobes at once, of a texel of either map.
        let both = move |kd_texel: Vec3, ks_texel: Vec3| {
            let whole = kd * kd_texel;
            let (kd, ks) = (whole * (1.0 - metallic), ks * ks_texel + whole * metallic);
            let scale = match energy {
                Energy::Preserve => (kd + ks).max_element().max(1.0),
                Energy::AsWritten => 1.0,
            };
            [kd / scale, ks / scale]
        };
        match (found.diffuse, found.specular.filter(|_| ks != Vec3::ZERO)) {
            (Some(_), None) => {
                let map = found.diffuse;
                let lit = ks != Vec3::ZERO || metallic > 0.0;
                [
                    Paint::new(map, move |texel| both(texel, Vec3::ONE)[0]),
                    Paint::new(map.filter(|_| lit), move |texel| both(texel, Vec3::ONE)[1]),
                ]
            }
            (None, Some(map)) => [
                Paint::new(None, move |_| both(Vec3::ONE, Vec3::ONE)[0]),
                Paint::new(Some(map), move |texel| both(Vec3::ONE, texel)[1]),
            ],
            (Some(diffuse), Some(map)) => {
                let mean = mean_and_most(diffuse).0;
                if metallic > 0.0 {
                    self.notes.say_of(name, "pm", "its metal has the mean colour of its map".to_owned());
                }
                [
                    Paint::new(Some(diffuse), move |texel| both(texel, Vec3::ONE)[0]),
                    Paint::new(Some(map), move |texel| both(mean, texel)[1]),
                ]
            }
            (None, None) => [0, 1].map(|lobe| Paint::new(None, move |_| both(Vec3::ONE, Vec3::ONE)[lobe])),
        }
    }

    /// The specular lobe by the nearest plugin.
    fn specular(
        &mut self,
        name: &str,
        material: &Material,
        found: &Found,
        paint: &Paint,
        part: f32,
    ) -> Result<Element, SaveError> {
        let colour = paint.element("specular_reflectance", part, self.pictures)?;
        let (distribution, alpha): (_, Box<dyn Fn(f32) -> f32>) = match material.lobe {
            Lobe::Mirror => {
                return Ok(Element::plugin("bsdf", "conductor").string("material", "none").with(colour));
            }
            Lobe::Ggx(roughness) => {
                let text = format!(
                    "its GGX lobe (Pr {roughness}) is a `roughconductor`, whose microfacets shadow and mask each other as if the two had nothing to do with each other: a little darker where light grazes"
                );
                self.notes.say_of(name, "pr", text);
                ("ggx", Box::new(move |texel| (roughness * texel).min(1.0).powi(2).max(LEAST_ALPHA)))
            }
            Lobe::Phong(exponent) => {
                let text = format!(
                    "Mitsuba has no Phong lobe (Ns {exponent}): it is a `roughconductor` of Beckmann's microfacets, as wide about the mirror direction, which does not grow darker as Phong's does where light grazes"
                );
                self.notes.say_of(name, "ns", text);
                ("beckmann", Box::new(move |texel| (1.0 / (2.0 * exponent * texel + 1.0)).sqrt().max(LEAST_ALPHA)))
            }
        };
        let element = Element::plugin("bsdf", "roughconductor").string("material", "none");
        let element = element.string("distribution", distribution).with(colour);
        Ok(match found.lobe {
            Some(texture) => element.with(self.pictures.texture("alpha", texture, &|t| Vec3::splat(alpha(t.x)))?),
            None => element.float("alpha", alpha(1.0).into()),
        })
    }

    /// What is under a coat: varnish over a diffuse surface is a plastic; no plugin has a coat over anything else.
    fn coated(&mut self, name: &str, material: &Material, diffuse: &Paint, ks: f32) -> Result<Element, SaveError> {
        let alpha = material.coat_roughness.powi(2);
        let plugin = if alpha < LEAST_ALPHA { "plastic" } else { "roughplastic" };
        let lost = if ks > 0.0 { ", and what mirrors below it is left out" } else { "" };
        let text = format!("its coat (Pc {}, Pcr {}) is a `{plugin}`{lost}", material.coat, material.coat_roughness);
        self.notes.say_of(name, "pc", text);
        let element = Element::plugin("bsdf", plugin).float("int_ior", 1.5).float("ext_ior", 1.0);
        let element = if alpha < LEAST_ALPHA { element } else { element.float("alpha", alpha.into()) };
        let element = element.boolean("nonlinear", true);
        Ok(element.with(diffuse.element("diffuse_reflectance", 1.0, self.pictures)?))
    }
}
