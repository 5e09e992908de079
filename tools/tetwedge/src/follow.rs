//! A template that shares faces with one that was meshed before.

use crate::done::Done;
use crate::fill::Filled;
use crate::template::{Job, template};
use mesher::{Deadline, Error, Piece};
use surface::{Other, impose, make};
use tmesh::{Document, Template};

/// A follower, its surface, and what became of it.
pub type Followed = (usize, Result<(Template, Done), Error>);

/// Meshes all followers of a template whose shared surface is settled.
pub type Follow<'a> = &'a (dyn Fn(&Filled) -> Vec<Followed> + Sync);

/// A leading template, and its followers if they were meshed beside it.
pub type Led = Result<(Done, Option<Vec<Followed>>), Error>;

/// Meshes a template that shares faces with one that was meshed before; returns its surface, too.
///
/// # Errors
/// See [`Error`].
pub fn follower(
    job: &Job<'_>,
    (document, index): (&Document, usize),
    lead: &Filled,
) -> Result<(Template, Done), Error> {
    let deadline = Deadline::start(job.params.timeout);
    let surface = surface_of(job, (document, index), lead, deadline)?;
    let piece = Piece {
        template: &surface,
        ..Piece::of(document, index)
    };
    let (done, _) = template::<()>(&job.climb(piece, deadline), None, None)?;
    Ok((surface, done))
}

/// Gives a template the faces that it shares with one that was meshed before, and makes the rest of
/// its surface fit them.
fn surface_of(
    job: &Job<'_>,
    (document, index): (&Document, usize),
    lead: &Filled,
    deadline: Deadline,
) -> Result<Template, Error> {
    let other = Other {
        template: &lead.template,
        vertices: &lead.vertices,
        triangles: &lead.shared,
    };
    let imposed = impose(document, index, &other).map_err(|what| Error::Unusable {
        template: index,
        what,
    })?;
    if !job.params.quality {
        return Ok(imposed);
    }
    let piece = Piece {
        template: &imposed,
        ..Piece::of(document, index)
    };
    match make(&job.climb(piece, deadline), job.guide) {
        Ok(made) => Ok(made.template),
        Err(error) => {
            job.log.detail(&format!(
                "template {index}: {error}; its other faces are divided only where the shared one is"
            ));
            Ok(imposed)
        }
    }
}
