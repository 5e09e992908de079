//! The vertices of templates that represent the others.

use super::error::NumberingError;
use super::nodes::Nodes;
use super::places::Places;
use rustc_hash::FxHashMap;
use tmesh::{Document, Isometry};

/// A vertex of a template on a closed wall, and the one that represents it.
#[derive(Clone, Copy, Debug)]
pub struct Shared {
    /// Template and vertex.
    pub own: (usize, u32),
    /// Template and vertex of the one that represents it; the same where it represents itself.
    pub root: (usize, u32),
    /// Takes the root onto the vertex.
    pub offset: Isometry,
}

/// All vertices on closed walls.
pub struct Roots {
    /// Them, each once.
    pub shared: Vec<Shared>,
    generators: FxHashMap<(usize, u32), Vec<Isometry>>,
}

impl Roots {
    /// Relates the vertices of a valid document. Linear.
    ///
    /// # Errors
    /// Instances that do not close up.
    pub fn new(document: &Document) -> Result<Self, NumberingError> {
        let places = Places::new(&document.instances, document.templates.len());
        let neighbours = places.neighbours(document)?;
        let mut nodes = Nodes::new(document, &places, &neighbours);
        let mut roots = Self {
            shared: Vec::with_capacity(nodes.vertex.len()),
            generators: FxHashMap::default(),
        };
        for node in 0..nodes.vertex.len() as u32 {
            let (root, offset) = nodes.orbits.find(node);
            let place = |node: u32| {
                let (t, v) = nodes.vertex[node as usize];
                (t as usize, v)
            };
            roots.shared.push(Shared {
                own: place(node),
                root: place(root),
                offset,
            });
            let generators = nodes.orbits.generators(nodes.orbits.set(root));
            if root == node && !generators.is_empty() {
                roots.generators.insert(place(root), generators.to_vec());
            }
        }
        Ok(roots)
    }

    /// Isometries that leave a root where it is, which generate all that do.
    pub fn generators(&self, root: (usize, u32)) -> &[Isometry] {
        self.generators.get(&root).map_or(&[], Vec::as_slice)
    }
}
