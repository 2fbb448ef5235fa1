//! What is seen first through the middle of every pixel. The twin of `passes/trace/view`.

use glam::{DVec3, UVec2, Vec3};

use super::intersect::{Fma, triangle_normal};
use super::normals::smooth_normal;
use super::texture::{TextureSet, level_of, nearest_texel};
use super::textured::Cone;
use super::traverse::closest_hit_of;
use super::tree::Tree;
use crate::image::srgb::srgb_byte;
use crate::layout::ray::{Hit, NO_HIT, Ray, T_FAR};
use crate::layout::texture::{TEXEL_KIND, TEXEL_SLOPES};
use crate::layout::trace::{MaterialRecord, Shading, TraceParams};
use crate::layout::tree::Triangle;
use crate::layout::view::{
    VIEW_ALBEDO, VIEW_COST, VIEW_DEPTH, VIEW_LEVEL, VIEW_MATERIAL, VIEW_MOST_LEVELS, VIEW_MOST_STEPS, VIEW_NORMAL,
    VIEW_TEXEL, VIEW_UV, ViewParams,
};

/// A scene as the pass gets it.
pub struct ViewScene<'a> {
    pub tree: &'a Tree,
    pub materials: &'a [MaterialRecord],
    /// In scene order; empty: geometric normals everywhere.
    pub shading: &'a [Shading],
    pub textures: TextureSet<'a>,
    pub fma: Fma,
}

/// The camera's ray through the middle of a pixel of the window, and of its lens.
pub fn middle_ray(trace_params: &TraceParams, pixel: UVec2) -> Ray {
    Ray {
        origin: trace_params.position,
        t_min: 0.0,
        direction: through_middle(trace_params, pixel).normalize(),
        t_max: T_FAR,
    }
}

/// Its direction, of length 1 along the viewing axis.
pub fn through_middle(trace_params: &TraceParams, pixel: UVec2) -> Vec3 {
    let at = UVec2::new(trace_params.window_x, trace_params.window_y).as_vec2() + pixel.as_vec2() + 0.5;
    let film = UVec2::new(trace_params.film_width, trace_params.film_height).as_vec2();
    let (x, y) = (2.0 * at.x / film.x - 1.0, 1.0 - 2.0 * at.y / film.y);
    trace_params.forward + x * trace_params.right + y * trace_params.up
}

