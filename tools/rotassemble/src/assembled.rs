//! The whole mesh, as a stream: nothing of it is in memory but the templates.

use crate::numbering::{Numbering, NumberingError};
use crate::promise::promise;
use glam::DVec3;
use interchange::sides::{by_label, face_tets, marker_label};
use interchange::{
    Coupling, Label, MeshStream, Middles, Patch, PatchBlock, PatchSink, Plain, PointSink, TetBlock,
    TetRegionBlock, TetRegionSink, TetSink, TriangleBlock, TriangleSink, placed_side,
    promise_title,
};
use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::io;
use std::ops::Range;
use tmesh::{
    Document, Gluing, Instance, Isometry, Marker, OUTSIDE, Promise, Region, Tet, Triangle,
};

/// Elements per block.
const BLOCK: usize = 8192;

/// All instances of a document, welded along closed walls, in world coordinates.
///
/// Points are computed once, by the instance that owns them, so that no two copies differ.
/// Triangles on closed walls are left out unless the regions on their two sides differ: then they
/// are interfaces, and come once. Elements of orientation-reversing instances are turned over.
pub struct Assembled<'a> {
    pub(crate) document: &'a Document,
    pub(crate) numbering: Numbering,
    promise: Promise,
    /// Triangles of each template that are on no closed wall, increasing.
    kept: Vec<Vec<u32>>,
    /// The same by label.
    labelled: Vec<BTreeMap<Label, Vec<u32>>>,
    /// Whether an instance has interfaces on closed walls.
    has_interfaces: Vec<bool>,
    triangle_count: u64,
    patches: Vec<Patch>,
    /// Position of each instance's first tetrahedron.
    first_tet: Vec<u64>,
    /// Tetrahedra that triangles are faces of, per template.
    sides: OnceCell<Vec<Vec<(u32, u8)>>>,
    middles: Option<&'a Middles>,
    open: Open,
}

/// What is left open in a sector: walls, and what they have to do with each other.
#[derive(Default)]
struct Open {
    names: Vec<String>,
    normals: Vec<Option<DVec3>>,
    /// Wall per triangle of each template, as in [`TriangleBlock::walls`]; empty when nothing is open.
    walls: Vec<Vec<u32>>,
    couplings: Vec<Coupling>,
    axis_edges: Vec<[u32; 2]>,
}

impl<'a> Assembled<'a> {
    /// The assembled mesh of a valid document.
    ///
    /// # Errors
    /// See [`Numbering::new`].
    pub fn new(document: &'a Document) -> Result<Self, NumberingError> {
        Self::of_order(document, None)
    }

    /// The assembled mesh of a document that [`interchange::second_order`] made, with its middles.
    ///
    /// # Errors
    /// See [`Numbering::new`].
    pub fn of_order(
        document: &'a Document,
        middles: Option<&'a Middles>,
    ) -> Result<Self, NumberingError> {
        let mut mesh = Self {
            document,
            numbering: Numbering::new(document)?,
            promise: promise(document),
            kept: Vec::new(),
            labelled: Vec::new(),
            has_interfaces: Vec::new(),
            triangle_count: 0,
            patches: Vec::new(),
            first_tet: Vec::new(),
            sides: OnceCell::new(),
            middles,
            open: Open::default(),
        };
        mesh.kept = mesh.triangles_off_walls();
        mesh.open = mesh.open_walls();
        let marker = |t: usize, i: u32| document.templates[t].triangles[i as usize].marker;
        let wall = |t: usize, i: u32| match mesh.open.walls.get(t) {
            Some(walls) => walls[i as usize],
            None => 0,
        };
        let lists = mesh.kept.iter().enumerate();
        mesh.labelled = lists
            .map(|(t, list)| {
                by_label(list.iter().map(|&i| match wall(t, i) {
                    0 => (i, marker_label(marker(t, i))),
                    wall => (i, Label::Wall(wall - 1)),
                }))
            })
            .collect();
        let mut counts: BTreeMap<Label, u64> = BTreeMap::new();
        let mut first_tet = 0;
        for (i, instance) in document.instances.iter().enumerate() {
            let t = instance.template as usize;
            for (&label, list) in &mesh.labelled[t] {
                *counts.entry(label).or_default() += list.len() as u64;
            }
            let mut any = false;
            mesh.interfaces(i, &mut |triangle, _, _| {
                *counts.entry(marker_label(marker(t, triangle))).or_default() += 1;
                any = true;
            });
            mesh.has_interfaces.push(any);
            mesh.first_tet.push(first_tet);
            first_tet += document.templates[t].tets.len() as u64;
        }
        mesh.triangle_count = counts.values().sum();
        let patches = counts.into_iter();
        mesh.patches = patches
            .map(|(label, triangles)| Patch { label, triangles })
            .collect();
        Ok(mesh)
    }

