//! What the phases hand to each other: resources that live as long as the engine, and components on the entities they are about.

mod compiling;
mod device;
mod film;
mod governor;
mod points;
mod scene;
mod spared;
mod textures;
mod tiles;

pub use compiling::CompileListener;
pub use device::{Budget, Device, Frame, Live, ProbeChosen, Probing, Robust, Spent, Tree, TreeBuilder, Viewed};
pub use film::{Batch, FilmProgress, Sweep, TileBatch, film_has_not_begun};
pub use governor::Governor;
pub use points::point_names;
pub use scene::{
    Displayed, Endless, Everything, General, LightDensity, MaterialSlot, MeanEmission, MeshSlot, Policy, Relief,
    SceneGeometry, Shot, Sky, SkyCell, SkySource, Target, Texel,
};
pub use spared::{DoneBefore, Spared};
pub use textures::{TextureSlot, TextureUse, Textures, texture_set};
pub use tiles::{PILOT_SPP, TileCounts, Tiles};
