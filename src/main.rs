//! The command line.

fn main() -> std::process::ExitCode {
    quiet_drivers();
    lucerna::app::main()
}

/// Mesa's device-select layer looks for a Wayland display, and where no session runs it prints an error about that.
fn quiet_drivers() {
    if cfg!(target_os = "linux") && std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: this is the process's only thread yet.
        unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
    }
}
