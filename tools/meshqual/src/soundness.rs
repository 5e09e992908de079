//! Which documents can be measured although something is wrong with them.

use crate::error::Error;
use tmesh::{Document, Violation};

/// Refuses documents whose indices lead nowhere; returns what else is wrong with one.
pub fn usable(document: &Document) -> Result<Vec<Violation>, Error> {
    let empty = |t: &tmesh::Template| t.tets.is_empty() && t.triangles.is_empty();
    if document.templates.iter().all(empty) {
        return Err(Error::Empty);
    }
    let violations = tmesh::validate(document);
    let usable = |v: &Violation| {
        matches!(
            v,
            Violation::OffPlane { .. }
                | Violation::OffAxis { .. }
                | Violation::NotAnImage { .. }
                | Violation::TrianglesDiffer { .. }
                | Violation::MissingNeighbour { .. }
                | Violation::RepeatedInstance { .. }
        )
    };
    let unusable = violations.iter().find(|v| !usable(v));
    // Violations of walls end validation before it comes to the instances, and a thousand of any kind
    // end it anywhere.
    let unknown = (violations.len() >= 1000 || !instances_in_range(document))
        .then(|| violations.first())
        .flatten();
    match unusable.or(unknown) {
        Some(violation) => Err(Error::Invalid(violation.clone())),
        None => Ok(violations),
    }
}

fn instances_in_range(document: &Document) -> bool {
    document.instances.iter().all(|i| {
        (i.template as usize) < document.templates.len()
            && i.region_map as usize <= document.region_maps.len()
    })
}
