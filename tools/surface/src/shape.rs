//! Surfaces that follow the shape behind the triangles of the input.

use crate::apart::{apart, note_moved};
use crate::footing::Footing;
use crate::joined::groups;
use crate::needles::Needle;
use crate::remeshed::{Remeshing, Smoothed, remeshed};
use crate::seams::{same_body, same_size};
use geom::tolerance::Tolerance;
use kit::tolerance;
use mesher::{Description, Error, Log, Params, Piece, Plc, Progress, Sizes, thickness};
use remesh::{Drawn, Told};
use tmesh::{Deviation, Document};

/// What a deviation is multiplied by where it changes volumes by too much. A choice: what a deviation changes of them is at most
/// proportional to it, so that a few steps of this size are enough, and none gives up much more than needed.
const NARROWER: f64 = 0.5;

/// How far a face of a wall may move for the sake of lengths, over the wall's thickness: as both do at most, half of it is left.
const OF_WALL: f64 = 0.25;

/// What became of surfaces that follow the shape.
#[derive(Default)]
pub struct Followed {
    /// A sentence for each that changed.
    pub facts: Vec<String>,
    /// Of each template, what its surface stands on if it changed; empty for none.
    pub footings: Vec<Option<Footing>>,
}

/// Remeshes the surfaces of all templates within the deviation that the wishes allow. Where the input is as symmetric as its coordinates can be and no deviation is asked for, only vertices go that no facet needs, but for templates
/// that are drawn far finer than edges are asked for, or in strips that cost far more than the shape does, or all of them where there are needles. Where the deviation is left to the length of edges that is asked for, or to
/// the tolerance of a body without symmetry, the document's wishes say afterwards how far surfaces have moved.
///
/// # Errors
/// Walls with more elements across than can be made.
pub fn follow_shape(
    document: &mut Document,
    params: &Params,
    log: Log<'_>,
) -> Result<Followed, Error> {
    let tolerance = tolerance(document);
    let mut followed = Followed {
        facts: Vec::new(),
        footings: vec![None; document.templates.len()],
    };
    let radius = tolerance.extent().radius;
    let deviation = radius * document.deviation(tolerance.equal() / radius);
    let exact = deviation <= tolerance.equal();
    if !params.quality {
        return Ok(followed);
    }
    let within = match exact {
        true => as_drawn(document, &tolerance),
        false => attempts(document, &tolerance, deviation),
    };
    if within.is_empty() && !document.moves_for_lengths() {
        return Ok(followed);
    }
    let sizes = Sizes::new(document)?;
    let noise = deviation.max(tolerance.equal());
    let by_length = by_length(document, &sizes, radius).map(|wide| Attempt {
        deviation: wide.max(noise),
        noise,
        drift: None,
        drawn: match exact {
            true => Drawn::Exactly,
            false => Drawn::Roughly,
        },
    });
    let is_auto = document.wishes.deviation() == Deviation::Auto;
    let mut farthest = 0.0_f64;
    for group in groups(document, sizes.local.iter().any(Option::is_some)) {
        // Leaving out vertices takes no time.
        let mut all = by_length.iter().chain(&within);
        if all.any(|attempt| attempt.drawn != Drawn::Kept) {
            log.progress(&Progress {
                template: group[0],
                step: "remeshing the surface",
                points: 0.0,
                tetrahedra: 0.0,
            });
        }
        for attempt in by_length.iter().chain(&within) {
            match attempt.remeshed(document, &group, (&sizes, tolerance.flat())) {
                None => {}
                Some(Err(what)) => log.detail(&format!(
                    "{}: not remeshed within {:.1e}, {what}",
                    named(&group),
                    attempt.deviation
                )),
                Some(Ok((all, told))) => {
                    let before = |smoothed: &Smoothed| &document.templates[smoothed.index];
                    // Otherwise the input's own drift says how far it may be off.
                    if attempt.drift.is_none() && is_auto {
                        let moved = all.iter().map(|s| apart(before(s), &s.template));
                        farthest = moved.fold(farthest, f64::max);
                    }
                    let fact = fact(document, &all, told, attempt.deviation);
                    followed.facts.push(fact);
                    for mut smoothed in all {
                        let (index, mut footing) = (smoothed.index, smoothed.footing.take());
                        if let Some(footing) = &mut footing {
                            footing.drift = attempt.drift;
                            let is_noted = attempt.drift.is_none() && is_auto;
                            footing.deviation = is_noted.then_some(attempt.deviation);
                        }
                        take(document, &group, smoothed);
                        followed.footings[index] = footing;
                    }
                    break;
                }
            }
        }
    }
    for (index, footing) in followed.footings.iter_mut().enumerate() {
        if let Some(footing) = footing {
            let piece = Piece::of(document, index);
            footing.apart = vec![false; piece.template.triangles.len()];
            // What cannot be described is not meshed either.
            if let Ok(plc) = Plc::new(piece, &sizes, Description::PLAIN) {
                footing.tell_apart(&plc, piece.template);
            }
        }
    }
    if !followed.facts.is_empty() {
        document.wishes.keep_surface = Some(true);
    }
    if farthest > deviation {
        document.wishes.deviation = Some(Deviation::Within(farthest / radius));
    } else if farthest > tolerance.drift() {
        note_moved(document, farthest);
    }
    Ok(followed)
}