    /// Names, pairs and axis of a sector: of a document in which each template is placed once.
    fn open_walls(&self) -> Open {
        let document = self.document;
        let templates = document.templates.len();
        let mut placed = vec![Vec::new(); templates];
        for (i, instance) in document.instances.iter().enumerate() {
            placed[instance.template as usize].push(i);
        }
        if placed.iter().any(|list| list.len() != 1) {
            return Open::default();
        }
        let Ok(plain) = Plain::of_order(document, self.middles) else {
            return Open::default();
        };
        // From the ids of the templates one after the other to those of the mesh.
        let first = plain.first_ids();
        let locate = |id: u32| {
            let t = first.partition_point(|&f| f <= id) - 1;
            self.numbering.id(placed[t][0], id - first[t])
        };
        let mut position: Vec<Option<u64>> = Vec::new();
        let mut next = vec![0_u64; templates];
        let mut begin = 0;
        for (i, instance) in document.instances.iter().enumerate() {
            next[instance.template as usize] = begin;
            begin += self.triangles_of(i);
        }
        for (t, template) in document.templates.iter().enumerate() {
            let from = position.len();
            position.resize(from + template.triangles.len(), None);
            for (at, &i) in (next[t]..).zip(&self.kept[t]) {
                position[from + i as usize] = Some(at);
            }
        }
        let couplings = plain.couplings().iter().filter_map(|coupling| {
            let pairs = coupling.triangles.iter();
            let triangles: Option<Vec<[u64; 2]>> = pairs
                .map(|p| Some([position[p[0] as usize]?, position[p[1] as usize]?]))
                .collect();
            let mut points: Vec<[u32; 2]> = coupling.points.iter().map(|p| p.map(locate)).collect();
            points.sort_unstable();
            points.dedup();
            // What is welded needs no coupling.
            Some(Coupling {
                triangles: triangles?,
                points,
                ..coupling.clone()
            })
        });
        Open {
            couplings: couplings.collect(),
            axis_edges: plain.axis_edges().iter().map(|e| e.map(locate)).collect(),
            names: plain.wall_names().to_vec(),
            normals: plain.wall_normals().to_vec(),
            walls: (0..templates).map(|t| plain.walls_of(t).to_vec()).collect(),
        }
    }

