use super::{Class, of_group};
use glam::{DVec2, DVec3};
use tmesh::{Group, Isometry, Kind};

#[test]
fn points_near_a_plane_are_moved_onto_it() {
    let cell = of_group(Group::new(Kind::C, 12), 1e-6, 1e-6, None);
    let (p, class) = cell.classify(DVec3::new(0.5, 3e-7, 1.0));
    assert_eq!(
        (p, class),
        (DVec3::new(0.5, 0.0, 1.0), Class::INSIDE.with(0, 0))
    );
    let turn = Isometry::rotation(1, 12);
    let (c, s) = turn.cos_sin();
    let (p, class) = cell.classify(DVec3::new(2.0 * c + 4e-7, 2.0 * s, 1.0));
    assert_eq!(class, Class::INSIDE.with(1, 0));
    let r = cell.faces[1].coordinates(p).x;
    assert_eq!(p, turn.apply(DVec3::new(r, 0.0, 1.0)));
    let on_axis = Class::INSIDE.with(0, 0).with(1, 0).on_axis();
    assert_eq!(cell.classify(DVec3::new(5e-7, -5e-7, 2.0)).1, on_axis);
    // On the first side's plane, but beyond the axis: outside of the second.
    let beyond = cell.classify(DVec3::new(-0.5, 0.0, 0.0)).1;
    assert_eq!((beyond.of(0), beyond.of(1)), (0, -1));
}

#[test]
fn crossings_do_not_depend_on_direction_or_height() {
    let cell = of_group(Group::new(Kind::C, 14), 1e-9, 1e-9, None);
    let at = |x: f64, y: f64, z: f64| cell.classify(DVec3::new(x, y, z));
    let (p, q) = (at(0.7, 0.1, 0.0), at(0.31, 0.9, 0.0));
    let low = cell.crossing(1, p, q, 1);
    assert_eq!(low, cell.crossing(1, q, p, 1));
    let (p, q) = (at(0.7, 0.1, 0.3), at(0.31, 0.9, 1.7));
    let slanted = cell.crossing(1, p, q, 1);
    assert_eq!((low.0.x, low.0.y), (slanted.0.x, slanted.0.y));
    assert_eq!(low.1, Class::INSIDE.with(1, 0));
}

#[test]
fn every_kind_joins_its_faces_by_elements_of_the_group() {
    for kind in Kind::ALL {
        for order in [1, 2, 3, 7] {
            let group = Group::new(kind, order);
            if matches!((kind, order), (Kind::C | Kind::Ch, 1)) {
                continue;
            }
            let cell = of_group(group, 1e-9, 1e-9, None);
            assert!(!cell.joins.is_empty(), "{group}");
            for join in &cell.joins {
                assert!(group.contains(join.step), "{group}: {}", join.step);
                // The image of a point there lies here, and has the same coordinates.
                let q = DVec2::new(0.8, 0.6);
                let there = join.there.at(&cell.faces, q);
                let here = join.step.apply(there);
                let (_, class) = cell.classify(there);
                assert!(
                    join.there.contains(&cell.faces, there, class),
                    "{group} {}",
                    join.name
                );
                let (here, class) = cell.classify(here);
                assert!(
                    join.here.contains(&cell.faces, here, class),
                    "{group} {}",
                    join.name
                );
                let place = join.here.place(&cell.faces, here);
                assert!(place.distance(q) < 1e-12, "{group} {}: {place}", join.name);
            }
        }
    }
}
