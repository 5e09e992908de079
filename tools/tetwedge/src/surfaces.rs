//! Surfaces alone, as they are to be filled.

use crate::document::{Meshed, or_as_cut};
use crate::filling::Filling;
use crate::settle::{Settled, Shaped};
use crate::template::Job;
use mesher::{Asks, Attempt, Deadline, Error, Fault, Log, Params, Piece, Sizes};
use surface::{Guide, SurfaceError, lengths};
use tmesh::Document;

/// Remeshes all surfaces within the deviation, and makes those of templates with seams, just as they are to be filled: where lengths of edges
/// are asked for, they are filled in both ways to see which is better. `log` receives details while the work goes on.
///
/// # Errors
/// See [`SurfaceError`].
pub fn surfaces(document: Document, params: &Params, log: Log<'_>) -> Result<Meshed, SurfaceError> {
    let tets = document.templates.iter().map(|t| t.tets.len()).sum();
    if tets > 0 {
        return Err(SurfaceError::AlreadyFilled(tets));
    }
    let spoils = |error: &SurfaceError| match error {
        SurfaceError::Mesher(error) => error.is_chance() || error.fault() == Fault::Input,
        _ => true,
    };
    or_as_cut(
        document,
        |document| made(document, params, log),
        spoils,
        log,
    )
}

/// The same, remeshed or not; an error says which.
fn made(document: Document, params: &Params, log: Log<'_>) -> Result<Meshed, (SurfaceError, bool)> {
    let shaped = Shaped::new(document, params, log).map_err(|error| (error.into(), true))?;
    let failed = |error| (error, shaped.is_remeshed());
    let mut settled = shaped.settled(Guide::Mesher, log).map_err(failed)?;
    if settled.is_as_asked()
        && has_choice(&settled)
        && let Ok(first) = Filling::new(settled.clone(), params, log)
    {
        let best = first.or_longer(&shaped, params, log);
        settled = best.settled;
        settled.document.templates = best.surfaces;
    } else if shaped.is_remeshed() {
        // What was not filled to see which is better.
        recovered(&settled.document, params, log).map_err(|error| failed(error.into()))?;
    }
    let mut facts = settled.facts();
    if settled.report.iter().all(Option::is_none) {
        let mut gluings = (0_usize..).zip(&settled.document.templates);
        let why = match gluings.any(|(i, t)| t.gluings.iter().any(|gluing| gluing.is_seam(i))) {
            true => "surface kept as cut, no quality is asked for",
            false => "no seam, the mesher may refine all walls",
        };
        facts.push(why.to_owned());
    }
    Ok(Meshed {
        advice: settled.advice(),
        facts,
        document: settled.document,
    })
}

/// Whether the mesher finds surfaces again in plain meshes of them: what it cannot be described or does not recover, nobody can fill who is told to keep it.
fn recovered(document: &Document, params: &Params, log: Log<'_>) -> Result<(), Error> {
    let plain = Params {
        quality: false,
        ..params.clone()
    };
    let job = Job {
        params: &plain,
        sizes: &Sizes::none(document),
        guide: Guide::Mesher,
        log,
    };
    let mut indices = 0..document.templates.len();
    indices.try_for_each(|index| {
        let climb = job.climb(Piece::of(document, index), Deadline::start(plain.timeout));
        climb.climb(Attempt::new(Asks::AsWished), |_| Ok(()))
    })
}

/// Whether a surface that was made might have the lengths asked for instead.
fn has_choice(settled: &Settled) -> bool {
    let Ok(sizes) = Sizes::new(&settled.document) else {
        return false;
    };
    let remade = settled.report.iter().enumerate();
    let mut remade = remade.filter(|(_, remade)| remade.is_some());
    remade.any(|(index, _)| lengths(&settled.document, &sizes, index).is_some())
}
