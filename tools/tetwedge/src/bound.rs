//! Keeps refinement from going on for ever.
//!
//! Delaunay refinement ends for radius-edge bounds of 2 and above if no angle of the input is acute
//! (Shewchuk, "Tetrahedral mesh generation by Delaunay refinement", 1998). Below, it mostly ends, and
//! where it does not, points heap up at a sharp corner or edge without end. So TetGen may only add so many
//! points. When it has used them all and its edges are far shorter than those of the surface,
//! the bounds are eased; when they are not, the mesh is to be that large.

use crate::plc::Plc;
use crate::{Params, Sizes};
use geom::measure::region_volume;
use tetgen_sys::Mesh;
use tmesh::Document;

/// Points that may be added at first, at least.
const LEAST: f64 = 5e4;

/// The same for each point of the surface.
const PER_POINT: f64 = 200.0;

/// Factor by which more may be added when the mesh is to be large.
const MORE: f64 = 20.0;

/// Edges shorter than this, relative to the shortest of the surface, are those of a heap.
const SHRUNK: f64 = 0.05;

/// Least radius-edge bound when bounds are eased.
const EASED: f64 = 2.0;

/// TetGen counts points in 32 bits.
const MOST: f64 = 2e9;

/// Points that may be added for each of the surface when eased bounds do not help either.
const LAST: f64 = 20.0;

/// The bounds that are asked for, and how many points TetGen may add for them.
pub struct Bound {
    /// As asked on the command line, or eased.
    pub params: Params,
    /// Points that may be added.
    most: f64,
    eased: bool,
    last: bool,
}

impl Bound {
    /// The bounds as asked for.
    pub fn new(
        document: &Document,
        index: usize,
        params: &Params,
        sizes: &Sizes,
        plc: &Plc,
    ) -> Self {
        let template = &document.templates[index];
        let limits = document.regions.iter().zip(&sizes.of_region);
        let by_size: f64 = limits
            .filter_map(|(r, limit)| Some(region_volume(template, r.id) / (*limit)?))
            .sum();
        Self {
            params: params.clone(),
            most: LEAST.max(PER_POINT * plc.points.len() as f64).max(by_size),
            eased: false,
            last: false,
        }
    }

    /// Switches for TetGen, appended to those of the bounds.
    pub fn switches(&self) -> String {
        // The user's own limit counts.
        if self.params.quality && !self.params.switches.contains('S') {
            format!("S{:.0}", self.most.min(MOST))
        } else {
            String::new()
        }
    }

    /// What to do about a mesh for which all points were used; `None` when the mesh is to be
    /// taken.
    pub fn next(&self, plc: &Plc, mesh: &Mesh) -> Option<Self> {
        let added = mesh.points().len().saturating_sub(plc.points.len());
        if self.switches().is_empty() || self.last || (added as f64) < self.most.min(MOST) {
            return None;
        }
        let params = self.params.clone();
        let of_surface = shortest(&plc.points, plc.complex().triangles);
        if shortest(mesh.points(), mesh.tetrahedra()) >= SHRUNK * of_surface {
            return Some(Self {
                params,
                most: MORE * self.most,
                ..*self
            });
        }
        Some(Self {
            params: Params {
                radius_edge: params.radius_edge.max(EASED),
                min_dihedral: 0.0,
                ..params
            },
            most: match self.eased {
                true => LAST * plc.points.len() as f64,
                false => self.most,
            },
            eased: true,
            last: self.eased,
        })
    }

    /// What became of the bounds, if they are not what was asked for.
    pub fn advice(&self) -> Option<String> {
        let stopped = if self.last {
            format!(", and it was stopped after {:.0} points", self.most)
        } else {
            String::new()
        };
        self.eased.then(|| {
            format!(
                "refinement did not come to an end at sharp angles of the surface: radius-edge bound eased to {}, \
                 that of the smallest dihedral angle left out{stopped}",
                self.params.radius_edge,
            )
        })
    }
}

/// Length of the shortest edge of triangles or tetrahedra.
fn shortest<const N: usize>(points: &[[f64; 3]], cells: &[[i32; N]]) -> f64 {
    let mut least = f64::INFINITY;
    for cell in cells {
        for (i, &a) in cell.iter().enumerate() {
            for &b in &cell[..i] {
                let [p, q] = [a, b].map(|v| glam::DVec3::from_array(points[v as usize]));
                least = least.min(p.distance_squared(q));
            }
        }
    }
    least.sqrt()
}
