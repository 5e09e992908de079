//! A template that shares faces with one that was meshed before.

use crate::fill::Filled;
use crate::judge::EASING;
use crate::template::{Done, Job, template};
use mesher::{Deadline, Error, LADDER, Params, Rung};
use periodic_surf::{GUIDE_EASED, Other, impose, make};
use tmesh::Template;

/// A follower, its surface, and what became of it.
pub type Followed = (usize, Result<(Template, Done), Error>);

/// Rungs for a mesh that is only to be better than one that is there.
const BETTER: &[Rung] = &[LADDER[0]];

/// Meshes a template that shares faces with one that was meshed before; returns its surface, too. The surface is
/// kept, so that single bad elements may be its fault: then another one is tried.
///
/// # Errors
/// See [`Error`].
pub fn follower(job: &Job<'_>, index: usize, lead: &Filled) -> Result<(Template, Done), Error> {
    let deadline = Deadline::start(job.params.timeout);
    let mesh = |surface: &Params, rungs: &[Rung]| {
        let mut document = job.document.clone();
        let on_surface = Job {
            params: surface,
            ..*job
        };
        document.templates[index] = surface_of(&on_surface, index, lead, (rungs, deadline))?;
        let on_document = Job {
            document: &document,
            ..*job
        };
        let climb = on_document.climb(index, rungs, deadline);
        let (done, _) = template::<()>(&climb, None)?;
        Ok((document.templates.swap_remove(index), done))
    };
    // The guide has an easing of its own for the radius-edge bound.
    let [_, easing] = match crate::judge::improves(job.params) {
        true => EASING,
        false => [1.0; 2],
    };
    let guide = Params {
        min_dihedral: easing * job.params.min_dihedral,
        ..job.params.clone()
    };
    let first = mesh(&guide, &LADDER)?;
    let blame = match first.1.advice {
        Some(_) => None,
        None => first.1.verdict.may_blame_surface(),
    };
    let Some(why) = blame.filter(|_| !deadline.is_over()) else {
        return Ok(first);
    };
    (job.log)(&format!(
        "template {index}: {why}; once more with another surface"
    ));
    // One step tighter: the bound itself where it was eased for the guide, and beyond it where the bound itself was
    // not enough. The mesher may add a limited number of points.
    let tighter = Params {
        radius_edge: job.params.radius_edge / GUIDE_EASED,
        ..job.params.clone()
    };
    match mesh(&tighter, BETTER) {
        Ok(second) if second.1.verdict.is_better_than(&first.1.verdict) => Ok(second),
        Err(error) if error.is_from_outside() => Err(error),
        _ => Ok(first),
    }
}

/// Gives a template the faces that it shares with one that was meshed before, and makes the rest of
/// its surface fit them.
fn surface_of(
    job: &Job<'_>,
    index: usize,
    lead: &Filled,
    (rungs, deadline): (&[Rung], Deadline),
) -> Result<Template, Error> {
    let other = Other {
        template: &lead.template,
        vertices: &lead.vertices,
        triangles: &lead.shared,
    };
    let imposed = impose(job.document, index, &other).map_err(|what| Error::Unusable {
        template: index,
        what,
    })?;
    if !job.params.quality {
        return Ok(imposed);
    }
    let mut document = job.document.clone();
    document.templates[index] = imposed;
    let on_document = Job {
        document: &document,
        ..*job
    };
    match make(&on_document.climb(index, rungs, deadline)) {
        Ok(made) => Ok(made.template),
        Err(error) => {
            (job.log)(&format!(
                "template {index}: {error}; its other faces are divided only where the shared one is"
            ));
            Ok(document.templates.swap_remove(index))
        }
    }
}
