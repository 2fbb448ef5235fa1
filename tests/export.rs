//! `lucerna export --mitsuba`: the file is XML that has every mesh, light and camera; and what is not the same is said.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use lucerna::app::export::mitsuba::{Exported, Weight, export};
use lucerna::app::export::told;
use lucerna::components::{Environment, Lobe, Material, Passage, PointLight, SpotCone, Wrap};
use lucerna::image::PictureFile;
use lucerna::scene::{Audit, MtlMaterial, SceneDescription, audit, find, load};
use roxmltree::{Document, Node};

use crate::support;

/// Whether nothing was told but what a close look sees.
fn is_the_same(exported: &Exported) -> bool {
    exported.notes.iter().all(|note| note.weight == Weight::Slight)
}

/// A scene of the shipped ones, and where its materials are written.
fn shipped(name: &str) -> (SceneDescription, Audit) {
    let path = find(name).unwrap();
    (load(&path, &[]).unwrap_or_else(|errors| panic!("{errors}")).description, audit(&path))
}

fn written(scene: &SceneDescription, audit: Audit, folder: &Path) -> (Exported, String) {
    let exported = export(scene, audit, folder).unwrap();
    let text = std::fs::read_to_string(&exported.scene).unwrap();
    (exported, text)
}

fn plugins<'a>(root: &Node<'a, 'a>, tag: &str) -> Vec<Node<'a, 'a>> {
    root.descendants().filter(|node| node.has_tag_name(tag)).collect()
}

/// The value of a parameter.
fn value<'a>(node: &Node<'a, 'a>, name: &str) -> Option<&'a str> {
    node.children().find(|child| child.attribute("name") == Some(name))?.attribute("value")
}

/// Numbers of vertices and faces that a PLY file says and has.
fn ply(path: &Path) -> [usize; 2] {
    let bytes = std::fs::read(path).unwrap();
    let end = bytes.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
    let head = std::str::from_utf8(&bytes[..end]).unwrap();
    let count =
        |what: &str| head.lines().find_map(|line| line.strip_prefix(what)?.trim().parse::<usize>().ok()).unwrap();
    let (vertices, faces) = (count("element vertex"), count("element face"));
    let floats = head.lines().filter(|line| line.starts_with("property float")).count();
    assert_eq!(bytes.len() - end, vertices * floats * 4 + faces * 13, "{}", path.display());
    for face in bytes[end + vertices * floats * 4..].chunks(13) {
        let corner = |k: usize| u32::from_le_bytes(face[1 + 4 * k..5 + 4 * k].try_into().unwrap()) as usize;
        assert!(face[0] == 3 && (0..3).all(|k| corner(k) < vertices));
    }
    [vertices, faces]
}

