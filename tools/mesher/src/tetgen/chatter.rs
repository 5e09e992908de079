//! The lines that TetGen prints.

use crate::Log;

/// The lines TetGen prints, as they come, and the last of them.
pub struct Chatter<'a> {
    log: Log<'a>,
    line: Vec<u8>,
    /// Last step announced; TetGen ends these lines in three dots.
    pub step: String,
}

impl<'a> Chatter<'a> {
    /// Passes whole lines to `log`.
    pub fn new(log: Log<'a>) -> Self {
        Self {
            log,
            line: Vec::new(),
            step: String::new(),
        }
    }

    /// Takes the next bytes. A line that fills more than one reading of them ends with it, so that a mesher gone wild
    /// takes no memory here: TetGen prints line by line, and none of its lines is as long.
    pub fn take(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            match byte {
                b'\n' => self.end_line(),
                _ => self.line.push(byte),
            }
        }
        if self.line.len() > bytes.len() {
            self.end_line();
        }
    }

    fn end_line(&mut self) {
        let line = String::from_utf8_lossy(&self.line).trim().to_owned();
        self.line.clear();
        if line.is_empty() {
            return;
        }
        if let Some(step) = line.strip_suffix("...") {
            self.step = step.trim().to_owned();
        }
        (self.log)(&format!("TetGen: {line}"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn chatter_is_cut_into_lines() {
        let lines = Mutex::new(Vec::new());
        let log = |line: &str| lines.lock().unwrap().push(line.to_owned());
        let mut chatter = Chatter::new(&log);
        chatter.take(b"Delaunizing ver");
        chatter.take(b"tices...\n\nDone\nhalf");
        assert_eq!(chatter.step, "Delaunizing vertices");
        assert_eq!(
            *lines.lock().unwrap(),
            ["TetGen: Delaunizing vertices...", "TetGen: Done"]
        );
    }
}
