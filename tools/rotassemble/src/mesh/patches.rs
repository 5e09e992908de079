//! The triangles of the mesh by label.

use super::assembled::Assembled;
use super::copies::BLOCK;
use interchange::sides::marker_label;
use interchange::{Label, Middles, PatchBlock, PatchSink, Side, placed_side};
use std::io;
use tmesh::{OUTSIDE, Triangle};

impl Assembled<'_> {
    /// Gives the triangles of a patch, and, where asked for, the tetrahedra that they are faces of.
    pub(super) fn give_patch(
        &self,
        patch: usize,
        sides: bool,
        sink: &mut PatchSink<'_>,
    ) -> io::Result<()> {
        let label = self.patches[patch].label;
        let mut block = Block::default();
        for (i, instance) in self.copies.document.instances.iter().enumerate() {
            let kept = self.labelled[instance.template as usize].get(&label);
            let kept = kept.map_or(&[][..], Vec::as_slice);
            let interfaces = self.interfaces_of(i, label);
            for part in kept.chunks(BLOCK).chain(interfaces.chunks(BLOCK)) {
                block.clear();
                for &at in part {
                    self.add_to_patch(i, at, sides, &mut block);
                }
                sink(&PatchBlock {
                    vertices: &block.vertices,
                    middles: &block.middles,
                    sides: &block.sides,
                })?;
            }
        }
        Ok(())
    }

    /// Triangles on closed walls of an instance that are interfaces with a label.
    fn interfaces_of(&self, instance: usize, label: Label) -> Vec<u32> {
        let mut interfaces = Vec::new();
        if self.has_interfaces[instance] {
            let document = self.copies.document;
            let template = document.instances[instance].template as usize;
            let triangles = &document.templates[template].triangles;
            self.copies.interfaces(instance, &mut |triangle, _, _| {
                if marker_label(triangles[triangle as usize].marker) == label {
                    interfaces.push(triangle);
                }
            });
        }
        interfaces
    }

    /// Adds a triangle of an instance, its normal pointing out of the material.
    fn add_to_patch(&self, instance: usize, triangle: u32, sides: bool, block: &mut Block) {
        let document = self.copies.document;
        let place = &document.instances[instance];
        let t = place.template as usize;
        let at = triangle as usize;
        let triangle: &Triangle = &document.templates[t].triangles[at];
        let reversed = place.isometry.reverses_orientation();
        let inward = triangle.back == OUTSIDE && triangle.front != OUTSIDE;
        let turn = reversed != inward;
        let id = |v: u32| self.copies.numbering.id(instance, v);
        let [a, b, c] = triangle.vertices;
        let turned = if turn { [a, c, b] } else { [a, b, c] };
        block.vertices.push(turned.map(id));
        if let Some(all) = self.copies.middles {
            let middles = all.triangles[t][at];
            let turned = if turn {
                Middles::turned(middles)
            } else {
                middles
            };
            block.middles.push(turned.map(id));
        }
        if sides {
            let side = self.sides()[t][at];
            let side = placed_side(side, self.first_tet[instance], reversed);
            block.sides.push(side);
        }
    }
}

/// Triangles of a patch on their way to a sink.
#[derive(Default)]
struct Block {
    vertices: Vec<[u32; 3]>,
    middles: Vec<[u32; 3]>,
    sides: Vec<Side>,
}

impl Block {
    fn clear(&mut self) {
        self.vertices.clear();
        self.middles.clear();
        self.sides.clear();
    }
}
