//! `lucerna judge --git`: shaders as commits have them, and the search for the commit that broke them.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use lucerna::app::{Exit, judge};
use tempfile::TempDir;

/// A repository with a folder of shaders, and its commits by their places: as they are shipped, broken, written otherwise, wrong, and
/// with a comment more.
struct Repository {
    folder: TempDir,
    commits: Vec<String>,
}

const EDITS: [(&str, &str, &str); 4] = [
    ("lib/sampling", "return Angle(sqrt(1.0 - u), sqrt(u));", "return Angle(sqrt(1.0 - u), u5);"),
    ("lib/sampling", "return Angle(sqrt(1.0 - u), u5);", "return Angle(sqrt(1.0 - u), sqrt(u) * 1.0);"),
    ("passes/trace/connect", "radiance, light.triangle, point, end)", "0.5 * radiance, light.triangle, point, end)"),
    ("lib/rng", "fn sample_1d(", "/* one number */ fn sample_1d("),
];

impl Repository {
    fn new() -> Self {
        let mut made = Self { folder: tempfile::tempdir().unwrap(), commits: Vec::new() };
        crate::reload::copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &made.shaders());
        made.git(&["init", "--quiet"]);
        made.commit("as they are shipped");
        for (module, text, replacement) in EDITS {
            let path = made.shaders().join(module).with_extension("wgsl");
            let before = std::fs::read_to_string(&path).unwrap();
            assert_eq!(before.matches(text).count(), 1, "`{text}` in {module}");
            std::fs::write(&path, before.replace(text, replacement)).unwrap();
            made.commit(replacement);
        }
        made
    }

    fn shaders(&self) -> PathBuf {
        self.folder.path().join("own").join("shaders")
    }

    fn commit(&mut self, message: &str) {
        self.git(&["add", "--all"]);
        self.git(&["commit", "--quiet", "--message", message]);
        self.commits.push(self.git(&["rev-parse", "HEAD"]).trim().to_owned());
    }

    fn git(&self, words: &[&str]) -> String {
        let run = self.run(Command::new("git").args(words));
        let [stdout, stderr] = [&run.stdout, &run.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
        assert!(run.status.success(), "git {words:?}: {stdout}{stderr}");
        stdout
    }

    /// Runs a command in it, with no settings of git but these.
    fn run(&self, command: &mut Command) -> Output {
        let person = |role: &str| [(format!("GIT_{role}_NAME"), "A"), (format!("GIT_{role}_EMAIL"), "a@example.org")];
        command.current_dir(self.folder.path()).stdin(Stdio::null());
        command.env("GIT_CONFIG_NOSYSTEM", "1").env("GIT_CONFIG_GLOBAL", self.folder.path().join("none"));
        command.envs(person("AUTHOR")).envs(person("COMMITTER"));
        command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"))
    }

    /// What `judge` says of a small Cornell box, and its exit code.
    fn judge(&self, range: &str, more: &[&str]) -> (Option<i32>, String) {
        let words = judging(range);
        let run = self.run(Command::new(words[0].as_str()).args(&words[1..]).args(more));
        (run.status.code(), String::from_utf8_lossy(&[run.stdout, run.stderr].concat()).into_owned())
    }
}

/// The command line.
fn judging(range: &str) -> Vec<String> {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets").join("scenes").join("cornell-box.ron");
    let new: PathBuf = ["own", "shaders"].iter().collect();
    let [scene, new] = [scene, new].map(|path| path.display().to_string());
    let words = [env!("CARGO_BIN_EXE_lucerna"), "judge", &scene, "--quiet", "--new", &new, "--git", range];
    let small = ["--size", "32x32", "--spp", "1", "--films", "64", "--within", "60", "-D", "render.max_depth=2"];
    words.into_iter().chain(small).map(str::to_owned).collect()
}

