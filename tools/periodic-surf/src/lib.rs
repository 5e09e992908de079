//! Makes the surface mesh of a wedge whose two cut faces are images of each other.
//!
//! Wedges between mirror walls pass as they are: both neighbours of a mirror wall are images of the
//! same face, so the mesher may refine it freely. The two faces of a seam have to stay images of
//! each other, so their triangulation must be settled before the wedge is filled:
//!
//! 1. A free pass of the mesher gives the guide: where the surface must be fine, for the thinness of
//!    layers and the quality and size asked for.
//! 2. Every edge of the seam's low face, and its image, get one division (`outline.rs`).
//! 3. The low face is triangulated between these edges, with the guide's inner points; the high face
//!    is its image.
//! 4. Flat facets whose outline changed are triangulated anew; all others are as in the guide.

mod check;
mod cli;
mod error;
mod features;
mod outline;
mod planar;
mod surface;

pub use cli::Cli;
pub use error::SurfaceError;
pub use tetwedge::Params;

use tmesh::{Document, Template, Wall};

/// Sentences about what was done, for the history and the user.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// A sentence for each template.
    pub facts: Vec<String>,
    /// Templates that got a new surface.
    pub remade: usize,
}

/// Makes the surfaces of all templates with a seam. `log` receives details while the work goes on.
///
/// # Errors
/// See [`SurfaceError`].
pub fn prepare(
    mut document: Document,
    params: &Params,
    log: &(dyn Fn(&str) + Sync),
) -> Result<(Document, Report), SurfaceError> {
    let tets = document.templates.iter().map(|t| t.tets.len()).sum();
    if tets > 0 {
        return Err(SurfaceError::AlreadyFilled(tets));
    }
    // Names of regions are wrong whatever the walls are.
    tetwedge::Sizes::new(&document, params)?;
    let mut report = Report::default();
    for index in 0..document.templates.len() {
        let template = &document.templates[index];
        let fact = match template.walls.as_slice() {
            _ if shared(&document, index) => "kept as cut, it shares a wall with another template",
            [Wall::Seam(_)] if !params.quality => "seam kept as cut, no quality is asked for",
            [Wall::Seam(seam)] => {
                let made = surface::make(&document, index, seam, params, log)?;
                report.facts.push(format!(
                    "template {index}: {} triangles, seam of {} vertex pairs and {} triangle pairs",
                    made.triangles.len(),
                    pairs(&made),
                    seam_triangles(&made),
                ));
                report.remade += 1;
                document.templates[index] = made;
                continue;
            }
            walls if walls.iter().any(|w| matches!(w, Wall::Seam(_))) => {
                "kept as cut, it has a seam and other walls"
            }
            _ => "no seam, the mesher may refine all walls",
        };
        report.facts.push(format!("template {index}: {fact}"));
    }
    Ok((document, report))
}

/// Whether a template has a wall in common with another one.
fn shared(document: &Document, index: usize) -> bool {
    document.templates.iter().enumerate().any(|(i, t)| {
        t.walls
            .iter()
            .any(|w| matches!(w, Wall::Hub(h) if i == index || h.other as usize == index))
    })
}

fn pairs(template: &Template) -> usize {
    template
        .walls
        .iter()
        .map(|w| match w {
            Wall::Seam(s) => s.vertex_pairs.len(),
            _ => 0,
        })
        .sum()
}

fn seam_triangles(template: &Template) -> usize {
    template
        .walls
        .iter()
        .map(|w| match w {
            Wall::Seam(s) => s.triangle_pairs.len(),
            _ => 0,
        })
        .sum()
}
