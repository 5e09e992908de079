//! A surface that is changed place by place, inside an envelope.

mod apply;
mod change;
mod fit;
mod images;
mod orbits;
mod sharp;
mod triangle;

pub use change::{Change, Sample};
pub use images::Images;
pub use orbits::Orbit;
pub use triangle::quality;

use crate::input::{Rules, Surface};
use crate::shape::{Allowance, Curves, Envelope, Patches};
use geom::flat::Plane;
use geom::measure::{double_area_vector, triangle_area};
use geom::sets::DisjointSets;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// No vertex.
pub const NONE: u32 = u32::MAX;

/// A surface that is changed place by place.
pub struct Mesh<'a> {
    /// What must stay.
    pub rules: Rules<'a>,
    /// What it stays inside of.
    pub envelope: &'a Envelope,
    /// The plane of each patch that is a flat face.
    pub planes: &'a [Option<Plane>],
    /// How far off it triangles of such a patch may be, model units.
    pub off: &'a [f64],
    /// Positions.
    pub points: Vec<DVec3>,
    /// The planes and lines that each vertex stays on.
    pub bound: Vec<u32>,
    /// Whether each vertex stays where it is.
    pub fixed: Vec<bool>,
    /// Whether each vertex and triangles between such vertices stay as they are.
    pub held: Vec<bool>,
    /// What is the image of what.
    pub images: Images,
    /// Length of edges wanted at each vertex.
    pub size: Vec<f64>,
    /// Width of the input's facets at each vertex.
    pub width: Vec<f64>,
    /// How far the surface may move at each vertex: less than the deviation where something else is as near.
    near: Vec<f64>,
    /// Vertex ids; [`NONE`] three times for triangles that are gone.
    pub triangles: Vec<[u32; 3]>,
    /// Patch of each triangle.
    pub patch: Vec<u32>,
    around: Vec<Vec<u32>>,
    /// Of each patch, whether it is the largest of its label, and stays so that the label does.
    pub keeps: Vec<bool>,
    /// The planes and lines that all of each patch is on.
    pub planes_of: Vec<u32>,
    /// Whether features may be joined that are detail.
    pub joins: bool,
    /// How often that was done.
    pub joined: usize,
    /// Of each curve, whether another one or a corner was joined to it, so that it is as far from where it was as the deviation.
    pub loose: Vec<bool>,
    /// Curve of each feature edge, lower vertex first.
    features: FxHashMap<[u32; 2], u32>,
    /// Points of the input that each triangle is near to.
    samples: Vec<Vec<Sample>>,
    /// Points of the input's curves that each feature edge is near to.
    on_chords: FxHashMap<[u32; 2], Vec<Sample>>,
}

