//! The symmetry that a mesh has by the way it is made of instances.

use geom::tolerance::PROMISE;
use std::collections::BTreeSet;
use tmesh::{Document, Group, Isometry, Outside, Promise, Template};

/// The symmetry that the placements of the instances have among themselves: multiplied from the
/// left, they map the instances of each template onto instances of the same template.
///
/// Says nothing of region ids, which region maps may permute.
pub fn promise(document: &Document) -> Promise {
    let mut places = vec![Places::new(); document.templates.len()];
    for instance in &document.instances {
        places[instance.template as usize].insert(instance.isometry);
    }
    let group = group_of(&places);
    let frame = &document.frame;
    let rows = frame.rotation.transpose().to_cols_array_2d();
    Promise {
        group,
        rotation: rows,
        origin: frame.origin.to_array(),
        outside: outside(document, &places).filter(|o| o.group != group),
    }
}

/// The group of the isometries that map the placements of each template onto such.
fn group_of(templates: &[Places]) -> Group {
    Group::of(rotations_of(templates), |g| keeps(templates, g))
}

/// Placements of a template.
type Places = BTreeSet<Isometry>;

/// Whether an isometry maps all placements of each template onto such.
fn keeps(templates: &[Places], g: Isometry) -> bool {
    let image = |p: Isometry| g.checked_compose(p);
    let kept = |set: &Places| {
        let mut images = set.iter().map(|&p| image(p));
        images.all(|p| p.is_some_and(|p| set.contains(&p)))
    };
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
    let group = group_of(std::slice::from_ref(own));
    let shares = |set: &Places| {
        let mut generators = group.generators().into_iter();
        generators.all(|g| keeps(std::slice::from_ref(set), g))
    };
    let others = placed().filter(|(_, set)| !shares(set));
    let radius = rounded_up(others.map(|(t, _)| reach[t]).fold(0.0, f64::max));
    (radius < reach[farthest]).then_some(Outside { group, radius })
}

/// A radius in six digits, not below `x` but by half of what promises are held to: short enough for titles, and what holds
/// outside of `x` holds outside of more. Vertices so near to the radius count as within it whoever checks.
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
    if below >= x * (1.0 - 0.5 * PROMISE) {
        below
    } else {
        value(digits + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use tmesh::{Instance, Kind};

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

    fn found(placements: &[(u32, Isometry)]) -> Group {
        promise(&document(placements)).group
    }

    #[test]
    fn full_groups_promise_themselves() {
        for n in [1, 2, 3, 7, 16] {
            for kind in Kind::ALL {
                let group = Group::new(kind, n);
                let all: Vec<_> = group.elements().map(|g| (0, g)).collect();
                assert_eq!(found(&all), group);
            }
        }
    }

    #[test]
    fn a_hub_of_lower_order_lowers_the_promise() {
        let mut list: Vec<_> = (0..12).map(|k| (0, Isometry::rotation(k, 12))).collect();
        list.extend((0..4).map(|k| (1, Isometry::rotation(k, 4))));
        assert_eq!(found(&list), Group::new(Kind::C, 4));
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
        assert_eq!(found.group, Group::new(Kind::Cv, 4));
        let expected = Outside {
            group: Group::new(Kind::Cv, 12),
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
        assert_eq!(found.group, Group::new(Kind::C, 4));
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
            (0.88 * (1.0 + 5e-12), 0.880_001),
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
        assert_eq!(found(&list), Group::TRIVIAL);
    }
}
