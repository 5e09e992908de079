//! The whole document: every template meshed, walls between templates renumbered.

use crate::done::Done;
use crate::fill::{Filled, NONE};
use crate::follow::{Follow, Followed, Led, follower};
use crate::leads::leader;
use crate::settle::{Settled, settle};
use crate::template::{Job, template};
use mesher::{Deadline, Error, Log, Params, Piece, Sizes};
use periodic_surf::{Footing, apart, note_moved};
use rayon::prelude::*;
use tmesh::{Deviation, Document, Template};

/// A document that was filled, and what there is to say about it.
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
    let wished = document.wishes.deviation;
    let attempt = meshed(document.clone(), params, log);
    match attempt {
        Err((error, true)) if error.is_chance() => {
            log.detail(&format!(
                "the surface is not remeshed, as that cannot be filled: {error}"
            ));
            let mut document = document;
            document.wishes.deviation = Some(Deviation::Within(0.0));
            let mut meshed = meshed(document, params, log).map_err(|(error, _)| error)?;
            meshed.document.wishes.deviation = wished;
            Ok(meshed)
        }
        other => other.map_err(|(error, _)| error),
    }
}

/// The same, remeshed or not; an error says which.
fn meshed(document: Document, params: &Params, log: Log<'_>) -> Result<Meshed, (Error, bool)> {
    let Settled {
        mut document,
        advice: unsettled,
        facts: settled,
        remeshed,
        footings,
    } = settle(document, params, log).map_err(|error| (error, true))?;
    let sizes = Sizes::new(&document).map_err(|error| (error.into(), remeshed))?;
    let leaders: Vec<Option<usize>> = (0..document.templates.len())
        .map(|index| leader(&document, index))
        .collect();
    let failed = |error| (error, remeshed);
    let given = document.templates.clone();
    let mut done =
        templates(&mut document, &leaders, params, (&sizes, &footings), log).map_err(failed)?;
    let advices = done.iter().filter_map(|d| d.advice.clone());
    let advice = unsettled.into_iter().chain(advices).collect();
    let facts = [settled, facts(&done)].concat();
    let mut moved = 0.0_f64;
    for index in 0..done.len() {
        let mut template = std::mem::take(&mut done[index].filled.template);
        // A follower has the new numbers already.
        if leaders[index].is_none() {
            renumber(index, &mut template, &done).map_err(failed)?;
        }
        if done[index].is_off {
            let footing = footings.get(index).and_then(Option::as_ref);
            moved = moved.max(match footing {
                Some(footing) => footing.farther(&template, &given[index]),
                None => apart(&given[index], &template),
            });
        }
        document.templates[index] = template;
    }
    note_moved(&mut document, moved);
    Ok(Meshed {
        document,
        advice,
        facts,
    })
}

/// Meshes all templates, those that lead before those that follow them; followers get their new surfaces.
fn templates(
    document: &mut Document,
    leaders: &[Option<usize>],
    params: &Params,
    (sizes, footings): (&Sizes, &[Option<Footing>]),
    log: Log<'_>,
) -> Result<Vec<Done>, Error> {
    let count = document.templates.len();
    let job = Job {
        document,
        params,
        sizes,
        log,
    };
    let first: Vec<usize> = (0..count).filter(|&i| leaders[i].is_none()).collect();
    let mesh = |&index: &usize| {
        let followers: Vec<usize> = (0..count).filter(|&i| leaders[i] == Some(index)).collect();
        let follow = |lead: &Filled| -> Vec<Followed> {
            let each = followers.iter();
            each.map(|&i| (i, follower(&job, i, lead))).collect()
        };
        let beside: Option<Follow<'_>> = match followers.is_empty() {
            true => None,
            false => Some(&follow),
        };
        let deadline = Deadline::start(params.timeout);
        let footing = footings.get(index).and_then(Option::as_ref);
        let climb = job.climb(Piece::of(document, index), deadline);
        template(&climb, footing, beside)
    };
    let meshed: Vec<Led> = first.par_iter().map(mesh).collect();
    let mut slots: Vec<Option<Done>> = (0..count).map(|_| None).collect();
    let mut followed: Vec<Followed> = Vec::new();
    for (&index, done) in first.iter().zip(meshed) {
        let (done, beside) = done?;
        followed.extend(beside.into_iter().flatten());
        slots[index] = Some(done);
    }
    for (index, lead) in leaders.iter().enumerate() {
        if let Some(lead) = lead.and_then(|l| slots[l].as_ref()) {
            let known = followed.iter().position(|(follower, _)| *follower == index);
            let (surface, done) = match known {
                Some(known) => followed.swap_remove(known).1?,
                None => {
                    let job = Job {
                        document,
                        params,
                        sizes,
                        log,
                    };
                    follower(&job, index, &lead.filled)?
                }
            };
            document.templates[index] = surface;
            slots[index] = Some(done);
        }
    }
    // Every slot is filled: a leader has no leader.
    Ok(slots.into_iter().flatten().collect())
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
