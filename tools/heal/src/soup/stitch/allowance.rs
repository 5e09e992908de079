//! How far corners may be moved: by what the facets there can be off the shape that they stand for.

use crate::soup::surface::Surface;
use geom::edges::Edges;
use geom::measure::double_area_vector;
use glam::DVec3;

/// Angle between facets up to which they may stand for one smooth surface, radians: 30 degrees. A choice: CAD programs
/// turn by up to 0.5 radians, 28.6 degrees, from facet to facet unless told otherwise. With a larger angle the edges of
/// prisms count as arcs, and with a smaller one coarse exports as prisms.
const SMOOTH: f64 = std::f64::consts::PI / 6.0;

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
}

/// For each vertex of a closed surface, the largest sagitta of a facet at it.
///
/// Facets that turn by an angle `a` against each other over a width `w` stand for an arc of radius `w / a`, whose
/// sagitta is `w a / 8`; where one of the two is flat, the other turns by all of that at its one side, which makes up for
/// twice of it. The narrower of the two counts, as the wider one may be flat. What the movement
/// of corners can have turned the facets by is no part of the angle: a gap does not explain itself.
pub fn sagittas(surface: &Surface, before: &Before) -> Vec<f64> {
    let edges = Edges::new(&surface.triangles);
    let normals: Vec<DVec3> = before
        .corners
        .iter()
        .map(|&[a, b, c]| double_area_vector(a, b, c))
        .collect();
    let tilt: Vec<f64> = (before.corners.iter().zip(&normals).zip(&before.moved))
        .map(|((corners, normal), moved)| tilt(corners, normal.length(), *moved))
        .collect();
    let mut of_source = vec![0.0_f64; before.corners.len()];
    for e in 0..edges.len() {
        let [u, v] = edges.around(e) else { continue };
        let sources = [u, v].map(|u| surface.source[u.triangle as usize] as usize);
        let [s, t] = sources;
        let alike = if u.forward == v.forward { -1.0 } else { 1.0 };
        let angle = normals[s].angle_between(normals[t] * alike);
        if s == t || !(angle <= SMOOTH) {
            continue;
        }
        let [a, b] = edges.ends[e].map(|v| surface.points[v as usize]);
        let along = (b - a).normalize_or_zero();
        let width = |s: usize| {
            let across = before.corners[s].map(|p| (p - a).cross(along).length());
            across.into_iter().fold(0.0, f64::max)
        };
        let turn = (angle - tilt[s] - tilt[t]).max(0.0);
        let sagitta = 0.25 * turn * width(s).min(width(t));
        for s in sources {
            of_source[s] = of_source[s].max(sagitta);
        }
    }
    let mut at_vertex = vec![0.0_f64; surface.points.len()];
    for (t, corners) in surface.triangles.iter().enumerate() {
        let sagitta = of_source[surface.source[t] as usize];
        for &v in corners {
            at_vertex[v as usize] = at_vertex[v as usize].max(sagitta);
        }
    }
    at_vertex
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

/// Looks for gaps that are wider than twice the sagitta there, one for either side of the gap, and `flat`, which is allowed
/// where facets hide nothing.
pub fn too_wide(gaps: &[Gap], sagitta: &[f64], flat: f64) -> Option<TooWide> {
    let mut found: Option<TooWide> = None;
    for &gap in gaps {
        let allowed = 2.0 * sagitta[gap.vertex as usize] + flat;
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
