//! Makes the worst tetrahedra better: moves vertices, replaces edges and faces, adds vertices.
//!
//! The mesher sees a wedge with a surface that it must keep where copies meet, and cannot do there what it
//! does inside. Here a seam is the inside that it is in the assembled mesh: the star of a vertex on it
//! is what is at the vertex together with what is at its partner, turned back, and both move as one.
//! Vertices on facets, walls and straight edges move along them, so shape, walls and the
//! triangulation of the surface stay.

mod ahead;
mod flip;
mod freedom;
mod insert;
mod mesh;
mod quality;
mod smooth;
mod stars;

#[cfg(test)]
mod tests;

pub use freedom::{Flats, Freedoms};

use ahead::{Bad, Count, Failed};
use geom::tet::TetMeasures;
use mesh::{Corners, Mesh};
use quality::Goal;
use rustc_hash::FxHashMap;
use tmesh::Template;

/// New tetrahedra have at least this quality: what is so near to flat that rounding could decide is not
/// touched.
const LEAST: f64 = 1e-4;

/// Rounds over the worst tetrahedra, and how many more while there are [`MANY`].
const ROUNDS: usize = 6;
const MORE_ROUNDS: usize = 14;

/// Part of the tetrahedra that is many to be bad.
const MANY: f64 = 0.01;

/// So many are worked on in any case.
const AT_LEAST: usize = 1000;

/// So many are few, and this part of all: they are given new vertices, which takes a hundred times as long as to
/// replace a face.
const FEW: usize = 128;
const FEW_PART: f64 = 1.0 / 400.0;

/// Angles below this times the smallest one asked for get new vertices, too.
const MARGIN: f64 = 1.5;

/// Times that all this is done, with new vertices in between for what is left.
const PASSES: usize = 3;

/// Part of the bad tetrahedra of the last round that are left where further rounds are no use.
const STUCK: f64 = 0.98;

/// What is asked of the elements.
pub struct Wish<'a> {
    /// Smallest dihedral angle, degrees.
    pub angle: f64,
    /// Largest radius-edge ratio.
    pub radius_edge: f64,
    /// Smallest dihedral angle asked for, degrees; the mesher may have been asked for less.
    pub min_dihedral: f64,
    /// Largest volume by region, model units cubed.
    pub max_volume: &'a FxHashMap<u32, f64>,
    /// A power of two that brings coordinates near one.
    pub scale: f64,
    /// Part of the tetrahedra that is worked on, at most.
    pub share: f64,
}

/// What was done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Improved {
    /// Tetrahedra that were not good enough before.
    pub bad: usize,
    /// And afterwards.
    pub left: usize,
    /// Those of them past the radius-edge bound.
    pub past: usize,
    /// Those of them with an angle that is smaller than the mesher was asked for.
    pub low: usize,
    /// The smallest angle of those that are left, degrees; 180 when there are none.
    pub least: f64,
    /// Vertices moved; pairs on seams count once.
    pub moved: usize,
    /// Edges and faces replaced.
    pub flipped: usize,
    /// New vertices.
    pub inserted: usize,
}

/// Improves the tetrahedra of a template. Surface triangles, walls and numbers of vertices stay; new vertices have
/// numbers beyond. The number of threads makes no difference to the result.
///
/// At first an element past the radius-edge bound is worth as much as one with two thirds of the angle. When nothing
/// helps any more, the bounds that the mesher was to keep come first.
pub fn improve(
    template: &mut Template,
    freedoms: &Freedoms,
    wish: &Wish<'_>,
    threads: usize,
) -> Improved {
    let goal = Goal::new(wish.angle, wish.radius_edge);
    let cube = 6.0 * wish.scale.powi(3);
    let limits: FxHashMap<u32, f64> = wish
        .max_volume
        .iter()
        .map(|(&r, &v)| (r, v * cube))
        .collect();
    let mut mesh = Mesh::new(template, wish.scale, goal, &limits, threads);
    let mut done = Improved::default();
    let mut tried = Tried::default();
    for pass in 0..PASSES {
        rounds(&mut mesh, freedoms, wish, threads, &mut tried, &mut done);
        // Where many are not as asked for, the shape is to blame, and other rounds are no use.
        let last = pass + 1 == PASSES || failing(&mesh, wish, 1.0).len() > few(&mesh);
        if last || !add_vertices(&mut mesh, freedoms, wish, 1.0, &mut tried, &mut done) {
            break;
        }
    }
    let bound_before = goal.with_bound_before(wish.min_dihedral);
    let past = failing(&mesh, wish, 1.0);
    mesh.change_goal(bound_before, past.into_iter().map(|(_, tet)| tet));
    // Within the bounds first, then with some room.
    let mut tried = Tried::default();
    for margin in [1.0, MARGIN] {
        mend(&mut mesh, freedoms, wish, margin, &mut tried, &mut done);
    }
    left_over(&mesh, wish, &mut done);
    for (p, &moved) in template.vertices.iter_mut().zip(&mesh.positions) {
        // Exact: the scale is a power of two.
        if *p * wish.scale != moved {
            *p = moved / wish.scale;
        }
    }
    let added = &mesh.positions[template.vertices.len()..];
    template
        .vertices
        .extend(added.iter().map(|&p| p / wish.scale));
    template.tets = mesh.into_tets();
    done
}

