//! README.md and the pages of docs/: links lead somewhere, and tables are those of the code.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use lucerna::app::help::PATHS;

/// README.md, the guide to shaders, and all pages of docs/.
fn pages() -> Vec<PathBuf> {
    let docs = std::fs::read_dir("docs").expect("docs/").map(|entry| entry.expect("an entry").path());
    let docs = docs.filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    [PathBuf::from("README.md"), PathBuf::from("shaders/README.md")].into_iter().chain(docs).collect()
}

fn read(page: impl AsRef<Path>) -> String {
    std::fs::read_to_string(page.as_ref()).unwrap_or_else(|error| panic!("{}: {error}", page.as_ref().display()))
}

/// What a heading is linked by.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.collect::<String>().to_lowercase().replace(' ', "-")
}

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let mut links = 0;
    for page in pages() {
        let text = read(&page);
        let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        for target in targets.filter(|target| !target.contains("://")) {
            links += 1;
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let file = if file.is_empty() { page.clone() } else { page.parent().expect("a folder").join(file) };
            assert!(file.exists(), "{}: {target} leads nowhere", page.display());
            let to = heading.is_empty().then(String::new).unwrap_or_else(|| read(&file));
            let known =
                to.lines().filter(|line| line.starts_with('#')).map(|line| anchor(line.trim_start_matches('#')));
            assert!(
                heading.is_empty() || known.into_iter().any(|known| known == heading),
                "{}: {target}",
                page.display()
            );
        }
    }
    assert!(links > 20, "{links}");
}

#[test]
fn every_page_can_be_found_from_the_readme() {
    let readme = read("README.md");
    for page in pages().iter().filter(|page| page.starts_with("docs")) {
        assert!(readme.contains(&format!("]({})", page.display())), "README.md does not link {}", page.display());
    }
}

fn printed(arguments: &[&str]) -> String {
    let run = Command::new(env!("CARGO_BIN_EXE_lucerna")).args(arguments).output().expect("the command");
    assert!(run.status.success(), "{arguments:?}");
    String::from_utf8(run.stdout).expect("UTF-8")
}

/// The words that begin with two dashes.
fn flags(text: &str) -> BTreeSet<String> {
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
    words
        .filter(|word| word.strip_prefix("--").is_some_and(|name| name.starts_with(char::is_alphabetic)))
        .map(str::to_owned)
        .collect()
}

#[test]
fn the_table_of_render_has_every_flag() {
    let page = read("docs/command-line.md");
    let rows =
        page.lines().skip_while(|line| !line.starts_with("| `render` flag |")).take_while(|line| line.starts_with('|'));
    let listed: BTreeSet<String> = rows.flat_map(|row| flags(row.split(" | ").next().unwrap_or_default())).collect();
    let help = printed(&["render", "--help"]);
    let lines = help.lines().map(str::trim_start).filter(|line| line.starts_with('-'));
    let first = lines.filter_map(|line| line.split([' ', ',']).find(|word| word.starts_with("--")));
    let short_or_general = ["--help", "--output", "--define"];
    let taken: BTreeSet<String> = first.filter(|flag| !short_or_general.contains(flag)).map(str::to_owned).collect();
    assert_eq!(listed, taken);
}

#[test]
fn the_table_of_exit_codes_is_that_of_the_command() {
    let page = read("docs/command-line.md");
    let codes = printed(&["help", "exit-codes"]);
    let codes: Vec<&str> = codes.lines().skip(1).filter_map(|line| line.split_whitespace().next()).collect();
    assert!(codes.len() >= 8, "{codes:?}");
    for code in codes {
        assert!(page.contains(&format!("\n| {code} | ")), "docs/command-line.md lacks the exit code {code}");
    }
}

/// The examples of paths of a text, without `-D` and the shell's quotes.
fn examples(text: &str) -> BTreeSet<String> {
    let lines = text.lines().filter(|line| line.contains('=')).filter(|line| !line.contains("`"));
    let parts =
        lines.flat_map(|line| line.split("  ")).map(|part| part.trim().trim_start_matches("-D ").replace('\'', ""));
    parts.filter(|part| part.contains('=')).collect()
}

#[test]
fn the_page_on_scene_files_has_the_paths_that_the_command_prints() {
    let page = read("docs/scene-files.md");
    let block = page.split("## Paths").nth(1).and_then(|rest| rest.split("```").nth(1)).expect("a block");
    let all = examples(block);
    assert!(all.len() >= 14, "{all:?}");
    assert_eq!(all, examples(PATHS));
}

/// Each of them changes a scene that has what it names.
#[test]
fn every_example_of_a_path_can_be_applied() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    crate::mtl_maps::write_picture(&folder.path().join("t.png"));
    write("m.mtl", "newmtl clay\nKd 0.25 0.25 0.25\nmap_Kd t.png\nnewmtl clay.001\nKd 0.25 0.25 0.25\n");
    write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl clay\nf 1 2 3\nusemtl clay.001\nf 1 2 3\n");
    write(
        "s.ron",
        r#"(
            models: [(path: "m.obj", name: "pot")],
            cameras: { "front": (position: (0, 0, 3), look_at: (0, 0, 0)) },
            lights: { "lamp": Point(position: (0, 0, 2), intensity: 1) },
            environment: Sky(sun: (45, 0)),
        )"#,
    );
    let loaded = |defines: &[lucerna::scene::Define]| {
        let loaded = lucerna::scene::load(&folder.path().join("s.ron"), defines);
        loaded.unwrap_or_else(|errors| panic!("{defines:?}: {errors}")).description
    };
    let plain = loaded(&[]);
    for example in examples(PATHS) {
        let (path, value) = example.split_once('=').expect("KEY=VALUE");
        assert_ne!(loaded(&[lucerna::scene::Define::given(path, value)]), plain, "{example} changes nothing");
    }
}
