//! The order of the work: rounds over the worst tetrahedra, new vertices for what is left, the bounds first in the end.

use crate::ahead::{self, Bad, Count, Failed};
use crate::freedom::Freedoms;
use crate::insert;
use crate::mesh::{Corners, Mesh};
use crate::quality::Goal;
use geom::tet::TetMeasures;
use rustc_hash::FxHashMap;
use tmesh::Template;

/// Rounds over the worst tetrahedra. Most of what can be done is done in the first three or four; each further one costs as
/// much as the first and finds what others have made possible.
const ROUNDS: usize = 6;

/// Further rounds at most, while more than the part [`MANY`] of all tetrahedra is bad, so that each of them still
/// finds something.
const MORE_ROUNDS: usize = 14;

/// The part of all tetrahedra that is worth further rounds.
const MANY: f64 = 0.01;

/// Further rounds end when one leaves more than this part of the bad tetrahedra as they are.
const STUCK: f64 = 0.98;

/// Tetrahedra that are worked on in each round in any case, whatever part of all they are: small meshes cost nothing.
const AT_LEAST: usize = 1000;

/// Tetrahedra that get new vertices, at most: looking for the place of a vertex takes a hundred times as long as replacing a
/// face. In small meshes this many, which take some milliseconds ...
const FEW: usize = 128;

/// ... and in large ones this part of all, so that new vertices take no longer than the rounds.
const FEW_PART: f64 = 1.0 / 400.0;

/// In the end, tetrahedra whose smallest angle is below this times the one asked for get new vertices, too, so that the
/// smallest angles of a mesh are not just those asked for. A larger value adds vertices for little.
const MARGIN: f64 = 1.5;

