//! The whole document: every template meshed, walls between templates renumbered.

use crate::done::Done;
use crate::fill::NONE;
use crate::filling::Filling;
use crate::leads::leader;
use crate::settle::{Settled, Shaped};
use mesher::{Error, Fault, Log, Params, Progress};
use surface::{Guide, SurfaceError, apart, note_deviation, note_moved};
use tmesh::{Deviation, Document, Template};

/// A document that was meshed, and what there is to say about it.
pub struct Meshed {
    /// The document; its history is as it was.
    pub document: Document,
    /// What the user should know or do otherwise, a sentence each.
    pub advice: Vec<String>,
    /// What was made, a sentence for each template.
    pub facts: Vec<String>,
}

/// Fills every template of a document with tetrahedra. Tetrahedra that were there before are
/// replaced. The faces that copies share are divided as the elements need, unless the document's wishes say that its
/// surface is to stay.
///
/// `log` receives details while the work goes on.
///
/// # Errors
/// See [`Error`].
pub fn tetrahedralize(document: Document, params: &Params, log: Log<'_>) -> Result<Meshed, Error> {
    tetrahedralize_shaped(document, params, log, &|_| ())
}

/// The same; `shaped` hears of the surfaces that follow the shape, before anything is filled.
///
/// # Errors
/// See [`Error`].
pub fn tetrahedralize_shaped(
    document: Document,
    params: &Params,
    log: Log<'_>,
    shaped: &(dyn Fn(&Shaped) + Sync),
) -> Result<Meshed, Error> {
    or_as_cut(
        document,
        |document| meshed(document, params, log, shaped),
        |error| error.is_chance() || error.fault() == Fault::Input,
        log,
    )
}

/// What is made of a document, of its surface as it was cut where `spoils` says of an error that it may be one of a surface that was
/// remeshed; errors tell whether it was.
pub fn or_as_cut<E: std::fmt::Display>(
    mut document: Document,
    make: impl Fn(Document) -> Result<Meshed, (E, bool)>,
    spoils: impl Fn(&E) -> bool,
    log: Log<'_>,
) -> Result<Meshed, E> {
    let wished = document.wishes.deviation;
    match make(document.clone()) {
        Err((error, true)) if spoils(&error) => {
            log.detail(&format!(
                "the surface is not remeshed, as that cannot be filled: {error}"
            ));
            document.wishes.deviation = Some(Deviation::Within(0.0));
            let mut made = make(document).map_err(|(error, _)| error)?;
            made.document.wishes.deviation = wished;
            Ok(made)
        }
        other => other.map_err(|(error, _)| error),
    }
}

/// The same, remeshed or not; an error says which.
fn meshed(
    document: Document,
    params: &Params,
    log: Log<'_>,
    hear: &(dyn Fn(&Shaped) + Sync),
) -> Result<Meshed, (Error, bool)> {
    let filled = document.templates.iter().any(|t| !t.tets.is_empty());
    let (shaped, settled) = of_surface(log, |log| {
        let shaped = match document.wishes.keep_surface() || filled {
            true => Shaped::kept(document),
            false => Shaped::new(document, params, log)?,
        };
        hear(&shaped);
        let settled = settled(&shaped, log)?;
        Ok((shaped, settled))
    })
    .map_err(|error| (error, true))?;
    let failed = |error| (error, shaped.is_remeshed());
    let first = Filling::new(settled, params, log).map_err(failed)?;
    let Filling {
        settled,
        surfaces: given,
        mut done,
        ..
    } = first.or_longer(&shaped, params, log);
    let facts = [settled.facts(), facts(&done)].concat();
    let advices = done.iter().filter_map(|d| d.advice.clone());
    let advice = settled.advice().into_iter().chain(advices).collect();
    let mut document = settled.document;
    let [mut moved, mut farthest] = [0.0_f64; 2];
    for index in 0..done.len() {
        let mut template = std::mem::take(&mut done[index].filled.template);
        // A follower has the new numbers already.
        if leader(&document, index).is_none() {
            renumber(index, &mut template, &done).map_err(failed)?;
        }
        if done[index].is_off {
            let footing = settled.footings.get(index).and_then(Option::as_ref);
            let more = match footing {
                Some(footing) => {
                    let [there, more] = footing.farther(&template, &given[index]);
                    if footing.is_noted() {
                        farthest = farthest.max(there);
                    }
                    more
                }
                None => apart(&given[index], &template),
            };
            moved = moved.max(more);
        }
        document.templates[index] = template;
    }
    note_moved(&mut document, moved);
    note_deviation(&mut document, farthest);
    Ok(Meshed {
        document,
        advice,
        facts,
    })
}

/// Does something about surfaces whose progress is said to be just that.
fn of_surface<T>(log: Log<'_>, work: impl FnOnce(Log<'_>) -> T) -> T {
    let detail = |text: &str| log.detail(text);
    let progress = |progress: &Progress<'_>| {
        let step = &format!("surface mesh, {}", progress.step);
        log.progress(&Progress { step, ..*progress });
    };
    match log.has_progress() {
        true => work(Log::new(&detail).with_progress(&progress)),
        false => work(log),
    }
}

/// The surface that is to be filled. Faces of a seam that cannot be divided stay as they were cut, unless that is for what remeshing made of
/// the surface.
///
/// # Errors
/// What another attempt would not change: time, memory, what is asked for.
fn settled(shaped: &Shaped, log: Log<'_>) -> Result<Settled, Error> {
    match shaped.settled(Guide::Mesher, log) {
        Err(SurfaceError::Mesher(error)) if !error.is_chance() => Err(error),
        Err(SurfaceError::Changed { template, what }) if shaped.is_remeshed() => {
            Err(Error::Unusable { template, what })
        }
        Err(error) => Ok(Settled {
            advice: vec![format!(
                "the faces that copies share stay as they were cut, which costs elements or their quality: {error}"
            )],
            ..shaped.as_it_is()
        }),
        Ok(settled) => Ok(settled),
    }
}

/// What was made.
fn facts(done: &[Done]) -> Vec<String> {
    let mut facts = Vec::new();
    for (index, d) in done.iter().enumerate() {
        if d.failed > 0 {
            facts.push(format!(
                "template {index}: TetGen failed on {} equivalent description(s) of the surface \
                 before this one",
                d.failed
            ));
        }
        facts.push(format!(
            "template {index}: {} tetrahedra, {} vertices, {} surface triangles (TetGen switches {})",
            d.filled.template.tets.len(),
            d.filled.template.vertices.len(),
            d.filled.template.triangles.len(),
            d.switches
        ));
    }
    facts
}

/// Gives the second members of the pairs with other templates the new numbers.
fn renumber(index: usize, template: &mut Template, done: &[Done]) -> Result<(), Error> {
    for gluing in &mut template.gluings {
        if let Some(other) = gluing.other_than(index) {
            let filled = &done[other].filled;
            let lost = renumber_second(&mut gluing.vertex_pairs, &filled.vertices)
                || renumber_second(&mut gluing.triangle_pairs, &filled.triangles);
            if lost {
                return Err(Error::Unusable {
                    template: other,
                    what: format!("it lost a part of wall '{}'", gluing.name),
                });
            }
        }
    }
    Ok(())
}

/// Renumbers the second members; returns whether one has no counterpart.
fn renumber_second(pairs: &mut [[u32; 2]], new: &[u32]) -> bool {
    for pair in pairs.iter_mut() {
        pair[1] = new[pair[1] as usize];
    }
    pairs.iter().any(|p| p[1] == NONE)
}