/// Holds a file to the scene that it is of.
fn is_whole(scene: &SceneDescription, exported: &Exported, text: &str) {
    let document = Document::parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let root = document.root_element();
    let folder = exported.scene.parent().unwrap();
    let seen = || scene.meshes.values().filter(|mesh| !scene.materials[&mesh.material].material().is_invisible());
    let shapes: Vec<Node> =
        plugins(&root, "shape").into_iter().filter(|shape| shape.attribute("type") == Some("ply")).collect();
    let (fronts, backs): (Vec<&Node>, Vec<&Node>) =
        shapes.iter().partition(|shape| !shape.attribute("id").unwrap().ends_with("-back"));
    assert_eq!(fronts.len(), seen().count());
    let faces: usize = fronts.iter().map(|shape| ply(&folder.join(value(shape, "filename").unwrap()))[1]).sum();
    assert_eq!(faces, seen().map(|mesh| mesh.geometry.triangles.len()).sum::<usize>());
    // Every lamp, and its back where it shines to both sides.
    let lamps = || seen().map(|mesh| &scene.materials[&mesh.material]).filter(|material| material.ke != Vec3::ZERO);
    assert_eq!(backs.len(), lamps().filter(|lamp| !lamp.one_sided).count());
    let areas = plugins(&root, "emitter").into_iter().filter(|e| e.attribute("type") == Some("area"));
    let sun = usize::from(plugins(&root, "shape").iter().any(|shape| shape.attribute("type") == Some("disk")));
    assert_eq!(areas.count(), lamps().count() + backs.len() + sun);
    let kinds = |kinds: &[&str]| {
        plugins(&root, "emitter").into_iter().filter(|e| kinds.contains(&e.attribute("type").unwrap())).count()
    };
    assert_eq!(kinds(&["point", "spot"]), scene.lights.len());
    assert_eq!(kinds(&["constant", "envmap"]), usize::from(scene.environment.is_some()));
    assert_eq!(sun, usize::from(matches!(scene.environment, Some(Environment::Daylight(_)))));
    // What is referred to is there, once.
    let ids: Vec<&str> = plugins(&root, "bsdf").iter().filter_map(|bsdf| bsdf.attribute("id")).collect();
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len());
    for reference in plugins(&root, "ref") {
        assert!(ids.contains(&reference.attribute("id").unwrap()));
    }
    for name in root.descendants().filter(|node| node.attribute("name") == Some("filename")) {
        let path = folder.join(name.attribute("value").unwrap());
        assert!(path.is_file(), "{} is not there", path.display());
    }
    let sensors = plugins(&root, "sensor");
    assert_eq!(sensors.len(), 1);
    let film = plugins(&root, "film")[0];
    let size = ["width", "height"].map(|side| value(&film, side).unwrap().parse::<u32>().unwrap());
    assert!(size[0] >= scene.film.size.x && size[1] >= scene.film.size.y);
    let integrator = plugins(&root, "integrator")[0];
    assert_eq!(value(&integrator, "max_depth"), Some(scene.render.max_depth.to_string().as_str()));
    assert!(value(&integrator, "rr_depth").unwrap().parse::<u32>().unwrap() > 1024);
}

#[test]
fn shipped_scenes_are_whole_as_xml() {
    let mut names = vec!["cornell-data", "cornell-box", "glass", "teapot", "teapot-daylight", "teapot-original"];
    if support::stress() {
        names.extend(["dining-room", "sports-car", "dining-room-original"]);
    }
    for name in names {
        let folder = tempfile::tempdir().unwrap();
        let (scene, audit) = shipped(name);
        let (exported, text) = written(&scene, audit, folder.path());
        is_whole(&scene, &exported, &text);
    }
}

#[test]
fn what_mitsuba_says_alike_is_the_same_and_what_it_does_not_is_named_where_it_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, audit) = shipped("cornell-data");
    let (exported, _) = written(&scene, audit, folder.path());
    assert!(exported.notes.is_empty(), "{:?}", exported.notes);
    // The teapot's own lobe is Phong's, and its number is in the scene file.
    let (scene, audit) = shipped("teapot");
    let path = find("teapot").unwrap();
    let (exported, _) = written(&scene, audit, folder.path());
    assert!(!is_the_same(&exported));
    let line = 1 + std::fs::read_to_string(&path).unwrap().lines().position(|line| line.contains("ns: 800")).unwrap();
    let place = format!("{}:{line}: teapot:teapot: Mitsuba has no Phong lobe (Ns 800)", path.display());
    let said = told(&exported);
    assert!(said.contains("not the same picture") && said.contains(&place), "{said}");
    // And GGX's number is in the library.
    let (scene, audit) = shipped("glass");
    let (exported, _) = written(&scene, audit, folder.path());
    let gold = exported.notes.iter().find(|note| note.weight == Weight::Another).unwrap().to_string();
    assert!(gold.contains("glass.mtl:") && gold.contains("gold_ball") && gold.contains("Pr 0.45"), "{gold}");
}

