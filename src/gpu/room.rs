//! What to do about an array that a device has no room for: what of the scene it grows with, and how much of that there can be.

use crate::layout::cdf::CdfEntry;
use crate::layout::film::{FilmPixel, RobustPixel};
use crate::layout::light::LightRecord;
use crate::layout::texture::{CornerUvs, MaterialMaps, Tangents, TextureRecord};
use crate::layout::trace::{GatherPoint, LentPoint, MaterialRecord, RadianceSample, Shading};
use crate::layout::tree::Triangle;
use crate::passes::tree::PLAN;

/// What a buffer has an element for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Grows {
    /// Every pixel of the environment's picture.
    Sky,
    /// Every pixel of the film.
    Film,
    Triangles,
    Lights,
    Materials,
    /// Words of textures.
    Textures,
    Rays,
}

/// What a buffer grows with, and the bytes of one of that.
fn growth(name: &str) -> Option<(Grows, usize)> {
    Some(match name {
        "sky" => (Grows::Sky, size_of::<glam::Vec4>()),
        "sky_cdf" => (Grows::Sky, size_of::<CdfEntry>()),
        "film" => (Grows::Film, size_of::<FilmPixel>()),
        "blocks" => (Grows::Film, size_of::<RobustPixel>()),
        "gather_points" => (Grows::Film, size_of::<GatherPoint>()),
        "lent_points" => (Grows::Film, size_of::<LentPoint>()),
        "gather_materials" => (Grows::Film, size_of::<MaterialRecord>()),
        "radiance" => (Grows::Film, size_of::<RadianceSample>()),
        "picture" => (Grows::Film, 4),
        "debug_colours" | "probe_values" => (Grows::Film, size_of::<glam::Vec4>()),
        "triangles" => (Grows::Triangles, size_of::<Triangle>()),
        "shading" => (Grows::Triangles, size_of::<Shading>()),
        "lights" => (Grows::Lights, size_of::<LightRecord>()),
        "materials" => (Grows::Materials, size_of::<MaterialRecord>()),
        "material_maps" => (Grows::Materials, size_of::<MaterialMaps>()),
        "textures" => (Grows::Textures, size_of::<TextureRecord>()),
        "texels" => (Grows::Textures, 4),
        "uvs" => (Grows::Triangles, size_of::<CornerUvs>()),
        "tangents" => (Grows::Triangles, size_of::<Tangents>()),
        "mean_emission" => (Grows::Triangles, 4),
        "rays" | "hits" | "occlusion" => (Grows::Rays, size_of::<crate::layout::ray::Ray>()),
        _ => (Grows::Triangles, tree_growth(name)?),
    })
}

/// Bytes of a buffer of the tree for each triangle; none where that is less than one.
fn tree_growth(name: &str) -> Option<usize> {
    const MANY: u32 = 1 << 20;
    let bytes = (PLAN.bytes(name, 2 * MANY) - PLAN.bytes(name, MANY)) / u64::from(MANY);
    (bytes > 0).then_some(bytes as usize)
}

/// What to do where a buffer is larger than `limit` bytes.
pub fn advice(name: &str, limit: u64) -> String {
    let Some((grows, bytes)) = growth(name) else {
        return format!("{}, or an adapter with larger buffers (`lucerna doctor`)", smaller(name));
    };
    let most = limit / bytes as u64;
    let fits = match grows {
        // The sphere by longitude and latitude is twice as wide as high.
        Grows::Sky => format!("one of {}x{} pixels fits", 2 * (most / 2).isqrt(), (most / 2).isqrt()),
        Grows::Film if name == "blocks" => format!("robust means of {most} pixels fit, such as {0}x{0}", most.isqrt()),
        Grows::Film => {
            format!("{most} pixels fit, such as {0}x{0}; `lucerna render` makes larger ones in bands", most.isqrt())
        }
        _ => format!("about {most} fit"),
    };
    format!("{}: {fits}; or an adapter with larger buffers (`lucerna doctor`)", smaller(name))
}

/// What to do where a buffer finds no room.
pub fn smaller(name: &str) -> &'static str {
    match growth(name).map(|(grows, _)| grows) {
        Some(Grows::Sky) => "use a smaller picture of the environment",
        Some(Grows::Film) => "use a smaller film (`--size`), or a part of it (`--crop`)",
        Some(Grows::Triangles) => "use fewer triangles",
        Some(Grows::Lights) => "use fewer triangles that emit, or fewer point lights",
        Some(Grows::Materials) => "use fewer materials",
        Some(Grows::Textures) => "use smaller textures (`--texture-size`)",
        Some(Grows::Rays) => "ask for fewer rays",
        None => "use a smaller scene or film",
    }
}
