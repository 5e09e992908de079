//! Cutting one flat patch, or the triangles of one that is not flat enough.

use super::local::Local;
use super::shared::Shared;
use crate::cell::Cell;
use crate::surface::Surface;
use geom::cdt::{Segment, triangulate};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::Triangle;

/// Labels of the parts of a patch.
const INSIDE: u32 = 1;
const OUT: u32 = 0;

/// Where to divide the surface.
#[derive(Clone, Copy)]
pub struct Cut {
    /// The face of the cell.
    pub face: usize,
    /// Bits of the faces that the surface has been cut at.
    pub done: u8,
    /// Whether any part of the surface beyond the face is kept.
    pub outer: bool,
    /// The face that everything is cut at right after, if any: nothing beyond it has to be right.
    pub next: Option<usize>,
}

/// The plane of a flat patch.
#[derive(Clone, Copy)]
struct Flat {
    normal: DVec3,
    /// Direction of the line in which it is cut.
    along: DVec3,
}

/// Whether a patch, of whose unit normal the part across a face is given, is as good as parallel to the face: it is not
/// cut as one polygon, whose coordinates would have lost half of their digits across the cut.
fn is_parallel(across: DVec3) -> bool {
    across.length() < f64::EPSILON.sqrt()
}

/// Cuts patches at a face.
pub struct Cutter<'a> {
    cell: &'a Cell,
    cut: Cut,
    crossings: FxHashMap<[u32; 2], u32>,
}

impl<'a> Cutter<'a> {
    /// For one cut.
    pub fn new(cell: &'a Cell, cut: Cut) -> Self {
        Self {
            cell,
            cut,
            crossings: FxHashMap::default(),
        }
    }

    /// Whether an edge in the face passes the line that divides it.
    pub fn passes_fold(&self, surface: &Surface, v: u32, w: u32) -> bool {
        let [p, q] = [v, w].map(|v| surface.at(v));
        self.cell.passes_fold(self.cut.face, p, q)
    }

    /// Whether faces with a point may be kept.
    fn keeps(&self, surface: &Surface, v: u32) -> bool {
        self.cut.outer || surface.classes[v as usize].of(self.cut.face) >= 0
    }

    /// The point at which an edge has to be divided, if it has to; of a body that is bent, the third corner of a triangle there tells
    /// where that is in the body.
    fn crossing(
        &mut self,
        surface: &mut Surface,
        [v, w]: [u32; 2],
        third: Option<u32>,
    ) -> Option<u32> {
        let (p, q) = (surface.at(v), surface.at(w));
        let opposite = p.1.of(self.cut.face) * q.1.of(self.cut.face) < 0;
        let passes = self.passes_fold(surface, v, w);
        if !opposite && !passes {
            return None;
        }
        let key = if v < w { [v, w] } else { [w, v] };
        if let Some(&x) = self.crossings.get(&key) {
            return Some(x);
        }
        let (point, class) = if opposite {
            self.cell.crossing(self.cut.face, p, q, self.cut.done)
        } else {
            self.cell.fold_crossing(self.cut.face, p, q, self.cut.done)
        };
        let point = third.map_or(point, |u| {
            let corners = [p.0, q.0, surface.points[u as usize]];
            self.cell.back_in_plane(point, class, corners)
        });
        let x = surface.add(point, class);
        self.crossings.insert(key, x);
        Some(x)
    }

