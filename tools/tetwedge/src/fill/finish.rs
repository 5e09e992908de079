//! Improvement of a filled template, and the checks of all of it.

use super::answer::{Origin, put_onto_relief};
use super::filled::Filled;
use super::measures::measures;
use super::orientations::orientations;
use geom::flat::FACE_FOLD_SINE;
use glam::DVec3;
use improve::{Flats, Freedoms, Improved, Wish, improve};
use mesher::{Climb, Error, Plc};
use rustc_hash::FxHashSet;

/// Improves the tetrahedra of a filled template, and checks all of it.
///
/// # Errors
/// [`Error::Unusable`] when anything that must hold does not.
pub fn finish(
    climb: &Climb<'_>,
    plc: &Plc,
    filled: &mut Filled,
    mut origin: Origin,
) -> Result<(), Error> {
    let unusable = |what: String| Error::Unusable {
        template: climb.piece.index,
        what,
    };
    if let Some((improved, parents)) = refine(climb, plc, &origin.facets, filled) {
        filled.improved = Some(improved);
        for t in parents {
            origin.facets.push(origin.facets[t as usize]);
            origin.faces.push(origin.faces[t as usize]);
        }
        let shared = filled.shared.iter();
        let shared: FxHashSet<u32> = shared
            .flat_map(|&t| filled.template.triangles[t as usize].vertices)
            .collect();
        put_onto_relief(plc, &origin.facets, &mut filled.template, |v| {
            !shared.contains(&v)
        });
    }
    let reach = climb.piece.document.frame.origin.length() + plc.extent;
    let template = &filled.template;
    orientations(template, origin.first_new, reach).map_err(unusable)?;
    measures(climb.piece.template, plc, &origin.faces, template).map_err(unusable)
}

/// Improves the tetrahedra, as far as elements are to be optimized; of each new triangle, the one that it is a part of.
fn refine(
    climb: &Climb<'_>,
    plc: &Plc,
    facets: &[usize],
    filled: &mut Filled,
) -> Option<(Improved, Vec<u32>)> {
    let Climb {
        piece,
        params,
        sizes,
        ..
    } = *climb;
    // The mesher was asked for less.
    let angle = params.angle()?;
    let of_triangle: Vec<u32> = facets.iter().map(|&f| f as u32).collect();
    let uneven = plc.relief.uneven().iter();
    let slopes: Vec<f64> = uneven
        .map(|&uneven| if uneven { FACE_FOLD_SINE } else { 0.0 })
        .collect();
    let normals: Vec<DVec3> = plc.facets.facets.iter().map(|f| f.normal).collect();
    // Templates that share a face take it over as it is.
    let shared = filled.shared.iter();
    let fixed: Vec<u32> = shared
        .flat_map(|&t| filled.template.triangles[t as usize].vertices)
        .collect();
    let freedoms = Freedoms::new(
        (&filled.template, piece.index),
        &Flats {
            of_triangle: &of_triangle,
            normals: &normals,
            slopes: &slopes,
            fixed: &fixed,
            kept: &filled.shared,
            straight: plc.rounding + 2.0 * plc.shift,
        },
    );
    let regions = piece.document.regions.iter().zip(&sizes.of_region);
    let wish = Wish {
        angle,
        radius_edge: params.radius_edge,
        min_dihedral: params.min_dihedral,
        max_volume: &regions.filter_map(|(r, v)| Some((r.id, (*v)?))).collect(),
        scale: plc.scale,
        stop: &|| climb.deadline.is_over(),
    };
    Some(improve(&mut filled.template, &freedoms, &wish))
}
