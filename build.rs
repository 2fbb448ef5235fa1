//! Embeds shaders/: a table of (module name, text), so that the binary renders from any folder.

#[path = "src/shader/names.rs"]
mod names;
#[path = "src/files/walk.rs"]
mod walk;

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs};

fn main() {
    println!("cargo:rerun-if-changed=shaders");
    println!("cargo:rerun-if-changed=build.rs");
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("invariant: cargo sets it")).join("shaders");
    let found = walk::walk(&root, walk::DEEPEST, names::is_shader).expect("the folder of shaders can be read");
    for path in found.folders.iter().chain(&found.files) {
        println!("cargo:rerun-if-changed={}", path.display());
    }
    for (folder, error) in &found.unread {
        println!("cargo:warning={}: {error}", folder.display());
    }
    let below = |path: &PathBuf| names::module_name(path.strip_prefix(&root).ok()?);
    let mut modules: Vec<String> = found.files.iter().filter_map(below).collect();
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
