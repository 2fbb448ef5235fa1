//! A family of scenes in the window: one member of it runs, and another can be chosen.

mod followed;
mod listing;

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

pub use listing::Listing;

use crate::app::Failure;
use crate::app::shared::failure::show;
use crate::app::shared::parameters;
use crate::app::shared::scene::{Opened, SceneFlags};
use crate::scene::{Assets, Diagnostics};
use crate::shader::{Layers, Library};
use crate::watch::{Attempt, SceneSource, Sources, WatchedScene};
use followed::{Followed, SharedListing};

/// A family that was opened.
#[derive(Clone)]
pub struct Family {
    path: PathBuf,
    flags: SceneFlags,
    listing: SharedListing,
    /// The shaders of the member that was opened.
    layers: Layers,
    /// What was read for it.
    assets: Arc<Assets>,
    /// The variant files of the chain.
    files: Vec<PathBuf>,
}

impl Family {
    /// Reads a variant file, and opens its first member that is right; those before it are told.
    pub fn open(path: &Path, flags: &SceneFlags) -> Result<(Family, Opened, Library), Failure> {
        let listing = Arc::new(Mutex::new(Listing::default()));
        let assets = Arc::new(Assets::new());
        let followed = followed(path, flags, &listing, &assets, Vec::new());
        let family = followed.plan()?;
        *lock(&listing) = Listing::new(family.members.iter().map(|member| member.name.clone()).collect());
        let mut wrong: Vec<Diagnostics> = Vec::new();
        for member in &family.members {
            let Attempt { scene, files, shaders } = followed.load(&family, member);
            match scene {
                Ok(loaded) => {
                    wrong.iter().flat_map(|errors| &errors.list).for_each(|error| show(error));
                    loaded.warnings.iter().for_each(|warning| show(warning));
                    let mut description = loaded.description;
                    flags.adjust(&mut description)?;
                    let layers = shaders.unwrap_or_default();
                    let library = layers.read()?;
                    parameters::check(&description.shader, &loaded.shader_places, &library)?;
                    lock(&listing).choose(&member.name);
                    let shader_places = loaded.shader_places;
                    let (path, text, flags) = (path.to_path_buf(), loaded.text, flags.clone());
                    let opened = Opened { path: path.clone(), description, text, files, shader_places, spp: None };
                    return Ok((Family { path, flags, listing, layers, assets, files: family.files }, opened, library));
                }
                // What is wrong with several members is told once.
                Err(errors) if wrong.iter().any(|known| known.list == errors.list) => {}
                Err(errors) => wrong.push(errors),
            }
        }
        let list = wrong.into_iter().flat_map(|errors| errors.list).collect();
        Err(Diagnostics { list }.into())
    }

    /// What an engine that runs a member with `library` is to watch.
    pub fn sources(&self, opened: Opened, library: Library) -> Sources {
        let mut followed = followed(&self.path, &self.flags, &self.listing, &self.assets, self.files.clone());
        let watched = WatchedScene { read: Box::new(move || followed.read()), adjust: self.flags.adjusting() };
        let Opened { description, text, files, .. } = opened;
        Sources {
            shaders: Some((self.layers.clone(), library)),
            scene: Some(SceneSource { watched, description, text, files }),
        }
    }

    /// The members as the file had them last.
    pub fn listing(&self) -> Listing {
        lock(&self.listing).clone()
    }

    /// Wants the member that is `by` places farther, when the scene is read next.
    pub fn step(&self, by: i32) {
        lock(&self.listing).step(by);
    }

    /// Wants the member of a name.
    pub fn choose(&self, name: &str) {
        lock(&self.listing).choose(name);
    }
}

fn followed(
    path: &Path,
    flags: &SceneFlags,
    listing: &SharedListing,
    assets: &Arc<Assets>,
    files: Vec<PathBuf>,
) -> Followed {
    let shaders = flags.shader_folder().map(Path::to_path_buf);
    Followed::new(path.to_path_buf(), flags.define.clone(), shaders, listing.clone(), assets.clone(), files)
}

fn lock(listing: &SharedListing) -> MutexGuard<'_, Listing> {
    listing.lock().unwrap_or_else(PoisonError::into_inner)
}
