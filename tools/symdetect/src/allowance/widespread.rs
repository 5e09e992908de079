//! Whether deviations are found all around, as those of facets are.

use crate::allowance::model::{NOTICEABLE, SECTORS, SHELLS};
use crate::allowance::place::Place;
use crate::budget::SURVEY;
use crate::shape::{Random, Shape};
use rustc_hash::FxHashMap;
use tmesh::{Frame, Isometry};

/// Whether deviations are found at most places that are drawn as coarsely as the worst ones, as
/// between facets, rather than at a feature. With more than two turns, at most images of the places
/// where they are found at all.
pub fn is_widespread(shape: &Shape, frame: &Frame, n: u32, value: f64) -> bool {
    let parts = SECTORS.div_ceil(n);
    // Half turns cannot tell images apart: a place and its only one deviate together.
    let folds = if n == 2 { 1 } else { parts };
    let sectors = n * parts;
    // For each shell and part of a turn: sectors that are drawn coarsely, those that deviate.
    let mut seen: FxHashMap<[u32; 2], [Vec<bool>; 2]> = FxHashMap::default();
    let mut random = Random(u64::from(n));
    let radius = shape.radius(frame);
    let noticeable = NOTICEABLE * value;
    for sample in shape.samples.mixed.iter().take(SURVEY) {
        let corners = shape.triangles[sample.triangle as usize];
        if shape.facets().around(corners) < noticeable {
            continue;
        }
        let normal = shape.normals[sample.triangle as usize];
        let place = Place::new(frame, sample.point, normal, radius);
        let sector = ((place.turn * f64::from(sectors)) as u32).min(sectors - 1);
        let key = [sector % folds, place.shell(SHELLS).into()];
        let [coarse, off] = seen
            .entry(key)
            .or_insert_with(|| [(); 2].map(|()| vec![false; (sectors / folds) as usize]));
        let sector = (sector / folds) as usize;
        coarse[sector] = true;
        if !off[sector] {
            let deviates = |k: u32| {
                let step = Isometry::rotation(i64::from(k), n);
                let distance = shape.distance_of_image(frame, step, sample, value);
                distance.is_none_or(|d| d > noticeable)
            };
            off[sector] = under_two(n, &mut random, deviates);
        }
    }
    let count = |list: &[bool]| list.iter().filter(|x| **x).count();
    (seen.values()).all(|[coarse, off]| count(off) == 0 || 2 * count(off) > count(coarse))
}

/// Whether a place deviates under two of three powers of the rotation of order `n`, spread from a random one on. Places
/// without a feature deviate where one power of the rotation takes them to it: that two different ones do needs
/// features at two places.
fn under_two(n: u32, random: &mut Random, deviates: impl Fn(u32) -> bool) -> bool {
    let (first, step) = (random.below(n as usize - 1) as u32, (n - 1).div_ceil(3));
    let tried = (0..n - 1)
        .step_by(step as usize)
        .map(|k| 1 + (first + k) % (n - 1));
    tried.filter(|&k| deviates(k)).count() >= 2.min(n as usize - 1)
}
