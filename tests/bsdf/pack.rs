//! Materials' numbers to records.

use glam::Vec3;
use lucerna::layout::trace::{
    EnergyRule, MATERIAL_DIELECTRIC, MATERIAL_GGX, MATERIAL_MIRROR, MaterialRecord, Reflector, SMOOTHEST_ALPHA,
};
use lucerna::passes::trace::Needs;

fn pack(values: Reflector) -> MaterialRecord {
    MaterialRecord::pack(&values, EnergyRule::Preserve)
}

fn features(values: Reflector) -> Vec<&'static str> {
    Needs { materials: &[pack(values)], ..Needs::default() }.features()
}

fn grey(kd: f32, ks: f32) -> Reflector {
    Reflector { kd: Vec3::splat(kd), ks: Vec3::splat(ks), ns: 10.0, ..Reflector::default() }
}

#[test]
fn what_a_material_lacks_is_not_compiled() {
    assert_eq!(features(grey(0.5, 0.0)), [""; 0]);
    assert_eq!(features(grey(0.5, 0.2)), ["phong"]);
    assert_eq!(features(Reflector { roughness: Some(0.5), ..grey(0.5, 0.2) }), ["ggx"]);
    assert_eq!(features(Reflector { mirror: true, ..grey(0.5, 0.2) }), ["mirror"]);
    assert_eq!(features(Reflector { opacity: 0.5, ..grey(0.5, 0.0) }), ["alpha"]);
    assert_eq!(features(Reflector { dielectric: true, opacity: 0.5, ..grey(0.5, 0.2) }), ["dielectric"]);
    // No lobe, no code for it.
    assert_eq!(features(Reflector { roughness: Some(0.5), mirror: true, ..grey(0.5, 0.0) }), [""; 0]);
    // Ni alone makes no glass.
    assert_eq!(pack(Reflector { ni: 1.5, tf: Vec3::ZERO, ..grey(0.5, 0.2) }), pack(grey(0.5, 0.2)));
}

#[test]
fn roughness_chooses_the_lobe() {
    let alpha = |roughness: f32| pack(Reflector { roughness: Some(roughness), mirror: true, ..grey(0.5, 0.2) });
    assert_eq!((alpha(0.5).alpha, alpha(0.5).flags), (0.25, MATERIAL_GGX));
    assert_eq!((alpha(0.0).alpha, alpha(0.0).flags), (0.0, MATERIAL_MIRROR));
    assert_eq!(alpha(0.99 * SMOOTHEST_ALPHA.sqrt()).flags, MATERIAL_MIRROR);
    assert_eq!(alpha(1.01 * SMOOTHEST_ALPHA.sqrt()).flags, MATERIAL_GGX);
}

#[test]
fn metal_reflects_its_colour_and_glass_has_none() {
    let metal = pack(Reflector { metallic: 0.75, ..grey(0.4, 0.1) });
    assert!((metal.kd - 0.1).abs().max_element() < 1e-6 && (metal.ks - 0.4).abs().max_element() < 1e-6);
    assert!((metal.specular_probability - 0.8).abs() < 1e-6);
    // The energy rule comes after.
    let bright = pack(Reflector { metallic: 0.5, ..grey(1.0, 1.0) });
    assert!((bright.kd - 0.25).abs().max_element() < 1e-6 && (bright.ks - 0.75).abs().max_element() < 1e-6);
    let glass = pack(Reflector { dielectric: true, ni: 1.5, opacity: 0.5, ..grey(0.4, 0.1) });
    assert_eq!(
        (glass.flags, glass.ni, glass.specular_probability, glass.transparency),
        (MATERIAL_DIELECTRIC, 1.5, 0.0, 0.0)
    );
    assert_eq!((glass.kd, glass.ks), (Vec3::ZERO, Vec3::ZERO));
}
