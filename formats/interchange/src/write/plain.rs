//! A document as it is stored: each template once, nothing welded.

use super::WriteError;
use super::title::document_title;
use crate::stream::{PointSink, TetRegionSink, TetSink, TriangleSink};
use crate::{MeshStream, TetBlock, TetRegionBlock, TriangleBlock};
use glam::DVec3;
use std::io;
use tmesh::{Document, Instance, Isometry, Marker, Region, Wall};

/// Elements per block.
const BLOCK: usize = 8192;

/// A view of a document in which each template appears once, placed by its first instance (by the
/// identity when it has none), in world coordinates. Walls stay, and are labelled.
pub struct Plain<'a> {
    document: &'a Document,
    /// The instance that each template is shown as, and its index.
    shown: Vec<(Instance, u32)>,
    /// First point id of each template.
    first: Vec<u32>,
    wall_names: Vec<String>,
    /// Wall per triangle of each template, numbered as in [`MeshStream::wall_names`] plus one.
    walls: Vec<Vec<u32>>,
}

impl<'a> Plain<'a> {
    /// The view of a valid document.
    ///
    /// # Errors
    /// More points in all templates together than `u32` can number.
    pub fn new(document: &'a Document) -> Result<Self, WriteError> {
        let mut shown = Vec::new();
        let mut first = Vec::new();
        let mut count = 0_u64;
        for (t, template) in document.templates.iter().enumerate() {
            let t = t as u32;
            let mut instances = document.instances.iter().zip(0..);
            let instance = instances.find(|(i, _)| i.template == t);
            shown.push(instance.map_or_else(
                || {
                    (
                        Instance {
                            template: t,
                            isometry: Isometry::IDENTITY,
                            region_map: 0,
                        },
                        0,
                    )
                },
                |(instance, index)| (*instance, index),
            ));
            first.push(count as u32);
            count += template.vertices.len() as u64;
            if count > u64::from(u32::MAX) {
                return Err(WriteError::TooLarge {
                    format: "a mesh",
                    what: "points",
                    count,
                    limit: u64::from(u32::MAX),
                });
            }
        }
        let (wall_names, walls) = label_walls(document);
        Ok(Self {
            document,
            shown,
            first,
            wall_names,
            walls,
        })
    }

    fn world(&self, template: usize) -> impl Fn(DVec3) -> DVec3 + use<> {
        let placed = self.shown[template].0.isometry.placed();
        let frame = self.document.frame;
        move |p| frame.to_world(placed.apply(p))
    }

    fn give_triangles<const CORNERS: bool>(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        let (mut vertices, mut corners) = (Vec::new(), Vec::new());
        let (mut markers, mut front, mut back) = (Vec::new(), Vec::new(), Vec::new());
        for (t, template) in self.document.templates.iter().enumerate() {
            let (instance, index) = self.shown[t];
            let reversed = instance.isometry.reverses_orientation();
            let (first, world) = (self.first[t], self.world(t));
            let placed = |region| self.document.placed_region(&instance, region);
            let parts = template
                .triangles
                .chunks(BLOCK)
                .zip(self.walls[t].chunks(BLOCK));
            for (part, walls) in parts {
                vertices.clear();
                corners.clear();
                for triangle in part {
                    let [a, b, c] = triangle.vertices;
                    let turned = if reversed { [a, c, b] } else { [a, b, c] };
                    vertices.push(turned.map(|v| first + v));
                    if CORNERS {
                        corners.push(turned.map(|v| world(template.vertices[v as usize])));
                    }
                }
                markers.clear();
                markers.extend(part.iter().map(|t| t.marker));
                front.clear();
                front.extend(part.iter().map(|t| placed(t.front)));
                back.clear();
                back.extend(part.iter().map(|t| placed(t.back)));
                sink(&TriangleBlock {
                    vertices: &vertices,
                    corners: &corners,
                    markers: &markers,
                    front: &front,
                    back: &back,
                    walls,
                    instance: index,
                })?;
            }
        }
        Ok(())
    }
}

