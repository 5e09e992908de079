//! Decimating what is drawn more finely than coordinates tell.

use super::collapse::collapse;
use super::flip::flip;
use super::reduced::Reduced;
use super::remeshed::{Remeshed, Told};
use crate::input::{Rules, Surface};
use crate::mesh::Mesh;
use crate::shape::{Allowance, Curves, Envelope, Patches, untold};
use geom::measure::double_area_vector;
use glam::DVec3;

/// Decimates the curved faces of a surface that have triangles without a direction, within what coordinates are uncertain by.
/// `None` where there are none. n log n.
///
/// Where the lines of a fine drawing meet, as at the poles of rounded corners, triangles are as low as coordinates are uncertain:
/// folds between them are sharp by chance, and what is within the uncertainty of a plane has jagged borders. Facets that are
/// as wide as the surface allows within that uncertainty turn by far more than it.
pub fn decimated(surface: &Surface, rules: &Rules<'_>) -> Option<Reduced> {
    let least = rules.told().min(rules.deviation);
    let fine = Fine::new(surface, rules, least)?;
    let smooth = Rules {
        feature: -1.0,
        deviation: least,
        flat: 0.0,
        nearer: &[],
        links: &[],
        ..*rules
    };
    let patches = Patches::of_labels(surface, &smooth);
    let mut curves = Curves::new(surface, &smooth, &patches);
    curves.reach.fill(least);
    // However short edges are, others may go in their place.
    let none = vec![f64::MIN_POSITIVE; surface.points.len()];
    let allowance = Allowance {
        reach: vec![least; surface.triangles.len()],
        size: none.clone(),
        width: none,
    };
    let envelope = Envelope::new((surface, &smooth), &patches, &curves, &allowance);
    let of = (&patches, &curves);
    let mut mesh = Mesh::new(surface, smooth, of, (&envelope, &allowance));
    let mut nearer: Vec<f64> = (0..surface.points.len())
        .map(|v| rules.deviation_at(v))
        .collect();
    let mut told = Told::default();
    // Each round takes about half of what may go.
    for _ in 0..=surface.points.len().ilog2() {
        let mut done = 0;
        for [a, b] in by_length(&mesh) {
            let mut goes = |ends: &[u32; 2]| {
                fine.may_go(*ends)
                    && !mesh.at_edge(a, b).is_empty()
                    && collapse(&mut mesh, *ends, true)
            };
            if let Some([from, to]) = [[a, b], [b, a]].into_iter().find(&mut goes) {
                nearer[to as usize] = nearer[to as usize].min(nearer[from as usize]);
                done += 1;
            }
        }
        told.collapsed += done;
        if done == 0 {
            break;
        }
        for [a, b] in mesh.edges() {
            if fine.may_flip([a, b]) {
                told.flipped += usize::from(flip(&mut mesh, [a, b]));
            }
        }
    }
    if told.is_nothing() {
        return None;
    }
    Some(Reduced::new(
        Remeshed::taken(surface, mesh, told),
        rules,
        &nearer,
    ))
}

/// The vertices that may go.
struct Fine {
    /// Whether each is one of a curved patch that has triangles without a direction, or is drawn so finely that coordinates do not tell
    /// how it turns, or of such a triangle wherever that is.
    is: Vec<bool>,
    /// The flat faces that each is in: they keep their planes.
    faces: Vec<Vec<u32>>,
}

impl Fine {
    fn new(surface: &Surface, rules: &Rules<'_>, least: f64) -> Option<Self> {
        let height = |t: u32| {
            let [a, b, c] = surface.corners(t);
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            double_area_vector(a, b, c).length() / longest
        };
        let heights: Vec<f64> = (0..surface.triangles.len() as u32).map(height).collect();
        // Facets that are higher turn by more than is uncertain, if what they stand for is bent as little as the surface is large.
        let low = surface.points.iter().copied().reduce(DVec3::min)?;
        let high = surface.points.iter().copied().reduce(DVec3::max)?;
        let most = (2.0 * rules.flat * low.distance(high)).sqrt().max(least);
        if heights.iter().all(|height| *height > most) {
            return None;
        }
        let low: Vec<bool> = heights.iter().map(|height| *height <= least).collect();
        let patches = Patches::new(surface, rules);
        let untold = untold(surface, rules, &patches);
        let mut has_low = vec![false; patches.planes.len()];
        let mut has_other = has_low.clone();
        for (&patch, &is_low) in patches.of.iter().zip(&low) {
            has_low[patch as usize] |= is_low;
            has_other[patch as usize] |= !is_low;
        }
        // Few low triangles are no face, however they lie.
        let is_face = |p: usize| patches.planes[p].is_some() && has_other[p];
        let is_fine = |p: usize| !is_face(p) && (has_low[p] || untold[p]);
        if !(0..patches.planes.len()).any(is_fine) {
            return None;
        }
        let mut fine = Self {
            is: vec![false; surface.points.len()],
            faces: vec![Vec::new(); surface.points.len()],
        };
        for (t, corners) in surface.triangles.iter().enumerate() {
            let patch = patches.of[t] as usize;
            for &v in corners {
                // Some of what is low counts as a part of a flat face beside it.
                fine.is[v as usize] |= is_fine(patch) || low[t];
                let faces = &mut fine.faces[v as usize];
                if is_face(patch) && !faces.contains(&(patch as u32)) {
                    faces.push(patch as u32);
                }
            }
        }
        // What is glued to something goes together with it.
        let glued = rules
            .links
            .iter()
            .flat_map(|link| link.pairs.as_flattened());
        glued.for_each(|&v| fine.is[v as usize] = false);
        Some(fine)
    }

    /// Whether the first vertex may become the second one.
    fn may_go(&self, [from, to]: [u32; 2]) -> bool {
        let [here, there] = [from, to].map(|v| &self.faces[v as usize]);
        self.is[from as usize] && here.iter().all(|face| there.contains(face))
    }

    /// Whether an edge may be flipped: both ends are vertices that may go, and in no flat face.
    fn may_flip(&self, ends: [u32; 2]) -> bool {
        let mut ends = ends.into_iter().map(|v| v as usize);
        ends.all(|v| self.is[v] && self.faces[v].is_empty())
    }
}

/// All edges, the shortest first.
fn by_length(mesh: &Mesh<'_>) -> Vec<[u32; 2]> {
    let mut edges = mesh.edges();
    edges.sort_by(|x, y| mesh.length(*x).total_cmp(&mesh.length(*y)).then(x.cmp(y)));
    edges
}
