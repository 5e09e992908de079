use super::*;
use geom::sets::DisjointSets;
use glam::DVec3;
use std::collections::BTreeSet;
use tmesh::{Document, Gluing, Group, Instance, Isometry, Kind, Template};

/// A template of `count` vertices without meaningful coordinates: numbering must not look.
fn template(count: usize, gluings: Vec<Gluing>) -> Template {
    Template {
        vertices: vec![DVec3::ZERO; count],
        gluings,
        ..Template::default()
    }
}

/// A wall of the first template.
fn mirror(reflection: Isometry, vertices: &[u32]) -> Gluing {
    Gluing::mirror("mirror", 0, reflection, vertices.iter().copied(), [])
}

fn seam(rotation: Isometry, vertex_pairs: &[[u32; 2]]) -> Gluing {
    Gluing::seam("seam", 0, rotation, vertex_pairs.iter().copied(), [])
}

fn hub(other: u32, step: Isometry, vertex_pairs: &[[u32; 2]]) -> Gluing {
    Gluing {
        name: "hub".to_owned(),
        other,
        step,
        vertex_pairs: vertex_pairs.to_vec(),
        triangle_pairs: Vec::new(),
    }
}

/// The same gluings with itself of the second template.
fn of_second(mut gluings: Vec<Gluing>) -> Vec<Gluing> {
    for gluing in gluings.iter_mut().filter(|g| g.name != "hub") {
        gluing.other = 1;
    }
    gluings
}

fn document(templates: Vec<Template>, instances: Vec<(u32, Isometry)>) -> Document {
    let mut document = Document::single(Template::default());
    document.templates = templates;
    document.instances = instances
        .into_iter()
        .map(|(template, isometry)| Instance {
            template,
            isometry,
            region_map: 0,
        })
        .collect();
    document
}

/// All elements of C_n, C_nv, C_nh or D_nh.
fn group(n: u32, mirrored: bool, flipped: bool) -> Vec<Isometry> {
    let kind = match (mirrored, flipped) {
        (false, false) => Kind::C,
        (true, false) => Kind::Cv,
        (false, true) => Kind::Ch,
        (true, true) => Kind::Dh,
    };
    Group::new(kind, n).elements().collect()
}

fn all_ids(document: &Document, numbering: &Numbering) -> Vec<Vec<u32>> {
    (0..document.instances.len())
        .map(|i| {
            let mut ids = Vec::new();
            numbering.ids(i, &mut ids);
            ids
        })
        .collect()
}

/// Ids by brute force: the relations stated by the walls, one by one, in a union-find over all
/// vertices of all instances. Which vertices are one must agree; ids may differ.
fn brute_force(document: &Document) -> Vec<Vec<u32>> {
    let find = |t: u32, g: Isometry| {
        let mut all = document.instances.iter();
        all.position(|i| i.template == t && i.isometry == g)
    };
    let mut first = vec![0];
    for i in &document.instances {
        let count = document.templates[i.template as usize].vertices.len();
        first.push(first[first.len() - 1] + count as u32);
    }
    let mut sets = DisjointSets::new(first[first.len() - 1] as usize);
    for (i, instance) in document.instances.iter().enumerate() {
        let t = instance.template;
        for gluing in &document.templates[t as usize].gluings {
            let Some(j) = find(gluing.other, instance.isometry.compose(gluing.step)) else {
                continue;
            };
            for &[here, there] in &gluing.vertex_pairs {
                sets.join(first[i] + here, first[j] + there);
            }
        }
    }
    let (labels, _) = sets.numbered();
    first
        .windows(2)
        .map(|w| labels[w[0] as usize..w[1] as usize].to_vec())
        .collect()
}

/// Checks everything that must hold of any numbering; returns the number of points.
fn check(document: &Document) -> u32 {
    let numbering = Numbering::new(document).unwrap();
    let ids = all_ids(document, &numbering);
    // The same vertices are one as by brute force.
    let pairs: BTreeSet<(u32, u32)> = ids
        .iter()
        .flatten()
        .copied()
        .zip(brute_force(document).into_iter().flatten())
        .collect();
    let count = numbering.point_count();
    assert_eq!(pairs.len(), count as usize, "not a one-to-one relation");
    let distinct =
        |part: fn(&(u32, u32)) -> u32| -> BTreeSet<u32> { pairs.iter().map(part).collect() };
    assert!(distinct(|p| p.0).into_iter().eq(0..count));
    assert_eq!(distinct(|p| p.1).len(), count as usize);
    // Points come in the order of their ids, from their owner.
    let mut next = 0;
    for (i, of_instance) in ids.iter().enumerate() {
        for &v in numbering.owned(i).flatten() {
            assert_eq!(of_instance[v as usize], next);
            assert_eq!(numbering.owner(i, v), (i, v));
            next += 1;
        }
    }
    assert_eq!(next, count);
    for (i, of_instance) in ids.iter().enumerate() {
        for (v, &id) in of_instance.iter().enumerate() {
            let (owner, vertex) = numbering.owner(i, v as u32);
            assert_eq!(ids[owner][vertex as usize], id);
        }
    }
    count
}

