//! The pixel inspector, against the film as it is read back whole.

use std::path::Path;
use std::time::Duration;

use glam::UVec2;
use lucerna::Engine;
use lucerna::components::Crop;
use lucerna::scene;
use lucerna::shader::Library;

use crate::support;

#[test]
fn a_pixel_is_what_the_film_holds_and_what_is_seen_there() {
    let mut description = scene::load(Path::new("assets/scenes/cornell-data.ron"), &[]).unwrap().description;
    description.film.size = UVec2::new(64, 48);
    // A crop: pixels are counted from its own corner, and rays go through the whole film's.
    description.film.crop = Some(Crop { min: UVec2::new(8, 0), max: UVec2::new(60, 40) });
    description.render.spp = 3;
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    assert_eq!(engine.inspect(UVec2::ZERO).unwrap(), None);
    while !engine.step(Duration::from_millis(100)).unwrap().finished {}
    let film = engine.film().unwrap();
    let brightest = (0..film.rgb.len()).max_by(|a, b| film.rgb[*a][1].total_cmp(&film.rgb[*b][1])).unwrap();
    let mut look = |index: usize| {
        let pixel = UVec2::new(index as u32 % 52, index as u32 / 52);
        engine.inspect(pixel).unwrap().unwrap()
    };
    for index in [0, 51, 52, 777, 52 * 40 - 1, brightest] {
        let seen = look(index);
        assert_eq!((seen.radiance.map(|v| v as f32), seen.samples, seen.bad), (film.rgb[index], 3, 0));
    }
    let lamp = look(brightest).surface.unwrap();
    assert!(lamp.material.as_deref() == Some("cornell-data:light"), "{lamp:?}");
    // A plane across the view, at whatever distance from the camera's place.
    let camera = description.cameras[&description.active];
    let forward = (camera.look_at - camera.position).normalize();
    let points =
        description.meshes.iter().filter(|(_, mesh)| mesh.material == "cornell-data:light").flat_map(|(_, mesh)| {
            mesh.geometry
                .positions
                .iter()
                .map(|p| (mesh.transform.0.transform_point3(*p) - camera.position).dot(forward))
        });
    let [near, far] = points.fold([f64::MAX, f64::MIN], |[near, far], d| [near.min(d), far.max(d)]);
    assert!(near - 1e-3 <= lamp.distance && lamp.distance <= far + 1e-3, "{} is not in {near} to {far}", lamp.distance);
    // The film is wider than the box is deep: at its left edge, the camera looks past it.
    assert_eq!(look(52 * 20).surface, None);
    let outside = engine.inspect(UVec2::new(52, 0)).unwrap();
    assert_eq!(outside, None);
    let report = engine.report().unwrap();
    assert_eq!(report.samples, 3 * 52 * 40, "to look is not to trace");
}
