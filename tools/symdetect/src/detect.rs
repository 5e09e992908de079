//! From a surface to its symmetry.

use crate::error::Error;
use crate::group::Found;
use crate::params::Params;
use crate::report::Detection;
use crate::rotation::{Drawn, Limits, Query, Rotation};
use crate::shape::{Shape, Told};
use crate::threads;
use glam::DVec3;
use heal::Joined;
use tmesh::{Document, Template};

/// Hears of progress.
type Log<'a> = &'a mut dyn FnMut(&str);

/// Finds the symmetry of a body's surface. `log` hears of progress.
///
/// Where solids were `joined`, it is that of the solids as they are drawn: where faces cross at small angles, or facets of
/// two were joined, the outcome is less symmetric than either. But where it swaps two that claim the same space, which the
/// later one has, it is that of the outcome.
pub fn detect(
    document: &Document,
    joined: Option<&Joined>,
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
    let precision = precision_of(document);
    threads::with(params.threads, || {
        let drawn = joined.and_then(|j| Some((j, j.drawn.as_ref()?)));
        let of_drawn = drawn.and_then(|(joined, drawn)| {
            let found = of_template(drawn, precision, params, log).ok()?;
            let holds = found.asymmetric.is_none() && keeps_claims(&found, joined, document);
            holds.then_some(found)
        });
        let is_united = joined.is_some_and(|joined| joined.is_united);
        let mut found = match of_drawn {
            Some(found) if !is_united => found,
            // Parts of one solid need not be symmetric for that to be.
            Some(of_parts) => match of_template(template, precision, params, log) {
                Ok(found) if size(&found) >= size(&of_parts) => found,
                _ => of_parts,
            },
            None => of_template(template, precision, params, log)?,
        };
        found.notes.extend(found.exchange(document));
        Ok(found)
    })
}

/// How many operations were found.
fn size(found: &Detection) -> u32 {
    match found.asymmetric {
        None => found.symmetry.group.size(),
        Some(_) => 1,
    }
}

/// How precise the coordinates of a document are, world units, if that is known.
pub fn precision_of(document: &Document) -> Option<f64> {
    document.source.as_ref().map(|s| s.precision)
}

/// Whether no operation takes a solid that has space of another one to one that has lost it to the other's image.
fn keeps_claims(found: &Detection, joined: &Joined, document: &Document) -> bool {
    let id = |name: &str| {
        document
            .regions
            .iter()
            .find(|r| r.name == name)
            .map(|r| r.id)
    };
    let claims = joined.overlaps.iter().filter(|c| !c.nested);
    let claims: Vec<_> = claims
        .filter_map(|c| Some([id(&c.by)?, id(&c.from)?]))
        .collect();
    found.symmetry.regions.iter().all(|map| {
        let image = |region: u32| {
            let pair = map.pairs.iter().find(|p| p[0] == region);
            pair.map_or(region, |p| p[1])
        };
        claims
            .iter()
            .all(|&[by, from]| !claims.contains(&[image(from), image(by)]))
    })
}

fn of_template(
    template: &Template,
    precision: Option<f64>,
    params: &Params,
    log: &mut (dyn FnMut(&str) + Send),
) -> Result<Detection, Error> {
    let mut shape = Shape::new(template, precision).ok_or(Error::NoExtent {
        triangles: template.triangles.len(),
    })?;
    shape.may_exchange = params.exchange;
    log(&format!(
        "surface prepared: {} kinds of interface, {} test points",
        shape.interfaces.classes.len(),
        shape.samples.mixed.len()
    ));
    answer(&mut shape, params, log)
}

