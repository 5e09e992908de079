//! The symmetry that a mesh has by the way it is made of instances.

use std::collections::BTreeSet;
use tmesh::{Axis, Document, Isometry, Outside, Promise, Symmetry, Template};

/// The symmetry that the placements of the instances have among themselves: multiplied from the
/// left, they map the instances of each template onto instances of the same template.
///
/// Says nothing of region ids, which region maps may permute.
pub fn promise(document: &Document) -> Promise {
    let mut places = vec![Places::new(); document.templates.len()];
    for instance in &document.instances {
        places[instance.template as usize].insert(instance.isometry);
    }
    let order = rotations_of(&places);
    let mirror = keeps(&places, canonical_mirror());
    let frame = &document.frame;
    let rows = frame.rotation.transpose().to_cols_array_2d();
    Promise {
        order,
        mirror,
        horizontal_mirror: keeps(&places, Isometry::new(0, 1, false, true)),
        rotation: rows,
        origin: frame.origin.to_array(),
        outside: outside(document, &places).filter(|o| (o.order, o.mirror) != (order, mirror)),
    }
}

/// The mirror at the canonical half plane.
fn canonical_mirror() -> Isometry {
    Isometry::reflection(0, 1)
}

/// Placements of a template.
type Places = BTreeSet<Isometry>;

/// Whether an isometry maps all placements of each template onto such.
fn keeps(templates: &[Places], g: Isometry) -> bool {
    let kept = |set: &Places| set.iter().all(|&p| set.contains(&g.compose(p)));
    templates.iter().all(kept)
}

/// Order of the rotations that keep the placements.
fn rotations_of(templates: &[Places]) -> u32 {
    // The template with the fewest instances leaves the fewest rotations to try.
    let placed = templates.iter().filter(|set| !set.is_empty());
    let Some(fewest) = placed.min_by_key(|set| set.len()) else {
        return 1;
    };
    let Some(&first) = fewest.first() else {
        return 1;
    };
    let turns = fewest.iter().map(|p| p.compose(first.inverse()));
    let mut steps: Vec<u32> = turns
        .filter(|g| !g.mirrored() && !g.flipped() && g.k() == 1)
        .map(|g| g.n())
        .collect();
    steps.sort_unstable();
    // Rotations that keep the instances form a group; the finest step generates it.
    let mut finest_first = steps.into_iter().rev();
    let finest = finest_first.find(|&n| keeps(templates, Isometry::rotation(1, n)));
    finest.unwrap_or(1)
}

/// The symmetry of the template that reaches farthest from the axis, and the radius beyond which there
/// are only templates that share it.
fn outside(document: &Document, places: &[Places]) -> Option<Outside> {
    let placed = || places.iter().enumerate().filter(|p| !p.1.is_empty());
    if placed().count() < 2 {
        return None;
    }
    let reach: Vec<f64> = document.templates.iter().map(Template::reach).collect();
    let (farthest, own) = placed().max_by(|a, b| reach[a.0].total_cmp(&reach[b.0]))?;
    let own = std::slice::from_ref(own);
    let (order, mirror) = (rotations_of(own), keeps(own, canonical_mirror()));
    let shares = |set: &Places| {
        let set = std::slice::from_ref(set);
        keeps(set, Isometry::rotation(1, order)) && (!mirror || keeps(set, canonical_mirror()))
    };
    let others = placed().filter(|(_, set)| !shares(set));
    let radius = rounded_up(others.map(|(t, _)| reach[t]).fold(0.0, f64::max));
    (radius < reach[farthest]).then_some(Outside {
        order,
        mirror,
        radius,
    })
}

/// A radius in six digits, not below `x` but by rounding: short enough for titles, and what holds outside
/// of `x` holds outside of more.
fn rounded_up(x: f64) -> f64 {
    let nearest = format!("{x:.5e}");
    let parts = nearest.split_once('e');
    let digits = parts.and_then(|p| p.0.replace('.', "").parse::<u32>().ok());
    let exponent = parts.and_then(|p| p.1.parse::<i32>().ok());
    let (Some(digits), Some(exponent)) = (digits, exponent) else {
        return x;
    };
    let value = |digits: u32| format!("{digits}e{}", exponent - 5).parse().unwrap_or(x);
    let below = value(digits);
    if below >= x * (1.0 - 1e-12) {
        below
    } else {
        value(digits + 1)
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
    use glam::DVec3;
    use tmesh::Instance;

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
    fn outside_of_a_hub_the_order_of_the_wedge_holds() {
        let both = |k, n| [false, true].map(|m| Isometry::new(k, n, m, false));
        let wedges = (0..12).flat_map(|k| both(k, 12)).map(|g| (0, g));
        let hubs = (0..4).flat_map(|k| both(k, 4)).map(|g| (1, g));
        let mut document = document(&wedges.chain(hubs).collect::<Vec<_>>());
        assert_eq!(promise(&document).outside, None, "nothing is farther out");
        document.templates[0].vertices = vec![DVec3::new(0.0, 3.0, 9.0), DVec3::X];
        document.templates[1].vertices = vec![DVec3::new(0.6, 0.8, -7.0), DVec3::ZERO];
        let found = promise(&document);
        assert_eq!((found.order, found.mirror), (4, true));
        let expected = Outside {
            order: 12,
            mirror: true,
            radius: 1.0,
        };
        assert_eq!(found.outside, Some(expected));
        // A ring of copies that has no mirror lies between.
        document.templates.push(Template::default());
        document.templates[2].vertices = vec![DVec3::new(2.0, 0.0, 0.0)];
        let turned = |k| Instance {
            template: 2,
            isometry: Isometry::rotation(k, 12),
            region_map: 0,
        };
        document.instances.extend((0..12).map(turned));
        let found = promise(&document);
        assert_eq!((found.order, found.mirror), (4, false));
        assert_eq!(found.outside.map(|o| o.radius), Some(2.0));
        // Farther out is less symmetry, not more.
        document.templates[1].vertices[1].x = 5.0;
        document.instances.truncate(32);
        assert_eq!(promise(&document).outside, None);
    }

    #[test]
    fn radii_are_rounded_up() {
        for (x, expected) in [
            (0.0, 0.0),
            (0.119_999_999_999_999_94, 0.12),
            (0.120_000_000_000_000_01, 0.12),
            (0.123_456_01, 0.123_457),
            (9.999_991e20, 1e21),
            (3.7e-310, 3.7e-310),
            (f64::MAX, f64::INFINITY),
        ] {
            assert_eq!(rounded_up(x), expected);
        }
        assert!(rounded_up(f64::INFINITY).is_infinite());
    }

    #[test]
    fn copies_that_do_not_close_up_promise_nothing() {
        let list: Vec<_> = (0..3).map(|k| (0, Isometry::rotation(k, 12))).collect();
        assert_eq!(found(&list), (1, false, false));
    }
}
