//! The scene's own surfaces, held to what their code says of itself: run on the device, judged by [`cpu::lint`](crate::cpu::lint).

use std::fmt;
use std::sync::Arc;

use glam::{DVec3, Vec4};

use crate::cpu::lint::{DRAWS, Flaw, POINTS, Trial};
use crate::gpu::{Gpu, GpuError, Runtime, Values};
use crate::layout::lint::{LintAnswer, LintCase, LintParams};
use crate::layout::trace::MaterialRecord;
use crate::passes::trace::Needs;
use crate::passes::{Recording, lint};
use crate::shader::Library;

/// Kinds of surface that one lint looks at.
const MOST_KINDS: usize = 8;

/// Where surfaces are seen from, degrees from the normal.
pub const VIEWS: [f64; 3] = [10.0, 50.0, 80.0];

/// What is linted.
#[derive(Clone, Copy, Debug)]
pub struct Surfaces<'a> {
    /// By name.
    pub materials: &'a [(String, MaterialRecord)],
    /// Pixels use each other's paths.
    pub reused: bool,
}

/// A flaw, and where it shows first.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    pub flaw: Flaw,
    /// The material's name.
    pub material: String,
    /// From the normal.
    pub degrees: f64,
    /// Kinds of surface and views that show such a flaw too.
    pub others: usize,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, for material `{}` seen at {} degrees", self.flaw, self.material, self.degrees)?;
        match self.others {
            0 => Ok(()),
            others => write!(f, " (and in {others} more cases)"),
        }
    }
}

/// The materials that differ in more than numbers, of each kind the one that reflects most.
pub fn kinds(materials: &[(String, MaterialRecord)]) -> Vec<&(String, MaterialRecord)> {
    let width = |m: &MaterialRecord| match m.has_phong() {
        true => m.ns.max(1.0).log10() as i32,
        false => m.alpha.max(1e-4).log10() as i32,
    };
    let kind = |m: &MaterialRecord| {
        (
            m.flags,
            m.specular_probability > 0.0,
            m.specular_probability < 1.0,
            m.transparency > 0.0,
            m.has_phong(),
            width(m),
            m.coat > 0.0,
            m.coat_alpha.max(1e-4).log10() as i32,
        )
    };
    let white = |m: &MaterialRecord| (m.kd + m.ks).max_element();
    let mut found: Vec<&(String, MaterialRecord)> = Vec::new();
    for material in materials {
        match found.iter_mut().find(|other| kind(&other.1) == kind(&material.1)) {
            Some(other) if white(&material.1) > white(&other.1) => *other = material,
            Some(_) => {}
            None => found.push(material),
        }
    }
    found.truncate(MOST_KINDS);
    found
}

/// Asks the code of a library for each kind of material, from each of `views`, degrees from the normal, with parameters set to `values`. Each kind of flaw comes once.
///
/// None where `wanted` says no on the way.
pub fn run(
    gpu: &Arc<Gpu>,
    library: Library,
    Surfaces { materials, reused }: Surfaces,
    views: &[f64],
    (seed, values): (u32, &Values),
    wanted: impl Fn() -> bool,
) -> Result<Option<Vec<Finding>>, GpuError> {
    let shown: Vec<_> = kinds(materials).into_iter().flat_map(|kind| views.iter().map(move |at| (kind, *at))).collect();
    let cases: Vec<LintCase> = shown.iter().map(|((_, material), degrees)| case(*material, *degrees)).collect();
    if cases.is_empty() {
        return Ok(Some(Vec::new()));
    }
    let records: Vec<MaterialRecord> = materials.iter().map(|(_, record)| *record).collect();
    let mut runtime = Runtime::new(gpu.clone(), library);
    runtime.set_values(values.clone());
    runtime.set_features(&Needs { materials: &records, reuse: reused, ..Needs::default() }.features());
    runtime.upload("lint_cases", &cases)?;
    let draws = ask(&mut runtime, cases.len(), DRAWS, seed, true)?;
    if !wanted() {
        return Ok(None);
    }
    let trials: Vec<_> = cases.iter().zip(draws.chunks_exact(DRAWS)).map(|(c, d)| Trial::new(c, d, seed)).collect();
    let points: Vec<Vec4> = trials.iter().flat_map(|(_, points)| points).map(|p| p.as_vec3().extend(0.0)).collect();
    runtime.upload("lint_directions", &points)?;
    let answers = ask(&mut runtime, cases.len(), POINTS, seed, false)?;
    if !wanted() {
        return Ok(None);
    }
    let mut findings: Vec<Finding> = Vec::new();
    for (((trial, _), answers), ((name, _), degrees)) in trials.iter().zip(answers.chunks_exact(POINTS)).zip(&shown) {
        for flaw in trial.judge(answers) {
            let same = |other: &&mut Finding| std::mem::discriminant(&other.flaw) == std::mem::discriminant(&flaw);
            match findings.iter_mut().find(same) {
                Some(other) => other.others += 1,
                None => findings.push(Finding { flaw, material: name.clone(), degrees: *degrees, others: 0 }),
            }
        }
    }
    Ok(Some(findings))
}

/// A surface whose normal is along no axis.
fn case(material: MaterialRecord, degrees: f64) -> LintCase {
    let normal = DVec3::new(0.36, -0.48, 0.8).normalize();
    let side = DVec3::new(0.8, 0.6, 0.0);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let wo = (normal * cos + side * sin).normalize().as_vec3();
    LintCase { material, wo, normal: normal.as_vec3(), ..LintCase::default() }
}

fn ask(
    runtime: &mut Runtime,
    cases: usize,
    per_case: usize,
    seed: u32,
    draw: bool,
) -> Result<Vec<LintAnswer>, GpuError> {
    let count = (cases * per_case) as u32;
    for (name, bytes) in lint::buffers(count) {
        runtime.reserve(name, bytes)?;
    }
    let mut recording = Recording::default();
    lint::record(&mut recording, &LintParams { count, per_case: per_case as u32, seed, draw: u32::from(draw) });
    runtime.play(&recording)?;
    let answers = runtime.read_some("lint_answers", count as usize)?;
    runtime.check_loops()?;
    Ok(answers)
}
