// What of a texture a path's ray covers: a cone through all bounces (Akenine-Moeller, Crassin, Boksansky, Belcour, Panteleev, Wright: Improved
// Shader and Texture Level of Detail Using Ray Cones, JCGT 10(1), 2021), widened by curvature and by what the surface spreads.

import package::gen::{Hit, MaterialMaps, PathState, POINT, TEXTURE_DIMENSIONS, TEXTURE_DIMENSIONS_PER_BOUNCE, Triangle};
import package::lib::bsdf::mixture::{BsdfSample};
import package::lib::math::{largest_of};
import package::lib::rng::{sample_4d};
import package::lib::texture::{TexturePoint};
import package::passes::trace::textures::{load_maps, load_uvs, texture_point};

// What is known of a hit before a texel is looked up.
struct Texturing {
    maps: MaterialMaps,
    point: TexturePoint,
    curvature: f32,
    // Uniform numbers that draw texels: of both colours, of the lobe and of metalness.
    colours: vec4<f32>,
    // Of relief, of emission, and of the emission of the light that is sampled.
    others: vec4<f32>,
}

// A cone that meets a surface at a slant covers an ellipse of it: its footprint is the circle of the same area.
fn texturing_at(state: PathState, triangle: Triangle, hit: Hit, area_normal: vec3<f32>) -> Texturing {
    let unit = normalize(area_normal / largest_of(abs(area_normal)));
    let slant = max(abs(dot(unit, state.direction)), 1e-3);
    let width = state.cone_width + state.cone_spread * hit.t;
    let corners = load_uvs(triangle.index);
    let point = texture_point(corners, hit.b1, hit.b2, log2(max(width, 1e-30)) - 0.5 * log2(slant));
    let first = TEXTURE_DIMENSIONS + state.bounce * TEXTURE_DIMENSIONS_PER_BOUNCE;
    var texturing = Texturing(load_maps(triangle.material), point, corners.curvature, vec4<f32>(0.0), vec4<f32>(0.0));
    @if(textures) {
        texturing.colours = sample_4d(state.key, first);
    }
    @if(relief || emission_map) {
        texturing.others = sample_4d(state.key, first + 4u);
    }
    return texturing;
}

// The same point, without a footprint if so asked.
fn at_point(point: TexturePoint, exactly: bool) -> TexturePoint {
    return TexturePoint(point.corner, point.offset, select(point.width, POINT, exactly));
}

// How the cone grows behind a surface, where its width is that of the state. What is drawn from a lobe stands for a solid angle of 1 / pdf,
// of which `part` counts; a mirror or a boundary spreads by its curvature; and what passes straight on stays as it is.
fn spread_by(state: PathState, curvature: f32, drawn: BsdfSample, part: f32) -> f32 {
    if (drawn.pdf > 0.0) {
        return max(state.cone_spread, part * inverseSqrt(drawn.pdf));
    }
    let bends = any(drawn.direction != state.direction);
    return state.cone_spread + select(0.0, 2.0 * curvature * state.cone_width, bends);
}
