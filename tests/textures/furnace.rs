//! Reliefs where all around is equally bright: what is not absorbed comes back, seen straight on and grazing.

use std::time::Duration;

use glam::{DVec3, UVec2, Vec2, Vec3};
use lucerna::components::{Camera, Channel, Environment, Lobe, Maps, Material, Reading, Texture};
use lucerna::engine::Engine;
use lucerna::shader::Library;

use super::board::{Scene, Textures, quad};
use super::garden::{bumps, picture};
use crate::support;

/// Directions that lean up to 70 degrees, every way.
fn directions() -> Texture {
    let picture = picture(UVec2::new(32, 32), |x, y| {
        let (u, v) = (x as f32 / 31.0 * 2.0 - 1.0, y as f32 / 31.0 * 2.0 - 1.0);
        let lean = Vec2::new(u, v).clamp_length_max(1.0) * 0.94;
        let n = Vec3::new(lean.x, lean.y, (1.0 - lean.length_squared()).sqrt());
        let code = |v: f32| (127.5 * (v + 1.0) + 0.5) as u8;
        [code(n.x), code(n.y), code(n.z), 255]
    });
    Texture::new(picture, Reading::Normal { flip_green: false })
}

fn heights() -> Texture {
    Texture::new(bumps(), Reading::Height { channel: Channel::Luminance, depth: 0.4 })
}

/// Mean of what comes back from a white surface that fills the picture, seen at an angle from its normal; and the brightest pixel's.
fn albedo(material: Material, relief: &Texture, degrees: f64) -> (f64, f64) {
    let mut scene =
        Scene::new(16, lucerna::components::Render { max_depth: 64, spp: 256, roulette: false, ..Default::default() });
    scene.description.environment = Some(Environment::Constant(Vec3::ONE));
    let (sin, cos) = degrees.to_radians().sin_cos();
    let camera = Camera {
        position: 10.0 * DVec3::new(sin, 0.0, cos),
        look_at: DVec3::ZERO,
        up: DVec3::Y,
        fov_y: 2.0,
        ..Camera::default()
    };
    scene.description.cameras.values_mut().for_each(|held| *held = camera);
    let side = quad(Vec3::new(-30.0, -30.0, 0.0), 60.0 * Vec3::X, 60.0 * Vec3::Y, [Vec2::ZERO, Vec2::splat(40.0)]);
    let maps = Textures { relief: Some(relief.clone()), ..Textures::default() };
    scene.part("plane", side, glam::DAffine3::IDENTITY, material, maps);
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &scene.description).unwrap();
    engine.edit(|world| scene.dress(world));
    while !engine.step(Duration::from_millis(200)).unwrap().finished {}
    assert!(engine.features().contains("relief"));
    assert!(engine.read(|world| world.try_query::<&Maps>().unwrap().iter(world).any(|maps| maps.relief.is_some())));
    assert_eq!(engine.report().unwrap().bad_samples, 0);
    let film = engine.film().unwrap();
    let most = film.rgb.iter().map(|rgb| f64::from(rgb[0])).fold(0.0, f64::max);
    (film.mean[0], most)
}

#[test]
fn no_relief_makes_light_or_loses_much_of_it() {
    let white = Material { diffuse: Vec3::ONE, ..Material::BLACK };
    let shiny = |lobe| Material { specular: Vec3::ONE, lobe, ..Material::BLACK };
    let mut told = String::new();
    for (name, material, least) in [
        ("diffuse", white, 0.999),
        ("mirror", shiny(Lobe::Mirror), 0.999),
        ("GGX of 0.3", shiny(Lobe::Ggx(0.3)), 0.9),
        ("GGX of 0.8", shiny(Lobe::Ggx(0.8)), 0.4),
    ] {
        for (kind, relief) in [("directions", directions()), ("heights", heights())] {
            for degrees in [0.0, 60.0, 85.0, 89.5] {
                let (mean, most) = albedo(material, &relief, degrees);
                told += &format!("{name}, {kind}, {degrees} degrees: {mean:.4}, at most {most:.4}\n");
                assert!(mean <= 1.001 && mean >= least, "{told}");
            }
        }
    }
    println!("{told}");
}
