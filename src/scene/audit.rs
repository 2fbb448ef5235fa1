//! What becomes of everything that a scene's libraries say of its materials.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::assets::Assets;
use super::diagnostic::{Diagnostic, Diagnostics, Severity};
use super::kind::Kind;
use super::load::{Loaded, Origin, attempt, bare};
use super::mtl::{Account, Appearance, MtlMaterial, Verdict, read_accounts};
use super::textures::Loading;
use super::variants::{is_family, load, plan};
use crate::components::{DiffuseMap, Energy, Render};

/// The materials of one scene, model or library.
#[derive(Clone, Debug, Default)]
pub struct Audit {
    pub file: PathBuf,
    /// Of a family, whose file it is then: the members that have these materials.
    pub members: Vec<String>,
    pub diagnostics: Diagnostics,
    /// By their names; of a scene, `model:material`.
    pub materials: Vec<Audited>,
}

/// A material, and what becomes of what files say of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Audited {
    pub name: String,
    pub look: Appearance,
    /// None where no library has it.
    pub library: Option<PathBuf>,
    /// The largest channel of kd + ks, as written and as rendered.
    pub energy: [f32; 2],
    /// By what it is read otherwise than it is written.
    pub policies: Vec<String>,
    /// In the order of the file.
    pub statements: Vec<Verdict>,
    /// Fields that the scene file gives, and where.
    pub edits: Vec<(String, Diagnostic)>,
}

/// Reads a scene, a model or a library as it would be rendered; of a family, all members, those of equal materials as one.
pub fn audits(path: &Path) -> Vec<Audit> {
    let assets = Assets::new();
    if !is_family(path, &assets) {
        return vec![audit(path)];
    }
    let empty = Audit { file: path.to_path_buf(), ..Audit::default() };
    let family = match plan(path, &[], &assets) {
        Ok(family) => family,
        Err(errors) => return vec![Audit { diagnostics: errors, ..empty }],
    };
    let mut audits: Vec<Audit> = Vec::new();
    for member in &family.members {
        let mut found = Audit { members: vec![member.name.clone()], ..empty.clone() };
        match load(&family, member, &Loading::default(), &assets).0 {
            Ok(loaded) => found.take_scene(loaded),
            Err(errors) => found.diagnostics = errors,
        }
        let known = audits.iter().flat_map(|audit| &audit.diagnostics.list).cloned().collect::<Vec<_>>();
        found.diagnostics.list.retain(|message| !known.contains(message));
        match audits.iter_mut().find(|audit| audit.materials == found.materials) {
            Some(audit) => {
                audit.members.append(&mut found.members);
                audit.diagnostics.list.append(&mut found.diagnostics.list);
            }
            None => audits.push(found),
        }
    }
    audits
}

/// Reads a scene, a model or a library as it would be rendered.
pub fn audit(path: &Path) -> Audit {
    let mut audit = Audit { file: path.to_path_buf(), ..Audit::default() };
    match Kind::of(path) {
        Ok(Some(Kind::Scene | Kind::Model)) => match attempt(path, &[]).0 {
            Ok(loaded) => audit.take_scene(loaded),
            Err(errors) => audit.diagnostics = errors,
        },
        Ok(Some(Kind::Library)) => {
            let accounts = read_accounts(path, &mut audit.diagnostics);
            for (name, account) in &accounts {
                let origin = Origin { library: Some(path.into()), ..Origin::default() };
                audit.materials.push(audited(name, &account.material, &origin, Some(account), &Render::default()));
            }
        }
        Ok(None) => {
            let error = Diagnostic::file(Severity::Error, path, "there are no materials in this kind of file");
            audit.diagnostics.push(error.help("name a scene (.ron), a model (.obj) or a library (.mtl)"));
        }
        Err(error) => audit.diagnostics.push(error),
    }
    audit
}

impl Audit {
    fn take_scene(&mut self, loaded: Loaded) {
        let Loaded { description, warnings, origins, .. } = loaded;
        self.diagnostics.list = warnings;
        let alone = matches!(Kind::of(&self.file), Ok(Some(Kind::Model)));
        let mut libraries: BTreeMap<PathBuf, BTreeMap<String, Account>> = BTreeMap::new();
        for (key, material) in &description.materials {
            let origin = origins.get(key).cloned().unwrap_or_default();
            let account = origin.library.as_ref().and_then(|library| {
                // What there is to say of a library was said when the scene was read.
                let read = || read_accounts(library, &mut Diagnostics::default());
                libraries.entry(library.to_path_buf()).or_insert_with(read).get(bare(key))
            });
            let name = if alone { bare(key) } else { key };
            self.materials.push(audited(name, material, &origin, account, &description.render));
        }
    }
}

fn audited(name: &str, material: &MtlMaterial, origin: &Origin, account: Option<&Account>, render: &Render) -> Audited {
    let written = material.energy();
    let scaled = render.energy == Energy::Preserve && written > 1.0;
    let mut policies: Vec<String> = account.iter().flat_map(|account| account.policies()).map(str::to_owned).collect();
    if scaled {
        policies.push("energy: Preserve divides `Kd` and `Ks` by their sum's largest channel".to_owned());
    } else if written > 1.0 {
        policies.push("energy: AsWritten leaves a sum above 1".to_owned());
    }
    if material.maps.kd.as_ref().is_some_and(|map| !map.off) {
        policies.push(match render.diffuse_map {
            DiffuseMap::Multiply => "texture: Multiply, `map_Kd` times `Kd`".to_owned(),
            DiffuseMap::Replace => "texture: Replace, `map_Kd` in place of `Kd`".to_owned(),
        });
    }
    Audited {
        name: name.to_owned(),
        look: material.appearance(),
        library: origin.library.as_deref().map(Path::to_path_buf),
        energy: [written, if scaled { 1.0 } else { written }],
        policies,
        statements: account.map_or_else(Vec::new, |account| account.verdicts(material, &origin.edited, render)),
        edits: origin.edited.iter().map(|(field, place)| ((*field).to_owned(), place.clone())).collect(),
    }
}