/// Rounds over the worst tetrahedra, as long as they are of use.
fn rounds(
    mesh: &mut Mesh<'_>,
    freedoms: &Freedoms,
    wish: &Wish<'_>,
    threads: usize,
    tried: &mut Tried,
    done: &mut Improved,
) {
    let most = ((mesh.len() as f64 * wish.share) as usize).max(AT_LEAST);
    let first = done.bad == 0;
    let mut last = f64::INFINITY;
    for round in 0..ROUNDS + MORE_ROUNDS {
        let mut bad: Vec<Bad> = (0..mesh.len() as u32)
            .map(|t| (mesh.grade(t).quality, t))
            .filter(|b| b.0 < 1.0)
            .collect();
        if round == 0 && first {
            done.bad = bad.len();
        }
        let (now, few) = (bad.len() as f64, MANY * mesh.len() as f64);
        if round >= ROUNDS && (now < few || now > STUCK * last) {
            break;
        }
        last = now;
        bad.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        bad.truncate(most);
        let count = ahead::work(mesh, freedoms, &bad, threads, &mut tried.others);
        done.moved += count.moved;
        done.flipped += count.flipped;
        if count == Count::default() {
            break;
        }
    }
}

/// Whether a tetrahedron is past the radius-edge bound, and whether it has an angle that is smaller than the mesher
/// was asked for; and its smallest angle, degrees.
fn failings(mesh: &Mesh<'_>, wish: &Wish<'_>, tet: u32) -> (bool, bool, f64) {
    let measures = TetMeasures::of(mesh.corners(tet).map(|v| mesh.positions[v as usize]));
    let angle = measures.min_dihedral.to_degrees();
    let past = measures.radius_edge_ratio > wish.radius_edge;
    (past, angle < wish.min_dihedral, angle)
}

/// Counts what is left.
fn left_over(mesh: &Mesh<'_>, wish: &Wish<'_>, done: &mut Improved) {
    (done.left, done.past, done.low, done.least) = (0, 0, 0, 180.0);
    for t in (0..mesh.len() as u32).filter(|&t| mesh.grade(t).quality < 1.0) {
        let (past, low, angle) = failings(mesh, wish, t);
        done.left += 1;
        done.past += usize::from(past);
        done.low += usize::from(low);
        done.least = done.least.min(angle);
    }
}

/// Tetrahedra for which nothing was found, and when: they are tried again only where something has changed at their
/// corners.
#[derive(Default)]
struct Tried {
    /// A new vertex.
    vertices: FxHashMap<Corners, u32>,
    /// Everything else.
    others: Failed,
}

/// How many tetrahedra are worth much work each.
fn few(mesh: &Mesh<'_>) -> usize {
    FEW.max((FEW_PART * mesh.len() as f64) as usize)
}

/// Tetrahedra that are not as the mesher was asked for, the worst first; angles count that are less than `margin` times
/// the smallest one asked for.
fn failing(mesh: &Mesh<'_>, wish: &Wish<'_>, margin: f64) -> Vec<Bad> {
    let below = (0..mesh.len() as u32).filter(|&t| mesh.grade(t).quality < 1.0);
    let failing = below.filter(|&t| {
        let (past, _, angle) = failings(mesh, wish, t);
        past || angle < margin * wish.min_dihedral
    });
    let mut bad: Vec<Bad> = failing.map(|t| (mesh.grade(t).quality, t)).collect();
    bad.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    bad
}

/// Gives what is still not as the mesher was asked for new vertices, where that helps; returns whether it did.
fn add_vertices(
    mesh: &mut Mesh<'_>,
    freedoms: &Freedoms,
    wish: &Wish<'_>,
    margin: f64,
    tried: &mut Tried,
    done: &mut Improved,
) -> bool {
    let before = done.inserted;
    let worst = failing(mesh, wish, margin).into_iter().take(few(mesh));
    for (quality, tet) in worst {
        if !ahead::is_there(mesh, quality, tet) {
            continue;
        }
        let corners = mesh.corners(tet);
        let last = tried.vertices.insert(corners, mesh.now());
        if last.is_some_and(|time| corners.iter().all(|&v| !mesh.is_touched(v, time))) {
            continue;
        }
        if let Some(insertion) = insert::find(mesh, freedoms, tet) {
            insertion.apply(mesh);
            done.inserted += 1;
        }
    }
    done.inserted > before
}

/// Everything that helps against what is not as the mesher was asked for, and nothing else.
fn mend(
    mesh: &mut Mesh<'_>,
    freedoms: &Freedoms,
    wish: &Wish<'_>,
    margin: f64,
    tried: &mut Tried,
    done: &mut Improved,
) {
    for _ in 0..PASSES {
        let mut worst = failing(mesh, wish, margin);
        worst.truncate(few(mesh));
        let count = ahead::work(mesh, freedoms, &worst, 1, &mut tried.others);
        done.moved += count.moved;
        done.flipped += count.flipped;
        let added = add_vertices(mesh, freedoms, wish, margin, tried, done);
        if !added && count == Count::default() {
            break;
        }
    }
}
