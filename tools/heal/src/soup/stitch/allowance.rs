//! How far corners may be moved: by what the facets there can be off the shape that they stand for.

use crate::soup::surface::Surface;
use geom::edges::Edges;
use geom::measure::double_area_vector;
use geom::smooth::SMOOTH;
use geom::tolerance::Tolerance;
use glam::DVec3;

/// How far a corner was moved, or an edge to a corner.
#[derive(Clone, Copy, Debug)]
pub struct Gap {
    /// The corner as it is now.
    pub vertex: u32,
    /// By how much it, or the edge that it is on now, was moved.
    pub width: f64,
}

/// Triangles as they were in the file, and how far their corners and edges were moved.
pub struct Before {
    /// Places of the corners.
    pub corners: Vec<[DVec3; 3]>,
    /// The farthest that a corner or an edge was moved.
    pub moved: Vec<f64>,
    /// Where the rim of the open surface bends.
    pub rims: Vec<Bend>,
}

/// Two edges of a rim, one after the other.
pub struct Bend {
    /// The triangles that have them.
    pub sources: [u32; 2],
    /// Their ends.
    pub points: [DVec3; 3],
}

/// For each vertex of a closed surface, the largest sagitta of a facet at it, and of an edge of the rim at it.
///
/// Facets that turn by an angle `a` against each other over a width `w` stand for an arc of radius `w / a`, whose
/// sagitta is `w a / 8`; so do edges of a rim of length `w`, which a flat face may have along a curve. The narrower of
/// the two counts, as the wider one may be flat. What the movement of corners can have turned them by is no part of the
/// angle: a gap does not explain itself.
pub fn sagittas(surface: &Surface, before: &Before) -> Vec<f64> {
    let mut of_source = vec![0.0_f64; before.corners.len()];
    of_facets(surface, before, &mut of_source);
    of_rims(before, &mut of_source);
    let mut at_vertex = vec![0.0_f64; surface.points.len()];
    for (t, corners) in surface.triangles.iter().enumerate() {
        let sagitta = of_source[surface.source[t] as usize];
        for &v in corners {
            at_vertex[v as usize] = at_vertex[v as usize].max(sagitta);
        }
    }
    at_vertex
}

/// The sagitta of arcs that turn by an angle, of which some is uncertain, over the narrower of two widths; 0 for what is
/// not smooth.
fn sagitta(angle: f64, uncertain: f64, widths: [f64; 2]) -> f64 {
    if angle.is_nan() || angle > SMOOTH {
        return 0.0;
    }
    0.125 * (angle - uncertain).max(0.0) * widths[0].min(widths[1])
}

fn of_facets(surface: &Surface, before: &Before, of_source: &mut [f64]) {
    let edges = Edges::new(&surface.triangles);
    let normals: Vec<DVec3> = before
        .corners
        .iter()
        .map(|&[a, b, c]| double_area_vector(a, b, c))
        .collect();
    let tilt: Vec<f64> = (before.corners.iter().zip(&normals).zip(&before.moved))
        .map(|((corners, normal), moved)| tilt(corners, normal.length(), *moved))
        .collect();
    for e in 0..edges.len() {
        let [u, v] = edges.around(e) else { continue };
        let sources = [u, v].map(|u| surface.source[u.triangle as usize] as usize);
        let [s, t] = sources;
        if s == t {
            continue;
        }
        let alike = if u.forward == v.forward { -1.0 } else { 1.0 };
        let angle = normals[s].angle_between(normals[t] * alike);
        let [a, b] = edges.ends[e].map(|v| surface.points[v as usize]);
        let along = (b - a).normalize_or_zero();
        let widths = sources.map(|s| {
            let across = before.corners[s].map(|p| (p - a).cross(along).length());
            across.into_iter().fold(0.0, f64::max)
        });
        let sagitta = sagitta(angle, tilt[s] + tilt[t], widths);
        for s in sources {
            of_source[s] = of_source[s].max(sagitta);
        }
    }
}

fn of_rims(before: &Before, of_source: &mut [f64]) {
    for bend in &before.rims {
        let [a, b, c] = bend.points;
        let sources = bend.sources.map(|s| s as usize);
        let lengths = [a.distance(b), b.distance(c)];
        let uncertain =
            before.moved[sources[0]] / lengths[0] + before.moved[sources[1]] / lengths[1];
        let sagitta = sagitta((b - a).angle_between(c - b), uncertain, lengths);
        for s in sources {
            of_source[s] = of_source[s].max(sagitta);
        }
    }
}

/// The angle by which moving a corner turns a triangle: the movement over its smallest height.
fn tilt(corners: &[DVec3; 3], double_area: f64, moved: f64) -> f64 {
    if moved == 0.0 {
        return 0.0;
    }
    let [a, b, c] = *corners;
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    moved * longest / double_area
}

/// Gaps that are wider than allowed.
pub struct TooWide {
    /// How many there are.
    pub count: usize,
    /// The one that is farthest beyond what is allowed, and that.
    pub worst: (Gap, f64),
}

/// How wide a gap may be: twice the sagitta there, once for either side of it, and as far as points are moved onto planes,
/// too, which does not bend flat faces.
pub fn widest(sagitta: f64, tolerance: &Tolerance) -> f64 {
    2.0 * sagitta + tolerance.on_plane()
}

/// Looks for gaps that are wider than allowed at their vertex.
pub fn too_wide(gaps: &[Gap], allowed: impl Fn(u32) -> f64) -> Option<TooWide> {
    let mut found: Option<TooWide> = None;
    for &gap in gaps {
        let allowed = allowed(gap.vertex);
        if gap.width <= allowed {
            continue;
        }
        let found = found.get_or_insert(TooWide {
            count: 0,
            worst: (gap, allowed),
        });
        found.count += 1;
        if gap.width - allowed > found.worst.0.width - found.worst.1 {
            found.worst = (gap, allowed);
        }
    }
    found
}