/// The group of the drawing, or that of the shape behind its facets where that is more and meant; without one, what
/// comes nearest.
fn answer(shape: &mut Shape, params: &Params, log: Log<'_>) -> Result<Detection, Error> {
    let mut query = Query::new(shape, params);
    query.limits.facets = false;
    let drawing = search(&query, log);
    let mut outcome = drawing.clone();
    let hidden = query.params.facets && query.facets_hide_something();
    if hidden && !outcome.is_round() {
        log("the shape behind the facets is looked at");
        query.look_behind(&mut outcome, log);
    } else {
        outcome.look_for_mirror(&query);
    }
    let Query {
        mut limits,
        mut drawn,
        ..
    } = query;
    if hidden && !outcome.is_round() {
        shape.told = Told::ByVertices {
            hiding: limits.tolerance,
        };
        // Where folds tell as much, they tell best where it is.
        let more = (shape.smooth().wider() > limits.tolerance).then(|| {
            log("and what vertices tell of it");
            told_by_vertices(drawing, Query::new(shape, params), log)
        });
        match more.filter(|more| more.0.size() > outcome.size()) {
            Some(more) => (outcome, limits, drawn) = more,
            None => shape.told = Told::ByFolds,
        }
    }
    let mut query = Query {
        limits,
        drawn,
        ..Query::new(shape, params)
    };
    let facets = std::mem::replace(&mut query.limits.facets, hidden);
    let nearly = query.nearly(&outcome.directions, outcome.found.as_ref());
    query.limits.facets = facets;
    if let Some(found) = outcome.found {
        return Ok(query.detection(found, &outcome.rotations, nearly, log));
    }
    if let Some(n) = query.params.order.filter(|&n| n > 1) {
        return Err(query.order_fails(n, &outcome.directions));
    }
    let closest = query.closest(&outcome.directions);
    let error = Error::Asymmetric {
        closest,
        nearly: nearly.clone().map(Box::new),
        tolerance: query.params.tolerance,
    };
    if query.params.allow_asymmetric {
        Ok(query.asymmetric(closest, nearly, error.to_string()))
    } else {
        Err(error)
    }
}

/// What the places of vertices tell beside the drawing, and what it was found with.
fn told_by_vertices(
    mut outcome: Outcome,
    mut query: Query<'_>,
    log: Log<'_>,
) -> (Outcome, Limits, Option<Drawn>) {
    query.look_behind(&mut outcome, log);
    (outcome, query.limits, query.drawn)
}

impl Query<'_> {
    /// Puts the group of the shape behind the facets in the place of another one, or of none, where it is more and meant.
    fn look_behind(&mut self, outcome: &mut Outcome, log: Log<'_>) {
        self.limits.facets = true;
        self.drawn = (outcome.found.as_ref())
            .filter(|f| f.group.order > 1)
            .map(|f| Drawn {
                axis: f.frame.rotation.z_axis,
                group: f.group,
            });
        let mut behind = search(self, log);
        // A mirror plane of the drawing comes before none and before a single operation behind it, but before no more.
        let is_more = |f: &Found| f.group.size() > 2 && self.is_meant(f);
        if outcome.found.is_none() && !behind.found.as_ref().is_some_and(is_more) {
            self.limits.facets = false;
            outcome.look_for_mirror(self);
            self.limits.facets = true;
        }
        behind.look_for_mirror(self);
        let drawn = outcome.found.as_ref();
        let found = behind.found.as_ref();
        let is_behind = found.map(|found| self.is_behind(found, &behind.rotations, drawn));
        match is_behind {
            Some(true) => *outcome = behind,
            None if outcome.found.is_none() => *outcome = behind,
            _ => {
                self.limits.facets = false;
                if let (Some(drawn), Some(found)) = (&mut outcome.found, &behind.found) {
                    drawn.axisymmetric = found.axisymmetric
                        && found.group.order == drawn.group.order
                        && self.is_meant(found);
                }
            }
        }
    }
}

/// What a search came to.
#[derive(Clone)]
struct Outcome {
    directions: Vec<DVec3>,
    rotations: Vec<Rotation>,
    found: Option<Found>,
}

impl Outcome {
    /// Whether any rotation takes the body to itself: then there is no more.
    fn is_round(&self) -> bool {
        self.found.as_ref().is_some_and(|f| f.axisymmetric)
    }

    /// How many operations the group found has.
    fn size(&self) -> u32 {
        self.found.as_ref().map_or(1, |f| f.group.size())
    }

    /// A mirror plane, if there is no rotation and none is asked for.
    fn look_for_mirror(&mut self, query: &Query<'_>) {
        if self.found.is_none() && query.params.order.is_none_or(|n| n <= 1) {
            self.found = query.mirror_only(&self.directions);
        }
    }
}

/// The rotation of the highest order with all that holds beside it.
fn search(query: &Query<'_>, log: Log<'_>) -> Outcome {
    let (directions, rotations) = match query.params.order {
        Some(1) => (query.directions(log), Vec::new()),
        _ => query.rotations(log),
    };
    Outcome {
        found: query.certified(rotations.clone(), log),
        directions,
        rotations,
    }
}
