//! OBJ files read by pieces: the same meshes and the same messages as line by line, wherever the pieces are cut.

use std::path::{Path, PathBuf};

use glam::DVec3;
use lucerna::components::MeshData;
use lucerna::scene::{Diagnostics, NamedMeshes, read_obj_by};

type Read = (Option<NamedMeshes>, Diagnostics);

/// Bytes of pieces: a line each, a few lines, and so many that most files are one.
const SIZES: [usize; 4] = [1, 40, 1000, 1 << 21];

/// The bits of a mesh: -0 is not 0.
fn bits(mesh: &MeshData) -> (Vec<u64>, Vec<u32>, Vec<[u32; 3]>) {
    let doubles = mesh.positions.iter().flat_map(|p| p.to_array()).map(f64::to_bits).collect();
    let uvs = mesh.uvs.iter().flat_map(|uv| uv.to_array());
    let singles = mesh.normals.iter().flat_map(|n| n.to_array()).chain(uvs).map(f32::to_bits).collect();
    let lists = [&mesh.triangles, &mesh.normal_triangles, &mesh.uv_triangles];
    (doubles, singles, lists.into_iter().flatten().copied().collect())
}

#[track_caller]
fn assert_same(read: &Read, want: &Read, what: &str) {
    assert_eq!(read.1, want.1, "{what}");
    let names =
        |read: &Read| read.0.as_ref().map(|meshes| meshes.iter().map(|mesh| mesh.0.clone()).collect::<Vec<_>>());
    assert_eq!(names(read), names(want), "{what}");
    for (mesh, want) in read.0.iter().flatten().zip(want.0.iter().flatten()) {
        assert!(mesh.1 == want.1 && bits(&mesh.1) == bits(&want.1), "{what}: {}", mesh.0);
    }
}

fn check(file: &Path, what: &str) {
    let want = read_obj_by(file, None);
    for size in SIZES {
        assert_same(&read_obj_by(file, Some(size)), &want, &format!("{what} in pieces of {size}"));
    }
}

/// Reads a text, and the same with line ends of all kinds.
fn check_text(folder: &Path, text: &[u8]) {
    let file = folder.join("model.obj");
    let what = String::from_utf8_lossy(text).chars().take(200).collect::<String>();
    let ends = ["\n", "\r\n", "\r"].map(|end| match std::str::from_utf8(text) {
        Ok(text) => text.replace('\n', end).into_bytes(),
        Err(_) => text.to_vec(),
    });
    for text in ends {
        std::fs::write(&file, text).unwrap();
        check(&file, &what);
    }
}

/// Every OBJ file below a folder.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "obj") {
            found.push(path);
        }
    }
}

#[test]
fn all_models_are_the_same_in_pieces() {
    let mut found = Vec::new();
    files(Path::new("assets"), &mut found);
    files(Path::new("tests"), &mut found);
    assert!(found.len() > 5, "{found:?}");
    for file in found {
        check(&file, &file.display().to_string());
    }
}

/// Triangles without area, but for rounding.
fn flat_triangles(mesh: &tobj::Mesh) -> usize {
    let corner = |index: u32| DVec3::from_slice(&mesh.positions[3 * index as usize..]);
    let is_flat = |corners: &&[u32]| {
        let [a, b, c] = [0, 1, 2].map(|k| corner(corners[k]));
        (b - a).cross(c - a).length() <= 1e-12 * (b - a).length() * (c - a).length()
    };
    mesh.indices.chunks_exact(3).filter(is_flat).count()
}

#[test]
fn all_models_are_what_tobj_makes_of_them() {
    let mut found = Vec::new();
    files(Path::new("assets"), &mut found);
    for file in found {
        let what = file.display();
        let options =
            tobj::LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, single_index: false };
        let (models, _) = tobj::load_obj(&file, &options).unwrap();
        // Order and cut of the meshes are our own; each corner of each triangle has to be there.
        let mut want: Vec<[u64; 3]> = Vec::new();
        for tobj::Model { mesh, .. } in &models {
            let corner = |index: &u32| [0, 1, 2].map(|axis| mesh.positions[3 * *index as usize + axis].to_bits());
            want.extend(mesh.indices.iter().map(corner));
        }
        let mut ours: Vec<[u64; 3]> = Vec::new();
        for (_, mesh) in read_obj_by(&file, Some(1 << 21)).0.unwrap() {
            let corner = |index: &u32| mesh.positions[*index as usize].to_array().map(f64::to_bits);
            ours.extend(mesh.triangles.iter().flatten().map(corner));
        }
        // Of a polygon with a corner on the line between its neighbours, cutting ears may leave out a triangle without area.
        let flat = models.iter().map(|model| flat_triangles(&model.mesh)).sum::<usize>();
        assert!((want.len() - 3 * flat..=want.len()).contains(&ours.len()), "{what}: {} of {}", ours.len(), want.len());
        let corners = |list: &[[u64; 3]]| list.iter().copied().collect::<std::collections::BTreeSet<_>>();
        assert!(corners(&ours) == corners(&want), "{what}");
    }
}

