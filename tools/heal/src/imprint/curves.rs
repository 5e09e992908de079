//! The smooth surfaces that facets stand for, and what touches those.
//!
//! Two solids that touch along a curve have facets of their own there, and vertices that lie on the curve. Seen from a
//! facet, the surface that it stands for is a quadratic patch through its corners, with the mean normals of the facets
//! around each of them: a vertex of the other solid that is where the patch is touches it, however far that is from the
//! facet itself. An air gap is no contact, even where it is narrower than the facets are off the patch.

use super::faces::Complex;
use super::near::{Spot, spot};
use geom::edges::Edges;
use geom::measure::double_area_vector;
use geom::smooth::{SMOOTH, SMOOTH_COSINE};
use glam::DVec3;

/// The smooth surface at a facet.
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    corners: [DVec3; 3],
    /// Unit normal of the facet.
    pub normal: DVec3,
    /// Unit normals of the surface at the corners: the mean ones of the facets around them.
    pub means: [DVec3; 3],
    /// Of the edge that begins at each corner: eight times the height of the patch over its middle.
    bends: [f64; 3],
    /// Whether the surface goes on smoothly beyond the edge that begins at each corner.
    pub smooth: [bool; 3],
    /// The largest height of the patch over the middle of an edge.
    pub sagitta: f64,
}

/// The smooth surfaces of all facets.
pub struct Curves {
    /// How far from the surface what touches it may be; `None` for what facets explain.
    gap: Option<f64>,
    /// Of each triangle.
    pub patches: Vec<Patch>,
    /// Of each vertex: the other ends of sharp edges.
    pub sharp: Vec<Vec<u32>>,
    /// Of each vertex: whether at least three flat faces of a solid meet there.
    corner: Vec<bool>,
}

impl Curves {
    /// The surfaces behind the facets of solids.
    pub fn new(complex: &Complex, edges: &Edges, solid: &[u32], gap: Option<f64>) -> Self {
        let cosine = SMOOTH_COSINE;
        let normals: Vec<DVec3> = (0..complex.triangles.len() as u32)
            .map(|t| {
                let [a, b, c] = complex.corners(t);
                double_area_vector(a, b, c).normalize_or_zero()
            })
            .collect();
        let around = flat_parts(complex, &normals, solid);
        let mut patches: Vec<Patch> = (0..complex.triangles.len())
            .map(|t| patch(complex, t, normals[t], solid[t], &around))
            .collect();
        let mut sharp = vec![Vec::new(); complex.points.len()];
        for e in 0..edges.len() {
            let around = edges.around(e);
            for u in around {
                let own = u.triangle as usize;
                let mut others = around.iter().map(|w| w.triangle as usize);
                let smooth = others.any(|w| {
                    w != own && solid[w] == solid[own] && normals[w].dot(normals[own]) >= cosine
                });
                patches[own].smooth[u.corner as usize] = smooth;
                if !smooth {
                    let [a, b] = edges.ends[e];
                    sharp[a as usize].push(b);
                    sharp[b as usize].push(a);
                }
            }
        }
        for list in &mut sharp {
            list.sort_unstable();
            list.dedup();
        }
        Self {
            gap,
            patches,
            sharp,
            corner: around.iter().map(|parts| is_corner(parts)).collect(),
        }
    }

    /// Whether a vertex is a corner of flat faces of a solid: others are inside of one, or on the straight edge between two.
    pub fn is_corner(&self, v: u32) -> bool {
        self.corner[v as usize]
    }

    /// How much of a feature a vertex is: 0 in a smooth surface, 1 on a sharp edge that goes on, 2 at a corner.
    pub fn rank(&self, v: u32, points: &[DVec3]) -> u8 {
        match self.sharp[v as usize][..] {
            [] => 0,
            [a, b] => {
                let at = |v: u32| points[v as usize];
                let turn = (at(v) - at(a)).angle_between(at(b) - at(v));
                if turn <= SMOOTH { 1 } else { 2 }
            }
            _ => 2,
        }
    }

