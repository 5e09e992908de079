//! The whole mesh as a stream for writers.

use super::assembled::Assembled;
use super::copies::{BLOCK, Ids};
use glam::DVec3;
use interchange::{
    Coupling, MeshStream, Patch, PatchSink, PointSink, TetRegionSink, TetSink, TriangleSink,
    promise_title,
};
use std::io;
use std::ops::Range;
use tmesh::{Marker, Region};

impl Assembled<'_> {
    fn all(&self) -> Range<usize> {
        0..self.copies.document.instances.len()
    }
}

impl MeshStream for Assembled<'_> {
    fn title(&self) -> String {
        if self.promise().group.is_trivial() {
            "symtet mesh".to_owned()
        } else {
            promise_title(self.promise())
        }
    }

    fn point_count(&self) -> u64 {
        u64::from(self.copies.numbering.point_count())
    }

    fn tet_count(&self) -> u64 {
        let instances = self.copies.document.instances.iter();
        let tets =
            |template: u32| self.copies.document.templates[template as usize].tets.len() as u64;
        instances.map(|i| tets(i.template)).sum()
    }

    fn triangle_count(&self) -> u64 {
        self.triangle_count
    }

    fn regions(&self) -> &[Region] {
        &self.copies.document.regions
    }

    fn markers(&self) -> &[Marker] {
        &self.copies.document.markers
    }

    fn wall_names(&self) -> &[String] {
        &self.open.names
    }

    fn points(&self, sink: &mut PointSink<'_>) -> io::Result<()> {
        let mut block = Vec::with_capacity(BLOCK);
        for (i, instance) in self.copies.document.instances.iter().enumerate() {
            let vertices = &self.copies.document.templates[instance.template as usize].vertices;
            let world = self.copies.world(instance.isometry);
            for owned in self.copies.numbering.owned(i) {
                for part in owned.chunks(BLOCK) {
                    block.clear();
                    block.extend(part.iter().map(|&v| world(vertices[v as usize])));
                    sink(&block)?;
                }
            }
        }
        Ok(())
    }

    fn tets(&self, sink: &mut TetSink<'_>) -> io::Result<()> {
        self.copies.give_tets(self.all(), Ids::Whole, sink)
    }

    fn tet_regions(&self, sink: &mut TetRegionSink<'_>) -> io::Result<()> {
        self.copies.give_regions(self.all(), sink)
    }

    fn triangles(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        self.give_triangles::<false>(self.all(), Ids::Whole, sink)
    }

    fn facets(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        self.give_triangles::<true>(self.all(), Ids::Whole, sink)
    }

    fn patches(&self) -> &[Patch] {
        &self.patches
    }

    fn patch(&self, patch: usize, sides: bool, sink: &mut PatchSink<'_>) -> io::Result<()> {
        self.give_patch(patch, sides, sink)
    }

    fn is_second_order(&self) -> bool {
        self.copies.middles.is_some()
    }

    fn wall_normals(&self) -> &[Option<DVec3>] {
        &self.open.normals
    }

    fn couplings(&self) -> &[Coupling] {
        &self.open.couplings
    }

    fn uncoupled(&self) -> &[String] {
        &self.open.uncoupled
    }

    fn axis_edges(&self) -> &[[u32; 2]] {
        &self.open.axis_edges
    }
}
