//! A wall of square patches, each of them another material with maps, filling the film: so each patch has its own block of pixels.

use std::f64::consts::TAU;
use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::{DAffine3, DVec3, UVec2, Vec2, Vec3};
use lucerna::components::{
    Camera, Channel, Environment, Film, Lobe, Maps, Material, MeshData, Passage, Reading, Render, Texels, Texture,
    TextureImage, Transform, Wrap,
};
use lucerna::scene::generate::icosphere;
use lucerna::scene::{self, MeshEntry, SceneDescription};

/// A scene, and the textures of its materials by their names.
#[derive(Clone)]
pub struct Scene {
    pub description: SceneDescription,
    pub maps: Vec<(String, Textures)>,
}

/// As [`Maps`], before there are entities.
#[derive(Clone, Default)]
pub struct Textures {
    pub diffuse: Option<Texture>,
    pub specular: Option<Texture>,
    pub lobe: Option<Texture>,
    pub metallic: Option<Texture>,
    pub emission: Option<Texture>,
    pub opacity: Option<Texture>,
    pub relief: Option<Texture>,
}

impl Textures {
    /// All there are, to be changed.
    pub fn each(&mut self) -> impl Iterator<Item = &mut Texture> {
        let Self { diffuse, specular, lobe, metallic, emission, opacity, relief } = self;
        [diffuse, specular, lobe, metallic, emission, opacity, relief].into_iter().flatten()
    }
}

impl Scene {
    /// A camera that sees the square from -1 to 1 in the plane z = 0, from 3 before it, and nothing else.
    pub fn new(side: u32, render: Render) -> Self {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/cornell-box.ron");
        let mut description = scene::load(&path, &[]).unwrap_or_else(|e| panic!("{e:?}")).description;
        description.meshes.clear();
        description.materials.clear();
        description.environment = Some(Environment::Constant(Vec3::new(0.5, 0.6, 0.7)));
        description.film = Film { size: UVec2::splat(side), ..description.film };
        description.render = render;
        let fov_y = 2.0 * (1.0f64 / 3.0).atan().to_degrees();
        let camera =
            Camera { position: 3.0 * DVec3::Z, look_at: DVec3::ZERO, up: DVec3::Y, fov_y, ..Camera::default() };
        description.cameras.values_mut().for_each(|held| *held = camera);
        Self { description, maps: Vec::new() }
    }

    /// A mesh and its material.
    pub fn part(&mut self, name: &str, mesh: MeshData, transform: DAffine3, material: Material, maps: Textures) {
        self.description.materials.insert(name.to_owned(), material.into());
        let mesh = MeshEntry { geometry: Arc::new(mesh), transform: Transform(transform), material: name.to_owned() };
        self.description.meshes.insert(name.to_owned(), mesh);
        self.maps.push((name.to_owned(), maps));
    }

    /// A lamp above what the camera sees, facing the wall aslant.
    pub fn lamp(&mut self, emission: Vec3, maps: Textures) {
        let (along, down) = (Vec3::new(1.6, 0.0, 0.3), Vec3::new(0.0, 0.4, 0.6));
        let mesh = quad(Vec3::new(-0.5, 1.5, 0.7), along, down, [Vec2::ZERO, Vec2::ONE]);
        let material = Material { diffuse: Vec3::ZERO, emission, ..Material::default() };
        self.part("lamp", mesh, DAffine3::IDENTITY, material, maps);
    }

    /// Gives the materials of a world that holds the description their textures, in the place of those they had.
    pub fn dress(&self, world: &mut World) {
        let held: Vec<Entity> = world.query_filtered::<Entity, With<Texture>>().iter(world).collect();
        held.into_iter().for_each(|entity| _ = world.despawn(entity));
        for (material, textures) in &self.maps {
            let mut place = |role: &str, texture: &Option<Texture>| {
                let name = Name::new(format!("{role} of {material}"));
                texture.clone().map(|texture| world.spawn((name, texture)).id())
            };
            let maps = Maps {
                diffuse: place("diffuse", &textures.diffuse),
                specular: place("specular", &textures.specular),
                lobe: place("lobe", &textures.lobe),
                metallic: place("metallic", &textures.metallic),
                emission: place("emission", &textures.emission),
                opacity: place("opacity", &textures.opacity),
                relief: place("relief", &textures.relief),
            };
            let mut materials = world.query_filtered::<(Entity, &Name), With<Material>>();
            let entity = materials.iter(world).find(|(_, name)| name.as_str() == material).unwrap().0;
            world.entity_mut(entity).insert(maps);
        }
    }
}

/// The parallelogram of a corner and two edges, in texture coordinates from the first to the second.
pub fn quad(corner: Vec3, e: Vec3, f: Vec3, [low, high]: [Vec2; 2]) -> MeshData {
    let triangles = vec![[0, 1, 2], [0, 2, 3]];
    MeshData {
        positions: [corner, corner + e, corner + e + f, corner + f].map(|p| p.as_dvec3()).to_vec(),
        uvs: vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)],
        uv_triangles: triangles.clone(),
        triangles,
        ..MeshData::default()
    }
}

