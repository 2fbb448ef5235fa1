//! What differs of the scene as a whole, and of no material alone.

use super::note::{Notes, Weight};
use super::placed::PlacedMesh;
use crate::components::{Passage, TextureFilter, Wrap};
use crate::scene::{MtlMaterial, SceneDescription};

/// Says it.
pub fn say_of_whole(scene: &SceneDescription, meshes: &[PlacedMesh], notes: &mut Notes) {
    let is_masked = |numbers: &MtlMaterial| numbers.maps.d.as_ref().is_some_and(|map| !map.off);
    let is_passed = |numbers: &MtlMaterial| {
        is_masked(numbers) || matches!(numbers.passage(), Passage::Pane(_) | Passage::SeeThrough(_))
    };
    let lamps = || meshes.iter().filter(|placed| placed.shines());
    if let Some(lamp) = lamps().find(|lamp| !lamp.numbers.one_sided) {
        let text = format!(
            "lamps that shine to both sides, such as {}, are two sheets back to back: half of what Mitsuba draws of them is of the side that is not seen, which costs it efficiency; `one_sided: true` spares that",
            lamp.name
        );
        notes.say(Weight::Slight, &text);
    }
    if let Some(lamp) = lamps().find(|lamp| is_masked(lamp.numbers)) {
        notes.say_of(lamp.material, "map_d", "what shines is not cut out by its map of opacity".to_owned());
    }
    if !scene.lights.is_empty() && meshes.iter().any(|placed| is_passed(placed.numbers)) {
        notes.say(
            Weight::Another,
            "light of points goes through no pane and no see-through surface: Mitsuba's `path` finds none of it there",
        );
    }
    if meshes.iter().any(|placed| placed.mesh.has_normals) {
        notes.say(
            Weight::Slight,
            "where a normal leans off its triangle, Lucerna's triangles mirror what would run into them, and Mitsuba's lose it",
        );
    }
    if !scene.textures.is_empty() && scene.render.texture_filter == TextureFilter::Footprint {
        notes.say(
            Weight::Slight,
            "Mitsuba looks textures up at points: compare with pictures of `--texture-filter exact`",
        );
    }
    let clamped = |wrap: [Wrap; 2]| wrap[0] != wrap[1];
    if scene.textures.values().any(|texture| clamped(texture.wrap)) {
        notes.say(Weight::Another, "a texture that is clamped along one axis alone is repeated along both");
    }
}