    /// Cuts a flat patch as one polygon; `None` when its projection is not a clean figure.
    pub fn cut_flat(
        &mut self,
        surface: &mut Surface,
        part: &[Triangle],
        shared: &Shared,
    ) -> Option<Vec<Triangle>> {
        // What lies in one plane does not once it is bent back.
        if self.cell.is_straightened() {
            return None;
        }
        let normal = part
            .iter()
            .map(|f| {
                let [a, b, c] = geom::measure::corners(&surface.points, f);
                geom::measure::double_area_vector(a, b, c)
            })
            .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?
            .try_normalize()?;
        // Across: the exact signed distance from the plane. Along: the direction of the cut line.
        let inward = self.cell.faces[self.cut.face].inward;
        let across = inward - normal * inward.dot(normal);
        let along = across.cross(normal).try_normalize()?;
        if is_parallel(across) {
            return None;
        }
        let mut sides: FxHashMap<[u32; 2], [bool; 2]> = FxHashMap::default();
        for f in part {
            for k in 0..3 {
                let (v, w) = (f.vertices[k], f.vertices[(k + 1) % 3]);
                let (key, at) = if v < w { ([v, w], 0) } else { ([w, v], 1) };
                let uses = sides.entry(key).or_default();
                if std::mem::replace(&mut uses[at], true) {
                    return None;
                }
            }
        }
        let mut rim: Vec<([u32; 2], [bool; 2])> = sides
            .into_iter()
            .filter(|(key, [l, r])| l != r || shared.edges.contains(key))
            .collect();
        rim.sort_unstable_by_key(|(key, _)| *key);

        let mut bounds: Vec<Segment> = Vec::new();
        for ([v, w], [left, right]) in rim {
            let label = |inside: bool| Some(if inside { INSIDE } else { OUT });
            let mut put = |a: u32, b: u32| {
                bounds.push(Segment {
                    ends: [a, b],
                    left: label(left),
                    right: label(right),
                });
            };
            match self.crossing(surface, [v, w], None) {
                Some(x) => {
                    put(v, x);
                    put(x, w);
                }
                None => put(v, w),
            }
        }
        // What is beyond the plane needs no triangles: the line of the cut closes the rest.
        bounds.retain(|s| s.ends.iter().all(|&v| self.keeps(surface, v)));
        let corners = part.iter().flat_map(|f| f.vertices);
        let corners = corners.filter(|v| shared.points[*v as usize] && self.keeps(surface, *v));
        let corners: Vec<u32> = corners.collect();
        let plane = Flat { normal, along };
        let near = self.near_next(surface, &bounds, &corners, plane);
        let triangles = near
            .and_then(|(segments, corners)| self.fill(surface, &segments, &corners, plane))
            .or_else(|| self.fill(surface, &bounds, &corners, plane))?;
        let face = |vertices| Triangle {
            vertices,
            ..part[0]
        };
        Some(triangles.into_iter().map(face).collect())
    }

    /// Of what bounds a flat patch and of its other points, what matters once the patch has been cut at the next
    /// plane too: what does not lie beyond that plane, what crosses it, a line that joins the ends of that
    /// beyond it, and the points of this cut. `None` if nothing lies beyond, or the patch is parallel to the
    /// next plane.
    ///
    /// The line may cross what it should close. That is no clean figure then, and the whole has to be taken.
    fn near_next(
        &self,
        surface: &Surface,
        rim: &[Segment],
        corners: &[u32],
        plane: Flat,
    ) -> Option<(Vec<Segment>, Vec<u32>)> {
        let next = self.cut.next?;
        let inward = self.cell.faces[next].inward;
        let across = inward - plane.normal * inward.dot(plane.normal);
        let along = across.cross(plane.normal).try_normalize()?;
        let class = |v: u32| surface.classes[v as usize];
        let is_beyond = |v: &u32| class(*v).of(next) < 0;
        let all = || {
            rim.iter()
                .flat_map(|s| s.ends)
                .chain(corners.iter().copied())
        };
        if is_parallel(across) || !all().any(|v| is_beyond(&v)) {
            return None;
        }
        let stays = |s: &&Segment| !s.ends.iter().all(is_beyond);
        let mut kept: Vec<Segment> = rim.iter().filter(stays).copied().collect();
        let others = all().filter(|&v| !is_beyond(&v) || class(v).of(self.cut.face) == 0);
        let others: Vec<u32> = others.collect();
        let ends = kept
            .iter()
            .flat_map(|s| s.ends)
            .chain(others.iter().copied());
        let mut beyond: Vec<(f64, u32)> = ends
            .filter(is_beyond)
            .map(|v| (along.dot(surface.points[v as usize]), v))
            .collect();
        beyond.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        beyond.dedup();
        // Two points of this cut are joined by its own line.
        let is_cut = |v: u32| class(v).of(self.cut.face) == 0;
        let pairs = beyond.windows(2).map(|pair| [pair[0].1, pair[1].1]);
        let pairs = pairs.filter(|[v, w]| !(is_cut(*v) && is_cut(*w)));
        kept.extend(pairs.map(|ends| Segment {
            ends,
            left: None,
            right: Some(OUT),
        }));
        Some((kept, others))
    }

