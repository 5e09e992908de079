//! The new surface of a template with faces that are images of each other, or with a face that another template has
//! refined.

use super::check;
use super::even::even;
use super::features::Features;
use super::guide::{Guide, Refined, refine};
use super::maker::Maker;
use super::pairing::Pairing;
use crate::SurfaceError;
use geom::contacts::contacts;
use mesher::{Climb, Description, Piece};
use tmesh::Template;

/// A new surface.
pub struct Made {
    /// The template; second members of its hub walls' pairs are as they were.
    pub template: Template,
    /// New vertex of each vertex, `u32::MAX` for those that are gone.
    pub vertices: Vec<u32>,
    /// Triangles on faces that other templates list as a hub wall, increasing.
    pub shared: Vec<u32>,
    /// Facet of each triangle, `u32::MAX` for images of others, and of each triangle as it was.
    pub facets: [Vec<u32>; 2],
    /// What became of the bounds, if they could not be met.
    pub advice: Option<String>,
    /// Whether faces are uneven, so that the surface is off the input's.
    pub is_uneven: bool,
}

/// Makes the surface of a template: its seam's faces become images of each other, its own hub
/// walls stay as they are, everything else is as fine as the guide has it.
///
/// Where the surface crosses itself because facets are uneven (two that meet at a small angle are filled as if they were flat), it is
/// made again without uneven facets.
///
/// # Errors
/// See [`SurfaceError`].
pub fn make(climb: &Climb<'_>, guide: Guide) -> Result<Made, SurfaceError> {
    let is_sound = |made: &Made| !made.is_uneven || !crosses_itself(&made.template);
    let evenly = || made_by(climb, even(climb)?).ok().filter(is_sound);
    if guide == Guide::Lengths
        && let Some(made) = evenly()
    {
        return Ok(made);
    }
    let made = made_by(climb, refine(climb, Description::PLAIN)?)?;
    if is_sound(&made) {
        return Ok(made);
    }
    climb.log.detail(&format!(
        "template {}: the surface crosses itself where facets are uneven, made again with all folds kept",
        climb.piece.index
    ));
    let apart = Description {
        apart: true,
        ..Description::PLAIN
    };
    made_by(climb, refine(climb, apart)?)
}

/// Whether triangles of a template meet anywhere but in common vertices and edges. n log n.
pub fn crosses_itself(template: &Template) -> bool {
    let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
    let mut crosses = false;
    contacts(
        &template.vertices,
        &triangles,
        |t| t,
        |_| {
            crosses = true;
            false
        },
    );
    crosses
}

/// Makes the surface by a guide.
fn made_by(climb: &Climb<'_>, guide: Refined) -> Result<Made, SurfaceError> {
    let Piece {
        index,
        template: input,
        ..
    } = climb.piece;
    let pairings = Pairing::of(input, index);
    let features = Features::new(input, index, &guide)?;
    let mut maker = Maker::new((input, index), &pairings, &guide, &features);
    maker.divide_edges();
    maker.fill_facets()?;
    let gluings = maker.gluings();
    let Maker {
        mut made,
        face_of,
        facet_of,
        of_input,
        ..
    } = maker;
    made.axis.sort_unstable();
    made.axis.dedup();
    made.gluings = gluings;
    let facets = &guide.facets.facets;
    let slack = facets.iter().map(|f| 2.0 * f.area * f.deviation).sum();
    check::same_body(input, &made, (guide.rounding, slack))
        .and_then(|()| check::apart(input, &made))
        .map_err(|what| SurfaceError::Changed {
            template: index,
            what,
        })?;
    let shared = (0..face_of.len() as u32).filter(|&t| climb.piece.shares(face_of[t as usize]));
    Ok(Made {
        shared: shared.collect(),
        template: made,
        vertices: of_input,
        facets: [facet_of, guide.facets.of_triangle],
        is_uneven: guide.is_uneven,
        advice: guide.advice,
    })
}
