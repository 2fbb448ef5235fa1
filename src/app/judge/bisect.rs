//! `--bisect`: a verdict as `git bisect run` reads it.

use std::ffi::OsString;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::app::{Exit, Failure};

/// Whether a command line that means nothing was meant for `git bisect run`, which would take the number that such a line ends with for a bad commit.
pub fn is_for_bisect(words: impl IntoIterator<Item = OsString>) -> bool {
    words.into_iter().any(|word| word == "--bisect")
}

/// 0 is a good commit, 1 a bad one, 125 one that can't be told and is skipped, and from 128 on the search ends: where nothing can be
/// judged at all, no commit is to be blamed. (git-bisect(1), "Bisect run".)
///
/// A panic, whose message is on stderr by then, is no verdict either.
pub fn answer(judge: impl FnOnce() -> Result<Exit, Failure>) -> Result<Exit, Failure> {
    // What it leaves half done is not used again.
    match catch_unwind(AssertUnwindSafe(judge)).unwrap_or(Ok(Exit::Abandoned)) {
        Ok(Exit::MeansDiffer) => Ok(Exit::Bad),
        Ok(Exit::CannotTell) => Ok(Exit::Skipped),
        Ok(Exit::Failed) => Ok(Exit::Abandoned),
        Ok(exit) => Ok(exit),
        Err(failure) if failure.exit == Exit::BrokenShaders => Err(Failure { exit: Exit::Skipped, ..failure }),
        Err(failure) => Err(Failure { exit: Exit::Abandoned, ..failure }),
    }
}
