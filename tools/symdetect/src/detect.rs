//! From a surface to its symmetry.

use crate::error::Error;
use crate::params::Params;
use crate::report::Detection;
use crate::rotation::{Query, Rotation};
use crate::shape::Shape;
use crate::threads;
use glam::DVec3;
use tmesh::Document;

/// Finds the symmetry of a body's surface. `log` hears of progress.
pub fn detect(
    document: &Document,
    params: &Params,
    log: &mut (dyn FnMut(&str) + Send),
) -> Result<Detection, Error> {
    if !document.is_plain() {
        return Err(Error::NotPlain {
            templates: document.templates.len(),
            instances: document.instances.len(),
        });
    }
    let template = &document.templates[0];
    if template.triangles.is_empty() {
        return Err(Error::NoSurface);
    }
    let precision = document.source.as_ref().map(|s| s.precision);
    threads::with(params.threads, || {
        let shape = Shape::new(template, precision).ok_or(Error::NoExtent {
            triangles: template.triangles.len(),
        })?;
        log(&format!(
            "surface prepared: {} kinds of interface, {} test points",
            shape.interfaces.classes.len(),
            shape.samples.mixed.len()
        ));
        answer(Query::new(&shape, params), log)
    })
}

/// The rotation of the highest order with all that holds beside it; without one, a mirror plane; without that, what
/// comes nearest.
fn answer(mut query: Query<'_>, log: &mut dyn FnMut(&str)) -> Result<Detection, Error> {
    let asked = query.params.order;
    let (directions, rotations) = match asked {
        Some(1) => (query.directions(log), Vec::new()),
        _ => query.rotations(log),
    };
    if asked != Some(1)
        && let Some(detection) = with_facets(&mut query, &directions, &rotations, log)
    {
        return Ok(detection);
    }
    if let Some(found) = query.certified(rotations.clone(), log) {
        return Ok(query.detection(found, &rotations, log));
    }
    if let Some(n) = asked.filter(|&n| n > 1) {
        return Err(query.order_fails(n, &directions));
    }
    for facets in [false, true] {
        query.limits.facets = facets;
        if let Some(found) = query.mirror_only(&directions) {
            log("a single mirror plane");
            return Ok(query.detection(found, &[], log));
        }
    }
    let closest = query.closest(&directions);
    let error = Error::Asymmetric {
        closest,
        tolerance: query.params.tolerance,
    };
    if query.params.allow_asymmetric {
        Ok(query.asymmetric(closest, error.to_string()))
    } else {
        Err(error)
    }
}

/// A group of higher order than the rotations found, if one holds when facets of smooth surfaces are allowed for.
fn with_facets(
    query: &mut Query<'_>,
    directions: &[DVec3],
    rotations: &[Rotation],
    log: &mut dyn FnMut(&str),
) -> Option<Detection> {
    if !query.facets_may_hide(directions, rotations) {
        return None;
    }
    query.limits.facets = true;
    let best = |all: &[Rotation]| all.iter().map(Rotation::rank).max();
    let wider = match query.main(rotations) {
        Some(main) => query.beside(main, query.limits).into_iter().collect(),
        None => query.rotations(log).1,
    };
    let mut found = None;
    if best(&wider) > best(rotations) {
        log("facets of smooth surfaces allowed for");
        found = query.certified(wider.clone(), log);
    }
    let detection = found.map(|found| query.detection(found, &wider, log));
    query.limits.facets = false;
    detection
}
