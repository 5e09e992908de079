//! Keeps refinement from going on for ever.
//!
//! Delaunay refinement mostly ends for the bounds that are asked for; where it does not, points heap up at a sharp corner or
//! edge without end. So the mesher may only add so many points. When it has used them all, the edges tell which it
//! is: far shorter than those of the surface, or not.

use super::rungs::Ending;
use crate::{Elements, Piece, Plc, Sizes};
use geom::measure::volume_of_region;
use glam::DVec3;
use tmesh::Size;

/// Points that may be added at first, at least. A choice: a second or two of work, so that a small surface whose mesh is to be
/// large is rarely meshed twice, and a heap is soon noticed.
const LEAST: f64 = 5e4;

/// By how much more or less is a matter of another kind. A mesh that needs more points than there was room for gets so many
/// times more. Edges so many times shorter than the shortest one of the surface are those of a heap: refinement that
/// ends makes few edges shorter than the surface's, and one that does not halves them again and again. And a heap that
/// does not end is stopped after so many points for each of the surface. A choice: a smaller one takes fine meshes
/// for heaps, a larger one lets heaps grow.
const FAR: f64 = 20.0;

/// How far apart points are that TetGen takes for one, by the diagonal (in the mesher's unit, that is from 1 to 2): its tolerance, switch
/// `T`, which is not set. Refinement that comes as near has not ended by itself, and what it leaves has no interior to speak of.
pub const RESOLUTION: f64 = 1e-8;

/// Points that may be added to a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room(f64);

impl Room {
    /// What is enough for most surfaces, and for the sizes asked for.
    pub fn new(piece: Piece<'_>, sizes: &Sizes, plc: &Plc) -> Self {
        let Piece {
            document, template, ..
        } = piece;
        let limits = document.regions.iter().zip(&sizes.of_region);
        let by_size: f64 = limits
            .filter_map(|(r, limit)| {
                Some(volume_of_region(&template.vertices, template.faces(), r.id) / (*limit)?)
            })
            .sum();
        // A cube holds as many elements as their volumes, less than half of what is allowed, fit into it.
        let local = sizes.local.get(piece.index).and_then(Option::as_ref);
        let by_size = by_size + local.map_or(0.0, |l| 2.0 * l.cubes / Size::OF_CUBE);
        // What is as fine inside as on its surface has the power 3/2 of the points there.
        let points = plc.points.len() as f64;
        Self(LEAST.max(points * points.sqrt()).max(by_size))
    }

    /// Far more.
    pub fn more(self) -> Self {
        Self(FAR * self.0)
    }

    /// So many times as many as another mesh of the same surface has, or far more.
    pub fn beside(vertices: usize, times: f64) -> Self {
        Self(times.min(FAR) * vertices as f64)
    }

    /// For a mesh that is taken as it is.
    pub fn last(plc: &Plc) -> Self {
        Self(FAR * plc.points.len() as f64)
    }

    /// The number of points. TetGen counts them in 32 bits.
    pub fn most(self) -> f64 {
        self.0.min(f64::from(i32::MAX))
    }

    /// How the attempt ended, if it used all points, or was stopped by nothing but the mesher's resolution. Where `only_volumes` are
    /// bounded, no more elements are wanted than there is room for.
    pub fn ending(self, plc: &Plc, mesh: &dyn Elements, only_volumes: bool) -> Option<Ending> {
        let added = mesh.points().len().saturating_sub(plc.points.len());
        let used_all = added as f64 >= self.most();
        let of_mesh = shortest(mesh.points(), mesh.tetrahedra());
        if !used_all && of_mesh > FAR * RESOLUTION {
            return None;
        }
        if only_volumes || FAR * of_mesh < shortest(&plc.points, &plc.triangles) {
            Some(Ending::Heaped)
        } else {
            used_all.then_some(Ending::Large)
        }
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