/// The patch of a number in a wall of `columns` patches a side, row by row from the top.
pub fn patch(number: usize, columns: usize, uvs: [Vec2; 2]) -> MeshData {
    let side = 2.0 / columns as f32;
    let (column, row) = ((number % columns) as f32, (number / columns) as f32);
    quad(Vec3::new(side * column - 1.0, 1.0 - side * (row + 1.0), 0.0), side * Vec3::X, side * Vec3::Y, uvs)
}

/// A picture of codes that are brighter to the upper right, and of different colours.
pub fn picture(size: UVec2) -> Arc<TextureImage> {
    let code = |x: u32, y: u32| {
        let across = (x * 120 / size.x) as u8;
        let up = ((size.y - 1 - y) * 90 / size.y) as u8;
        [90 + across, 60 + across / 2 + up, 100 + up + (x + y) as u8 % 2 * 40, 255 - across]
    };
    let texels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| code(x, y))).collect();
    Arc::new(TextureImage { size, texels: Texels::Rgba8(texels) })
}

pub fn colour(size: [u32; 2]) -> Texture {
    Texture::new(picture(size.into()), Reading::Colour)
}

pub fn number(size: [u32; 2], channel: Channel) -> Texture {
    Texture::new(picture(size.into()), Reading::Number(channel))
}

/// Heights in 16 bits that grow to the right and wave upwards.
pub fn heights(size: [u32; 2], depth: f32) -> Texture {
    let code = |x: u32, y: u32| (x * 40_000 / size[0] + y * y * 7919 % 20_000) as u16;
    let texels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| code(x, y))).collect();
    let image = TextureImage { size: size.into(), texels: Texels::Grey16(texels) };
    Texture::new(Arc::new(image), Reading::Height { channel: Channel::Luminance, depth })
}

/// Directions that lean up to half a unit, more to the right and upwards than to the left and down.
pub fn directions(size: [u32; 2], flip_green: bool) -> Texture {
    let code = |x: u32, y: u32| [128 + (x * 60 / size[0]) as u8, 170 - (y * 70 / size[1]) as u8, 230, 255];
    let texels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| code(x, y))).collect();
    let image = TextureImage { size: size.into(), texels: Texels::Rgba8(texels) };
    Texture::new(Arc::new(image), Reading::Normal { flip_green })
}

/// Patches a side of the [`wall`].
pub const COLUMNS: usize = 4;

/// Every map alone, every way to look up, and all together.
pub fn wall(render: Render) -> Scene {
    let mut scene = Scene::new(2 * COLUMNS as u32, render);
    scene.lamp(Vec3::new(5.0, 4.5, 4.0), Textures::default());
    let plain = Material { diffuse: Vec3::new(0.6, 0.7, 0.8), ..Material::default() };
    let shiny = |lobe| Material { diffuse: Vec3::splat(0.3), specular: Vec3::splat(0.5), lobe, ..Material::default() };
    let diffuse = |texture| Textures { diffuse: Some(texture), ..Textures::default() };
    let relief = |texture| Textures { relief: Some(texture), ..Textures::default() };
    let clamped = Texture { wrap: [Wrap::Clamp; 2], ..colour([4, 6]) };
    let moved =
        Texture { scale: Vec2::new(-2.0, 1.3), offset: Vec2::new(0.3, 0.2), gain: 0.7, base: 0.1, ..colour([7, 4]) };
    let half = Texture { wrap: [Wrap::Clamp, Wrap::Repeat], ..colour([1, 5]) };
    let unit = [Vec2::ZERO, Vec2::splat(0.8)];
    let all = Textures {
        diffuse: Some(colour([5, 3])),
        specular: Some(Texture { gain: 1.5, ..colour([2, 4]) }),
        lobe: Some(number([4, 4], Channel::Red)),
        metallic: Some(number([3, 5], Channel::Alpha)),
        relief: Some(directions([6, 3], false)),
        ..Textures::default()
    };
    let parts = [
        (plain, diffuse(colour([5, 3])), [Vec2::new(0.0, 0.1), Vec2::new(1.3, 0.9)]),
        (plain, diffuse(clamped), [Vec2::new(-0.4, -0.3), Vec2::new(1.2, 1.4)]),
        (plain, diffuse(moved), unit),
        (plain, diffuse(colour([4, 3])), [Vec2::splat(1e6), Vec2::new(1e6 + 0.75, 1e6 + 0.5)]),
        (plain, diffuse(half), [Vec2::splat(-0.7), Vec2::ZERO]),
        (plain, diffuse(colour([1, 1])), unit),
        (shiny(Lobe::Phong(12.0)), Textures { specular: Some(colour([3, 4])), ..Textures::default() }, unit),
        (
            shiny(Lobe::Phong(40.0)),
            Textures { lobe: Some(number([4, 3], Channel::Green)), ..Textures::default() },
            unit,
        ),
        (shiny(Lobe::Ggx(0.9)), Textures { lobe: Some(number([4, 3], Channel::Blue)), ..Textures::default() }, unit),
        (
            Material { metallic: 0.9, ..shiny(Lobe::Ggx(0.6)) },
            Textures { metallic: Some(number([3, 3], Channel::Luminance)), ..Textures::default() },
            unit,
        ),
        (plain, relief(directions([4, 5], false)), unit),
        (plain, relief(directions([4, 5], true)), unit),
        (plain, relief(heights([8, 5], 0.3)), unit),
        (plain, relief(directions([5, 4], false)), unit),
        (plain, relief(directions([5, 4], false)), unit),
        (Material { diffuse: Vec3::splat(0.9), specular: Vec3::splat(0.9), ..shiny(Lobe::Ggx(0.8)) }, all, unit),
    ];
    for (i, (material, maps, uvs)) in parts.into_iter().enumerate() {
        // The last two of relief are mirrored: without normals of their own, and with them.
        let mirrored = i == 13 || i == 14;
        let column = if mirrored { COLUMNS * (i / COLUMNS) + COLUMNS - 1 - i % COLUMNS } else { i };
        let mut mesh = patch(column, COLUMNS, uvs);
        if i == 14 {
            mesh.normals = vec![Vec3::Z];
            mesh.normal_triangles = vec![[0; 3]; 2];
        }
        let scale = DVec3::new(if mirrored { -1.0 } else { 1.0 }, 1.0, 1.0);
        scene.part(&format!("patch {i}"), mesh, DAffine3::from_scale(scale), material, maps);
    }
    scene
}

