//! The engine's tree by the passes and by their twin: the same words, whatever the scene and whatever was done to it; and an
//! edit of the passes is run, whoever built before.

use std::sync::Arc;
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{DAffine3, DVec3, UVec2, Vec3};
use lucerna::Engine;
use lucerna::components::{Camera, Environment, Film, Geometry, Material, Render, Transform};
use lucerna::engine::TreeBuilder;
use lucerna::gpu::Gpu;
use lucerna::gpu::GpuTable;
use lucerna::layout::tree::{Node, Triangle, node_count};
use lucerna::scene::generate::to_mesh;
use lucerna::scene::{self, MeshEntry, SceneDescription};
use lucerna::shader::Library;
use lucerna::systems::resources::Device;

use crate::morton::{cloud, point, scenes};
use crate::support;

const STEP: Duration = Duration::from_secs(10);

/// A scene of two meshes: half of the triangles each.
fn describe(triangles: &[Triangle]) -> SceneDescription {
    let corners: Vec<[Vec3; 3]> = triangles.iter().map(|t| [t.a, t.b, t.c]).collect();
    let mesh = |corners: &[[Vec3; 3]]| MeshEntry {
        geometry: Arc::new(to_mesh(corners)),
        transform: Transform::default(),
        material: "lamp".into(),
    };
    let (first, second) = corners.split_at(corners.len() / 2);
    let lamp = Material { emission: Vec3::splat(3.0), ..Default::default() };
    let camera = Camera {
        position: DVec3::splat(2.5),
        look_at: DVec3::splat(0.5),
        up: DVec3::Y,
        fov_y: 60.0,
        ..Camera::default()
    };
    SceneDescription {
        name: "built".into(),
        meshes: [("a".into(), mesh(first)), ("b".into(), mesh(second))].into(),
        materials: [("lamp".into(), lamp.into())].into(),
        textures: Default::default(),
        cameras: [("front".into(), camera)].into(),
        active: "front".into(),
        lights: Default::default(),
        film: Film { size: UVec2::splat(8), ..Default::default() },
        render: Render { spp: 1, max_depth: 3, ..Default::default() },
        shader: Default::default(),
        environment: Some(Environment::Constant(Vec3::splat(0.25))),
    }
}

fn open(builder: TreeBuilder, library: Library, description: &SceneDescription) -> Engine {
    let mut engine = Engine::open(support::gpu(), library, description).unwrap();
    engine.set_tree_builder(builder);
    engine
}

/// Finishes the film. The words of leaves and nodes, and of the film's sums.
fn words(engine: &mut Engine) -> [Vec<u32>; 3] {
    while !engine.step(STEP).unwrap().finished {}
    let film = bytemuck::cast_slice(&engine.film().unwrap().pixels).to_vec();
    engine.read(|world| {
        let count = world.resource::<GpuTable<Triangle>>().len() as u32;
        let device = &world.resource::<Device>().0;
        let read = |name, items: u32, size: usize| device.read_some(name, items as usize * size / 4).unwrap();
        [read("leaves", count, size_of::<Triangle>()), read("nodes", node_count(count), size_of::<Node>()), film]
    })
}

/// Whether a pass of the tree ran since the engine opened.
fn has_built(engine: &Engine) -> bool {
    ["morton", "sort scatter", "leaves", "nodes"].iter().any(|pass| engine.dispatches().contains_key(pass))
}

#[test]
fn passes_and_twin_build_the_same_tree_for_an_engine() {
    let first = describe(&cloud(2, 0.5, |_, random| point(random)));
    let [mut by_passes, mut by_twin] =
        [TreeBuilder::Passes, TreeBuilder::Twin].map(|builder| open(builder, Library::shipped(), &first));
    let mut compare = |what: &str, edit: &dyn Fn(&mut World)| {
        by_passes.edit(edit);
        by_twin.edit(edit);
        let [expected, found] = [&mut by_passes, &mut by_twin].map(words);
        for (part, (a, b)) in ["leaves", "nodes", "film"].iter().zip(expected.iter().zip(&found)) {
            let wrong = a.iter().zip(b).position(|(a, b)| a != b);
            assert!(a.len() == b.len() && wrong.is_none(), "{what}: word {wrong:?} of the {part}");
        }
    };
    for n in [0, 1, 2, 3, 513] {
        let random = describe(&cloud(n, 0.3, |_, random| point(random)));
        compare(&format!("{n} triangles"), &|world| scene::apply(world, &random));
    }
    for (what, triangles) in scenes(700) {
        let description = describe(&triangles);
        compare(what, &|world| scene::apply(world, &description));
    }
    let move_first = |world: &mut World| {
        let mut places = world.query::<(&Name, &mut Transform)>();
        let found = places.iter_mut(world).find(|(name, _)| name.as_str() == "a");
        found.unwrap().1.0 = DAffine3::from_translation(DVec3::new(0.1, 0.2, -0.3));
    };
    compare("a mesh moved", &move_first);
    compare("a mesh less", &|world| {
        let mut meshes = world.query_filtered::<(Entity, &Name), With<Geometry>>();
        let (second, _) = meshes.iter(world).find(|(_, name)| name.as_str() == "b").unwrap();
        world.despawn(second);
    });
    assert!(has_built(&by_passes) && !has_built(&by_twin));
}

#[test]
fn a_processor_builds_by_the_twin_and_a_graphics_card_by_passes() {
    let gpu: Arc<Gpu> = support::gpu();
    let mut engine =
        Engine::open(gpu.clone(), Library::shipped(), &describe(&cloud(9, 0.5, |_, random| point(random)))).unwrap();
    words(&mut engine);
    assert_eq!(has_built(&engine), !gpu.is_software());
}

/// The tree's modules, each with a place for a change that leaves the tree as it is and one that spoils it.
#[test]
fn edited_passes_are_run_in_place_of_the_twin() {
    let description = describe(&cloud(40, 0.8, |_, random| point(random)));
    let shipped = words(&mut open(TreeBuilder::Twin, Library::shipped(), &description));
    let edits = [
        ("passes/tree/nodes", "return result;\n", "result.low += vec4<f32>(0.0);\n    return result;\n", true),
        ("passes/tree/clusters", "].left = left.child;", "].left = right.child;", false),
        ("passes/tree/leaves", "leaves[leaf] = triangle;", "leaves[leaf] = triangles[leaf];", false),
        ("passes/morton/morton", "payload[index] = index;", "payload[index] = index + 0u;", true),
        ("passes/sort/digit", "fn digit_of(", "fn unused_here() {}\nfn digit_of(", true),
    ];
    for (module, from, to, same) in edits {
        let library = Library::shipped();
        let text = library.text(module).unwrap().to_owned();
        assert!(text.contains(from), "{module} has no `{from}`");
        let library = library.with(module, &text.replacen(from, to, 1));
        let mut engine = open(TreeBuilder::Twin, library, &description);
        let found = words(&mut engine);
        assert!(has_built(&engine), "{module}: its edit is not run");
        assert_eq!(found[..2] == shipped[..2], same, "{module}");
    }
}
