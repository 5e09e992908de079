//! Global vertex ids of an assembled mesh, by index arithmetic.
//!
//! Vertices of a template that are fixed by the same isometries (see [`crate::orbit`]) form a
//! *class*: the interior, each wall, the axis, each line where walls meet. Within a class the
//! copies of a vertex are the cosets of its stabilizer, the same for every vertex of the class, so
//! one small table per class, from instance to the first id of the coset, numbers them all:
//! `id = start[class][instance] + index_in_class`. The weld is exact whatever the rounding, the
//! number of points is known before any is written, and nothing is stored per copy.
//!
//! Ids are contiguous per instance: first the vertices that the first instance owns, then those of
//! the second that are not shared with the first, and so on.

use crate::orbit::{Orbits, SetId};
use geom::sets::DisjointSets;
use rustc_hash::FxHashMap;
use thiserror::Error;
use tmesh::{Document, Gluing, Instance, Isometry};

/// Why the copies of a document cannot be numbered.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NumberingError {
    /// Some instances have a neighbour across a wall and others have none.
    #[error(
        "instance {isometry} of template {template} has no neighbour across wall '{wall}', though \
         others have"
    )]
    MissingNeighbour {
        /// Template index.
        template: usize,
        /// The instance's placement.
        isometry: Isometry,
        /// The wall's name.
        wall: String,
    },
    /// A chain of walls leads to a placement that is not among the instances.
    #[error(
        "following the walls from instance {isometry} of template {template} leads to a placement \
         of template {other} that is not there"
    )]
    Incomplete {
        /// Template index.
        template: usize,
        /// The instance's placement.
        isometry: Isometry,
        /// Template at the end of the chain.
        other: usize,
    },
    /// More points than ids.
    #[error(
        "the assembled mesh has {points} points, and vertex ids end at {}",
        u32::MAX
    )]
    TooManyPoints {
        /// Points needed.
        points: u64,
    },
}

const NONE: u32 = u32::MAX;

/// Vertices of one template with the same stabilizer.
struct Class {
    template: usize,
    /// The template's vertices in the class, increasing.
    vertices: Vec<u32>,
    /// First id of the coset, per slot (position among the template's instances).
    start: Vec<u32>,
    /// Slot of the instance that owns the coset, per slot.
    owner: Vec<u32>,
}

/// Vertices of one template that belong to one class after the same shift of instance.
struct Group {
    class: usize,
    /// Slot of the shifted instance in the class's template, per slot of this template.
    slot: Vec<u32>,
}

#[derive(Default)]
struct TemplateIds {
    /// Group per vertex, an index into `groups`.
    group: Vec<u32>,
    /// Position within the class, per vertex.
    index: Vec<u32>,
    groups: Vec<Group>,
    /// Classes whose vertices this template owns.
    classes: Vec<usize>,
    /// Instances of the template, increasing.
    instances: Vec<u32>,
    /// For each wall, the instance beyond it per slot; `None` when nothing is placed there.
    neighbours: Vec<Option<Vec<u32>>>,
}

