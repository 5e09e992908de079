//! Looks for what makes tetrahedra better on several threads, and does it in their order.
//!
//! What is to be done with a tetrahedron depends on what there is at its corners. So it is found for many of them on
//! the mesh as it is, and then done one after the other; where something at a corner was changed by one before,
//! it is found anew. The result is that of one thread, to the last bit.

use crate::flip::{self, Flip};
use crate::freedoms::Freedoms;
use crate::mesh::Mesh;
use crate::smooth::{self, Move};
use rayon::prelude::*;
use std::iter::repeat_with;

/// A bad tetrahedron: its quality, and its number.
pub type Bad = (f64, u32);

/// What makes a tetrahedron better.
pub enum Step {
    /// Others in the place of some.
    Flip(Box<Flip>),
    /// A corner elsewhere, by its number from 0 to 3.
    Move(usize, Move),
}

/// How often something was done.
#[derive(Clone, Copy, Default, PartialEq)]
pub struct Count {
    pub moved: usize,
    pub flipped: usize,
    /// Tetrahedra that were looked at.
    pub looked_at: usize,
}

/// When nothing was found for a tetrahedron, by its number: nothing will be before something changes at its corners.
pub type Failed = Vec<Option<u32>>;

/// Makes tetrahedra better, those that are still there with the same quality when it is their turn, until there is a reason to stop.
pub fn work(
    mesh: &mut Mesh<'_>,
    freedoms: &Freedoms,
    bad: &[Bad],
    (failed, stop): (&mut Failed, &dyn Fn() -> bool),
) -> Count {
    let mut count = Count::default();
    let ahead = rayon::current_num_threads() > 1;
    // Of so many tetrahedra looked at together, the same few have corners in common with what is changed before them,
    // however large the mesh is.
    let at_once = mesh.positions.len().isqrt();
    for some in bad.chunks(if ahead { at_once } else { bad.len() }.max(1)) {
        failed.resize(failed.len().max(mesh.len()), None);
        let now = mesh.now();
        let found = match ahead {
            true => look_ahead(mesh, freedoms, some, failed),
            false => Vec::new(),
        };
        let found = found.into_iter().map(Some).chain(repeat_with(|| None));
        for (&(quality, tet), step) in some.iter().zip(found) {
            if !is_there(mesh, quality, tet) || is_hopeless(mesh, freedoms, tet, failed) {
                continue;
            }
            if stop() {
                return count;
            }
            count.looked_at += 1;
            let (step, time) = match step {
                Some(step) if !is_touched(mesh, freedoms, tet, now) => (step, now),
                _ => (find(mesh, freedoms, tet, 0), mesh.now()),
            };
            if step.is_none()
                && let Some(failed) = failed.get_mut(tet as usize)
            {
                *failed = Some(time);
            }
            take(mesh, freedoms, tet, step, &mut count);
        }
    }
    count
}

/// What makes each tetrahedron better, on several threads.
fn look_ahead(
    mesh: &Mesh<'_>,
    freedoms: &Freedoms,
    bad: &[Bad],
    failed: &Failed,
) -> Vec<Option<Step>> {
    let step = |&(quality, tet): &Bad| {
        let open = is_there(mesh, quality, tet) && !is_hopeless(mesh, freedoms, tet, failed);
        open.then(|| find(mesh, freedoms, tet, 0)).flatten()
    };
    bad.par_iter().map(step).collect()
}

/// Whether nothing else has taken the place of a tetrahedron.
pub fn is_there(mesh: &Mesh<'_>, quality: f64, tet: u32) -> bool {
    (tet as usize) < mesh.len() && mesh.grade(tet).quality == quality
}

/// Whether nothing was found for a tetrahedron that is there, and nothing has changed since.
fn is_hopeless(mesh: &Mesh<'_>, freedoms: &Freedoms, tet: u32, failed: &Failed) -> bool {
    let last = failed.get(tet as usize).copied().flatten();
    last.is_some_and(|time| !is_touched(mesh, freedoms, tet, time))
}

/// Whether anything that [`find`] looks at changed after that time.
fn is_touched(mesh: &Mesh<'_>, freedoms: &Freedoms, tet: u32, time: u32) -> bool {
    mesh.corners(tet).into_iter().any(|v| {
        let mover = freedoms.mover(v);
        let partner = freedoms.partner(mover);
        mesh.is_touched(v, time)
            || (mover != v && mesh.is_touched(mover, time))
            || partner.is_some_and(|(other, _)| mesh.is_touched(other, time))
    })
}

/// The first thing that makes a tetrahedron better. From corner 0, or, after something was moved, further corners.
fn find(mesh: &Mesh<'_>, freedoms: &Freedoms, tet: u32, from: usize) -> Option<Step> {
    let flip = (from == 0).then(|| flip::find(mesh, tet)).flatten();
    if let Some(flip) = flip {
        return Some(Step::Flip(Box::new(flip)));
    }
    let corners = mesh.corners(tet);
    (from..4).find_map(|i| {
        let found = smooth::find(mesh, freedoms, corners[i]);
        found.map(|m| Step::Move(i, m))
    })
}

/// Does what was found for a tetrahedron, and moves further corners while it is not good enough.
fn take(
    mesh: &mut Mesh<'_>,
    freedoms: &Freedoms,
    tet: u32,
    mut step: Option<Step>,
    count: &mut Count,
) {
    while let Some(what) = step.take() {
        match what {
            Step::Flip(flip) => {
                flip.apply(mesh);
                count.flipped += 1;
            }
            Step::Move(corner, to) => {
                to.apply(mesh);
                count.moved += 1;
                if mesh.grade(tet).quality < 1.0 && corner < 3 {
                    step = find(mesh, freedoms, tet, corner + 1);
                }
            }
        }
    }
}
