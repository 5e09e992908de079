//! The boundary of a mesh, face by face, for formats in which surfaces are nothing else.

use super::sides::marker_label;
use super::{Label, MeshStream};
use std::io;
use tmesh::OUTSIDE;

/// A surface triangle with material on one side only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundaryFace {
    /// Three point ids; the normal points out of the material.
    pub vertices: [u32; 3],
    /// What it is called.
    pub label: Label,
    /// Position in the order of [`MeshStream::triangles`].
    pub position: u64,
}

/// All triangles with material on exactly one side, open walls included, sorted by label, else in the
/// order of the mesh.
pub fn boundary(mesh: &dyn MeshStream) -> io::Result<Vec<BoundaryFace>> {
    let mut faces = Vec::new();
    let mut position = 0;
    mesh.triangles(&mut |block| {
        for (i, &[a, b, c]) in block.vertices.iter().enumerate() {
            let inward = block.back[i] == OUTSIDE;
            if inward != (block.front[i] == OUTSIDE) {
                faces.push(BoundaryFace {
                    vertices: if inward { [a, c, b] } else { [a, b, c] },
                    label: match block.walls[i] {
                        0 => marker_label(block.markers[i]),
                        wall => Label::Wall(wall - 1),
                    },
                    position,
                });
            }
            position += 1;
        }
        Ok(())
    })?;
    faces.sort_by_key(|face| face.label);
    Ok(faces)
}
