//! How good a mesh of a template is, next to another one.

use crate::done::Done;
use geom::tet::TetMeasures;
use mesher::Room;
use std::cmp::Ordering;

/// What an element that fails what is asked for weighs against others. A choice: the first percentile is what is asked of a mesh, and where
/// one in a hundred fails, these weigh as much as all others.
pub const FAILING: usize = 100;

/// Where one in so many elements fails, it is the shape, and no coarsening helps: a thin layer drawn with needles takes a minute to improve, and
/// another one for nothing. Impellers have one in thirty.
const HOPELESS: usize = 10;

/// Whether so many elements fail that nothing else is worth trying.
pub fn is_hopeless(failing: usize, elements: usize) -> bool {
    HOPELESS * failing > elements
}

/// How good a mesh is.
pub struct Score {
    /// Elements that fail what is asked for.
    pub failing: usize,
    /// All of them.
    pub elements: usize,
    /// The smallest dihedral angle of all elements, degrees.
    pub angle: f64,
    /// What that is worth in elements: its cube, as edges that are shorter by a part make as many more elements. Whole degrees count, up
    /// to those that are enough.
    worth: f64,
}

impl Score {
    /// Grades a mesh; larger angles than `enough` degrees are worth no more.
    pub fn new(done: &Done, enough: f64) -> Self {
        let template = &done.filled.template;
        let angles = template.tets.iter().map(|tet| {
            let corners = tet.vertices.map(|v| template.vertices[v as usize]);
            TetMeasures::of(corners).min_dihedral().to_degrees()
        });
        let angle = angles.fold(f64::INFINITY, f64::min);
        Self {
            failing: done.filled.improved.map_or(0, |i| i.past + i.low),
            elements: template.tets.len(),
            angle,
            worth: angle.min(enough).floor().powi(3),
        }
    }

    /// Whether it has fewer elements that fail, or as many and fewer elements for what the smallest angle is worth.
    pub fn is_better_than(&self, other: &Self) -> bool {
        let price = |one: &Self, other: &Self| one.elements as f64 * other.worth;
        match self.failing.cmp(&other.failing) {
            Ordering::Equal => price(self, other) < price(other, self),
            differ => differ.is_lt(),
        }
    }

    /// See [`is_hopeless`].
    pub fn is_hopeless(&self) -> bool {
        is_hopeless(self.failing, self.elements)
    }

    /// Whether it has fewer elements for what the smallest angle is worth, where one that fails weighs as much as [`FAILING`].
    pub fn costs_less_than(&self, other: &Self) -> bool {
        let price =
            |one: &Self, other: &Self| (one.elements + FAILING * one.failing) as f64 * other.worth;
        price(self, other) < price(other, self)
    }

    /// Room for all meshes that are better than one of so many vertices, which have `enough` degrees at best. Improvement begins with
    /// taking vertices out, up to every other one.
    pub fn room(&self, vertices: usize, enough: f64) -> Room {
        let times = match self.failing {
            0 => 2.0 * enough.powi(3) / self.worth,
            _ => f64::INFINITY,
        };
        Room::beside(vertices, times)
    }
}
