//! Vertices that are apart, from each other and from their images across mirror walls.

use geom::tolerance::PROMISE;
use mesher::Place;
use rayon::prelude::*;
use tmesh::Template;

/// How much farther apart vertices are than those that coincide: what is meshed along a shape may have a larger box than its surface had.
const APART: f64 = 2.0;

/// No edge of the template `index` is so short that its ends are taken for one vertex, and no vertex so near to a mirror wall without being
/// on it that it is taken for its image. `diagonal`: of the document's bounding box, model units.
pub fn separation(template: &Template, index: usize, diagonal: f64) -> Result<(), String> {
    let least = APART * PROMISE * diagonal;
    let at = |v: u32| template.vertices[v as usize];
    let short = template.tets.par_iter().find_map_first(|tet| {
        let [a, b, c, d] = tet.vertices;
        let edges = [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]];
        edges
            .into_iter()
            .find(|&[u, v]| at(u).distance(at(v)) <= least)
    });
    if let Some([u, v]) = short {
        return Err(format!(
            "two vertices are {:e} apart near {}",
            at(u).distance(at(v)),
            Place(at(u))
        ));
    }
    let mirrors = template.gluings.iter();
    let mirrors: Vec<_> = mirrors
        .filter_map(|g| Some((g, g.mirror_plane(index)?)))
        .collect();
    for (gluing, plane) in &mirrors {
        let mut is_on = vec![false; template.vertices.len()];
        // The two walls of half a space lie in one plane.
        let same = mirrors.iter().filter(|(_, other)| {
            let across = plane.normal.cross(other.normal);
            across.length() <= PROMISE
        });
        same.flat_map(|(gluing, _)| gluing.vertices_here())
            .for_each(|v| is_on[v as usize] = true);
        let inside = template.vertices.iter().zip(&is_on).filter(|v| !v.1);
        let distances = inside.map(|(&p, _)| (plane.distance(p).abs(), p));
        let nearest = distances.min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((distance, p)) = nearest.filter(|nearest| nearest.0 <= least) {
            return Err(format!(
                "a vertex that is not on wall '{}' is {distance:e} from it near {}",
                gluing.name,
                Place(p)
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use tmesh::{Gluing, Isometry, Tet};

    #[test]
    fn vertices_that_would_be_taken_for_one_are_refused() {
        let over_a_wall = |height: f64| Template {
            vertices: vec![
                DVec3::ZERO,
                DVec3::X,
                DVec3::Y,
                DVec3::new(0.2, 0.2, height),
            ],
            tets: vec![Tet {
                vertices: [0, 1, 2, 3],
                region: 1,
            }],
            gluings: vec![Gluing::mirror(
                "wall-level",
                0,
                Isometry::FLIP,
                [0, 1, 2],
                [],
            )],
            ..Template::default()
        };
        assert_eq!(separation(&over_a_wall(1e-9), 0, 1.0), Ok(()));
        let told = separation(&over_a_wall(1e-12), 0, 1.0).unwrap_err();
        assert!(told.contains("'wall-level' is 1e-12 from it"), "{told}");
        let mut close = over_a_wall(1e-9);
        close.gluings.clear();
        close.vertices[3] = DVec3::new(0.0, 0.0, 1e-12);
        let told = separation(&close, 0, 1.0).unwrap_err();
        assert!(told.contains("are 1e-12 apart"), "{told}");
    }
}