/// One triangle of some material.
fn one(material: Material) -> SceneDescription {
    let mut scene = shipped("cornell-data").0;
    let (name, mut mesh) = scene.meshes.pop_first().unwrap();
    mesh.material = "m".to_owned();
    scene.meshes = [(name, mesh)].into();
    scene.materials = [("m".to_owned(), MtlMaterial::from(material))].into();
    scene
}

/// The plugins of the only material, from the outside in.
fn plugins_of(material: Material) -> (Vec<String>, Exported) {
    let folder = tempfile::tempdir().unwrap();
    let scene = one(material);
    let (exported, text) = written(&scene, Audit::default(), folder.path());
    is_whole(&scene, &exported, &text);
    let document = Document::parse(&text).unwrap();
    let nodes = plugins(&document.root_element(), "bsdf");
    (nodes.iter().map(|node| node.attribute("type").unwrap().to_owned()).collect(), exported)
}

#[test]
fn every_kind_of_material_has_its_plugin() {
    let grey = Material { diffuse: Vec3::splat(0.5), ..Material::BLACK };
    let shiny = Material { specular: Vec3::splat(0.3), ..grey };
    let cases: [(Material, &[&str], bool); 10] = [
        (grey, &["twosided", "diffuse"], true),
        (Material { lobe: Lobe::Mirror, ..shiny }, &["twosided", "blendbsdf", "diffuse", "conductor"], true),
        (Material { diffuse: Vec3::ZERO, lobe: Lobe::Mirror, ..shiny }, &["twosided", "conductor"], true),
        (Material { lobe: Lobe::Ggx(0.5), ..shiny }, &["twosided", "blendbsdf", "diffuse", "roughconductor"], false),
        (Material { lobe: Lobe::Phong(9.0), ..shiny }, &["twosided", "blendbsdf", "diffuse", "roughconductor"], false),
        (Material { passage: Passage::Glass(1.5), ..grey }, &["dielectric"], true),
        (Material { passage: Passage::Pane(1.5), ..grey }, &["thindielectric"], true),
        (Material { passage: Passage::Pane(1.5), filter: Vec3::splat(0.5), ..grey }, &["thindielectric"], false),
        (Material { passage: Passage::SeeThrough(0.3), ..grey }, &["mask", "twosided", "diffuse"], true),
        (Material { coat: 1.0, coat_roughness: 0.3, ..shiny }, &["twosided", "roughplastic"], false),
    ];
    for (material, wanted, same) in cases {
        let (found, exported) = plugins_of(material);
        assert_eq!(found, wanted, "{material:?}");
        assert_eq!(is_the_same(&exported), same, "{material:?}: {:?}", exported.notes);
    }
}

#[test]
fn a_reflectance_above_one_is_a_picture_and_mixtures_keep_their_sums() {
    let folder = tempfile::tempdir().unwrap();
    // Red is all diffuse and blue all mirror: parts of a half are 2 each.
    let scene = one(Material {
        diffuse: Vec3::new(1.0, 0.0, 0.0),
        specular: Vec3::new(0.0, 0.0, 1.0),
        lobe: Lobe::Mirror,
        ..Material::BLACK
    });
    let (_, text) = written(&scene, Audit::default(), folder.path());
    let document = Document::parse(&text).unwrap();
    let root = document.root_element();
    let blend = plugins(&root, "bsdf").into_iter().find(|b| b.attribute("type") == Some("blendbsdf")).unwrap();
    assert_eq!(value(&blend, "weight"), Some("0.5"));
    let pictures = plugins(&root, "texture");
    let colours: Vec<[f32; 3]> = pictures
        .iter()
        .map(|t| PictureFile::open(&folder.path().join(value(t, "filename").unwrap())).unwrap().read_all().unwrap()[0])
        .collect();
    assert_eq!(colours, [[2.0, 0.0, 0.0], [0.0, 0.0, 2.0]]);
}

