//! What the trace kernel shares with WGSL: materials, shading normals, the path state, its parameters and its output.

use glam::Vec3;

gpu_struct! {
    /// What a surface does with light, packed from a material by `prepare`.
    pub struct MaterialRecord {
        /// Diffuse reflectance, linear Rec.709, at least 0.
        pub kd: Vec3,
        /// Exponent of the Phong lobe, 0 to 1e5.
        pub ns: f32,
        /// Reflectance of the specular lobe, linear Rec.709, at least 0.
        pub ks: Vec3,
        /// `MATERIAL_` flags. The specular lobe is Phong's unless one of them says otherwise.
        pub flags: u32,
        /// Emitted radiance, linear Rec.709, at least 0.
        pub emission: Vec3,
        /// Probability of sampling the specular lobe instead of the diffuse one: the luminance of `ks` against that of
        /// `kd` + `ks`. 0 to 1.
        pub specular_probability: f32,
        /// What a crossing of the surface multiplies radiance by, linear Rec.709, each channel 0 to 1.
        pub tf: Vec3,
        /// Index of refraction behind the surface, against 1 before it; at least 1.
        pub ni: f32,
        /// Roughness of the GGX lobe: the root mean square slope of its facets, [`SMOOTHEST_ALPHA`] to 1.
        pub alpha: f32,
        /// Part of all light that passes straight through, and the probability of following it: 0 (opaque) to 1.
        pub transparency: f32,
        /// Part of the surface that has a clear coat, 0 to 1.
        pub coat: f32,
        /// Roughness of the coat, as `alpha`; 0 is a mirror.
        pub coat_alpha: f32,
    }

    /// Corner normals of one triangle, in scene order. World space, octahedral, two snorm16 a word; 0 is none.
    pub struct Shading {
        pub n0: u32,
        pub n1: u32,
        pub n2: u32,
        pub pad: u32,
    }

    /// Which random numbers a path draws: they are a pure function of this and the dimension.
    pub struct SampleKey {
        /// Row times the whole film's width plus column: the same in a crop.
        pub pixel: u32,
        /// Sample index within its half of the film.
        pub index: u32,
        /// Half of the film, 0 or 1.
        pub half: u32,
        pub seed: u32,
    }

    /// A path between two bounces.
    pub struct PathState {
        /// World space relative to the scene's origin.
        pub origin: Vec3,
        /// Ray cone: width at `origin`, scene units.
        pub cone_width: f32,
        /// Unit length.
        pub direction: Vec3,
        /// Ray cone: growth of the width by distance.
        pub cone_spread: f32,
        /// What a unit of radiance along the ray adds to the pixel.
        pub throughput: Vec3,
        /// Path segments before this ray: 0 for the camera's.
        pub bounce: u32,
        /// Gathered so far.
        pub radiance: Vec3,
        /// Rays traced so far.
        pub rays: u32,
        pub key: SampleKey,
        /// Above 0 where `radiance` is not that but the number that went wrong: 1 + the material it went wrong at, or [`NO_MATERIAL`].
        pub fault: u32,
        /// Density by solid angle with which the direction was drawn, before surfaces that it passed straight on; 0 where it could have been no
        /// other.
        pub pdf: f32,
        /// Length of the way since it was drawn, over surfaces that were passed straight on, up to the ray's origin.
        pub passed: f32,
        /// What undoes, for the chance to survive roulette, that radiance is squeezed in dense media: the index of refraction around
        /// the path, squared.
        pub eta_scale: f32,
    }

    /// Parameters of the trace kernel.
    pub struct TraceParams {
        /// Camera, relative to the scene's origin.
        pub position: Vec3,
        /// Whole film, pixels.
        pub film_width: u32,
        /// Through the film's middle, of length 1 along the viewing axis.
        pub forward: Vec3,
        pub film_height: u32,
        /// To the film's right edge at unit distance.
        pub right: Vec3,
        /// Left edge of the rendered window, pixels of the whole film.
        pub window_x: u32,
        /// To the film's top edge at unit distance.
        pub up: Vec3,
        /// Top edge of the rendered window.
        pub window_y: u32,
        /// Radiance where nothing is hit.
        pub environment: Vec3,
        pub window_width: u32,
        pub window_height: u32,
        /// Film sample of layer 0.
        pub first_sample: u32,
        /// Samples of this batch, a layer each.
        pub layers: u32,
        pub seed: u32,
        /// Path segments, at least 1.
        pub max_depth: u32,
        /// Root of the tree, a node reference.
        pub root: u32,
        /// Growth of a camera ray's cone by distance.
        pub cone_spread: f32,
        /// Radiance above this does not fit the film.
        pub largest: f32,
        /// Number of emitting triangles and point lights that are sampled.
        pub lights: u32,
        /// Probability of sampling one of them, and not the sky.
        pub light_share: f32,
        /// Density by area with which a point of a triangle of unit luminance and one side is drawn; 0 where triangles are not sampled.
        pub light_density: f32,
        /// Light samples from `light_share` to this are of the sun, those beyond it of the sky.
        pub sun_end: f32,
        /// The axes of the sky's picture as the scene has them, unit length: this one, its right half.
        pub sky_x: Vec3,
        /// Pixels of the sky.
        pub sky_width: u32,
        /// Its top.
        pub sky_y: Vec3,
        pub sky_height: u32,
        /// Away from its middle.
        pub sky_z: Vec3,
        /// Density by solid angle with which a direction of unit luminance is drawn from the sky.
        pub sky_density: f32,
        /// Middle of the sun's disk, unit length.
        pub sun_direction: Vec3,
        /// Of a unit vector at the disk's edge from its middle: the distance squared. 0 without a sun.
        pub sun_chord_squared: f32,
        /// Radiance of the disk, beside that of the sky; linear Rec.709.
        pub sun_radiance: Vec3,
        /// Density by solid angle with which a direction of the disk is drawn.
        pub sun_density: f32,
        /// By how much surfaces spread the cones of paths: [`CONE_PART`](super::texture::CONE_PART), or 0 where lookups are of points.
        pub cone_part: f32,
        /// Radius of the camera's lens; 0 is a pinhole.
        pub lens_radius: f32,
        /// Distance along the viewing axis at which the lens is sharp.
        pub focus: f32,
        /// Probability with which a point light of unit power is drawn.
        pub point_density: f32,
        /// Binary logarithm of the distance between two columns that are traced. `window_width` and `window_height` count what is traced.
        pub column_shift: u32,
        /// The same of rows.
        pub row_shift: u32,
        /// Where layer 0 is in `radiance`, in layers.
        pub first_layer: u32,
        /// 1: paths lend nothing, though the kernel is one whose paths may.
        pub keeps: u32,
        /// Workgroups that trace what `tile_samples` says, a tile each; 0: the batch is layers of a rectangle. Of adaptive films alone.
        pub tile_samples: u32,
        pub pad0: u32,
        pub pad1: u32,
        pub pad2: u32,
    }

    /// Where a pixel gathers what the paths of its tile lend: its path's first surface. World space relative to the scene's origin.
    pub struct GatherPoint {
        /// Where rays leave it, on the side that the camera sees.
        pub origin: Vec3,
        /// Index of its material; [`NO_MATERIAL`] where the pixel gathers nothing.
        pub material: u32,
        /// Towards the camera, unit length.
        pub wo: Vec3,
        pub pad0: u32,
        /// The normal that it is shaded by, unit length.
        pub shading: Vec3,
        pub pad1: u32,
        /// The triangle's own, on the side of `wo`; unit length.
        pub geometric: Vec3,
        /// 1 where it is seen from its back.
        pub back_face: u32,
    }

    /// A path's second surface, and what its diffuse lobe sends on: what a path lends to its tile.
    pub struct LentPoint {
        /// World space relative to the scene's origin.
        pub position: Vec3,
        /// Index in scene order; [`NO_HIT`](super::ray::NO_HIT) where the path lends nothing.
        pub triangle: u32,
        /// Radiance, linear Rec.709; the same in all directions from where the surface is seen.
        pub radiance: Vec3,
        /// The number by which surfaces with holes were there or not on the path's own way here.
        pub chance: u32,
        /// The triangle's normal on the side of the path; unit length.
        pub geometric: Vec3,
        pub pad0: u32,
        /// What it is shaded by, before it is bent to a viewer; where nothing bends normals, not written.
        pub normal: Vec3,
        pub pad1: u32,
        /// What a unit of radiance from here adds to the path's own pixel, where it keeps that to itself.
        pub weight: Vec3,
        pub pad2: u32,
    }

    /// One sample of one pixel, as the trace kernel leaves it for the film.
    pub struct RadianceSample {
        /// Linear Rec.709; of a bad sample: kind, bounce and material, as whole numbers.
        pub rgb: Vec3,
        /// Rays traced; [`SAMPLE_BAD`] is set in a bad sample.
        pub info: u32,
    }
}

