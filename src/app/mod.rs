//! The command line, and the headless driver of the schedule.
//!
//! Every error of the layers below ends here, is shown once, and becomes an exit code.

mod arguments;
pub mod bench;
mod check;
mod compare;
mod doctor;
mod failure;
mod headless;
mod interrupt;
pub mod judge;
mod output;
mod progress;
mod report;
mod stage;

use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;

pub use failure::{Exit, Failure};

use arguments::{Arguments, Command};

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let started = Instant::now();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are asked for, and go to stdout; a closed pipe there is no error.
            let _ = error.print();
            return ExitCode::from(if error.use_stderr() { Exit::Usage } else { Exit::Done });
        }
    };
    let result = match arguments.command {
        Command::Render(render) => headless::render(&render, started),
        Command::Compare(comparison) => compare::run(&comparison),
        Command::Check(check) => check::run(&check),
        Command::Doctor => doctor::run(),
        Command::Bench(bench) => bench.run(),
        Command::Judge(judge) => judge::run(&judge),
    };
    match result {
        Ok(exit) => ExitCode::from(exit),
        Err(failure) => {
            failure.show();
            ExitCode::from(failure.exit)
        }
    }
}
