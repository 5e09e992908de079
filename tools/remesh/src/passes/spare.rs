//! Leaving out vertices that the shape does not need.

use super::collapse::collapse;
use super::reduced::Reduced;
use super::remeshed::{Remeshed, Told};
use super::worth::DETAIL;
use crate::input::{Rules, Surface};
use crate::mesh::Mesh;
use crate::shape::{Allowance, Curves, Envelope, Patches};
use geom::flat::FOLD_COSINE;

/// Leaves out vertices inside of flat facets and of straight edges between them, where they are nearer to others than a quarter of the facets' width.
/// `None` where there are none. n log n.
///
/// Facets are drawn with such vertices where something was cut off or joined, and cuts of a wedge pass them closely. The mesher keeps all vertices that
/// it is given, with elements as small as they are apart.
pub fn without_spare(surface: &Surface, rules: &Rules<'_>) -> Option<Reduced> {
    let patches = Patches::of_facets(surface, rules);
    let within = Rules {
        feature: FOLD_COSINE,
        deviation: rules.flat,
        noise: rules.flat,
        nearer: &[],
        ..*rules
    };
    let mut curves = Curves::new(surface, &within, &patches);
    curves.reach.fill(rules.flat);
    let widths = patches.widths(surface);
    let mut width = vec![f64::INFINITY; surface.points.len()];
    for (corners, &patch) in surface.triangles.iter().zip(&patches.of) {
        for &v in corners {
            width[v as usize] = width[v as usize].min(widths[patch as usize]);
        }
    }
    let allowance = Allowance {
        reach: vec![rules.flat; surface.triangles.len()],
        size: width.clone(),
        width,
    };
    let envelope = Envelope::new((surface, &within), &patches, &curves, &allowance);
    let of = (&patches, &curves);
    let mut mesh = Mesh::new(surface, within, of, (&envelope, &allowance));
    let mut told = Told::default();
    // Each round takes about half of what may go.
    for _ in 0..=surface.points.len().ilog2() {
        let is_spare = |mesh: &Mesh<'_>, [from, to]: [u32; 2]| {
            mesh.length([from, to]) < DETAIL * mesh.width[from as usize]
        };
        let shortest = mesh.edges_by(|[a, b]| {
            let goes = is_spare(&mesh, [a, b]) || is_spare(&mesh, [b, a]);
            goes.then(|| mesh.length([a, b]))
        });
        let mut done = 0;
        for [a, b] in shortest {
            let goes = |ends: &[u32; 2]| {
                !mesh.at_edge(a, b).is_empty()
                    && is_spare(&mesh, *ends)
                    && collapse(&mut mesh, *ends, true)
            };
            done += usize::from([[a, b], [b, a]].iter().any(goes));
        }
        told.collapsed += done;
        if done == 0 {
            break;
        }
    }
    if told.is_nothing() {
        return None;
    }
    let nearer: Vec<f64> = (0..surface.points.len())
        .map(|v| rules.deviation_at(v))
        .collect();
    Some(Reduced::new(
        Remeshed::taken(surface, mesh, told),
        rules,
        &nearer,
    ))
}
