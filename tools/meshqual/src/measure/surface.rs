//! The surface triangles of a mesh: how many, and their area.

use crate::instances::{Copies, is_sector, wall_triangles};
use geom::measure::{corners, triangle_area};
use serde::Serialize;
use tmesh::{Document, OUTSIDE};

/// The surface triangles of a mesh.
#[derive(Clone, Debug, Serialize)]
pub struct Surface {
    /// Triangles, walls left out.
    pub triangles: u64,
    /// Area of those with material on exactly one side, model units squared.
    pub boundary_area: f64,
}

/// Counts and measures the surface triangles that are on no wall, over all instances.
pub fn surface(document: &Document) -> Surface {
    let copies = Copies::of(document).of_template;
    let walls = wall_triangles(document);
    let sector = is_sector(document);
    let mut surface = Surface {
        triangles: 0,
        boundary_area: 0.0,
    };
    for ((template, on_wall), &copies) in document.templates.iter().zip(&walls).zip(&copies) {
        let mut count = 0;
        let mut area = 0.0;
        for (t, _) in template
            .triangles
            .iter()
            .zip(on_wall)
            .filter(|(_, wall)| sector || !**wall)
        {
            count += 1;
            if (t.front == OUTSIDE) != (t.back == OUTSIDE) {
                let [a, b, c] = corners(&template.vertices, t);
                area += triangle_area(a, b, c);
            }
        }
        surface.triangles += count * copies;
        surface.boundary_area += area * copies as f64;
    }
    surface
}
