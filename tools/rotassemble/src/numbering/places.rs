//! Where the instances of a document are, and which of them are neighbours.

use super::error::NumberingError;
use rustc_hash::FxHashMap;
use tmesh::{Document, Gluing, Instance, Isometry};

/// Where the instances are.
pub struct Places {
    /// Instances of each template, increasing.
    pub of_template: Vec<Vec<u32>>,
    /// Position of each instance among those of its template, its slot.
    pub slot: Vec<u32>,
    slots: FxHashMap<(u32, Isometry), u32>,
}

impl Places {
    /// Notes the places of all instances.
    pub fn new(instances: &[Instance], templates: usize) -> Self {
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

    /// Position of an instance among those of its template.
    pub fn slot_of(&self, template: usize, isometry: Isometry) -> Option<u32> {
        self.slots.get(&(template as u32, isometry)).copied()
    }
}

/// For each gluing of each template, the instance beyond it per slot; `None` where nothing is placed
/// beyond it.
pub type Neighbours = Vec<Vec<Option<Vec<u32>>>>;

impl Places {
    /// The instances beyond all gluings.
    ///
    /// # Errors
    /// Some instances of a template have a neighbour beyond a gluing and others have none.
    pub fn neighbours(&self, document: &Document) -> Result<Neighbours, NumberingError> {
        let templates = document.templates.iter().enumerate();
        let of_template = templates.map(|(t, template)| {
            let gluings = template.gluings.iter();
            gluings.map(|g| self.beyond(document, t, g)).collect()
        });
        of_template.collect()
    }

    fn beyond(
        &self,
        document: &Document,
        template: usize,
        gluing: &Gluing,
    ) -> Result<Option<Vec<u32>>, NumberingError> {
        let target = gluing.other as usize;
        let instances = &self.of_template[template];
        let mut beyond = Vec::with_capacity(instances.len());
        let mut missing = None;
        for &i in instances {
            let isometry = document.instances[i as usize].isometry;
            match self.slot_of(target, isometry.compose(gluing.step)) {
                Some(slot) => beyond.push(self.of_template[target][slot as usize]),
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
}
