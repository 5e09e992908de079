//! The body in outline, seen along its axis and from the side.

use geom::edges::{Edges, apex_of};
use geom::measure::double_area_vector;
use glam::DVec3;
use tmesh::{Frame, Symmetry, Template};

/// Cosine of the angle from which on an edge is drawn: 20 degrees.
const SHARP: f64 = 0.94;
/// Segments drawn at most; the longest ones.
const MOST: usize = 5_000;

/// A line in the plane of a view.
pub type Segment = [[f64; 2]; 2];

/// Sharp edges, edges between regions and outlines of a surface in two views, in units of the radius
/// about the axis, the centre at the origin.
pub struct Views {
    /// Along the axis: the mirror direction to the right, its left normal up.
    pub top: Vec<Segment>,
    /// From the side: the mirror direction to the right, the axis up.
    pub side: Vec<Segment>,
    /// Lowest and highest place along the axis.
    pub span: [f64; 2],
    /// Largest distance from the axis.
    pub reach: f64,
}

/// The frame of a symmetry, in world coordinates.
pub fn frame_of(symmetry: &Symmetry) -> Frame {
    Frame::from_axis(
        DVec3::from_array(symmetry.axis.point),
        DVec3::from_array(symmetry.axis.direction),
        DVec3::from_array(symmetry.reference),
    )
    .unwrap_or(Frame::IDENTITY)
}

/// Draws a surface. O(n log n).
pub fn views(template: &Template, symmetry: &Symmetry) -> Views {
    let frame = frame_of(symmetry);
    let scale = match symmetry.radius > 0.0 {
        true => 1.0 / symmetry.radius,
        false => 1.0,
    };
    let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
    let points: Vec<DVec3> = (template.vertices.iter())
        .map(|p| frame.to_canonical(*p) * scale)
        .collect();
    let normals: Vec<DVec3> = (triangles.iter())
        .map(|t| {
            let [a, b, c] = t.map(|v| points[v as usize]);
            double_area_vector(a, b, c).normalize_or_zero()
        })
        .collect();
    let (mut span, mut reach) = ([f64::INFINITY, f64::NEG_INFINITY], 0.0_f64);
    for p in triangles.iter().flatten().map(|v| points[*v as usize]) {
        span = [span[0].min(p.z), span[1].max(p.z)];
        reach = reach.max(p.truncate().length());
    }
    let edges = Edges::new(&triangles);
    let view = |along: DVec3, flat: fn(DVec3) -> [f64; 2]| {
        let mut segments: Vec<(f64, Segment)> = Vec::new();
        for edge in 0..edges.len() {
            let drawn = match edges.around(edge) {
                [u, v] => {
                    let (t, s) = (u.triangle as usize, v.triangle as usize);
                    let alike = if u.forward == v.forward { -1.0 } else { 1.0 };
                    let (n, m) = (normals[t], normals[s] * alike);
                    let apex = points[apex_of(&triangles[s], v.corner) as usize];
                    let start = points[edges.ends[edge][0] as usize];
                    let faces = [n, m].map(|n| n.dot(along));
                    // An outline: one side faces the viewer and the other does not.
                    n.dot(m) < SHARP
                        || (faces[0] * faces[1] < 0.0 && n.dot(apex - start).abs() > 1e-9)
                }
                _ => true,
            };
            if drawn {
                let segment = edges.ends[edge].map(|v| flat(points[v as usize]));
                let [[a, b], [c, d]] = segment;
                segments.push((libm::hypot(c - a, d - b), segment));
            }
        }
        segments.retain(|s| s.0 > 2e-3);
        segments.sort_by(|a, b| b.0.total_cmp(&a.0));
        segments.truncate(MOST);
        segments.into_iter().map(|s| s.1).collect()
    };
    Views {
        top: view(DVec3::Z, |p| [p.x, p.y]),
        side: view(DVec3::Y, |p| [p.x, p.z]),
        span,
        reach,
    }
}
