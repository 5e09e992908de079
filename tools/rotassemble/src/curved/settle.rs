//! Elements that would be turned over keep straight edges.

use super::jacobian::least;
use super::nodes::{Bound, Nodes};
use glam::DVec3;
use interchange::Middles;
use tmesh::Document;

/// Part of its Jacobian that an element keeps at least, everywhere, as its edges are bent. A choice, that of Gmsh for curved
/// meshes (`Mesh.HighOrderThresholdMin`): errors of finite elements grow as it gets smaller, and more edges stay straight as it
/// gets larger.
const KEPT: f64 = 0.1;

/// How many times the move of a vertex is halved before it stays where it is.
const HALVINGS: u8 = 3;

/// What became of edges, in one copy of each template.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bends {
    /// Edges that follow the shape, or would.
    pub curved: usize,
    /// Those of them that are kept straight.
    pub straight: usize,
    /// Vertices of the mesh on facets that are nearer to these than the shape is.
    pub held: usize,
}

impl Bends {
    /// A sentence about edges that are curved, if there are any.
    pub fn told(&self) -> Option<String> {
        let Self {
            curved,
            straight,
            held,
        } = self;
        let part = 100.0 * *straight as f64 / *curved as f64;
        let rest = match (straight, held) {
            (0, 0) => String::new(),
            (_, 0) => format!(
                "; {straight} ({part:.2} %) are kept straight, so that no element is turned over"
            ),
            _ => format!(
                "; {straight} ({part:.2} %) are kept straight and {held} vertices nearer to the facets, so that no \
                 element is turned over"
            ),
        };
        (*curved > 0)
            .then(|| format!("{curved} edges of the wedge follow the shape of curved faces{rest}"))
    }
}

impl Nodes<'_> {
    /// Straightens edges, and where that is not enough takes moves of vertices back, until every element keeps a part of its
    /// Jacobian everywhere. Both in all copies: they have one root. Edges are bent that are off a straight line by more than
    /// `rounding`.
    pub fn settle(&mut self, document: &Document, middles: &Middles, rounding: f64) -> Bends {
        let mut settling = Settling::new(self, rounding);
        let asked: usize = settling.is_bent.iter().flatten().filter(|b| **b).count();
        let mut bends = Bends {
            curved: asked,
            ..Bends::default()
        };
        while settling.round(document, middles) {}
        let left = settling.is_bent.iter().flatten().filter(|b| **b).count();
        bends.straight = asked - left;
        bends.held = settling.halved.iter().flatten().filter(|h| **h > 0).count();
        bends
    }
}

/// Work on moves.
struct Settling<'n, 'a> {
    nodes: &'n mut Nodes<'a>,
    /// Of each node, whether it is on an edge that is bent.
    is_bent: Vec<Vec<bool>>,
    /// How often the move of each node was halved.
    halved: Vec<Vec<u8>>,
    /// The root of each node that is shared, by template.
    root: Vec<Vec<(usize, u32)>>,
}

impl<'n, 'a> Settling<'n, 'a> {
    fn new(nodes: &'n mut Nodes<'a>, rounding: f64) -> Self {
        let all = |t: usize| (0..nodes.moves[t].len() as u32).map(move |v| (t, v));
        let templates = 0..nodes.moves.len();
        let mut root: Vec<Vec<(usize, u32)>> =
            templates.clone().map(|t| all(t).collect()).collect();
        for shared in &nodes.roots.shared {
            root[shared.own.0][shared.own.1 as usize] = shared.root;
        }
        let is_bent = |t: usize| {
            let first = nodes.vertices(t);
            let bent = |v: usize| {
                let Some(ends) = v.checked_sub(first).map(|i| nodes.ends[t][i]) else {
                    return false;
                };
                nodes.bounds[t][v] == Bound::Known
                    && nodes.moves[t][v].distance(nodes.mean(t, ends)) > rounding
            };
            (0..nodes.moves[t].len()).map(bent).collect()
        };
        Self {
            is_bent: templates.clone().map(is_bent).collect(),
            halved: templates.map(|t| vec![0; nodes.moves[t].len()]).collect(),
            root,
            nodes,
        }
    }

    /// Looks at all elements once; returns whether something was changed.
    fn round(&mut self, document: &Document, middles: &Middles) -> bool {
        let (mut straighten, mut retreat) = (Vec::new(), Vec::new());
        for (t, template) in document.templates.iter().enumerate() {
            let moves = &self.nodes.moves[t];
            for (tet, between) in template.tets.iter().zip(&middles.tets[t]) {
                let ids: [u32; 10] = std::array::from_fn(|i| {
                    if i < 4 {
                        tet.vertices[i]
                    } else {
                        between[i - 4]
                    }
                });
                if ids.iter().all(|&v| moves[v as usize] == DVec3::ZERO) {
                    continue;
                }
                let places = ids.map(|v| template.vertices[v as usize]);
                let moved = std::array::from_fn(|i| places[i] + moves[ids[i] as usize]);
                let [a, b, c, d] = [0, 1, 2, 3].map(|i| places[i]);
                let straight = (b - a).cross(c - a).dot(d - a);
                if least(&moved) >= KEPT * straight {
                    continue;
                }
                let roots = ids.map(|v| self.root[t][v as usize]);
                let bent = ids
                    .iter()
                    .zip(roots)
                    .filter(|(v, _)| self.is_bent[t][**v as usize]);
                let before = straighten.len();
                straighten.extend(bent.map(|(_, root)| root));
                if straighten.len() == before {
                    retreat.extend_from_slice(&roots[..4]);
                }
            }
        }
        let changed = !straighten.is_empty() || !retreat.is_empty();
        for (t, v) in straighten {
            self.is_bent[t][v as usize] = false;
            self.nodes.bounds[t][v as usize] = Bound::Free;
        }
        retreat.sort_unstable();
        retreat.dedup();
        for (t, v) in retreat {
            let (halved, by) = (
                &mut self.halved[t][v as usize],
                &mut self.nodes.moves[t][v as usize],
            );
            if *by != DVec3::ZERO {
                *halved += 1;
                *by = if *halved > HALVINGS {
                    DVec3::ZERO
                } else {
                    *by * 0.5
                };
            }
        }
        self.spread();
        changed
    }

    /// Gives all copies what their roots have.
    fn spread(&mut self) {
        for shared in &self.nodes.roots.shared {
            let ((t, v), (r, w)) = (shared.own, shared.root);
            let (v, w) = (v as usize, w as usize);
            self.is_bent[t][v] = self.is_bent[r][w];
            self.halved[t][v] = self.halved[r][w];
            if self.nodes.bounds[r][w] == Bound::Free {
                self.nodes.bounds[t][v] = Bound::Free;
            }
        }
        self.nodes.spread();
        self.nodes.follow_ends();
    }
}
