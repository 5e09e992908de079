//! What is known of the cut faces of a sector: pairs, maps, the axis.

use super::walls::WallNames;
use super::{Coupling, Middles};
use glam::DMat3;
use rustc_hash::FxHashSet;
use tmesh::{Document, Isometry};

/// The couplings of all seams and hubs. Template `t` is placed by `shown[t]`, its points begin at
/// `first[t]`. Seams of several templates with the same faces are one coupling.
pub fn couplings(document: &Document, shown: &[Isometry], first: &[u32]) -> Vec<Coupling> {
    let mut all: Vec<Coupling> = Vec::new();
    let mut names = WallNames::default();
    let mut first_triangle = Vec::with_capacity(document.templates.len());
    let mut count = 0;
    for template in &document.templates {
        first_triangle.push(count);
        count += template.triangles.len() as u64;
    }
    for (t, template) in document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            let faces = names.of(t, gluing);
            if gluing.is_mirror(t) {
                continue;
            }
            let other = gluing.other as usize;
            let turn = shown[t]
                .compose(gluing.step)
                .compose(shown[other].inverse());
            let points = gluing
                .vertex_pairs
                .iter()
                .map(|&[here, there]| [first[other] + there, first[t] + here]);
            let triangles = gluing.triangle_pairs.iter().map(|&[here, there]| {
                [
                    first_triangle[other] + u64::from(there),
                    first_triangle[t] + u64::from(here),
                ]
            });
            // Faces of several templates that have one name are one face, but for those of hubs.
            let own = gluing.is_seam(t);
            let same = all.iter().position(|c| [c.low, c.high] == faces && own);
            let at = same.unwrap_or_else(|| {
                let mut coupling = coupling(document, &gluing.name, faces, turn);
                coupling.sectors = coupling.sectors.filter(|_| own);
                all.push(coupling);
                all.len() - 1
            });
            all[at].points.extend(points);
            all[at].triangles.extend(triangles);
        }
    }
    for coupling in &mut all {
        coupling.points.sort_unstable();
        coupling.triangles.sort_unstable();
    }
    all
}

/// A coupling without pairs.
fn coupling(document: &Document, name: &str, walls: [u32; 2], map: Isometry) -> Coupling {
    let frame = document.frame;
    let matrix = match map == Isometry::IDENTITY {
        // To the bit: what it relates is one.
        true => DMat3::IDENTITY,
        false => frame.rotation * map.matrix() * frame.rotation.transpose(),
    };
    let turns = !map.mirrored() && !map.flipped();
    // One step backwards is a step forwards about the opposite direction.
    let backwards = turns && map.n() > 2 && map.k() == map.n() - 1;
    let direction = if backwards {
        -frame.rotation.z_axis
    } else {
        frame.rotation.z_axis
    };
    Coupling {
        name: name.to_owned(),
        low: walls[0],
        high: walls[1],
        sectors: (turns && (map.k() == 1 || backwards)).then_some(map.n()),
        matrix,
        translation: frame.origin - matrix * frame.origin,
        axis: [frame.origin, frame.origin + direction],
        points: Vec::new(),
        triangles: Vec::new(),
    }
}

/// Edges of surface triangles that lie on the axis, from low to high along it.
pub fn axis_edges(document: &Document, first: &[u32], middles: Option<&Middles>) -> Vec<[u32; 2]> {
    let mut all = Vec::new();
    for (t, template) in document.templates.iter().enumerate() {
        let on_axis = |v: u32| template.axis.binary_search(&v).is_ok();
        let mut edges = Vec::new();
        let mut seen = FxHashSet::default();
        for (i, triangle) in template.triangles.iter().enumerate() {
            let [a, b, c] = triangle.vertices;
            for (k, [p, q]) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
                if !(on_axis(p) && on_axis(q) && seen.insert([p.min(q), p.max(q)])) {
                    continue;
                }
                match middles {
                    Some(all) => {
                        let m = all.triangles[t][i][k];
                        edges.extend([[p, m], [m, q]]);
                    }
                    None => edges.push([p, q]),
                }
            }
        }
        let height = |v: u32| template.vertices[v as usize].z;
        for edge in &mut edges {
            if height(edge[0]) > height(edge[1]) {
                edge.swap(0, 1);
            }
        }
        edges.sort_by(|a, b| height(a[0]).total_cmp(&height(b[0])).then(a.cmp(b)));
        all.extend(edges.into_iter().map(|e| e.map(|v| first[t] + v)));
    }
    all
}
