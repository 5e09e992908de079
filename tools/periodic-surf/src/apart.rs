//! How far two surfaces are apart.

use geom::tree::Tree;
use glam::DVec3;
use tmesh::Template;

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