impl ViewScene<'_> {
    /// A picture word a pixel: r in the lowest byte, a = 255 in the highest.
    pub fn view(&self, params: &ViewParams) -> Vec<u32> {
        let trace_params = &params.trace_params;
        let pixels =
            (0..trace_params.window_height).flat_map(|y| (0..trace_params.window_width).map(move |x| UVec2::new(x, y)));
        pixels.map(|pixel| self.seen(params, &middle_ray(trace_params, pixel))).collect()
    }

    fn seen(&self, params: &ViewParams, ray: &Ray) -> u32 {
        let hit = closest_hit_of(self.fma, ray, self.tree, &|triangle, hit| {
            self.textures.is_there(triangle.material, triangle.index, weights(hit), [0.5; 2])
        });
        if hit.triangle == NO_HIT {
            return word([0; 3]);
        }
        let triangle = &self.tree.leaves[hit.leaf as usize];
        word(match params.mode {
            VIEW_ALBEDO => {
                let material = &self.materials[triangle.material as usize];
                let maps = self.textures.maps(triangle.material);
                let point = self.textures.point(triangle.index, weights(&hit));
                let part = |map: u32| if map == 0 { DVec3::ONE } else { self.textures.colour(map, point, 0.5) };
                let (kd, ks) =
                    (material.kd.as_dvec3() * part(maps.diffuse), material.ks.as_dvec3() * part(maps.specular));
                (kd + ks).to_array().map(srgb_byte)
            }
            VIEW_NORMAL => normal_colour(self.normal(triangle, &hit, ray.direction)),
            VIEW_DEPTH => [depth_code(params.reach, hit.t); 3],
            VIEW_MATERIAL => material_colour(triangle.material),
            VIEW_COST => heat(hit.steps, VIEW_MOST_STEPS),
            VIEW_UV if !self.textures.maps.is_empty() => {
                let uv = self.textures.point(triangle.index, weights(&hit)).uv;
                [code(uv.x - uv.x.floor()), code(uv.y - uv.y.floor()), 0]
            }
            VIEW_TEXEL if self.first_map(triangle) != 0 => self.texel(triangle, &hit),
            VIEW_LEVEL if self.first_map(triangle) != 0 => {
                heat((self.level(params, triangle, &hit) * 64.0) as u32, 64 * VIEW_MOST_LEVELS)
            }
            _ => [0; 3],
        })
    }

    fn first_map(&self, triangle: &Triangle) -> u32 {
        self.textures.maps(triangle.material).shown
    }

    /// The texel of the first map, as light; slopes are shown about a grey.
    fn texel(&self, triangle: &Triangle, hit: &Hit) -> [u8; 3] {
        let t = self.textures.record(self.first_map(triangle));
        let place = nearest_texel(t, self.textures.point(triangle.index, weights(hit)));
        let texel = self.textures.texel(t, place).truncate();
        let slopes = t.format & TEXEL_KIND == TEXEL_SLOPES;
        let shown = if slopes { 0.5 + 0.5 * f64::from(t.gain) * texel } else { texel };
        shown.to_array().map(srgb_byte)
    }

    /// The level of the first map that the camera's footprint asks for.
    fn level(&self, params: &ViewParams, triangle: &Triangle, hit: &Hit) -> f64 {
        let cone = Cone { width: 0.0, spread: params.trace_params.cone_spread.into() };
        let t = self.textures.record(self.first_map(triangle));
        level_of(t, self.textures.point_with(triangle.index, weights(hit), cone.width_at(hit.t.into()), [0.0; 2]))
    }

    fn normal(&self, triangle: &Triangle, hit: &Hit, direction: Vec3) -> DVec3 {
        let area_normal = triangle_normal(self.fma, triangle.a, triangle.b, triangle.c).as_dvec3().normalize_or_zero();
        let geometric = if area_normal.dot(direction.as_dvec3()) > 0.0 { -area_normal } else { area_normal };
        let corners = self.shading.get(triangle.index as usize);
        let smooth = corners.and_then(|corners| smooth_normal(corners, [f64::from(hit.b1), f64::from(hit.b2)]));
        smooth.map_or(geometric, |n| if n.dot(geometric) < 0.0 { -n } else { n })
    }
}

fn weights(hit: &Hit) -> [f64; 2] {
    [hit.b1.into(), hit.b2.into()]
}

fn word([r, g, b]: [u8; 3]) -> u32 {
    u32::from_le_bytes([r, g, b, 255])
}

fn code(value: f64) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// The grey of a distance: white at the camera, half at `reach`; both in one unit.
pub fn depth_code(reach: f32, distance: f32) -> u8 {
    code(f64::from(reach) / (f64::from(reach) + f64::from(distance)))
}

/// The colour of a normal, unit length.
pub fn normal_colour(normal: DVec3) -> [u8; 3] {
    normal.to_array().map(|v| code(0.5 * v + 0.5))
}

/// A colour that is not dark, from a hash of the material's index (PCG: O'Neill 2014).
pub fn material_colour(index: u32) -> [u8; 3] {
    let state = index.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let mixed = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    let hash = (mixed >> 22) ^ mixed;
    [0, 8, 16].map(|shift| (64 + ((hash >> shift) & 0xff) * 3 / 4) as u8)
}

/// From black by red and yellow to white.
pub fn heat(part: u32, most: u32) -> [u8; 3] {
    let v = part.min(most) * 768 / most;
    [0, 256, 512].map(|from| v.saturating_sub(from).min(255) as u8)
}