/// Names of all walls, the two faces of a seam apart, and the wall of each triangle.
fn label_walls(document: &Document) -> (Vec<String>, Vec<Vec<u32>>) {
    let mut names = Vec::new();
    let mut labels: Vec<Vec<u32>> = document
        .templates
        .iter()
        .map(|t| vec![0; t.triangles.len()])
        .collect();
    for (t, template) in document.templates.iter().enumerate() {
        for wall in &template.walls {
            let next = names.len() as u32 + 1;
            match wall {
                Wall::Mirror(w) => {
                    names.push(w.name.clone());
                    w.triangles
                        .iter()
                        .for_each(|&i| labels[t][i as usize] = next);
                }
                Wall::Seam(w) => {
                    names.extend([format!("{}-a", w.name), format!("{}-b", w.name)]);
                    for &[low, high] in &w.triangle_pairs {
                        labels[t][low as usize] = next;
                        labels[t][high as usize] = next + 1;
                    }
                }
                Wall::Hub(w) => {
                    // The face as each of the two templates sees it.
                    names.push(w.name.clone());
                    for &[here, there] in &w.triangle_pairs {
                        labels[t][here as usize] = next;
                        labels[w.other as usize][there as usize] = next;
                    }
                }
            }
        }
    }
    (names, labels)
}

impl MeshStream for Plain<'_> {
    fn title(&self) -> String {
        document_title(self.document)
    }

    fn point_count(&self) -> u64 {
        let templates = self.document.templates.iter();
        templates.map(|t| t.vertices.len() as u64).sum()
    }

    fn tet_count(&self) -> u64 {
        let templates = self.document.templates.iter();
        templates.map(|t| t.tets.len() as u64).sum()
    }

    fn triangle_count(&self) -> u64 {
        let templates = self.document.templates.iter();
        templates.map(|t| t.triangles.len() as u64).sum()
    }

    fn regions(&self) -> &[Region] {
        &self.document.regions
    }

    fn markers(&self) -> &[Marker] {
        &self.document.markers
    }

    fn wall_names(&self) -> &[String] {
        &self.wall_names
    }

    fn points(&self, sink: &mut PointSink<'_>) -> io::Result<()> {
        let mut block = Vec::new();
        for (t, template) in self.document.templates.iter().enumerate() {
            let world = self.world(t);
            for part in template.vertices.chunks(BLOCK) {
                block.clear();
                block.extend(part.iter().map(|&p| world(p)));
                sink(&block)?;
            }
        }
        Ok(())
    }

    fn tets(&self, sink: &mut TetSink<'_>) -> io::Result<()> {
        let (mut vertices, mut regions) = (Vec::new(), Vec::new());
        for (t, template) in self.document.templates.iter().enumerate() {
            let (instance, index) = self.shown[t];
            let reversed = instance.isometry.reverses_orientation();
            let first = self.first[t];
            for part in template.tets.chunks(BLOCK) {
                vertices.clear();
                vertices.extend(part.iter().map(|tet| {
                    let [a, b, c, d] = tet.vertices.map(|v| first + v);
                    if reversed { [a, b, d, c] } else { [a, b, c, d] }
                }));
                regions.clear();
                let placed = |region| self.document.placed_region(&instance, region);
                regions.extend(part.iter().map(|tet| placed(tet.region)));
                sink(&TetBlock {
                    vertices: &vertices,
                    regions: &regions,
                    instance: index,
                })?;
            }
        }
        Ok(())
    }

    fn tet_regions(&self, sink: &mut TetRegionSink<'_>) -> io::Result<()> {
        let mut regions = Vec::new();
        for (t, template) in self.document.templates.iter().enumerate() {
            let (instance, index) = self.shown[t];
            for part in template.tets.chunks(BLOCK) {
                regions.clear();
                let placed = |region| self.document.placed_region(&instance, region);
                regions.extend(part.iter().map(|tet| placed(tet.region)));
                sink(&TetRegionBlock {
                    regions: &regions,
                    instance: index,
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
