//! The line of progress while templates are meshed.

use kit::{Session, Status, about};
use mesher::{Log, Progress};
use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Does work that says how far it is: details among the lines of `-v`, progress on a line that goes away afterwards.
/// The work may tell how many tetrahedra of all templates are expected, and what to say of that.
pub fn watched<T>(
    session: &Session,
    work: impl FnOnce(Log<'_>, &(dyn Fn(f64, &str) + Sync)) -> T,
) -> T {
    let detail = |text: &str| session.info(text);
    let log = Log::new(&detail);
    let line = session.status();
    if !line.is_shown() {
        return work(log, &|_, text| session.info(text));
    }
    let meshing = Meshing {
        line,
        expected: Mutex::default(),
        templates: Mutex::default(),
    };
    let hear = |progress: &Progress<'_>| meshing.hear(progress);
    let expect = |tetrahedra: f64, text: &str| {
        *unpoisoned(&meshing.expected) = Some(tetrahedra);
        meshing.line.aside(|| session.note(text));
    };
    work(log.with_progress(&hear), &expect)
}

/// What is in there: what a panic elsewhere left is as good as before.
fn unpoisoned<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Shows what is done, and the points and tetrahedra of all templates so far.
struct Meshing {
    line: Status,
    /// Tetrahedra expected of all templates.
    expected: Mutex<Option<f64>>,
    /// Points and tetrahedra of each template.
    templates: Mutex<BTreeMap<usize, [f64; 2]>>,
}

impl Meshing {
    /// Takes what is heard of a template.
    fn hear(&self, progress: &Progress<'_>) {
        let mut templates = unpoisoned(&self.templates);
        templates.insert(progress.template, [progress.points, progress.tetrahedra]);
        let sum = |i: usize| templates.values().map(|counts| counts[i]).sum();
        let text = text(progress.step, [sum(0), sum(1)], *unpoisoned(&self.expected));
        self.line.show(text);
    }
}

/// A step, and how far it is: what is cut off where a terminal is narrow comes last.
fn text(step: &str, [points, tetrahedra]: [f64; 2], expected: Option<f64>) -> String {
    if tetrahedra == 0.0 {
        return step.to_owned();
    }
    let so_far = about(tetrahedra);
    let of_expected = match expected {
        Some(expected) if tetrahedra < expected => format!(
            " of about {} tetrahedra, {:.0} %",
            about(expected),
            (100.0 * tetrahedra / expected).floor()
        ),
        Some(expected) => format!(" tetrahedra (about {} expected)", about(expected)),
        None => " tetrahedra".to_owned(),
    };
    // Of few points none may have been counted.
    let points = match points {
        0.0 => String::new(),
        points => format!(", {} points", about(points)),
    };
    format!("{step}: {so_far}{of_expected}{points}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_how_far_it_is() {
        assert_eq!(text("refining mesh", [0.0; 2], Some(5e4)), "refining mesh");
        let refining = |expected| text("refining mesh", [12_345.0, 119_999.0], expected);
        assert_eq!(
            refining(Some(4.51e5)),
            "refining mesh: 120 000 of about 450 000 tetrahedra, 26 %, 12 000 points"
        );
        assert_eq!(
            refining(Some(1e5)),
            "refining mesh: 120 000 tetrahedra (about 100 000 expected), 12 000 points"
        );
        assert_eq!(
            text("refining mesh", [0.0, 30.0], None),
            "refining mesh: 30 tetrahedra"
        );
        assert_eq!(
            refining(None),
            "refining mesh: 120 000 tetrahedra, 12 000 points"
        );
    }
}
