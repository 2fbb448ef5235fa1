//! Whether a Wayland compositor answers where the environment says that one is.
//!
//! Asked before the window library is: that makes one attempt at a loop of events, and waits for a compositor without end.

use std::env;
use std::io::{Read, Write};
use std::os::unix::fs::FileTypeExt;
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::sync::mpsc::channel;
use std::time::Duration;

/// A compositor that is alive answers within this, also on a busy machine.
const PATIENCE: Duration = Duration::from_secs(3);

/// Why the compositor that the environment names does not answer; None if it does, or if none is named.
pub fn silence() -> Option<String> {
    let display = env::var_os("WAYLAND_DISPLAY").filter(|name| !name.is_empty());
    let socket = env::var_os("WAYLAND_SOCKET");
    if display.is_none() && socket.as_ref().is_none_or(|number| number.is_empty()) {
        return None;
    }
    // As the protocol's own library does it: a socket that was handed over goes before any name.
    if let Some(socket) = socket {
        let number = socket.to_string_lossy().into_owned();
        let open = number.parse::<u32>().is_ok() && is_socket(&Path::new("/dev/fd").join(&number));
        return (!open).then(|| format!("WAYLAND_SOCKET is `{number}`, which is no open socket"));
    }
    let name = PathBuf::from(display?);
    let shown = format!("no Wayland compositor answers at WAYLAND_DISPLAY={}", name.display());
    let path = match env::var_os("XDG_RUNTIME_DIR").filter(|folder| !folder.is_empty()) {
        _ if name.is_absolute() => name,
        Some(folder) => Path::new(&folder).join(name),
        None => return Some(format!("{shown}: XDG_RUNTIME_DIR is not set")),
    };
    let (sender, answer) = channel();
    // A thread, since already to connect may take for ever.
    std::thread::spawn(move || sender.send(ask(&path)));
    match answer.recv_timeout(PATIENCE) {
        Ok(Ok(())) => None,
        Ok(Err(error)) => Some(format!("{shown}: {error}")),
        Err(_) => Some(format!("{shown} within {} s", PATIENCE.as_secs())),
    }
}

/// Asks for a word at once (`wl_display::sync`, the first request there is), and waits for it.
fn ask(path: &Path) -> std::io::Result<()> {
    const DISPLAY: u32 = 1;
    const SYNC: u32 = 0;
    const BYTES: u32 = 12;
    const CALLBACK: u32 = 2;
    let mut stream = UnixStream::connect(path)?;
    let words = [DISPLAY, BYTES << 16 | SYNC, CALLBACK];
    stream.write_all(&words.map(u32::to_ne_bytes).concat())?;
    stream.read_exact(&mut [0])
}

fn is_socket(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|metadata| metadata.file_type().is_socket())
}
