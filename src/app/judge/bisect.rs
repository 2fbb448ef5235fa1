//! `--bisect`: a verdict as `git bisect run` reads it.

use crate::app::{Exit, Failure};

/// 0 is a good commit, 1 a bad one, 125 one that can't be told and is skipped, and from 128 on the search ends: where nothing can be
/// judged at all, no commit is to be blamed. (git-bisect(1), "Bisect run".)
pub fn answer(judged: Result<Exit, Failure>) -> Result<Exit, Failure> {
    match judged {
        Ok(Exit::MeansDiffer) => Ok(Exit::Bad),
        Ok(Exit::CannotTell) => Ok(Exit::Skipped),
        Ok(Exit::Failed) => Ok(Exit::Abandoned),
        Ok(exit) => Ok(exit),
        Err(failure) if failure.exit == Exit::BrokenShaders => Err(Failure { exit: Exit::Skipped, ..failure }),
        Err(failure) => Err(Failure { exit: Exit::Abandoned, ..failure }),
    }
}