#[test]
fn commits_are_judged_and_the_bad_one_is_found() {
    let repository = Repository::new();
    let [shipped, broken, written, wrong, _] = &repository.commits[..] else { panic!("{:?}", repository.commits) };
    // What is checked out is another commit than those that are judged.
    let (code, said) = repository.judge(&format!("{shipped}..{wrong}"), &[]);
    assert!(code == Some(5) && said.contains("darker"), "{code:?}: {said}");
    let (code, said) = repository.judge(&format!("{shipped}..{written}"), &["--json"]);
    assert!(code == Some(0) && said.contains(&format!("\"new_shaders\":\"{}:own/shaders\"", &written[..10])), "{said}");
    assert_eq!(repository.judge(&format!("{wrong}.."), &[]).1, "nothing changed in what this scene runs\n");
    let (code, said) = repository.judge(&format!("{shipped}..{broken}"), &[]);
    let place = format!("{}:own/shaders/lib/sampling.wgsl:", &broken[..10]);
    assert!(code == Some(1) && said.contains(&place), "{code:?}: {said}");
    assert_eq!(repository.judge(&format!("{shipped}..{broken}"), &["--bisect"]).0, Some(125));
    // Where there is nothing to judge by, skipping commit after commit would find nothing.
    assert_eq!(repository.judge(&format!("{broken}..{shipped}"), &["--bisect"]).0, Some(128));
    // The files as they lie there, against a commit.
    let path = repository.shaders().join("lib").join("rng.wgsl");
    std::fs::write(&path, std::fs::read_to_string(&path).unwrap() + "\n// more\n").unwrap();
    assert_eq!(repository.judge(wrong, &[]).1, "nothing changed in what this scene runs\n");
    repository.git(&["checkout", "--quiet", "."]);

    repository.git(&["bisect", "start", "HEAD", shipped]);
    let words = judging(&format!("{shipped}.."));
    let search: Vec<&str> = words.iter().map(String::as_str).collect();
    let said = repository.git(&[&["bisect", "run"], &search[..], &["--bisect"]].concat());
    assert!(said.contains(&format!("{wrong} is the first bad commit")), "{said}");
}

#[test]
fn what_is_no_commit_is_told() {
    let repository = Repository::new();
    for (range, code, told) in [
        ("v9..", 1, "`v9` is no commit of the repository of "),
        ("--output=x..", 1, "`--output=x` is no commit"),
        ("HEAD...HEAD~1", 2, "expected two dots: HEAD..HEAD~1"),
        ("", 2, "expected A..B"),
    ] {
        let asked = format!("--git={range}");
        let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
        let run = repository.run(command.args(["judge", "cornell-box", &asked, "--new"]).arg(repository.shaders()));
        let said = String::from_utf8_lossy(&run.stderr);
        assert!(run.status.code() == Some(code) && said.contains(told), "{range}: {said}");
    }
    let elsewhere = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.args(["judge", "cornell-box", "--bisect", "--git", "HEAD", "--new"]).arg(elsewhere.path());
    let run = command.output().unwrap();
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.code() == Some(128) && said.contains("commits can't be looked up here"), "{said}");
    // `git bisect run` would take 2 for a bad commit.
    command.arg("--no-such-flag");
    assert_eq!(command.output().unwrap().status.code(), Some(128));
}

#[test]
fn shaders_that_are_too_large_are_told() {
    let repository = Repository::new();
    std::fs::write(repository.shaders().join("large.wgsl"), vec![b'/'; (64 << 20) + 1]).unwrap();
    repository.git(&["add", "--all"]);
    repository.git(&["commit", "--quiet", "--message", "large"]);
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    let run =
        repository.run(command.args(["judge", "cornell-box", "--git", "HEAD", "--new"]).arg(repository.shaders()));
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.code() == Some(1) && said.contains("they have more than 64 MiB"), "{said}");
}

#[test]
fn a_panic_blames_no_commit() {
    let answered = judge::bisect_answer(|| panic!("planted: this message is expected"));
    assert_eq!(answered.map_err(|failure| failure.exit), Ok(Exit::Abandoned));
}
