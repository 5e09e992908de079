//! The whole mesh, as a stream: nothing of it is in memory but the templates.

use crate::numbering::{Numbering, NumberingError};
use crate::promise::{is_trivial, promise};
use glam::DVec3;
use interchange::{
    MeshStream, PointSink, TetBlock, TetRegionBlock, TetRegionSink, TetSink, TriangleBlock,
    TriangleSink, promise_title,
};
use std::io;
use tmesh::{Document, Instance, Isometry, Marker, OUTSIDE, Promise, Region, Tet, Triangle, Wall};

/// Elements per block.
const BLOCK: usize = 8192;

/// All instances of a document, welded along closed walls, in world coordinates.
///
/// Points are computed once, by the instance that owns them, so that no two copies differ.
/// Triangles on closed walls are left out unless the regions on their two sides differ: then they
/// are interfaces, and come once. Elements of orientation-reversing instances are turned over.
pub struct Assembled<'a> {
    document: &'a Document,
    numbering: Numbering,
    promise: Promise,
    /// Triangles of each template that are on no closed wall, increasing.
    kept: Vec<Vec<u32>>,
    triangle_count: u64,
}

impl<'a> Assembled<'a> {
    /// The assembled mesh of a valid document.
    ///
    /// # Errors
    /// See [`Numbering::new`].
    pub fn new(document: &'a Document) -> Result<Self, NumberingError> {
        let mut mesh = Self {
            document,
            numbering: Numbering::new(document)?,
            promise: promise(document),
            kept: Vec::new(),
            triangle_count: 0,
        };
        mesh.kept = mesh.triangles_off_walls();
        for (i, instance) in document.instances.iter().enumerate() {
            let mut count = mesh.kept[instance.template as usize].len() as u64;
            mesh.interfaces(i, &mut |_, _, _| count += 1);
            mesh.triangle_count += count;
        }
        Ok(mesh)
    }

    /// The symmetry the mesh has by construction.
    pub fn promise(&self) -> &Promise {
        &self.promise
    }

    /// Whether any two instances are welded.
    pub fn is_welded(&self) -> bool {
        self.numbering.has_closed_walls()
    }

    fn triangles_off_walls(&self) -> Vec<Vec<u32>> {
        let templates = &self.document.templates;
        let mut on_wall: Vec<Vec<bool>> = templates
            .iter()
            .map(|t| vec![false; t.triangles.len()])
            .collect();
        for (t, template) in templates.iter().enumerate() {
            for (w, wall) in template.walls.iter().enumerate() {
                if !self.numbering.is_closed(t, w) {
                    continue;
                }
                wall.triangles().for_each(|i| on_wall[t][i as usize] = true);
                if let Wall::Hub(hub) = wall {
                    for pair in &hub.triangle_pairs {
                        on_wall[hub.other as usize][pair[1] as usize] = true;
                    }
                }
            }
        }
        on_wall
            .iter()
            .map(|flags| {
                (0..)
                    .zip(flags)
                    .filter(|(_, on)| !**on)
                    .map(|(i, _)| i)
                    .collect()
            })
            .collect()
    }

    /// Calls `each` for the triangles on the instance's closed walls that separate two regions:
    /// triangle index, region within the instance, region beyond. Each pair of instances that meet
    /// at a wall is looked at from one side only.
    fn interfaces(&self, instance: usize, each: &mut impl FnMut(u32, u32, u32)) {
        let document = self.document;
        let here = document.instances[instance];
        let template = &document.templates[here.template as usize];
        for (w, wall) in template.walls.iter().enumerate() {
            let Some(beyond) = self.numbering.neighbour(instance, w) else {
                continue;
            };
            let there = document.instances[beyond];
            let other = &document.templates[there.template as usize];
            let mut look = |a: u32, b: u32| {
                let inner = inner_region(&template.triangles[a as usize]);
                let outer = inner_region(&other.triangles[b as usize]);
                let inner = document.placed_region(&here, inner);
                let outer = document.placed_region(&there, outer);
                if inner != outer {
                    each(a, inner, outer);
                }
            };
            match wall {
                Wall::Mirror(wall) => {
                    if instance < beyond && here.region_map != there.region_map {
                        wall.triangles.iter().for_each(|&t| look(t, t));
                    }
                }
                Wall::Seam(wall) => {
                    // The neighbour across the high face touches with its low face.
                    wall.triangle_pairs
                        .iter()
                        .for_each(|&[low, high]| look(high, low));
                }
                Wall::Hub(hub) => {
                    let back = |w: &Wall| {
                        matches!(w, Wall::Hub(b) if b.other == here.template
                            && b.placement == hub.placement.inverse())
                    };
                    let stated_twice = hub.other != here.template && other.walls.iter().any(back);
                    if !(stated_twice && hub.other < here.template) {
                        hub.triangle_pairs.iter().for_each(|&[a, b]| look(a, b));
                    }
                }
            }
        }
    }

    fn place_regions(&self, instance: &Instance, tets: &[Tet], regions: &mut Vec<u32>) {
        regions.clear();
        if instance.region_map == 0 {
            regions.extend(tets.iter().map(|tet| tet.region));
        } else {
            let placed = |region| self.document.placed_region(instance, region);
            regions.extend(tets.iter().map(|tet| placed(tet.region)));
        }
    }

    fn world(&self, isometry: Isometry) -> impl Fn(DVec3) -> DVec3 + use<> {
        let placed = isometry.placed();
        let frame = self.document.frame;
        move |p| frame.to_world(placed.apply(p))
    }

