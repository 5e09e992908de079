//! Regions of tetrahedra, from the two sides of the refined surface's triangles.

use crate::{Elements, Plc};
use geom::measure::double_area_vector;
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
    let points = mesh.points();
    let tets = mesh.tetrahedra();
    let at = |v: i32| DVec3::from_array(points[v as usize]);
    // Triangles with their facet and the two tetrahedra beside them.
    let mut pieces = Vec::with_capacity(mesh.triangles().len());
    let mut walled = vec![0_u8; tets.len()];
    for (i, (&corners, &marker)) in mesh
        .triangles()
        .iter()
        .zip(mesh.triangle_markers())
        .enumerate()
    {
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
        pieces.push((corners, facet, sides));
    }
    let (cell, cells) = connected(mesh, &walled);

    // Which regions each cell's boundary speaks for: (region, area), few per cell.
    let mut votes: Vec<Vec<(u32, f64)>> = vec![Vec::new(); cells];
    for (corners, facet, sides) in &pieces {
        let facet = &plc.facets.facets[*facet];
        let [a, b, c] = corners.map(at);
        let along = double_area_vector(a, b, c).dot(facet.normal);
        for tet in sides.iter().copied().flatten() {
            let apex = at(apex(tets[tet], *corners));
            let in_front = (orientation(a, b, c, apex) > 0.0) == (along > 0.0);
            let region = if in_front {
                facet.attributes.front
            } else {
                facet.attributes.back
            };
            let list = &mut votes[cell[tet] as usize];
            match list.iter_mut().find(|v| v.0 == region) {
                Some(vote) => vote.1 += along.abs(),
                None => list.push((region, along.abs())),
            }
        }
    }
    let mut region_of_cell = Vec::with_capacity(cells);
    for (i, list) in votes.iter().enumerate() {
        let Some(&(region, _)) = list.iter().max_by(|a, b| a.1.total_cmp(&b.1)) else {
            let tet = cell.iter().position(|&c| c as usize == i).unwrap_or(0);
            return Err(Contradiction {
                what: "tetrahedra that the surface does not bound".to_owned(),
                place: points[tets[tet][0] as usize],
            });
        };
        region_of_cell.push(region);
    }

    let mut surface = Vec::with_capacity(pieces.len());
    for (corners, facet, sides) in pieces {
        let id = facet;
        let facet = &plc.facets.facets[id];
        let of_side =
            |side: Option<usize>| side.map_or(OUTSIDE, |t| region_of_cell[cell[t] as usize]);
        let found = sides.map(of_side);
        let wanted = [facet.attributes.front, facet.attributes.back];
        let matches = |side: usize| found[side] == wanted[0] && found[1 - side] == wanted[1];
        let front = match (matches(0), matches(1)) {
            (true, false) => 0,
            (false, true) => 1,
            (true, true) => {
                // The same region on both sides: the facet's normal decides.
                let [a, b, c] = corners.map(at);
                let along = double_area_vector(a, b, c).dot(facet.normal) > 0.0;
                let first = sides[0]
                    .is_some_and(|t| orientation(a, b, c, at(apex(tets[t], corners))) > 0.0);
                usize::from(first != along)
            }
            (false, false) => {
                let middle = corners.map(at).iter().sum::<DVec3>() / 3.0;
                return Err(Contradiction {
                    what: format!(
                        "a surface triangle separates {} from {} instead of {} from {}",
                        crate::error::RegionName(found[0]),
                        crate::error::RegionName(found[1]),
                        crate::error::RegionName(wanted[0]),
                        crate::error::RegionName(wanted[1]),
                    ),
                    place: middle.to_array(),
                });
            }
        };
        let [a, b, c] = corners;
        // Counter-clockwise seen from the front: the front's apex on the positive side.
        let positive = match (sides[front], sides[1 - front]) {
            (Some(t), _) => orientation(at(a), at(b), at(c), at(apex(tets[t], corners))) > 0.0,
            (None, Some(t)) => orientation(at(a), at(b), at(c), at(apex(tets[t], corners))) < 0.0,
            (None, None) => (at(b) - at(a)).cross(at(c) - at(a)).dot(facet.normal) > 0.0,
        };
        let vertices = if positive { [a, b, c] } else { [a, c, b] };
        surface.push(Surface {
            triangle: Triangle {
                vertices: vertices.map(|v| v as u32),
                marker: facet.attributes.marker,
                front: facet.attributes.front,
                back: facet.attributes.back,
            },
            facet: id,
        });
    }
    let region = cell.iter().map(|&c| region_of_cell[c as usize]).collect();
    Ok(Cells { region, surface })
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
