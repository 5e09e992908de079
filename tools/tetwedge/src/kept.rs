//! Templates whose surface has the lengths asked for already are filled once more with no vertices added to it.
//!
//! The mesher keeps all edges of a curved surface, and refuses any vertex inside of the sphere around one of them: it halves the
//! edge instead. Of triangles with sides of one length, the middle of a side is inside of the spheres around the longer ones, so that a
//! single obtuse triangle, or a single vertex wanted near a thin wall, has most of the edges of the surface halved.

use crate::done::Done;
use crate::draws::{drawn, draws, has_lengths};
use crate::score::Score;
use mesher::{Attempt, Climb, Description, Log, Plc};
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use tmesh::Template;

/// Mean length of edges, over the length asked for, below which the mesher may have halved edges for nothing: where remeshing joins
/// two of them.
const SHORT: f64 = 0.8;

/// Triangles of the surface over those it had from which on most of its edges were halved: one that is halved makes two more of three.
const HALVED: usize = 2;

/// Width of facets and length of edges between them, over the length asked for, up to which the surface may do without another vertex: that
/// of two of the longest edges that remeshing leaves, so that none misses more than one. Beyond, improvement takes long to make good of what is
/// filled so, and fails.
const WIDEST: f64 = 8.0 / 3.0;

/// The better one of a filled template and one whose surface is kept, and whether that is the other; `again` fills it.
pub fn better_of_kept(
    climb: &Climb<'_>,
    first: Done,
    attempt: Attempt,
    again: impl Fn(&Climb<'_>, Attempt) -> Option<Done> + Sync,
) -> (Done, bool) {
    let is_as_asked = first.filled.improved.is_some()
        && first.advice.is_none()
        && climb.params.switches.is_empty();
    let angle = climb.params.angle().filter(|_| is_as_asked);
    let made = &first.filled.template;
    let is_halved = made.triangles.len() > HALVED * climb.piece.template.triangles.len();
    let angle = angle.filter(|_| is_halved && is_short(climb, made) && fits(climb));
    let Some(angle) = angle else {
        return (first, false);
    };
    let here = Score::new(&first, angle);
    let quiet = Climb {
        rungs: &[],
        log: Log::new(&|_| ()),
        ..*climb
    };
    let kept = |attempt: Attempt| {
        let done = again(
            &quiet,
            Attempt {
                keeps_surface: true,
                ..attempt
            },
        )?;
        Some((Score::new(&done, angle), done))
    };
    let Some(one) = kept(attempt).filter(|one| !one.0.is_hopeless()) else {
        return (first, false);
    };
    let others: Vec<_> = (0..draws(climb, one.0.elements) as u64)
        .into_par_iter()
        .map(|draw| kept(drawn(draw, attempt.asks)))
        .collect();
    let better = |a: (Score, Done), b: (Score, Done)| match b.0.costs_less_than(&a.0) {
        true => b,
        false => a,
    };
    let (there, other) = others.into_iter().flatten().fold(one, better);
    if !there.costs_less_than(&here) {
        return (first, false);
    }
    climb.log.detail(&format!(
        "template {}: with no vertices added to the surface there are {} tetrahedra, none with an angle below {:.1} degrees",
        climb.piece.index, there.elements, there.angle,
    ));
    let failed = first.failed;
    (Done { failed, ..other }, true)
}

/// Length asked for in each region, model units, where all regions of the template have one.
fn lengths(climb: &Climb<'_>) -> Option<FxHashMap<u32, f64>> {
    let regions = climb.piece.document.regions.iter();
    let each = regions.zip(&climb.sizes.lengths);
    let known: FxHashMap<u32, f64> = each
        .filter_map(|(r, &length)| Some((r.id, length?)))
        .collect();
    // A size that changes from place to place may want the surface divided.
    let is_even = climb.sizes.local[climb.piece.index].is_none();
    (is_even && has_lengths(climb)).then_some(known)
}

/// Whether edges are shorter than asked for in the mean.
fn is_short(climb: &Climb<'_>, template: &Template) -> bool {
    let Some(lengths) = lengths(climb) else {
        return false;
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for tet in &template.tets {
        let Some(length) = lengths.get(&tet.region) else {
            return false;
        };
        let corners = tet.vertices.map(|v| template.vertices[v as usize]);
        for i in 0..4 {
            for j in 0..i {
                sum += corners[i].distance(corners[j]) / length;
                count += 1.0;
            }
        }
    }
    sum < SHORT * count
}

/// Whether the surface is not kept anyway, and no facet of it is so wide, and no edge between facets so long, that it needs more vertices.
fn fits(climb: &Climb<'_>) -> bool {
    let Ok(plc) = Plc::new(climb.piece, climb.sizes, Description::PLAIN) else {
        return false;
    };
    if plc.faces.preserve() {
        return false;
    }
    let lengths = climb.sizes.lengths.iter().flatten().copied();
    let length = lengths.fold(f64::INFINITY, f64::min);
    let template = climb.piece.template;
    let mut borders = vec![0.0; plc.facets.facets.len()];
    let mut longest = 0.0_f64;
    let mut around: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
    for (triangle, &facet) in template.triangles.iter().zip(&plc.facets.of_triangle) {
        let [a, b, c] = triangle.vertices;
        for [a, b] in [[a, b], [b, c], [c, a]] {
            around.entry([a.min(b), a.max(b)]).or_default().push(facet);
        }
    }
    for ([a, b], facets) in around {
        if !matches!(facets[..], [f, g] if f == g) {
            let length = template.vertices[a as usize].distance(template.vertices[b as usize]);
            longest = longest.max(length);
            facets.iter().for_each(|&f| borders[f as usize] += length);
        }
    }
    let facets = plc.facets.facets.iter().zip(borders);
    let widths = facets.map(|(facet, border)| 4.0 * facet.area / border);
    widths.fold(longest, f64::max) <= WIDEST * length
}
