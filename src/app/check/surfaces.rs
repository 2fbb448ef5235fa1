//! The surfaces that a check of shaders lints where there is no scene: one of every kind of lobe, alone or beside others.

use glam::Vec3;

use crate::components::{Energy, Lobe, Material, Passage};
use crate::layout::trace::MaterialRecord;
use crate::prepare::material::pack;

/// By names that say what they are.
pub fn surfaces() -> Vec<(String, MaterialRecord)> {
    let grey = |kd: f32, ks: f32| Material { diffuse: Vec3::splat(kd), specular: Vec3::splat(ks), ..Material::BLACK };
    let all = [
        ("diffuse", grey(0.9, 0.0)),
        ("Phong", Material { lobe: Lobe::Phong(100.0), ..grey(0.5, 0.4) }),
        ("GGX", Material { lobe: Lobe::Ggx(0.4), ..grey(0.0, 0.9) }),
        ("mirror", Material { lobe: Lobe::Mirror, ..grey(0.5, 0.5) }),
        ("rough coat", Material { coat: 0.9, coat_roughness: 0.3, lobe: Lobe::Ggx(0.5), ..grey(0.5, 0.4) }),
        ("see-through", Material { passage: Passage::SeeThrough(0.3), ..grey(0.8, 0.0) }),
        ("glass", Material { passage: Passage::Glass(1.5), ..grey(0.0, 0.0) }),
        ("pane", Material { passage: Passage::Pane(1.5), ..grey(0.0, 0.0) }),
    ];
    all.map(|(name, material)| (name.to_owned(), pack(&material, Energy::Preserve))).into()
}
