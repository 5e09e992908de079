//! The new surface of a template with faces that are images of each other, or with a face that another template has
//! refined.

use super::check;
use super::features::Features;
use super::guide::refine;
use super::maker::Maker;
use super::pairing::Pairing;
use crate::SurfaceError;
use mesher::{Climb, Piece, face_key};
use tmesh::Template;

/// A new surface.
pub struct Made {
    /// The template; second members of its hub walls' pairs are as they were.
    pub template: Template,
    /// New vertex of each vertex, `u32::MAX` for those that are gone.
    pub vertices: Vec<u32>,
    /// Triangles on faces that other templates list as a hub wall, increasing.
    pub shared: Vec<u32>,
    /// What became of the bounds, if they could not be met.
    pub advice: Option<String>,
    /// Whether faces are uneven, so that the surface is off the input's.
    pub is_uneven: bool,
}

/// Makes the surface of a template: its seam's faces become images of each other, its own hub
/// walls stay as they are, everything else is as fine as a free pass of the mesher has it.
///
/// # Errors
/// See [`SurfaceError`].
pub fn make(climb: &Climb<'_>) -> Result<Made, SurfaceError> {
    let Piece {
        index,
        template: input,
        ..
    } = climb.piece;
    let pairings = Pairing::of(input, index);
    let guide = refine(climb)?;
    let features = Features::new(input, index, &guide)?;
    let mut maker = Maker::new((input, index), &pairings, &guide, &features);
    maker.divide_edges();
    maker.fill_facets()?;
    let gluings = maker.gluings();
    let Maker {
        mut made,
        face_of,
        of_input,
        ..
    } = maker;
    made.axis.sort_unstable();
    made.axis.dedup();
    made.gluings = gluings;
    let facets = &guide.facets.facets;
    let slack = facets.iter().map(|f| 2.0 * f.area * f.deviation).sum();
    check::same_body(input, &made, (guide.rounding, slack)).map_err(|what| {
        SurfaceError::Changed {
            template: index,
            what,
        }
    })?;
    let others = face_key(input.gluings.len(), false);
    let shared = (0..face_of.len() as u32).filter(|&t| face_of[t as usize] >= others);
    Ok(Made {
        shared: shared.collect(),
        template: made,
        vertices: of_input,
        is_uneven: guide.is_uneven,
        advice: guide.advice,
    })
}
