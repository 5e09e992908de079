//! The smooth faces that facets belong to.

use crate::imprint::Curves;
use crate::soup::Surface;
use geom::edges::Edges;
use geom::sets::DisjointSets;

/// What the edges of facets tell of these.
pub struct Faces {
    /// The edge that begins at each corner.
    pub edge: Vec<[u32; 3]>,
    /// Whether that edge stays where it is: the smooth face, or the group, ends there, or the face is not curved.
    pub stays: Vec<[bool; 3]>,
    /// Whether each facet belongs to a smooth face that is curved somewhere, of a solid that is closed and oriented.
    pub is_curved: Vec<bool>,
}

impl Faces {
    /// Joins facets over smooth edges. O(n log n) in the facets around one edge, linear else.
    pub fn new(surface: &Surface, edges: &Edges, curves: &Curves, equal: f64) -> Self {
        let count = surface.triangles.len();
        let solid = |t: u32| surface.solid[t as usize];
        let mut edge = vec![[0; 3]; count];
        let mut stays = vec![[true; 3]; count];
        let mut is_closed = vec![true; surface.solids.len()];
        let mut sets = DisjointSets::new(count);
        for e in 0..edges.len() {
            let mut around = edges.around(e).to_vec();
            around.sort_by_key(|u| solid(u.triangle));
            for own in around.chunk_by(|u, w| solid(u.triangle) == solid(w.triangle)) {
                for u in own {
                    edge[u.triangle as usize][u.corner as usize] = e as u32;
                }
                let [u, w] = own else {
                    is_closed[solid(own[0].triangle) as usize] = false;
                    continue;
                };
                let [s, t] = [u, w].map(|u| u.triangle as usize);
                is_closed[surface.solid[s] as usize] &= u.forward != w.forward;
                if curves.patches[s].smooth[u.corner as usize] {
                    sets.join(u.triangle, w.triangle);
                    let ends = surface.group[s] != surface.group[t];
                    stays[s][u.corner as usize] = ends;
                    stays[t][w.corner as usize] = ends;
                }
            }
        }
        let mut is_bent = vec![false; count];
        for t in 0..count as u32 {
            if curves.patches[t as usize].sagitta > equal {
                is_bent[sets.find(t) as usize] = true;
            }
        }
        let is_curved: Vec<bool> = (0..count as u32)
            .map(|t| is_bent[sets.find(t) as usize] && is_closed[solid(t) as usize])
            .collect();
        for (stays, is_curved) in stays.iter_mut().zip(&is_curved) {
            if !is_curved {
                *stays = [true; 3];
            }
        }
        Self {
            edge,
            stays,
            is_curved,
        }
    }
}