    /// Triangles between segments, whose ends are points of the surface, and further points; `None` when that is
    /// not a clean figure.
    fn fill(
        &mut self,
        surface: &mut Surface,
        rim: &[Segment],
        corners: &[u32],
        plane: Flat,
    ) -> Option<Vec<[u32; 3]>> {
        let mut local = Local::default();
        let own = |s: &Segment| Segment {
            ends: s.ends.map(|v| local.id(v)),
            ..*s
        };
        let mut segments: Vec<Segment> = rim.iter().map(own).collect();
        for &v in corners {
            local.id(v);
        }
        self.add_cut_line(surface, &mut local, &mut segments, plane.along);
        let points: Vec<[f64; 2]> = local
            .ids
            .iter()
            .map(|&v| {
                let (p, class) = surface.at(v);
                [
                    plane.along.dot(p),
                    self.cell.distance(self.cut.face, p, class),
                ]
            })
            .collect();
        let triangles = triangulate(&points, &segments, OUT).ok()?;
        let ids = |(t, _): ([u32; 3], u32)| t.map(|v| local.ids[v as usize]);
        Some(triangles.into_iter().map(ids).collect())
    }

    /// Joins the points on the cut plane one after the other, so that no triangle straddles it.
    fn add_cut_line(
        &mut self,
        surface: &mut Surface,
        local: &mut Local,
        segments: &mut Vec<Segment>,
        along: DVec3,
    ) {
        let mut on: Vec<(f64, u32)> = local
            .ids
            .iter()
            .filter(|&&v| surface.classes[v as usize].of(self.cut.face) == 0)
            .map(|&v| (along.dot(surface.points[v as usize]), v))
            .collect();
        on.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let present: FxHashSet<[u32; 2]> = segments
            .iter()
            .map(|s| {
                if s.ends[0] < s.ends[1] {
                    s.ends
                } else {
                    [s.ends[1], s.ends[0]]
                }
            })
            .collect();
        let open = |a: u32, b: u32| {
            let ends = if a < b { [a, b] } else { [b, a] };
            (!present.contains(&ends)).then_some(Segment {
                ends,
                left: None,
                right: None,
            })
        };
        for pair in on.windows(2) {
            let (v, w) = (pair[0].1, pair[1].1);
            let (a, b) = (local.id(v), local.id(w));
            if self.passes_fold(surface, v, w) {
                if let Some(x) = self.crossing(surface, [v, w], None) {
                    let x = local.id(x);
                    segments.extend(open(a, x));
                    segments.extend(open(x, b));
                }
            } else {
                segments.extend(open(a, b));
            }
        }
    }

    /// Cuts each triangle for itself.
    pub fn cut_singly(&mut self, surface: &mut Surface, part: &[Triangle]) -> Vec<Triangle> {
        let mut cut = Vec::with_capacity(2 * part.len());
        for f in part {
            let mut ring = Vec::with_capacity(6);
            for k in 0..3 {
                let [v, w, u] = [0, 1, 2].map(|i| f.vertices[(k + i) % 3]);
                ring.push(v);
                ring.extend(self.crossing(surface, [v, w], Some(u)));
            }
            self.divide(surface, &ring, f, &mut cut);
        }
        cut
    }

    /// Triangles of a ring of three to six points, of which the crossing points divide it.
    fn divide(&self, surface: &Surface, ring: &[u32], f: &Triangle, cut: &mut Vec<Triangle>) {
        let class = |v: u32| surface.classes[v as usize].of(self.cut.face);
        for sign in [1, -1] {
            let half: Vec<u32> = ring
                .iter()
                .copied()
                .filter(|&v| class(v) * sign >= 0)
                .collect();
            if half.iter().all(|&v| class(v) == 0) {
                continue;
            }
            // Convex: a fan from a point of the half that is not on the plane.
            let start = half.iter().position(|&v| class(v) != 0).unwrap_or(0);
            let at = |i: usize| half[(start + i) % half.len()];
            for i in 1..half.len().saturating_sub(1) {
                cut.push(Triangle {
                    vertices: [at(0), at(i), at(i + 1)],
                    ..*f
                });
            }
        }
    }
}
