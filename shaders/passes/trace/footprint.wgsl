// What of a texture a path's ray covers: a cone through all bounces (Akenine-Moeller, Crassin, Boksansky, Belcour, Panteleev, Wright: Improved
// Shader and Texture Level of Detail Using Ray Cones, JCGT 10(1), 2021), widened by curvature and by what the surface spreads.

import package::gen::{CornerUvs, Hit, MaterialMaps, PathState, POINT, TEXTURE_DIMENSIONS, TEXTURE_DIMENSIONS_PER_BOUNCE, Triangle};
import package::lib::bsdf::frame::{BsdfSample};
import package::lib::math::{largest_of};
import package::lib::rng::{sample_4d};
import package::lib::texture::{TexturePoint};
import package::passes::trace::textures::{load_maps, load_uvs, texture_point};

// Cosine of the greatest slant that a footprint follows.
const LEAST_SLANT: f32 = 1e-3;

// A footprint that covers more pictures than these along its axis is not followed.
const LONGEST: f32 = 65536.0;

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

// A cone that meets a surface at a slant covers an ellipse of it. How its long axis is longer than its short one, in texture coordinates.
// `unit` is the triangle's normal; the short axis is `width` long, scene units.
fn long_axis(triangle: Triangle, corners: CornerUvs, unit: vec3<f32>, direction: vec3<f32>, width: f32) -> vec2<f32> {
    let ab = triangle.b - triangle.a;
    let ac = triangle.c - triangle.a;
    // So that squares neither overflow nor vanish.
    let size = max(largest_of(abs(ab)), largest_of(abs(ac)));
    let slant = dot(unit, direction);
    let ahead = (direction - slant * unit) * (width / (size * max(abs(slant), LEAST_SLANT)));
    let area = dot(cross(ab / size, ac / size), unit);
    let b1 = dot(cross(ahead, ac / size), unit) / area;
    let b2 = dot(cross(ab / size, ahead), unit) / area;
    let along = b1 * corners.b + b2 * corners.c;
    // Also false where that is no number.
    return select(vec2<f32>(0.0), along, largest_of(abs(vec3<f32>(along, 0.0))) < LONGEST);
}

fn texturing_at(state: PathState, triangle: Triangle, hit: Hit, area_normal: vec3<f32>) -> Texturing {
    let unit = normalize(area_normal / largest_of(abs(area_normal)));
    let width = state.cone_width + state.cone_spread * hit.t;
    let corners = load_uvs(triangle.index);
    var point = texture_point(corners, hit.b1, hit.b2);
    if (width > 0.0) {
        point.width = log2(max(width, 1e-30)) + corners.density;
        point.along = long_axis(triangle, corners, unit, state.direction, width);
    }
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
    return TexturePoint(point.corner, point.offset, select(point.width, POINT, exactly), select(point.along, vec2<f32>(0.0), exactly));
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