/// A smooth ball with relief, glossy and coloured.
pub fn ball(render: Render) -> Scene {
    let material = Material { specular: Vec3::splat(0.3), lobe: Lobe::Phong(8.0), ..Material::default() };
    let maps = Textures { relief: Some(heights([12, 7], 0.2)), diffuse: Some(colour([5, 4])), ..Textures::default() };
    ball_of(render, material, maps)
}

/// A smooth ball of tinted glass with relief.
pub fn glass_ball(render: Render) -> Scene {
    let material = Material { passage: Passage::Glass(1.5), filter: Vec3::new(0.8, 0.9, 1.0), ..Material::default() };
    let maps = Textures { relief: Some(heights([12, 7], 0.2)), ..Textures::default() };
    ball_of(render, material, maps)
}

/// A grey wall under a lamp with holes.
pub fn grille(render: Render) -> Scene {
    let mut scene = Scene::new(8, render);
    let holes = Textures { opacity: Some(number([5, 3], Channel::Red)), ..Textures::default() };
    scene.lamp(Vec3::new(5.0, 4.5, 4.0), holes);
    let grey = Material { diffuse: Vec3::splat(0.7), ..Material::default() };
    scene.part("wall", patch(0, 1, [Vec2::ZERO, Vec2::ONE]), DAffine3::IDENTITY, grey, Textures::default());
    scene
}

/// A grey wall under the lamp, with panes between the two: of one half of the lamp a pane with relief, of the other a plain one.
pub fn skylight(render: Render) -> Scene {
    let mut scene = Scene::new(8, render);
    scene.lamp(Vec3::new(5.0, 4.5, 4.0), Textures::default());
    let grey = Material { diffuse: Vec3::splat(0.7), ..Material::default() };
    scene.part("wall", patch(0, 1, [Vec2::ZERO, Vec2::ONE]), DAffine3::IDENTITY, grey, Textures::default());
    let pane = Material { passage: Passage::Pane(1.5), filter: Vec3::new(0.7, 0.9, 1.0), ..Material::BLACK };
    let relief = Textures { relief: Some(heights([12, 7], 0.6)), ..Textures::default() };
    for (name, x, maps) in [("wavy", -2.8, relief), ("plain", 0.2, Textures::default())] {
        let mesh = quad(Vec3::new(x, 1.3, 3.0), 3.0 * Vec3::X, -4.0 * Vec3::Z, [Vec2::ZERO, Vec2::splat(3.0)]);
        scene.part(name, mesh, DAffine3::IDENTITY, pane, maps);
    }
    scene
}

/// A smooth ball, turned, stretched and mirrored, below the lamp.
fn ball_of(render: Render, material: Material, maps: Textures) -> Scene {
    let mut scene = Scene::new(8, render);
    scene.lamp(Vec3::new(5.0, 4.5, 4.0), Textures::default());
    let corners = icosphere(2);
    let triangles: Vec<[u32; 3]> = (0..corners.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let uv = |n: &DVec3| Vec2::new((n.x.atan2(n.z) / TAU) as f32, (0.5 + 0.5 * n.y) as f32);
    let mesh = MeshData {
        positions: corners.iter().flatten().copied().collect(),
        triangles: triangles.clone(),
        normals: corners.iter().flatten().map(|n| n.as_vec3()).collect(),
        normal_triangles: triangles.clone(),
        uvs: corners.iter().flatten().map(uv).collect(),
        uv_triangles: triangles,
    };
    let turn = DAffine3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7);
    scene.part("ball", mesh, turn * DAffine3::from_scale(DVec3::new(-0.9, 0.7, 0.8)), material, maps);
    scene
}
