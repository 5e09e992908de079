//! Global vertex ids of all instances.

use super::classes::{Numbered, Shift, TemplateIds};
use super::error::NumberingError;
use super::nodes::Nodes;
use super::places::{Neighbours, Places};
use tmesh::Document;

/// Global vertex ids of all instances of a document.
pub struct Numbering {
    numbered: Numbered,
    places: Places,
    neighbours: Neighbours,
    template_of: Vec<usize>,
}

impl Numbering {
    /// Numbers the vertices of all instances of a valid document (see [`tmesh::validate`]).
    ///
    /// A wall beyond which nothing is placed stays open, so a single instance is not welded to
    /// anything. Time and memory are linear in the templates, plus the number of instances times
    /// the number of classes (interior, walls, axis, lines where walls meet).
    ///
    /// # Errors
    /// Instances that do not close up, and more points than `u32` can number.
    pub fn new(document: &Document) -> Result<Self, NumberingError> {
        let places = Places::new(&document.instances, document.templates.len());
        let neighbours = places.neighbours(document)?;
        let mut nodes = Nodes::new(document, &places, &neighbours);
        let numbered = Numbered::new(document, &places, &mut nodes)?;
        let template_of = document.instances.iter().map(|i| i.template as usize);
        Ok(Self {
            numbered,
            places,
            neighbours,
            template_of: template_of.collect(),
        })
    }

    /// The vertices of an instance's template, and the instance's slot.
    fn of(&self, instance: usize) -> (&TemplateIds, usize) {
        let template = &self.numbered.templates[self.template_of[instance]];
        (template, self.places.slot[instance] as usize)
    }

    /// Number of points of the assembled mesh.
    pub fn point_count(&self) -> u32 {
        self.numbered.count
    }

    /// Fills `ids` with the global id of every vertex of the instance's template.
    pub fn ids(&self, instance: usize, ids: &mut Vec<u32>) {
        let (template, slot) = self.of(instance);
        let start = |s: &Shift| self.numbered.classes[s.class].start[s.slot[slot] as usize];
        let start: Vec<u32> = template.shifts.iter().map(start).collect();
        ids.clear();
        let vertices = template.shift.iter().zip(&template.index);
        ids.extend(vertices.map(|(&s, &i)| start[s as usize] + i));
    }

    /// The global id of one vertex of the instance's template.
    pub fn id(&self, instance: usize, vertex: u32) -> u32 {
        let (template, slot) = self.of(instance);
        let shift = &template.shifts[template.shift[vertex as usize] as usize];
        let start = &self.numbered.classes[shift.class].start;
        start[shift.slot[slot] as usize] + template.index[vertex as usize]
    }

    /// Blocks of vertices that the instance owns, in the order of their ids: visiting the instances
    /// in order gives every point once, with ids 0, 1, 2, ...
    pub fn owned(&self, instance: usize) -> impl Iterator<Item = &[u32]> {
        let (template, slot) = self.of(instance);
        let classes = template.classes.iter().map(|&c| &self.numbered.classes[c]);
        classes
            .filter(move |c| c.owner[slot] as usize == slot)
            .map(|c| c.vertices.as_slice())
    }

    /// The instance that owns a vertex of an instance, and which vertex of its template it is
    /// there. All copies of a point have the same owner.
    pub fn owner(&self, instance: usize, vertex: u32) -> (usize, u32) {
        let (template, slot) = self.of(instance);
        let shift = &template.shifts[template.shift[vertex as usize] as usize];
        let class = &self.numbered.classes[shift.class];
        let slot = class.owner[shift.slot[slot] as usize];
        let owner = self.places.of_template[class.template][slot as usize];
        let index = template.index[vertex as usize];
        (owner as usize, class.vertices[index as usize])
    }

    /// Whether anything is placed beyond a wall of a template.
    pub fn is_closed(&self, template: usize, wall: usize) -> bool {
        self.neighbours[template][wall].is_some()
    }

    /// Whether anything is welded at all.
    pub fn has_closed_walls(&self) -> bool {
        self.neighbours.iter().flatten().any(Option::is_some)
    }

    /// The instance beyond a wall (beyond the high face of a seam), if anything is placed there.
    pub fn neighbour(&self, instance: usize, wall: usize) -> Option<usize> {
        let beyond = self.neighbours[self.template_of[instance]][wall].as_ref()?;
        Some(beyond[self.places.slot[instance] as usize] as usize)
    }
}