    /// Whether the second vertex, projected onto the plane of a facet with this normal, is on the line of a sharp edge
    /// at the first one.
    fn on_sharp(&self, [v, other]: [u32; 2], normal: DVec3, points: &[DVec3], within: f64) -> bool {
        let [from, place] = [v, other].map(|v| points[v as usize]);
        self.sharp[v as usize].iter().any(|&w| {
            let along = (points[w as usize] - from).reject_from_normalized(normal);
            let off = (place - from).reject_from_normalized(normal);
            off.reject_from(along).length() <= within
        })
    }
}

/// What one flat face of a solid has around a vertex.
struct FlatPart {
    face: u32,
    solid: u32,
    /// Unit normal of one of its triangles.
    normal: DVec3,
    /// Normals of its triangles by their angles at the vertex, so that they do not depend on how faces are cut into
    /// triangles.
    sum: DVec3,
}

/// Of each vertex: the flat faces around it, a fan of triangles in one plane being one of them.
fn flat_parts(complex: &Complex, normals: &[DVec3], solid: &[u32]) -> Vec<Vec<FlatPart>> {
    let mut around: Vec<Vec<FlatPart>> = complex.points.iter().map(|_| Vec::new()).collect();
    for (t, corners) in complex.triangles.iter().enumerate() {
        let places = complex.corners(t as u32);
        let (face, solid, normal) = (complex.face[t], solid[t], normals[t]);
        for (i, &v) in corners.iter().enumerate() {
            let [a, b] = [1, 2].map(|k| places[(i + k) % 3] - places[i]);
            let weighted = normal * a.angle_between(b);
            let parts = &mut around[v as usize];
            match parts.iter_mut().find(|p| p.face == face) {
                Some(part) => part.sum += weighted,
                None => parts.push(FlatPart {
                    face,
                    solid,
                    normal,
                    sum: weighted,
                }),
            }
        }
    }
    around
}

fn is_corner(parts: &[FlatPart]) -> bool {
    let faces = |solid: u32| parts.iter().filter(|p| p.solid == solid).count();
    parts.iter().any(|p| faces(p.solid) > 2)
}

fn patch(
    complex: &Complex,
    t: usize,
    normal: DVec3,
    solid: u32,
    around: &[Vec<FlatPart>],
) -> Patch {
    let corners = complex.corners(t as u32);
    let means = complex.triangles[t].map(|v| {
        let smooth = (around[v as usize].iter())
            .filter(|part| part.solid == solid && part.normal.dot(normal) >= SMOOTH_COSINE);
        smooth
            .map(|part| part.sum)
            .sum::<DVec3>()
            .normalize_or_zero()
    });
    let bends = [0, 1, 2].map(|i| {
        let j = (i + 1) % 3;
        bend([corners[i], corners[j]], [means[i], means[j]])
    });
    Patch {
        corners,
        normal,
        means,
        bends,
        smooth: [false; 3],
        sagitta: bends.into_iter().map(f64::abs).fold(0.0, f64::max) / 8.0,
    }
}

/// Eight times the height of a surface over the middle of an edge, by the unit normals at its ends.
pub fn bend([from, to]: [DVec3; 2], [first, second]: [DVec3; 2]) -> f64 {
    let along = to - from;
    let [back, ahead] = [-first.dot(along), second.dot(along)];
    // Where the surface ends, the mean normal is the facet's own.
    2.0 * if back.abs() > ahead.abs() {
        back
    } else {
        ahead
    }
}

impl Patch {
    /// Height of the patch over the point of an edge that is so far along it.
    pub fn over_edge(&self, corner: usize, along: f64) -> f64 {
        0.5 * along * (1.0 - along) * self.bends[corner]
    }

    /// Height of the patch over a point of the facet's plane.
    pub fn over(&self, p: DVec3) -> f64 {
        let [a, b, c] = self.corners;
        let whole = (b - a).cross(c - a).dot(self.normal);
        let part = |u: DVec3, v: DVec3| (u - p).cross(v - p).dot(self.normal) / whole;
        let weights = [part(b, c), part(c, a), part(a, b)].map(|w| w.clamp(0.0, 1.0));
        let over = (0..3).map(|i| weights[i] * weights[(i + 1) % 3] * self.bends[i]);
        0.5 * over.sum::<f64>()
    }

    /// Height of a point over the facet's plane.
    pub fn height(&self, p: DVec3) -> f64 {
        (p - self.corners[0]).dot(self.normal)
    }

