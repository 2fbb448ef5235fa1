//! What drivers compiled, kept between starts: a file a pipeline, in the user's folder of caches.
//!
//! Drivers have caches of their own, but not on every machine, and compiling the trace kernels takes half of a first picture's time on a
//! GPU. A file here is what the driver gives of one pipeline. It says of which device, driver and code it is, so one that is found under a wrong
//! name costs a compile and no more. Damage is seen by a checksum, for a driver may trust what it is given.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::files;

/// The environment variable that names another folder, or says `off`.
const VARIABLE: &str = "LUCERNA_PIPELINE_CACHE";

/// Files of all devices and drivers that are kept at most: those that were written longest ago go first. Each has some 100 KiB.
const MOST_FILES: usize = 512;

/// Bytes of a file that is read at most.
const MOST_BYTES: u64 = 64 << 20;

/// Where the pipelines of a device are kept.
pub(super) struct PipelineCache {
    folder: PathBuf,
}

/// One pipeline's part of it, while that pipeline is made.
pub(super) struct Slot {
    pub cache: wgpu::PipelineCache,
    /// There was a file of this pipeline.
    pub found: bool,
    file: PathBuf,
    /// What that file held.
    before: Option<Vec<u8>>,
}

/// What the environment asks for: a folder, or none at all.
enum Asked {
    Nothing,
    Off,
    Folder(PathBuf),
}

fn asked() -> Asked {
    match std::env::var_os(VARIABLE).filter(|text| !text.is_empty()) {
        None => Asked::Nothing,
        Some(text) if text == "off" => Asked::Off,
        Some(folder) => Asked::Folder(folder.into()),
    }
}

impl PipelineCache {
    /// That of an adapter. Drivers that draw on the processor keep what they make by themselves, so there it has to be asked for.
    pub fn of(info: &wgpu::AdapterInfo, features: wgpu::Features) -> Option<Self> {
        let able = features.contains(wgpu::Features::PIPELINE_CACHE);
        let device = wgpu::util::pipeline_cache_key(info).filter(|_| able)?;
        let folder = match asked() {
            Asked::Off => None,
            Asked::Folder(folder) => Some(folder),
            Asked::Nothing if info.device_type == wgpu::DeviceType::Cpu => None,
            Asked::Nothing => Some(dirs::cache_dir()?.join("lucerna").join("pipelines")),
        }?;
        let driver = hash(&(&info.name, &info.driver, &info.driver_info));
        Some(Self { folder: folder.join(format!("{device}-{driver:016x}")) })
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The part of the pipeline of a pass whose code has this fingerprint.
    pub fn slot(&self, device: &wgpu::Device, pass: &str, fingerprint: u64) -> Slot {
        let file = self.file(pass, fingerprint);
        let before = files::read(&file, MOST_BYTES).ok().and_then(|bytes| unsealed(&bytes).map(<[u8]>::to_vec));
        let descriptor = wgpu::PipelineCacheDescriptor { label: Some(pass), data: before.as_deref(), fallback: true };
        // SAFETY: the data are what `get_data` gave, by the checksum before them; wgpu sees to it that they are of this device and driver.
        let cache = unsafe { device.create_pipeline_cache(&descriptor) };
        Slot { cache, found: before.is_some(), file, before }
    }

    /// Drops what is kept of a pipeline.
    pub fn remove(&self, pass: &str, fingerprint: u64) {
        // Another process may have done so.
        let _ = fs::remove_file(self.file(pass, fingerprint));
    }

    fn file(&self, pass: &str, fingerprint: u64) -> PathBuf {
        self.folder.join(format!("{}-{fingerprint:016x}.bin", pass.replace(' ', "-")))
    }
}

impl Slot {
    /// Keeps what the driver made, if it is not there yet. That it can't be kept is no reason to fail.
    pub fn keep(self) {
        let Some(made) = self.cache.get_data().filter(|made| self.before.as_ref() != Some(made)) else { return };
        let Some(folder) = self.file.parent() else { return };
        let written = || -> std::io::Result<()> {
            fs::create_dir_all(folder)?;
            let mut file = tempfile::NamedTempFile::new_in(folder)?;
            file.write_all(&sealed(&made))?;
            file.persist(&self.file)?;
            Ok(())
        };
        if let (Ok(()), Some(all)) = (written(), folder.parent()) {
            drop_oldest(all, MOST_FILES);
        }
    }
}

/// The bytes of a file: those given, behind their checksum.
fn sealed(bytes: &[u8]) -> Vec<u8> {
    let mut file = hash(bytes).to_le_bytes().to_vec();
    file.extend_from_slice(bytes);
    file
}

/// What is behind the checksum, if it is right.
fn unsealed(file: &[u8]) -> Option<&[u8]> {
    let (sum, bytes) = file.split_first_chunk::<8>()?;
    (u64::from_le_bytes(*sum) == hash(bytes)).then_some(bytes)
}

/// Removes files of the folders in a folder until so many are left, those that were written longest ago first.
fn drop_oldest(all: &Path, most: usize) {
    let entries = |folder: &Path| fs::read_dir(folder).into_iter().flatten().flatten();
    let written = |file: fs::DirEntry| Some((file.metadata().ok()?.modified().ok()?, file.path()));
    let folders: Vec<PathBuf> = entries(all).map(|folder| folder.path()).collect();
    let mut files: Vec<(SystemTime, PathBuf)> =
        folders.iter().flat_map(|folder| entries(folder)).filter_map(written).collect();
    files.sort();
    let spare = files.len().saturating_sub(most);
    for (_, file) in &files[..spare] {
        // Another process may have removed it.
        let _ = fs::remove_file(file);
    }
}

fn hash(value: &(impl Hash + ?Sized)) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}