const CORNERS: &str = "v 0 0 0\nv 1 0 -0\nv 0 1 .5\nv 1. 1 1e-3\nvt 0 1\nvt 1\nvt 0.5 0.25 7\nvn 0 0 1\nvn 3 4 0\n";

/// Texts with all that is plain, odd and wrong.
fn texts() -> Vec<Vec<u8>> {
    let mut texts: Vec<Vec<u8>> = [
        "",
        "# nothing",
        "f 1 2 3",
        "v 0 0 0\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "\n\n  \t\nf 1 2 3\nf 1 2 3 4\n",
        "f 1 2 3 4\nf 4//1 3//2 2//1\nf 1/1 2/2 3/3\nf 1/1/1 2/2/2 3/3/1 4/1/2\n",
        "f -1 -2 -3\nv 0 0 2\nf -1 -2 -3\n",
        "f 1 2 3\nf 1 2 5\n",
        "f 1 2 -5\n",
        "f 1 2 0\n",
        "f 1 2\n",
        "f 1/1 2/2 3\nf 1 2/2 3\n",
        "f 1//3 2//1 3//1\n",
        "f 1/4 2/1 3/1\n",
        "f 1/2/3/4 1 1\n",
        "f 1/ 2/ 3/\nf 1// 2// 3//\n",
        "f +1 2 3\n",
        "f 1 2 3 # end\nf 1 2 3 #\n",
        "f 1 2 \\\n 3\nf 1 2 3 \\\n\n",
        "o a\nusemtl x\nf 1 2 3\ng b\nf 1 2 3\nusemtl y\nf 3 2 1\no a\nusemtl x\nf 1 2 3\n",
        "s 1\nf 1 2 3\nf 1//1 2//1 3//1\ns off\nf 1 2 3\n",
        "usemtl x\ns 1\nf 1//1 2//1 3//1\nf 1 2 3\n",
        "v 1 2 3 0.5 0.5 0.5\nv 1 2 4 1 1 1\nf 4 5 6\nv 1 2 3 # a\nv 1 2 3 4 # a\nf 1 2 7\n",
        "v 1 2 3 \\\n 4\nf 1 2 3\n",
        "v 0 0 nan\n",
        "v 0 0 1e13\n",
        "v 0 0 -1e12\nf 1 2 5\n",
        "v 1 2\n",
        "v 1,5 2 3\n",
        "vn 0 0 0\nvn 1e-200 0 0\nf 1//3 2//4 3//1\n",
        "vn 1 2\n",
        "vn 1e39 0 0\nf 1//3 2//3 3//3\n",
        "vt nan\nvt 1e39 0\nf 1/4 2/5 3/1\n",
        "vt\n",
        "vt 1 2 3 4\nvn 1 0 0 x\nf 1/4/3 2/1/1 3/1/1\n",
        "l 1 2\np 1\nf 1 2 3\nl 1 2\n",
        "f 1 2 3\no a \\\nf 3 2 1\nf 1 2 3\n",
        "curv 0 1\nf 1 2 3\n",
        "bogus\nf 1 2 3\n",
        "mtllib\nmtllib a.mtl\nf 1 2 3\nmtllib \"b c.mtl\" d.mtl\n",
        "fo 1 2 3\n",
        "usemtl\nf 1 2 3\n",
        "f 1 2 3\n\u{1a}",
        "f 1 2 3\u{1a}",
        "f 1 2 3\n\u{1a}\nf 1 2 3\n",
        "f 1 2 3\n\0\0\n\0",
        "# a \0 b\nf 1 2 3\n",
        "f 1 2 3\n# C:\\\nf 1 2 3\n",
        "f 1 2 3\\",
        "f 1 2 3\n\\\nf 1 2 3\n",
        "v 1.7976931348623157e11 123456789012345678901234567890e-20 0.1234567890123456789012\nf 1 2 5\n",
        "v 9007199254740993 1 1\n",
        "v 0.3 0.1 123456.789012345\nf 1 2 5\n",
        "f\u{a0}1 2 3\n",
        "o caf\u{e9}\nf 1 2 3\n",
        "f 1 2 3\u{3000}4\n",
        "V 1 2 3\n",
        "f 1 2 99999999999\n",
        "f 1 2 3\n   f 2 3 4  \n\tf\t1\t2\t3\t\n",
        "f 1 1 1\nf 1 2 1 2\nf 1 2 3 4 1\n",
    ]
    .iter()
    .map(|text| format!("{CORNERS}{text}").into_bytes())
    .collect();
    texts.push(b"\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec());
    texts.push(b"\xef\xbb\xbf# a\n\xef\xbb\xbfv 0 0 0\n".to_vec());
    texts.push([CORNERS.as_bytes(), b"o \xe9t\xe9\nf 1 2 3 # gr\xfcn\n# \xff\nf 1 2 3\n"].concat());
    texts.push([CORNERS.as_bytes(), b"f 1 2 \xff\n"].concat());
    texts.push([CORNERS.as_bytes(), b"o \x83\x5c\nf 1 2 3\n"].concat());
    texts.push([CORNERS.as_bytes(), "f 1 2 3\n".repeat(40).as_bytes(), "bogus\n".repeat(15).as_bytes()].concat());
    texts.push([CORNERS.as_bytes(), "f 1/1 2 3\nvn 0 0 0\n".repeat(20).as_bytes()].concat());
    texts
}

#[test]
fn all_that_is_plain_odd_and_wrong_is_told_alike() {
    let folder = tempfile::tempdir().unwrap();
    texts().iter().for_each(|text| check_text(folder.path(), text));
}

#[test]
fn lines_that_are_too_long_are_told_alike() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("model.obj");
    // At the limit, and beyond it: blank, a comment, and spaces between and behind corners.
    for length in [4 << 20, (4 << 20) + 1, 5 << 20] {
        for (first, last) in [("", ""), ("#", "#"), ("f 1 2", "3"), ("f 1 2 3", " ")] {
            let line = format!("{first}{}{last}", " ".repeat(length - first.len() - last.len()));
            for end in ["\n", "\r\n"] {
                std::fs::write(&file, format!("{CORNERS}{line}{end}f 1 2 3\n")).unwrap();
                let want = read_obj_by(&file, None);
                assert_eq!(want.0.is_none(), length > 4 << 20, "{first}: {length}");
                let what = format!("{first:?}, {length} bytes, end {end:?}");
                assert_same(&read_obj_by(&file, Some(1 << 21)), &want, &what);
            }
        }
    }
}