/// Global vertex ids of all instances of a document.
pub struct Numbering {
    templates: Vec<TemplateIds>,
    classes: Vec<Class>,
    /// Slot per instance.
    slot: Vec<u32>,
    template_of: Vec<usize>,
    point_count: u32,
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
        let mut templates: Vec<TemplateIds> = Vec::with_capacity(document.templates.len());
        for (t, template) in document.templates.iter().enumerate() {
            let mut ids = TemplateIds {
                instances: places.of_template[t].clone(),
                ..TemplateIds::default()
            };
            for gluing in &template.gluings {
                let beyond = neighbours(document, &places, t, gluing)?;
                ids.neighbours.push(beyond);
            }
            templates.push(ids);
        }
        let mut nodes = Nodes::new(document, &templates);
        let mut builder = Builder {
            document,
            places: &places,
            classes: Vec::new(),
            class_ids: FxHashMap::default(),
            next: 0,
        };
        builder.sort_vertices(&mut templates, &mut nodes)?;
        builder.number(&templates, &nodes.orbits)?;
        let (classes, points) = (builder.classes, builder.next);
        let template_of = document.instances.iter().map(|i| i.template as usize);
        Ok(Self {
            templates,
            classes,
            template_of: template_of.collect(),
            slot: places.slot,
            point_count: points as u32,
        })
    }

    /// Number of points of the assembled mesh.
    pub fn point_count(&self) -> u32 {
        self.point_count
    }

    /// Fills `ids` with the global id of every vertex of the instance's template.
    pub fn ids(&self, instance: usize, ids: &mut Vec<u32>) {
        let slot = self.slot[instance] as usize;
        let template = &self.templates[self.template_of[instance]];
        let start: Vec<u32> = template
            .groups
            .iter()
            .map(|g| self.classes[g.class].start[g.slot[slot] as usize])
            .collect();
        ids.clear();
        ids.extend(
            template
                .group
                .iter()
                .zip(&template.index)
                .map(|(&g, &i)| start[g as usize] + i),
        );
    }

    /// The global id of one vertex of the instance's template.
    pub fn id(&self, instance: usize, vertex: u32) -> u32 {
        let template = &self.templates[self.template_of[instance]];
        let group = &template.groups[template.group[vertex as usize] as usize];
        let slot = group.slot[self.slot[instance] as usize];
        self.classes[group.class].start[slot as usize] + template.index[vertex as usize]
    }

    /// Blocks of vertices that the instance owns, in the order of their ids: visiting the instances
    /// in order gives every point once, with ids 0, 1, 2, ...
    pub fn owned(&self, instance: usize) -> impl Iterator<Item = &[u32]> {
        let slot = self.slot[instance];
        let template = &self.templates[self.template_of[instance]];
        template
            .classes
            .iter()
            .map(|&c| &self.classes[c])
            .filter(move |c| c.owner[slot as usize] == slot)
            .map(|c| c.vertices.as_slice())
    }

    /// The instance that owns a vertex of an instance, and which vertex of its template it is
    /// there. All copies of a point have the same owner.
    pub fn owner(&self, instance: usize, vertex: u32) -> (usize, u32) {
        let template = &self.templates[self.template_of[instance]];
        let group = &template.groups[template.group[vertex as usize] as usize];
        let class = &self.classes[group.class];
        let slot = class.owner[group.slot[self.slot[instance] as usize] as usize];
        let owner = self.templates[class.template].instances[slot as usize];
        let index = template.index[vertex as usize];
        (owner as usize, class.vertices[index as usize])
    }

    /// Whether anything is placed beyond a wall of a template.
    pub fn is_closed(&self, template: usize, wall: usize) -> bool {
        self.templates[template].neighbours[wall].is_some()
    }

    /// Whether anything is welded at all.
    pub fn has_closed_walls(&self) -> bool {
        let mut walls = self.templates.iter().flat_map(|t| &t.neighbours);
        walls.any(Option::is_some)
    }

    /// The instance beyond a wall (beyond the high face of a seam), if anything is placed there.
    pub fn neighbour(&self, instance: usize, wall: usize) -> Option<usize> {
        let beyond = self.templates[self.template_of[instance]].neighbours[wall].as_ref()?;
        Some(beyond[self.slot[instance] as usize] as usize)
    }
}

/// Where the instances are.
struct Places {
    /// Instances of each template, increasing.
    of_template: Vec<Vec<u32>>,
    /// Position of each instance among those of its template.
    slot: Vec<u32>,
    slots: FxHashMap<(u32, Isometry), u32>,
}

impl Places {
    fn new(instances: &[Instance], templates: usize) -> Self {
        let mut of_template = vec![Vec::new(); templates];
        let mut slot = Vec::with_capacity(instances.len());
        let mut slots = FxHashMap::default();
        for (i, instance) in instances.iter().enumerate() {
            let list = &mut of_template[instance.template as usize];
            let at = list.len() as u32;
            slot.push(at);
            slots.insert((instance.template, instance.isometry), at);
            list.push(i as u32);
        }
        Self {
            of_template,
            slot,
            slots,
        }
    }

