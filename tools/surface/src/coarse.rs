//! The mesher's answer without the vertices that its elements do not need.

use glam::DVec3;
use improve::{Coarse, Face, Leaves, coarsen};
use mesher::{Answer, Cells, Climb, Surface};
use rustc_hash::FxHashMap;
use tmesh::{OUTSIDE, Size, Tet};

/// What is left of the mesher's answer, in its numbering of vertices.
pub struct Left {
    /// Tetrahedra that are not in voids.
    pub tets: Vec<Tet>,
    /// The surface.
    pub surface: Vec<Surface>,
    /// Vertices that were taken out.
    pub removed: usize,
}

/// Takes out what the mesher added and its elements do not need, if they are improved afterwards.
pub fn coarsened(climb: &Climb<'_>, answer: &Answer, cells: Cells, leaves: Leaves) -> Left {
    let Cells {
        region,
        mut surface,
    } = cells;
    let (plc, mesh) = (&answer.plc, &*answer.mesh);
    let all = mesh.tetrahedra().iter().zip(region);
    let mut tets: Vec<Tet> = all
        .filter(|&(_, region)| region != OUTSIDE)
        .map(|(t, region)| Tet {
            vertices: t.map(|v| v as u32),
            region,
        })
        .collect();
    let mut removed = 0;
    if let Some(angle) = climb.params.angle() {
        let mut faces: Vec<Face> = surface
            .iter()
            .enumerate()
            .map(|(number, s)| Face {
                corners: s.triangle.vertices,
                facet: s.facet as u32,
                number: number as u32,
                stays: climb
                    .piece
                    .shares(plc.facets.facets[s.facet].attributes.face),
            })
            .collect();
        let cube = plc.scale.powi(3);
        let regions = climb
            .piece
            .document
            .regions
            .iter()
            .zip(&climb.sizes.of_region);
        let max_volume: FxHashMap<u32, f64> = regions
            .filter_map(|(r, volume)| Some((r.id, (*volume)? * cube)))
            .collect();
        let local = plc
            .graded
            .as_ref()
            .map(|graded| |p: DVec3| Size::OF_CUBE * graded.at(p).powi(3));
        let points = mesh.points().iter().map(|&p| DVec3::from_array(p));
        removed = coarsen(
            points.collect(),
            &mut tets,
            &mut faces,
            &Coarse {
                angle,
                min_dihedral: climb.params.min_dihedral,
                radius_edge: climb.params.radius_edge,
                leaves,
                max_volume: &max_volume,
                local: local.as_ref().map(|l| l as &(dyn Fn(DVec3) -> f64 + Sync)),
                first: plc.points.len() as u32,
            },
        );
        surface = faces
            .iter()
            .map(|face| {
                let of = &surface[face.number as usize];
                let mut triangle = of.triangle;
                triangle.vertices = face.corners;
                Surface {
                    triangle,
                    facet: of.facet,
                }
            })
            .collect();
    }
    Left {
        tets,
        surface,
        removed,
    }
}
