use std::sync::Arc;
use std::time::Duration;

use glam::{UVec2, Vec2};
use lucerna::components::{Channel, Reading, Texels, Texture, TextureFilter, TextureImage};
use lucerna::engine::Engine;
use lucerna::scene::{self, TextureMap};
use lucerna::shader::Library;

use crate::support;

#[test]
#[ignore]
fn look() {
    let dir = tempfile::tempdir().unwrap();
    let obj = dir.path().join("a.obj");
    std::fs::write(
        &obj,
        "mtllib a.mtl\nv -2 0 -2\nv 2 0 -2\nv 2 0 2\nv -2 0 2\nv -1 0.1 -1\nv 1 0.1 -1\nv 1 2.1 -1\nv -1 2.1 -1\n\
         v -1 3 -1\nv 1 3 -1\nv 1 3 1\nv -1 3 1\nv 0.2 0.2 0\nv 1.2 0.2 0.4\nv 1.2 1.2 0.4\nv 0.2 1.2 0\n\
         vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0 0\nvt 4 0\nvt 4 4\nvt 0 4\n\
         usemtl floor\nf 1/5 4/8 3/7 2/6\nusemtl wall\nf 5/1 6/2 7/3 8/4\nusemtl lamp\nf 9/1 10/2 11/3 12/4\nusemtl leaf\nf 13/1 14/2 15/3 16/4\n",
    )
    .unwrap();
    std::fs::write(
        dir.path().join("a.mtl"),
        "newmtl floor\nKd 1 1 1\nnewmtl wall\nKd 0.8 0.8 0.8\nKs 0.2 0.2 0.2\nNs 50\nnewmtl lamp\nKd 0 0 0\nKe 8 8 8\nnewmtl leaf\nKd 0.2 0.7 0.1\n",
    )
    .unwrap();
    std::fs::write(
        dir.path().join("a.ron"),
        "(models: [(path: \"a.obj\")], cameras: {\"c\": (position: (0.5, 1.4, 4.5), look_at: (0, 1.1, 0))}, environment: Constant((0.15, 0.2, 0.3)))",
    )
    .unwrap();
    let mut loaded = scene::load(&dir.path().join("a.ron"), &[]).unwrap().description;
    let size = UVec2::new(256, 256);
    let image = |f: &dyn Fn(u32, u32) -> [u8; 4]| {
        let texels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| (x, y))).map(|(x, y)| f(x, y)).collect();
        Arc::new(TextureImage { size, texels: Texels::Rgba8(texels) })
    };
    let checker = image(&|x, y| {
        if (x / 32 + y / 32) % 2 == 0 { [230, 60 + (y / 2) as u8, 40, 255] } else { [240, 240, (x) as u8, 255] }
    });
    let disc = |x: u32, y: u32| Vec2::new(x as f32 - 128.0, y as f32 - 128.0).length();
    let leaf = image(&|x, y| if disc(x, y) < 100.0 && disc(x, y) > 50.0 { [255; 4] } else { [0, 0, 0, 255] });
    let bumps = image(&|x, y| {
        let v = (((x as f32 * 0.2).sin() * (y as f32 * 0.2).sin()) * 100.0 + 128.0) as u8;
        [v, v, v, 255]
    });
    let glow = image(&|x, y| if (x / 64 + y / 64) % 2 == 0 { [255, 120, 40, 255] } else { [0, 0, 0, 255] });
    let mut add = |file: &str, texture: Texture, used| {
        let map = TextureMap::new(file);
        loaded.textures.insert(scene::texture_name(&map, used), texture);
        map
    };
    use scene::MapUse;
    let kd = add("checker", Texture::new(checker, Reading::Colour), MapUse::Colour);
    let d = add("leaf", Texture::new(leaf, Reading::Number(Channel::Luminance)), MapUse::Number);
    let height = Reading::Height { channel: Channel::Luminance, depth: 0.03 };
    let bump = add("bumps", Texture::new(bumps, height), MapUse::Bump);
    let ke = add("glow", Texture::new(glow, Reading::Colour), MapUse::Colour);
    loaded.materials.get_mut("a:floor").unwrap().maps.kd = Some(kd.clone());
    loaded.materials.get_mut("a:wall").unwrap().maps.bump = Some(bump);
    loaded.materials.get_mut("a:leaf").unwrap().maps.d = Some(d);
    loaded.materials.get_mut("a:lamp").unwrap().maps.ke = Some(ke);
    loaded.film.size = UVec2::new(384, 288);
    loaded.render.spp = 64;
    for filter in [TextureFilter::Footprint, TextureFilter::Exact] {
        loaded.render.texture_filter = filter;
        let mut engine = Engine::open(support::gpu(), Library::shipped(), &loaded).unwrap();
        let begin = std::time::Instant::now();
        while !engine.step(Duration::from_secs(1)).unwrap().finished {}
        let film = engine.film().unwrap();
        println!("{filter:?}: {:?} {} {:?} {:?}", begin.elapsed(), film.relative_error, film.mean, engine.features());
        let file = std::fs::File::create(format!("/tmp/look-{filter:?}.png")).unwrap();
        let mut encoder = png::Encoder::new(file, film.size.x, film.size.y);
        encoder.set_color(png::ColorType::Rgba);
        let bytes: Vec<u8> = film.picture.iter().flatten().copied().collect();
        encoder.write_header().unwrap().write_image_data(&bytes).unwrap();
    }
}
