//! Files and folders as they are found: links, loops of links, what is no file, and what editors leave behind.

use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::symlink;
use std::os::unix::net::UnixListener;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::mpsc::channel;
use std::time::Duration;

use lucerna::files::{self, NoFile, Stamp};
use lucerna::scene;
use lucerna::shader::Library;

/// Makes a FIFO.
pub fn fifo(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

/// What is to be over soon, and fails if it isn't.
#[track_caller]
fn soon<T: Send + 'static>(what: &str, work: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, result) = channel();
    std::thread::spawn(move || sender.send(work()));
    result.recv_timeout(Duration::from_secs(60)).unwrap_or_else(|_| panic!("{what} hangs"))
}

/// Puts beside every file of a folder, and in folders of its own, what people, editors and systems leave there: none of it is wanted.
pub fn litter(folder: &Path, ending: &str) {
    let write = |name: &str| fs::write(folder.join(name), "?!").unwrap();
    for name in ["._x", ".x", "flycheck_x", "x_flymake", "~$x"] {
        write(&format!("{name}.{ending}"));
    }
    for behind in ["~", ".swp", ".bak", ".orig", ".tmp", ".~1~", "___jb_tmp___", "~RF1a2b3.TMP", ".kate-swp", ".un~"] {
        write(&format!("x.{ending}{behind}"));
        write(&format!(".x.{ending}{behind}"));
    }
    for name in ["4913", ".DS_Store", "Thumbs.db", ".goutputstream-AB12CD"] {
        write(name);
    }
    write(&format!("#x.{ending}#"));
    symlink("user@host.1234:5678", folder.join(format!(".#x.{ending}"))).unwrap();
    fifo(&folder.join(format!("pipe.{ending}")));
    drop(UnixListener::bind(folder.join(format!("socket.{ending}"))).unwrap());
    symlink("/dev/zero", folder.join(format!("zero.{ending}"))).unwrap();
    symlink(format!("itself.{ending}"), folder.join(format!("itself.{ending}"))).unwrap();
    symlink(format!("b.{ending}"), folder.join(format!("a_to_b.{ending}"))).unwrap();
    symlink(format!("a_to_b.{ending}"), folder.join(format!("b.{ending}"))).unwrap();
    fs::create_dir(folder.join(".git")).unwrap();
    fs::write(folder.join(format!(".git/x.{ending}")), "?!").unwrap();
    for (link, target) in [("up", ".."), ("here", "."), ("root", "/.."), ("self", "self")] {
        symlink(target, folder.join(link)).unwrap();
    }
}

#[test]
fn litter_in_a_folder_is_passed_over() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("shaders");
    crate::reload::copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &root);
    let clean = Library::open(&root).unwrap();
    // An import can't name these.
    for name in ["x.orig.wgsl", "x (copy).wgsl", "x - Copy.wgsl", "x.sync-conflict-20261126.wgsl"] {
        fs::write(root.join("lib").join(name), "?!").unwrap();
    }
    litter(&root, "wgsl");
    litter(&root.join("lib"), "wgsl");
    let library = soon("reading a folder of shaders", move || Library::open(&root).unwrap());
    assert!(library.is_same(&clean), "{:?}", library.modules().collect::<Vec<_>>());
    assert_eq!(library.features().unwrap(), clean.features().unwrap());

    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("models");
    fs::create_dir(&root).unwrap();
    fs::write(root.join("right.mtl"), "newmtl a\nKd 1 1 1\n").unwrap();
    for ending in ["obj", "mtl", "ron"] {
        let below = root.join(ending);
        fs::create_dir(&below).unwrap();
        litter(&below, ending);
    }
    let checked = soon("checking a folder", move || scene::check(&root));
    assert!(checked.diagnostics.list.is_empty(), "{:?}", checked.diagnostics);
    assert_eq!(checked.files, [folder.path().join("models/right.mtl")]);
}

#[test]
fn a_file_behind_a_link_is_a_module_and_one_that_leads_nowhere_only_counts_where_it_is_imported() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("shaders");
    fs::create_dir_all(root.join("lib")).unwrap();
    fs::create_dir(folder.path().join("common")).unwrap();
    fs::write(folder.path().join("common/half.wgsl"), "fn half(x: f32) -> f32 { return 0.5 * x; }\n").unwrap();
    symlink("../../common/half.wgsl", root.join("lib/half.wgsl")).unwrap();
    symlink(folder.path().join("common"), root.join("common")).unwrap();
    symlink("gone.wgsl", root.join("lib/lost.wgsl")).unwrap();
    let library = Library::open(&root).unwrap();
    assert_eq!(library.modules().collect::<Vec<_>>(), ["common/half", "lib/half", "lib/lost"]);
    assert!(library.features().unwrap().is_empty());
    let error = library.link("lib/lost", &Default::default()).unwrap_err().to_string();
    assert!(error.contains("lib/lost.wgsl") && error.contains("gone.wgsl") && error.contains("link"), "{error}");
}