/// How far a surface may move, and what must not change.
#[derive(Clone, Copy)]
struct Attempt {
    /// At most so far, model units.
    deviation: f64,
    /// What is less off a plane may be noise, model units.
    noise: f64,
    /// Volumes and areas stay what they are within what comes of a surface that is off by this, model units.
    drift: Option<f64>,
    /// What the triangles of curved faces stand for.
    drawn: Drawn,
}

impl Attempt {
    /// The surfaces of a group of templates and what was done, or what is wrong with them; `None` where there is nothing to do.
    fn remeshed(
        &self,
        document: &Document,
        group: &[usize],
        (sizes, flat): (&Sizes, f64),
    ) -> Option<Result<(Vec<Smoothed>, Told), String>> {
        let nearer = match self.deviation > self.noise {
            true => group.iter().flat_map(|&i| walls(document, i)).collect(),
            false => Vec::new(),
        };
        let remeshing = Remeshing {
            deviation: self.deviation,
            nearer: &nearer,
            noise: self.noise,
            flat,
            drawn: self.drawn,
            sizes,
        };
        let (all, told) = remeshed(document, group, &remeshing)?;
        let kept = all.iter().try_for_each(|smoothed| {
            let before = &document.templates[smoothed.index];
            same_body(before, &smoothed.template, (self.deviation, 0.0))?;
            self.drift.map_or(Ok(()), |drift| {
                same_size((before, smoothed.index), &smoothed.template, drift)
            })
        });
        Some(kept.map(|()| (all, told)))
    }
}

/// What is tried one after the other. Where nobody asked for more than the tolerance, volume and area stay what they are
/// within what the body is off its symmetry, or it is remeshed within that. A body without symmetry is off none.
fn attempts(document: &Document, tolerance: &Tolerance, deviation: f64) -> Vec<Attempt> {
    let attempt = |deviation: f64, drift: Option<f64>| Attempt {
        deviation,
        noise: deviation,
        drift,
        drawn: Drawn::Roughly,
    };
    let drift = tolerance.drift();
    match document.wishes.deviation() {
        Deviation::Auto if 0.0 < drift && drift < deviation => {
            let wider = std::iter::successors(Some(deviation), |d| Some(d * NARROWER));
            let wider = wider.take_while(|d| *d > drift);
            wider
                .map(|d| attempt(d, Some(drift)))
                .chain([attempt(drift, None)])
                .collect()
        }
        _ => vec![attempt(deviation, None)],
    }
}

/// What is tried one after the other where the input has its symmetry exactly, unless all of it is to stay.
fn as_drawn(document: &Document, tolerance: &Tolerance) -> Vec<Attempt> {
    if document.wishes.deviation() != Deviation::Auto {
        return Vec::new();
    }
    let kept = Attempt {
        deviation: tolerance.equal(),
        noise: tolerance.equal(),
        drift: None,
        drawn: Drawn::Kept,
    };
    let wider = for_drawing(document, tolerance);
    wider.into_iter().chain([kept]).collect()
}

