//! One instance of an assembled mesh as a mesh of its own, for files that are read in parallel.

use super::assembled::Assembled;
use super::copies::{BLOCK, Ids};
use glam::DVec3;
use interchange::{MeshStream, Patch, PatchSink, PointSink, TetRegionSink, TetSink, TriangleSink};
use std::io;
use std::ops::Range;
use tmesh::{Marker, Region};

/// The elements of one instance, with points numbered as in its template, and their ids in the
/// whole mesh.
///
/// Points that several pieces share have the same coordinates in all of them, to the bit.
pub struct Piece<'a> {
    mesh: &'a Assembled<'a>,
    instance: usize,
    ids: Vec<u32>,
}

impl<'a> Piece<'a> {
    /// The piece that an instance makes up.
    pub fn new(mesh: &'a Assembled<'a>, instance: usize) -> Self {
        let mut ids = Vec::new();
        mesh.copies.numbering.ids(instance, &mut ids);
        Self {
            mesh,
            instance,
            ids,
        }
    }

    fn only(&self) -> Range<usize> {
        self.instance..self.instance + 1
    }

    fn template(&self) -> &tmesh::Template {
        let document = self.mesh.copies.document;
        &document.templates[document.instances[self.instance].template as usize]
    }
}

impl MeshStream for Piece<'_> {
    fn title(&self) -> String {
        self.mesh.title()
    }

    fn point_count(&self) -> u64 {
        self.template().vertices.len() as u64
    }

    fn tet_count(&self) -> u64 {
        self.template().tets.len() as u64
    }

    fn triangle_count(&self) -> u64 {
        self.mesh.triangles_of(self.instance)
    }

    fn regions(&self) -> &[Region] {
        self.mesh.regions()
    }

    fn markers(&self) -> &[Marker] {
        self.mesh.markers()
    }

    fn wall_names(&self) -> &[String] {
        self.mesh.wall_names()
    }

    fn points(&self, sink: &mut PointSink<'_>) -> io::Result<()> {
        let isometry = self.mesh.copies.document.instances[self.instance].isometry;
        let own = self.mesh.copies.world(isometry);
        let ids: Vec<u32> = (0..self.template().vertices.len() as u32).collect();
        let mut block: Vec<DVec3> = Vec::with_capacity(BLOCK);
        for part in ids.chunks(BLOCK) {
            block.clear();
            let position = |&v: &u32| self.mesh.copies.position(self.instance, v, &own);
            block.extend(part.iter().map(position));
            sink(&block)?;
        }
        Ok(())
    }

    fn tets(&self, sink: &mut TetSink<'_>) -> io::Result<()> {
        self.mesh.copies.give_tets(self.only(), Ids::Template, sink)
    }

    fn tet_regions(&self, sink: &mut TetRegionSink<'_>) -> io::Result<()> {
        self.mesh.copies.give_regions(self.only(), sink)
    }

    fn triangles(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        self.mesh
            .give_triangles::<false>(self.only(), Ids::Template, sink)
    }

    fn facets(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        self.mesh
            .give_triangles::<true>(self.only(), Ids::Template, sink)
    }

    fn patches(&self) -> &[Patch] {
        // Only formats that have no pieces ask for patches.
        &[]
    }

    fn patch(&self, _: usize, _: bool, _: &mut PatchSink<'_>) -> io::Result<()> {
        Ok(())
    }

    fn is_second_order(&self) -> bool {
        self.mesh.is_second_order()
    }

    fn point_ids(&self) -> Option<&[u32]> {
        Some(&self.ids)
    }
}
