//! `--git`: the folder of shaders as commits have it, read by `git` without touching what is checked out.

use std::ffi::OsStr;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::str::FromStr;

use crate::shader::Library;

/// Bytes that the shaders of a commit may have.
const LIMIT: u64 = 64 << 20;

/// What is judged by what, as `git diff` names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Commits {
    /// The commit to judge by.
    pub old: String,
    /// The commit to be judged; `None` is the folder as it is now.
    pub new: Option<String>,
}

impl FromStr for Commits {
    type Err = String;

    /// `A..B`; a side that is left out is HEAD. `A` alone is against the folder.
    fn from_str(text: &str) -> Result<Self, String> {
        let named = |name: &str| if name.is_empty() { "HEAD".to_owned() } else { name.to_owned() };
        if text.trim().is_empty() {
            return Err("expected A..B, two commits, or A, one to judge the folder by".into());
        }
        if text.contains("...") {
            return Err(format!("expected two dots: {}", text.replacen("...", "..", 1)));
        }
        Ok(match text.split_once("..") {
            Some((old, new)) => Self { old: named(old), new: Some(named(new)) },
            None => Self { old: text.to_owned(), new: None },
        })
    }
}

/// Why a commit's shaders can't be had.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum CommitError {
    #[error("--git reads commits by `git`, which can't be run: {0}")]
    #[diagnostic(help("install git, or check both commits out, and name their folders by --old and --new"))]
    NoGit(io::Error),
    #[error("{folder}: commits can't be looked up here: {reason}")]
    #[diagnostic(help("--new names the folder of shaders, which is to be in a git repository"))]
    NoRepository { folder: String, reason: String },
    #[error("`{name}` is no commit of the repository of {folder}")]
    #[diagnostic(help("`git log --oneline` lists commits; a shallow clone has only the newest"))]
    NoCommit { name: String, folder: String },
    #[error("commit {commit} has no shaders in {folder}")]
    #[diagnostic(help("--new names the folder of shaders"))]
    NoFolder { commit: String, folder: String },
    #[error("commit {commit}: its shaders can't be read: {reason}")]
    Unread { commit: String, reason: String },
}

/// The shaders of a commit, and what it is called: `1a2b3c4d5e:shaders`, as `git show` takes it.
pub fn read(folder: &Path, name: &str) -> Result<(Library, String), CommitError> {
    let told = folder.display().to_string();
    let prefix = git(folder, ["rev-parse", "--show-prefix"])?
        .map_err(|reason| CommitError::NoRepository { folder: told.clone(), reason })?;
    // What begins with a dash is no flag here.
    let asked = format!("{name}^{{commit}}");
    let found = git(folder, ["rev-parse", "--verify", "--quiet", "--end-of-options", &asked])?;
    let Ok(full) = found else { return Err(CommitError::NoCommit { name: name.to_owned(), folder: told }) };
    let full = String::from_utf8_lossy(&full).trim().to_owned();
    let commit: String = full.chars().take(10).collect();
    let prefix = String::from_utf8_lossy(&prefix).trim_end_matches(['\n', '\r', '/']).to_owned();
    let tree = format!("{full}:{prefix}");
    let none = || CommitError::NoFolder { commit: commit.clone(), folder: told.clone() };
    let Ok(listing) = git(folder, ["ls-tree", "-r", "-z", "--full-tree", &tree])? else { return Err(none()) };
    let blobs = blobs(&listing);
    let texts = contents(folder, blobs.iter().map(|blob| blob.1.as_str()))
        .map_err(|error| CommitError::Unread { commit: commit.clone(), reason: error.to_string() })?;
    let label = format!("{commit}:{prefix}");
    let library = Library::of(&label, blobs.into_iter().map(|blob| blob.0).zip(texts));
    if library.modules().next().is_none() {
        return Err(none());
    }
    Ok((library, label))
}

/// What a command of git printed, in a folder; or what it complained of.
fn git<'a>(folder: &Path, words: impl IntoIterator<Item = &'a str>) -> Result<Result<Vec<u8>, String>, CommitError> {
    let run = command(folder, words).stdin(Stdio::null()).output().map_err(CommitError::NoGit)?;
    Ok(if run.status.success() {
        Ok(run.stdout)
    } else {
        Err(String::from_utf8_lossy(&run.stderr).trim().trim_start_matches("fatal: ").to_owned())
    })
}

fn command<'a>(folder: &Path, words: impl IntoIterator<Item = &'a str>) -> Command {
    let mut command = Command::new("git");
    command.arg("-C").arg(if folder.as_os_str().is_empty() { OsStr::new(".") } else { folder.as_os_str() });
    command.args(words);
    command
}

/// Path and object of every regular file that `ls-tree -z` lists: `MODE blob OBJECT\tPATH`.
fn blobs(listing: &[u8]) -> Vec<(String, String)> {
    let entry = |entry: &[u8]| {
        let entry = String::from_utf8_lossy(entry);
        let (what, path) = entry.split_once('\t')?;
        let mut words = what.split(' ');
        let regular = words.next()?.starts_with("100") && words.next()? == "blob" && path.ends_with(".wgsl");
        regular.then_some((path.to_owned(), words.next()?.to_owned()))
    };
    listing.split(|byte| *byte == 0).filter_map(entry).collect()
}

/// The contents of objects, in their order, by one process.
fn contents<'a>(folder: &Path, objects: impl Iterator<Item = &'a str>) -> io::Result<Vec<Vec<u8>>> {
    let asked: Vec<String> = objects.map(|object| format!("{object}\n")).collect();
    let mut child = command(folder, ["cat-file", "--batch"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    let (mut stdin, mut stdout) = (child.stdin.take().expect("piped"), child.stdout.take().expect("piped"));
    let count = asked.len();
    // Git answers while it is asked: who only asked would wait for it to be heard, and it for room in the pipe.
    let asking = std::thread::spawn(move || asked.iter().try_for_each(|line| stdin.write_all(line.as_bytes())));
    let mut answer = Vec::new();
    stdout.by_ref().take(LIMIT + 1).read_to_end(&mut answer)?;
    let is_whole = answer.len() as u64 <= LIMIT;
    drop(stdout);
    child.wait()?;
    // Where git ended early, the answer is too short, which is told below.
    let _ = asking.join();
    if !is_whole {
        return Err(io::Error::other(format!("they have more than {} MiB", LIMIT >> 20)));
    }
    let mut rest = answer.as_slice();
    (0..count).map(|_| next(&mut rest).ok_or_else(|| io::Error::other("git's answer is cut short"))).collect()
}

/// The next of `OBJECT blob SIZE\nCONTENTS\n`.
fn next(answer: &mut &[u8]) -> Option<Vec<u8>> {
    let end = answer.iter().position(|byte| *byte == b'\n')?;
    let size: usize = std::str::from_utf8(&answer[..end]).ok()?.rsplit(' ').next()?.parse().ok()?;
    let contents = answer.get(end + 1..end + 1 + size)?.to_vec();
    *answer = answer.get(end + 2 + size..)?;
    Some(contents)
}