    fn slot_of(&self, template: usize, isometry: Isometry) -> Option<u32> {
        self.slots.get(&(template as u32, isometry)).copied()
    }
}

fn neighbours(
    document: &Document,
    places: &Places,
    template: usize,
    gluing: &Gluing,
) -> Result<Option<Vec<u32>>, NumberingError> {
    let target = gluing.other as usize;
    let instances = &places.of_template[template];
    let mut beyond = Vec::with_capacity(instances.len());
    let mut missing = None;
    for &i in instances {
        let isometry = document.instances[i as usize].isometry;
        match places.slot_of(target, isometry.compose(gluing.step)) {
            Some(slot) => beyond.push(places.of_template[target][slot as usize]),
            None => missing = missing.or(Some(isometry)),
        }
    }
    match missing {
        None if !beyond.is_empty() => Ok(Some(beyond)),
        Some(isometry) if !beyond.is_empty() => Err(NumberingError::MissingNeighbour {
            template,
            isometry,
            wall: gluing.name.clone(),
        }),
        _ => Ok(None),
    }
}

/// The vertices that lie on closed walls, and how they relate.
struct Nodes {
    orbits: Orbits,
    /// Node per vertex of each template, or [`NONE`]; empty for templates without closed walls.
    of_vertex: Vec<Vec<u32>>,
    /// Template and vertex of each node.
    vertex: Vec<(u32, u32)>,
}

impl Nodes {
    fn new(document: &Document, templates: &[TemplateIds]) -> Self {
        let mut nodes = Self {
            orbits: Orbits::new(),
            of_vertex: vec![Vec::new(); document.templates.len()],
            vertex: Vec::new(),
        };
        // The template with more instances represents shared vertices: each of the others'
        // instances leads to one of its, but not the other way round.
        let node = |nodes: &mut Self, t: usize, v: u32| {
            let of_vertex = &mut nodes.of_vertex[t];
            if of_vertex.is_empty() {
                of_vertex.resize(document.templates[t].vertices.len(), NONE);
            }
            let entry = &mut of_vertex[v as usize];
            if *entry == NONE {
                *entry = nodes.orbits.add(templates[t].instances.len() as u32);
                nodes.vertex.push((t as u32, v));
            }
            *entry
        };
        for (t, template) in document.templates.iter().enumerate() {
            for (w, gluing) in template.gluings.iter().enumerate() {
                if templates[t].neighbours[w].is_none() {
                    continue;
                }
                for &[here, there] in &gluing.vertex_pairs {
                    let here = node(&mut nodes, t, here);
                    let there = node(&mut nodes, gluing.other as usize, there);
                    nodes.orbits.relate(here, gluing.step, there);
                }
            }
        }
        nodes
    }
}

struct Builder<'a> {
    document: &'a Document,
    places: &'a Places,
    classes: Vec<Class>,
    /// Class, and its group of unshifted instances, per template and stabilizer.
    class_ids: FxHashMap<(usize, SetId), (usize, u32)>,
    /// First id not yet given.
    next: u64,
}

