//! What is heard of TetGen: the lines that it prints, and how far it is.

use crate::{Log, Progress};
use tetgen_sys::Counts;

/// Tetrahedra that TetGen checks for each one of its mesh; it replaces the others later. Measured as the last count over
/// the tetrahedra of the mesh, on twenty bodies: 1.3 to 1.4 where a size was asked for, 1.2 to 1.8 elsewhere.
const CHECKED: f64 = 1.4;

/// The lines TetGen prints, as they come, the last step among them, and the last counts.
pub struct Chatter<'a> {
    log: Log<'a>,
    template: usize,
    line: Vec<u8>,
    counts: Counts,
    /// Last step announced; TetGen ends these lines in three dots.
    pub step: String,
}

impl<'a> Chatter<'a> {
    /// Passes whole lines about a template to `log`.
    pub fn new(log: Log<'a>, template: usize) -> Self {
        Self {
            log,
            template,
            line: Vec::new(),
            counts: Counts::default(),
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

    /// Takes the next counts.
    pub fn count(&mut self, counts: Counts) {
        self.counts = counts;
        self.tell();
    }

    fn tell(&self) {
        let mut letters = self.step.chars();
        let first = letters.next().map(|c| c.to_ascii_lowercase());
        let step: String = first.into_iter().chain(letters).collect();
        self.log.progress(&Progress {
            template: self.template,
            step: &step,
            points: self.counts.points as f64,
            tetrahedra: self.counts.checked as f64 / CHECKED,
        });
    }

    fn end_line(&mut self) {
        let line = String::from_utf8_lossy(&self.line).trim().to_owned();
        self.line.clear();
        if line.is_empty() {
            return;
        }
        if let Some(step) = line.strip_suffix("...") {
            self.step = step.trim().to_owned();
            self.tell();
        }
        self.log.detail(&format!("TetGen: {line}"));
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
        let mut chatter = Chatter::new(Log::new(&log), 0);
        chatter.take(b"Delaunizing ver");
        chatter.take(b"tices...\n\nDone\nhalf");
        assert_eq!(chatter.step, "Delaunizing vertices");
        assert_eq!(
            *lines.lock().unwrap(),
            ["TetGen: Delaunizing vertices...", "TetGen: Done"]
        );
    }

    #[test]
    fn steps_and_counts_are_told() {
        let told = Mutex::new(Vec::new());
        let hear = |p: &Progress<'_>| {
            let so_far = (p.template, p.step.to_owned(), p.points, p.tetrahedra);
            told.lock().unwrap().push(so_far);
        };
        let detail = |_: &str| ();
        let log = Log::new(&detail).with_progress(&hear);
        let mut chatter = Chatter::new(log, 3);
        chatter.take(b"Refining mesh...\nDone\n");
        chatter.count(Counts {
            checked: 130,
            points: 32,
        });
        let step = || "refining mesh".to_owned();
        assert_eq!(
            *told.lock().unwrap(),
            [(3, step(), 0.0, 0.0), (3, step(), 32.0, 130.0 / CHECKED)]
        );
    }
}