#[test]
fn points_and_spots_are_lights_and_names_are_escaped() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = one(Material { diffuse: Vec3::splat(0.5), ..Material::BLACK });
    let point = PointLight { position: DVec3::new(1.0, 2.0, 3.0), intensity: Vec3::new(4.0, 5.0, 6.0), cone: None };
    let cone = SpotCone { look_at: DVec3::ZERO, angle: 60.0, blend: 0.5 };
    scene.lights =
        [("a<&\">$b".to_owned(), point), ("spot".to_owned(), PointLight { cone: Some(cone), ..point })].into();
    let (exported, text) = written(&scene, Audit::default(), folder.path());
    is_whole(&scene, &exported, &text);
    let document = Document::parse(&text).unwrap();
    let spot =
        plugins(&document.root_element(), "emitter").into_iter().find(|e| e.attribute("type") == Some("spot")).unwrap();
    assert_eq!([value(&spot, "cutoff_angle"), value(&spot, "beam_width")], [Some("30"), Some("15")]);
    assert!(exported.notes.iter().any(|note| note.text.contains("light `spot`")), "{:?}", exported.notes);
}

/// A model with a texture of four colours.
const OBJ: &str = "mtllib a.mtl\nusemtl painted\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
const MTL: &str = "newmtl painted\nKd 0.5 0.5 0.5\nmap_Kd -s 2 3 1 -o 0.25 0.5 0 a.png\nmap_d b.png\n";

fn png(path: PathBuf, texels: &[[u8; 3]], width: u32) {
    image::RgbImage::from_raw(width, texels.len() as u32 / width, texels.concat()).unwrap().save(path).unwrap();
}

#[test]
fn textures_are_multiplied_and_looked_up_where_they_were() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("a.obj"), OBJ).unwrap();
    std::fs::write(at("a.mtl"), MTL).unwrap();
    png(at("a.png"), &[[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]], 2);
    png(at("b.png"), &[[255; 3], [0; 3]], 2);
    let scene = load(&at("a.obj"), &[]).unwrap().description;
    assert_eq!(scene.textures.len(), 2);
    let (exported, text) = written(&scene, audit(&at("a.obj")), &at("out"));
    is_whole(&scene, &exported, &text);
    let document = Document::parse(&text).unwrap();
    let root = document.root_element();
    let named = |name: &str| plugins(&root, "texture").into_iter().find(|t| t.attribute("name") == Some(name)).unwrap();
    let (paint, mask) = (named("reflectance"), named("opacity"));
    let pixels = |node: &Node| PictureFile::open(&at("out").join(value(node, "filename").unwrap())).unwrap().read_all();
    assert_eq!(pixels(&paint).unwrap(), [[0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5], [0.5; 3]]);
    assert_eq!(pixels(&mask).unwrap(), [[1.0; 3], [0.0; 3]]);
    // (u, v) is at (2 u + 0.25, 1 - (3 v + 0.5)) from the upper left.
    let matrix = paint.descendants().find(|node| node.has_tag_name("matrix")).unwrap().attribute("value").unwrap();
    assert_eq!(matrix, "2 0 0 0.25 0 -3 0 0.5 0 0 1 0 0 0 0 1");
    assert_eq!(value(&paint, "wrap_mode"), Some("repeat"));
    assert!(scene.textures.values().all(|texture| texture.wrap == [Wrap::Repeat; 2]));
}

#[test]
fn a_folder_that_can_not_be_written_is_told_before_the_scene_is_read() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("file"), "").unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lucerna"));
    let target = folder.path().join("file").join("scene");
    let run = command.args(["export", "no-such-scene", "--mitsuba"]).arg(&target).output().unwrap();
    let text = String::from_utf8(run.stderr).unwrap();
    assert!(run.status.code() == Some(1) && text.contains("can't make the folder"), "{text}");
    assert!(text.contains("choose another place with --mitsuba DIR"), "{text}");
}