    /// Whether the face ends at a corner.
    fn ends_at(&self, corner: usize) -> bool {
        !(self.smooth[corner] && self.smooth[(corner + 2) % 3])
    }

    /// Whether two facets look the same way.
    fn continues(&self, other: &Self) -> bool {
        self.normal.dot(other.normal) >= SMOOTH_COSINE
    }

    /// Whether two facets look at each other.
    pub fn faces(&self, other: &Self) -> bool {
        self.normal.dot(other.normal) <= -SMOOTH_COSINE
    }
}

impl Curves {
    /// How far a point may be from the surface behind a facet to touch it: that is as uncertain as half of its height
    /// over the facet, and what is flat is certain.
    pub fn uncertain(&self, t: u32) -> f64 {
        self.gap.unwrap_or(0.5 * self.patches[t as usize].sagitta)
    }

    /// How far from a facet's box what touches it may be.
    pub fn reach(&self, t: u32) -> f64 {
        self.patches[t as usize].sagitta + self.uncertain(t)
    }

    /// Where on the facet `t` a corner of another solid's facet `of` lies, if it touches the surface behind `t`: that is as
    /// uncertain as the coarser one of both, so that corners of either touch the other one.
    pub fn spot(
        &self,
        (of, corner): (u32, usize),
        t: u32,
        complex: &Complex,
        equal: f64,
    ) -> Option<Spot> {
        let v = complex.triangles[of as usize][corner];
        let [own, patch] = [of, t].map(|t| &self.patches[t as usize]);
        let p = complex.points[v as usize];
        let height = patch.height(p);
        let beside = own.continues(patch);
        let looks = beside || own.faces(patch);
        let within = self.uncertain(t).max(self.uncertain(of)).max(equal);
        if self.reach(t) <= equal || !looks || height.abs() > patch.sagitta + within {
            return None;
        }
        let flat = p - patch.normal * height;
        let at = spot(flat, &patch.corners, self.uncertain(t).max(equal))?;
        if (height - patch.over(flat)).abs() > within {
            return None;
        }
        let narrow = spot(flat, &patch.corners, equal);
        if beside {
            // Two solids end side by side on one surface: they touch along the edges where they end.
            return narrow.filter(|at| match *at {
                Spot::Corner(i) => patch.ends_at(i),
                Spot::Edge(i, _) => !patch.smooth[i],
                Spot::Inside => false,
            });
        }
        if let Spot::Corner(i) = at
            && self.may_join(
                [v, complex.triangles[t as usize][i]],
                patch.normal,
                &complex.points,
                equal,
            )
        {
            return Some(at);
        }
        // Sharp edges are where they are.
        match (at, narrow) {
            (_, Some(narrow @ (Spot::Corner(_) | Spot::Edge(..)))) => Some(narrow),
            (Spot::Edge(i, _), _) if patch.smooth[i] => Some(at),
            (_, narrow) => narrow,
        }
    }

    /// Whether a vertex may be joined to a corner of a facet with this normal: the corner, or the vertex, is moved along
    /// its own sharp edges only.
    fn may_join(
        &self,
        [v, corner]: [u32; 2],
        normal: DVec3,
        points: &[DVec3],
        within: f64,
    ) -> bool {
        let on = |v: u32, other: u32| self.on_sharp([v, other], normal, points, within);
        match [v, corner].map(|v| self.rank(v, points)) {
            [0, _] | [_, 0] => true,
            [2, 2] => false,
            [1, 1] => on(v, corner) && on(corner, v),
            [1, _] => on(v, corner),
            _ => on(corner, v),
        }
    }

    /// How far the surface behind an edge is over a point of it, along the normal of the facet that the edge belongs to
    /// and that looks at the facet `t`, and how uncertain that is; `None` where no such facet is at the edge.
    pub fn edge_over(&self, e: u32, along: f64, t: u32, edges: &Edges) -> Option<(f64, f64)> {
        let patch = &self.patches[t as usize];
        edges.around(e as usize).iter().find_map(|u| {
            let own = &self.patches[u.triangle as usize];
            let along = if u.forward { along } else { 1.0 - along };
            own.faces(patch).then(|| {
                (
                    own.over_edge(u.corner as usize, along),
                    self.uncertain(u.triangle),
                )
            })
        })
    }
}
