//! JSON of an earlier benchmark.

use std::path::Path;

use crate::app::bench::BenchError;
use crate::files;

/// Bytes that a file of an earlier benchmark may have.
const LIMIT: u64 = 256 << 20;

/// Reads a file of an earlier benchmark, or of anything else in JSON.
pub fn read_json<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, BenchError> {
    let bytes = files::read(path, LIMIT).map_err(|source| BenchError::file(path, source))?;
    serde_json::from_slice(&bytes).map_err(|source| BenchError::Earlier { path: path.to_path_buf(), source })
}
