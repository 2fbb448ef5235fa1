//! One path: light asked directly and light hit by chance, weighted together by the balance heuristic (Veach 1997).

use glam::{DVec2, DVec3, UVec2};

use super::Oracle;
use super::bsdf::{Bsdf, Facing};
use super::random::Random;

impl Oracle {
    /// Radiance of one sample of a pixel of the whole film.
    pub(super) fn trace(&self, pixel: UVec2, random: &mut Random) -> DVec3 {
        let at = pixel.as_dvec2() + DVec2::new(random.unit(), random.unit());
        let (mut origin, mut direction) = self.scene.camera_ray(at, random);
        let (mut throughput, mut radiance) = (DVec3::ONE, DVec3::ZERO);
        // Of the ray's direction, as the last surface drew it; 0 where it could not have asked a light that way.
        let mut drawn_pdf = 0.0;
        for segment in 1..=self.max_depth {
            let Some(hit) = self.scene.closest(origin, direction, random) else {
                let asked_pdf = self.lights.pdf_of_sky(direction);
                radiance += throughput * self.lights.sky_radiance(direction) * self.share(drawn_pdf, asked_pdf);
                break;
            };
            let emitted = self.scene.emitted(&hit, direction);
            if emitted != DVec3::ZERO {
                let asked_pdf = self.lights.pdf_of_hit(&self.scene, &hit, direction);
                radiance += throughput * emitted * self.share(drawn_pdf, asked_pdf);
            }
            if segment == self.max_depth {
                break;
            }
            origin += hit.t * direction;
            let facing = self.scene.facing(&hit, direction, random);
            let bsdf = self.scene.substance(&hit).bsdf(self.scene.uv(&hit), random);
            if self.ask_lights {
                radiance += throughput * self.ask(origin, &facing, &bsdf, random);
            }
            radiance +=
                throughput * self.points.ask(&self.scene, origin, &facing, &bsdf, self.max_depth - segment - 1, random);
            let Some(draw) = bsdf.draw(&facing, random) else { break };
            throughput *= draw.weight;
            if throughput == DVec3::ZERO {
                break;
            }
            (direction, drawn_pdf) = (draw.wi, draw.pdf);
        }
        radiance
    }

    /// Weight of light that was hit by chance, against asking for it.
    fn share(&self, drawn_pdf: f64, asked_pdf: f64) -> f64 {
        if self.ask_lights && drawn_pdf > 0.0 { drawn_pdf / (drawn_pdf + asked_pdf) } else { 1.0 }
    }

    /// Light that a surface reflects from one light that it asks, weighted.
    fn ask(&self, at: DVec3, facing: &Facing, bsdf: &Bsdf, random: &mut Random) -> DVec3 {
        let Some(ask) = self.lights.draw(&self.scene, at, random) else { return DVec3::ZERO };
        let (value, drawn_pdf) = bsdf.evaluate(facing, ask.wi);
        if value == DVec3::ZERO {
            return DVec3::ZERO;
        }
        // The first surface of that direction is or isn't the light: so both ways of finding it see the same scene.
        let hit = self.scene.closest(at, ask.wi, random);
        if hit.map(|hit| hit.triangle) != ask.triangle {
            return DVec3::ZERO;
        }
        let light = match hit {
            Some(hit) => self.scene.emitted(&hit, ask.wi),
            None => self.lights.sky_radiance(ask.wi),
        };
        value * light / (ask.pdf + drawn_pdf)
    }
}
