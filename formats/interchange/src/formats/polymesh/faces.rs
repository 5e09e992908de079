//! The faces of all tetrahedra, each once: those inside first, then those of each patch.

use super::face::Face;
use super::patches::{Patch, patches};
use crate::stream::{FACES, MeshStream};
use std::io;

/// All faces in the order of the format.
pub struct Faces {
    /// Those inside by owner and neighbour, then those of the patches, one patch after the other.
    pub all: Vec<Face>,
    /// Number of faces inside.
    pub inner: usize,
    /// The patches.
    pub patches: Vec<Patch>,
}

/// A face of a tetrahedron on the way to its partner.
#[derive(Clone, Copy)]
struct Half {
    /// The point ids, increasing.
    key: [u32; 3],
    tet: u32,
    opposite: u8,
}

impl Faces {
    /// Gathers the faces of a mesh; its tetrahedra are in memory while that lasts.
    pub fn of(mesh: &dyn MeshStream) -> io::Result<Self> {
        let mut tets: Vec<[u32; 4]> = Vec::with_capacity(mesh.tet_count() as usize);
        mesh.tets(&mut |part| {
            tets.extend(part.vertices);
            Ok(())
        })?;
        let halves = tets.iter().zip(0..).flat_map(|(tet, t)| {
            (0..4).map(move |opposite: u8| {
                let mut key = FACES[usize::from(opposite)].map(|c| tet[c]);
                key.sort_unstable();
                Half {
                    key,
                    tet: t,
                    opposite,
                }
            })
        });
        let mut halves: Vec<Half> = halves.collect();
        halves.sort_unstable_by_key(|half| (half.key, half.tet));
        let face = |half: &Half, neighbour: u32| Face {
            vertices: FACES[usize::from(half.opposite)].map(|c| tets[half.tet as usize][c]),
            owner: half.tet,
            neighbour,
        };
        let (mut all, mut open) = (Vec::new(), Vec::new());
        for same in halves.chunk_by(|a, b| a.key == b.key) {
            match same {
                [first, second] => all.push(face(first, second.tet)),
                // A face of one tetrahedron; of more than two, which no valid mesh has, each is.
                others => open.extend(others.iter().map(|h| (h.key, face(h, h.tet)))),
            }
        }
        drop(halves);
        all.sort_unstable_by_key(|face| (face.owner, face.neighbour));
        let inner = all.len();
        let (boundary, patches) = patches(mesh, &open)?;
        all.extend(boundary);
        Ok(Self {
            all,
            inner,
            patches,
        })
    }
}
