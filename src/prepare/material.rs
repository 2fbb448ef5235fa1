//! Materials to records: the energy policy, and the choice between lobes.

use glam::Vec3;

use crate::components::{Energy, Lobe, Material, Passage};
use crate::layout::trace::{
    MATERIAL_DIELECTRIC, MATERIAL_GGX, MATERIAL_MIRROR, MATERIAL_ONE_SIDED, MATERIAL_THIN, MaterialRecord,
    SMOOTHEST_ALPHA, luminance,
};

/// Packs a material. What it has no use for is left at its default, so that materials of equal looks are equal records.
pub fn pack(material: &Material, energy: Energy) -> MaterialRecord {
    // The sum turns -0.0 into 0.0: the kernel tells negative numbers by their sign.
    let record = MaterialRecord {
        emission: material.emission + Vec3::ZERO,
        flags: if material.one_sided { MATERIAL_ONE_SIDED } else { 0 },
        tf: Vec3::ONE,
        ni: 1.0,
        ..MaterialRecord::default()
    };
    let tf = material.filter.clamp(Vec3::ZERO, Vec3::ONE) + Vec3::ZERO;
    match material.passage {
        Passage::Glass(index) => {
            MaterialRecord { tf, ni: index.max(1.0), flags: record.flags | MATERIAL_DIELECTRIC, ..record }
        }
        Passage::Pane(index) => {
            MaterialRecord { tf, ni: index.max(1.0), flags: record.flags | MATERIAL_THIN, ..record }
        }
        Passage::SeeThrough(opacity) if opacity < 1.0 => {
            let record = MaterialRecord { transparency: 1.0 - opacity.clamp(0.0, 1.0), tf, ..record };
            reflect(record, material, energy)
        }
        Passage::SeeThrough(_) | Passage::Opaque => reflect(record, material, energy),
    }
}

/// The record with its lobes of reflection.
fn reflect(mut record: MaterialRecord, material: &Material, energy: Energy) -> MaterialRecord {
    [record.kd, record.ks] = reflectances(material, energy);
    record.coat = material.coat.clamp(0.0, 1.0) + 0.0;
    let coat_alpha = material.coat_roughness * material.coat_roughness;
    if record.coat > 0.0 && coat_alpha >= SMOOTHEST_ALPHA {
        record.coat_alpha = coat_alpha.min(1.0);
    }
    let (diffuse, specular) = (luminance(record.kd), luminance(record.ks));
    if let Lobe::Phong(exponent) = material.lobe {
        record.ns = exponent.clamp(0.0, 1e5);
    }
    if specular <= 0.0 {
        return record;
    }
    record.specular_probability = specular / (diffuse + specular);
    match material.lobe {
        Lobe::Phong(_) => {}
        Lobe::Ggx(roughness) if roughness * roughness >= SMOOTHEST_ALPHA => {
            record.alpha = (roughness * roughness).min(1.0);
            record.flags |= MATERIAL_GGX;
        }
        Lobe::Ggx(_) | Lobe::Mirror => record.flags |= MATERIAL_MIRROR,
    }
    record
}

/// What the diffuse and the specular lobe reflect, after the energy policy.
fn reflectances(material: &Material, energy: Energy) -> [Vec3; 2] {
    let metallic = material.metallic.clamp(0.0, 1.0);
    let (kd, ks) = (material.diffuse * (1.0 - metallic), material.specular + material.diffuse * metallic);
    let scale = match energy {
        Energy::Preserve => (kd + ks).max_element().max(1.0),
        Energy::AsWritten => 1.0,
    };
    [kd / scale, ks / scale].map(|v| v + Vec3::ZERO)
}
