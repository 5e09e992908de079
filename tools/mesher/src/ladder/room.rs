//! Keeps refinement from going on for ever.
//!
//! Delaunay refinement mostly ends for the bounds that are asked for; where it does not, points heap up at a sharp corner or
//! edge without end. So the mesher may only add so many points. When it has used them all, the edges tell which it
//! is: far shorter than those of the surface, or not.

use super::rungs::Ending;
use crate::{Elements, Plc, Sizes};
use geom::measure::volume_of_region;
use glam::DVec3;
use tmesh::Document;

/// Points that may be added at first, at least. A choice: a second or two of work, so that a small surface whose mesh is to be
/// large is rarely meshed twice, and a heap is soon noticed.
const LEAST: f64 = 5e4;

/// The same for each point of the surface. A choice with the same reasons, for large surfaces.
const PER_POINT: f64 = 200.0;

/// Edges shorter than this part of the shortest one of the surface are those of a heap. A choice: refinement that ends
/// makes few edges shorter than the surface's, and one that does not halves them again and again; a larger value
/// takes fine meshes for heaps, a smaller one lets heaps grow to four hundred times the room.
const SHRUNK: f64 = 0.05;

/// TetGen counts points in 32 bits.
const MOST: f64 = i32::MAX as f64;

/// Points that may be added to a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room(f64);

impl Room {
    /// What is enough for most surfaces, and for the sizes asked for.
    pub fn new(document: &Document, sizes: &Sizes, plc: &Plc) -> Self {
        let template = &document.templates[plc.template];
        let limits = document.regions.iter().zip(&sizes.of_region);
        let by_size: f64 = limits
            .filter_map(|(r, limit)| {
                Some(volume_of_region(&template.vertices, template.faces(), r.id) / (*limit)?)
            })
            .sum();
        Self(LEAST.max(PER_POINT * plc.points.len() as f64).max(by_size))
    }

    /// So many times more.
    pub fn more(self, times: f64) -> Self {
        Self(times * self.0)
    }

    /// So many for each point of the surface.
    pub fn per_point(plc: &Plc, points: f64) -> Self {
        Self(points * plc.points.len() as f64)
    }

    /// The number of points.
    pub fn most(self) -> f64 {
        self.0.min(MOST)
    }

    /// How the attempt ended, if it used all points.
    pub fn ending(self, plc: &Plc, mesh: &dyn Elements) -> Option<Ending> {
        let added = mesh.points().len().saturating_sub(plc.points.len());
        if (added as f64) < self.most() {
            return None;
        }
        let of_surface = shortest(&plc.points, &plc.triangles);
        let heaped = shortest(mesh.points(), mesh.tetrahedra()) < SHRUNK * of_surface;
        Some(if heaped {
            Ending::Heaped
        } else {
            Ending::Large
        })
    }
}

/// Length of the shortest edge of triangles or tetrahedra.
fn shortest<const N: usize>(points: &[[f64; 3]], cells: &[[i32; N]]) -> f64 {
    let mut least = f64::INFINITY;
    for cell in cells {
        for (i, &a) in cell.iter().enumerate() {
            for &b in &cell[..i] {
                let [p, q] = [a, b].map(|v| DVec3::from_array(points[v as usize]));
                least = least.min(p.distance_squared(q));
            }
        }
    }
    least.sqrt()
}
