//! What to say when TetGen fails: the step it was in, the place if there is one, what to try.

use crate::Error;
use crate::error::{ADVICE, Place};
use crate::plc::Plc;
use std::time::Duration;
use tetgen_sys::{Error as MesherError, Failure, Limits, tetrahedralize};

/// How long finding the place of a failure may take at most.
const DIAGNOSIS: Duration = Duration::from_secs(10);

/// The lines TetGen prints, as they come, and the last of them.
pub struct Chatter<'a> {
    log: &'a (dyn Fn(&str) + Sync),
    line: Vec<u8>,
    /// Last step announced; TetGen ends these lines in three dots.
    step: String,
}

/// Longest line kept; anything beyond is cut.
const LONGEST_LINE: usize = 1000;

impl<'a> Chatter<'a> {
    /// Passes whole lines to `log`.
    pub fn new(log: &'a (dyn Fn(&str) + Sync)) -> Self {
        Self {
            log,
            line: Vec::new(),
            step: String::new(),
        }
    }

    /// Takes the next bytes.
    pub fn take(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            if byte == b'\n' {
                self.end_line();
            } else if self.line.len() < LONGEST_LINE {
                self.line.push(byte);
            }
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

/// The error to report, with advice, and with the place when `locate` is set.
pub fn failure(
    source: MesherError,
    chatter: &Chatter<'_>,
    plc: &Plc,
    timeout: Option<Duration>,
    locate: bool,
) -> Error {
    // A later attempt gets what is left of the time; the user gave the whole.
    let source = match (source, timeout) {
        (MesherError::TimedOut(_), Some(whole)) => MesherError::TimedOut(whole),
        (other, _) => other,
    };
    let during = if chatter.step.is_empty() || matches!(source, MesherError::System { .. }) {
        String::new()
    } else {
        format!(" in its step '{}'", chatter.step)
    };
    let pairs = match source {
        MesherError::Crashed { .. } | MesherError::Failed(_) if locate => {
            intersections(plc, timeout.map_or(DIAGNOSIS, |t| t.min(DIAGNOSIS)))
        }
        _ => Intersections::default(),
    };
    let place = match pairs.first {
        Some(triangles) => {
            let [a, b] = triangles.map(|t| Place(plc.middle(t)));
            format!(
                "; {} pair(s) of surface triangles intersect, the first near {a} and {b}",
                pairs.count
            )
        }
        None => String::new(),
    };
    let advice = match &source {
        _ if pairs.count > 0 => "repair the surface there",
        MesherError::TimedOut(_) => {
            "raise --timeout, or ask for larger elements (--max-volume, --edge-length) or fewer (--radius-edge, --min-dihedral)"
        }
        MesherError::MemoryLimit(_) => {
            "raise --max-memory, or ask for larger elements (--max-volume, --edge-length)"
        }
        MesherError::Killed | MesherError::Failed(Failure::OutOfMemory) => {
            "ask for larger elements (--max-volume, --edge-length)"
        }
        MesherError::BadSwitches(_) | MesherError::NotLinear(_) => "see --switches",
        MesherError::System { .. } | MesherError::Stopped { .. } => {
            "this is not a matter of the input"
        }
        _ => ADVICE,
    };
    Error::Mesher {
        source,
        during,
        place,
        advice,
    }
}

#[derive(Default)]
struct Intersections {
    first: Option<[usize; 2]>,
    count: usize,
}

/// Intersecting triangles, as TetGen's switch `d` finds them.
fn intersections(plc: &Plc, timeout: Duration) -> Intersections {
    let mut text = Vec::new();
    let limits = Limits {
        timeout: Some(timeout),
        ..Limits::default()
    };
    // Only what it prints is of interest; 1 MiB of it is plenty.
    let _ = tetrahedralize(&plc.complex(), "pd", limits, &mut |bytes| {
        if text.len() < 1 << 20 {
            text.extend_from_slice(bytes);
        }
    });
    let triangles = plc.complex().triangles.len();
    let mut found = Intersections::default();
    for line in String::from_utf8_lossy(&text).lines() {
        if let Some(pair) = facet_pair(line) {
            found.count += 1;
            if found.first.is_none() && pair.iter().all(|&t| t < triangles) {
                found.first = Some(pair);
            }
        }
    }
    if found.first.is_none() {
        found.count = 0;
    }
    found
}

/// Reads a line such as `Facet #12 intersects facet #31 at triangles:`; facets count from 1.
fn facet_pair(line: &str) -> Option<[usize; 2]> {
    let line = line.trim();
    if !line.starts_with("Facet #") {
        return None;
    }
    let mut numbers = line.split('#').skip(1).map(|part| {
        let digits: String = part.chars().take_while(char::is_ascii_digit).collect();
        digits.parse::<usize>().ok()?.checked_sub(1)
    });
    Some([numbers.next()??, numbers.next()??])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn pairs_of_facets_are_read() {
        let line = "  Facet #1 intersects facet #33 at triangles:";
        assert_eq!(facet_pair(line), Some([0, 32]));
        assert_eq!(facet_pair("Facet #0 duplicates facet #3"), None);
        assert_eq!(facet_pair("Facet #2"), None);
        assert_eq!(facet_pair("Delaunizing vertices..."), None);
    }

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
