//! Materials to records.

use glam::Vec3;
use lucerna::components::{Energy, Lobe, Material, Passage};
use lucerna::layout::trace::{
    MATERIAL_DIELECTRIC, MATERIAL_GGX, MATERIAL_MIRROR, MATERIAL_ONE_SIDED, MaterialRecord, SMOOTHEST_ALPHA,
};
use lucerna::passes::trace::Needs;
use lucerna::prepare::material;

fn pack(values: Material) -> MaterialRecord {
    material::pack(&values, Energy::Preserve)
}

fn features(values: Material) -> Vec<&'static str> {
    Needs { materials: &[pack(values)], ..Needs::default() }.features()
}

fn grey(diffuse: f32, specular: f32) -> Material {
    Material {
        diffuse: Vec3::splat(diffuse),
        specular: Vec3::splat(specular),
        lobe: Lobe::Phong(10.0),
        ..Material::BLACK
    }
}

#[test]
fn what_a_material_lacks_is_not_compiled() {
    assert_eq!(features(grey(0.5, 0.0)), [""; 0]);
    assert_eq!(features(grey(0.5, 0.2)), ["phong"]);
    assert_eq!(features(Material { lobe: Lobe::Ggx(0.5), ..grey(0.5, 0.2) }), ["ggx"]);
    assert_eq!(features(Material { lobe: Lobe::Mirror, ..grey(0.5, 0.2) }), ["mirror"]);
    assert_eq!(features(Material { passage: Passage::SeeThrough(0.5), ..grey(0.5, 0.0) }), ["alpha"]);
    assert_eq!(features(Material { passage: Passage::Glass(1.0), ..grey(0.5, 0.2) }), ["dielectric"]);
    assert_eq!(features(Material { passage: Passage::Pane(1.5), ..grey(0.5, 0.2) }), ["thin"]);
    // No lobe, no code for it.
    assert_eq!(features(Material { lobe: Lobe::Ggx(0.5), ..grey(0.5, 0.0) }), [""; 0]);
    assert_eq!(features(Material { lobe: Lobe::Mirror, ..grey(0.5, 0.0) }), [""; 0]);
    // Nothing gets through what is opaque, whatever the filter.
    assert_eq!(pack(Material { filter: Vec3::ZERO, ..grey(0.5, 0.2) }), pack(grey(0.5, 0.2)));
    assert_eq!(pack(Material { passage: Passage::SeeThrough(1.0), ..grey(0.5, 0.2) }), pack(grey(0.5, 0.2)));
}

#[test]
fn a_coat_is_compiled_where_there_is_one() {
    let coated = |coat: f32, coat_roughness: f32| Material { coat, coat_roughness, ..grey(0.5, 0.0) };
    assert_eq!(features(coated(0.5, 0.0)), ["coat"]);
    assert_eq!(pack(coated(0.0, 0.5)), pack(grey(0.5, 0.0)), "no coat has no roughness");
    assert_eq!(pack(Material { passage: Passage::Glass(1.5), ..coated(1.0, 0.5) }).coat, 0.0, "glass has none");
    let alpha = |roughness: f32| pack(coated(1.0, roughness)).coat_alpha;
    assert_eq!([alpha(0.0), alpha(0.99 * SMOOTHEST_ALPHA.sqrt()), alpha(0.5), alpha(2.0)], [0.0, 0.0, 0.25, 1.0]);
}

#[test]
fn roughness_chooses_the_lobe() {
    let alpha = |roughness: f32| pack(Material { lobe: Lobe::Ggx(roughness), ..grey(0.5, 0.2) });
    assert_eq!((alpha(0.5).alpha, alpha(0.5).flags), (0.25, MATERIAL_GGX));
    assert_eq!((alpha(0.0).alpha, alpha(0.0).flags), (0.0, MATERIAL_MIRROR));
    assert_eq!(alpha(0.99 * SMOOTHEST_ALPHA.sqrt()).flags, MATERIAL_MIRROR);
    assert_eq!(alpha(1.01 * SMOOTHEST_ALPHA.sqrt()).flags, MATERIAL_GGX);
}

#[test]
fn metal_reflects_its_colour_and_glass_has_none() {
    let metal = pack(Material { metallic: 0.75, ..grey(0.4, 0.1) });
    assert!((metal.kd - 0.1).abs().max_element() < 1e-6 && (metal.ks - 0.4).abs().max_element() < 1e-6);
    assert!((metal.specular_probability - 0.8).abs() < 1e-6);
    // The energy policy comes after.
    let bright = Material { metallic: 0.5, ..grey(1.0, 1.0) };
    let kept = pack(bright);
    assert!((kept.kd - 0.25).abs().max_element() < 1e-6 && (kept.ks - 0.75).abs().max_element() < 1e-6);
    let written = material::pack(&bright, Energy::AsWritten);
    assert_eq!((written.kd, written.ks), (Vec3::splat(0.5), Vec3::splat(1.5)));
    let glass = pack(Material { passage: Passage::Glass(1.5), ..grey(0.4, 0.1) });
    assert_eq!(
        (glass.flags, glass.ni, glass.specular_probability, glass.transparency),
        (MATERIAL_DIELECTRIC, 1.5, 0.0, 0.0)
    );
    assert_eq!((glass.kd, glass.ks), (Vec3::ZERO, Vec3::ZERO));
}

#[test]
fn numbers_out_of_range_are_moved_into_it() {
    let (filter, lobe) = (Vec3::new(2.0, 0.5, -1.0), Lobe::Phong(1e9));
    let veil = Material { passage: Passage::SeeThrough(-0.5), filter, lobe, one_sided: true, ..grey(0.5, 0.2) };
    let record = pack(veil);
    assert_eq!((record.transparency, record.ns, record.flags), (1.0, 1e5, MATERIAL_ONE_SIDED));
    assert_eq!(record.tf, Vec3::new(1.0, 0.5, 0.0));
    assert_eq!(pack(Material { passage: Passage::Glass(0.5), ..veil }).ni, 1.0);
    // The kernel calls -0.0 negative.
    let dark = pack(Material { emission: Vec3::splat(-0.0), diffuse: Vec3::splat(-0.0), ..Material::BLACK });
    assert!(dark.emission.is_negative_bitmask() == 0 && dark.kd.is_negative_bitmask() == 0);
}
