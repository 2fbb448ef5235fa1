//! Numbers that a map multiplies, and that nobody gave: 1 beside the map, their default without it.

use glam::Vec3;

use super::material::MtlMaterial;
use super::texture_map::TextureMap;
use crate::scene::textures::MapUse;

/// A number of a material, to read and write.
enum Number<'a> {
    /// With its default.
    Colour(&'a mut Vec3, Vec3),
    One(&'a mut f32, f32),
    /// None by default.
    Optional(&'a mut Option<f32>),
}

/// A map, and the number that it multiplies.
struct Multiplied {
    /// The number's field in scene files, and the map's.
    key: &'static str,
    map_key: &'static str,
    used: MapUse,
    map: fn(&mut MtlMaterial) -> &mut Option<TextureMap>,
    number: fn(&mut MtlMaterial) -> Number<'_>,
}

impl Multiplied {
    const fn new(
        [key, map_key]: [&'static str; 2],
        used: MapUse,
        map: fn(&mut MtlMaterial) -> &mut Option<TextureMap>,
        number: fn(&mut MtlMaterial) -> Number<'_>,
    ) -> Self {
        Self { key, map_key, used, map, number }
    }
}

/// All of them but the exponent, which stays what it is by default.
const MULTIPLIED: &[Multiplied] = &[
    Multiplied::new(
        ["kd", "map_kd"],
        MapUse::Colour,
        |m| &mut m.maps.kd,
        |m| Number::Colour(&mut m.kd, MtlMaterial::default().kd),
    ),
    Multiplied::new(["ks", "map_ks"], MapUse::Colour, |m| &mut m.maps.ks, |m| Number::Colour(&mut m.ks, Vec3::ZERO)),
    Multiplied::new(["ke", "map_ke"], MapUse::Colour, |m| &mut m.maps.ke, |m| Number::Colour(&mut m.ke, Vec3::ZERO)),
    Multiplied::new(["pr", "map_pr"], MapUse::Number, |m| &mut m.maps.pr, |m| Number::Optional(&mut m.pr)),
    Multiplied::new(["pm", "map_pm"], MapUse::Number, |m| &mut m.maps.pm, |m| Number::One(&mut m.pm, 0.0)),
    Multiplied::new(["d", "map_d"], MapUse::Number, |m| &mut m.maps.d, |m| Number::One(&mut m.d, 1.0)),
];

impl Number<'_> {
    /// Beside a map that counts alone, 1; without it the default.
    fn set(self, mapped: bool) {
        match self {
            Self::Colour(value, default) => *value = if mapped { Vec3::ONE } else { default },
            Self::One(value, default) => *value = if mapped { 1.0 } else { default },
            Self::Optional(value) => *value = mapped.then_some(1.0),
        }
    }

    fn is_zero(&self) -> bool {
        match self {
            Self::Colour(value, _) => **value == Vec3::ZERO,
            Self::One(value, _) => **value == 0.0,
            Self::Optional(value) => **value == Some(0.0),
        }
    }

    fn is_default(&self) -> bool {
        match self {
            Self::Colour(value, default) => **value == *default,
            Self::One(value, default) => **value == *default,
            Self::Optional(value) => value.is_none(),
        }
    }
}

impl MtlMaterial {
    /// Gives each number that a map says alone its value, by whether the map is on and its picture is there. The maps stay.
    pub fn settle(&mut self, is_there: impl Fn(&TextureMap, MapUse) -> bool) {
        for Multiplied { used, map, number, .. } in MULTIPLIED {
            if let Some(map) = map(self).as_ref().filter(|map| map.alone) {
                let mapped = !map.off && is_there(map, *used);
                number(self).set(mapped);
            }
        }
    }

    /// Whether a number is what its map makes of one that nobody gave.
    pub fn is_alone(&mut self, field: &str) -> bool {
        let multiplied = MULTIPLIED.iter().find(|multiplied| multiplied.key == field);
        multiplied.is_some_and(|multiplied| (multiplied.map)(self).as_ref().is_some_and(|map| map.alone))
    }

    /// Marks the maps that count alone: of numbers that were not given, or as 0, which programs write beside a map.
    pub(super) fn mark_alone(&mut self, given: impl Fn(&str) -> bool) {
        for Multiplied { key, map, number, .. } in MULTIPLIED {
            let alone = !given(key) || number(self).is_zero();
            if let Some(map) = map(self) {
                map.alone = alone;
            }
        }
        self.settle(|_, _| true);
    }

    /// After an edit of a material that was `before`: marks the maps that count alone, where the edit gave a map and no number for it,
    /// and what was there is 0 or the default. A map that the edit took away leaves the default.
    pub fn edited(&mut self, before: &Self, given: impl Fn(&str) -> bool) {
        let before = &mut before.clone();
        for Multiplied { key, map_key, map, number, .. } in MULTIPLIED {
            if !given(key) && !given(map_key) {
                continue;
            }
            let was_alone = map(before).as_ref().is_some_and(|map| map.alone);
            let unsaid = number(before).is_zero() || number(before).is_default();
            match map(self) {
                Some(map) => map.alone = !given(key) && (was_alone || unsaid),
                None if was_alone && !given(key) => number(self).set(false),
                None => {}
            }
        }
        self.settle(|_, _| true);
    }

    /// After numbers were changed by hand: those that are no longer what they were `before` are given.
    pub fn moved(&mut self, before: &Self) {
        let now = &mut self.clone();
        let before = &mut before.clone();
        for Multiplied { map, number, .. } in MULTIPLIED {
            if number(now).value() != number(before).value()
                && let Some(map) = map(self)
            {
                map.alone = false;
            }
        }
    }
}

impl Number<'_> {
    /// The value, as what can be compared.
    fn value(&self) -> Option<Vec3> {
        match self {
            Self::Colour(value, _) => Some(**value),
            Self::One(value, _) => Some(Vec3::splat(**value)),
            Self::Optional(value) => value.map(Vec3::splat),
        }
    }
}
