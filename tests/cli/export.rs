//! `lucerna export`: what it refuses to write over.

use glam::UVec2;
use lucerna::components::Crop;
use lucerna::image::{Output, Picture};

use super::{folder_with, lucerna, refused};

const PLACED: &str = "mtllib a.mtl\nusemtl grey\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

#[test]
fn an_export_keeps_the_files_that_it_reads() {
    // The scene's own texture has the name, in the folder, of a picture that is written.
    let folder = folder_with("a.obj", PLACED.as_bytes());
    let mtl = "newmtl grey\nKd 0.6 0.6 0.6\nmap_Kd textures/1.exr\n";
    std::fs::write(folder.path().join("a.mtl"), mtl).unwrap();
    std::fs::create_dir(folder.path().join("textures")).unwrap();
    let texture = folder.path().join("textures/1.exr");
    let picture = Picture {
        size: UVec2::ONE,
        window: Crop { min: UVec2::ZERO, max: UVec2::ONE },
        linear: &[[0.25, 0.5, 0.75]],
        display: &[],
        metadata: &[],
        report: &serde_json::Value::Null,
    };
    Output::new(texture.clone()).unwrap().write(&picture).unwrap();
    let before = std::fs::read(&texture).unwrap();
    let said = refused(1, folder.path(), &["export", "a.ron", "--mitsuba", ".", "-q"]);
    assert!(said.contains("1.exr: is one of the files that are read: it would be lost"), "{said}");
    assert!(said.contains("--mitsuba DIR"), "{said}");
    assert!(std::fs::read(&texture).unwrap() == before, "the texture was written over");
    // Elsewhere all is well, also a second time.
    for _ in 0..2 {
        let run = lucerna(folder.path(), &["export", "a.ron", "--mitsuba", "out", "-q"]);
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    }
    assert!(std::fs::read(&texture).unwrap() == before);
}

#[cfg(unix)]
#[test]
fn an_export_writes_through_no_link_to_what_it_reads() {
    let folder = folder_with("a.obj", super::OBJ.as_bytes());
    std::fs::create_dir(folder.path().join("out")).unwrap();
    std::os::unix::fs::symlink("../a.obj", folder.path().join("out/scene.xml")).unwrap();
    let said = refused(1, folder.path(), &["export", "a.ron", "--mitsuba", "out", "-q"]);
    assert!(said.contains("scene.xml: is one of the files that are read"), "{said}");
    assert_eq!(std::fs::read_to_string(folder.path().join("a.obj")).unwrap(), super::OBJ);
}

#[test]
fn a_folder_that_can_not_be_made_is_told_with_the_flag_that_names_it() {
    let folder = folder_with("a.obj", super::OBJ.as_bytes());
    let said = refused(1, folder.path(), &["export", "a.ron", "--mitsuba", "a.mtl", "-q"]);
    assert!(said.contains("--mitsuba DIR") && !said.contains("-o FILE"), "{said}");
}
