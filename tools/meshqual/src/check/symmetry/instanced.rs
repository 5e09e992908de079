//! Symmetry of instances: placements instead of coordinates are mapped.

use crate::check::findings::{Findings, Kind};
use crate::instances::{Realized, realized};
use geom::tolerance::PROMISE;
use kit::number;
use tmesh::{Document, Outside, Promise};

/// Whether the instances have the symmetry that the document promises, if it does.
pub fn check(document: &Document, findings: &mut Findings) -> bool {
    let Some(promise) = &document.promise else {
        return true;
    };
    let realized = realized(document);
    let holds = promise.group.is_subgroup_of(realized.group);
    if !holds {
        findings.add(Kind::Instances, || {
            format!(
                "they have the symmetry {}, the document promises {}",
                realized.group, promise.group
            )
        });
    }
    holds && outside_holds(&realized, promise, findings)
}

/// Whether the instances have the symmetry that is promised away from the axis.
fn outside_holds(realized: &Realized, promise: &Promise, findings: &mut Findings) -> bool {
    let Some(promised) = promise.outside else {
        return true;
    };
    let whole = Outside {
        group: realized.group,
        radius: 0.0,
    };
    let candidates = [Some(whole), realized.outside];
    let holds = candidates.iter().flatten().any(|o| {
        promised.group.is_subgroup_of(o.group) && o.radius <= promised.radius * (1.0 + PROMISE)
    });
    if !holds {
        findings.add(Kind::Instances, || {
            let found = realized.outside.unwrap_or(whole);
            format!(
                "they have the symmetry {} outside of the radius {}, the document promises {} outside of {}",
                found.group,
                number(found.radius),
                promised.group,
                number(promised.radius)
            )
        });
    }
    holds
}
