//! How good a mesh of a template is, next to another one.

use crate::done::Done;
use crate::failing::{FAILING, is_hopeless};
use geom::measure::tet_volume;
use geom::tet::TetMeasures;
use mesher::{Params, Room, Sizes};
use rustc_hash::FxHashMap;
use std::cmp::Ordering;
use surface::{Lengths, lengths, mean_edge};
use tmesh::{Document, Tet};

/// What an element past a radius-edge bound that nobody asked for weighs, where lengths are: the elements around an inner vertex, which a vertex there
/// would replace. It has no angle that is too small; the bound is what ends refinement.
const PAST: usize = 20;

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
    /// The same of the first percentile of the smallest angles of elements.
    worth_of_most: f64,
    /// Mean length of edges over the one asked for; one where none is.
    mean: f64,
}

/// What meshes of a template are judged by.
pub struct Judge {
    /// Larger dihedral angles are worth no more, degrees.
    enough: f64,
    /// Lengths asked for.
    lengths: Option<Lengths>,
    /// Volumes by region that the lengths let elements have, model units cubed.
    limits: FxHashMap<u32, f64>,
    /// What an element past the radius-edge bound weighs.
    of_past: usize,
}

impl Judge {
    /// By what is asked for of a document's template.
    pub fn new(
        document: &Document,
        (sizes, template): (&Sizes, usize),
        params: &Params,
        enough: f64,
    ) -> Self {
        let lengths = lengths(document, sizes, template);
        let limits = document.regions.iter().zip(&sizes.of_region);
        let limits = limits.filter_map(|(r, &limit)| Some((r.id, limit?)));
        Self {
            enough,
            limits: match lengths {
                Some(_) => limits.collect(),
                None => FxHashMap::default(),
            },
            of_past: match lengths {
                Some(_) if params.default_bounds => PAST,
                _ => FAILING,
            },
            lengths,
        }
    }

    /// Whether lengths are asked for.
    pub fn has_lengths(&self) -> bool {
        self.lengths.is_some()
    }

    /// What an angle is worth.
    fn worth(&self, angle: f64) -> f64 {
        angle.min(self.enough).floor().powi(3)
    }

    /// Grades a mesh. Where lengths are asked for, elements that are larger than these let them be fail, too.
    pub fn score(&self, done: &Done) -> Score {
        let template = &done.filled.template;
        let angles = template.tets.iter().map(|tet| {
            let corners = tet.vertices.map(|v| template.vertices[v as usize]);
            TetMeasures::of(corners).min_dihedral().to_degrees()
        });
        let mut angles: Vec<f64> = angles.collect();
        let angle = angles.iter().copied().fold(f64::INFINITY, f64::min);
        let rank = angles.len() / 100;
        let first = match angles.is_empty() {
            true => angle,
            false => *angles.select_nth_unstable_by(rank, f64::total_cmp).1,
        };
        let is_large = |tet: &&Tet| {
            let [a, b, c, d] = tet.vertices.map(|v| template.vertices[v as usize]);
            let limit = self.limits.get(&tet.region);
            limit.is_some_and(|&limit| tet_volume(a, b, c, d) > limit)
        };
        let large = template.tets.iter().filter(is_large).count();
        let lengths = self.lengths.as_ref();
        let mean =
            lengths.and_then(|lengths| mean_edge(lengths, &template.vertices, &template.tets));
        let [past, low] = done.filled.improved.map_or([0; 2], |i| [i.past, i.low]);
        Score {
            failing: past + low + large,
            weight: self.of_past * past + FAILING * (low + large),
            elements: template.tets.len(),
            angle,
            worth: self.worth(angle),
            worth_of_most: self.worth(first),
            mean: mean.unwrap_or(1.0),
        }
    }
}