impl<'a> Mesh<'a> {
    /// The surface as it is given.
    pub fn new(
        surface: &Surface,
        rules: Rules<'a>,
        (patches, curves): (&'a Patches, &Curves),
        (envelope, allowance): (&'a Envelope, &Allowance),
    ) -> Self {
        let mut around = vec![Vec::new(); surface.points.len()];
        for (t, corners) in surface.triangles.iter().enumerate() {
            corners
                .iter()
                .for_each(|&v| around[v as usize].push(t as u32));
        }
        let vertices = 0..surface.points.len();
        let images = Images::new(surface, rules.links, patches);
        let ends = curves.ends.iter().copied();
        let mut mesh = Self {
            rules,
            envelope,
            planes: &patches.planes,
            off: &patches.off,
            points: surface.points.clone(),
            bound: rules.bound.to_vec(),
            fixed: vertices
                .map(|v| rules.held[v] || curves.corner[v] || images.is_fixed(v as u32))
                .collect(),
            images,
            held: rules.held.to_vec(),
            size: allowance.size.clone(),
            width: allowance.width.clone(),
            near: (0..surface.points.len())
                .map(|v| rules.deviation_at(v))
                .collect(),
            triangles: surface.triangles.clone(),
            patch: patches.of.clone(),
            around,
            keeps: largest(surface, patches),
            planes_of: planes_of(surface, rules.bound, patches),
            joins: false,
            joined: 0,
            loose: vec![false; curves.count],
            features: ends.zip(curves.of.iter().copied()).collect(),
            samples: vec![Vec::new(); surface.triangles.len()],
            on_chords: FxHashMap::default(),
        };
        mesh.take_samples(surface, curves);
        mesh
    }

    /// Notes the points of the input where the surface is near to them now.
    fn take_samples(&mut self, surface: &Surface, curves: &Curves) {
        let borders = self.borders_of_faces(curves);
        let reach_at = |t: u32| {
            let border = borders[self.patch[t as usize] as usize];
            self.envelope.reach(t).max(border)
        };
        let reaches: Vec<f64> = (0..self.triangles.len() as u32).map(reach_at).collect();
        for v in 0..surface.points.len() {
            let point = surface.points[v];
            let mut seen: Vec<(u32, u32, f64)> = Vec::new();
            for &t in &self.around[v] {
                let (patch, reach) = (self.patch[t as usize], reaches[t as usize]);
                match seen.iter_mut().find(|s| s.0 == patch) {
                    Some(known) => known.2 = known.2.max(reach),
                    None => seen.push((patch, t, reach)),
                }
            }
            // On borders of patches, curves are what counts.
            if let [(_, t, reach)] = seen[..]
                && curves.degree[v] == 0
            {
                self.samples[t as usize].push(Sample { point, reach });
            }
        }
        // Of triangles that are needles, ends may be near to what is far from the middle.
        for [a, b] in self.edges() {
            if let [t, u] = self.at_edge(a, b)[..]
                && self.curve(a, b).is_none()
            {
                let reach = reaches[t as usize].max(reaches[u as usize]);
                let point = 0.5 * (surface.points[a as usize] + surface.points[b as usize]);
                self.samples[t as usize].push(Sample { point, reach });
            }
        }
        for (i, &ends) in (0..).zip(&curves.ends) {
            let reach = self.envelope.reach_of_edge(i);
            let samples = ends.map(|v| Sample {
                point: surface.points[v as usize],
                reach,
            });
            self.on_chords.insert(ends, samples.to_vec());
        }
    }

    /// How far the border of each flat face may move, 0 for other patches. A flat face ends where its border does, so that points
    /// of it beside a border that moves are as far from what is left; a fine drawing has many of them there.
    fn borders_of_faces(&self, curves: &Curves) -> Vec<f64> {
        let mut borders = vec![0.0_f64; self.planes.len()];
        for (i, &[a, b]) in (0..).zip(&curves.ends) {
            let reach = self.envelope.reach_of_edge(i);
            for t in self.at_edge(a, b) {
                let patch = self.patch[t as usize] as usize;
                if self.planes[patch].is_some() {
                    borders[patch] = borders[patch].max(reach);
                }
            }
        }
        borders
    }

    /// Points of the input that a triangle is near to.
    pub fn samples(&self, t: u32) -> &[Sample] {
        &self.samples[t as usize]
    }

    /// The triangles around a vertex.
    pub fn around(&self, v: u32) -> &[u32] {
        &self.around[v as usize]
    }

    /// The triangles at an edge.
    pub fn at_edge(&self, a: u32, b: u32) -> Vec<u32> {
        let around = self.around[a as usize].iter().copied();
        around
            .filter(|&t| self.triangles[t as usize].contains(&b))
            .collect()
    }

    /// The curve of an edge, if it is a feature.
    pub fn curve(&self, a: u32, b: u32) -> Option<u32> {
        self.features.get(&[a.min(b), a.max(b)]).copied()
    }

    /// The vertices at the other ends of the edges of a vertex, increasing.
    pub fn neighbours(&self, v: u32) -> Vec<u32> {
        let around = self.around[v as usize].iter();
        let mut all: Vec<u32> = around.flat_map(|&t| self.triangles[t as usize]).collect();
        all.sort_unstable();
        all.dedup();
        all.retain(|&w| w != v);
        all
    }

    /// The neighbours along feature edges, each with the curve.
    pub fn along(&self, v: u32) -> Vec<(u32, u32)> {
        let all = self.neighbours(v).into_iter();
        all.filter_map(|w| Some((w, self.curve(v, w)?))).collect()
    }

    /// Whether one curve passes a vertex, and none ends there.
    pub fn is_passed(&self, v: u32) -> bool {
        matches!(self.along(v)[..], [(_, one), (_, other)] if one == other)
    }

    /// Length of an edge.
    pub fn length(&self, [a, b]: [u32; 2]) -> f64 {
        self.points[a as usize].distance(self.points[b as usize])
    }

    /// Length of an edge over that wanted there.
    pub fn relative(&self, [a, b]: [u32; 2]) -> f64 {
        2.0 * self.length([a, b]) / (self.size[a as usize] + self.size[b as usize])
    }

    /// Length of an edge over the width of the input's facets there.
    pub fn relative_to_drawn(&self, [a, b]: [u32; 2]) -> f64 {
        2.0 * self.length([a, b]) / (self.width[a as usize] + self.width[b as usize])
    }

    /// Quality of a triangle, from 0 to 1; 1 in flat faces, where only borders count.
    pub fn quality_of(&self, [a, b, c]: [u32; 3], patch: u32) -> f64 {
        match self.planes[patch as usize] {
            Some(_) => 1.0,
            None => self.shape_of([a, b, c]),
        }
    }

    /// Quality of a triangle wherever it is, from 0 to 1.
    pub fn shape_of(&self, corners: [u32; 3]) -> f64 {
        quality(corners.map(|v| self.points[v as usize]))
    }

    /// The worst quality of triangles.
    pub fn worst(&self, triangles: &[u32]) -> f64 {
        let each = triangles
            .iter()
            .map(|&t| self.quality_of(self.triangles[t as usize], self.patch[t as usize]));
        each.fold(1.0, f64::min)
    }

    /// The worst quality of triangles wherever they are.
    pub fn worst_shape(&self, triangles: &[u32]) -> f64 {
        let each = triangles.iter();
        let each = each.map(|&t| self.shape_of(self.triangles[t as usize]));
        each.fold(1.0, f64::min)
    }

    /// Facets of curved patches: sets of triangles that are coplanar with the next one.
    pub fn facets(&self) -> Vec<u32> {
        let mut sets = DisjointSets::new(self.triangles.len());
        for [a, b] in self.edges() {
            let [s, t] = self.at_edge(a, b)[..] else {
                continue;
            };
            if self.patch[s as usize] == self.patch[t as usize] {
                let [p, q] =
                    [s, t].map(|t| self.triangles[t as usize].map(|v| self.points[v as usize]));
                if Plane::of(p).off(q) <= self.rules.flat || Plane::of(q).off(p) <= self.rules.flat
                {
                    sets.join(s, t);
                }
            }
        }
        (0..self.triangles.len() as u32)
            .map(|t| sets.find(t))
            .collect()
    }

    /// How far off a surface gets where it bridges a fold, over the distance to the fold: the sine of the angle that triangles there turn by,
    /// or 1 at features and where they turn by more than a right angle.
    pub fn fold(&self, [a, b]: [u32; 2]) -> f64 {
        let [s, t] = self.at_edge(a, b)[..] else {
            return 1.0;
        };
        let [p, q] = [s, t].map(|t| {
            let [a, b, c] = self.triangles[t as usize].map(|v| self.points[v as usize]);
            double_area_vector(a, b, c).normalize_or_zero()
        });
        match self.curve(a, b).is_none() && p.dot(q) > 0.0 {
            true => p.cross(q).length(),
            false => 1.0,
        }
    }

    /// Whether a triangle is there.
    pub fn is_there(&self, t: u32) -> bool {
        self.triangles[t as usize][0] != NONE
    }

    /// All edges, lower vertex first, increasing.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let there = self.triangles.iter().filter(|t| t[0] != NONE);
        let mut edges: Vec<[u32; 2]> = there
            .flat_map(|t| [0, 1, 2].map(|i| [t[i], t[(i + 1) % 3]]))
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Edges by what `wanted` makes of them, least first.
    pub fn edges_by(&self, wanted: impl Fn([u32; 2]) -> Option<f64>) -> Vec<[u32; 2]> {
        let edges = self.edges().into_iter();
        let mut found: Vec<(f64, [u32; 2])> = edges.filter_map(|e| Some((wanted(e)?, e))).collect();
        found.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        found.into_iter().map(|f| f.1).collect()
    }

    /// How far the surface may move at all of these vertices.
    pub fn deviation_at(&self, vertices: &[u32]) -> f64 {
        let each = vertices.iter().map(|&v| self.near[v as usize]);
        each.fold(self.rules.deviation, f64::min)
    }

    /// Lets the surface move no farther at a vertex than at others.
    pub fn keep_near(&mut self, v: u32, others: &[u32]) {
        self.near[v as usize] = self.deviation_at(others).min(self.near[v as usize]);
    }

    /// Adds a vertex near which the surface may move by so much.
    pub fn add(&mut self, p: DVec3, (bound, size): (u32, f64), near: f64) -> u32 {
        self.points.push(p);
        self.bound.push(bound);
        self.fixed.push(false);
        self.held.push(false);
        self.size.push(size);
        self.width.push(size);
        self.near.push(near);
        self.around.push(Vec::new());
        self.points.len() as u32 - 1
    }

    /// Takes back the vertex that was added last.
    pub fn drop_last(&mut self) {
        self.points.pop();
        self.bound.pop();
        self.fixed.pop();
        self.held.pop();
        self.size.pop();
        self.width.pop();
        self.near.pop();
        self.around.pop();
    }
}

/// Of each patch, the planes and lines that all of its vertices are on.
fn planes_of(surface: &Surface, bound: &[u32], patches: &Patches) -> Vec<u32> {
    let mut planes = vec![u32::MAX; patches.planes.len()];
    for (corners, &patch) in surface.triangles.iter().zip(&patches.of) {
        for &v in corners {
            planes[patch as usize] &= bound[v as usize];
        }
    }
    planes
}

/// Of each patch, whether it has the largest area of those of its label.
fn largest(surface: &Surface, patches: &Patches) -> Vec<bool> {
    let mut area = vec![0.0_f64; patches.planes.len()];
    for (t, &patch) in (0..).zip(&patches.of) {
        let [a, b, c] = surface.corners(t);
        area[patch as usize] += triangle_area(a, b, c);
    }
    let mut best: FxHashMap<u32, u32> = FxHashMap::default();
    for (&patch, &label) in patches.of.iter().zip(&surface.labels) {
        let best = best.entry(label).or_insert(patch);
        if area[patch as usize] > area[*best as usize] {
            *best = patch;
        }
    }
    let mut keeps = vec![false; area.len()];
    best.into_values().for_each(|p| keeps[p as usize] = true);
    keeps
}