gpu_consts! {
    /// Material flag: light leaves the front side only.
    pub const MATERIAL_ONE_SIDED: u32 = 1;
    /// Material flag: the specular lobe is GGX.
    pub const MATERIAL_GGX: u32 = 2;
    /// Material flag: the specular lobe is a smooth mirror.
    pub const MATERIAL_MIRROR: u32 = 4;
    /// Material flag: a smooth dielectric, and nothing else.
    pub const MATERIAL_DIELECTRIC: u32 = 8;
    /// Material flag: a pane of glass as one sheet, and nothing else.
    pub const MATERIAL_THIN: u32 = 16;
    /// No material: the environment, or unknown. A whole number that f32 holds.
    pub const NO_MATERIAL: u32 = 0x00ff_ffff;
    /// Flag of [`RadianceSample::info`].
    pub const SAMPLE_BAD: u32 = 0x8000_0000;
    /// A path's radiance or throughput was NaN.
    pub const BAD_NAN: u32 = 1;
    /// A path's radiance or throughput was infinite.
    pub const BAD_INFINITE: u32 = 2;
    /// A path's radiance or throughput was negative.
    pub const BAD_NEGATIVE: u32 = 3;
    /// A sample was too large for the film's fixed point.
    pub const BAD_OVERFLOW: u32 = 4;
    /// Random dimensions of a bounce, in groups of four that a sampler may stratify jointly: a direction with the point on a
    /// light that is drawn where it leads, and choices.
    pub const DIMENSIONS_PER_BOUNCE: u32 = 8;
    /// Where a sample lies in its pixel, 2D, of bounce 0: the camera's direction.
    pub const SLOT_FILM: u32 = 0;
    /// Which light, and the point on it, 2D.
    pub const SLOT_LIGHT_POINT: u32 = 2;
    /// Which lobe of the BSDF, and whether the path survives: 2D, in a group of their own.
    pub const SLOT_CHOICES: u32 = 4;
    /// The direction that a bounce draws, 2D: in the group of the next bounce's light.
    pub const SLOT_DIRECTION: u32 = 8;
    /// Random dimensions of the point on the lens, 2D: beyond those of bounces, textures and rays.
    pub const LENS_DIMENSIONS: u32 = 196608;
    /// Cosine to its viewer that a shading normal is bent to where it looks away, at a facet that itself has as much.
    pub const LEAST_FACING: f32 = 1.0 / 32.0;
    /// Roughness below which a GGX lobe is taken as a mirror. Unit vectors in f32 err by some 1e-7, which is a thousandth of
    /// such a lobe's width and moves its density by 0.2 %; no film resolves it either.
    pub const SMOOTHEST_ALPHA: f32 = 1e-4;
    /// Pixels of a tile, whose paths are reused.
    pub const TILE_PIXELS: u32 = 16;
    /// Sides of the blocks of pixels that hold whole tiles.
    pub const TILE_BLOCK: u32 = 8;
    /// First bounce after which Russian roulette may end a path: paths of 4 segments are never cut.
    pub const ROULETTE_BOUNCE: u32 = 3;
}

