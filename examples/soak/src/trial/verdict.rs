//! What to think of how a trial ended.

use super::pipe::Ended;
use super::subject::{Subject, Symmetry};
use super::surface::Measured;
use super::union::filled_twice;
use bodies::assembly::Claim;
use serde_json::Value;

/// How a trial ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Meshed; all that is known of the body holds.
    Meshed,
    /// Refused for what is known to be true: it has no symmetry.
    Asymmetric,
    /// Refused by a tool with exit code 1: the reason is for people to judge.
    Refused(String),
    /// Something that must not happen.
    Failed(String),
}

/// Largest deviation of a volume, relative to the boundary's area times radius, that rounding and
/// cleaning explain.
const VOLUME: f64 = 2e-6;

/// Judges the stages of the pipe, which got a body or, for `None`, a file that may be anything: `None` when all have ended well.
pub fn of_stages(subject: Option<&Subject>, ended: &[Ended]) -> Option<Verdict> {
    let first = ended.iter().find(|e| e.hung || e.code != Some(0))?;
    // A stage that waits for one that hangs hangs too; the last one that does is to blame for nothing.
    let tool = &first.tool;
    let last = first.messages.lines().last().unwrap_or_default();
    let reason = last.strip_prefix(&format!("{tool}: error: "));
    let is_asymmetric = subject.is_some_and(|s| s.symmetry.order() == 1);
    let may_be_malformed = subject.is_none() && tool == "symdetect";
    Some(match (first.hung, first.code, reason) {
        (true, ..) => Verdict::Failed(format!("{tool}: over the time limit")),
        (_, None, _) => Verdict::Failed(format!("{tool}: ended by a signal")),
        (_, Some(code), None) => Verdict::Failed(format!("{tool}: exit {code} without a reason")),
        (_, Some(1), Some(reason)) if reason.contains("internal error") => {
            Verdict::Failed(format!("{tool}: {reason}"))
        }
        (_, Some(1), Some(reason)) if is_asymmetric && reason.starts_with("no symmetry within") => {
            Verdict::Asymmetric
        }
        (_, Some(1), Some(reason)) => Verdict::Refused(format!("{tool}: {reason}")),
        (_, Some(3), Some(reason)) if may_be_malformed => {
            Verdict::Refused(format!("{tool}: {reason}"))
        }
        // The body, or what the stage before wrote, is sound and so is the usage.
        (_, Some(code), Some(reason)) => Verdict::Failed(format!("{tool}: exit {code}: {reason}")),
    })
}

/// Compares what symdetect and meshqual report with what is known. `deviation`: how far the surface may have moved, relative to
/// the radius about the axis.
pub fn of_reports(subject: &Subject, symmetry: &Value, quality: &Value, deviation: f64) -> Verdict {
    let problems = [
        order(subject, symmetry),
        volumes(subject, symmetry, quality, deviation),
    ];
    match problems.into_iter().flatten().next() {
        Some(problem) => Verdict::Failed(problem),
        None => Verdict::Meshed,
    }
}

/// Stages that make surfaces, each of which may take for one plane what is in one but for the precision of the file.
const FLATTENING: f64 = 2.0;

/// Judges the distance between the surfaces of body and mesh: it is no more than the deviation that was asked for, and what
/// rounding and the symmetry explain.
pub fn of_distance(symmetry: &Value, deviation: f64, measured: &Measured) -> Verdict {
    let Measured {
        distance,
        radius,
        equal,
    } = *measured;
    let most = (exactness(symmetry) + deviation) * radius + FLATTENING * equal;
    if distance <= most {
        return Verdict::Meshed;
    }
    Verdict::Failed(format!(
        "distance: the surface is off by {distance:.3e}, at most {most:.3e} was asked for"
    ))
}

/// What rounding, cleaning and the symmetry explain, relative to the radius.
fn exactness(symmetry: &Value) -> f64 {
    VOLUME + 2.0 * symmetry["residual"].as_f64().unwrap_or(f64::INFINITY)
}

fn order(subject: &Subject, symmetry: &Value) -> Option<String> {
    let known = subject.symmetry.order() as u64;
    let Some(found) = symmetry["order"].as_u64() else {
        return Some("symdetect: the report has no order".to_owned());
    };
    // About another axis than the one known, flat faces may have more; of a body of revolution, as far as the
    // tolerance goes, all orders hold.
    let Symmetry::Known { mirrors, .. } = subject.symmetry else {
        let holds = known <= 2 || found.is_multiple_of(known);
        return (!holds).then(|| format!("order: {found} found, at least {known} known"));
    };
    let more = found > known && (known <= 2 || symmetry["axisymmetric"] == Value::Bool(true));
    if !more && !found.is_multiple_of(known) {
        return Some(format!("order: {found} found, {known} known"));
    }
    // Groups of lower order may be seen from another axis.
    if found == known && known > 2 && mirrors && symmetry["mirror"] != Value::Bool(true) {
        return Some("mirror: none found".to_owned());
    }
    None
}

fn volumes(subject: &Subject, symmetry: &Value, quality: &Value, deviation: f64) -> Option<String> {
    let Some(regions) = quality["regions"].as_array() else {
        return Some("meshqual: the report has no regions".to_owned());
    };
    let body = &subject.body;
    if regions.len() != body.materials.len() {
        return Some(format!(
            "regions: {} of {}",
            regions.len(),
            body.materials.len()
        ));
    }
    let slack = exactness(symmetry) * body.boundary_area() * subject.radius;
    for (index, material) in body.materials.iter().enumerate() {
        let named = regions.iter().find(|r| r["name"] == material.name.as_str());
        // Binary STL has no names.
        let region = named.or_else(|| (regions.len() == 1).then(|| &regions[0]));
        let found = region.and_then(|r| Some((r["name"].as_str()?, r["volume"].as_f64()?)));
        let Some((name, found)) = found else {
            return Some(format!("regions: none is called {}", material.name));
        };
        let Claim {
            volume: known,
            slack: facets,
        } = subject.regions[index];
        let known = known - filled_twice(symmetry, name, subject.settled);
        let moved = deviation * subject.radius * area(subject, index);
        let slack = slack + facets + moved;
        if (found - known).abs() > slack {
            return Some(format!(
                "volume: {} has {found:e}, not {known:e} (slack {slack:.1e})",
                material.name
            ));
        }
    }
    None
}

/// Area of all that bounds a material.
fn area(subject: &Subject, material: usize) -> f64 {
    let triangles = subject.body.solid(material).map(|t| {
        let [a, b, c] = t.map(|v| subject.body.vertices[v as usize]);
        geom::measure::triangle_area(a, b, c)
    });
    triangles.sum()
}
