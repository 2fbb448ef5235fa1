//! Camera, film and path lengths.

use glam::{DVec3, UVec2};

use super::note::{Notes, Weight};
use super::xml::Element;
use crate::components::{Camera, Film};
use crate::scene::SceneDescription;

/// No path is ended before this.
const NEVER: u64 = 1 << 30;

/// Nearest and farthest of what is seen, by the distance that the camera is focused to and the radius of the scene.
const NEAR: f64 = 1e-4;
const FAR: f64 = 1e5;

/// Paths of at most so many segments, as Lucerna counts them: 1 sees emitters only.
pub fn integrator(max_depth: u32) -> Element {
    Element::plugin("integrator", "path").integer("max_depth", max_depth.into()).integer("rr_depth", NEVER)
}

/// The camera that is rendered. `radius` is that of the scene, with the camera.
pub fn sensor(scene: &SceneDescription, radius: f64, notes: &mut Notes) -> Element {
    let camera = scene.cameras.get(&scene.active).copied().unwrap_or_default();
    let focus = camera.focus_distance();
    let lens = camera.lens.aperture > 0.0 && focus > 0.0;
    let placed = if lens { shifted_film(&camera, &scene.film, notes) } else { Placed::plain(&camera, &scene.film) };
    let forward = (camera.look_at - camera.position).normalize_or(DVec3::NEG_Z);
    let distance = if focus > 0.0 { focus } else { 1.0 };
    let element = Element::plugin("sensor", if lens { "thinlens" } else { "perspective" })
        .string("fov_axis", "y")
        .float("fov", placed.fov_y)
        .float("near_clip", NEAR * distance)
        .float("far_clip", FAR * radius.max(distance))
        .look_at("to_world", [camera.position, camera.position + distance * forward, camera.up]);
    let element = if lens {
        element.float("aperture_radius", camera.lens.aperture).float("focus_distance", focus)
    } else {
        let aspect = f64::from(scene.film.size.x) / f64::from(scene.film.size.y);
        let shift = camera.lens.shift;
        // Of the film's width and height.
        element.float("principal_point_offset_x", -shift.x / aspect).float("principal_point_offset_y", shift.y)
    };
    let sampler = Element::plugin("sampler", "independent").integer("sample_count", scene.render.spp.into());
    element.with(sampler).with(placed.film())
}

/// A film that may be larger than the picture, of which it is a part then.
struct Placed {
    fov_y: f64,
    size: UVec2,
    /// First pixel and size of what is rendered.
    crop: [UVec2; 2],
}

impl Placed {
    fn plain(camera: &Camera, film: &Film) -> Self {
        let window = film.window();
        Self { fov_y: camera.fov_y, size: film.size, crop: [window.min, window.size()] }
    }

    fn film(&self) -> Element {
        let [first, size] = self.crop;
        let film = Element::plugin("film", "hdrfilm")
            .integer("width", self.size.x.into())
            .integer("height", self.size.y.into())
            .string("pixel_format", "rgb")
            .string("component_format", "float32")
            .with(Element::plugin("rfilter", "box"));
        if self.crop == [UVec2::ZERO, self.size] {
            return film;
        }
        film.integer("crop_offset_x", first.x.into())
            .integer("crop_offset_y", first.y.into())
            .integer("crop_width", size.x.into())
            .integer("crop_height", size.y.into())
    }
}

/// A lens that is moved against the film: the picture is a part of a larger one about the axis. Mitsuba's lens can't be moved.
fn shifted_film(camera: &Camera, film: &Film, notes: &mut Notes) -> Placed {
    let plain = Placed::plain(camera, film);
    let height = f64::from(film.size.y);
    let shift = camera.lens.shift * height;
    let whole = shift.round();
    if whole == glam::DVec2::ZERO && shift == whole {
        return plain;
    }
    if shift.distance(whole) > 1e-6 {
        notes.say(Weight::Slight, "the lens is moved by whole pixels: Mitsuba's `thinlens` can't be moved by less");
    }
    // Room on the side that the picture moves to, and as much on the other: the axis stays in the middle.
    let room = (2.0 * whole.abs()).as_uvec2();
    let size = film.size + room;
    let fov_y = 2.0 * ((0.5 * camera.fov_y.to_radians()).tan() * f64::from(size.y) / height).atan().to_degrees();
    let first = UVec2::new(if whole.x > 0.0 { room.x } else { 0 }, if whole.y > 0.0 { 0 } else { room.y });
    Placed { fov_y, size, crop: [plain.crop[0] + first, plain.crop[1]] }
}
