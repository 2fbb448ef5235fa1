//! OBJ files: geometry, groups, and what is wrong at which place; and triangulation.

use std::path::Path;

use glam::{DVec3, Vec2, Vec3};
use lucerna::components::MeshData;
use lucerna::scene::{Diagnostics, Loaded, Severity, load, triangulate};

/// Loads `model.obj` with these bytes, beside `model.mtl`.
fn read(obj: &[u8]) -> Result<Loaded, Diagnostics> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("model.obj"), obj).expect("a file");
    std::fs::write(folder.path().join("model.mtl"), "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n").expect("a file");
    load(&folder.path().join("model.obj"), &[])
}

fn mesh(obj: &str) -> MeshData {
    let loaded = read(obj.as_bytes()).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(loaded.description.meshes.len(), 1);
    let (_, mesh) = loaded.description.meshes.first_key_value().expect("a mesh");
    MeshData::clone(&mesh.geometry)
}

/// Corners of all triangles, in order.
fn corners(mesh: &MeshData) -> Vec<[DVec3; 3]> {
    mesh.triangles.iter().map(|triangle| triangle.map(|corner| mesh.positions[corner as usize])).collect()
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn positions_keep_all_digits_of_f64() {
    let mesh = mesh("v 1000000.000000123 0.1 -1e-300\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_eq!(mesh.positions[0], DVec3::new(1000000.000000123, 0.1, -1e-300));
}

#[test]
fn indices_may_be_negative_and_attributes_absent() {
    let want = corners(&mesh(&format!("{TRIANGLE}f 1 2 3\n")));
    for face in ["f -3 -2 -1", "f 1 2 -1", "f 1// 2// 3//", "f 1/ 2/ 3/", "fo 1 2 3"] {
        let mesh = mesh(&format!("{TRIANGLE}{face}\n"));
        assert_eq!(corners(&mesh), want, "{face}");
        assert!(mesh.normals.is_empty() && mesh.normal_triangles.is_empty());
        assert!(mesh.uvs.is_empty() && mesh.uv_triangles.is_empty());
    }
}

#[test]
fn normals_and_texture_coordinates_have_their_own_indices() {
    let mesh = mesh(&format!("{TRIANGLE}vn 0 0 2\nvn 3 0 4\nvt 0.25 0.5\nvt 0.75\nf 1/2/2 2/1/1 3/2/1\n"));
    let normal = |at: usize| mesh.normals[mesh.normal_triangles[0][at] as usize];
    let uv = |at: usize| mesh.uvs[mesh.uv_triangles[0][at] as usize];
    assert_eq!([normal(0), normal(1), normal(2)], [Vec3::new(0.6, 0.0, 0.8), Vec3::Z, Vec3::Z]);
    assert_eq!([uv(0), uv(1), uv(2)], [Vec2::new(0.75, 0.0), Vec2::new(0.25, 0.5), Vec2::new(0.75, 0.0)]);
}

#[test]
fn text_may_have_any_line_ends_a_mark_and_continuations() {
    let want = corners(&mesh(&format!("{TRIANGLE}f 1 2 3\n")));
    let texts = [
        format!("{TRIANGLE}f 1 2 3"),
        format!("\u{feff}{TRIANGLE}f 1 2 3\n"),
        format!("{TRIANGLE}f 1 2 3\n").replace('\n', "\r\n"),
        format!("{TRIANGLE}f 1 2 3\n").replace('\n', "\r"),
        format!("{TRIANGLE}f 1 \\\n 2 \\\r\n 3\n"),
        format!("# C:\\models\\\n{TRIANGLE}f 1 2 3 # the only one\n"),
        format!("  {TRIANGLE}\n\n\t f  1\t2  3  \n"),
        format!("{TRIANGLE}f 1 2 3\\"),
        format!("{TRIANGLE}f 1 \\ \n 2 \\\t \r\n 3\n"),
        format!("{TRIANGLE}f 1 2 3\n\u{1a}"),
        format!("{TRIANGLE}f 1 2 3\u{1a}"),
        format!("{TRIANGLE}f 1 2 3\r\n\u{1a}\u{1a}\r\n\n"),
        format!("{TRIANGLE}f 1 2 3\n\0\0\0\0\n\0"),
        format!("{TRIANGLE}f 1 2 3\0"),
    ];
    for text in texts {
        assert_eq!(corners(&mesh(&text)), want, "{text:?}");
    }
    let latin = [b"# caf\xe9\n".as_slice(), TRIANGLE.as_bytes(), b"f 1 2 3 # gr\xfcn\n"].concat();
    assert!(read(&latin).is_ok(), "comments may be in any encoding");
}

#[test]
fn parts_are_named_by_object_and_number() {
    let obj = format!(
        "mtllib model.mtl\n{TRIANGLE}vn 0 0 1\no lid\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\nusemtl red\nf 3 2 1\n\
         f 1//1 2//1 3//1\no base\ng left\nf 1 2 3\ng right side\nf 1 2 3\no lid\nf 1 2 3\n"
    );
    let scene = read(obj.as_bytes()).unwrap_or_else(|errors| panic!("{errors}")).description;
    let parts: Vec<(&str, &str, usize)> = scene
        .meshes
        .iter()
        .map(|(name, mesh)| (name.as_str(), mesh.material.as_str(), mesh.geometry.triangles.len()))
        .collect();
    assert_eq!(
        parts,
        [
            ("model/base/left/0", "model:red", 1),
            ("model/base/right side/0", "model:red", 1),
            ("model/lid/0", "model:red", 3),
            ("model/lid/1", "model:blue", 1),
            ("model/lid/2", "model:red", 1),
        ]
    );
    assert_eq!(scene.meshes["model/lid/2"].geometry.normals, [Vec3::Z]);
    assert_eq!(scene.materials["model:blue"].kd, Vec3::Z);
}

#[test]
fn a_file_of_many_blocks_arrives_whole() {
    // Enough faces that they are passed on in several pieces, with two materials that take turns.
    let mut obj = String::from("mtllib model.mtl\n");
    let count = 700_000_u32;
    for i in 0..count {
        obj += &format!("v {i} 0 0\nv {i} 1 0\nv {i} 0 1\n");
        obj += if i % 2 == 0 { "usemtl red\n" } else { "usemtl blue\n" };
        obj += "f -3 -2 -1\n";
    }
    let scene = read(obj.as_bytes()).unwrap_or_else(|errors| panic!("{errors}")).description;
    assert_eq!(scene.meshes.len(), 2);
    for (material, mesh) in scene.meshes.values().enumerate() {
        let corners = corners(&mesh.geometry);
        assert_eq!(corners.len() as u32, count / 2);
        for (i, triangle) in corners.iter().enumerate() {
            let x = f64::from(2 * i as u32 + material as u32);
            assert_eq!(*triangle, [DVec3::new(x, 0.0, 0.0), DVec3::new(x, 1.0, 0.0), DVec3::new(x, 0.0, 1.0)]);
        }
    }
}

/// What is wrong, where it is reported, and a part of the message.
const WRONG: &[(&str, u32, u32, &str)] = &[
    ("", 1, 1, "the file ends here without a face"),
    ("# nothing\nv 0 0 0", 2, 1, "the file ends here without a face"),
    ("v 0 0 nan\n", 1, 7, "a vertex can't be at NaN"),
    ("v 0 -inf 0\n", 1, 5, "a vertex can't be at infinity"),
    ("v 0 1e999 0\n", 1, 5, "a vertex can't be at infinity"),
    ("v 0 1e13 0\n", 1, 5, "beyond 1e12"),
    ("v 0 0\n", 1, 1, "three coordinates, this one has 2"),
    ("v 0 zero 0\n", 1, 5, "`zero` is not a number"),
    ("v 0 0 0\nf 1 2147483648 1\n", 2, 5, "there is no vertex (`v`) 2147483648: 1 come before this line"),
    ("v 0 0 0\nf 1 -2147483648 1\n", 2, 5, "there is no vertex"),
    ("v 0 0 0\nf 1 99999999999999999999 1\n", 2, 5, "is not an index"),
    ("v 0 0 0\nf 1 -9223372036854775808 1\n", 2, 5, "there is no vertex"),
    ("v 0 0 0\nf 0 1 1\n", 2, 3, "0 is none"),
    ("v 0 0 0\nf 1 1 2\nv 1 1 1\n", 2, 7, "1 come before this line"),
    ("v 0 0 0\nf 1/1 1/1 1/1\n", 2, 5, "no texture coordinate (`vt`) 1: 0 come before"),
    ("v 0 0 0\nf 1//1 1//1 1//1\n", 2, 6, "no normal (`vn`) 1"),
    ("v 0 0 0\nf 1/1/1/1 1 1\n", 2, 3, "has more parts"),
    ("v 0 0 0\nf /1 1 1\n", 2, 3, "has no vertex index"),
    ("v 0 0 0\nf 1 1\n", 2, 1, "at least three corners, this one has 2"),
    ("v 0 0 0\nf\n", 2, 1, "this one has 0"),
    ("v 0 0 0\nf 1.5 1 1\n", 2, 3, "`1.5` is not an index"),
    ("vn 1 2\n", 1, 1, "`vn` needs 3 numbers, this one has 2"),
    ("vn 1 2 x\n", 1, 8, "`x` is not a number"),
    ("vt\n", 1, 1, "`vt` needs 1 numbers"),
    ("usemtl\n", 1, 1, "without a name"),
    ("v 0,5 0 0\n", 1, 3, "decimals have a point: `0.5`"),
    ("ff 1 2 3\n", 1, 1, "did you mean `f`"),
    ("vertex 1 2 3\n", 1, 1, "unknown statement `vertex`"),
    ("v 0 0 0\nv 0 0 \\\n  nan\n", 3, 3, "NaN"),
    ("\u{feff}v 0 0 x\n", 1, 7, "`x`"),
    ("o ä\nv ö 0 0\n", 2, 3, "`ö`"),
    ("v 0 0 0\0\n", 1, 8, "a zero byte"),
    ("v 0 0 0\n\0\0\0\0", 2, 1, "a zero byte"),
    ("v 0 0 0\n\0\0\nf 1 1 1\n", 2, 1, "a zero byte"),
    ("v 0 0 0\u{1a}\nf 1 1 1\n", 1, 8, "Ctrl-Z"),
    ("v 0 0 -nan(ind)\n", 1, 7, "a vertex can't be at NaN"),
    ("v 0 0 nan(snan)\n", 1, 7, "a vertex can't be at NaN"),
    ("v 1.#QNAN 0 0\n", 1, 3, "a vertex can't be at NaN"),
    ("v -1.#IND 0 0\n", 1, 3, "a vertex can't be at NaN"),
    ("v 1.#IND000000 0 0\n", 1, 3, "a vertex can't be at NaN"),
    ("v 0 1.#INF 0\n", 1, 5, "a vertex can't be at infinity"),
    ("v 0 -1.#INF00 0\n", 1, 5, "a vertex can't be at infinity"),
    ("v 0 1.#J 0\n", 1, 5, "a vertex can't be at infinity"),
    ("v 0 1.# 0\n", 1, 5, "`1.#` is not a number"),
    ("v 0 nano 0\n", 1, 5, "`nano` is not a number"),
];

#[test]
fn wrong_files_are_reported_where_they_are_wrong() {
    for (text, line, column, message) in WRONG {
        let Err(errors) = read(text.as_bytes()) else { panic!("taken: {text:?}") };
        let error = errors.list.iter().find(|found| found.severity == Severity::Error).expect("an error");
        assert!(error.to_string().contains(message), "{text:?}\n{error}");
        assert_eq!((error.line, error.column), (*line, *column), "{text:?}\n{error}");
        assert!(error.file.ends_with("model.obj"));
    }
}

#[test]
fn binary_files_are_refused_at_once() {
    let error = read(b"v 0 0 0\nv \xff\xfe 0\n").unwrap_err();
    assert!(error.to_string().contains("model.obj:2:3: error: byte 0xff is not UTF-8"), "{error}");
    let utf16: Vec<u8> = std::iter::once(0xfeff).chain("v 0 0 0\n".encode_utf16()).flat_map(u16::to_le_bytes).collect();
    let error = read(&utf16).unwrap_err();
    assert!(error.to_string().contains("UTF-16"), "{error}");
    let error = read(&vec![b'a'; 5 << 20]).unwrap_err();
    assert!(error.to_string().contains("a line of more than"), "{error}");
    // Noise without zero bytes: ten errors are enough.
    let noise = "qwertz 1 2 3\n".repeat(10_000);
    assert_eq!(read(noise.as_bytes()).unwrap_err().list.len(), 10);
}

#[test]
fn missing_files_and_folders_say_what_to_do() {
    let error = load(Path::new("no/such/model.obj"), &[]).unwrap_err();
    assert!(error.to_string().contains("there is no such file"), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("folder.obj");
    std::fs::create_dir(&path).unwrap();
    let error = load(&path, &[]).unwrap_err();
    assert!(error.to_string().contains("this is a folder"), "{error}");
    // A sparse file: refused by its size, unread.
    let path = folder.path().join("large.obj");
    std::fs::File::create(&path).unwrap().set_len((4 << 30) + 1).unwrap();
    let error = load(&path, &[]).unwrap_err();
    assert!(error.to_string().contains("too large"), "{error}");
}

/// What is used, but not as written: where it is said, and a part of the message.
const DOUBTFUL: &[(&str, u32, u32, &str)] = &[
    ("mtllib none.mtl\nusemtl red\n", 1, 8, "there is no material library"),
    ("usemtl red\n", 1, 8, "no library has a material `red`, for no `mtllib` names one"),
    ("usemtl rde\n", 1, 8, "did you mean `red`"),
    ("vn -nan(ind) -nan(ind) -nan(ind)\n", 1, 1, "no direction"),
    ("vn 1.#QNAN 1.#QNAN 1.#QNAN\n", 1, 1, "no direction"),
    ("vn 1.#INF 0 0\n", 1, 1, "no direction"),
    ("vt -1.#IND 0\n", 1, 1, "not finite"),
    ("mtllib model.mtl\nusemtl rde\n", 2, 8, "did you mean `red`"),
    ("s 1\nmtllib model.mtl\nusemtl red\n", 7, 1, "rendered flat"),
    ("l 1 2\n", 1, 1, "points and lines"),
    ("v 0 0 0 1\n", 1, 1, "weights and colours"),
    ("cstype bezier\n", 1, 1, "`cstype` is not supported"),
    ("vt nan 0\n", 1, 1, "not finite"),
    ("vn 0 0 0\n", 1, 1, "no direction"),
    ("vn nan 0 0\n", 1, 1, "no direction"),
    ("vn 1e-300 0 0\n", 1, 1, "no direction"),
    ("vn 1e300 0 0\n", 1, 1, "no direction"),
    ("", 4, 1, "no `usemtl` before this face"),
];

#[test]
fn what_is_not_taken_as_written_is_a_warning() {
    for (text, line, column, message) in DOUBTFUL {
        let loaded =
            read(format!("{text}{TRIANGLE}f -3 -2 -1\n").as_bytes()).unwrap_or_else(|errors| panic!("{errors}"));
        let found = loaded.warnings.iter().find(|found| found.to_string().contains(message));
        let found = found.unwrap_or_else(|| panic!("{text}: {:?}", loaded.warnings));
        assert_eq!((found.line, found.column), (*line, *column), "{found}");
    }
}

#[test]
fn repeated_warnings_are_counted() {
    let loaded = read(format!("{}{TRIANGLE}f -3 -2 -1\n", "vn 0 0 0\n".repeat(1000)).as_bytes()).unwrap();
    let found: Vec<String> = loaded.warnings.iter().map(|found| found.to_string()).collect();
    assert_eq!(found.iter().filter(|found| found.contains("no direction")).count(), 8);
    assert!(found.iter().any(|found| found.contains("and 992 more: normals without a direction")), "{found:?}");
}

#[test]
fn useless_normals_become_those_of_the_face() {
    let mesh = mesh(&format!("{TRIANGLE}vn 0 0 0\nvn 1 0 0\nf 1//1 2//2 3//nan\n").replace("//nan", "//1"));
    let normals = mesh.normal_triangles[0].map(|normal| mesh.normals[normal as usize]);
    assert_eq!(normals, [Vec3::Z, Vec3::X, Vec3::Z]);
}

/// Twice the area of a polygon in the plane z = 0.
fn doubled_area(polygon: &[DVec3]) -> f64 {
    (0..polygon.len()).map(|i| polygon[i].cross(polygon[(i + 1) % polygon.len()]).z).sum()
}

/// Checks that triangles cover a polygon of the plane z = 0 once: areas of one sign that add up, corners all used,
/// and every edge of the polygon the edge of exactly one triangle.
fn assert_covers(polygon: &[DVec3], triangles: &[[u32; 3]]) {
    let area = doubled_area(polygon);
    let areas: Vec<f64> = triangles.iter().map(|t| doubled_area(&t.map(|corner| polygon[corner as usize]))).collect();
    assert!(areas.iter().all(|part| part * area.signum() >= -1e-12 * area.abs()), "{areas:?}");
    assert!((areas.iter().sum::<f64>() - area).abs() <= 1e-9 * area.abs(), "{areas:?}, {area}");
    assert_eq!(triangles.len(), polygon.len() - 2, "{triangles:?}");
    for corner in 0..polygon.len() as u32 {
        let edge = (corner, (corner + 1) % polygon.len() as u32);
        let has = |t: &&[u32; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])].contains(&edge);
        assert_eq!(triangles.iter().filter(has).count(), 1, "{edge:?} in {triangles:?}");
    }
}

fn plane(points: &[(f64, f64)]) -> Vec<DVec3> {
    points.iter().map(|(x, y)| DVec3::new(*x, *y, 0.0)).collect()
}

#[test]
fn polygons_are_covered_once() {
    let shapes: &[&[(f64, f64)]] = &[
        &[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)],
        &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
        // Darts, with the reflex corner in each place.
        &[(0.0, 0.0), (2.0, 1.0), (0.0, 2.0), (0.5, 1.0)],
        &[(0.5, 1.0), (0.0, 0.0), (2.0, 1.0), (0.0, 2.0)],
        &[(0.0, 2.0), (0.5, 1.0), (0.0, 0.0), (2.0, 1.0)],
        // An L, an arrow, a comb.
        &[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)],
        &[(0.0, 0.0), (3.0, 2.0), (0.0, 4.0), (1.0, 3.0), (-4.0, 3.0), (-4.0, 1.0), (1.0, 1.0)],
        &[(0.0, 0.0), (5.0, 0.0), (5.0, 3.0), (4.0, 1.0), (3.0, 3.0), (2.0, 1.0), (1.0, 3.0)],
        // Corners on straight edges, where the fan and where only ears work.
        &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)],
        &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0), (0.0, 2.0), (0.0, 1.0)],
        &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0), (0.0, 1.5)],
    ];
    for shape in shapes {
        let polygon = plane(shape);
        assert_covers(&polygon, &triangulate(&polygon));
        let reversed: Vec<DVec3> = polygon.iter().rev().copied().collect();
        assert_covers(&reversed, &triangulate(&reversed));
    }
}

