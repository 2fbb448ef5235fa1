//! Textures as kernels look them up: records, texels in words, and what triangles say of where they are in a picture.
//!
//! A texture's words are a table of its levels, an offset each from the texture's first word, and then the texels of each level, the
//! picture first and every next one half its size, rounded down, to a single texel. A level lies in tiles of 8x8 texels, row by row, whose
//! texels follow each other in Morton order: neighbours in a picture are neighbours in memory.

use glam::{UVec2, Vec2};

gpu_struct! {
    /// How one texture is looked up.
    pub struct TextureRecord {
        /// The point of texture coordinates `uv` is at `uv * scale + offset` in the picture, whose upper left corner is (0, 0).
        pub scale: Vec2,
        pub offset: Vec2,
        /// A value is `base + gain` times what a texel has. Of heights, `gain` is the depth in widths of the picture.
        pub gain: f32,
        pub base: f32,
        /// Its first word in `texels`.
        pub first: u32,
        /// Width and height of its first level, each less 1: 16 bits each.
        pub size: u32,
        /// A `TEXEL_` kind, and `TEXTURE_` flags.
        pub format: u32,
        /// Levels, at least 1.
        pub levels: u32,
        /// Half the binary logarithm of the texels of the first level in a unit square of texture coordinates.
        pub density: f32,
        pub pad: u32,
    }

    /// The textures of a material: each the index of its record, plus 1; 0 is none.
    pub struct MaterialMaps {
        pub diffuse: u32,
        pub specular: u32,
        pub lobe: u32,
        pub metallic: u32,
        pub emission: u32,
        pub opacity: u32,
        pub relief: u32,
        /// `MAPS_` flags.
        pub flags: u32,
        /// What the map of metalness multiplies, 0 to 1.
        pub metalness: f32,
        /// What the map of opacity multiplies, 0 to 1.
        pub coverage: f32,
        /// The texture that views show: `first` of those above.
        pub shown: u32,
        pub pad: u32,
    }

    /// Where the corners of one triangle are in pictures, in scene order.
    pub struct CornerUvs {
        /// First corner, v up.
        pub a: Vec2,
        /// Second corner, relative to the first.
        pub b: Vec2,
        /// Third corner, relative to the first.
        pub c: Vec2,
        /// Half the binary logarithm of the triangle's area in texture coordinates by that in the scene.
        pub density: f32,
        /// By how much its shading normals turn along a unit of length, at most: 1 / scene units.
        pub curvature: f32,
    }

    /// Corner tangents of one triangle by MikkTSpace, in scene order: world space, octahedral, two snorm16 a word; 0 is none.
    pub struct Tangents {
        pub t0: u32,
        pub t1: u32,
        pub t2: u32,
        /// 1 where the bitangent is `cross(tangent, normal)`, and not the other way round.
        pub mirrored: u32,
    }
}

