//! Regions of tetrahedra, from the two sides of the refined surface's triangles.

use crate::error::RegionName;
use crate::{Elements, Plc};
use geom::predicate::orientation;
use geom::sets::DisjointSets;
use glam::DVec3;
use tmesh::{OUTSIDE, Triangle};

/// A surface triangle of the mesh.
pub struct Surface {
    /// Triangle in the mesh's numbering of vertices, oriented, with all attributes.
    pub triangle: Triangle,
    /// Facet; see [`crate::Facets`].
    pub facet: usize,
}

/// The mesh with its regions.
pub struct Cells {
    /// Region of each tetrahedron; [`OUTSIDE`] where nothing is to be.
    pub region: Vec<u32>,
    /// The refined surface.
    pub surface: Vec<Surface>,
}

/// What is wrong with a mesh, and where.
pub struct Contradiction {
    /// What is wrong.
    pub what: String,
    /// A point nearby, in the mesh's coordinates.
    pub place: [f64; 3],
}

/// Labels tetrahedra by the cells that surface triangles enclose, and orients the triangles.
///
/// Facet normals say which region is on which side. Thin triangles have unreliable normals, so each
/// cell takes the region most of its boundary's area speaks for; then every triangle must separate
/// just the two regions of its facet, and is turned so that its front faces the right one.
pub fn label(plc: &Plc, mesh: &dyn Elements) -> Result<Cells, Contradiction> {
    let labeller = Labeller::new(plc, mesh);
    let region_of_cell = labeller.vote()?;
    let mut surface = Vec::with_capacity(labeller.pieces.len());
    for piece in &labeller.pieces {
        surface.push(Surface {
            triangle: labeller.oriented(piece, &region_of_cell)?,
            facet: piece.facet,
        });
    }
    let cells = labeller.cell.iter();
    Ok(Cells {
        region: cells.map(|&c| region_of_cell[c as usize]).collect(),
        surface,
    })
}

/// A triangle of the mesh that is on a facet.
struct Piece {
    corners: [i32; 3],
    facet: usize,
    /// The tetrahedra beside it.
    sides: [Option<usize>; 2],
}

/// A mesh, cut into cells by the triangles on facets.
struct Labeller<'a> {
    plc: &'a Plc,
    points: &'a [[f64; 3]],
    tets: &'a [[i32; 4]],
    pieces: Vec<Piece>,
    /// Cell of each tetrahedron.
    cell: Vec<u32>,
    cells: usize,
}

impl<'a> Labeller<'a> {
    fn new(plc: &'a Plc, mesh: &'a dyn Elements) -> Self {
        let tets = mesh.tetrahedra();
        let mut pieces = Vec::with_capacity(mesh.triangles().len());
        let mut walled = vec![0_u8; tets.len()];
        let markers = mesh.triangle_markers();
        for (i, (&corners, &marker)) in mesh.triangles().iter().zip(markers).enumerate() {
            // Faces that are on no facet have a marker that is none of ours.
            let Some(facet) = usize::try_from(marker)
                .ok()
                .and_then(|m| m.checked_sub(1))
                .filter(|&f| f < plc.facets.facets.len())
            else {
                continue;
            };
            let sides = mesh.sides(i);
            for tet in sides.into_iter().flatten() {
                let opposite = (0..4).find(|&c| !corners.contains(&tets[tet][c]));
                walled[tet] |= 1 << opposite.unwrap_or(0);
            }
            pieces.push(Piece {
                corners,
                facet,
                sides,
            });
        }
        let (cell, cells) = connected(mesh, &walled);
        Self {
            plc,
            points: mesh.points(),
            tets,
            pieces,
            cell,
            cells,
        }
    }

    fn at(&self, v: i32) -> DVec3 {
        DVec3::from_array(self.points[v as usize])
    }

    fn apex(&self, tet: usize, corners: [i32; 3]) -> DVec3 {
        self.at(apex(self.tets[tet], corners))
    }