impl Builder<'_> {
    /// Sorts the vertices of all templates into classes and groups.
    fn sort_vertices(
        &mut self,
        templates: &mut [TemplateIds],
        nodes: &mut Nodes,
    ) -> Result<(), NumberingError> {
        // Vertices that represent themselves come first: the others take their index from them.
        for (t, ids) in templates.iter_mut().enumerate() {
            if ids.instances.is_empty() {
                continue;
            }
            let count = self.document.templates[t].vertices.len();
            ids.group = vec![NONE; count];
            ids.index = vec![NONE; count];
            for v in 0..count {
                let set = match nodes.of_vertex[t].get(v) {
                    Some(&node) if node != NONE => match nodes.orbits.find(node) {
                        (root, _) if root == node => nodes.orbits.set(root),
                        _ => continue,
                    },
                    _ => Orbits::FREE,
                };
                let (class, group) = self.class(t, set, ids);
                let vertices = &mut self.classes[class].vertices;
                ids.group[v] = group;
                ids.index[v] = vertices.len() as u32;
                vertices.push(v as u32);
            }
        }
        let mut groups: FxHashMap<(usize, usize, Isometry), u32> = FxHashMap::default();
        for node in 0..nodes.vertex.len() as u32 {
            let (root, offset) = nodes.orbits.find(node);
            if root == node {
                continue;
            }
            let (t, v) = nodes.vertex[node as usize];
            let (root_t, root_v) = nodes.vertex[root as usize];
            let (class, _) = self.class_ids[&(root_t as usize, nodes.orbits.set(root))];
            let index = templates[root_t as usize].index[root_v as usize];
            let ids = &mut templates[t as usize];
            let key = (t as usize, class, offset);
            let group = match groups.get(&key) {
                Some(&group) => group,
                None => {
                    let slot = self.shifted(t as usize, root_t as usize, offset, &ids.instances)?;
                    ids.groups.push(Group { class, slot });
                    let group = ids.groups.len() as u32 - 1;
                    groups.insert(key, group);
                    group
                }
            };
            ids.group[v as usize] = group;
            ids.index[v as usize] = index;
        }
        Ok(())
    }

    fn class(&mut self, template: usize, set: SetId, ids: &mut TemplateIds) -> (usize, u32) {
        *self.class_ids.entry((template, set)).or_insert_with(|| {
            let (class, group) = (self.classes.len(), ids.groups.len());
            ids.classes.push(class);
            let slot = (0..ids.instances.len() as u32).collect();
            ids.groups.push(Group { class, slot });
            self.classes.push(Class {
                template,
                vertices: Vec::new(),
                start: Vec::new(),
                owner: Vec::new(),
            });
            (class, group as u32)
        })
    }

    /// Slots, among the instances of `target`, of the given instances shifted by `offset`.
    fn shifted(
        &self,
        template: usize,
        target: usize,
        offset: Isometry,
        instances: &[u32],
    ) -> Result<Vec<u32>, NumberingError> {
        instances
            .iter()
            .map(|&i| {
                let isometry = self.document.instances[i as usize].isometry;
                self.places.slot_of(target, isometry.compose(offset)).ok_or(
                    NumberingError::Incomplete {
                        template,
                        isometry,
                        other: target,
                    },
                )
            })
            .collect()
    }

    /// Finds the cosets of every class and gives them their ids, instance by instance.
    fn number(&mut self, templates: &[TemplateIds], orbits: &Orbits) -> Result<(), NumberingError> {
        let mut stabilizers = vec![Orbits::FREE; self.classes.len()];
        for (&(_, set), &(class, _)) in &self.class_ids {
            stabilizers[class] = set;
        }
        for (class, set) in stabilizers.into_iter().enumerate() {
            let template = self.classes[class].template;
            let instances = &templates[template].instances;
            let mut cosets = DisjointSets::new(instances.len());
            for &generator in orbits.generators(set) {
                let moved = self.shifted(template, template, generator, instances)?;
                for (slot, &other) in moved.iter().enumerate() {
                    cosets.join(slot as u32, other);
                }
            }
            let slots = 0..instances.len() as u32;
            self.classes[class].owner = slots.map(|slot| cosets.find(slot)).collect();
            self.classes[class].start = vec![0; instances.len()];
        }
        let mut starts = Vec::with_capacity(self.document.instances.len());
        for (i, instance) in self.document.instances.iter().enumerate() {
            let slot = self.places.slot[i] as usize;
            for &c in &templates[instance.template as usize].classes {
                let class = &self.classes[c];
                if class.owner[slot] as usize == slot {
                    starts.push((c, slot, self.next));
                    self.next += class.vertices.len() as u64;
                }
            }
        }
        if self.next > u64::from(u32::MAX) {
            return Err(NumberingError::TooManyPoints { points: self.next });
        }
        for (c, slot, start) in starts {
            self.classes[c].start[slot] = start as u32;
        }
        for class in &mut self.classes {
            for slot in 0..class.start.len() {
                class.start[slot] = class.start[class.owner[slot] as usize];
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
