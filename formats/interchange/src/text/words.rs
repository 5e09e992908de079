//! Names and counts as they can stand in messages and in lines of other files.

/// Longest title of a legacy VTK file, without the line end ("VTK File Formats": 256 characters with it).
pub const MAX_TITLE: usize = 255;

/// A name without control characters, which would break lines of other formats and steer terminals.
pub fn plain(name: &str) -> String {
    name.replace(char::is_control, " ").trim().to_owned()
}

/// Text without line ends and other control characters, of at most [`MAX_TITLE`] bytes.
pub fn one_line(text: &str) -> String {
    let mut line = text.replace(|c: char| c.is_control(), " ");
    line.truncate(line.floor_char_boundary(MAX_TITLE));
    line
}

/// `1 edge`, `2 edges`.
pub fn counted(n: usize, one: &str, many: &str) -> String {
    if n == 1 {
        format!("1 {one}")
    } else {
        format!("{n} {many}")
    }
}
