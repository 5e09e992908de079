//! How far two surfaces are apart, and what the document says of that.

use geom::tolerance::ROUNDING;
use geom::tree::Tree;
use glam::DVec3;
use tmesh::{Deviation, Document, Template};

/// The largest distance between the surfaces of two templates, model units: both ways, at the corners of triangles, the middles of
/// their edges and their own, and at more places of those where that is a good part of the largest. n log n.
pub fn apart(first: &Template, second: &Template) -> f64 {
    one_way(first, second).max(one_way(second, first))
}

/// Triangles are looked at once more where they are as far as this part of the largest distance. A choice: between the places that were looked at
/// first, a vase that was remeshed is 1.13 times as far.
const WORTH_MORE: f64 = 0.5;

/// Parts of the edges of triangles that are looked at once more.
const PARTS: u32 = 8;

fn one_way(from: &Template, to: &Template) -> f64 {
    let corners = |template: &Template, t: &tmesh::Triangle| -> [DVec3; 3] {
        t.vertices.map(|v| template.vertices[v as usize])
    };
    let tree = Tree::new(to.triangles.iter().map(|t| corners(to, t)));
    let far = |points: &mut dyn Iterator<Item = DVec3>| {
        let distances = points.filter_map(|p| Some(tree.nearest(p, f64::INFINITY)?.distance));
        distances.fold(0.0, f64::max)
    };
    let first = from.triangles.iter().map(|t| {
        let [a, b, c] = corners(from, t);
        let middles = [a + b, b + c, c + a].map(|sum| 0.5 * sum);
        let own = [(a + b + c) / 3.0];
        far(&mut [a, b, c].into_iter().chain(middles).chain(own))
    });
    let first: Vec<f64> = first.collect();
    let farthest = first.iter().copied().fold(0.0, f64::max);
    let worth = from.triangles.iter().zip(&first);
    let worth = worth.filter(|&(_, &far)| far > 0.0 && far >= WORTH_MORE * farthest);
    let more = worth.map(|(t, _)| far(&mut lattice(corners(from, t))));
    more.fold(farthest, f64::max)
}

/// Points of a triangle, evenly.
fn lattice([a, b, c]: [DVec3; 3]) -> impl Iterator<Item = DVec3> {
    let step = 1.0 / f64::from(PARTS);
    (0..=PARTS).flat_map(move |i| {
        let along = move |j: u32| a + (f64::from(i) * (b - a) + f64::from(j) * (c - a)) * step;
        (0..=PARTS - i).map(along)
    })
}

/// Writes into the document how much farther, in model units, its surface is from the input's.
pub fn note_moved(document: &mut Document, by: f64) {
    let radius = document.symmetry.as_ref().map(|found| found.radius);
    if radius.is_some_and(|radius| by > ROUNDING * radius) {
        document.add_displacement(by);
    }
}

/// Writes into the document, where it says how far its surface is from the input's, that this is so far, model units. What it may be farther
/// gets less by that.
pub fn note_deviation(document: &mut Document, farthest: f64) {
    if let Some(radius) = document.symmetry.as_ref().map(|found| found.radius)
        && let Some(Deviation::Within(known)) = document.wishes.deviation
        && farthest > known * radius
    {
        let deviation = farthest / radius;
        let left = document.wishes.moved.map(|moved| known + moved - deviation);
        document.wishes.deviation = Some(Deviation::Within(deviation));
        document.wishes.moved = left.filter(|&left| left > ROUNDING);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{Axis, Group, OUTSIDE, Symmetry, Triangle};

    fn template(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Template {
        let like = |&vertices: &[u32; 3]| Triangle {
            vertices,
            marker: 0,
            front: OUTSIDE,
            back: 1,
        };
        Template {
            vertices: vertices.iter().copied().map(DVec3::from_array).collect(),
            triangles: triangles.iter().map(like).collect(),
            ..Template::default()
        }
    }

    #[test]
    fn what_is_farthest_between_the_places_looked_at_first_is_seen() {
        let flat = template(
            &[[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]],
            &[[0, 1, 2]],
        );
        // A valley that is deepest below a quarter of an edge.
        let deep = 0.01;
        let at = |x: f64, z: f64| [[x, -9.0, z], [x, 9.0, z]];
        let valley = [at(0.0, 0.0), at(0.75, -deep), at(3.0, 0.0)].concat();
        let valley = template(&valley, &[[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]]);
        let seen = one_way(&flat, &valley);
        assert!((0.995 * deep..=deep).contains(&seen), "{seen}");
    }

    #[test]
    fn what_is_said_of_the_surface_grows_and_what_it_may_be_stays() {
        let mut document = Document::single(Template::default());
        document.symmetry = Some(Symmetry {
            group: Group::TRIVIAL,
            axis: Axis {
                point: [0.0; 3],
                direction: [0.0, 0.0, 1.0],
            },
            reference: [1.0, 0.0, 0.0],
            residual: 0.0,
            tolerance: 1e-3,
            axisymmetric: false,
            radius: 2.0,
            regions: Vec::new(),
        });
        note_deviation(&mut document, 0.5);
        assert_eq!(document.wishes.deviation, None);
        document.wishes.deviation = Some(Deviation::Within(0.125));
        document.wishes.moved = Some(0.375);
        note_deviation(&mut document, 0.2);
        assert_eq!(document.wishes.deviation, Some(Deviation::Within(0.125)));
        note_deviation(&mut document, 0.5);
        assert_eq!(document.wishes.deviation, Some(Deviation::Within(0.25)));
        assert_eq!(document.wishes.moved, Some(0.25));
        note_deviation(&mut document, 1.0);
        assert_eq!(document.wishes.deviation, Some(Deviation::Within(0.5)));
        assert_eq!(document.wishes.moved, None);
    }
}
