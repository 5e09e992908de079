//! Templates whose surface has the lengths asked for already, which may be filled with no vertices added to it.
//!
//! The mesher keeps all edges of a curved surface, and refuses any vertex inside of the sphere around one of them: it halves the
//! edge instead. Of triangles with sides of one length, the middle of a side is inside of the spheres around the longer ones, so that a
//! single obtuse triangle, or a single vertex wanted near a thin wall, has most of the edges of the surface halved.

use crate::draws::has_lengths;
use mesher::{Climb, Description, Plc};
use rustc_hash::FxHashMap;
use tmesh::Template;

/// Mean length of edges, over the length asked for, below which the mesher may have halved edges for nothing: where remeshing joins
/// two of them.
const SHORT: f64 = 0.8;

/// Width of facets and length of edges between them, over the length asked for, up to which the surface may do without another vertex: that
/// of two of the longest edges that remeshing leaves, so that none misses more than one. Beyond, improvement takes long to make good of what is
/// filled so, and fails.
const WIDEST: f64 = 8.0 / 3.0;

/// Whether a filled template has shorter edges than asked for, and one whose surface is kept may do better.
pub fn may_keep(climb: &Climb<'_>, filled: &Template) -> bool {
    is_short(climb, filled) && fits(climb)
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
