//! The command line, and the two drivers of the schedule: headless, and a window.
//!
//! Every error of the layers below ends here, is shown once, and becomes an exit code.

mod animate;
mod arguments;
pub mod bench;
mod check;
mod compare;
mod doctor;
pub mod edits;
pub mod export;
pub mod help;
pub mod judge;
mod new;
pub mod render;
pub mod replay;
mod schema;
pub mod shared;
mod stress;
pub mod variants;
mod watch;
pub mod window;

use std::process::ExitCode;
use std::time::Instant;

use clap::{CommandFactory, Parser};

pub use shared::failure::{Exit, Failure};

use arguments::{Arguments, Command};
use shared::interrupt::end_of_main;
use window::ViewArguments;

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let started = Instant::now();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are no errors, and go to stdout; a closed pipe there is no error.
            let _ = error.print();
            return ExitCode::from(match error.use_stderr() {
                true if judge::is_for_bisect(std::env::args_os()) => Exit::Abandoned,
                true => Exit::Usage,
                false => Exit::Done,
            });
        }
    };
    let command = match arguments.command {
        Some(command) => command,
        None if window::has_display() => Command::View(ViewArguments::default()),
        None => {
            let _ = std::io::Write::write_all(&mut std::io::stderr(), short_help().as_bytes());
            return ExitCode::from(Exit::Usage);
        }
    };
    let result = match command {
        Command::View(view) => window::run(&view),
        Command::Render(render) => render::run(&render, started),
        Command::Replay(replay) => replay::run(&replay),
        Command::Watch(watch) => watch::run(&watch),
        Command::Variants(family) => variants::run(&family),
        Command::Animate(animation) => animate::run(&animation),
        Command::New(new) => new::run(&new),
        Command::Compare(comparison) => compare::run(&comparison),
        Command::Check(check) => check::run(&check),
        Command::Schema(schema) => schema::run(&schema),
        Command::Help(about) => help::run(&about, Arguments::command()),
        Command::Doctor => doctor::run(),
        Command::Bench(bench) => bench.run(),
        Command::Judge(judge) => judge::run(&judge),
        Command::Stress(stress) => stress::run(&stress),
        Command::Edits(edits) => edits::run(&edits),
        Command::Export(export) => export::run(&export),
    };
    match result {
        Ok(exit) => end_of_main(exit),
        Err(failure) => {
            failure.show();
            end_of_main(failure.exit)
        }
    }
}

/// What `--help` prints.
fn short_help() -> String {
    Arguments::command().render_help().to_string()
}
