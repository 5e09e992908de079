//! How good a mesh of a template is, next to another one.

use crate::done::Done;
use crate::kept::mean_edge;
use crate::lengths::Lengths;
use geom::measure::tet_volume;
use geom::tet::TetMeasures;
use mesher::Room;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;
use tmesh::Tet;

/// What an element that fails what is asked for weighs against others. A choice: the first percentile is what is asked of a mesh, and where
/// one in a hundred fails, these weigh as much as all others.
pub const FAILING: usize = 100;

/// What an element past a radius-edge bound that nobody asked for weighs, where lengths are: the elements around an inner vertex, which a vertex there
/// would replace. It has no angle that is too small; the bound is what ends refinement.
const PAST: usize = 20;

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
    /// What those that fail weigh where lengths are asked for, in elements.
    weight: usize,
    /// The smallest dihedral angle of all elements, degrees.
    pub angle: f64,
    /// What that is worth in elements: its cube, as edges that are shorter by a part make as many more elements. Whole degrees count, up
    /// to those that are enough.
    worth: f64,
    /// Mean length of edges over the one asked for, at least one. Edges that are longer by a part are as far from what was asked for as ones that are
    /// shorter by it, which take its cube more elements: that many fewer are no merit, and as many count against it.
    longer: f64,
}

impl Score {
    /// Grades a mesh; larger angles than `enough` degrees are worth no more.
    pub fn new(done: &Done, enough: f64) -> Self {
        Self::of(done, enough, FAILING, None)
    }

    /// The same where lengths are asked for; `asked`: whether the bounds are the user's own, too. Elements that are larger than the lengths
    /// let them be fail as well; `limits` has the volumes by region, model units cubed.
    pub fn of_lengths(
        done: &Done,
        enough: f64,
        (lengths, limits): (&Lengths, &FxHashMap<u32, f64>),
        asked: bool,
    ) -> Self {
        let of_past = if asked { FAILING } else { PAST };
        let template = &done.filled.template;
        let is_large = |tet: &&Tet| {
            let [a, b, c, d] = tet.vertices.map(|v| template.vertices[v as usize]);
            let limit = limits.get(&tet.region);
            limit.is_some_and(|&limit| tet_volume(a, b, c, d) > limit)
        };
        let large = template.tets.iter().filter(is_large).count();
        let score = Self::of(done, enough, of_past, Some(lengths));
        Self {
            failing: score.failing + large,
            weight: score.weight + FAILING * large,
            ..score
        }
    }

    fn of(done: &Done, enough: f64, of_past: usize, lengths: Option<&Lengths>) -> Self {
        let template = &done.filled.template;
        let angles = template.tets.iter().map(|tet| {
            let corners = tet.vertices.map(|v| template.vertices[v as usize]);
            TetMeasures::of(corners).min_dihedral().to_degrees()
        });
        let angle = angles.fold(f64::INFINITY, f64::min);
        let mean = lengths.and_then(|lengths| mean_edge(lengths, template));
        let [past, low] = done.filled.improved.map_or([0; 2], |i| [i.past, i.low]);
        Self {
            failing: past + low,
            weight: of_past * past + FAILING * low,
            elements: template.tets.len(),
            angle,
            worth: angle.min(enough).floor().powi(3),
            longer: mean.map_or(1.0, |mean| mean.max(1.0)),
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

    /// Whether it has fewer elements for what the smallest angle is worth, where one that fails weighs as much as others, and edges that are
    /// longer than asked for as much as ones that are shorter.
    pub fn costs_less_than(&self, other: &Self) -> bool {
        let price = |one: &Self, other: &Self| {
            (one.elements + one.weight) as f64 * one.longer.powi(6) * other.worth
        };
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
