//! A small scene in which every kind of map is seen: a floor, a wall, a lamp and a leaf, and pictures made of numbers.

use std::sync::Arc;

use glam::{UVec2, Vec2};
use lucerna::components::{Channel, Reading, Texels, Texture, TextureImage};
use lucerna::scene::{self, MapUse, SceneDescription, TextureMap};

const OBJ: &str = "mtllib a.mtl
v -2 0 -2\nv 2 0 -2\nv 2 0 2\nv -2 0 2
v -1 0.1 -1\nv 1 0.1 -1\nv 1 2.1 -1\nv -1 2.1 -1
v -1 3 -1\nv 1 3 -1\nv 1 3 1\nv -1 3 1
v 0.2 0.2 0\nv 1.2 0.2 0.4\nv 1.2 1.2 0.4\nv 0.2 1.2 0
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0 0\nvt 4 0\nvt 4 4\nvt 0 4
vn 0 0.1 1\nvn 0.3 0 1\nvn -0.1 0.2 1\nvn 0 0 1
usemtl floor\nf 1/5 4/8 3/7 2/6
usemtl wall\nf 5/1/1 6/2/2 7/3/3 8/4/4
usemtl lamp\nf 9/1 10/2 11/3 12/4
usemtl leaf\nf 13/1 14/2 15/3 16/4
";

const MTL: &str = "newmtl floor\nKd 1 1 1\nnewmtl wall\nKd 0.8 0.8 0.8\nKs 0.2 0.2 0.2\nPr 0.6
newmtl lamp\nKd 0 0 0\nKe 8 8 8\nnewmtl leaf\nKd 0.2 0.7 0.1\n";

const RON: &str = r#"(models: [(path: "a.obj")], cameras: {"c": (position: (0.5, 1.4, 4.5), look_at: (0, 1.1, 0))},
    environment: Constant((0.15, 0.2, 0.3)), render: (spp: 4, max_depth: 4))"#;

/// A scene whose maps are set one by one.
pub struct Garden {
    pub description: SceneDescription,
}

impl Garden {
    /// Without any map.
    pub fn plain(size: UVec2) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in [("a.obj", OBJ), ("a.mtl", MTL), ("a.ron", RON)] {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        let mut description = scene::load(&folder.path().join("a.ron"), &[]).unwrap().description;
        description.film.size = size;
        Self { description }
    }

    /// With a map on every surface.
    pub fn full(size: UVec2) -> Self {
        let mut garden = Self::plain(size);
        let kd = garden.add("checker", Texture::new(checker(), Reading::Colour), MapUse::Colour);
        let glow = Texture { gain: 1.5, ..Texture::new(glow(), Reading::Colour) };
        let ke = garden.add("glow", glow, MapUse::Colour);
        let d = garden.add("ring", Texture::new(ring(), Reading::Number(Channel::Luminance)), MapUse::Number);
        let relief = Reading::Height { channel: Channel::Luminance, depth: 0.05 };
        let bump = garden.add("bumps", Texture::new(bumps(), relief), MapUse::Bump);
        let ks = garden.add("checker", Texture::new(checker(), Reading::Colour), MapUse::Colour);
        let rough = Texture::new(bumps(), Reading::Number(Channel::Green));
        let pr = garden.add("rough", rough.clone(), MapUse::Number);
        let pm = garden.add("metal", Texture { scale: Vec2::new(-2.0, 0.7), ..rough }, MapUse::Number);
        let of = |garden: &mut Self, name: &str, set: &dyn Fn(&mut scene::TextureMaps)| {
            set(&mut garden.description.materials.get_mut(name).unwrap().maps);
        };
        of(&mut garden, "a:floor", &|maps| maps.kd = Some(kd.clone()));
        of(&mut garden, "a:lamp", &|maps| maps.ke = Some(ke.clone()));
        of(&mut garden, "a:leaf", &|maps| maps.d = Some(d.clone()));
        of(&mut garden, "a:wall", &|maps| {
            maps.bump = Some(bump.clone());
            maps.ks = Some(ks.clone());
            maps.pr = Some(pr.clone());
            maps.pm = Some(pm.clone());
        });
        garden
    }

    /// Adds a texture under the name of a file; the map that means it.
    pub fn add(&mut self, file: &str, texture: Texture, used: MapUse) -> TextureMap {
        let map = TextureMap::new(file);
        self.description.textures.insert(scene::texture_name(&map, used), texture);
        map
    }
}

/// A picture by a function of column and row.
pub fn picture(size: UVec2, texel: impl Fn(u32, u32) -> [u8; 4]) -> Arc<TextureImage> {
    let places = (0..size.y).flat_map(|y| (0..size.x).map(move |x| (x, y)));
    Arc::new(TextureImage { size, texels: Texels::Rgba8(places.map(|(x, y)| texel(x, y)).collect()) })
}

pub fn checker() -> Arc<TextureImage> {
    picture(UVec2::new(64, 48), |x, y| match (x / 8 + y / 8) % 2 {
        0 => [230, 60 + 2 * y as u8, 40, 255],
        _ => [240, 240, 3 * x as u8, 255],
    })
}

/// There between two circles, half there at their edges.
pub fn ring() -> Arc<TextureImage> {
    picture(UVec2::splat(40), |x, y| {
        let radius = Vec2::new(x as f32 - 19.5, y as f32 - 19.5).length();
        let code = if radius < 17.0 && radius > 9.0 {
            255
        } else if radius < 19.0 {
            100
        } else {
            0
        };
        [code, code, code, 255]
    })
}

pub fn bumps() -> Arc<TextureImage> {
    picture(UVec2::new(63, 31), |x, y| {
        let value = ((x as f32 * 0.4).sin() * (y as f32 * 0.6).sin() * 100.0 + 128.0) as u8;
        [value, value / 2 + 60, value, 255]
    })
}

pub fn glow() -> Arc<TextureImage> {
    picture(UVec2::splat(32), |x, y| if (x / 8 + y / 8) % 2 == 0 { [255, 120, 40, 255] } else { [0, 0, 0, 255] })
}
