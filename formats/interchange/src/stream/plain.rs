//! A document as it is stored: each template once, nothing welded.

use super::couplings::{axis_edges, couplings};
use super::sides::{NONE, by_label, face_tets, marker_label};
use super::walls::{label_walls, wall_normals};
use super::{
    Coupling, Label, MeshStream, Middles, Patch, PatchBlock, Side, TetBlock, TetRegionBlock,
    TriangleBlock,
};
use super::{PatchSink, PointSink, TetRegionSink, TetSink, TriangleSink};
use crate::WriteError;
use crate::title::document_title;
use glam::DVec3;
use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::io;
use tmesh::{Document, Instance, Isometry, Marker, OUTSIDE, Region, Source, Symmetry};

/// Elements per block: a few hundred kilobytes, which stay in a processor's cache from one writer to
/// the next. Files do not depend on it.
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
    wall_normals: Vec<Option<DVec3>>,
    /// Wall per triangle of each template, numbered as in [`MeshStream::wall_names`] plus one.
    walls: Vec<Vec<u32>>,
    patches: Vec<Patch>,
    /// Triangles by label, per template.
    labelled: Vec<BTreeMap<Label, Vec<u32>>>,
    /// Tetrahedra that triangles are faces of, per template.
    sides: OnceCell<Vec<Vec<(u32, u8)>>>,
    couplings: Vec<Coupling>,
    axis_edges: Vec<[u32; 2]>,
    middles: Option<&'a Middles>,
}

impl<'a> Plain<'a> {
    /// Wall per triangle of a template: 0 for none, else one plus the position of its name.
    pub fn walls_of(&self, template: usize) -> &[u32] {
        &self.walls[template]
    }

    /// The id of each template's first point.
    pub fn first_ids(&self) -> &[u32] {
        &self.first
    }

    /// The view of a valid document.
    ///
    /// # Errors
    /// More points in all templates together than `u32` can number.
    pub fn new(document: &'a Document) -> Result<Self, WriteError> {
        Self::of_order(document, None)
    }

    /// The view of a document that [`crate::second_order`] made, with its middles.
    ///
    /// # Errors
    /// As [`Plain::new`].
    pub fn of_order(
        document: &'a Document,
        middles: Option<&'a Middles>,
    ) -> Result<Self, WriteError> {
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
        let isometries: Vec<Isometry> = shown.iter().map(|(i, _)| i.isometry).collect();
        let (wall_names, walls) = label_walls(document);
        let wall_normals = wall_normals(document, &isometries, wall_names.len());
        let labelled: Vec<_> = document
            .templates
            .iter()
            .zip(&walls)
            .map(|(template, walls)| {
                let labels = template.triangles.iter().zip(walls);
                by_label((0..).zip(labels.map(|(triangle, &wall)| match wall {
                    0 => marker_label(triangle.marker),
                    wall => Label::Wall(wall - 1),
                })))
            })
            .collect();
        let mut counts: BTreeMap<Label, u64> = BTreeMap::new();
        for (&label, list) in labelled.iter().flatten() {
            *counts.entry(label).or_default() += list.len() as u64;
        }
        let patches = counts
            .into_iter()
            .map(|(label, triangles)| Patch { label, triangles })
            .collect();
        Ok(Self {
            couplings: couplings(document, &isometries, &first),
            axis_edges: axis_edges(document, &first, middles),
            document,
            shown,
            first,
            wall_names,
            wall_normals,
            walls,
            patches,
            labelled,
            sides: OnceCell::new(),
            middles,
        })
    }

    fn sides(&self) -> &[Vec<(u32, u8)>] {
        let templates = self.document.templates.iter();
        self.sides
            .get_or_init(|| templates.map(face_tets).collect())
    }

    fn world(&self, template: usize) -> impl Fn(DVec3) -> DVec3 + use<> {
        let placed = self.shown[template].0.isometry.placed();
        let frame = self.document.frame;
        move |p| frame.to_world(placed.apply(p))
    }

