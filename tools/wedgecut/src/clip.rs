//! Clipping the surface at a plane through the axis.
//!
//! A flat patch that the plane crosses is cut as one polygon and triangulated afresh, so the cut
//! depends on the shape and not on how its flat faces happened to be triangulated. Crossing points
//! are made once per edge and shared by all patches around it.

use crate::opening::{Class, Opening, Side};
use crate::surface::Surface;
use geom::cdt::{Segment, triangulate};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::Triangle;

/// Sine of the angle between a patch and a plane below which it is not cut as one polygon.
const LEAST_TILT: f64 = 1e-4;
const INSIDE: u32 = 1;
const OUT: u32 = 0;

/// Keeps the part of the surface on the wedge's side of a plane. Faces that lie in the plane go
/// too; the caps replace them. So do faces that the cut leaves in another side's plane, where it passes a
/// point on the axis or near it.
///
/// `split_at_axis`: also split what lies in the plane where it passes the axis, for wedges whose
/// two sides share one plane.
pub fn clip(surface: &mut Surface, opening: &Opening, side: Side, split_at_axis: bool) {
    let keeps = |classes: [Class; 3]| {
        let lies_in = |side| classes.iter().all(|c| c.of(side) == 0);
        classes.iter().all(|c| c.of(side) >= 0)
            && ![Side::A, Side::B, Side::Level].into_iter().any(lies_in)
    };
    let sides = opening.sides();
    let next = sides.iter().skip_while(|s| **s != side).nth(1);
    let cut = Cut {
        side,
        split_at_axis,
        outer: false,
        next: next.copied(),
    };
    divide(surface, opening, cut, keeps);
}

/// Divides the surface at the hub's plane, so that no face has points on both sides of it. Faces
/// that lie in the plane go; the caps replace them.
pub fn divide_at_hub(surface: &mut Surface, opening: &Opening) {
    for (p, class) in surface.points.iter_mut().zip(&mut surface.classes) {
        (*p, *class) = opening.classify_hub(*p, *class);
    }
    let keeps = |classes: [Class; 3]| classes.iter().any(|c| c.hub != 0);
    let cut = Cut {
        side: Side::Hub,
        split_at_axis: false,
        outer: true,
        next: None,
    };
    divide(surface, opening, cut, keeps);
}

/// Where to divide the surface.
#[derive(Clone, Copy)]
struct Cut {
    /// The plane.
    side: Side,
    /// Whether what lies in the plane is divided where it passes the axis.
    split_at_axis: bool,
    /// Whether any face beyond the plane is kept.
    outer: bool,
    /// The plane that everything is cut at right after, if any: nothing beyond it has to be right.
    next: Option<Side>,
}

/// Divides all patches that cross a plane, and keeps the faces whose points have the right classes.
fn divide(surface: &mut Surface, opening: &Opening, cut: Cut, wanted: impl Fn([Class; 3]) -> bool) {
    let mut members: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    let side = cut.side;
    let mut cutter = Cutter {
        opening,
        side,
        split_at_axis: cut.split_at_axis,
        outer: cut.outer,
        next: cut.next,
        crossings: FxHashMap::default(),
    };
    let faces = std::mem::take(&mut surface.faces);
    let patches = std::mem::take(&mut surface.patches);
    let count = patches.iter().map(|p| p + 1).max().unwrap_or(0) as usize;
    // Per patch: whether it has points beyond, and on the wedge's side, and crosses the axis.
    let mut reach = vec![(false, false, false); count];
    for (face, &patch) in faces.iter().zip(&patches) {
        let r = &mut reach[patch as usize];
        for k in 0..3 {
            let (v, w) = (face.vertices[k], face.vertices[(k + 1) % 3]);
            let class = surface.classes[v as usize].of(side);
            r.0 |= class < 0;
            r.1 |= class > 0;
            r.2 |= cutter.passes_axis(surface, v, w);
        }
    }
    let keeps = |surface: &Surface, face: &Triangle| {
        wanted(face.vertices.map(|v| surface.classes[v as usize]))
    };
    for (i, (face, &patch)) in faces.iter().zip(&patches).enumerate() {
        match reach[patch as usize] {
            (true, true, _) | (_, true, true) => members.entry(patch).or_default().push(i as u32),
            _ if keeps(surface, face) => {
                surface.faces.push(*face);
                surface.patches.push(patch);
            }
            _ => {}
        }
    }
    let shared = Shared::new(&faces, &patches, surface.points.len());
    let mut crossed: Vec<_> = members.into_iter().collect();
    crossed.sort_unstable_by_key(|(patch, _)| *patch);
    for (patch, members) in crossed {
        let part: Vec<Triangle> = members.iter().map(|&i| faces[i as usize]).collect();
        let cut = cutter
            .cut_flat(surface, &part, &shared)
            .unwrap_or_else(|| cutter.cut_singly(surface, &part));
        for face in cut {
            if keeps(surface, &face) {
                surface.faces.push(face);
                surface.patches.push(patch);
            }
        }
    }
}

/// What patches have in common.
struct Shared {
    /// For each point, whether it is one of more than one patch.
    points: Vec<bool>,
    /// Edges of more than one patch, lower point first.
    edges: FxHashSet<[u32; 2]>,
}

