//! What the user is told of triangles that were turned over, and of what keeps sides from being told apart.

use crate::meeting::meetings;
use crate::soup::surface::{NONE, Surface};
use crate::words::place;
use geom::cells::Cells;
use geom::edges::Edges;
use interchange::text::counted;
use rustc_hash::FxHashMap;

/// What keeps inside and outside from being told apart: where the surface crosses itself, and edges with more than two
/// triangles; to be put before what follows from it.
pub fn causes(surface: &Surface, edges: &Edges) -> String {
    let met = meetings(&surface.points, &surface.triangles, |t| t, |_| true);
    let mut causes = Vec::new();
    if let Some(first) = met.lowest {
        let (one, many) = (
            "pair of triangles crosses or touches",
            "pairs of triangles cross or touch",
        );
        let what = counted(met.count, one, many);
        causes.push(format!("{what}, the first at {}", place(first.point)));
    }
    let mut crowded = (0..edges.len()).filter(|&e| edges.around(e).len() > 2);
    if let Some(first) = crowded.next() {
        let (one, many) = ("edge has", "edges have");
        let what = counted(1 + crowded.count(), one, many);
        let [a, b] = edges.ends[first].map(|v| place(surface.points[v as usize]));
        causes.push(format!(
            "{what} more than two triangles, the first from {a} to {b}"
        ));
    }
    match causes.is_empty() {
        true => String::new(),
        false => format!("{}; so ", causes.join(" and ")),
    }
}

/// Triangles of a solid or a shell: how many were turned, and how many there are.
#[derive(Clone, Copy, Default)]
struct Share {
    turned: usize,
    all: usize,
}

impl Share {
    fn is_whole(self) -> bool {
        self.turned == self.all && self.all > 0
    }
}

/// Notices about triangles that had to be turned over: whole solids, whole shells, single triangles.
/// `shell` is the shell of each triangle. An interface has a solid on both sides, so that neither
/// orientation of it is wrong.
pub fn explain_turned(
    surface: &Surface,
    cells: &Cells<'_>,
    shell: &[u32],
    solids: usize,
    turned: &[bool],
) -> Vec<String> {
    let counts = |t: usize| surface.partner[t] == NONE;
    if !(0..shell.len()).any(|t| turned[t] && counts(t)) {
        return Vec::new();
    }
    let mut of_solid = vec![Share::default(); solids];
    let mut of_shell: FxHashMap<u32, Share> = FxHashMap::default();
    for t in (0..shell.len()).filter(|&t| counts(t)) {
        for share in [
            &mut of_solid[surface.solid[t] as usize],
            of_shell.entry(shell[t]).or_default(),
        ] {
            share.turned += usize::from(turned[t]);
            share.all += 1;
        }
    }
    let mut notices = Vec::new();
    for (solid, share) in of_solid.iter().enumerate().filter(|s| s.1.is_whole()) {
        notices.push(if solids == 1 {
            "the surface is oriented inwards: turned over".to_owned()
        } else {
            let name = surface.solid_name(solid as u32);
            format!(
                "{name} is oriented inwards: turned over ({} triangles)",
                share.turned
            )
        });
    }
    let mut others = Others::default();
    let mut last = NONE;
    for t in (0..shell.len()).filter(|&t| counts(t) && turned[t]) {
        if of_solid[surface.solid[t] as usize].is_whole() {
            continue;
        }
        if !of_shell[&shell[t]].is_whole() {
            others.triangles += 1;
        } else if shell[t] != last {
            last = shell[t];
            // Turned, so the empty cell is the one behind the triangle as the file has it.
            if cells.back(t) == Cells::UNBOUNDED {
                others.shells += 1;
            } else {
                others.voids += 1;
                others.first_void.get_or_insert(t);
            }
        }
    }
    notices.extend(others.notices(surface));
    notices
}

/// What was turned over beside whole solids.
#[derive(Default)]
struct Others {
    /// Shells around a void.
    voids: usize,
    /// A triangle of the first of them.
    first_void: Option<usize>,
    /// Shells around material.
    shells: usize,
    /// Triangles of shells that were not turned as a whole.
    triangles: usize,
}

impl Others {
    fn notices(&self, surface: &Surface) -> Vec<String> {
        let mut notices = Vec::new();
        if let Some(t) = self.first_void {
            let [a, b, c] = surface.corners(t as u32);
            notices.push(format!(
                "{} inside the body {} like an outer surface, the first at {}: taken as voids",
                counted(self.voids, "closed surface", "closed surfaces"),
                if self.voids == 1 {
                    "is oriented"
                } else {
                    "are oriented"
                },
                place((a + b + c) / 3.0)
            ));
        }
        if self.shells > 0 {
            let (one, many) = ("piece of the surface is", "pieces of the surface are");
            let what = counted(self.shells, one, many);
            notices.push(format!("{what} oriented inwards: turned over"));
        }
        if self.triangles > 0 {
            let (one, many) = ("triangle is oriented", "triangles are oriented");
            let what = counted(self.triangles, one, many);
            notices.push(format!("{what} against the others: turned over"));
        }
        notices
    }
}
