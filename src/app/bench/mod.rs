//! Benchmarks. Of single stages: medians over runs after warm-up, GPU time by pass, as a table or as JSON. Of light
//! transport as a whole: [`light`]; beside another renderer: [`peers`].

mod arguments;
pub mod build;
pub mod extend;
pub mod light;
pub mod peers;
pub mod skip;
pub mod sort;

pub use arguments::BenchArguments;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;

use super::Failure;
use crate::app::shared::output::{self, FOLDER_FLAG, Unwritten};
use crate::engine::EngineError;
use crate::gpu::{GpuError, Runtime};
use crate::image::SaveError;
use crate::layout::tree::Triangle;
use crate::oracle::OracleError;
use crate::passes::Recording;
use crate::scene::generate;
use peers::PeerError;

/// Runs before the first that counts: GPUs clock up only under load.
const WARM_UP: u32 = 5;

/// Fewer runs than this make no median worth stating.
pub const LEAST_RUNS: u32 = 10;

/// Why a benchmark gave no figures.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum BenchError {
    #[error(transparent)]
    #[diagnostic(transparent)]
    Gpu(#[from] GpuError),
    #[error("wrong result: {0}")]
    Wrong(String),
    #[error("no JSON: {0}")]
    Json(#[from] serde_json::Error),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Print(#[from] Unwritten),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    #[diagnostic(help("choose another folder with {FOLDER_FLAG}"))]
    Save(#[from] SaveError),
    #[error("{}: {source}", path.display())]
    File { path: PathBuf, source: std::io::Error },
    #[error("{}: this is no bench.json: {source}", path.display())]
    #[diagnostic(help("name the bench.json that `lucerna bench` wrote"))]
    Earlier { path: PathBuf, source: serde_json::Error },
    #[error(transparent)]
    #[diagnostic(transparent)]
    Peer(#[from] PeerError),
    #[error("no reference: {0}")]
    Oracle(#[from] OracleError),
}

impl From<BenchError> for Failure {
    fn from(error: BenchError) -> Self {
        match error {
            BenchError::Gpu(error) => error.into(),
            BenchError::Engine(error) => Self::engine(error),
            other => Self::of(other),
        }
    }
}

impl BenchError {
    /// Of a file that can't be read or written.
    fn file(path: &Path, source: std::io::Error) -> Self {
        Self::File { path: path.to_path_buf(), source }
    }
}

/// Statistics of one quantity over the runs, in milliseconds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    pub name: String,
    pub median: f64,
    pub min: f64,
    pub max: f64,
}

/// One case of a benchmark.
#[derive(Clone, Debug, Serialize)]
pub struct Case {
    /// What was run, as `8388608 pairs`.
    pub name: String,
    /// Items processed by a run.
    pub items: u64,
    /// The passes, each with all its dispatches, and then the wholes.
    pub rows: Vec<Row>,
    /// Items a second by the median of the last row.
    pub rate: f64,
    /// Unit of `rate`, as `pairs/s`.
    pub unit: &'static str,
    /// Figures that are no times, by name.
    pub notes: BTreeMap<String, f64>,
}

/// What a benchmark found out.
#[derive(Clone, Debug, Serialize)]
pub struct BenchReport {
    pub bench: &'static str,
    pub adapter: String,
    pub runs: u32,
    pub cases: Vec<Case>,
}

impl Row {
    /// Median (of an even number, the mean of the two in the middle), least and greatest. Zeros if there are none.
    pub fn of(name: &str, milliseconds: &[f64]) -> Self {
        let mut sorted = milliseconds.to_vec();
        sorted.sort_by(f64::total_cmp);
        let n = sorted.len();
        let median = if n == 0 { 0.0 } else { (sorted[(n - 1) / 2] + sorted[n / 2]) / 2.0 };
        let at = |i: usize| sorted.get(i).copied().unwrap_or(0.0);
        Self { name: name.to_owned(), median, min: at(0), max: at(n.wrapping_sub(1)) }
    }
}

impl Case {
    /// A case whose rate is stated by its last row.
    pub fn new(name: String, items: u64, unit: &'static str, rows: Vec<Row>) -> Self {
        let median = rows.last().map_or(0.0, |row| row.median);
        let rate = if median > 0.0 { items as f64 / median * 1e3 } else { 0.0 };
        Self { name, items, rows, rate, unit, notes: BTreeMap::new() }
    }

    /// Adds a figure that is no time.
    pub fn note(mut self, name: &str, value: f64) -> Self {
        self.notes.insert(name.to_owned(), value);
        self
    }

    fn table(&self) -> String {
        let width = self.rows.iter().map(|row| row.name.len()).max().unwrap_or(0).max(self.name.len());
        let mut text = format!("{:width$}  {:>10}  {:>10}  {:>10}  ms\n", self.name, "median", "min", "max");
        for row in &self.rows {
            text +=
                &format!("  {:w$}  {:10.4}  {:10.4}  {:10.4}\n", row.name, row.median, row.min, row.max, w = width - 2);
        }
        text += &format!("  {:.1} M{}\n", self.rate * 1e-6, self.unit);
        for (name, value) in &self.notes {
            text += &format!("  {name}: {value}\n");
        }
        text
    }
}

impl BenchReport {
    /// Prints all cases to stdout, as a table or as one JSON object.
    pub fn print(&self, json: bool) -> Result<(), BenchError> {
        let text = if json { serde_json::to_string(self)? + "\n" } else { self.table() };
        Ok(output::write(&text)?)
    }

    fn table(&self) -> String {
        let head = format!("{}: {}, {} runs\n", self.bench, self.adapter, self.runs);
        let cases = self.cases.iter().map(|case| format!("\n{}", case.table()));
        std::iter::once(head).chain(cases).collect()
    }
}

/// Generated spheres as the passes take triangles, of material 0.
fn spheres(count: u32, seed: u64) -> Vec<Triangle> {
    let corners = generate::spheres(count, seed);
    corners.into_iter().zip(0..).map(|([a, b, c], index)| Triangle { a, b, c, index, ..Triangle::default() }).collect()
}

/// Plays `before` and then `timed`, again and again, and times the latter on the GPU: a row a pass in order of its first
/// dispatch, and `in all`, from the first timestamp of a run to the last. Without timestamps, only `wall clock`.
pub fn measure(rig: &mut Runtime, before: &Recording, timed: &Recording, runs: u32) -> Result<Vec<Row>, BenchError> {
    rig.set_timing(true);
    let mut passes: BTreeMap<&'static str, Vec<f64>> = BTreeMap::new();
    let (mut spans, mut walls) = (Vec::new(), Vec::new());
    for run in 0..WARM_UP + runs {
        rig.play(before)?;
        rig.wait()?;
        rig.timings()?;
        rig.spans()?;
        let start = Instant::now();
        rig.play(timed)?;
        rig.wait()?;
        let wall = start.elapsed().as_secs_f64() * 1e3;
        let (timings, span) = (rig.timings()?, rig.spans()?);
        if run < WARM_UP {
            continue;
        }
        walls.push(wall);
        spans.extend(span);
        for timing in timings {
            passes.entry(timing.name).or_default().push(timing.milliseconds);
        }
    }
    rig.set_timing(false);
    let mut rows: Vec<Row> = Vec::new();
    for call in timed.calls() {
        if let Some(times) = passes.remove(call.pass.name) {
            rows.push(Row::of(call.pass.name, &times));
        }
    }
    match spans.is_empty() {
        true => rows.push(Row::of("wall clock", &walls)),
        false => rows.push(Row::of("in all", &spans)),
    }
    Ok(rows)
}

/// As [`measure`], without any timestamp between dispatches: the wall clock of `repeats` rounds of `before` and `timed`
/// in one submission, less that of as many of `before` alone, by round. For whole recordings of short dispatches.
pub fn measure_unstamped(
    rig: &mut Runtime,
    before: &Recording,
    timed: &Recording,
    runs: u32,
    repeats: u32,
) -> Result<Row, BenchError> {
    let (mut both, mut alone) = (Recording::default(), Recording::default());
    for _ in 0..repeats {
        both.extend(before.clone());
        both.extend(timed.clone());
        alone.extend(before.clone());
    }
    let mut times = Vec::new();
    for run in 0..WARM_UP + runs {
        let mut wall = [0.0; 2];
        for (recording, wall) in [&alone, &both].into_iter().zip(&mut wall) {
            rig.wait()?;
            let start = Instant::now();
            rig.play(recording)?;
            rig.wait()?;
            *wall = start.elapsed().as_secs_f64() * 1e3;
        }
        if run >= WARM_UP {
            times.push((wall[1] - wall[0]) / f64::from(repeats));
        }
    }
    Ok(Row::of("in all, without timestamps", &times))
}