    fn give_triangles<const CORNERS: bool>(&self, sink: &mut TriangleSink<'_>) -> io::Result<()> {
        let (mut vertices, mut corners, mut middles) = (Vec::new(), Vec::new(), Vec::new());
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
            for (chunk, (part, walls)) in parts.enumerate() {
                vertices.clear();
                corners.clear();
                middles.clear();
                if let Some(all) = self.middles {
                    let at = chunk * BLOCK;
                    let ids = &all.triangles[t][at..at + part.len()];
                    middles.extend(ids.iter().map(|&ids| {
                        let turned = if reversed { Middles::turned(ids) } else { ids };
                        turned.map(|v| first + v)
                    }));
                }
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
                    middles: &middles,
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

impl MeshStream for Plain<'_> {
    fn findings(&self) -> Option<(&Symmetry, Option<&Source>)> {
        let symmetry = self.document.symmetry.as_ref();
        let symmetry = symmetry.filter(|_| self.document.is_plain())?;
        Some((symmetry, self.document.source.as_ref()))
    }

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
        let (mut vertices, mut regions, mut middles) = (Vec::new(), Vec::new(), Vec::new());
        for (t, template) in self.document.templates.iter().enumerate() {
            let (instance, index) = self.shown[t];
            let reversed = instance.isometry.reverses_orientation();
            let first = self.first[t];
            for (chunk, part) in template.tets.chunks(BLOCK).enumerate() {
                middles.clear();
                if let Some(all) = self.middles {
                    let at = chunk * BLOCK;
                    let ids = &all.tets[t][at..at + part.len()];
                    middles.extend(ids.iter().map(|&ids| {
                        let turned = if reversed {
                            Middles::reversed(ids)
                        } else {
                            ids
                        };
                        turned.map(|v| first + v)
                    }));
                }
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
                    middles: &middles,
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

    fn patches(&self) -> &[Patch] {
        &self.patches
    }

    fn patch(&self, patch: usize, sides: bool, sink: &mut PatchSink<'_>) -> io::Result<()> {
        let label = self.patches[patch].label;
        let mut first_tet = 0;
        let (mut vertices, mut middles, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        for (t, template) in self.document.templates.iter().enumerate() {
            let reversed = self.shown[t].0.isometry.reverses_orientation();
            let first = self.first[t];
            let list = self.labelled[t].get(&label);
            for part in list.map_or(&[][..], Vec::as_slice).chunks(BLOCK) {
                vertices.clear();
                middles.clear();
                faces.clear();
                for &i in part {
                    let triangle = &template.triangles[i as usize];
                    let inward = triangle.back == OUTSIDE && triangle.front != OUTSIDE;
                    let turn = reversed != inward;
                    let [a, b, c] = triangle.vertices.map(|v| first + v);
                    vertices.push(if turn { [a, c, b] } else { [a, b, c] });
                    if let Some(all) = self.middles {
                        let ids = all.triangles[t][i as usize].map(|v| first + v);
                        middles.push(if turn { Middles::turned(ids) } else { ids });
                    }
                    if sides {
                        faces.push(placed_side(
                            self.sides()[t][i as usize],
                            first_tet,
                            reversed,
                        ));
                    }
                }
                sink(&PatchBlock {
                    vertices: &vertices,
                    middles: &middles,
                    sides: &faces,
                })?;
            }
            first_tet += template.tets.len() as u64;
        }
        Ok(())
    }

    fn is_second_order(&self) -> bool {
        self.middles.is_some()
    }

    fn wall_normals(&self) -> &[Option<DVec3>] {
        &self.wall_normals
    }

    fn couplings(&self) -> &[Coupling] {
        &self.couplings
    }

    fn axis_edges(&self) -> &[[u32; 2]] {
        &self.axis_edges
    }
}

/// A triangle's side as it is in a mesh where the template's tetrahedra begin at `first_tet`, with the
/// last two vertices of each swapped when `reversed`.
pub fn placed_side((tet, opposite): (u32, u8), first_tet: u64, reversed: bool) -> Side {
    let opposite = match opposite {
        2 if reversed => 3,
        3 if reversed => 2,
        other => other,
    };
    let tet = if tet == NONE {
        Side::NONE
    } else {
        first_tet + u64::from(tet)
    };
    Side { tet, opposite }
}
