//! Plain data on entities. Knows bevy_ecs and glam, and neither files nor the GPU.
//!
//! | entity | components |
//! |---|---|
//! | mesh | `Name`, [`Geometry`], [`Transform`], [`UsesMaterial`] |
//! | material | `Name`, [`Material`], [`Maps`] |
//! | texture | `Name`, [`Texture`] |
//! | camera | `Name`, [`Camera`]; one of them is [`Active`] |
//! | light | `Name`, [`PointLight`] |
//! | film | `Name`, [`Film`], [`Render`], [`ShaderValues`]: one entity |
//! | environment | `Name`, [`Environment`]: at most one entity |
//!
//! A `Name` is a stable key, unique within its kind (`model/object/3`, `model:material`). Whatever depends on an order
//! sorts by it.

mod camera;
mod environment;
mod film;
mod light;
mod material;
mod mesh;
mod rendered;
mod shader;
mod texture;

pub use bevy_ecs::name::Name;
pub use camera::{Active, Camera, Focus, Lens};
pub use environment::{Daylight, Environment, EnvironmentMap};
pub use film::{Adaptive, Crop, DiffuseMap, Energy, Film, Integrator, Render, Reuse, Sampler, TextureFilter, Tone};
pub use light::{PointLight, SpotCone};
pub use material::{Lobe, Material, Passage};
pub use mesh::{Geometry, MeshData, Transform, UsesMaterial};
pub use rendered::{CameraItem, EnvironmentItem, rendered_camera, rendered_environment};
pub use shader::{ShaderValue, ShaderValues};
pub use texture::{Channel, Maps, Reading, Texels, Texture, TextureImage, Wrap};

use bevy_ecs::prelude::World;

/// Makes all components of scenes known to a world, so that it can be queried for any of them.
pub fn register(world: &mut World) {
    world.register_component::<Name>();
    world.register_component::<Geometry>();
    world.register_component::<Transform>();
    world.register_component::<UsesMaterial>();
    world.register_component::<Material>();
    world.register_component::<Maps>();
    world.register_component::<Texture>();
    world.register_component::<Camera>();
    world.register_component::<Active>();
    world.register_component::<PointLight>();
    world.register_component::<Film>();
    world.register_component::<Render>();
    world.register_component::<ShaderValues>();
    world.register_component::<Environment>();
}
