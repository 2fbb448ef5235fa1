//! The one table of keys: what F1 shows, what `lucerna view --help` prints, and what docs/window.md lists.

/// A key or gesture, and what it does.
pub const KEYS: &[(&str, &str)] = &[
    ("left drag", "orbit about the point that is looked at"),
    (
        "left click",
        "select the mesh that is clicked, and show its material in the panel; again, or beside all: let go of it",
    ),
    ("middle drag, Shift + left drag", "pan"),
    ("wheel, right drag", "come closer, go away"),
    ("Ctrl + wheel", "the picture's pixels as larger squares, up to 64:1; back to 1:1"),
    ("P", "the brightest paths of the pixel under the pointer, over the picture; again: take them away"),
    ("W A S D, Q E", "fly; down and up"),
    ("Ctrl + left click", "focus to what is under the pointer"),
    ("F", "show the whole scene"),
    ("1 to 9", "the scene's cameras in the order of their names, as the scene's file has them"),
    ("R", "start the film anew"),
    ("Space", "pause the film, let it go on"),
    ("B, Shift + B", "half a stop brighter, darker"),
    ("C", "copy the camera as a line for the scene file, and print it"),
    ("Ctrl + S", "save what was changed here into the scene's file"),
    ("J", "judge the last edit of the shaders by what was there before"),
    ("[ and ]", "the member before, and the next, of a family of scenes"),
    (
        "V",
        "before on the left, after on the right: of what was judged, or of the last two members; the line between them can be dragged",
    ),
    ("F1", "this help"),
    ("F2", "the panel, off and on"),
    ("F5", "read shaders and scene again"),
    ("F11", "fullscreen"),
    ("F12", "save PNG and EXR to result/, and say the command that gives them again"),
    ("Esc", "take paths away; quit"),
];

/// The table as lines of text.
pub fn listed() -> String {
    let width = KEYS.iter().map(|(key, _)| key.len()).max().unwrap_or_default();
    let lines: Vec<String> = KEYS.iter().map(|(key, meaning)| format!("  {key:width$}  {meaning}")).collect();
    format!("Keys of the window:\n{}", lines.join("\n"))
}
