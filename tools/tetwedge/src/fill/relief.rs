//! Vertices on facets that are not flat.

use super::orientations::Oriented;
use glam::DVec3;
use mesher::Plc;
use rustc_hash::FxHashMap;
use tmesh::{Template, Tet};

/// Where the vertices inside of uneven facets are on these, in their order; `facets` has the facet of each triangle. Those of walls
/// and of the axis stay there, and are left out.
pub fn on_relief(plc: &Plc, facets: &[usize], template: &Template) -> Vec<(u32, DVec3)> {
    if !plc.relief.is_there() {
        return Vec::new();
    }
    let mut stays = vec![false; template.vertices.len()];
    let of_walls = template.gluings.iter().flat_map(|g| &g.vertex_pairs);
    for &v in of_walls.flatten().chain(&template.axis) {
        // The second of a pair may be another template's.
        if let Some(stays) = stays.get_mut(v as usize) {
            *stays = true;
        }
    }
    let triangles = template.triangles.iter().zip(facets);
    let triangles = triangles.map(|(t, &facet)| (t.vertices, facet));
    let mut places = plc.relief.places(&template.vertices, triangles);
    places.retain(|&(v, _)| !stays[v as usize]);
    places
}

/// Moves vertices to their `places`, one after the other, where all of its tetrahedra stay positive: beside a
/// sharp edge elements are smaller than a facet is uneven, and a vertex that was moved along its plane may have to stay there.
pub fn move_within_elements(template: &mut Template, places: &[(u32, DVec3)], oriented: &Oriented) {
    let mut around: FxHashMap<u32, Vec<[u32; 4]>> =
        places.iter().map(|&(v, _)| (v, Vec::new())).collect();
    for Tet { vertices, .. } in &template.tets {
        for v in vertices {
            if let Some(around) = around.get_mut(v) {
                around.push(*vertices);
            }
        }
    }
    for &(v, there) in places {
        let from = std::mem::replace(&mut template.vertices[v as usize], there);
        let at = |v: u32| template.vertices[v as usize];
        if !around[&v].iter().all(|t| oriented.holds(t.map(at))) {
            template.vertices[v as usize] = from;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_that_would_turn_an_element_over_stays() {
        let mut template = Template {
            vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            tets: vec![Tet {
                vertices: [0, 1, 2, 3],
                region: 1,
            }],
            ..Template::default()
        };
        let before = template.vertices.clone();
        let oriented = Oriented::within(1.0);
        move_within_elements(&mut template, &[(3, -DVec3::Z), (2, DVec3::X)], &oriented);
        assert_eq!(template.vertices, before);
        move_within_elements(&mut template, &[(3, 0.5 * DVec3::Z)], &oriented);
        assert_eq!(template.vertices[3], 0.5 * DVec3::Z);
    }
}