gpu_consts! {
    /// Red, green, blue and alpha of 8 bits each in a word, red lowest.
    pub const TEXEL_RGBA8: u32 = 0;
    /// One channel of 8 bits, four texels a word.
    pub const TEXEL_R8: u32 = 1;
    /// One channel of 16 bits, two texels a word.
    pub const TEXEL_R16: u32 = 2;
    /// Red, green, blue and alpha as f16, in two words.
    pub const TEXEL_RGBA16F: u32 = 3;
    /// By how much heights grow along u and along v, in depths by widths of the picture: two f16.
    pub const TEXEL_SLOPES: u32 = 4;
    /// The bits of a format that are its kind.
    pub const TEXEL_KIND: u32 = 7;
    /// Colours are sRGB codes; alpha is not.
    pub const TEXTURE_SRGB: u32 = 16;
    /// Beyond the picture are the texels of its edge, along u; else the picture again.
    pub const TEXTURE_CLAMP_U: u32 = 32;
    /// The same along v.
    pub const TEXTURE_CLAMP_V: u32 = 64;
    /// Green grows downwards in a picture of directions.
    pub const TEXTURE_FLIP_GREEN: u32 = 128;
    /// Where the number of a channel lies in a format: 0 to 3 are red, green, blue and alpha, and 4 luminance.
    pub const TEXTURE_CHANNEL_SHIFT: u32 = 8;
    /// Texels a side of a tile.
    pub const TILE: u32 = 8;
    /// The energy policy divides what both lobes reflect, where that is above 1.
    pub const MAPS_PRESERVE: u32 = 1;
    /// First of the random dimensions by which texels are drawn, beyond those of all bounces.
    pub const TEXTURE_DIMENSIONS: u32 = 65536;
    /// Random dimensions of a bounce for that: of colours, lobe and metalness; then of relief, of the emission that was hit, and of the light's.
    pub const TEXTURE_DIMENSIONS_PER_BOUNCE: u32 = 8;
    /// First of the dimensions by which a ray's own number is drawn, one a ray: it decides what is there of surfaces with holes.
    pub const CUTOUT_DIMENSIONS: u32 = 131072;
    /// The number of rays that decide nothing by chance: a surface is there where it is at least half there.
    pub const NO_CHANCE: u32 = 0;
    /// What a cone grows by where a surface spreads it, by the root of the solid angle that a drawn direction stands for.
    pub const CONE_PART: f32 = 1.0 / 16.0;
    /// The part of a pixel that the camera's cone is as wide as. Samples of a pixel are spread over it already: what a lookup takes in beyond
    /// what lies between them blurs the picture. (Pharr, Jakob, Humphreys: Physically Based Rendering, 4th edition, 2023, section 10.1.3, has
    /// the same least part.)
    pub const CAMERA_PART: f32 = 0.125;
    /// The most texels that are looked up along a footprint.
    pub const MOST_LOOKUPS: u32 = 4;
    /// A footprint that is a point.
    pub const POINT: f32 = -1000.0;
}

impl TextureRecord {
    /// Texels of a level.
    pub fn level_size(&self, level: u32) -> UVec2 {
        let size = UVec2::new((self.size & 0xffff) + 1, (self.size >> 16) + 1);
        UVec2::new(size.x >> level, size.y >> level).max(UVec2::ONE)
    }
}

impl MaterialMaps {
    /// Whether a texture multiplies a number of a lobe.
    pub fn changes_lobes(&self) -> bool {
        self.diffuse | self.specular | self.lobe | self.metallic != 0
    }

    /// The first texture that there is, in the order in which views look for one; 0 is none.
    pub fn first(&self) -> u32 {
        let Self { diffuse, specular, emission, relief, opacity, lobe, metallic, .. } = *self;
        [diffuse, specular, emission, relief, opacity, lobe, metallic].into_iter().find(|map| *map != 0).unwrap_or(0)
    }

    /// Whether there is any texture.
    pub fn is_textured(&self) -> bool {
        self.changes_lobes() || self.emission | self.opacity | self.relief != 0
    }
}

/// The place of a texel in a level of such a width, by texels.
pub fn texel_index(at: UVec2, width: u32) -> u32 {
    let spread = |v: u32| (v & 1) | (v & 2) << 1 | (v & 4) << 2;
    let tile = (at.y / TILE) * width.div_ceil(TILE) + at.x / TILE;
    tile * TILE * TILE + (spread(at.x % TILE) | spread(at.y % TILE) << 1)
}

/// Texels that a level of such a size takes, those that fill up its tiles included.
pub fn level_texels(size: UVec2) -> u64 {
    let tiles = UVec2::new(size.x.div_ceil(TILE), size.y.div_ceil(TILE));
    u64::from(tiles.x) * u64::from(tiles.y) * u64::from(TILE * TILE)
}

/// Levels of a picture of such a size, down to a single texel.
pub fn level_count(size: UVec2) -> u32 {
    u32::BITS - size.max_element().leading_zeros()
}