/// What is tried where the input has its symmetry exactly, but is drawn with facets that cost more than the shape does: its copies were
/// copied, and say nothing of how well it was drawn. As far as without a symmetry, then. All of it where there are needles that no mesh of good elements
/// can have; otherwise where narrow facets are most of what it costs, of a wedge that takes several steps of the symmetry those that are not there
/// because of it.
fn for_drawing(document: &Document, tolerance: &Tolerance) -> Option<Attempt> {
    let found = document.symmetry.as_ref()?;
    let deviation = found.tolerance * tolerance.extent().radius;
    let needle = Needle {
        narrow: deviation,
        feature: libm::cos(document.wishes.feature_angle().to_radians()),
        flat: tolerance.flat(),
    };
    let mut templates = 0..document.templates.len();
    let has_needles = templates.any(|t| needle.is_in(document, t));
    let turns = document.instances.iter().filter(|i| {
        let placed = i.isometry;
        i.template == 0 && !placed.mirrored() && !placed.flipped()
    });
    let is_one_step = turns.count() == found.group.order as usize;
    Some(Attempt {
        deviation,
        noise: tolerance.equal(),
        drift: None,
        drawn: match (has_needles, is_one_step) {
            (true, _) => Drawn::WithNeedles,
            (false, true) => Drawn::Exactly,
            (false, false) => Drawn::ExactlyAbout,
        },
    })
}

/// How far surfaces may move for the sake of a length of edges, model units, where nobody says how far.
fn by_length(document: &Document, sizes: &Sizes, radius: f64) -> Option<f64> {
    let wishes = &document.wishes;
    let field = sizes.local.iter().flatten().filter_map(|l| l.longest);
    let length = match field.reduce(f64::max) {
        // A field holds everywhere.
        Some(longest) => {
            let of_region = |length: &Option<f64>| length.unwrap_or(longest).min(longest);
            sizes.lengths.iter().map(of_region).reduce(f64::max)
        }
        None => {
            let lengths = sizes.lengths.iter().flatten().copied();
            lengths.chain(wishes.edge_length()).reduce(f64::max)
        }
    };
    let length = length.filter(|_| wishes.deviation() == Deviation::Auto)?;
    Some(wishes.room_for(length, radius))
}

/// How far the surface of a template may move at each of its vertices so that walls stay walls.
fn walls(document: &Document, index: usize) -> Vec<f64> {
    let copies = document.instances.len();
    let mut walls = thickness((&document.templates[index], index), copies);
    walls.iter_mut().for_each(|t| *t *= OF_WALL);
    walls
}

fn fact(document: &Document, all: &[Smoothed], told: Told, deviation: f64) -> String {
    let group: Vec<usize> = all.iter().map(|s| s.index).collect();
    let before = group.iter().map(|&i| document.templates[i].triangles.len());
    let after = all.iter().map(|s| s.template.triangles.len());
    format!(
        "{}: surface remeshed within {deviation:.1e}, {} triangles for {} ({} edges collapsed, {} split, {} flipped, {} \
         vertices moved)",
        named(&group),
        after.sum::<usize>(),
        before.sum::<usize>(),
        told.collapsed,
        told.split,
        told.flipped,
        told.moved,
    )
}

/// The templates of a group, in words.
fn named(group: &[usize]) -> String {
    let numbers: Vec<String> = group.iter().map(usize::to_string).collect();
    match &numbers[..] {
        [one] => format!("template {one}"),
        all => format!("templates {}", all.join(" and ")),
    }
}

/// Puts a template in its place, and renumbers what templates that are not in its group have of it.
fn take(document: &mut Document, group: &[usize], smoothed: Smoothed) {
    let index = smoothed.index;
    document.templates[index] = smoothed.template;
    let others = document.templates.iter_mut().enumerate();
    for (other, template) in others.filter(|(other, _)| !group.contains(other)) {
        for gluing in &mut template.gluings {
            if gluing.other_than(other) == Some(index) {
                for pair in &mut gluing.vertex_pairs {
                    pair[1] = smoothed.vertices[pair[1] as usize];
                }
                for pair in &mut gluing.triangle_pairs {
                    pair[1] = smoothed.triangles[pair[1] as usize];
                }
                gluing.sort();
            }
        }
    }
}