    /// World position of a vertex of an instance, the same for all copies of the point.
    fn position(&self, instance: usize, vertex: u32, own: &impl Fn(DVec3) -> DVec3) -> DVec3 {
        let (owner, vertex) = self.numbering.owner(instance, vertex);
        let place = &self.document.instances[owner];
        let p = self.document.templates[place.template as usize].vertices[vertex as usize];
        if owner == instance {
            own(p)
        } else {
            self.world(place.isometry)(p)
        }
    }

    fn give_triangles<const CORNERS: bool>(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        let mut ids = Vec::new();
        let mut block = Block::default();
        for (i, instance) in self.document.instances.iter().enumerate() {
            let triangles = &self.document.templates[instance.template as usize].triangles;
            if triangles.is_empty() {
                continue;
            }
            self.numbering.ids(i, &mut ids);
            let reversed = instance.isometry.reverses_orientation();
            let world = self.world(instance.isometry);
            let mut add = |block: &mut Block, t: u32, sides: Option<[u32; 2]>| {
                let triangle = &triangles[t as usize];
                let [a, b, c] = triangle.vertices;
                let turned = if reversed { [a, c, b] } else { [a, b, c] };
                let stored = [triangle.front, triangle.back];
                let placed = stored.map(|region| self.document.placed_region(instance, region));
                block.vertices.push(turned.map(|v| ids[v as usize]));
                if CORNERS {
                    let corners = turned.map(|v| self.position(i, v, &world));
                    block.corners.push(corners);
                }
                block.markers.push(triangle.marker);
                let [front, back] = sides.unwrap_or(placed);
                block.front.push(front);
                block.back.push(back);
                if block.vertices.len() == BLOCK {
                    block.give(i, sink)
                } else {
                    Ok(())
                }
            };
            for &t in &self.kept[instance.template as usize] {
                add(&mut block, t, None)?;
            }
            let mut interfaces = Vec::new();
            self.interfaces(i, &mut |t, inner, outer| {
                interfaces.push((t, inner, outer));
            });
            for (t, inner, outer) in interfaces {
                let sides = if triangles[t as usize].back == OUTSIDE {
                    [inner, outer]
                } else {
                    [outer, inner]
                };
                add(&mut block, t, Some(sides))?;
            }
            block.give(i, sink)?;
        }
        Ok(())
    }
}

/// The region on the inner side of a wall triangle, whichever way it is wound.
fn inner_region(triangle: &Triangle) -> u32 {
    if triangle.back == OUTSIDE {
        triangle.front
    } else {
        triangle.back
    }
}

impl MeshStream for Assembled<'_> {
    fn title(&self) -> String {
        if is_trivial(&self.promise) {
            "symtet mesh".to_owned()
        } else {
            promise_title(&self.promise)
        }
    }

    fn point_count(&self) -> u64 {
        u64::from(self.numbering.point_count())
    }

    fn tet_count(&self) -> u64 {
        let instances = self.document.instances.iter();
        let tets = |template: u32| self.document.templates[template as usize].tets.len() as u64;
        instances.map(|i| tets(i.template)).sum()
    }

    fn triangle_count(&self) -> u64 {
        self.triangle_count
    }

    fn regions(&self) -> &[Region] {
        &self.document.regions
    }

    fn markers(&self) -> &[Marker] {
        &self.document.markers
    }

    fn wall_names(&self) -> &[String] {
        &[]
    }

    fn points(&self, sink: &mut PointSink<'_>) -> io::Result<()> {
        let mut block = Vec::with_capacity(BLOCK);
        for (i, instance) in self.document.instances.iter().enumerate() {
            let vertices = &self.document.templates[instance.template as usize].vertices;
            let world = self.world(instance.isometry);
            for owned in self.numbering.owned(i) {
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
        let mut ids = Vec::new();
        let mut vertices = Vec::with_capacity(BLOCK);
        let mut regions = Vec::with_capacity(BLOCK);
        for (i, instance) in self.document.instances.iter().enumerate() {
            let tets = &self.document.templates[instance.template as usize].tets;
            if tets.is_empty() {
                continue;
            }
            self.numbering.ids(i, &mut ids);
            let reversed = instance.isometry.reverses_orientation();
            for part in tets.chunks(BLOCK) {
                vertices.clear();
                let mapped = part.iter().map(|tet| tet.vertices.map(|v| ids[v as usize]));
                if reversed {
                    vertices.extend(mapped.map(|[a, b, c, d]| [a, b, d, c]));
                } else {
                    vertices.extend(mapped);
                }
                self.place_regions(instance, part, &mut regions);
                sink(&TetBlock {
                    vertices: &vertices,
                    regions: &regions,
                    instance: i as u32,
                })?;
            }
        }
        Ok(())
    }

    fn tet_regions(&self, sink: &mut TetRegionSink<'_>) -> io::Result<()> {
        let mut regions = Vec::with_capacity(BLOCK);
        for (i, instance) in self.document.instances.iter().enumerate() {
            let tets = &self.document.templates[instance.template as usize].tets;
            for part in tets.chunks(BLOCK) {
                self.place_regions(instance, part, &mut regions);
                sink(&TetRegionBlock {
                    regions: &regions,
                    instance: i as u32,
                })?;
            }
        }
        Ok(())
    }

    fn triangles(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        self.give_triangles::<false>(sink)
    }

    fn facets(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        self.give_triangles::<true>(sink)
    }
}

/// Triangles on their way to a sink.
#[derive(Default)]
struct Block {
    vertices: Vec<[u32; 3]>,
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
        self.walls.resize(self.vertices.len(), 0);
        let given = sink(&TriangleBlock {
            vertices: &self.vertices,
            corners: &self.corners,
            markers: &self.markers,
            front: &self.front,
            back: &self.back,
            walls: &self.walls,
            instance: instance as u32,
        });
        self.vertices.clear();
        self.corners.clear();
        self.markers.clear();
        self.front.clear();
        self.back.clear();
        self.walls.clear();
        given
    }
}
