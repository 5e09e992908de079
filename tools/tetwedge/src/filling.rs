//! All templates of a document filled, and what of it is better by another surface.

use crate::done::Done;
use crate::fill::Filled;
use crate::follow::{Follow, Followed, Led, follower};
use crate::leads::leader;
use crate::score::{Judge, Score};
use crate::settle::{Settled, Shaped};
use crate::template::{Job, template};
use mesher::{Deadline, Error, Log, Params, Piece, Sizes};
use rayon::prelude::*;
use std::time::Instant;
use surface::{Guide, glued};
use tmesh::{Document, Template};

/// A document whose templates are filled.
pub struct Filling {
    /// The document, with the surfaces that were filled, and what was made of it before.
    pub settled: Settled,
    /// The surfaces as they were settled, before those that follow others did.
    pub surfaces: Vec<Template>,
    /// What became of each template.
    pub done: Vec<Done>,
    /// Sizes by region.
    sizes: Sizes,
    /// When it was begun.
    begun: Instant,
}

impl Filling {
    /// Fills all templates.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn new(mut settled: Settled, params: &Params, log: Log<'_>) -> Result<Self, Error> {
        let begun = Instant::now();
        let sizes = Sizes::new(&settled.document)?;
        let surfaces = settled.document.templates.clone();
        let mut document = std::mem::take(&mut settled.document);
        let done = templates(&mut document, (params, &sizes), &settled, log)?;
        settled.document = document;
        Ok(Self {
            settled,
            surfaces,
            done,
            sizes,
            begun,
        })
    }

    /// The better one of this and what becomes of surfaces with the lengths asked for, where edges end up shorter; for templates that share
    /// faces, together.
    pub fn or_longer(mut self, shaped: &Shaped, params: &Params, log: Log<'_>) -> Self {
        // As with draws: what cannot be as asked is not a matter of the way.
        let is_as_asked =
            self.settled.is_as_asked() && self.done.iter().all(|done| done.advice.is_none());
        let has_choice = is_as_asked && params.switches.is_empty();
        let Some(first) = self.scores(params).filter(|_| has_choice) else {
            return self;
        };
        let mut each = first.iter().enumerate();
        if !each.any(|(index, score)| self.is_made(index) && score.is_short()) {
            return self;
        }
        // Both share the time that there is.
        let limited = Params {
            timeout: params
                .timeout
                .map(|t| t.saturating_sub(self.begun.elapsed())),
            ..params.clone()
        };
        if limited.timeout.is_some_and(|left| left.is_zero()) {
            return self;
        }
        let settled = shaped.settled(Guide::Lengths, log);
        let other = settled
            .ok()
            .and_then(|settled| Self::new(settled, &limited, log).ok());
        let Some((mut other, second)) = other.and_then(|other| {
            let scores = other.scores(params)?;
            Some((other, scores))
        }) else {
            return self;
        };
        for group in glued(&self.surfaces) {
            let of = |scores: &[Score]| {
                let each = group.iter().map(|&i| (self.copies(i), &scores[i]));
                Score::together(each)
            };
            let [there, here] = [&second, &first].map(|scores| of(scores));
            if there.is_as_wanted_beside(&here) {
                for &index in &group {
                    if self.is_made(index) {
                        log.detail(&format!(
                            "template {index}: its surface has the lengths asked for, and the mesher leaves them"
                        ));
                    }
                    self.swap(&mut other, index);
                }
            }
        }
        self
    }

    /// Whether the surface of a template was made here, and might have been made in another way.
    fn is_made(&self, index: usize) -> bool {
        self.settled.report[index].is_some() || leader(&self.settled.document, index).is_some()
    }

    /// Puts what another filling has of a template in the place of what is here.
    fn swap(&mut self, other: &mut Self, index: usize) {
        let (here, there) = (&mut self.settled, &mut other.settled);
        let templates = (&mut here.document.templates, &mut there.document.templates);
        std::mem::swap(&mut templates.0[index], &mut templates.1[index]);
        std::mem::swap(&mut self.surfaces[index], &mut other.surfaces[index]);
        std::mem::swap(&mut self.done[index], &mut other.done[index]);
        std::mem::swap(&mut here.report[index], &mut there.report[index]);
        if let (Some(here), Some(there)) =
            (here.footings.get_mut(index), there.footings.get_mut(index))
        {
            std::mem::swap(here, there);
        }
    }

    /// How often a template is placed.
    fn copies(&self, index: usize) -> usize {
        let instances = self.settled.document.instances.iter();
        instances.filter(|i| i.template as usize == index).count()
    }

    /// How good the meshes are; `None` where no lengths are asked for or elements are not improved.
    fn scores(&self, params: &Params) -> Option<Vec<Score>> {
        let angle = params.angle()?;
        let each = self.done.iter().enumerate().map(|(index, done)| {
            let judge = Judge::new(&self.settled.document, (&self.sizes, index), params, angle);
            (judge.has_lengths() && done.filled.improved.is_some()).then(|| judge.score(done))
        });
        each.collect()
    }
}

/// Meshes all templates, those that lead before those that follow them; followers get their new surfaces.
fn templates(
    document: &mut Document,
    (params, sizes): (&Params, &Sizes),
    settled: &Settled,
    log: Log<'_>,
) -> Result<Vec<Done>, Error> {
    let job = Job {
        params,
        sizes,
        guide: settled.guide,
        log,
    };
    let count = document.templates.len();
    let leaders: Vec<Option<usize>> = (0..count).map(|index| leader(document, index)).collect();
    let first: Vec<usize> = (0..count).filter(|&i| leaders[i].is_none()).collect();
    let mesh = |&index: &usize| {
        let followers: Vec<usize> = (0..count).filter(|&i| leaders[i] == Some(index)).collect();
        let follow = |lead: &Filled| -> Vec<Followed> {
            let each = followers.iter();
            each.map(|&i| (i, follower(&job, (document, i), lead)))
                .collect()
        };
        let beside: Option<Follow<'_>> = match followers.is_empty() {
            true => None,
            false => Some(&follow),
        };
        let deadline = Deadline::start(params.timeout);
        let footing = settled.footings.get(index).and_then(Option::as_ref);
        let piece = Piece {
            apart: footing.map_or(&[], |footing| &footing.apart),
            ..Piece::of(document, index)
        };
        let climb = job.climb(piece, deadline);
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
                None => follower(&job, (document, index), &lead.filled)?,
            };
            document.templates[index] = surface;
            slots[index] = Some(done);
        }
    }
    // Every slot is filled: a leader has no leader.
    Ok(slots.into_iter().flatten().collect())
}
