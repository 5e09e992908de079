//! Gaps between points that should be one.

use super::closure::odd_edges;
use super::surface::Surface;
use crate::document::tolerance;
use crate::near::near_points;
use crate::words::short;
use geom::edges::Edges;
use glam::DVec3;
use interchange::text::counted;

/// Gaps are no longer than this share of the shortest edge along them. A larger share would let the
/// closing of a gap fold triangles over.
const SMALL: f64 = 0.1;

/// Gaps that are closed where that closes the whole surface, as shares of its size.
const GAPS: [f64; 4] = [1e-7, 1e-6, 1e-5, 1e-4];

/// Joins ends of odd edges: those that differ by rounding, and if that does not close the surface,
/// those within the smallest of a few shares of the size that does. Says so if that did anything.
pub fn close_gaps(
    surface: &mut Surface,
    edges: &Edges,
    odd: &[usize],
    relative_precision: f64,
) -> Option<String> {
    let mut ends: Vec<u32> = odd.iter().flat_map(|&e| edges.ends[e]).collect();
    ends.sort_unstable();
    ends.dedup();
    let rounding = tolerance(&surface.points, relative_precision).equal();
    let by_rounding = joined(surface, &ends, rounding);
    let is_closed = |triangles: &[[u32; 3]]| odd_edges(&Edges::new(triangles)).is_empty();
    let rounded = by_rounding.as_ref().map(|(_, triangles)| triangles);
    if rounded.is_none_or(|triangles| !is_closed(triangles)) {
        let size = extent(surface);
        // Gaps are small beside the edges along them.
        let mut lengths: Vec<f64> = (odd.iter())
            .map(|&e| {
                let [a, b] = edges.ends[e].map(|v| surface.points[v as usize]);
                (b - a).length()
            })
            .collect();
        lengths.sort_by(f64::total_cmp);
        let shortest = lengths.first().copied().unwrap_or(0.0);
        for share in GAPS {
            let gap = share * size;
            if gap <= rounding || gap > SMALL * shortest {
                continue;
            }
            if let Some((count, triangles)) = joined(surface, &ends, gap)
                && is_closed(&triangles)
            {
                surface.triangles = triangles;
                surface.drop_degenerate();
                return Some(format!(
                    "{} to within {}, {share:e} of the size: joined, which closes the surface",
                    counted(count, "point agrees", "points agree"),
                    short(gap)
                ));
            }
        }
    }
    let (count, triangles) = by_rounding?;
    surface.triangles = triangles;
    surface.drop_degenerate();
    Some(format!(
        "{} to within {} of each other, the rounding of the file: joined",
        counted(count, "point agrees", "points agree"),
        short(rounding)
    ))
}

/// The number of points among `ends` that others within `tolerance` stand for, and the triangles
/// with those; `None` for none.
fn joined(surface: &Surface, ends: &[u32], tolerance: f64) -> Option<(usize, Vec<[u32; 3]>)> {
    let pairs = near_points(&surface.points, ends, tolerance);
    if pairs.is_empty() {
        return None;
    }
    let mut new_id: Vec<u32> = (0..surface.points.len() as u32).collect();
    for &(from, to) in &pairs {
        new_id[from as usize] = to;
    }
    let triangles = surface.triangles.iter();
    let triangles = triangles.map(|t| t.map(|v| new_id[v as usize])).collect();
    Some((pairs.len(), triangles))
}

/// Diagonal of the bounding box.
fn extent(surface: &Surface) -> f64 {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for p in surface
        .triangles
        .iter()
        .flatten()
        .map(|v| surface.points[*v as usize])
    {
        low = low.min(p);
        high = high.max(p);
    }
    (high - low).length()
}
