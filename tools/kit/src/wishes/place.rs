//! What vertices are on, in words.

use rustc_hash::FxHashMap;
use tmesh::{Document, Template};

/// What a vertex or an edge is on; what comes first says more.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    Axis,
    /// A glued face: template and number of the gluing.
    Wall(usize, usize),
    /// A marker.
    Surface(u32),
    Inside,
}

impl Place {
    /// Words for it.
    pub fn words(self, document: &Document) -> String {
        match self {
            Self::Axis => "at the axis".to_owned(),
            Self::Wall(template, gluing) => {
                format!("at '{}'", document.templates[template].gluings[gluing].name)
            }
            Self::Surface(marker) => {
                let named = document.markers.iter().find(|m| m.id == marker);
                match named.map(|m| m.name.as_str()) {
                    Some(name) if !name.is_empty() => format!("at surface '{name}'"),
                    _ => "at the surface".to_owned(),
                }
            }
            Self::Inside => "inside".to_owned(),
        }
    }
}

/// What the vertices of a template are on.
pub struct Places(FxHashMap<u32, Place>);

impl Places {
    /// The places of a template, given with its index.
    pub fn new((index, template): (usize, &Template)) -> Self {
        let mut of_vertex: FxHashMap<u32, Place> = FxHashMap::default();
        let mut put = |v: u32, place: Place| {
            let known = of_vertex.entry(v).or_insert(place);
            *known = (*known).min(place);
        };
        for t in &template.triangles {
            let place = Place::Surface(t.marker);
            t.vertices.into_iter().for_each(|v| put(v, place));
        }
        for (i, gluing) in template.gluings.iter().enumerate() {
            let place = Place::Wall(index, i);
            gluing.vertices_of(index).for_each(|v| put(v, place));
        }
        template.axis.iter().for_each(|&v| put(v, Place::Axis));
        Self(of_vertex)
    }

    /// What an element is at: the first place of its vertices.
    pub fn of(&self, vertices: impl IntoIterator<Item = u32>) -> Place {
        let known = vertices.into_iter().filter_map(|v| self.0.get(&v).copied());
        known.min().unwrap_or(Place::Inside)
    }
}