    /// The region of each cell: the one that most of its boundary's area speaks for.
    fn vote(&self) -> Result<Vec<u32>, Contradiction> {
        // Which regions each cell's boundary speaks for: (region, area), few per cell.
        let mut votes: Vec<Vec<(u32, f64)>> = vec![Vec::new(); self.cells];
        for piece in &self.pieces {
            let facet = &self.plc.facets.facets[piece.facet];
            let [a, b, c] = piece.corners.map(|v| self.at(v));
            let along = (b - a).cross(c - a).dot(facet.normal);
            for tet in piece.sides.iter().copied().flatten() {
                let apex = self.apex(tet, piece.corners);
                let in_front = (orientation(a, b, c, apex) > 0.0) == (along > 0.0);
                let region = if in_front {
                    facet.attributes.front
                } else {
                    facet.attributes.back
                };
                let list = &mut votes[self.cell[tet] as usize];
                match list.iter_mut().find(|v| v.0 == region) {
                    Some(vote) => vote.1 += along.abs(),
                    None => list.push((region, along.abs())),
                }
            }
        }
        let most = |(i, list): (usize, &Vec<(u32, f64)>)| {
            let most = list.iter().max_by(|a, b| a.1.total_cmp(&b.1));
            most.map(|vote| vote.0).ok_or_else(|| {
                let tet = self.cell.iter().position(|&c| c as usize == i);
                Contradiction {
                    what: "tetrahedra that the surface does not bound".to_owned(),
                    place: self.points[self.tets[tet.unwrap_or(0)][0] as usize],
                }
            })
        };
        votes.iter().enumerate().map(most).collect()
    }

    /// A triangle with its attributes, turned so that its front faces the right region.
    fn oriented(&self, piece: &Piece, region_of_cell: &[u32]) -> Result<Triangle, Contradiction> {
        let Piece {
            corners,
            facet,
            sides,
        } = *piece;
        let facet = &self.plc.facets.facets[facet];
        let places = corners.map(|v| self.at(v));
        let [a, b, c] = places;
        let is_above = |tet: usize| orientation(a, b, c, self.apex(tet, corners)) > 0.0;
        let along = (b - a).cross(c - a).dot(facet.normal) > 0.0;
        let found =
            sides.map(|side| side.map_or(OUTSIDE, |tet| region_of_cell[self.cell[tet] as usize]));
        let wanted = [facet.attributes.front, facet.attributes.back];
        let matches = |side: usize| found[side] == wanted[0] && found[1 - side] == wanted[1];
        let front = match (matches(0), matches(1)) {
            (true, false) => 0,
            (false, true) => 1,
            // The same region on both sides: the facet's normal decides.
            (true, true) => usize::from(sides[0].is_some_and(is_above) != along),
            (false, false) => {
                let [of, from, instead, and] =
                    [found[0], found[1], wanted[0], wanted[1]].map(RegionName);
                return Err(Contradiction {
                    what: format!(
                        "a surface triangle separates {of} from {from} instead of {instead} from {and}"
                    ),
                    place: (places.iter().sum::<DVec3>() / 3.0).to_array(),
                });
            }
        };
        // Counter-clockwise seen from the front: the front's apex on the positive side.
        let positive = match (sides[front], sides[1 - front]) {
            (Some(tet), _) => is_above(tet),
            (None, Some(tet)) => orientation(a, b, c, self.apex(tet, corners)) < 0.0,
            (None, None) => along,
        };
        let [a, b, c] = corners.map(|v| v as u32);
        Ok(Triangle {
            vertices: if positive { [a, b, c] } else { [a, c, b] },
            marker: facet.attributes.marker,
            front: facet.attributes.front,
            back: facet.attributes.back,
        })
    }
}

/// The corner of a tetrahedron that is not in its face.
fn apex(tet: [i32; 4], face: [i32; 3]) -> i32 {
    tet.into_iter()
        .find(|v| !face.contains(v))
        .unwrap_or(tet[3])
}

/// Cell of each tetrahedron, and their number; bit `c` of `walled` closes the face opposite to
/// corner `c`. Cells are numbered by their first tetrahedra.
fn connected(mesh: &dyn Elements, walled: &[u8]) -> (Vec<u32>, usize) {
    let mut cells = DisjointSets::new(walled.len());
    for (tet, around) in mesh.neighbors().iter().enumerate().take(walled.len()) {
        for (corner, &next) in around.iter().enumerate() {
            // Each face is seen from both sides; one of them is enough.
            let earlier = u32::try_from(next).is_ok_and(|next| next < tet as u32);
            if earlier && walled[tet] & (1 << corner) == 0 {
                cells.join(tet as u32, next as u32);
            }
        }
    }
    cells.numbered()
}