#[test]
fn polygons_anywhere_in_space_are_cut_as_in_the_plane() {
    let polygon = plane(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)]);
    for scale in [1e-6, 1.0, 1e6] {
        for offset in [DVec3::ZERO, DVec3::new(1e4, -1e4, 1e4)] {
            let turn = glam::DMat3::from_rotation_y(0.7) * glam::DMat3::from_rotation_x(-1.1);
            let moved: Vec<DVec3> = polygon.iter().map(|point| turn * *point * scale + offset * scale).collect();
            assert_covers(&polygon, &triangulate(&moved));
        }
    }
}

#[test]
fn polygons_without_a_proper_shape_still_become_triangles() {
    let ring = plane(&[
        // A square with a square hole, joined by a bridge that is walked twice.
        (0.0, 0.0),
        (3.0, 0.0),
        (3.0, 3.0),
        (0.0, 3.0),
        (0.0, 0.0),
        (1.0, 1.0),
        (1.0, 2.0),
        (2.0, 2.0),
        (2.0, 1.0),
        (1.0, 1.0),
    ]);
    let area: f64 = triangulate(&ring).iter().map(|t| doubled_area(&t.map(|corner| ring[corner as usize]))).sum();
    assert!((area - doubled_area(&ring)).abs() < 1e-9, "{area}");
    let line = plane(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]);
    assert_eq!(triangulate(&line).len(), 2);
    assert_eq!(triangulate(&[DVec3::ONE; 5]).len(), 3);
    let bow = plane(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]);
    assert!(!triangulate(&bow).is_empty());
    assert!(triangulate(&line[..2]).is_empty() && triangulate(&[]).is_empty());
    let huge: Vec<DVec3> = bow.iter().map(|point| *point * 1e12).collect();
    assert!(!triangulate(&huge).is_empty());
}

