//! The part of a plane that segments enclose.

use geom::cdt::{Cdt, CdtError};

/// Triangles of the part of the plane that `segments` enclose, counter-clockwise, without the parts
/// around `holes`: what can be reached from infinity or from a hole without crossing a segment is
/// left out. No points are added.
///
/// # Errors
/// Crossing segments, coincident points.
pub fn enclosed(
    points: &[[f64; 2]],
    segments: &[[u32; 2]],
    holes: &[[f64; 2]],
) -> Result<Vec<[u32; 3]>, CdtError> {
    if points.len() < 3 {
        return Ok(Vec::new());
    }
    let cdt = Cdt::new(points, segments)?;
    let inside = cdt.enclosed(holes);
    let triangles = cdt.triangles.iter().zip(inside);
    Ok(triangles.filter(|t| t.1).map(|t| *t.0).collect())
}
