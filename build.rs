//! Embeds shaders/: a table of (module name, text), so that the binary renders from any folder.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    println!("cargo:rerun-if-changed=shaders");
    println!("cargo:rerun-if-changed=build.rs");
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("invariant: cargo sets it")).join("shaders");
    let mut modules = Vec::new();
    collect(&root, "", &mut modules);
    modules.sort();
    let mut table = String::from("&[\n");
    for name in &modules {
        writeln!(
            table,
            "    ({name:?}, include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/shaders/{name}.wgsl\"))),"
        )
        .expect("invariant: a String takes any text");
    }
    table.push_str("]\n");
    let out = PathBuf::from(env::var("OUT_DIR").expect("invariant: cargo sets it")).join("shaders.rs");
    fs::write(out, table).expect("the table of embedded shaders can be written");
}

/// Adds the names of the modules below a folder: paths from shaders/ with `/`, without `.wgsl`.
fn collect(folder: &Path, prefix: &str, modules: &mut Vec<String>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let path = entry.path();
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else { continue };
        if path.is_dir() {
            println!("cargo:rerun-if-changed={}", path.display());
            collect(&path, &format!("{prefix}{name}/"), modules);
        } else if let Some(stem) = name.strip_suffix(".wgsl") {
            println!("cargo:rerun-if-changed={}", path.display());
            modules.push(format!("{prefix}{stem}"));
        }
    }
}