#[test]
fn a_concave_face_arrives_with_its_attributes() {
    let obj = "v 0 0 0\nv 2 1 0\nv 0 2 0\nv 0.5 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nvn 0 0 1\n\
               f 1/1/1 2/2/1 3/3/1 4/4/1\n";
    let mesh = mesh(obj);
    assert_eq!(mesh.triangles.len(), 2);
    for (triangle, uvs) in mesh.triangles.iter().zip(&mesh.uv_triangles) {
        // Position and texture coordinate were given in the same order.
        assert_eq!(triangle, uvs);
    }
    let diagonal = |t: &[u32; 3]| t.contains(&1) && t.contains(&3);
    assert!(mesh.triangles.iter().all(diagonal), "the cut runs from the reflex corner: {:?}", mesh.triangles);
}

/// The worst polygon found for ear clipping, at the greatest size that is accepted, ends in reasonable time.
#[test]
fn large_faces_end_soon() {
    let count = 1 << 14;
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f64 / f64::from(1 << 24)
    };
    let star: Vec<DVec3> = (0..count)
        .map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / count as f64;
            DVec3::new(angle.cos(), angle.sin(), 0.0) * (0.1 + random())
        })
        .collect();
    assert!(triangulate(&star).len() > count / 2);
    let tangle: Vec<DVec3> = (0..count).map(|_| DVec3::new(random(), random(), 0.0)).collect();
    let started = std::time::Instant::now();
    triangulate(&tangle);
    eprintln!("tangle: {:?}", started.elapsed());
}