/// A walk through each of n folders that hold links to all others has more ways than there is time for.
#[test]
fn links_between_neighbours_come_to_an_end() {
    const FOLDERS: usize = 12;
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().to_path_buf();
    for i in 0..FOLDERS {
        fs::create_dir(root.join(format!("f{i}"))).unwrap();
        fs::write(root.join(format!("f{i}/x.wgsl")), "").unwrap();
        for j in (0..FOLDERS).filter(|j| *j != i) {
            symlink(format!("../f{j}"), root.join(format!("f{i}/to{j}"))).unwrap();
        }
    }
    let found = soon("the walk", move || files::walk(&root, files::DEEPEST, |_| true).unwrap());
    for i in 0..FOLDERS {
        assert!(found.files.contains(&folder.path().join(format!("f{i}/x.wgsl"))), "f{i} is not met by its own name");
    }
    assert!(found.folders.len() < 20 * FOLDERS, "{} folders", found.folders.len());
}

#[test]
fn what_is_no_file_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fifo(&path("fifo"));
    let _listener = UnixListener::bind(path("socket")).unwrap();
    symlink("fifo", path("to_fifo")).unwrap();
    symlink("round", path("round")).unwrap();
    symlink("two", path("one")).unwrap();
    symlink("one", path("two")).unwrap();
    symlink("chain", path("lost")).unwrap();
    symlink("away/gone", path("chain")).unwrap();
    fs::create_dir(path("away")).unwrap();
    symlink("nowhere", path("folder")).unwrap();
    let cases: [(PathBuf, &[&str]); 10] = [
        (path("fifo"), &["FIFO"]),
        (path("to_fifo"), &["FIFO"]),
        (path("socket"), &["socket"]),
        (PathBuf::from("/dev/zero"), &["device"]),
        (PathBuf::from("/dev/null"), &["device"]),
        (path("away"), &["folder"]),
        (path("round"), &["round", "leads back"]),
        (path("one"), &["one", "two", "leads back"]),
        (path("lost"), &["lost", "away/gone", "does not exist"]),
        // A link on the way to the file.
        (path("folder/file"), &["folder", "nowhere", "does not exist"]),
    ];
    for (path, words) in cases {
        let named = path.clone();
        let error = soon("opening", move || files::open_regular(&named).unwrap_err());
        assert!(NoFile::of(&error).is_some(), "{}: {error}", path.display());
        for word in words {
            assert!(error.to_string().contains(word), "{}: `{word}` is not in: {error}", path.display());
        }
    }
    assert_eq!(files::open_regular(&path("none")).unwrap_err().kind(), std::io::ErrorKind::NotFound);
}

#[test]
fn the_trail_of_a_file_has_the_folder_of_each_link_on_the_way() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().canonicalize().unwrap();
    for name in ["a", "b/deep", "c", "d"] {
        fs::create_dir_all(root.join(name)).unwrap();
    }
    fs::write(root.join("d/file"), "").unwrap();
    symlink("../b/deep/link", root.join("a/link")).unwrap();
    symlink(root.join("c/link"), root.join("b/deep/link")).unwrap();
    symlink("../behind/file", root.join("c/link")).unwrap();
    symlink("d", root.join("behind")).unwrap();
    let folders = |names: &[&str]| names.iter().map(|name| root.join(name)).collect::<BTreeSet<PathBuf>>();
    // The folder of `behind` is the root itself.
    let mut wanted = folders(&["a", "b/deep", "c", "d"]);
    wanted.insert(root.clone());
    assert_eq!(files::trail(&root.join("a/link")), wanted);
    assert_eq!(files::trail(&root.join("d/file")), folders(&["d"]));
    assert_eq!(files::trail(&root.join("a/../d/none")), folders(&["d"]));
    symlink("round", root.join("c/round")).unwrap();
    assert!(files::trail(&root.join("c/round")).contains(&root.join("c")));
}

#[test]
fn a_stamp_tells_files_of_one_length_and_time_apart() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let old = std::time::SystemTime::now() - Duration::from_secs(1000);
    for name in ["a", "b", "c"] {
        fs::write(path(name), name).unwrap();
        fs::File::options().append(true).open(path(name)).unwrap().set_modified(old).unwrap();
    }
    symlink("a", path("link")).unwrap();
    let first = Stamp::of(&path("link")).unwrap();
    assert!(!first.is_young() && first == Stamp::of(&path("link")).unwrap());
    fs::remove_file(path("link")).unwrap();
    symlink("b", path("link")).unwrap();
    assert_ne!(first, Stamp::of(&path("link")).unwrap());
    // Renamed over it: the path is the same.
    let (a, before) = (path("a"), Stamp::of(&path("a")).unwrap());
    fs::rename(path("c"), &a).unwrap();
    assert_ne!(before, Stamp::of(&a).unwrap());
}
