//! Structs and constants shared with WGSL, declared once. Does not know wgpu or naga.
//!
//! [`gpu_struct!`](crate::gpu_struct) and [`gpu_consts!`](crate::gpu_consts) declare them; the shader library supplies
//! them as the virtual module `package::gen`, and compares each struct with the layout naga gives it at every link.

#[macro_use]
mod macros;
pub mod adaptive;
pub mod cdf;
pub mod clear;
pub mod film;
pub mod light;
pub mod lint;
pub mod probe;
pub mod ray;
pub mod replay;
pub mod sky;
pub mod sort;
pub mod sources;
pub mod texture;
pub mod trace;
pub mod tree;
mod types;
mod vectors;
pub mod view;
pub mod window;

pub use types::{AtomicWord, ConstValue, FieldLayout, FieldType, GpuConst, GpuField, StructLayout, largest, round_up};
pub use vectors::Vectors;

/// Every struct that WGSL can import from `package::gen`.
pub static ALL: &[&StructLayout] = &[
    &clear::ClearParams::LAYOUT,
    &tree::Triangle::LAYOUT,
    &tree::LeafBox::LAYOUT,
    &tree::Node::LAYOUT,
    &tree::BuildParams::LAYOUT,
    &tree::PyramidParams::LAYOUT,
    &tree::TreeletParams::LAYOUT,
    &ray::Ray::LAYOUT,
    &ray::Hit::LAYOUT,
    &ray::ExtendParams::LAYOUT,
    &cdf::CdfEntry::LAYOUT,
    &light::LightRecord::LAYOUT,
    &light::PointLightRecord::LAYOUT,
    &trace::MaterialRecord::LAYOUT,
    &trace::Shading::LAYOUT,
    &trace::SampleKey::LAYOUT,
    &trace::PathState::LAYOUT,
    &trace::TraceParams::LAYOUT,
    &trace::RadianceSample::LAYOUT,
    &trace::GatherPoint::LAYOUT,
    &trace::LentPoint::LAYOUT,
    &texture::TextureRecord::LAYOUT,
    &texture::MaterialMaps::LAYOUT,
    &texture::CornerUvs::LAYOUT,
    &texture::Tangents::LAYOUT,
    &film::FilmHalf::LAYOUT,
    &film::FilmPixel::LAYOUT,
    &film::RobustPixel::LAYOUT,
    &film::BadSample::LAYOUT,
    &film::FilmCounters::LAYOUT,
    &film::AccumulateParams::LAYOUT,
    &film::DisplayParams::LAYOUT,
    &adaptive::TileSample::LAYOUT,
    &adaptive::TileRun::LAYOUT,
    &adaptive::HalfMark::LAYOUT,
    &adaptive::PixelMark::LAYOUT,
    &adaptive::TallyRun::LAYOUT,
    &adaptive::TileTally::LAYOUT,
    &adaptive::TallyParams::LAYOUT,
    &sort::SortParams::LAYOUT,
    &sort::SortDigit::LAYOUT,
    &sort::SortPlan::LAYOUT,
    &view::ViewParams::LAYOUT,
    &window::WindowParams::LAYOUT,
    &lint::LintCase::LAYOUT,
    &lint::LintAnswer::LAYOUT,
    &lint::LintParams::LAYOUT,
    &replay::PathTurn::LAYOUT,
    &replay::Replayed::LAYOUT,
    &sources::Contribution::LAYOUT,
    &probe::Probed::LAYOUT,
    &probe::ProbeChoice::LAYOUT,
    &probe::ProbeColours::LAYOUT,
];

/// Every struct that WGSL may read by vectors of four words: what unpacks them is imported from `package::gen` as well.
pub static VECTORS: &[Vectors] = &[
    Vectors::of(&tree::Triangle::LAYOUT),
    Vectors::of(&tree::Node::LAYOUT),
    Vectors::of(&light::LightRecord::LAYOUT),
    Vectors::of(&light::PointLightRecord::LAYOUT),
    Vectors::of(&trace::MaterialRecord::LAYOUT),
    Vectors::of(&trace::GatherPoint::LAYOUT),
    Vectors::of(&trace::LentPoint::LAYOUT),
    Vectors::of(&texture::TextureRecord::LAYOUT),
    Vectors::of(&texture::MaterialMaps::LAYOUT),
    Vectors::of(&texture::CornerUvs::LAYOUT),
    Vectors::of(&texture::Tangents::LAYOUT),
];

/// Every constant that WGSL can import from `package::gen`, module by module.
pub static CONSTS: &[&[GpuConst]] = &[
    adaptive::CONSTS,
    cdf::CONSTS,
    tree::CONSTS,
    probe::CONSTS,
    ray::CONSTS,
    replay::CONSTS,
    sources::CONSTS,
    trace::CONSTS,
    texture::CONSTS,
    film::CONSTS,
    sort::CONSTS,
    view::CONSTS,
];
