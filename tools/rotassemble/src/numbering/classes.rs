//! Classes of vertices and the ids of their cosets.

use super::error::NumberingError;
use super::nodes::Nodes;
use super::orbit::{Orbits, SetId};
use super::places::Places;
use geom::sets::DisjointSets;
use rustc_hash::FxHashMap;
use tmesh::{Document, Isometry};

/// Stands for a vertex that is not sorted yet.
const NONE: u32 = u32::MAX;

/// Vertices of one template with the same stabilizer.
pub struct Class {
    /// The template.
    pub template: usize,
    /// The template's vertices in the class, increasing.
    pub vertices: Vec<u32>,
    /// First id of the coset, per slot (position among the template's instances).
    pub start: Vec<u32>,
    /// Slot of the instance that owns the coset, per slot.
    pub owner: Vec<u32>,
}

/// Vertices of one template that are vertices of one class, of instances shifted alike: `(g, x)` is
/// `(g * s, y)` with the same `s` for all of them.
pub struct Shift {
    /// The class.
    pub class: usize,
    /// Slot of the shifted instance in the class's template, per slot of this template.
    pub slot: Vec<u32>,
}

/// The vertices of a template by shift and class.
#[derive(Default)]
pub struct TemplateIds {
    /// Shift per vertex, an index into `shifts`; empty for templates that are not placed.
    pub shift: Vec<u32>,
    /// Position within the class, per vertex.
    pub index: Vec<u32>,
    /// The shifts.
    pub shifts: Vec<Shift>,
    /// Classes whose vertices this template owns.
    pub classes: Vec<usize>,
}

/// The vertices of all templates, sorted into classes that are numbered.
pub struct Numbered {
    /// Vertices by template.
    pub templates: Vec<TemplateIds>,
    /// All classes.
    pub classes: Vec<Class>,
    /// Number of ids given.
    pub count: u32,
}

impl Numbered {
    /// Sorts the vertices into classes and numbers their cosets.
    ///
    /// # Errors
    /// Instances that do not close up, and more points than `u32` can number.
    pub fn new(
        document: &Document,
        places: &Places,
        nodes: &mut Nodes,
    ) -> Result<Self, NumberingError> {
        let templates = document.templates.iter().map(|_| TemplateIds::default());
        let mut sorting = Sorting {
            document,
            places,
            templates: templates.collect(),
            classes: Vec::new(),
            stabilizers: Vec::new(),
            class_ids: FxHashMap::default(),
        };
        sorting.sort_representatives(nodes);
        sorting.sort_others(nodes)?;
        sorting.find_cosets(&nodes.orbits)?;
        sorting.number()
    }
}

/// The work of [`Numbered::new`].
struct Sorting<'a> {
    document: &'a Document,
    places: &'a Places,
    templates: Vec<TemplateIds>,
    classes: Vec<Class>,
    /// Stabilizer of each class.
    stabilizers: Vec<SetId>,
    /// Class, and its shift by nothing, per template and stabilizer.
    class_ids: FxHashMap<(usize, SetId), (usize, u32)>,
}