    fn sides(&self) -> &[Vec<(u32, u8)>] {
        let templates = self.document.templates.iter();
        self.sides
            .get_or_init(|| templates.map(face_tets).collect())
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
            for (w, gluing) in template.gluings.iter().enumerate() {
                if !self.numbering.is_closed(t, w) {
                    continue;
                }
                for &[here, there] in &gluing.triangle_pairs {
                    on_wall[t][here as usize] = true;
                    on_wall[gluing.other as usize][there as usize] = true;
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
        for (w, gluing) in template.gluings.iter().enumerate() {
            let Some(beyond) = self.numbering.neighbour(instance, w) else {
                continue;
            };
            let there = document.instances[beyond];
            let other = &document.templates[there.template as usize];
            // A face that two gluings state is looked at by the one of the lower template, and a mirror
            // wall by the lower of the instances that meet there.
            let back = |g: &Gluing| g.other == here.template && g.step == gluing.step.inverse();
            let stated_twice = gluing.other != here.template && other.gluings.iter().any(back);
            let skipped = match gluing.is_mirror(here.template as usize) {
                true => beyond < instance || here.region_map == there.region_map,
                false => stated_twice && gluing.other < here.template,
            };
            if skipped {
                continue;
            }
            for &[a, b] in &gluing.triangle_pairs {
                let inner = inner_region(&template.triangles[a as usize]);
                let outer = inner_region(&other.triangles[b as usize]);
                let inner = document.placed_region(&here, inner);
                let outer = document.placed_region(&there, outer);
                if inner != outer {
                    each(a, inner, outer);
                }
            }
        }
    }

    pub(crate) fn place_regions(&self, instance: &Instance, tets: &[Tet], regions: &mut Vec<u32>) {
        regions.clear();
        if instance.region_map == 0 {
            regions.extend(tets.iter().map(|tet| tet.region));
        } else {
            let placed = |region| self.document.placed_region(instance, region);
            regions.extend(tets.iter().map(|tet| placed(tet.region)));
        }
    }

    /// Gives the tetrahedra of some instances, with ids of the whole mesh or, when `local`, of the
    /// template.
    pub(crate) fn give_tets(
        &self,
        instances: Range<usize>,
        local: bool,
        sink: &mut TetSink<'_>,
    ) -> io::Result<()> {
        let mut ids = Vec::new();
        let mut vertices = Vec::with_capacity(BLOCK);
        let mut regions = Vec::with_capacity(BLOCK);
        let mut middles = Vec::new();
        for i in instances {
            let instance = &self.document.instances[i];
            let tets = &self.document.templates[instance.template as usize].tets;
            if tets.is_empty() {
                continue;
            }
            self.point_ids(i, local, &mut ids);
            let reversed = instance.isometry.reverses_orientation();
            for (chunk, part) in tets.chunks(BLOCK).enumerate() {
                middles.clear();
                if let Some(all) = self.middles {
                    let at = chunk * BLOCK;
                    let of_part = &all.tets[instance.template as usize][at..at + part.len()];
                    middles.extend(of_part.iter().map(|&middles| {
                        let turned = if reversed {
                            Middles::reversed(middles)
                        } else {
                            middles
                        };
                        turned.map(|v| ids[v as usize])
                    }));
                }
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
                    middles: &middles,
                    regions: &regions,
                    instance: i as u32,
                })?;
            }
        }
        Ok(())
    }

    fn point_ids(&self, instance: usize, local: bool, ids: &mut Vec<u32>) {
        if local {
            let template = self.document.instances[instance].template as usize;
            ids.clear();
            ids.extend(0..self.document.templates[template].vertices.len() as u32);
        } else {
            self.numbering.ids(instance, ids);
        }
    }