#[test]
fn numbers_are_read_to_the_bit() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = lucerna::scene::generate::SplitMix(3);
    let mut text = "v 1 2 3\n".repeat(3);
    for number in 0..3000 {
        let mut word = || {
            let (digits, places) = (random.next_u64() % 20, random.next_u64() % 24);
            let whole = random.next_u64() % 10u64.pow(digits as u32);
            let value = whole as f64 * 10f64.powi(-(places as i32));
            match random.next_u64() % 5 {
                0 => format!("{value:e}"),
                1 => format!("{value:.*}", places as usize),
                2 => format!("-{whole}."),
                3 => format!("{}.{whole:0>20}", whole % 1000),
                _ => format!("{value}"),
            }
        };
        text += &format!("v {} {} {}\n", word(), word(), word());
        text += if number % 3 == 2 { "f -1 -2 -3\n" } else { "" };
    }
    // A vertex may not be at more than 1e12.
    let text: String = text
        .lines()
        .filter(|line| {
            let fits = |word: &str| word.parse::<f64>().is_ok_and(|value| value.abs() < 1e12);
            line.starts_with('f') || line.split(' ').skip(1).all(fits)
        })
        .map(|line| format!("{line}\n"))
        .collect();
    check_text(folder.path(), text.as_bytes());
    let (meshes, _) = read_obj_by(&folder.path().join("model.obj"), Some(1 << 21));
    let mut words = text.lines().filter(|line| line.starts_with('v')).flat_map(|line| line.split(' ').skip(1));
    let vertices: Vec<u64> = words.by_ref().map(|word| word.parse::<f64>().unwrap().to_bits()).collect();
    let mesh = &meshes.unwrap()[0].1;
    for position in &mesh.positions {
        assert!(position.to_array().iter().all(|value| vertices.contains(&value.to_bits())), "{position}");
    }
}

#[test]
fn texts_that_were_spoilt_are_told_alike() {
    // Bytes of a good text exchanged, doubled and taken out, at random.
    let folder = tempfile::tempdir().unwrap();
    let good: Vec<u8> = texts()[6..8].concat();
    let mut random = lucerna::scene::generate::SplitMix(7);
    for _ in 0..300 {
        let mut text = good.clone();
        for _ in 0..=random.next_u64() % 3 {
            let at = random.next_u64() as usize % text.len();
            match random.next_u64() % 3 {
                0 => text[at] = b" \t\n\r/-#\\0.e\x1a\0f"[random.next_u64() as usize % 14],
                1 => text.insert(at, text[at]),
                _ => drop(text.remove(at)),
            }
        }
        std::fs::write(folder.path().join("model.obj"), &text).unwrap();
        check(&folder.path().join("model.obj"), &String::from_utf8_lossy(&text));
    }
}