/// Times that rounds follow each other, with new vertices in between for what is left; and that what is not as asked for is
/// worked on alone. What the second pass leaves is mostly the shape's fault; a third one costs little, since what was
/// tried in vain is not tried again.
const PASSES: usize = 3;

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
/// helps any more, the bounds that were asked for come first.
pub fn improve(template: &mut Template, freedoms: &Freedoms, wish: &Wish<'_>) -> Improved {
    let goal = Goal::new(wish.angle, wish.radius_edge);
    let cube = 6.0 * wish.scale.powi(3);
    let limits: FxHashMap<u32, f64> = wish
        .max_volume
        .iter()
        .map(|(&r, &v)| (r, v * cube))
        .collect();
    let mut work = Work {
        mesh: Mesh::new(template, wish.scale, goal, &limits),
        freedoms,
        wish,
        tried: Tried::default(),
        done: Improved::default(),
    };
    work.done.bad = work.bad().len();
    for pass in 0..PASSES {
        work.rounds();
        // Where many are not as asked for, the shape is to blame, and other rounds are no use.
        let last = pass + 1 == PASSES || work.failing(1.0).len() > work.affordable();
        if last || !work.add_vertices(1.0) {
            break;
        }
    }
    work.put_bounds_first(goal);
    // Within the bounds first, then with some room.
    for margin in [1.0, MARGIN] {
        work.mend(margin);
    }
    work.count_what_is_left();
    let Work { mesh, done, .. } = work;
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

/// A mesh that is improved.
struct Work<'a> {
    mesh: Mesh<'a>,
    freedoms: &'a Freedoms,
    wish: &'a Wish<'a>,
    tried: Tried,
    done: Improved,
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

/// What of the wishes a tetrahedron does not fulfil.
struct Failing {
    /// The radius-edge bound.
    past: bool,
    /// Its smallest dihedral angle, degrees.
    angle: f64,
}

impl Work<'_> {
    /// Tetrahedra that are not good enough, the worst first.
    fn bad(&self) -> Vec<Bad> {
        let all = 0..self.mesh.len() as u32;
        let grades = all.map(|t| (self.mesh.grade(t).quality, t));
        let mut bad: Vec<Bad> = grades.filter(|b| b.0 < 1.0).collect();
        bad.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        bad
    }

    /// Those of them that are not as asked for, the worst first; angles count that are less than `margin` times the
    /// smallest one asked for.
    fn failing(&self, margin: f64) -> Vec<Bad> {
        let mut bad = self.bad();
        bad.retain(|&(_, tet)| {
            let Failing { past, angle } = self.measured(tet);
            past || angle < margin * self.wish.min_dihedral
        });
        bad
    }

    fn measured(&self, tet: u32) -> Failing {
        let at = |v: u32| self.mesh.positions[v as usize];
        let measures = TetMeasures::of(self.mesh.corners(tet).map(at));
        Failing {
            past: measures.radius_edge_ratio > self.wish.radius_edge,
            angle: measures.min_dihedral.to_degrees(),
        }
    }

    /// How many tetrahedra are worth much work each.
    fn affordable(&self) -> usize {
        FEW.max((FEW_PART * self.mesh.len() as f64) as usize)
    }

    /// Moves vertices and replaces edges and faces for some tetrahedra; returns whether anything was done.
    fn work_on(&mut self, bad: &[Bad], look: ahead::Look) -> bool {
        let others = &mut self.tried.others;
        let count = ahead::work(&mut self.mesh, self.freedoms, bad, look, others);
        self.done.moved += count.moved;
        self.done.flipped += count.flipped;
        count != Count::default()
    }

    /// Rounds over the worst tetrahedra, as long as they are of use.
    fn rounds(&mut self) {
        let most = ((self.mesh.len() as f64 * self.wish.share) as usize).max(AT_LEAST);
        let mut last = f64::INFINITY;
        for round in 0..ROUNDS + MORE_ROUNDS {
            let mut bad = self.bad();
            let (now, many) = (bad.len() as f64, MANY * self.mesh.len() as f64);
            if round >= ROUNDS && (now < many || now > STUCK * last) {
                break;
            }
            last = now;
            bad.truncate(most);
            if !self.work_on(&bad, ahead::Look::Ahead) {
                break;
            }
        }
    }

    /// Gives what is still not as asked for new vertices, where that helps; returns whether it did.
    fn add_vertices(&mut self, margin: f64) -> bool {
        let before = self.done.inserted;
        let worst = self.failing(margin).into_iter().take(self.affordable());
        for (quality, tet) in worst {
            let mesh = &mut self.mesh;
            if !ahead::is_there(mesh, quality, tet) {
                continue;
            }
            let corners = mesh.corners(tet);
            let last = self.tried.vertices.insert(corners, mesh.now());
            if last.is_some_and(|time| corners.iter().all(|&v| !mesh.is_touched(v, time))) {
                continue;
            }
            if let Some(insertion) = insert::find(mesh, self.freedoms, tet) {
                insertion.apply(mesh);
                self.done.inserted += 1;
            }
        }
        self.done.inserted > before
    }

    /// From now on an element past the radius-edge bound is worse than one with the smallest angle asked for.
    fn put_bounds_first(&mut self, goal: Goal) {
        let past = self.failing(1.0).into_iter().map(|(_, tet)| tet);
        self.mesh
            .change_goal(goal.with_bound_before(self.wish.min_dihedral), past);
        self.tried = Tried::default();
    }

    /// Everything that helps against what is not as asked for, and nothing else.
    fn mend(&mut self, margin: f64) {
        for _ in 0..PASSES {
            let mut worst = self.failing(margin);
            worst.truncate(self.affordable());
            let changed = self.work_on(&worst, ahead::Look::OneByOne);
            if !self.add_vertices(margin) && !changed {
                break;
            }
        }
    }

    fn count_what_is_left(&mut self) {
        let left: Vec<Failing> = (self.bad().into_iter())
            .map(|(_, tet)| self.measured(tet))
            .collect();
        let low = |f: &&Failing| f.angle < self.wish.min_dihedral;
        self.done.left = left.len();
        self.done.past = left.iter().filter(|f| f.past).count();
        self.done.low = left.iter().filter(low).count();
        self.done.least = left.iter().fold(180.0, |least, f| f.angle.min(least));
    }
}
