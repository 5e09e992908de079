//! The whole mesh: nothing of it is in memory but the templates.

use super::copies::Copies;
use super::open::{Open, Positions};
use crate::numbering::NumberingError;
use crate::promise::promise;
use interchange::sides::{by_label, face_tets, marker_label};
use interchange::{Label, Middles, Patch};
use std::cell::OnceCell;
use std::collections::BTreeMap;
use tmesh::{Document, Promise};

/// All instances of a document, welded along closed walls, in world coordinates.
///
/// Points are computed once, by the instance that owns them, so that no two copies differ.
/// Triangles on closed walls are left out unless the regions on their two sides differ: then they
/// are interfaces, and come once. Elements of orientation-reversing instances are turned over.
pub struct Assembled<'a> {
    pub(super) copies: Copies<'a>,
    promise: Promise,
    /// Triangles of each template that are on no closed wall, increasing.
    pub(super) kept: Vec<Vec<u32>>,
    /// The same by label.
    pub(super) labelled: Vec<BTreeMap<Label, Vec<u32>>>,
    /// Whether an instance has interfaces on closed walls.
    pub(super) has_interfaces: Vec<bool>,
    pub(super) triangle_count: u64,
    pub(super) patches: Vec<Patch>,
    /// Position of each instance's first tetrahedron.
    pub(super) first_tet: Vec<u64>,
    /// Tetrahedra that triangles are faces of, per template.
    sides: OnceCell<Vec<Vec<(u32, u8)>>>,
    pub(super) open: Open,
}

impl<'a> Assembled<'a> {
    /// The assembled mesh of a valid document.
    ///
    /// # Errors
    /// See [`crate::Numbering::new`].
    pub fn new(document: &'a Document) -> Result<Self, NumberingError> {
        Self::of_order(document, None)
    }

    /// The assembled mesh of a document that [`interchange::second_order`] made, with its middles.
    ///
    /// # Errors
    /// See [`crate::Numbering::new`].
    pub fn of_order(
        document: &'a Document,
        middles: Option<&'a Middles>,
    ) -> Result<Self, NumberingError> {
        let copies = Copies::new(document, middles)?;
        let mut mesh = Self {
            kept: copies.triangles_off_walls(),
            copies,
            promise: promise(document),
            labelled: Vec::new(),
            has_interfaces: Vec::new(),
            triangle_count: 0,
            patches: Vec::new(),
            first_tet: Vec::new(),
            sides: OnceCell::new(),
            open: Open::default(),
        };
        mesh.open = mesh.open_walls();
        mesh.labelled = mesh.by_label();
        mesh.count();
        Ok(mesh)
    }

    /// What is left open.
    fn open_walls(&self) -> Open {
        let copies = &self.copies;
        let mut next = 0;
        let mut first = Vec::with_capacity(copies.document.instances.len());
        for i in 0..copies.document.instances.len() {
            first.push(next);
            next += self.triangles_of(i);
        }
        let positions = Positions {
            kept: &self.kept,
            first: &first,
        };
        Open::of(
            copies.document,
            copies.middles,
            &copies.numbering,
            &positions,
        )
    }

    /// The triangles that come into the mesh, by label: that of an open wall, else that of the marker.
    fn by_label(&self) -> Vec<BTreeMap<Label, Vec<u32>>> {
        let templates = self.copies.document.templates.iter();
        let lists = templates.zip(&self.kept).enumerate();
        lists
            .map(|(t, (template, list))| {
                let walls = self.open.walls.get(t);
                by_label(
                    list.iter()
                        .map(|&i| match walls.map_or(0, |w| w[i as usize]) {
                            0 => (i, marker_label(template.triangles[i as usize].marker)),
                            wall => (i, Label::Wall(wall - 1)),
                        }),
                )
            })
            .collect()
    }

    /// Counts the triangles by label, and the tetrahedra before each instance.
    fn count(&mut self) {
        let document = self.copies.document;
        let mut counts: BTreeMap<Label, u64> = BTreeMap::new();
        let mut first_tet = 0;
        for (i, instance) in document.instances.iter().enumerate() {
            let template = &document.templates[instance.template as usize];
            for (&label, list) in &self.labelled[instance.template as usize] {
                *counts.entry(label).or_default() += list.len() as u64;
            }
            let mut any = false;
            self.copies.interfaces(i, &mut |triangle, _, _| {
                let label = marker_label(template.triangles[triangle as usize].marker);
                *counts.entry(label).or_default() += 1;
                any = true;
            });
            self.has_interfaces.push(any);
            self.first_tet.push(first_tet);
            first_tet += template.tets.len() as u64;
        }
        self.triangle_count = counts.values().sum();
        let patches = counts.into_iter();
        self.patches = patches
            .map(|(label, triangles)| Patch { label, triangles })
            .collect();
    }

    /// Number of triangles of one instance.
    pub(super) fn triangles_of(&self, instance: usize) -> u64 {
        let template = self.copies.document.instances[instance].template;
        let mut count = self.kept[template as usize].len() as u64;
        self.copies.interfaces(instance, &mut |_, _, _| count += 1);
        count
    }

    /// The tetrahedron that each triangle of each template is a face of.
    pub(super) fn sides(&self) -> &[Vec<(u32, u8)>] {
        let templates = self.copies.document.templates.iter();
        self.sides
            .get_or_init(|| templates.map(face_tets).collect())
    }

    /// The symmetry the mesh has by construction.
    pub fn promise(&self) -> &Promise {
        &self.promise
    }

    /// Whether any two instances are welded.
    pub fn is_welded(&self) -> bool {
        self.copies.numbering.has_closed_walls()
    }
}
