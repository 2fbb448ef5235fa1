//! The maps of a material to what the kernel knows of them, and the record that they multiply.

use glam::Vec3;

use crate::components::{DiffuseMap, Energy, Lobe, Material, Passage};
use crate::layout::texture::{MAPS_PRESERVE, MaterialMaps};
use crate::layout::trace::{MATERIAL_GGX, MaterialRecord, SMOOTHEST_ALPHA, luminance};

/// The record of a material with textures, and the rest of what they multiply. `maps` has its textures, by the indices of their records
/// plus 1. What the energy policy and metalness do is done at each point, behind the lookups.
pub fn pack_maps(
    material: &Material,
    packed: MaterialRecord,
    mut maps: MaterialMaps,
    energy: Energy,
    replace: DiffuseMap,
) -> (MaterialRecord, MaterialMaps) {
    let mut record = packed;
    maps.coverage = 1.0;
    if let (Passage::SeeThrough(opacity), true) = (material.passage, maps.opacity != 0) {
        maps.coverage = opacity.clamp(0.0, 1.0);
        record.transparency = 0.0;
    }
    if matches!(material.passage, Passage::Glass(_) | Passage::Pane(_)) {
        // Glass has no colours, and one lobe.
        let none = MaterialMaps { diffuse: 0, specular: 0, lobe: 0, metallic: 0, ..maps };
        return (record, none);
    }
    if !maps.changes_lobes() {
        return (record, maps);
    }
    let replaces = replace == DiffuseMap::Replace && maps.diffuse != 0;
    record.kd = if replaces { Vec3::ONE } else { material.diffuse } + Vec3::ZERO;
    record.ks = material.specular + Vec3::ZERO;
    maps.metalness = material.metallic.clamp(0.0, 1.0);
    maps.flags = if energy == Energy::Preserve { MAPS_PRESERVE } else { 0 };
    // What the specular lobe may come to: that a texture leaves nothing of it is found at the point.
    let most = record.ks + maps.metalness * record.kd;
    record.specular_probability = luminance(most) / (luminance(most) + luminance(record.kd)).max(f32::MIN_POSITIVE);
    if let (Lobe::Ggx(roughness), true) = (material.lobe, record.specular_probability > 0.0) {
        let smooth = roughness * roughness < SMOOTHEST_ALPHA;
        if !smooth || maps.lobe != 0 {
            record.flags = packed.flags & !crate::layout::trace::MATERIAL_MIRROR | MATERIAL_GGX;
            record.alpha = (roughness * roughness).clamp(SMOOTHEST_ALPHA, 1.0);
        }
    }
    if let Lobe::Phong(exponent) = material.lobe {
        record.ns = exponent.clamp(0.0, 1e5);
    }
    (record, maps)
}
