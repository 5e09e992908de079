//! The whole document: every template meshed, walls between templates renumbered.

use crate::bound::Bound;
use crate::diagnose::{Chatter, failure};
use crate::fill::{Filled, NONE, fill, finish};
use crate::improve::Improved;
use crate::params::switches;
use crate::plc::{DESCRIPTIONS, Plc};
use crate::surface::{GUIDE_EASED, Other, impose, make};
use crate::walls::leader;
use crate::{Error, Params, Sizes};
use geom::tet::TetMeasures;
use glam::DVec3;
use kit::{both, in_parallel};
use std::time::Instant;
use tetgen_sys::{Limits, Mesh};
use tmesh::{Document, Template};

/// Most tetrahedra that may be asked for in a template: TetGen counts in 32 bits.
const MOST: f64 = 4e8;

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
/// replaced.
///
/// `log` receives details while the work goes on.
///
/// # Errors
/// See [`Error`].
pub fn tetrahedralize(
    mut document: Document,
    params: &Params,
    log: &(dyn Fn(&str) + Sync),
) -> Result<Meshed, Error> {
    let sizes = Sizes::new(&document, params)?;
    let count = document.templates.len();
    let leaders: Vec<Option<usize>> = (0..count).map(|i| leader(&document, i)).collect();
    let first: Vec<usize> = (0..count).filter(|&i| leaders[i].is_none()).collect();
    let mut slots: Vec<Option<Done>> = (0..count).map(|_| None).collect();
    // What is left of the threads is for the work on a single template.
    let each = Params {
        threads: (params.threads / first.len().max(1)).max(1),
        ..params.clone()
    };
    let mesh = |&index: &usize| {
        let followers = (0..count).filter(|&i| leaders[i] == Some(index));
        let followers: Vec<usize> = followers.collect();
        template(&document, index, &followers, &each, &sizes, log)
    };
    let meshed = in_parallel(&first, params.threads, mesh);
    let mut followed: Vec<Followed> = Vec::new();
    for (&index, done) in first.iter().zip(meshed) {
        let mut done = done?;
        followed.append(&mut done.followed);
        slots[index] = Some(done);
    }
    for (index, lead) in leaders.iter().enumerate() {
        if let Some(lead) = lead.and_then(|l| slots[l].as_ref()) {
            let known = followed.iter().position(|(follower, _)| *follower == index);
            let (surface, done) = match known {
                Some(known) => followed.swap_remove(known).1?,
                None => follower(&document, index, &lead.filled, params, &sizes, log)?,
            };
            document.templates[index] = surface;
            slots[index] = Some(done);
        }
    }
    // Every slot is filled: a leader has no leader.
    let mut done: Vec<Done> = slots.into_iter().flatten().collect();

    let mut advice = Vec::new();
    let mut facts = Vec::new();
    let refined = document.wishes.keep_surface();
    let as_cut = |(d, lead): (&Done, &Option<usize>)| d.preserved && lead.is_none();
    if !refined && done.iter().zip(&leaders).any(as_cut) {
        advice.push(
            "the surface was preserved for the sake of the faces it shares with its copies; periodic-surf before tetwedge \
             gives better elements"
                .to_owned(),
        );
    }
    for (index, d) in done.iter().enumerate() {
        advice.extend(d.advice.clone());
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
    for index in 0..count {
        let mut template = std::mem::take(&mut done[index].filled.template);
        // A follower has the new numbers already.
        let gluings = template
            .gluings
            .iter_mut()
            .filter(|_| leaders[index].is_none());
        for gluing in gluings {
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
        document.templates[index] = template;
    }
    Ok(Meshed {
        document,
        advice,
        facts,
    })
}

/// Meshes a template that shares faces with one that was meshed before; returns its surface, too. The surface is
/// kept, so that single bad elements may be its fault: then another one is tried.
fn follower(
    document: &Document,
    index: usize,
    lead: &Filled,
    params: &Params,
    sizes: &Sizes,
    log: &(dyn Fn(&str) + Sync),
) -> Result<(Template, Done), Error> {
    let begun = Instant::now();
    let mesh = |surface: &Params, params: &Params| {
        let mut document = document.clone();
        follow(&mut document, index, lead, surface, log)?;
        let done = template(&document, index, &[], params, sizes, log)?;
        Ok((document.templates.swap_remove(index), done))
    };
    let improved = |done: &Done| done.filled.improved.unwrap_or_default();
    // The guide has an easing of its own for the radius-edge bound.
    let guide = Params {
        min_dihedral: eased(params).min_dihedral,
        ..params.clone()
    };
    let first = mesh(&guide, params)?;
    let begin = improved(&first.1);
    let failing = begin.past + begin.low;
    let count = first.1.filled.template.tets.len();
    let few = SINGLE.max((FEW * count as f64) as usize);
    if first.1.advice.is_some() || count > SMALL || !(1..=few).contains(&failing) {
        return Ok(first);
    }
    let Some(again) = params.once_more(begun) else {
        return Ok(first);
    };
    log(&format!(
        "template {index}: {} tetrahedra are past the radius-edge bound, {} have a smaller angle than asked for (the \
         smallest {:.1} degrees); once more with another surface",
        begin.past, begin.low, begin.least
    ));
    // One step tighter: the bound itself where it was eased for the guide, and beyond it where the bound itself was
    // not enough. The mesher may add a limited number of points.
    let tighter = Params {
        radius_edge: again.radius_edge / GUIDE_EASED,
        ..again.clone()
    };
    match mesh(&tighter, &again) {
        Ok(second) if is_better(improved(&second.1), begin) => Ok(second),
        Err(error) if error.is_from_outside() => Err(error),
        _ => Ok(first),
    }
}

/// Gives a template the faces that it shares with one that was meshed before, and makes the rest of
/// its surface fit them.
fn follow(
    document: &mut Document,
    index: usize,
    lead: &Filled,
    params: &Params,
    log: &(dyn Fn(&str) + Sync),
) -> Result<(), Error> {
    let other = Other {
        template: &lead.template,
        vertices: &lead.vertices,
        triangles: &lead.shared,
    };
    document.templates[index] =
        impose(document, index, &other).map_err(|what| Error::Unusable {
            template: index,
            what,
        })?;
    if params.quality {
        match make(document, index, params, log) {
            Ok(made) => document.templates[index] = made.template,
            Err(error) => log(&format!(
                "template {index}: {error}; its other faces are divided only where the shared one is"
            )),
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

struct Done {
    filled: Filled,
    switches: String,
    advice: Option<String>,
    preserved: bool,
    /// Descriptions that failed before.
    failed: usize,
    /// Whether so many elements are left past the radius-edge bound that the mesh is worth another one.
    many: bool,
    /// Templates that share faces with this one, if they were meshed while it was finished.
    followed: Vec<Followed>,
}

/// A follower, its surface, and what became of it.
type Followed = (usize, Result<(Template, Done), Error>);

/// TetGen's answer for one template.
pub struct Answer {
    pub plc: Plc,
    pub mesh: Mesh,
    pub switches: String,
    /// What became of the bounds, if they could not be met.
    pub advice: Option<String>,
    /// When TetGen was done.
    pub meshed: Instant,
}

/// Has `make` mesh template `index` by one description of its surface after the other, until
/// one works. Returns what it made, and the number of descriptions that failed before.
///
/// `make` gets the number of the description in [`DESCRIPTIONS`] and the time when to stop.
///
/// # Errors
/// The last description's.
pub fn persist<T>(
    index: usize,
    params: &Params,
    log: &(dyn Fn(&str) + Sync),
    make: impl Fn(usize, Option<Instant>) -> Result<T, Error>,
) -> Result<(T, usize), Error> {
    let deadline = params.timeout.and_then(|t| Instant::now().checked_add(t));
    let mut failed = 0;
    loop {
        match make(failed, deadline) {
            Err(error) if error.is_bad_luck() && failed + 1 < DESCRIPTIONS.len() => {
                log(&format!(
                    "template {index}: {error}; trying an equivalent description of the surface"
                ));
                failed += 1;
            }
            Ok(made) => return Ok((made, failed)),
            Err(error) => return Err(error),
        }
    }
}

/// Has TetGen mesh one template by description `number`. `preserve`: the surface stays as it is.
///
/// # Errors
/// See [`Error`].
pub fn run(
    document: &Document,
    index: usize,
    params: &Params,
    sizes: &Sizes,
    (number, deadline): (usize, Option<Instant>),
    preserve: impl Fn(&Plc) -> bool,
    log: &(dyn Fn(&str) + Sync),
) -> Result<Answer, Error> {
    let begun = Instant::now();
    check_count(document, index, sizes)?;
    let plc = Plc::new(document, index, sizes, DESCRIPTIONS[number])?;
    let prepared = Instant::now();
    let mut bound = Bound::new(document, index, params, sizes, &plc);
    let (mesh, switches) = loop {
        let preserve = preserve(&plc);
        let mut switches = switches(&bound.params, plc.max_volume, plc.per_region, preserve);
        switches.push_str(&bound.switches());
        if let Some(points) = DESCRIPTIONS[number].rounds_from {
            switches.push_str(&format!("b{points}"));
        }
        log(&format!(
            "template {index}: {} points, {} triangles in {} facets, {} void(s); switches {switches}",
            plc.points.len(),
            plc.facets.of_triangle.len(),
            plc.facets.facets.len(),
            plc.hole_count(),
        ));
        let limits = Limits {
            timeout: deadline.map(|d| d.saturating_duration_since(Instant::now())),
            memory: params.max_memory,
        };
        let mut chatter = Chatter::new(log);
        let mesh = tetgen_sys::tetrahedralize(&plc.complex(), &switches, limits, &mut |bytes| {
            chatter.take(bytes);
        })
        .map_err(|error| {
            // Looking for the place takes time, and makes sense once there is nothing left to try.
            let last = number + 1 == DESCRIPTIONS.len();
            failure(error, &chatter, &plc, params.timeout, last)
        })?;
        match bound.next(&plc, &mesh) {
            Some(next) => bound = next,
            None => break (mesh, switches),
        }
    };
    let meshed = Instant::now();
    log(&format!(
        "template {index}: {} tetrahedra; prepared in {:.3} s, meshed in {:.3} s",
        mesh.tetrahedra().len(),
        (prepared - begun).as_secs_f64(),
        (meshed - prepared).as_secs_f64(),
    ));
    Ok(Answer {
        plc,
        mesh,
        switches,
        advice: bound.advice(),
        meshed,
    })
}

/// How much the radius-edge bound is eased for the mesher where elements are improved afterwards, which
/// brings what it left past the bound back below it. On prisms and vias (orders 4 to 128, bound 1.4) it
/// saves 2 to 15 % of the elements.
const EASED: f64 = 1.05;

/// The same for the smallest dihedral angle: on prisms and vias it saves a quarter of the elements with 15 degrees asked
/// for, a tenth with 10, next to nothing with 5, and all of them reach what was asked for.
const EASED_ANGLE: f64 = 2.0 / 3.0;

/// Fewer elements left past the bound are not worth another mesh.
const SOME: usize = 3;

/// With more than this part of the elements left past the bound, it was eased for too many ...
const TOO_MANY: f64 = 0.01;

/// ... unless it is the shape: elements past the eased bound, of which each spoils about so many.
const SPOILED: f64 = 2.0;

/// The same for elements with an angle below the smallest one asked for.
const TOO_MANY_LOW: f64 = 1e-3;

/// Elements that are not as asked for, as a part of all, up to which they are chance and not the shape: another mesh
/// may be without them.
const FEW: f64 = 1e-3;

/// Larger meshes are not made again for single elements with a small angle, and for single ones past the radius-edge
/// bound.
const SMALL: usize = 50_000;
const VERY_SMALL: usize = 10_000;

/// So many elements that fail are not the shape's fault in any case, where the surface may be at fault.
const SINGLE: usize = 8;

/// Whether fewer elements fail, or as many with a larger smallest angle.
fn is_better(this: Improved, other: Improved) -> bool {
    let failing = |i: Improved| i.past + i.low;
    failing(this) < failing(other) || (failing(this) == failing(other) && this.least > other.least)
}

/// Whether elements are improved after the mesher.
fn improves(params: &Params) -> bool {
    params.quality && params.optimize.is_some()
}

/// Bounds for the mesher: eased where elements are improved afterwards.
fn eased(params: &Params) -> Params {
    let mut bounds = params.clone();
    if improves(params) {
        bounds.radius_edge *= EASED;
        bounds.min_dihedral *= EASED_ANGLE;
    }
    bounds
}

/// Meshes a template, with the bounds eased if that can be mended; followers, too, if it is done at the first attempt
/// and there are threads for it.
fn template(
    document: &Document,
    index: usize,
    followers: &[usize],
    params: &Params,
    sizes: &Sizes,
    log: &(dyn Fn(&str) + Sync),
) -> Result<Done, Error> {
    if !improves(params) {
        return attempt(document, index, followers, (params, params), sizes, log);
    }
    let begun = Instant::now();
    let mesher = eased(params);
    let done = attempt(document, index, followers, (params, &mesher), sizes, log)?;
    let count = done.filled.template.tets.len();
    let improved = done.filled.improved.unwrap_or_default();
    if done.advice.is_some() || !(done.many || is_unlucky(&done.filled)) {
        return Ok(done);
    }
    let Some(params) = params.once_more(begun) else {
        return Ok(done);
    };
    log(&format!(
        "template {index}: of {count} tetrahedra {} are past the radius-edge bound, {} have an angle below {} (the \
         smallest {:.1} degrees); once more without the bounds eased",
        improved.past, improved.low, params.min_dihedral, improved.least
    ));
    let tight = match attempt(document, index, &[], (&params, &params), sizes, log) {
        Ok(tight) => tight,
        Err(error) if error.is_from_outside() => return Err(error),
        Err(_) => return Ok(done),
    };
    let again = tight.filled.improved.unwrap_or_default();
    let share = |i: Improved, count: usize| (i.past + i.low) as f64 / count.max(1) as f64;
    // A mesh that is no better only has more elements.
    let better = match done.many {
        true => share(again, tight.filled.template.tets.len()) < share(improved, count),
        false => is_better(again, improved),
    };
    Ok(if better { tight } else { done })
}

/// Whether more elements were left past the radius-edge bound, or with a smaller angle than was asked for, than
/// `outside` explains: the parts of the mesher's elements that are past its own bounds. They are looked at only where
/// they decide.
fn is_many(filled: &Filled, outside: impl FnOnce() -> [f64; 2]) -> bool {
    let left = filled.improved.unwrap_or_default();
    let count = filled.template.tets.len().max(1) as f64;
    let kinds = [(left.past, TOO_MANY), (left.low, TOO_MANY_LOW)];
    let excess = kinds.map(|(some, most)| match some >= SOME {
        true => some as f64 / count - most,
        false => 0.0,
    });
    let at_most = |of: [f64; 2]| excess.iter().zip(of).all(|(e, of)| *e <= SPOILED * of);
    !at_most([0.0; 2]) && !at_most(outside())
}

/// Whether so few elements are not as asked for that they are chance, in a mesh that is soon made again.
fn is_unlucky(filled: &Filled) -> bool {
    let left = filled.improved.unwrap_or_default();
    let count = filled.template.tets.len();
    let few = 1..=1.max((FEW * count as f64) as usize);
    (count <= SMALL && few.contains(&left.low))
        || (count <= VERY_SMALL && few.contains(&(left.past + left.low)))
}

/// Meshes a template as `mesher` says and improves it as `params` does. What it shares with followers is settled before
/// that: where there are threads, they are meshed at the same time.
fn attempt(
    document: &Document,
    index: usize,
    followers: &[usize],
    (params, mesher): (&Params, &Params),
    sizes: &Sizes,
    log: &(dyn Fn(&str) + Sync),
) -> Result<Done, Error> {
    let preserve = |plc: &Plc| plc.faces.preserve();
    let (done, failed) = persist(index, params, log, |number, deadline| {
        let attempt = (number, deadline);
        let answer = run(document, index, mesher, sizes, attempt, preserve, log)?;
        let (mut filled, origin) = fill(document, index, &answer.plc, &answer.mesh)?;
        let parallel = params.threads > 1 && !followers.is_empty();
        let surface = parallel.then(|| filled.shared_surface());
        let follow = || {
            let follow = |surface: &Filled| {
                let each = followers.iter();
                each.map(|&i| (i, follower(document, i, surface, params, sizes, log)))
                    .collect()
            };
            surface.as_ref().map_or_else(Vec::new, follow)
        };
        let finish = || {
            let filled = (&mut filled, &origin);
            finish(document, index, &answer.plc, filled, params, sizes)
        };
        let (followed, finished) = both(if parallel { 2 } else { 1 }, follow, finish);
        finished?;
        if let Some(done) = filled.improved {
            log(&format!(
                "template {index}: {} tetrahedra to be improved, {} remain; {} vertices moved, {} added, {} edges and faces \
                 replaced",
                done.bad, done.left, done.moved, done.inserted, done.flipped,
            ));
        }
        log(&format!(
            "template {index}: {} tetrahedra, {} vertices; checked in {:.3} s",
            filled.template.tets.len(),
            filled.template.vertices.len(),
            answer.meshed.elapsed().as_secs_f64(),
        ));
        if filled.dropped > 0 {
            log(&format!(
                "template {index}: {} tetrahedra in voids were left out",
                filled.dropped
            ));
        }
        let many = is_many(&filled, || outside(&answer.mesh, mesher));
        Ok(Done {
            filled,
            switches: answer.switches,
            advice: answer.advice,
            preserved: answer.plc.faces.preserve(),
            failed: 0,
            many,
            followed,
        })
    })?;
    Ok(Done { failed, ..done })
}

/// The parts of a mesh that are past the radius-edge bound, and below the smallest dihedral angle.
pub fn outside(mesh: &Mesh, params: &Params) -> [f64; 2] {
    let least = params.min_dihedral.to_radians();
    let mut found = [0_usize; 2];
    for t in mesh.tetrahedra().iter().filter(|_| params.quality) {
        let measures = TetMeasures::of(t.map(|v| DVec3::from_array(mesh.points()[v as usize])));
        found[0] += usize::from(measures.radius_edge_ratio > params.radius_edge);
        found[1] += usize::from(measures.min_dihedral < least);
    }
    found.map(|n| n as f64 / mesh.tetrahedra().len().max(1) as f64)
}

/// Refuses sizes that could only end in running out of memory.
fn check_count(document: &Document, index: usize, sizes: &Sizes) -> Result<(), Error> {
    let template = &document.templates[index];
    for (region, limit) in document.regions.iter().zip(&sizes.of_region) {
        if let Some(max_volume) = *limit {
            let count = geom::measure::region_volume(template, region.id) / max_volume;
            if count > MOST {
                return Err(Error::TooMany {
                    template: index,
                    max_volume,
                    count,
                    limit: MOST,
                });
            }
        }
    }
    Ok(())
}
