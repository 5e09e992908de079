//! The symmetry that a mesh has by the way it is made of instances.

use std::collections::BTreeSet;
use tmesh::{Axis, Document, Isometry, Promise, Symmetry};

/// The symmetry that the placements of the instances have among themselves: multiplied from the
/// left, they map the instances of each template onto instances of the same template.
///
/// Says nothing of region ids, which region maps may permute.
pub fn promise(document: &Document) -> Promise {
    let mut places = vec![BTreeSet::new(); document.templates.len()];
    for instance in &document.instances {
        places[instance.template as usize].insert(instance.isometry);
    }
    let keeps = |g: Isometry| {
        let kept = |set: &BTreeSet<Isometry>| set.iter().all(|&p| set.contains(&g.compose(p)));
        places.iter().all(kept)
    };
    // The template with the fewest instances leaves the fewest rotations to try.
    let fewest = places
        .iter()
        .filter(|set| !set.is_empty())
        .min_by_key(|set| set.len());
    let mut order = 1;
    if let Some(fewest) = fewest
        && let Some(&first) = fewest.first()
    {
        let turns = fewest.iter().map(|p| p.compose(first.inverse()));
        let mut steps: Vec<u32> = turns
            .filter(|g| !g.mirrored() && !g.flipped() && g.k() == 1)
            .map(|g| g.n())
            .collect();
        steps.sort_unstable();
        // Rotations that keep the instances form a group; the finest step generates it.
        let finest = steps
            .iter()
            .rev()
            .find(|&&n| keeps(Isometry::rotation(1, n)));
        order = finest.copied().unwrap_or(1);
    }
    let frame = &document.frame;
    let rows = frame.rotation.transpose().to_cols_array_2d();
    Promise {
        order,
        mirror: keeps(Isometry::reflection(0, 1)),
        horizontal_mirror: keeps(Isometry::new(0, 1, false, true)),
        rotation: rows,
        origin: frame.origin.to_array(),
    }
}

/// Whether the promise is more than that the mesh is its own image under the identity.
pub fn is_trivial(promise: &Promise) -> bool {
    promise.order == 1 && !promise.mirror && !promise.horizontal_mirror
}

/// What is known of the symmetry of the assembled mesh: what `symdetect` found, if it did, and the
/// promise.
pub fn assembled_symmetry(document: &Document, promise: Promise) -> Symmetry {
    if let Some(found) = &document.symmetry {
        return Symmetry {
            promise: Some(promise),
            ..found.clone()
        };
    }
    let column = |i: usize| promise.rotation.map(|row| row[i]);
    let symbol = match (promise.mirror, promise.horizontal_mirror) {
        (false, false) => format!("C{}", promise.order),
        (true, false) => format!("C{}v", promise.order),
        (false, true) => format!("C{}h", promise.order),
        (true, true) => format!("D{}h", promise.order),
    };
    Symmetry {
        group: symbol,
        order: promise.order,
        mirror: promise.mirror,
        horizontal_mirror: promise.horizontal_mirror,
        axis: Axis {
            point: promise.origin,
            direction: column(2),
        },
        mirror_direction: column(0),
        residual: 0.0,
        tolerance: 0.0,
        axisymmetric: false,
        radius: 0.0,
        other_axes: Vec::new(),
        rejected: Vec::new(),
        rotation_regions: Vec::new(),
        mirror_regions: Vec::new(),
        horizontal_regions: Vec::new(),
        promise: Some(promise),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{Instance, Template};

    fn document(placements: &[(u32, Isometry)]) -> Document {
        let mut document = Document::single(Template::default());
        document.templates.push(Template::default());
        document.instances = placements
            .iter()
            .map(|&(template, isometry)| Instance {
                template,
                isometry,
                region_map: 0,
            })
            .collect();
        document
    }

    fn found(placements: &[(u32, Isometry)]) -> (u32, bool, bool) {
        let p = promise(&document(placements));
        (p.order, p.mirror, p.horizontal_mirror)
    }

    #[test]
    fn full_groups_promise_themselves() {
        for n in [1, 2, 3, 7, 16] {
            let all = |mirrors: &[bool], flips: &[bool]| {
                let mut list = Vec::new();
                for k in 0..n {
                    for &m in mirrors {
                        for &f in flips {
                            list.push((0, Isometry::new(k, n as u32, m, f)));
                        }
                    }
                }
                found(&list)
            };
            let both = [false, true];
            let n = n as u32;
            assert_eq!(all(&[false], &[false]), (n, false, false));
            assert_eq!(all(&both, &[false]), (n, true, false));
            assert_eq!(all(&[false], &both), (n, false, true));
            assert_eq!(all(&both, &both), (n, true, true));
        }
    }

    #[test]
    fn a_hub_of_lower_order_lowers_the_promise() {
        let mut list: Vec<_> = (0..12).map(|k| (0, Isometry::rotation(k, 12))).collect();
        list.extend((0..4).map(|k| (1, Isometry::rotation(k, 4))));
        assert_eq!(found(&list), (4, false, false));
    }

    #[test]
    fn copies_that_do_not_close_up_promise_nothing() {
        let list: Vec<_> = (0..3).map(|k| (0, Isometry::rotation(k, 12))).collect();
        assert_eq!(found(&list), (1, false, false));
    }
}
