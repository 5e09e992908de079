//! How far two surfaces are apart, and what the document says of that.

use geom::tolerance::ROUNDING;
use geom::tree::Tree;
use glam::DVec3;
use tmesh::{Document, Template};

/// The largest distance between the surfaces of two templates, model units: both ways, at the corners of triangles, the middles of
/// their edges and their own. n log n.
pub fn apart(first: &Template, second: &Template) -> f64 {
    one_way(first, second).max(one_way(second, first))
}

fn one_way(from: &Template, to: &Template) -> f64 {
    let corners = |template: &Template, t: &tmesh::Triangle| -> [DVec3; 3] {
        t.vertices.map(|v| template.vertices[v as usize])
    };
    let tree = Tree::new(to.triangles.iter().map(|t| corners(to, t)));
    let points = from.triangles.iter().flat_map(|t| {
        let [a, b, c] = corners(from, t);
        let middles = [a + b, b + c, c + a].map(|sum| 0.5 * sum);
        [a, b, c]
            .into_iter()
            .chain(middles)
            .chain([(a + b + c) / 3.0])
    });
    let distances = points.filter_map(|p| Some(tree.nearest(p, f64::INFINITY)?.distance));
    distances.fold(0.0, f64::max)
}

/// Writes into the document how much farther, in model units, its surface is from the input's.
pub fn note_moved(document: &mut Document, by: f64) {
    if let Some(radius) = document.symmetry.as_ref().map(|found| found.radius)
        && by > ROUNDING * radius
    {
        let earlier = document.wishes.moved.unwrap_or(0.0);
        document.wishes.moved = Some(earlier + by / radius);
    }
}
