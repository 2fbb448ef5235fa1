//! Pictures with values that are none, as textures and as a sky.

use std::fs;
use std::path::Path;

use exr::prelude::write_rgb_file;

use crate::scene;
use crate::stress::lab::{Lab, finish};
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;

pub static ROW: Row = Row {
    name: "bad-pictures",
    holds: "NaN, infinity and overflow in EXR and HDR, as textures or a sky: told where they are named, no bad pixel",
    quantity: "pictures that are not, and films with bad pixels",
    most: 0.0,
    unit: "pictures",
    sizes: [1, 1, 1],
    measure,
};

const OBJ: &str = "mtllib a.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n\
    vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
const MTL: &str = "newmtl a\nKd 0.5 0.5 0.5\nKs 0.2 0.2 0.2\nNs 20\nKe 0.1 0.1 0.1\n";
const RON: &str = "(models: [(path: \"a.obj\")], cameras: {\"c\": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 42.0)}, \
    environment: Map(path: \"sky.ENDING\"), film: (size: (32, 32)), render: (spp: 16))";

/// Statements that name a picture, each of which is called as its statement.
const MAPS: [&str; 6] = ["map_Kd", "map_Ks", "map_Ns", "map_Ke", "map_d", "map_Bump"];

/// Texels, a channel each of which is no value but in the last two.
const TEXELS: [(f32, f32, f32); 8] = [
    (f32::NAN, 0.5, 0.5),
    (0.5, f32::INFINITY, 0.5),
    (0.5, 0.5, f32::NEG_INFINITY),
    (1e38, 0.5, 0.5),
    (0.5, -1.0, 0.5),
    (f32::NAN, f32::NAN, f32::NAN),
    (0.5, 0.25, 1.0),
    (1.0, 0.5, 0.25),
];

/// Bytes of an HDR file with values up to infinity, which its exposure makes of what its pixels can say.
fn hdr() -> Vec<u8> {
    let pixels: [[u8; 4]; 8] = std::array::from_fn(|at| [255 - at as u8, 128, 64, 255 - 30 * at as u8]);
    [&b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1e-30\n\n-Y 2 +X 4\n"[..], pixels.as_flattened()].concat()
}

/// Writes a scene all of whose pictures have that ending.
fn write(folder: &Path, ending: &str) -> std::io::Result<()> {
    let maps: String = MAPS.iter().map(|map| format!("{map} {map}.{ending}\n")).collect();
    fs::write(folder.join("a.obj"), OBJ)?;
    fs::write(folder.join("a.mtl"), MTL.to_owned() + &maps)?;
    fs::write(folder.join("a.ron"), RON.replace("ENDING", ending))?;
    for name in MAPS.iter().chain(&["sky"]) {
        let path = folder.join(name).with_extension(ending);
        match ending {
            "hdr" => fs::write(path, hdr())?,
            _ => write_rgb_file(path, 4, 2, |x, y| TEXELS[4 * y + x]).map_err(std::io::Error::other)?,
        }
    }
    Ok(())
}

/// What is wrong with how a scene is taken up: an entry a picture, and one for the film.
fn faults(lab: &Lab, folder: &Path, ending: &str) -> Result<Vec<Option<String>>, StressError> {
    let (loaded, told) = match scene::load(&folder.join("a.ron"), &[]) {
        Err(errors) => (None, vec![errors.to_string()]),
        Ok(loaded) => {
            let told = loaded.warnings.iter().map(ToString::to_string).collect();
            (Some(loaded), told)
        }
    };
    let is_told = |file: &str, name: &str| {
        told.iter().any(|text| text.contains(&format!("{file}:")) && text.contains(&format!("{name}.{ending}")))
    };
    let of = |file: &str, name: &str| (!is_told(file, name)).then(|| format!("{name}.{ending}: taken without a word"));
    let mut faults: Vec<Option<String>> = MAPS.iter().map(|map| of("a.mtl", map)).collect();
    faults.push(of("a.ron", "sky"));
    let Some(loaded) = loaded else { return Ok(faults) };
    faults.push(match finish(&mut lab.engine(&loaded.description)?) {
        Ok(film) => {
            let finite = film.rgb.iter().flatten().all(|v| v.is_finite() && *v >= 0.0);
            (!finite).then(|| format!("{ending}: a pixel that is no number"))
        }
        Err(StressError::Broken(what)) => Some(format!("{ending}: {what}")),
        Err(error) => return Err(error),
    });
    Ok(faults)
}

fn measure(lab: &Lab, _: u64) -> Result<Measured, StressError> {
    let of_disk = |error: std::io::Error| StressError::Broken(format!("the folder for files: {error}"));
    let folder = tempfile::tempdir().map_err(of_disk)?;
    let mut all = Measured::new(0.0, 0);
    for (k, ending) in ["exr", "hdr"].into_iter().enumerate() {
        write(folder.path(), ending).map_err(of_disk)?;
        for fault in faults(lab, folder.path(), ending)? {
            let count = f64::from(u8::from(fault.is_some()));
            all = all.plus(Measured::new(count, 1).noted(fault.unwrap_or_default()));
        }
        lab.tell(k as u64 + 1, 2);
    }
    Ok(all)
}
