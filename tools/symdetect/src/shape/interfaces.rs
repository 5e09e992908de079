//! Regions on the two sides of every triangle, and the kinds of interface that they make.

use crate::shape::motion::{NO_CLASS, Target};
use crate::shape::regions::Permutation;
use tmesh::{OUTSIDE, Template};

/// The interfaces of a surface: which regions each triangle separates.
pub struct Interfaces {
    /// Region ids in use, increasing; the last is [`OUTSIDE`].
    pub regions: Vec<u32>,
    /// Regions before and behind each triangle, as indices into `regions`.
    pub sides: Vec<[u32; 2]>,
    /// Pairs of regions that triangles separate, lower index first, increasing.
    pub classes: Vec<[u32; 2]>,
    /// Kind of interface of each triangle, an index into `classes`.
    pub class: Vec<u32>,
}

impl Interfaces {
    /// Of the triangles of a template.
    pub fn new(template: &Template) -> Self {
        let (regions, sides) = dense_regions(template);
        let pair = |&[a, b]: &[u32; 2]| [a.min(b), a.max(b)];
        let mut classes: Vec<[u32; 2]> = sides.iter().map(pair).collect();
        classes.sort_unstable();
        classes.dedup();
        let number = |side| classes.partition_point(|x| *x < pair(side)) as u32;
        let class = sides.iter().map(number).collect();
        Self {
            regions,
            sides,
            classes,
            class,
        }
    }

    /// The sign with which a triangle bounds material: 1 with material behind it, -1 with material in front, 0
    /// between two materials.
    pub fn sign(&self, triangle: usize) -> f64 {
        let outside = self.regions.len() as u32 - 1;
        let [front, back] = self.sides[triangle];
        f64::from(i8::from(back != outside) - i8::from(front != outside))
    }

    /// The target that a permutation of regions asks for.
    pub fn target(&self, permutation: &Permutation) -> Target {
        if self.classes.len() < 2 {
            return Target::Any;
        }
        let image = |c: &[u32; 2]| {
            let [a, b] = c.map(|r| permutation.get(r));
            let key = [a.min(b), a.max(b)];
            self.classes
                .binary_search(&key)
                .map_or(NO_CLASS, |i| i as u32)
        };
        Target::Classes(self.classes.iter().map(image).collect())
    }
}

/// Region ids in use, increasing and with [`OUTSIDE`] last, and the sides of every triangle as indices into them.
fn dense_regions(template: &Template) -> (Vec<u32>, Vec<[u32; 2]>) {
    let mut regions: Vec<u32> = Vec::new();
    let mut last = OUTSIDE;
    for t in &template.triangles {
        for r in [t.front, t.back] {
            if r != last && r != OUTSIDE {
                regions.push(r);
                last = r;
            }
        }
    }
    regions.push(OUTSIDE);
    regions.sort_unstable();
    regions.dedup();
    let index = |r: u32| regions.partition_point(|&x| x < r) as u32;
    let sides = template
        .triangles
        .iter()
        .map(|t| [index(t.front), index(t.back)])
        .collect();
    (regions, sides)
}