impl Score {
    /// That of several meshes that belong together, each with how often there are copies of it.
    pub fn together<'a>(scores: impl Iterator<Item = (usize, &'a Self)>) -> Self {
        let mut all = Self {
            failing: 0,
            elements: 0,
            weight: 0,
            angle: f64::INFINITY,
            worth: f64::INFINITY,
            worth_of_most: f64::INFINITY,
            mean: 0.0,
        };
        for (copies, score) in scores {
            all.failing += copies * score.failing;
            all.weight += copies * score.weight;
            all.elements += copies * score.elements;
            all.angle = all.angle.min(score.angle);
            all.worth = all.worth.min(score.worth);
            all.worth_of_most = all.worth_of_most.min(score.worth_of_most);
            all.mean += (copies * score.elements) as f64 * score.mean;
        }
        all.mean /= all.elements as f64;
        all
    }

    /// Whether edges are nearer to what was asked for in the mean, and either the worst element or the first percentile says that they cost less.
    pub fn is_as_wanted_beside(&self, other: &Self) -> bool {
        self.is_nearer_than(other) && (self.costs_less_than(other) || self.takes_less_than(other))
    }

    /// Whether edges are nearer to what was asked for in the mean.
    fn is_nearer_than(&self, other: &Self) -> bool {
        self.mean.ln().abs() < other.mean.ln().abs()
    }

    /// Whether edges are shorter than asked for in the mean.
    pub fn is_short(&self) -> bool {
        self.mean < 1.0
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
    /// longer than asked for as much as ones that are shorter: edges that are longer by a part are as far from what was asked for as ones that
    /// are shorter by it, which take its cube more elements. That many fewer are no merit, and as many count against it.
    fn costs_less_than(&self, other: &Self) -> bool {
        self.cost() * other.worth < other.cost() * self.worth
    }

    /// The same by the smallest angle and the first percentile as much: the smallest one is that of a single element, and more elements for it may be many.
    pub fn is_cheaper_than(&self, other: &Self) -> bool {
        let worth = |score: &Self| (score.worth * score.worth_of_most).sqrt();
        self.cost() * worth(other) < other.cost() * worth(self)
    }

    /// The same by the first percentile alone: next to lengths that are far from those asked for, a single element is no reason.
    fn takes_less_than(&self, other: &Self) -> bool {
        self.cost() * other.worth_of_most < other.cost() * self.worth_of_most
    }

    /// Elements, where those that fail weigh as much as others, and edges that are longer than asked for as much as ones that are shorter.
    fn cost(&self) -> f64 {
        (self.elements + self.weight) as f64 * self.mean.max(1.0).powi(6)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn score((elements, weight): (usize, usize), mean: f64, [angle, first]: [f64; 2]) -> Score {
        Score {
            failing: 0,
            elements,
            weight,
            angle,
            worth: angle.powi(3),
            worth_of_most: first.powi(3),
            mean,
        }
    }

    /// Where the lengths that were asked for leave most elements as good, a bad one among them is no reason for shorter edges.
    #[test]
    fn lengths_that_are_asked_for_come_before_the_worst_element() {
        let short = score((3000, 0), 0.5, [21.0, 26.0]);
        let long = score((1000, 100), 0.8, [14.0, 24.0]);
        assert!(long.is_as_wanted_beside(&short) && long.takes_less_than(&short));
        assert!(short.costs_less_than(&long) && !short.is_as_wanted_beside(&long));
        // What most elements are worth counts, as do those that fail what is asked for, and edges that are longer.
        assert!(!score((1000, 100), 0.8, [14.0, 18.0]).takes_less_than(&short));
        assert!(!score((1000, 2000), 0.8, [14.0, 24.0]).takes_less_than(&short));
        assert!(!score((1000, 0), 1.2, [14.0, 24.0]).takes_less_than(&short));
        // Both count as much: half as many elements more for a better worst one are too many, unless most are better, too.
        let [plain, fine] = [14.0, 17.0].map(|first| score((1000, 0), 1.0, [14.0, first]));
        let dear = score((1500, 0), 1.0, [17.0, 14.0]);
        assert!(dear.costs_less_than(&plain) && plain.is_cheaper_than(&dear));
        assert!(fine.is_cheaper_than(&plain));
        // Where the worst element is no worse, most of them may be, as in a mesh of so few that one in a hundred is one of those that the input makes.
        let few = score((1000, 100), 0.8, [14.0, 18.0]);
        let many = score((3000, 0), 0.5, [14.0, 26.0]);
        assert!(!few.takes_less_than(&many) && few.is_as_wanted_beside(&many));
        let worse = score((1000, 2000), 0.8, [14.0, 18.0]);
        assert!(!worse.is_as_wanted_beside(&many));
    }
}
