//! Defects of the surface that do not keep it from being read, with places.

use crate::budget::{FULL, LISTED};
use crate::shape::Flats;
use geom::contacts::{Search, contacts};
use geom::edges::Edges;
use geom::measure::double_area_vector;
use glam::DVec3;
use heal::OddEdges;
use kit::point;
use serde::Serialize;
use tmesh::{OUTSIDE, Template};

/// Defects of a surface.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Defects {
    /// Edges of one triangle only, by their ends.
    pub open_edges: Places<[[f64; 3]; 2]>,
    /// Edges with more than two triangles that are not where regions meet, by their ends.
    pub non_manifold_edges: Places<[[f64; 3]; 2]>,
    /// Pairs of triangles that cross, overlap or touch away from common corners and edges.
    /// `None` where it was not looked for.
    pub self_intersections: Option<Places<[f64; 3]>>,
}

/// How many of a kind there are, and where some of them are, in world coordinates.
#[derive(Clone, Debug, Serialize)]
pub struct Places<T> {
    /// How many.
    pub count: usize,
    /// Whether there may be more.
    pub at_least: bool,
    /// Where the first ones are.
    pub places: Vec<T>,
}

impl<T> Default for Places<T> {
    fn default() -> Self {
        Self {
            count: 0,
            at_least: false,
            places: Vec::new(),
        }
    }
}

impl<T> Places<T> {
    fn add(&mut self, place: T) {
        self.count += 1;
        if self.places.len() < LISTED {
            self.places.push(place);
        }
    }
}

impl Defects {
    /// Of a surface that could not be read.
    pub fn of_open(edges: &OddEdges) -> Self {
        let mut defects = Self::default();
        for e in &edges.open {
            defects.open_edges.add(e.map(|p| p.to_array()));
        }
        for e in &edges.crowded {
            defects.non_manifold_edges.add(e.map(|p| p.to_array()));
        }
        defects
    }

    /// Looks for defects. O(n log n) where few triangles are crowded together. Where it is known that triangles are
    /// apart that is not looked for.
    pub fn find(template: &Template, is_apart: bool) -> Self {
        let mut defects = Self::default();
        let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
        let edges = Edges::new(&triangles);
        for e in 0..edges.len() {
            let fan = edges.around(e);
            let sides = |i: usize| {
                let t = &template.triangles[fan[i].triangle as usize];
                [t.front.min(t.back), t.front.max(t.back)]
            };
            let one_region = (0..fan.len()).all(|i| sides(i) == sides(0) && sides(i)[1] == OUTSIDE);
            let place = || edges.ends[e].map(|v| template.vertices[v as usize].to_array());
            match fan.len() {
                1 => defects.open_edges.add(place()),
                n if n > 2 && one_region => defects.non_manifold_edges.add(place()),
                _ => {}
            }
        }
        if is_apart {
            defects.self_intersections = Some(Places::default());
            return defects;
        }
        // What lies in one plane and is joined along edges does not cross itself, and may be fans of
        // many triangles around one point, all of which would have to be compared.
        let normals: Vec<DVec3> = (triangles.iter())
            .map(|t| {
                let [a, b, c] = t.map(|v| template.vertices[v as usize]);
                double_area_vector(a, b, c).normalize_or_zero()
            })
            .collect();
        let flats = Flats::new(&triangles, &normals, &edges);
        let mut found = Places::default();
        let search = contacts(
            &template.vertices,
            &triangles,
            |t| flats.of[t as usize],
            |contact| {
                found.add(contact.point.to_array());
                found.count < FULL
            },
        );
        found.at_least = search == Search::GaveUp || found.count >= FULL;
        defects.self_intersections = Some(found);
        defects
    }

    /// What the user should know, a sentence each.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let at = |p: &[f64; 3]| point(*p);
        if let Some([a, b]) = self.non_manifold_edges.places.first() {
            notes.push(format!(
                "edges with more than two triangles: {}, the first from {} to {}",
                self.non_manifold_edges.count,
                at(a),
                at(b)
            ));
        }
        if let Some(found) = &self.self_intersections
            && let Some(first) = found.places.first()
        {
            notes.push(format!(
                "the surface crosses or touches itself at {}{} pairs of triangles, the first at {}; \
                 it may not be meshed as it is",
                if found.at_least { "at least " } else { "" },
                found.count,
                at(first)
            ));
        }
        notes
    }
}
