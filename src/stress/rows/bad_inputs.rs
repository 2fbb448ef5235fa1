//! Files with numbers that are none.

use std::fs;
use std::path::Path;

use crate::scene;
use crate::stress::lab::{Lab, finish};
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;

pub static ROW: Row = Row {
    name: "bad-inputs",
    holds: "NaN, infinity and overflow in vertices, normals, uvs, materials, cameras: told at their place, no bad pixel",
    quantity: "files that are not",
    most: 0.0,
    unit: "files",
    sizes: [1, 1, 1],
    measure,
};

const OBJ: &str = "mtllib a.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nf 1/1/1 2/1/1 3/1/1\n";
const MTL: &str =
    "newmtl a\nKd 0.5 0.5 0.5\nKs 0.1 0.1 0.1\nNs 10\nKe 0.1 0.1 0.1\nNi 1.5\nd 1\nPr 0.5\nPm 0.5\nPc 0.5\n";
const RON: &str = "(models: [(path: \"a.obj\", transform: (scale: 1.0))], \
    cameras: {\"c\": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 42.0)}, \
    environment: Constant((0.5, 0.5, 0.5)), film: (size: (8, 8), exposure: 0.0), render: (spp: 2))";

/// Numbers that are none, or none that fit.
const WRONG: [&str; 4] = ["nan", "inf", "-inf", "1e999"];

/// A file, a text in it, and what it becomes, with `#` for the number.
const PLACES: [(usize, &str, &str); 17] = [
    (0, "v 1 -1 0", "v 1 # 0"),
    (0, "vn 0 0 1", "vn 0 # 1"),
    (0, "vt 0 0", "vt # 0"),
    (1, "Kd 0.5 0.5 0.5", "Kd 0.5 # 0.5"),
    (1, "Ks 0.1 0.1 0.1", "Ks # 0.1 0.1"),
    (1, "Ns 10", "Ns #"),
    (1, "Ke 0.1 0.1 0.1", "Ke 0.1 0.1 #"),
    (1, "Ni 1.5", "illum 7\nNi #"),
    (1, "d 1", "d #"),
    (1, "Pr 0.5", "Pr #"),
    (1, "Pm 0.5", "Pm #"),
    (1, "Pc 0.5", "Pc #"),
    (2, "scale: 1.0", "scale: #"),
    (2, "position: (0, 0, 3)", "position: (0, 0, #)"),
    (2, "fov_y: 42.0", "fov_y: #"),
    (2, "Constant((0.5, 0.5, 0.5))", "Constant((0.5, #, 0.5))"),
    (2, "exposure: 0.0", "exposure: #"),
];

const NAMES: [&str; 3] = ["a.obj", "a.mtl", "a.ron"];

/// What is wrong with how files are taken up; none if all is well.
fn fault(lab: &Lab, folder: &Path, file: &str) -> Result<Option<String>, StressError> {
    let located = |text: &str| text.contains(&format!("{file}:"));
    let loaded = match scene::load(&folder.join("a.ron"), &[]) {
        Err(errors) => return Ok((!located(&errors.to_string())).then(|| format!("refused without a place: {errors}"))),
        Ok(loaded) => loaded,
    };
    if !loaded.warnings.iter().any(|warning| located(&warning.to_string())) {
        return Ok(Some("taken without a word".to_owned()));
    }
    let film = match finish(&mut lab.engine(&loaded.description)?) {
        Ok(film) => film,
        Err(StressError::Broken(what)) => return Ok(Some(what)),
        Err(error) => return Err(error),
    };
    let finite = film.rgb.iter().flatten().all(|v| v.is_finite() && *v >= 0.0);
    Ok((!finite).then(|| "a pixel that is no number".to_owned()))
}

fn measure(lab: &Lab, _: u64) -> Result<Measured, StressError> {
    let of_disk = |error: std::io::Error| StressError::Broken(format!("the folder for files: {error}"));
    let folder = tempfile::tempdir().map_err(of_disk)?;
    let mut all = Measured::new(0.0, 0);
    for (k, (which, right, place)) in PLACES.into_iter().enumerate() {
        for number in WRONG {
            let mut texts = [OBJ, MTL, RON].map(str::to_owned);
            if !texts[which].contains(right) {
                return Err(StressError::Broken(format!("{} has no {right}", NAMES[which])));
            }
            let wrong = place.replace('#', number);
            texts[which] = texts[which].replace(right, &wrong);
            for (name, text) in NAMES.iter().zip(&texts) {
                fs::write(folder.path().join(name), text).map_err(of_disk)?;
            }
            let fault = fault(lab, folder.path(), NAMES[which])?;
            let note = fault.as_ref().map_or_else(String::new, |fault| format!("{}, `{wrong}`: {fault}", NAMES[which]));
            all = all.plus(Measured::new(f64::from(u8::from(fault.is_some())), 1).noted(note));
        }
        lab.tell(k as u64 + 1, PLACES.len() as u64);
    }
    Ok(all)
}
