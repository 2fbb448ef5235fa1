//! With lights asked and without: the same mean.

use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use lucerna::components::{Environment, Material};
use lucerna::oracle::Picture;

use crate::statistics::BATCHES;
use crate::support::stage::{Stage, quad, sky_map};

use super::{SMALL, batch, compare, glass, halves, mirror, rough, shiny, veil};

/// Samples of a pixel and batch, with lights asked and without: as many as 0.3 % take.
type Samples = (u32, u32);

/// Means of batches, with lights asked and without.
struct Both {
    asked: Vec<[DVec3; 2]>,
    unasked: Vec<[DVec3; 2]>,
}

impl Both {
    fn trace(stage: &mut Stage, (asked, unasked): Samples) -> Self {
        let (with, mut without) = (stage.oracle(), stage.oracle());
        without.ask_lights = false;
        let of = |picture: Picture| halves(picture.size.x, &picture.mean);
        Self {
            asked: (0..BATCHES).map(|i| of(batch(&with, i, asked, 1))).collect(),
            unasked: (0..BATCHES).map(|i| of(batch(&without, i, unasked, 2))).collect(),
        }
    }

    /// Whether asking changes the mean, once what it found has been scaled by `planted`.
    fn agree(&self, planted: f64) -> Result<(), String> {
        compare(|i| self.asked[i].map(|v| planted * v), |i| self.unasked[i])
    }
}

#[test]
fn asking_lights_changes_no_mean() {
    let rooms: [(&str, [Material; 2], Option<Environment>, Samples); 3] = [
        ("shiny and rough", [shiny(), rough()], None, (450, 1000)),
        ("mirror and glass", [mirror(), glass()], Some(Environment::Constant(Vec3::new(0.3, 0.4, 0.5))), (128, 700)),
        ("veil and rough", [veil(), rough()], Some(sky_map()), (128, 700)),
    ];
    for (name, balls, sky, samples) in rooms {
        let mut stage = Stage::room(SMALL, balls);
        stage.sky(sky.unwrap_or(Environment::Constant(Vec3::ZERO)));
        let both = Both::trace(&mut stage, samples);
        both.agree(1.0).unwrap_or_else(|why| panic!("{name}: {why}"));
        // Six comparisons of at most 0.3 % each: 6.4 errors are 1.9 %.
        assert!(both.agree(1.025).is_err_and(|why| why.contains("differ")), "{name}: a planted error went unnoticed");
    }
}

#[test]
fn a_sky_alone_lights_a_floor() {
    let mut stage = Stage::new(SMALL, 3, DVec3::new(0.0, 1.0, 3.0), DVec3::ZERO);
    stage.part(&quad(Vec3::new(-2.0, 0.0, 2.0), Vec3::X * 4.0, Vec3::Z * -4.0), shiny());
    stage.sky(sky_map());
    Both::trace(&mut stage, (240, 480)).agree(1.0).unwrap();
}