impl Shared {
    fn new(faces: &[Triangle], patches: &[u32], count: usize) -> Self {
        let mut first = vec![u32::MAX; count];
        let mut points = vec![false; count];
        for (face, &patch) in faces.iter().zip(patches) {
            for v in face.vertices.map(|v| v as usize) {
                if first[v] == u32::MAX {
                    first[v] = patch;
                }
                points[v] |= first[v] != patch;
            }
        }
        let mut first: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        let mut edges = FxHashSet::default();
        for (face, &patch) in faces.iter().zip(patches) {
            for k in 0..3 {
                let (v, w) = (face.vertices[k], face.vertices[(k + 1) % 3]);
                let key = if v < w { [v, w] } else { [w, v] };
                let both = points[v as usize] && points[w as usize];
                if both && *first.entry(key).or_insert(patch) != patch {
                    edges.insert(key);
                }
            }
        }
        Self { points, edges }
    }
}

/// The plane of a flat patch.
#[derive(Clone, Copy)]
struct Flat {
    normal: DVec3,
    /// Direction of the line in which it is cut.
    along: DVec3,
}

struct Cutter<'a> {
    opening: &'a Opening,
    side: Side,
    split_at_axis: bool,
    outer: bool,
    next: Option<Side>,
    crossings: FxHashMap<[u32; 2], u32>,
}

impl Cutter<'_> {
    fn passes_axis(&self, surface: &Surface, v: u32, w: u32) -> bool {
        let on = |v: u32| {
            let class = surface.classes[v as usize];
            class.of(self.side) == 0 && !class.is_axis()
        };
        let x = |v: u32| surface.points[v as usize].x;
        self.split_at_axis && on(v) && on(w) && (x(v) > 0.0) != (x(w) > 0.0)
    }

    /// Whether faces with a point may be kept.
    fn keeps(&self, surface: &Surface, v: u32) -> bool {
        self.outer || surface.classes[v as usize].of(self.side) >= 0
    }

    /// The point at which an edge has to be divided, if it has to.
    fn crossing(&mut self, surface: &mut Surface, v: u32, w: u32) -> Option<u32> {
        let (p, q) = (surface.at(v), surface.at(w));
        let opposite = p.1.of(self.side) * q.1.of(self.side) < 0;
        let passes = self.passes_axis(surface, v, w);
        if !opposite && !passes {
            return None;
        }
        let key = if v < w { [v, w] } else { [w, v] };
        if let Some(&x) = self.crossings.get(&key) {
            return Some(x);
        }
        let (point, class) = if opposite {
            self.opening.crossing(self.side, p, q)
        } else {
            self.opening.axis_crossing(p, q)
        };
        let x = surface.add(point, class);
        self.crossings.insert(key, x);
        Some(x)
    }

    /// Cuts a flat patch as one polygon; `None` when its projection is not a clean figure.
    fn cut_flat(
        &mut self,
        surface: &mut Surface,
        part: &[Triangle],
        shared: &Shared,
    ) -> Option<Vec<Triangle>> {
        let normal = part
            .iter()
            .map(|f| {
                let [a, b, c] = geom::measure::corners(&surface.points, f);
                geom::measure::double_area_vector(a, b, c)
            })
            .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?
            .try_normalize()?;
        // Across: the exact signed distance from the plane. Along: the direction of the cut line.
        let inward = self.opening.inward(self.side);
        let across = inward - normal * inward.dot(normal);
        let along = across.cross(normal).try_normalize()?;
        if across.length() < LEAST_TILT {
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
            match self.crossing(surface, v, w) {
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
        let next = self.next?;
        let inward = self.opening.inward(next);
        let across = inward - plane.normal * inward.dot(plane.normal);
        let along = across.cross(plane.normal).try_normalize()?;
        let class = |v: u32| surface.classes[v as usize];
        let is_beyond = |v: &u32| class(*v).of(next) < 0;
        let all = || {
            rim.iter()
                .flat_map(|s| s.ends)
                .chain(corners.iter().copied())
        };
        if across.length() < LEAST_TILT || !all().any(|v| is_beyond(&v)) {
            return None;
        }
        let stays = |s: &&Segment| !s.ends.iter().all(is_beyond);
        let mut kept: Vec<Segment> = rim.iter().filter(stays).copied().collect();
        let others = all().filter(|&v| !is_beyond(&v) || class(v).of(self.side) == 0);
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
        let is_cut = |v: u32| class(v).of(self.side) == 0;
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
                    self.opening.distance(self.side, p, class),
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
            .filter(|&&v| surface.classes[v as usize].of(self.side) == 0)
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
            if self.passes_axis(surface, v, w) {
                if let Some(x) = self.crossing(surface, v, w) {
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
    fn cut_singly(&mut self, surface: &mut Surface, part: &[Triangle]) -> Vec<Triangle> {
        let mut cut = Vec::with_capacity(2 * part.len());
        for f in part {
            let mut ring = Vec::with_capacity(6);
            for k in 0..3 {
                let (v, w) = (f.vertices[k], f.vertices[(k + 1) % 3]);
                ring.push(v);
                ring.extend(self.crossing(surface, v, w));
            }
            self.divide(surface, &ring, f, &mut cut);
        }
        cut
    }

    /// Triangles of a ring of three to six points, of which the crossing points divide it.
    fn divide(&self, surface: &Surface, ring: &[u32], f: &Triangle, cut: &mut Vec<Triangle>) {
        let class = |v: u32| surface.classes[v as usize].of(self.side);
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

/// Numbers the points of one patch 0, 1, ... in order of appearance.
#[derive(Default)]
struct Local {
    ids: Vec<u32>,
    index: FxHashMap<u32, u32>,
}

impl Local {
    fn id(&mut self, v: u32) -> u32 {
        *self.index.entry(v).or_insert_with(|| {
            self.ids.push(v);
            self.ids.len() as u32 - 1
        })
    }
}
