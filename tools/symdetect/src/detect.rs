//! From a surface to its symmetry.

use crate::error::Error;
use crate::group::Found;
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

/// The group of the shape that the drawing stands for, or that of the drawing where it is meant as it is; without one,
/// what comes nearest.
fn answer(mut query: Query<'_>, log: &mut dyn FnMut(&str)) -> Result<Detection, Error> {
    query.limits.facets = query.params.facets && query.facets_hide_something();
    let mut outcome = search(&query, log);
    if let Some(found) = outcome
        .found
        .take_if(|f| query.limits.facets && !query.is_drawn(f))
    {
        let is_meant = query.is_meant(&found);
        if is_meant && !found.axisymmetric && query.has_drawn_rotation(&found) {
            outcome.found = Some(found);
        } else {
            // A body that any rotation takes to itself within its facets is drawn as it was meant if it has a rotation.
            log("what the drawing itself has is looked for");
            query.limits.facets = false;
            let drawn = search(&query, log);
            let has_rotation = drawn.found.as_ref().is_some_and(|f| f.group.order > 1);
            if is_meant && !has_rotation {
                query.limits.facets = true;
                outcome.found = Some(found);
            } else {
                outcome = drawn;
            }
        }
    }
    if let Some(found) = outcome.found {
        return Ok(query.detection(found, &outcome.rotations, log));
    }
    if let Some(n) = query.params.order.filter(|&n| n > 1) {
        return Err(query.order_fails(n, &outcome.directions));
    }
    let closest = query.closest(&outcome.directions);
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

/// What a search came to.
struct Outcome {
    directions: Vec<DVec3>,
    rotations: Vec<Rotation>,
    found: Option<Found>,
}

/// The rotation of the highest order with all that holds beside it; without one, a mirror plane.
fn search(query: &Query<'_>, log: &mut dyn FnMut(&str)) -> Outcome {
    let asked = query.params.order;
    let (directions, rotations) = match asked {
        Some(1) => (query.directions(log), Vec::new()),
        _ => query.rotations(log),
    };
    let found = query.certified(rotations.clone(), log);
    let mirror = || query.mirror_only(&directions);
    let found = match asked {
        Some(n) if n > 1 => found,
        _ => found.or_else(mirror),
    };
    Outcome {
        directions,
        rotations,
        found,
    }
}