#[test]
fn mirror_wedges() {
    // Vertex 0 on the axis, 1 and 2 on one wall each, 3 inside.
    for n in [1, 2, 3, 4, 7, 16] {
        let walls = vec![
            mirror(Isometry::reflection(0, n), &[0, 1]),
            mirror(Isometry::reflection(1, n), &[0, 2]),
        ];
        let placed = group(n, true, false).into_iter().map(|g| (0, g)).collect();
        let document = document(vec![template(4, walls)], placed);
        assert_eq!(check(&document), 1 + n + n + 2 * n, "order {n}");
    }
}

#[test]
fn one_mirror_plane_alone() {
    let walls = vec![mirror(Isometry::reflection(0, 1), &[0, 2])];
    let placed = group(1, true, false).into_iter().map(|g| (0, g)).collect();
    assert_eq!(check(&document(vec![template(3, walls)], placed)), 4);
}

#[test]
fn seams_with_and_without_axis() {
    // Vertex 0 on the axis, 1 and 2 low, 4 and 3 high, 5 inside.
    for n in [2, 3, 4, 7, 16] {
        let pairs: &[[u32; 2]] = &[[0, 0], [1, 4], [2, 3]];
        for pairs in [pairs, &pairs[1..]] {
            let walls = vec![seam(Isometry::rotation(1, n), pairs)];
            let placed = group(n, false, false).into_iter().map(|g| (0, g)).collect();
            let axis = if pairs.len() == 3 { 1 } else { n };
            let document = document(vec![template(6, walls)], placed);
            assert_eq!(check(&document), axis + 2 * n + n, "order {n}");
        }
    }
}

#[test]
fn three_walls_and_the_corner_where_they_meet() {
    // Two vertical mirrors and the floor: 0 in the corner, 1 on the axis, 2 and 3 where a
    // vertical wall meets the floor, 4 to 6 on one wall each, 7 inside.
    for n in [1, 2, 3, 4, 7, 16] {
        let walls = vec![
            mirror(Isometry::reflection(0, n), &[0, 1, 2, 4]),
            mirror(Isometry::reflection(1, n), &[0, 1, 3, 5]),
            mirror(Isometry::new(0, 1, false, true), &[0, 2, 3, 6]),
        ];
        let placed = group(n, true, true).into_iter().map(|g| (0, g)).collect();
        let count = 1 + 2 + n + n + 2 * n + 2 * n + 2 * n + 4 * n;
        assert_eq!(check(&document(vec![template(8, walls)], placed)), count);
    }
}

#[test]
fn a_seam_whose_ends_lie_on_the_floor() {
    // 0 on the axis and the floor, 1 low and 2 high on the floor, 3 low and 4 high above it.
    for n in [2, 3, 7] {
        let walls = vec![
            mirror(Isometry::new(0, 1, false, true), &[0, 1, 2]),
            seam(Isometry::rotation(1, n), &[[0, 0], [1, 2], [3, 4]]),
        ];
        let placed = group(n, false, true).into_iter().map(|g| (0, g)).collect();
        let document = document(vec![template(5, walls)], placed);
        assert_eq!(check(&document), 1 + n + 2 * n);
    }
}

#[test]
fn two_halves_of_a_screw_axis_wall() {
    // A wall at z = 0 whose neighbour is turned and mirrored (D_n): 0 and 1 change places.
    let n = 5;
    let step = Isometry::new(2, n, true, true);
    let walls = vec![seam(step, &[[0, 1], [1, 0], [2, 2]])];
    let mut placed: Vec<_> = group(n, false, false).into_iter().map(|g| (0, g)).collect();
    placed.extend(
        group(n, false, false)
            .into_iter()
            .map(|g| (0, g.compose(step))),
    );
    check(&document(vec![template(4, walls)], placed));
}

