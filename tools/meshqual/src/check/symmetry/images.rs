//! The vertices that images of vertices fall on.

use super::generators::Generator;
use super::part::Part;
use crate::check::findings::{Findings, Kind, at};
use geom::grid::Grid;
use geom::tolerance::PROMISE;
use geom::tree::Tree;
use glam::DVec3;
use tmesh::Document;

/// Stands for no image.
pub const NONE: u32 = u32::MAX;

/// Finds the vertices that images fall on.
pub struct Matcher<'a> {
    document: &'a Document,
    /// Vertices in the frame of the promise.
    points: &'a [DVec3],
    size: f64,
    /// Largest distance allowed, model units.
    pub limit: f64,
    /// How far from an image its vertex is looked for where none is near enough: halfway between the limit and
    /// the size by order of magnitude. The distance is only reported, and beyond this a vertex is said to
    /// have no image.
    reach: f64,
    near: Option<Grid<3>>,
    far: Option<Tree>,
}

impl<'a> Matcher<'a> {
    /// A matcher of a plain document's vertices; `points` are these in the frame of the promise, whose
    /// origin is `origin` in the world.
    pub fn new(document: &'a Document, points: &'a [DVec3], size: f64, origin: DVec3) -> Self {
        let vertices = document.templates[0].vertices.iter();
        let world = vertices.map(|p| document.frame.to_world(*p).abs().max_element());
        let largest = world.fold(origin.abs().max_element(), f64::max);
        // World coordinates far from the origin hold less. Half an epsilon is lost when one is stored and as
        // much when another frame is made of it, in each of three coordinates, of the vertex and of its
        // image: twice the square root of three, below four.
        let limit = PROMISE * size + 4.0 * f64::EPSILON * largest;
        Self {
            document,
            points,
            size,
            limit,
            reach: (limit * size).sqrt(),
            near: None,
            far: None,
        }
    }

    /// The largest distance of an image from its vertex relative to the size, and the image of each
    /// vertex of the part, [`NONE`] where there is none within reach. Images have to be different
    /// vertices.
    pub fn images(
        &mut self,
        generator: &Generator,
        part: &Part,
        findings: &mut Findings,
    ) -> (f64, Vec<u32>) {
        let placed = generator.isometry.placed();
        let (points, limit) = (self.points, self.limit);
        let mut residual = 0.0_f64;
        let mut images = Vec::with_capacity(points.len());
        for (v, &p) in points.iter().enumerate() {
            if !part.has_vertex(v) {
                images.push(NONE);
                continue;
            }
            let image = placed.apply(p);
            let all = || Grid::of(points.iter().copied(), limit);
            let near = self.near.get_or_insert_with(all);
            let mut found = near.nearest(image, limit);
            if found.is_none() {
                let all = || Tree::new(points.iter().map(|&p| [p; 3]));
                let far = self.far.get_or_insert_with(all);
                let nearest = far.nearest(image, self.reach);
                found = nearest.map(|n| (n.triangle, n.distance));
                self.report(v as u32, found, &generator.name, findings);
            }
            let (image, distance) = found.unwrap_or((NONE, self.reach));
            residual = residual.max(distance);
            images.push(image);
        }
        self.check_permutation(&generator.name, &images, findings);
        if self.size > 0.0 {
            residual /= self.size;
        }
        (residual, images)
    }

    /// Reports a vertex whose image misses the nearest vertex, or has none within reach.
    fn report(&self, v: u32, found: Option<(u32, f64)>, name: &str, findings: &mut Findings) {
        let place = || at(self.document, 0, &[v]);
        match found {
            Some((w, d)) => findings.add(Kind::Deviation, || {
                format!(
                    "the image of vertex {v} under {name} misses vertex {w} by {d:.3e} ({:.3e} of the size, where {:.1e} is allowed) {}",
                    d / self.size,
                    self.limit / self.size,
                    place()
                )
            }),
            None => findings.add(Kind::NoImage, || {
                format!(
                    "the image of vertex {v} under {name} has no vertex within {:.3e} {}",
                    self.reach,
                    place()
                )
            }),
        }
    }

    fn check_permutation(&self, name: &str, images: &[u32], findings: &mut Findings) {
        let mut taken = vec![false; images.len()];
        for (v, &image) in images.iter().enumerate().filter(|i| *i.1 != NONE) {
            if std::mem::replace(&mut taken[image as usize], true) {
                findings.add(Kind::NoPermutation, || {
                    let place = at(self.document, 0, &[image]);
                    format!("{name} maps vertex {v} and an earlier one to vertex {image} {place}")
                });
            }
        }
    }
}
