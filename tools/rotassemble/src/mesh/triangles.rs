//! The surface triangles of the mesh, block by block.

use super::assembled::Assembled;
use super::copies::{BLOCK, Ids};
use glam::DVec3;
use interchange::{Middles, TriangleBlock, TriangleSink};
use std::io;
use std::ops::Range;
use tmesh::{Instance, OUTSIDE};

impl Assembled<'_> {
    /// Gives the triangles of some instances, with the coordinates of their corners where `CORNERS`.
    pub(super) fn give_triangles<const CORNERS: bool>(
        &self,
        instances: Range<usize>,
        ids: Ids,
        sink: &mut TriangleSink<'_>,
    ) -> io::Result<()> {
        let copies = &self.copies;
        let mut block = Block::default();
        let mut interfaces = Vec::new();
        for i in instances {
            let instance = &copies.document.instances[i];
            let triangles = &copies.document.templates[instance.template as usize].triangles;
            if triangles.is_empty() {
                continue;
            }
            copies.point_ids(i, ids, &mut block.ids);
            let world = copies.world(instance.isometry);
            let mut add = |t: u32, sides: Option<[u32; 2]>| {
                let turned = self.add(instance, t, sides, &mut block);
                if CORNERS {
                    let corners = turned.map(|v| copies.position(i, v, &world));
                    block.corners.push(corners);
                }
                if block.vertices.len() == BLOCK {
                    block.give(i, sink)
                } else {
                    Ok(())
                }
            };
            for &t in &self.kept[instance.template as usize] {
                add(t, None)?;
            }
            interfaces.clear();
            copies.interfaces(i, &mut |t, inner, outer| {
                interfaces.push((t, inner, outer));
            });
            for &(t, inner, outer) in &interfaces {
                let sides = if triangles[t as usize].back == OUTSIDE {
                    [inner, outer]
                } else {
                    [outer, inner]
                };
                add(t, Some(sides))?;
            }
            block.give(i, sink)?;
        }
        Ok(())
    }

    /// Adds a triangle of an instance, with the regions on its sides where these are not its own; returns
    /// its vertices in the order in which they are added.
    fn add(
        &self,
        instance: &Instance,
        triangle: u32,
        sides: Option<[u32; 2]>,
        block: &mut Block,
    ) -> [u32; 3] {
        let (document, t) = (self.copies.document, instance.template as usize);
        let at = triangle as usize;
        let triangle = &document.templates[t].triangles[at];
        let reversed = instance.isometry.reverses_orientation();
        let [a, b, c] = triangle.vertices;
        let turned = if reversed { [a, c, b] } else { [a, b, c] };
        let vertices = turned.map(|v| block.ids[v as usize]);
        block.vertices.push(vertices);
        if let Some(all) = self.copies.middles {
            let middles = all.triangles[t][at];
            let middles = if reversed {
                Middles::turned(middles)
            } else {
                middles
            };
            let middles = middles.map(|v| block.ids[v as usize]);
            block.middles.push(middles);
        }
        block.markers.push(triangle.marker);
        let walls = self.open.walls.get(t);
        block.walls.push(walls.map_or(0, |walls| walls[at]));
        let [front, back] = sides.unwrap_or_else(|| {
            [triangle.front, triangle.back].map(|region| document.placed_region(instance, region))
        });
        block.front.push(front);
        block.back.push(back);
        turned
    }
}

/// Triangles on their way to a sink.
#[derive(Default)]
struct Block {
    /// Id of each vertex of the instance at hand.
    ids: Vec<u32>,
    vertices: Vec<[u32; 3]>,
    middles: Vec<[u32; 3]>,
    corners: Vec<[DVec3; 3]>,
    markers: Vec<u32>,
    front: Vec<u32>,
    back: Vec<u32>,
    walls: Vec<u32>,
}

impl Block {
    /// Gives what there is to the sink, and is empty again.
    fn give(&mut self, instance: usize, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        if self.vertices.is_empty() {
            return Ok(());
        }
        let given = sink(&TriangleBlock {
            vertices: &self.vertices,
            middles: &self.middles,
            corners: &self.corners,
            markers: &self.markers,
            front: &self.front,
            back: &self.back,
            walls: &self.walls,
            instance: instance as u32,
        });
        self.vertices.clear();
        self.middles.clear();
        self.corners.clear();
        self.markers.clear();
        self.front.clear();
        self.back.clear();
        self.walls.clear();
        given
    }
}