#[test]
fn a_hub_of_the_same_order() {
    // Wedge: 0 and 1 on the hub wall and one mirror each, 2 on the hub wall between, 3 inside.
    // Hub: 0 on the axis, 1, 2, 3 on the wall.
    for n in [1, 3, 4, 16] {
        let mirrors = |a: &[u32], b: &[u32]| {
            [
                mirror(Isometry::reflection(0, n), a),
                mirror(Isometry::reflection(1, n), b),
            ]
        };
        let pairs = [[0, 3], [1, 1], [2, 2]];
        let [a, b] = mirrors(&[0], &[1]);
        let wedge = template(4, vec![a, b, hub(1, Isometry::IDENTITY, &pairs)]);
        let [a, b] = mirrors(&[0, 3], &[0, 1]);
        let column = template(4, of_second(vec![a, b]));
        let mut placed: Vec<_> = group(n, true, false).into_iter().map(|g| (0, g)).collect();
        placed.extend(group(n, true, false).into_iter().map(|g| (1, g)));
        let document = document(vec![wedge, column], placed);
        // The wall's corners n each, its middle 2n, inside 2n, axis 1.
        assert_eq!(check(&document), n + n + 2 * n + 2 * n + 1, "order {n}");
    }
}

#[test]
fn a_hub_of_lower_order_and_one_meshed_whole() {
    // Wedge of C_nv: 0 and 1 on the hub wall and one mirror each, 2 on the hub wall, 3 inside.
    // The hub's template goes over `parts` half-wedges; of its 2 parts + 1 wall vertices every
    // other one lies where two half-wedges meet.
    for (n, order, mirrored) in [(12, 3, true), (12, 4, false), (6, 1, false), (8, 1, true)] {
        let wedge_walls = vec![
            mirror(Isometry::reflection(0, n), &[0]),
            mirror(Isometry::reflection(1, n), &[1]),
        ];
        let copies = order * if mirrored { 2 } else { 1 };
        let parts = 2 * n / copies;
        let whole = copies == 1;
        // Vertices 0 .. 2 parts around, then the axis.
        let around = |i: u32| if whole { i % (2 * parts) } else { i };
        let axis = if whole { 2 * parts } else { 2 * parts + 1 };
        let mut walls = Vec::new();
        for part in 0..parts {
            let (turn, odd) = (i64::from(part.div_ceil(2)), part % 2 == 1);
            let corners = if odd { [1, 0] } else { [0, 1] };
            let at = [2 * part, 2 * part + 2];
            let mut pairs = vec![
                [around(at[0]), corners[0]],
                [around(2 * part + 1), 2],
                [around(at[1]), corners[1]],
            ];
            pairs.sort_unstable();
            walls.push(hub(0, Isometry::new(turn, n, odd, false), &pairs));
        }
        if mirrored {
            walls.push(mirror(Isometry::reflection(0, order), &[0, axis]));
            walls.push(mirror(Isometry::reflection(1, order), &[2 * parts, axis]));
        } else if !whole {
            let pairs = [[0, 2 * parts], [axis, axis]];
            walls.push(seam(Isometry::rotation(1, order), &pairs));
        }
        let column = template(axis as usize + 1, of_second(walls));
        let mut placed: Vec<_> = group(n, true, false).into_iter().map(|g| (0, g)).collect();
        placed.extend(group(order, mirrored, false).into_iter().map(|g| (1, g)));
        let document = document(vec![template(4, wedge_walls), column], placed);
        assert_eq!(
            check(&document),
            n + n + 2 * n + 2 * n + 1,
            "{n} {order} {mirrored}"
        );
    }
}

#[test]
fn one_instance_is_not_welded() {
    let walls = vec![
        mirror(Isometry::reflection(0, 4), &[0, 1]),
        seam(Isometry::rotation(1, 4), &[[1, 2]]),
    ];
    let document = document(
        vec![template(4, walls)],
        vec![(0, Isometry::rotation(1, 4))],
    );
    let numbering = Numbering::new(&document).unwrap();
    assert_eq!(numbering.point_count(), 4);
    assert!(!numbering.has_closed_walls());
    assert_eq!(numbering.neighbour(0, 0), None);
}

#[test]
fn a_gap_is_named() {
    let walls = vec![mirror(Isometry::reflection(0, 3), &[0])];
    let placed = [(0, false), (0, true), (1, false)];
    let placed = placed.map(|(k, m)| (0, Isometry::new(k, 3, m, false)));
    let document = document(vec![template(1, walls)], placed.to_vec());
    let error = Numbering::new(&document).err().unwrap();
    assert_eq!(
        error.to_string(),
        "instance 1/3 of template 0 has no neighbour across wall 'mirror', though others have"
    );
}

#[test]
fn more_points_than_ids_is_an_error() {
    let placed = (0..65_536)
        .map(|k| (0, Isometry::rotation(k, 65_536)))
        .collect();
    let document = document(vec![template(70_000, Vec::new())], placed);
    let error = Numbering::new(&document).err().unwrap();
    assert_eq!(
        error,
        NumberingError::TooManyPoints {
            points: 65_536 * 70_000
        }
    );
}
