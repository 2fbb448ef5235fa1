//! The Python that has Mitsuba.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::error::PeerError;

/// Where one is looked for, if none is named.
const NAMES: [&str; 2] = ["python3", "python"];

/// The earliest version that reads what is written for it.
const LEAST: [u32; 2] = [3, 5];

/// Prints the version, and imports all that is needed.
const PROBE: &str = "import mitsuba; print(mitsuba.__version__)";

/// A Python that imports Mitsuba.
#[derive(Clone, Debug)]
pub struct Python {
    pub path: PathBuf,
    /// Of Mitsuba.
    pub version: String,
}

/// The one that is named, or the first that has Mitsuba.
pub fn find(named: Option<&Path>) -> Result<Python, PeerError> {
    if let Some(path) = named {
        return probe(path);
    }
    let mut tried = Vec::new();
    for name in NAMES {
        match probe(Path::new(name)) {
            Err(PeerError::NoPython { .. }) => tried.push(format!("{name} is not there")),
            Err(PeerError::NoMitsuba { .. }) => tried.push(format!("{name} has no module of that name")),
            other => return other,
        }
    }
    Err(PeerError::NoneFound { tried: tried.join(", ") })
}

/// Asks a Python for its Mitsuba.
fn probe(path: &Path) -> Result<Python, PeerError> {
    let mut command = Command::new(path);
    command.args(["-c", PROBE]).stdin(Stdio::null());
    let output = command.output().map_err(|source| PeerError::NoPython { path: path.to_path_buf(), source })?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
    let (said, wrong) = (text(&output.stdout), text(&output.stderr));
    if !output.status.success() {
        let last = wrong.lines().last().unwrap_or("it said nothing").to_owned();
        return Err(PeerError::NoMitsuba { path: path.to_path_buf(), last });
    }
    // Whatever else is printed comes before.
    let version = said.lines().last().unwrap_or_default().to_owned();
    match numbers(&version) {
        Some(found) if found >= LEAST => Ok(Python { path: path.to_path_buf(), version }),
        _ => {
            let least = LEAST.map(|number| number.to_string()).join(".");
            Err(PeerError::TooOld { path: path.to_path_buf(), version, least })
        }
    }
}

/// The first two numbers of a version.
pub fn numbers(version: &str) -> Option<[u32; 2]> {
    let mut parts = version.split('.').map(|part| part.parse().ok());
    Some([parts.next()??, parts.next()??])
}
