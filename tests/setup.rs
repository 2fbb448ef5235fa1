//! `setup.sh` beside an apt that is made up: which Mesa it takes, and what it says of that.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::Command;

/// What the machine of a case is like.
struct Machine {
    uid: u32,
    /// Versions of Mesa: installed, the release's own, and in the backports that apt knows.
    installed: &'static str,
    own: &'static str,
    backports: &'static str,
    /// apt can install.
    works: bool,
}

const OLD: Machine =
    Machine { uid: 0, installed: "22.3.6-1", own: "22.3.6-1", backports: "25.0.7-2~bpo12+1", works: true };

/// The code name of this Debian, where nothing but the processor draws; none on other machines.
fn release() -> Option<String> {
    let text = fs::read_to_string("/etc/os-release").ok()?;
    let value =
        |key: &str| text.lines().find_map(|line| line.strip_prefix(key)).map(|v| v.trim_matches('"').to_owned());
    let draws = |path: &str| Path::new(path).exists();
    let processor = !draws("/dev/dri") && !draws("/dev/nvidiactl") && !draws("/dev/dxg");
    value("VERSION_CODENAME=").filter(|_| processor && value("ID=").as_deref() == Some("debian"))
}

/// Runs the script. What it says, and what it has apt install.
fn setup(machine: &Machine, release: &str, arguments: &[&str]) -> (bool, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log");
    let Machine { uid, installed, own, backports, works } = machine;
    let policy = format!("echo 'mesa-vulkan-drivers:'; echo '  Candidate: {own}'");
    let madison =
        format!("echo ' mesa-vulkan-drivers | {backports} | http://deb {release}-backports/main amd64 Packages'");
    let scripts = [
        ("id", format!("echo {uid}")),
        ("dpkg-query", format!("echo 'installed {installed}'")),
        ("apt-cache", format!("case $1 in policy) {policy} ;; madison) {madison} ;; esac")),
        ("apt-get", format!("[ $1 != install ] || {{ echo \"$@\" >>{}; {works}; }}", log.display())),
    ];
    for (name, body) in scripts {
        let path = folder.path().join(name);
        fs::write(&path, format!("#!/bin/sh\n{body}\n")).unwrap();
        fs::set_permissions(&path, std::os::unix::fs::PermissionsExt::from_mode(0o755)).unwrap();
    }
    let path = format!("{}:{}", folder.path().display(), std::env::var("PATH").unwrap());
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("setup.sh");
    let run = Command::new("sh").arg(script).args(arguments).env("PATH", path).output().unwrap();
    let said = String::from_utf8([run.stdout, run.stderr].concat()).unwrap();
    (run.status.success(), said, fs::read_to_string(log).unwrap_or_default())
}

#[test]
fn an_unknown_argument_is_refused_wherever_it_stands() {
    for arguments in [&["--frob"][..], &["--tests", "--frob"], &["--release-mesa", "tests"]] {
        let (done, said, installed) = setup(&OLD, "any", arguments);
        assert!(!done && said.contains("unknown argument") && said.contains("--release-mesa"), "{said}");
        assert_eq!(installed, "");
    }
}

#[test]
fn an_old_mesa_makes_room_for_that_of_the_backports() {
    let Some(release) = release() else { return };
    let (done, said, installed) = setup(&OLD, &release, &[]);
    assert!(done && said.contains("Mesa 25.0.7-2~bpo12+1 from") && said.contains("--release-mesa"), "{said}");
    assert!(installed.contains(&format!("-t {release}-backports")) && installed.contains("--no-remove"), "{installed}");
    let unlucky = Machine { works: false, ..OLD };
    let (done, said, _) = setup(&unlucky, &release, &[]);
    assert!(done && said.contains("going on with 22.3.6-1"), "{said}");
}

#[test]
fn the_release_s_mesa_stays_where_it_should() {
    let Some(release) = release() else { return };
    let cases = [
        (OLD, &["--release-mesa"][..], "is kept"),
        (Machine { uid: 1000, ..OLD }, &[], "as root installs it"),
        (Machine { installed: "25.0.7-2~bpo12+1", ..OLD }, &[], ""),
        (Machine { installed: "25.0.7-2", own: "25.0.7-2", backports: "26.1.0-1~bpo13+1", ..OLD }, &[], ""),
        (Machine { installed: "22.3.6-1", own: "1:25.0.7-2", ..OLD }, &[], ""),
    ];
    for (machine, arguments, line) in cases {
        let (done, said, installed) = setup(&machine, &release, arguments);
        assert!(done && installed.is_empty() && said.contains(line), "{said}{installed}");
        assert!(!line.is_empty() || !said.contains("Mesa"), "{said}");
    }
}