const _: () = assert!(size_of::<PathState>() <= 96, "a path state is at most 96 bytes");

impl MaterialRecord {
    /// Whether the specular lobe is Phong's.
    pub fn has_phong(&self) -> bool {
        self.specular_probability > 0.0 && self.flags & (MATERIAL_GGX | MATERIAL_MIRROR) == 0
    }
}

impl Shading {
    /// Packs unit normals of a triangle's corners; a zero vector stands for the geometric normal.
    pub fn pack(normals: [Vec3; 3]) -> Self {
        let [n0, n1, n2] = normals.map(octahedral);
        Self { n0, n1, n2, pad: 0 }
    }
}

/// Rec.709 luminance.
pub fn luminance(rgb: Vec3) -> f32 {
    rgb.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// Octahedral snorm16 pair of a unit vector (Cigolle et al. 2014); never 0, which stands for no normal.
pub fn octahedral(n: Vec3) -> u32 {
    let length = n.abs().element_sum();
    if length.is_nan() || length <= 0.0 {
        return 0;
    }
    let p = n / length;
    let (x, y) = match p.z >= 0.0 {
        true => (p.x, p.y),
        false => ((1.0 - p.y.abs()).copysign(p.x), (1.0 - p.x.abs()).copysign(p.y)),
    };
    let quantise = |v: f32| (v.clamp(-1.0, 1.0) * 32767.0).round() as i16 as u16 as u32;
    // +z packs to 0, which is taken: its nearest neighbour is 3e-5 radians away.
    (quantise(x) | quantise(y) << 16).max(1)
}