impl Sorting<'_> {
    /// Sorts the vertices that represent themselves into classes.
    fn sort_representatives(&mut self, nodes: &mut Nodes) {
        for (t, template) in self.document.templates.iter().enumerate() {
            if self.places.of_template[t].is_empty() {
                continue;
            }
            let count = template.vertices.len();
            self.templates[t].shift = vec![NONE; count];
            self.templates[t].index = vec![NONE; count];
            for v in 0..count {
                let set = match nodes.of_vertex[t].get(v) {
                    Some(&node) if node != Nodes::NONE => match nodes.orbits.find(node) {
                        (root, _) if root == node => nodes.orbits.set(root),
                        _ => continue,
                    },
                    _ => Orbits::FREE,
                };
                let (class, shift) = self.class(t, set);
                let vertices = &mut self.classes[class].vertices;
                self.templates[t].shift[v] = shift;
                self.templates[t].index[v] = vertices.len() as u32;
                vertices.push(v as u32);
            }
        }
    }

    /// Gives the other vertices the class and the index of those that represent them.
    fn sort_others(&mut self, nodes: &mut Nodes) -> Result<(), NumberingError> {
        let mut known: FxHashMap<(usize, usize, Isometry), u32> = FxHashMap::default();
        for node in 0..nodes.vertex.len() as u32 {
            let (root, offset) = nodes.orbits.find(node);
            if root == node {
                continue;
            }
            let (t, v) = nodes.vertex[node as usize];
            let (root_t, root_v) = nodes.vertex[root as usize];
            let (t, root_t) = (t as usize, root_t as usize);
            let (class, _) = self.class_ids[&(root_t, nodes.orbits.set(root))];
            let index = self.templates[root_t].index[root_v as usize];
            let key = (t, class, offset);
            let shift = match known.get(&key) {
                Some(&shift) => shift,
                None => {
                    let slot = self.shifted(t, root_t, offset)?;
                    let shifts = &mut self.templates[t].shifts;
                    shifts.push(Shift { class, slot });
                    let shift = shifts.len() as u32 - 1;
                    known.insert(key, shift);
                    shift
                }
            };
            self.templates[t].shift[v as usize] = shift;
            self.templates[t].index[v as usize] = index;
        }
        Ok(())
    }

    /// The class of a template's vertices with a stabilizer, and its shift by nothing.
    fn class(&mut self, template: usize, set: SetId) -> (usize, u32) {
        *self.class_ids.entry((template, set)).or_insert_with(|| {
            let ids = &mut self.templates[template];
            let (class, shift) = (self.classes.len(), ids.shifts.len());
            ids.classes.push(class);
            let slots = self.places.of_template[template].len() as u32;
            let slot = (0..slots).collect();
            ids.shifts.push(Shift { class, slot });
            self.stabilizers.push(set);
            self.classes.push(Class {
                template,
                vertices: Vec::new(),
                start: Vec::new(),
                owner: Vec::new(),
            });
            (class, shift as u32)
        })
    }

    /// Slots, among the instances of `target`, of the instances of `template` shifted by `offset`.
    fn shifted(
        &self,
        template: usize,
        target: usize,
        offset: Isometry,
    ) -> Result<Vec<u32>, NumberingError> {
        let shift = |&i: &u32| {
            let isometry = self.document.instances[i as usize].isometry;
            let slot = self.places.slot_of(target, isometry.compose(offset));
            slot.ok_or(NumberingError::Incomplete {
                template,
                isometry,
                other: target,
            })
        };
        self.places.of_template[template]
            .iter()
            .map(shift)
            .collect()
    }

    /// Finds the cosets of every class and who owns them.
    fn find_cosets(&mut self, orbits: &Orbits) -> Result<(), NumberingError> {
        for class in 0..self.classes.len() {
            let template = self.classes[class].template;
            let count = self.places.of_template[template].len();
            let mut cosets = DisjointSets::new(count);
            for &generator in orbits.generators(self.stabilizers[class]) {
                let moved = self.shifted(template, template, generator)?;
                for (slot, &other) in moved.iter().enumerate() {
                    cosets.join(slot as u32, other);
                }
            }
            let slots = 0..count as u32;
            self.classes[class].owner = slots.map(|slot| cosets.find(slot)).collect();
            self.classes[class].start = vec![0; count];
        }
        Ok(())
    }

    /// Gives the cosets their ids, instance by instance.
    fn number(mut self) -> Result<Numbered, NumberingError> {
        let mut next = 0_u64;
        let mut starts = Vec::with_capacity(self.document.instances.len());
        for (i, instance) in self.document.instances.iter().enumerate() {
            let slot = self.places.slot[i] as usize;
            for &c in &self.templates[instance.template as usize].classes {
                let class = &self.classes[c];
                if class.owner[slot] as usize == slot {
                    starts.push((c, slot, next));
                    next += class.vertices.len() as u64;
                }
            }
        }
        let count = u32::try_from(next);
        let count = count.map_err(|_| NumberingError::TooManyPoints { points: next })?;
        for (c, slot, start) in starts {
            self.classes[c].start[slot] = start as u32;
        }
        for class in &mut self.classes {
            for slot in 0..class.start.len() {
                class.start[slot] = class.start[class.owner[slot] as usize];
            }
        }
        Ok(Numbered {
            templates: self.templates,
            classes: self.classes,
            count,
        })
    }
}
