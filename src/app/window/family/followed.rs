//! Reads the wanted member of a family, as its files are now.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use super::listing::Listing;
use crate::scene::variants::{Family, Member, load, plan};
use crate::scene::{Assets, Define, Diagnostics, Loaded, Loading};
use crate::shader::Layers;
use crate::watch::Attempt;

/// The list, for whoever reads members and whoever chooses one.
pub type SharedListing = Arc<Mutex<Listing>>;

/// A variant file that is followed: it is read anew with what changed of all that it names.
pub struct Followed {
    pub path: PathBuf,
    /// Over what the file says, before members do.
    pub defines: Vec<Define>,
    /// For members that have no shaders of their own.
    pub shaders: Option<PathBuf>,
    pub listing: SharedListing,
    assets: Arc<Assets>,
    /// All variant files of the chain, as they were read last without a mistake.
    files: Vec<PathBuf>,
}

impl Followed {
    /// `assets` are what was read before, and `files` the variant files of the chain as they were then.
    pub fn new(
        path: PathBuf,
        defines: Vec<Define>,
        shaders: Option<PathBuf>,
        listing: SharedListing,
        assets: Arc<Assets>,
        files: Vec<PathBuf>,
    ) -> Self {
        Self { path, defines, shaders, listing, assets, files }
    }

    /// The family as its file is now.
    pub fn plan(&self) -> Result<Family, Diagnostics> {
        self.assets.refresh();
        plan(&self.path, &self.defines, &self.assets)
    }

    /// Reads the member that is wanted. The list follows the file where that is right.
    pub fn read(&mut self) -> Attempt {
        let family = match self.plan() {
            Ok(family) => family,
            // What it extends may be what is wrong: that is looked at again too.
            Err(errors) => {
                let files = std::iter::once(&self.path).chain(&self.files).cloned().collect();
                return Attempt { scene: Err(errors), files, shaders: None };
            }
        };
        self.files.clone_from(&family.files);
        let wanted = {
            let mut listing = self.listing.lock().unwrap_or_else(PoisonError::into_inner);
            listing.replace(family.members.iter().map(|member| member.name.clone()).collect());
            listing.wanted().and_then(|name| family.members.iter().find(|member| member.name == name)).cloned()
        };
        match wanted {
            Some(member) => self.load(&family, &member),
            // No family is without members.
            None => Attempt { scene: Err(Diagnostics::default()), files: family.files, shaders: None },
        }
    }

    /// A member as its scene alone would be, by the member's name.
    pub fn load(&self, family: &Family, member: &Member) -> Attempt {
        let (mut scene, read) = load(family, member, &Loading::default(), &self.assets);
        let mut files = family.files.clone();
        files.extend(read.into_iter().filter(|file| !family.files.contains(file)));
        if let Ok(Loaded { description, warnings, files: named, .. }) = &mut scene {
            description.name.clone_from(&member.name);
            warnings.splice(0..0, family.warnings.iter().cloned());
            named.clone_from(&files);
        }
        let (base, over) = (self.shaders.clone(), member.shaders.clone());
        Attempt { scene, files, shaders: Some(Layers { base, over }) }
    }
}
