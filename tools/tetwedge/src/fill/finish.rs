//! Improvement of a filled template, and the checks of all of it.

use super::answer::Origin;
use super::doubled::doubled;
use super::filled::Filled;
use super::measures::{volumes, walls};
use super::orientations::Oriented;
use super::relief::{move_within_elements, on_relief};
use super::separation::separation;
use geom::flat::FACE_FOLD_SINE;
use geom::measure::corners;
use glam::DVec3;
use improve::{Curved, Flats, Freedoms, Improved, NO_PATCH, Point, Wish, improve};
use mesher::{Climb, Error, NO_FACE, Plc};
use rustc_hash::FxHashSet;
use surface::{Footing, crosses_itself};
use tmesh::Template;

/// Improves the tetrahedra of a filled template, and checks all of it. Where its surface stands on a shape, vertices are moved along that,
/// unless triangles meet then that did not, or sizes change that are to stay.
///
/// # Errors
/// [`Error::Unusable`] or [`Error::Doubled`] when anything that must hold does not.
pub fn finish(
    (climb, footing): (&Climb<'_>, Option<&Footing>),
    plc: &Plc,
    filled: &mut Filled,
    mut origin: Origin,
) -> Result<(), Error> {
    let unusable = |what: String| Error::Unusable {
        template: climb.piece.index,
        what,
    };
    let input = climb.piece.template;
    let patches = footing.map(|footing| patches(plc, footing));
    let points = footing
        .map(|footing| points(plc, footing))
        .unwrap_or_default();
    let curved = footing
        .zip(patches.as_deref())
        .map(|(footing, patches)| Curved {
            shape: footing.shape(plc.scale),
            patches,
            feature: libm::cos(climb.piece.document.wishes.feature_angle().to_radians()),
            points: &points,
            scale: plc.scale,
        });
    let mut refined = None;
    if let Some((curved, footing)) = curved.zip(footing) {
        volumes(input, plc, &filled.template).map_err(unusable)?;
        let before = filled.template.clone();
        refined = refine(climb, plc, (&origin.facets, Some(curved)), filled);
        filled.has_slid = has_slid(&before, &filled.template, |t| {
            patches
                .as_ref()
                .is_some_and(|patches| patches[origin.facets[t]] != NO_PATCH)
        });
        let is_kept = |template: &Template| {
            !crosses_itself(template) && footing.keeps_size(climb.piece.index, template)
        };
        if filled.has_slid && !is_kept(&filled.template) {
            filled.template = before;
            filled.has_slid = false;
            refined = None;
        }
    }
    let reach = climb.piece.document.frame.origin.length() + plc.extent;
    let oriented = Oriented::within(reach);
    let refined = refined.or_else(|| refine(climb, plc, (&origin.facets, None), filled));
    if let Some((improved, parents)) = refined {
        filled.improved = Some(improved);
        for t in parents {
            origin.facets.push(origin.facets[t as usize]);
            origin.faces.push(origin.faces[t as usize]);
        }
        let shared = filled.shared.iter();
        let shared: FxHashSet<u32> = shared
            .flat_map(|&t| filled.template.triangles[t as usize].vertices)
            .collect();
        let mut places = on_relief(plc, &origin.facets, &filled.template);
        places.retain(|(v, _)| !shared.contains(v));
        move_within_elements(&mut filled.template, &places, &oriented);
    }
    let template = &filled.template;
    oriented.all(template, origin.first_new).map_err(unusable)?;
    let diagonal = climb.piece.document.diagonal();
    separation(template, climb.piece.index, diagonal).map_err(unusable)?;
    doubled(template, climb.piece.index, &origin.faces)?;
    // What has slid was held against the input before.
    let surface = if filled.has_slid { template } else { input };
    volumes(surface, plc, template).map_err(unusable)?;
    walls(input, plc, &origin.faces, template).map_err(unusable)
}

/// The patch that each facet stands for: none for walls, uneven facets, and those of several patches.
fn patches(plc: &Plc, footing: &Footing) -> Vec<u32> {
    let facets = &plc.facets.facets;
    let mut patches: Vec<Option<u32>> = (facets.iter().zip(plc.relief.uneven()))
        .map(|(facet, &uneven)| (uneven || facet.attributes.face != NO_FACE).then_some(NO_PATCH))
        .collect();
    for (&facet, &patch) in plc.facets.of_triangle.iter().zip(&footing.patches) {
        let known = patches[facet as usize].get_or_insert(patch);
        if *known != patch {
            *known = NO_PATCH;
        }
    }
    let known = patches.into_iter();
    known.map(|patch| patch.unwrap_or(NO_PATCH)).collect()
}

/// The points of the shape that each facet is near to.
fn points(plc: &Plc, footing: &Footing) -> Vec<Vec<Point>> {
    let mut points = vec![Vec::new(); plc.facets.facets.len()];
    for (&facet, near) in plc.facets.of_triangle.iter().zip(&footing.points) {
        points[facet as usize].extend_from_slice(near);
    }
    points
}

/// Whether triangles that are curved are others, or elsewhere.
fn has_slid(before: &Template, after: &Template, is_curved: impl Fn(usize) -> bool) -> bool {
    let both = before.triangles.iter().zip(&after.triangles).enumerate();
    let mut curved = both.filter(|(t, _)| is_curved(*t)).map(|(_, both)| both);
    curved.any(|(old, new)| corners(&before.vertices, old) != corners(&after.vertices, new))
}

/// Improves the tetrahedra, as far as elements are to be optimized; of each new triangle, the one that it is a part of.
fn refine(
    climb: &Climb<'_>,
    plc: &Plc,
    (facets, curved): (&[usize], Option<Curved<'_>>),
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
            curved,
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
