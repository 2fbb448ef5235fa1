//! No circle of files within src: what a file names is explained without that file.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Modules by their paths, `""` the crate itself, and their code without comments.
type Modules = BTreeMap<String, String>;

/// The modules below a folder, whose own module is `prefix`.
fn modules(folder: &Path, prefix: &[String], found: &mut Modules) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let inner = [prefix, std::slice::from_ref(&name)].concat();
        if path.is_dir() {
            modules(&path, &inner, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let own = if ["mod", "lib", "main"].contains(&name.as_str()) { prefix } else { &inner };
            let text = fs::read_to_string(&path).unwrap();
            let code: Vec<&str> = text.lines().map(|line| line.split("//").next().unwrap_or("")).collect();
            *found.entry(own.join("::")).or_default() += &(code.join("\n") + "\n");
        }
    }
}

/// The paths of a `use` tree: `a::{b, c::d}` is `a::b` and `a::c::d`.
fn expand(prefix: &str, tree: &str, paths: &mut Vec<String>) {
    let tree = tree.trim();
    let Some(open) = tree.find('{') else {
        if !tree.is_empty() {
            paths.push(format!("{prefix}{tree}"));
        }
        return;
    };
    let (head, inner) = (&tree[..open], &tree[open + 1..tree.rfind('}').unwrap_or(tree.len())]);
    let (mut depth, mut start) = (0, 0);
    for (at, c) in inner.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                expand(&format!("{prefix}{head}"), &inner[start..at], paths);
                start = at + 1;
            }
            _ => {}
        }
    }
    expand(&format!("{prefix}{head}"), &inner[start..], paths);
}

/// A path as it is from the crate's root; `None` where it leaves the crate.
fn absolute(known: &Modules, module: &str, path: &str) -> Option<Vec<String>> {
    let path = path.split(" as ").next()?;
    let mut parts: Vec<String> = path.split("::").map(|part| part.trim().to_owned()).collect();
    let mut base: Vec<String> = module.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect();
    match parts[0].as_str() {
        "crate" => return Some(parts.split_off(1)),
        "self" => parts = parts.split_off(1),
        "super" => {
            while parts.first().is_some_and(|part| part == "super") {
                parts.remove(0);
                base.pop();
            }
        }
        first => {
            let child = [base.as_slice(), &[first.to_owned()]].concat().join("::");
            known.contains_key(&child).then_some(())?;
        }
    }
    Some([base, parts].concat())
}

/// Splits code into its `use` trees, with whether each is a re-export, and the rest.
fn uses(code: &str) -> (Vec<(bool, String)>, String) {
    let (mut trees, mut rest, mut open) = (Vec::new(), String::new(), None::<(bool, String)>);
    for line in code.lines() {
        if open.is_none() {
            let start = line.trim_start();
            let public = start.starts_with("pub");
            let bare = match start.strip_prefix("pub(").and_then(|after| after.split_once(')')) {
                Some((_, after)) => after.trim_start(),
                None => start.strip_prefix("pub ").unwrap_or(start),
            };
            match bare.strip_prefix("use ") {
                Some(tree) => open = Some((public, tree.to_owned())),
                None => rest += &format!("{line}\n"),
            }
        } else if let Some((_, tree)) = &mut open {
            *tree += line;
        }
        if let Some((public, tree)) = open.take_if(|(_, tree)| tree.contains(';')) {
            trees.push((public, tree.split(';').next().unwrap_or("").to_owned()));
        }
    }
    (trees, rest)
}

/// Paths of two parts or more that code names: `super::size`.
fn paths(code: &str) -> Vec<String> {
    let words = code.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
    words
        .filter(|word| !word.starts_with(':'))
        .map(|word| word.trim_end_matches(':'))
        .filter(|word| word.contains("::"))
        .map(str::to_owned)
        .collect()
}

/// The module of the file that defines what a path names, through re-exports.
fn defined(
    known: &Modules,
    exports: &BTreeMap<(String, String), Vec<String>>,
    path: &[String],
    hops: u32,
) -> Option<String> {
    let (module, rest) =
        (0..=path.len()).rev().map(|n| (path[..n].join("::"), &path[n..])).find(|(m, _)| known.contains_key(m))?;
    let Some(target) = rest.first().and_then(|name| exports.get(&(module.clone(), name.clone()))) else {
        return Some(module);
    };
    if hops == 0 { None } else { defined(known, exports, &[target.as_slice(), &rest[1..]].concat(), hops - 1) }
}

/// Which modules each names.
fn edges(known: &Modules) -> BTreeMap<String, BTreeSet<String>> {
    let (mut named, mut exports) = (Vec::new(), BTreeMap::new());
    for (module, code) in known {
        let (trees, rest) = uses(code);
        for (public, tree) in trees {
            let mut all = Vec::new();
            expand("", &tree, &mut all);
            for path in all {
                let Some(target) = absolute(known, module, &path) else { continue };
                let name = path.split(" as ").last().and_then(|path| path.rsplit("::").next()).unwrap_or("").trim();
                if public {
                    exports.insert((module.clone(), name.to_owned()), target);
                } else {
                    named.push((module, target));
                }
            }
        }
        // `pub(in path)` says who may see, and names nothing.
        let rest = rest.replace("pub(in ", "pub(in::");
        named.extend(paths(&rest).iter().filter_map(|path| Some((module, absolute(known, module, path)?))));
    }
    let mut edges: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (module, path) in named {
        if let Some(target) = defined(known, &exports, &path, 8).filter(|target| target != module && !target.is_empty())
        {
            edges.entry(module.clone()).or_default().insert(target);
        }
    }
    edges
}

/// The modules that lead back to themselves.
fn circles(known: &Modules) -> BTreeSet<String> {
    let edges = edges(known);
    let leads_back = |module: &String| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![module]);
        while let Some(at) = open.pop() {
            for next in edges.get(at).into_iter().flatten().filter(|next| seen.insert(*next)) {
                open.push(next);
            }
        }
        seen.contains(module)
    };
    known.keys().filter(|module| leads_back(module)).cloned().collect()
}

#[test]
fn files_go_in_no_circles() {
    let mut known = Modules::new();
    modules(Path::new("src"), &[], &mut known);
    assert!(known.len() > 100);
    let found = circles(&known);
    assert!(found.is_empty(), "in circles: {found:?}");
}

#[test]
fn a_planted_circle_is_found() {
    let plant = |files: &[(&str, &str)]| {
        circles(&files.iter().map(|(module, code)| ((*module).to_owned(), (*code).to_owned())).collect())
    };
    let both = BTreeSet::from(["a::b".to_owned(), "a::c".to_owned()]);
    // Through braces and a re-export.
    let parent = ("a", "mod b;\nmod c;\npub use b::{\n    B,\n    Other as O,\n};\n");
    assert_eq!(plant(&[parent, ("a::b", "use super::{c::{C, D}};\n"), ("a::c", "use crate::a::O;\n")]), both);
    // By paths within code.
    assert_eq!(plant(&[parent, ("a::b", "fn f() { super::c::g() }\n"), ("a::c", "use super::B;\n")]), both);
    // A parent that only lists its children is in no circle with them.
    assert!(plant(&[parent, ("a::b", "use super::c::C;\n"), ("a::c", "use std::fs;\n")]).is_empty());
    assert_eq!(plant(&[("a", "mod b;\nuse b::B;\n"), ("a::b", "use super::A;\n")]).len(), 2);
}
