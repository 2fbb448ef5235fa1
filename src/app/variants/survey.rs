//! All members, loaded before a device is opened: what is wrong is known, and what they share.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::code::Codes;
use super::flags::FamilyFlags;
use super::keys::{Keys, Numbering};
use crate::app::Failure;
use crate::app::shared::key::hash;
use crate::app::shared::parameters;
use crate::app::shared::pictures::watch_pictures;
use crate::files::Digest;
use crate::scene::variants::{self, Chosen, Family, Goal, Member};
use crate::scene::{Assets, Diagnostic, Loading, SceneDescription, Severity};

/// The seed of the reference's own film: of no member that has a small one.
const REFERENCE_SEED: u32 = 0x9e37_79b9;

/// A film that is to be made.
pub struct Subject {
    /// Of the family.
    pub member: Member,
    /// The film that the others are compared with, beside the member's own.
    pub is_reference: bool,
    pub description: SceneDescription,
    /// Of its shaders.
    pub code: usize,
    pub goal: Goal,
    pub keys: Keys,
    /// Of all that the picture follows from.
    pub key: String,
    /// Files that were read for it first.
    pub read: u32,
}

/// What came of a member.
pub type Found = Result<Subject, Box<Broken>>;

/// A member that can't be rendered.
#[derive(Clone, Debug)]
pub struct Broken {
    pub member: Member,
    pub error: Diagnostic,
}

/// All members in the order of the file, and behind them the reference, where it has a film of its own.
pub struct Survey {
    pub found: Vec<Found>,
    pub codes: Codes,
    /// Each told once.
    pub warnings: Vec<Diagnostic>,
    /// The folder of shaders of members that have none of their own, where it was named.
    pub shaders: Option<PathBuf>,
    /// What of the command line changes films, as words of a shell, each behind a space.
    pub flags: String,
    /// Every file that there is of those that were looked for.
    pub files: Vec<PathBuf>,
}

/// Loads all members. Fails where every one of them is wrong by the same message.
pub fn survey(family: &Family, assets: &Assets, flags: &FamilyFlags) -> Result<Survey, Failure> {
    let goal = flags.goal(family);
    let mut reader = Reader {
        family,
        assets,
        flags,
        goal,
        codes: Codes::new(flags.shaders.as_deref()),
        digests: BTreeMap::new(),
        warnings: Vec::new(),
        // Of the family's own files.
        reads: family.files.len() as u32,
    };
    let mut found: Vec<Found> = family.members.iter().map(|member| reader.member(member)).collect();
    let errors: Vec<&Diagnostic> = found.iter().filter_map(|found| found.as_ref().err()).map(|b| &b.error).collect();
    if errors.len() == found.len()
        && let [first, rest @ ..] = &errors[..]
        && rest.iter().all(|error| error == first)
    {
        return Err(Diagnostic::clone(first).into());
    }
    found.extend(reader.reference(&found));
    let Reader { codes, warnings, digests, .. } = reader;
    let mut numbering = Numbering::default();
    for subject in found.iter_mut().flatten() {
        subject.keys = numbering.keys(&subject.description, subject.code);
    }
    let there = digests.into_iter().filter(|(_, digest)| digest.is_some());
    let files = there.map(|(file, _)| file).collect();
    Ok(Survey { found, codes, warnings, shaders: flags.shaders.clone(), flags: flags.repeated(), files })
}

struct Reader<'s> {
    family: &'s Family,
    assets: &'s Assets,
    flags: &'s FamilyFlags,
    goal: Option<Goal>,
    codes: Codes,
    /// `None` where there is no such file.
    digests: BTreeMap<PathBuf, Option<Digest>>,
    warnings: Vec<Diagnostic>,
    /// Files read so far.
    reads: u32,
}

impl Reader<'_> {
    fn member(&mut self, member: &Member) -> Found {
        let broken = |error: Diagnostic| Box::new(Broken { member: member.clone(), error });
        let code = self
            .codes
            .number(member)
            .map_err(|message| broken(Diagnostic { severity: Severity::Error, message, ..member.place.clone() }))?;
        let tell = watch_pictures(self.flags.quiet);
        let loading = Loading { tell: &tell, ..Loading::default() };
        let (loaded, files) = variants::load(self.family, member, &loading, self.assets);
        let reads = self.assets.count();
        let read = reads - std::mem::replace(&mut self.reads, reads);
        let loaded = loaded.map_err(|errors| {
            let first = errors.list.iter().find(|error| error.severity == Severity::Error).or(errors.list.first());
            let nothing = || Diagnostic { message: "can't be read".to_owned(), ..member.place.clone() };
            broken(first.cloned().unwrap_or_else(nothing))
        })?;
        for warning in loaded.warnings {
            if !self.warnings.contains(&warning) {
                self.warnings.push(warning);
            }
        }
        let mut description = loaded.description;
        let library = self.codes.library(code);
        let wrong = parameters::wrong(&description.shader, &loaded.shader_places, library, &member.place);
        if let Some(first) = wrong.into_iter().next() {
            return Err(broken(first));
        }
        if self.flags.size == Some(description.film.size) {
            // A crop in pixels is one of the scene's own size.
            description.film.crop = None;
        }
        let goal = self.goal.clone().unwrap_or_else(|| Goal::Samples(vec![description.render.spp]));
        if let Goal::Samples(spp) = &goal {
            description.render.spp = spp.last().copied().unwrap_or(description.render.spp);
        }
        let key = self.key(&description, member, &goal, code, &files);
        let keys = Numbering::default().keys(&description, code);
        Ok(Subject { member: member.clone(), is_reference: false, description, code, goal, keys, key, read })
    }

    /// The reference's own film, where it has one.
    fn reference(&self, found: &[Found]) -> Option<Found> {
        let Chosen { member, spp: Some(spp) } = self.family.reference.as_ref()? else { return None };
        let subject = found.iter().flatten().find(|subject| subject.member.name == *member)?;
        let mut description = subject.description.clone();
        description.render.seed ^= REFERENCE_SEED;
        description.render.spp = *spp;
        let goal = Goal::Samples(vec![*spp]);
        let key = format!("{:016x}", hash((&subject.key, description.render, &goal)));
        let Subject { member, code, keys, .. } = subject;
        let (member, code, keys) = (member.clone(), *code, *keys);
        Some(Ok(Subject { member, is_reference: true, description, code, goal, keys, key, read: 0 }))
    }

    /// Of what the picture follows from: this program, all files by their contents, shaders, settings, and when it is done.
    fn key(
        &mut self,
        scene: &SceneDescription,
        member: &Member,
        goal: &Goal,
        code: usize,
        files: &[PathBuf],
    ) -> String {
        let defines: Vec<(&str, &str)> = member.defines.iter().map(|d| (d.path.as_str(), d.value.as_str())).collect();
        let mut digests = Vec::new();
        for file in files {
            let digest = self.digests.entry(file.clone()).or_insert_with(|| Digest::of(file).ok());
            digests.push((file.display().to_string(), *digest));
        }
        let modules = self.codes.library(code).hashes();
        let settings = (scene.film, scene.render, &scene.active, goal);
        let all = (env!("CARGO_PKG_VERSION"), settings, defines, digests, modules);
        format!("{:016x}", hash(all))
    }
}

/// The files of subjects that are to be made, in the order that shares the most.
pub fn order(found: &[Found]) -> Vec<usize> {
    let keys = |index: &usize| found[*index].as_ref().ok().map(|subject| subject.keys);
    let mut order: Vec<usize> = (0..found.len()).filter(|index| found[*index].is_ok()).collect();
    order.sort_by_key(keys);
    order
}
