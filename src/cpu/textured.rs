//! Surfaces whose numbers and normals textures say: the twin of `passes/trace/textured`, `relief` and `footprint`, f64.

use glam::{DVec3, DVec4};

use super::bsdf::{BsdfSample, Reflection, ShadingFrame, Specular};
use super::normals::octahedral_decode;
use super::texture::{TexturePoint, TextureSet, draw_texel};
use crate::layout::texture::{MAPS_PRESERVE, MaterialMaps, TEXEL_KIND, TEXEL_SLOPES, TEXTURE_FLIP_GREEN};
use crate::layout::trace::{SMOOTHEST_ALPHA, luminance};

impl TextureSet<'_> {
    /// A reflection at a point, by four numbers: of both colours, of the lobe and of the metalness.
    pub fn textured(&self, plain: Reflection, maps: &MaterialMaps, point: TexturePoint, u: DVec4) -> Reflection {
        if !maps.changes_lobes() {
            return plain;
        }
        let mut m = plain;
        if maps.diffuse != 0 {
            m.kd *= self.colour(maps.diffuse, point, u.x);
        }
        if maps.specular != 0 {
            m.ks *= self.colour(maps.specular, point, u.y);
        }
        if maps.lobe != 0 {
            let part = self.number(maps.lobe, point, u.z);
            m.specular = match m.specular {
                Specular::Phong(exponent) => Specular::Phong((exponent * part).min(1e5)),
                Specular::Ggx(alpha) => Specular::Ggx((alpha * part * part).clamp(SMOOTHEST_ALPHA.into(), 1.0)),
                Specular::Mirror => Specular::Mirror,
            };
        }
        let mut metalness = f64::from(maps.metalness);
        if maps.metallic != 0 {
            metalness = (metalness * self.number(maps.metallic, point, u.w)).min(1.0);
        }
        m.ks += metalness * m.kd;
        m.kd *= 1.0 - metalness;
        if maps.flags & MAPS_PRESERVE != 0 {
            let scale = (m.kd + m.ks).max_element().max(1.0);
            (m.kd, m.ks) = (m.kd / scale, m.ks / scale);
        }
        let weight = |colour: DVec3| f64::from(luminance(colour.as_vec3()));
        let (diffuse, specular) = (weight(m.kd), weight(m.ks));
        m.specular_probability = if specular > 0.0 { specular / (diffuse + specular) } else { 0.0 };
        m
    }

    /// A unit normal, on the side that the mesh says, bent by the relief of a material; itself where there is none.
    pub fn relieved(
        &self,
        maps: &MaterialMaps,
        point: TexturePoint,
        triangle: u32,
        b: [f64; 2],
        n: DVec3,
        u: f64,
    ) -> DVec3 {
        let corners = self.tangents.get(triangle as usize).copied().unwrap_or_default();
        let words = [corners.t0, corners.t1, corners.t2];
        if maps.relief == 0 || words.contains(&0) {
            return n;
        }
        let [t0, t1, t2] = words.map(octahedral_decode);
        let along = (1.0 - b[0] - b[1]) * t0 + b[0] * t1 + b[1] * t2;
        let across = along - along.dot(n) * n;
        if across.length_squared() < 1e-6 {
            return n;
        }
        let tangent = across.normalize();
        let bitangent = if corners.mirrored != 0 { -n.cross(tangent) } else { n.cross(tangent) };
        let t = self.record(maps.relief);
        let texel = self.texel(t, draw_texel(t, point, u));
        let local = if t.format & TEXEL_KIND == TEXEL_SLOPES {
            DVec3::new(-f64::from(t.gain) * texel.x, -f64::from(t.gain) * texel.y, 1.0)
        } else {
            let n = 2.0 * texel.truncate() - 1.0;
            DVec3::new(n.x, if t.format & TEXTURE_FLIP_GREEN != 0 { -n.y } else { n.y }, n.z.max(1e-3))
        };
        (local.x * tangent + local.y * bitangent + local.z * n).normalize()
    }
}

/// Cosine of the greatest slant that a footprint follows.
const LEAST_SLANT: f64 = 1e-3;

/// The cone of a path: its width where the ray begins, scene units, and how that grows by distance.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cone {
    pub width: f64,
    pub spread: f64,
}

impl Cone {
    /// How wide the cone is at a distance: the short axis of the ellipse that it covers of a surface there.
    pub fn width_at(&self, distance: f64) -> f64 {
        self.width + self.spread * distance
    }

    /// By how much the long axis of that ellipse is longer, in weights of the second and third corner of the triangle.
    pub fn long_axis(&self, distance: f64, corners: [DVec3; 3], direction: DVec3) -> [f64; 2] {
        let (ab, ac) = (corners[1] - corners[0], corners[2] - corners[0]);
        let area_normal = ab.cross(ac);
        let unit = area_normal.normalize();
        let slant = unit.dot(direction);
        let ahead = (direction - slant * unit) * (self.width_at(distance) / slant.abs().max(LEAST_SLANT));
        [ahead.cross(ac), ab.cross(ahead)].map(|part| part.dot(unit) / area_normal.length())
    }

    /// The cone behind a surface at a distance, of which `part` of a drawn solid angle counts.
    pub fn spread_by(self, distance: f64, curvature: f64, frame: &ShadingFrame, drawn: &BsdfSample, part: f64) -> Cone {
        let width = self.width_at(distance);
        let bends = drawn.direction != -frame.wo;
        let spread = match drawn.pdf > 0.0 {
            true => self.spread.max(part / drawn.pdf.sqrt()),
            false => self.spread + if bends { 2.0 * curvature * width } else { 0.0 },
        };
        Cone { width, spread }
    }
}
