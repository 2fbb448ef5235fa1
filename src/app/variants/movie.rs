//! Frames to a movie that players play, by ffmpeg, where that is found.

use std::io;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use glam::UVec2;

use super::answers::thumb::picture_of;
use super::record::{Answer, State};
use super::wanted::Wanted;
use crate::app::shared::describe::quoted;
use crate::app::shared::interrupt::Interrupt;
use crate::image::PictureFile;

/// Sides are made even, and colours are those of BT.709, but for sRGB's curve; both by name and by value, so that players show them right.
const FILTER: &str = "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv";

/// Makes a movie, `NAME.mp4`, of the frames that are wanted, which lie in a folder. Says in a line what came of it.
pub fn make(folder: &Path, answer: &Answer, wanted: &Wanted, fps: f64, interrupt: &Interrupt) -> String {
    let frames = || answer.records.iter().enumerate().filter(|(place, record)| wanted.has(*place, &record.name));
    let (count, missing) = (frames().count(), frames().filter(|(_, record)| record.state != State::Done).count());
    let Some((first, record)) = frames().next().filter(|_| missing == 0) else {
        return format!("no movie: {missing} of {count} frames are not done");
    };
    if let Some(other) =
        frames().map(|(_, record)| &record.name).find(|frame| size(folder, frame) != size(folder, &record.name))
    {
        return format!("no movie: the frames {} and {other} are of two sizes", record.name);
    }
    let (name, part) = (format!("{}.mp4", answer.name), format!(".lucerna-{}.mp4.part", answer.name));
    let numbers = format!("%0{}d", record.name.len());
    let words = |file: &str| -> Vec<String> {
        let input = picture_of(Path::new(""), &numbers).display().to_string();
        let [fps, first, count] = [fps.to_string(), first.to_string(), count.to_string()];
        let before =
            ["-y", "-nostdin", "-loglevel", "error", "-framerate", &fps, "-start_number", &first, "-i", &input];
        let picture = ["-frames:v", &count, "-vf", FILTER, "-c:v", "libx264", "-crf", "16", "-pix_fmt", "yuv420p"];
        let colour = ["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1"];
        let end = ["-movflags", "+faststart", "-f", "mp4", file];
        before.into_iter().chain(picture).chain(colour).chain(end).map(str::to_owned).collect()
    };
    // A name may begin with a dash, or look like the address of something else.
    let mut command = Command::new("ffmpeg");
    command.args(words(&format!("./{part}"))).current_dir(folder).stdin(Stdio::null());
    let failed = match run(&mut command, interrupt) {
        Ok(None) => "interrupted".to_owned(),
        Ok(Some(output)) if output.status.success() => match std::fs::rename(folder.join(&part), folder.join(&name)) {
            Ok(()) => return format!("{name}: {:.2} s at {fps} frames a second", count as f64 / fps),
            Err(error) => error.to_string(),
        },
        Ok(Some(output)) => {
            first_line(&output.stderr).unwrap_or_else(|| format!("ffmpeg ended with {}", output.status))
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => "ffmpeg is not installed".to_owned(),
        Err(error) => format!("ffmpeg can't be run: {error}"),
    };
    let _ = std::fs::remove_file(folder.join(&part));
    let words: Vec<String> = words(&format!("./{name}")).iter().map(|word| quoted(word)).collect();
    let folder = quoted(&folder.display().to_string());
    format!("no movie: {failed}; this would make it: cd {folder} && ffmpeg {}", words.join(" "))
}

/// The size of a frame's picture, if it can be read.
fn size(folder: &Path, frame: &str) -> Option<UVec2> {
    PictureFile::open(&picture_of(folder, frame)).ok().map(|picture| picture.size)
}

/// Runs a command to its end, or until an interrupt, which ends it too.
fn run(command: &mut Command, interrupt: &Interrupt) -> io::Result<Option<Output>> {
    const MOMENT: Duration = Duration::from_millis(20);
    // It says little, for which the pipe has room.
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn()?;
    while child.try_wait()?.is_none() {
        if interrupt.requested() {
            child.kill()?;
        }
        std::thread::sleep(MOMENT);
    }
    let output = child.wait_with_output()?;
    Ok((!interrupt.requested()).then_some(output))
}

/// The first line that says something.
fn first_line(text: &[u8]) -> Option<String> {
    let text = String::from_utf8_lossy(text);
    text.lines().map(str::trim).find(|line| !line.is_empty()).map(str::to_owned)
}
