//! The command line.

fn main() -> std::process::ExitCode {
    lucerna::app::main()
}