    /// Gives the regions of the tetrahedra of some instances.
    pub(crate) fn give_regions(
        &self,
        instances: Range<usize>,
        sink: &mut TetRegionSink<'_>,
    ) -> io::Result<()> {
        let mut regions = Vec::with_capacity(BLOCK);
        for i in instances {
            let instance = &self.document.instances[i];
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

    pub(crate) fn world(&self, isometry: Isometry) -> impl Fn(DVec3) -> DVec3 + use<> {
        let placed = isometry.placed();
        let frame = self.document.frame;
        move |p| frame.to_world(placed.apply(p))
    }

    /// World position of a vertex of an instance, the same for all copies of the point.
    pub(crate) fn position(
        &self,
        instance: usize,
        vertex: u32,
        own: &impl Fn(DVec3) -> DVec3,
    ) -> DVec3 {
        let (owner, vertex) = self.numbering.owner(instance, vertex);
        let place = &self.document.instances[owner];
        let p = self.document.templates[place.template as usize].vertices[vertex as usize];
        if owner == instance {
            own(p)
        } else {
            self.world(place.isometry)(p)
        }
    }

    /// Number of triangles of one instance.
    pub(crate) fn triangles_of(&self, instance: usize) -> u64 {
        let template = self.document.instances[instance].template;
        let mut count = self.kept[template as usize].len() as u64;
        self.interfaces(instance, &mut |_, _, _| count += 1);
        count
    }

    /// Gives the triangles of some instances, with ids of the whole mesh or, when `local`, of the
    /// template.
    pub(crate) fn give_triangles<const CORNERS: bool>(
        &self,
        instances: Range<usize>,
        local: bool,
        sink: &mut TriangleSink<'_>,
    ) -> io::Result<()> {
        let mut ids = Vec::new();
        let mut block = Block::default();
        for i in instances {
            let instance = &self.document.instances[i];
            let triangles = &self.document.templates[instance.template as usize].triangles;
            if triangles.is_empty() {
                continue;
            }
            self.point_ids(i, local, &mut ids);
            let reversed = instance.isometry.reverses_orientation();
            let world = self.world(instance.isometry);
            let mut add = |block: &mut Block, t: u32, sides: Option<[u32; 2]>| {
                let triangle = &triangles[t as usize];
                let [a, b, c] = triangle.vertices;
                let turned = if reversed { [a, c, b] } else { [a, b, c] };
                let stored = [triangle.front, triangle.back];
                let placed = stored.map(|region| self.document.placed_region(instance, region));
                block.vertices.push(turned.map(|v| ids[v as usize]));
                if let Some(all) = self.middles {
                    let middles = all.triangles[instance.template as usize][t as usize];
                    let turned = if reversed {
                        Middles::turned(middles)
                    } else {
                        middles
                    };
                    block.middles.push(turned.map(|v| ids[v as usize]));
                }
                if CORNERS {
                    let corners = turned.map(|v| self.position(i, v, &world));
                    block.corners.push(corners);
                }
                block.markers.push(triangle.marker);
                let walls = self.open.walls.get(instance.template as usize);
                block.walls.push(walls.map_or(0, |walls| walls[t as usize]));
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
        if self.promise.group.is_trivial() {
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
        &self.open.names
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
        self.give_tets(0..self.document.instances.len(), false, sink)
    }

    fn tet_regions(&self, sink: &mut TetRegionSink<'_>) -> io::Result<()> {
        self.give_regions(0..self.document.instances.len(), sink)
    }

    fn triangles(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        self.give_triangles::<false>(0..self.document.instances.len(), false, sink)
    }

    fn facets(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        self.give_triangles::<true>(0..self.document.instances.len(), false, sink)
    }

    fn patches(&self) -> &[Patch] {
        &self.patches
    }

    fn patch(&self, patch: usize, sides: bool, sink: &mut PatchSink<'_>) -> io::Result<()> {
        let label = self.patches[patch].label;
        let (mut vertices, mut middles, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        let mut interfaces = Vec::new();
        for (i, instance) in self.document.instances.iter().enumerate() {
            let t = instance.template as usize;
            let triangles = &self.document.templates[t].triangles;
            let kept = self.labelled[t].get(&label).map_or(&[][..], Vec::as_slice);
            interfaces.clear();
            if self.has_interfaces[i] {
                self.interfaces(i, &mut |triangle, _, _| {
                    if marker_label(triangles[triangle as usize].marker) == label {
                        interfaces.push(triangle);
                    }
                });
            }
            let reversed = instance.isometry.reverses_orientation();
            for part in kept.chunks(BLOCK).chain(interfaces.chunks(BLOCK)) {
                vertices.clear();
                middles.clear();
                faces.clear();
                for &at in part {
                    let triangle = &triangles[at as usize];
                    let inward = triangle.back == OUTSIDE && triangle.front != OUTSIDE;
                    let turn = reversed != inward;
                    let [a, b, c] = triangle.vertices;
                    let turned = if turn { [a, c, b] } else { [a, b, c] };
                    vertices.push(turned.map(|v| self.numbering.id(i, v)));
                    if let Some(all) = self.middles {
                        let ids = all.triangles[t][at as usize];
                        let turned = if turn { Middles::turned(ids) } else { ids };
                        middles.push(turned.map(|v| self.numbering.id(i, v)));
                    }
                    if sides {
                        let side = self.sides()[t][at as usize];
                        faces.push(placed_side(side, self.first_tet[i], reversed));
                    }
                }
                sink(&PatchBlock {
                    vertices: &vertices,
                    middles: &middles,
                    sides: &faces,
                })?;
            }
        }
        Ok(())
    }

    fn is_second_order(&self) -> bool {
        self.middles.is_some()
    }

    fn wall_normals(&self) -> &[Option<DVec3>] {
        &self.open.normals
    }

    fn couplings(&self) -> &[Coupling] {
        &self.open.couplings
    }

    fn axis_edges(&self) -> &[[u32; 2]] {
        &self.open.axis_edges
    }
}

/// Triangles on their way to a sink.
#[derive(Default)]
struct Block {
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
