//! Where the user is; the engine's camera follows.

use std::collections::BTreeMap;
use std::time::Duration;

use glam::DVec3;

use super::flight::Flight;
use super::navigate;
use crate::components::Camera;

/// Where the user is, and the flight that is under way.
pub struct Viewpoint {
    pub camera: Camera,
    /// The engine's camera does not follow yet.
    pub moved: bool,
    /// The cameras as the scene's file has them.
    pub homes: BTreeMap<String, Camera>,
    flight: Flight,
}

impl Viewpoint {
    /// At the engine's camera, at rest.
    pub fn new(camera: Camera, homes: BTreeMap<String, Camera>) -> Self {
        Self { camera, moved: false, homes, flight: Flight::default() }
    }

    /// Goes to another place: the engine's camera is to follow.
    pub fn move_to(&mut self, camera: Camera) {
        (self.camera, self.moved) = (camera, true);
    }

    /// Goes to where the engine's camera is already, and rests there.
    pub fn rest_at(&mut self, camera: Camera) {
        (self.camera, self.moved, self.flight) = (camera, false, Flight::default());
    }

    /// Whether it flies, or is to fly to `wanted`: right, up and forward.
    pub fn flies(&self, wanted: DVec3) -> bool {
        wanted != DVec3::ZERO || self.flight.is_under_way()
    }

    /// Flies on to `wanted`, or comes to rest. Full speed is `speed`, in scene units a second.
    pub fn fly(&mut self, wanted: DVec3, elapsed: Duration, speed: f64) {
        let way = self.flight.advance(wanted, elapsed);
        self.move_to(navigate::fly(self.camera, way * speed));
    }
}
