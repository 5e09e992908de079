//! What an assembled mesh must be, over structured wedges of many groups.

mod common;

use bodies::structured::{INNER, OUTER, Structured};
use common::{Mesh, gather};
use glam::DVec3;
use interchange::Plain;
use rotassemble::Assembled;
use tmesh::{Document, Frame, Gluing, Group, Instance, Isometry, Kind};

fn wedges() -> Vec<Structured> {
    let mut all = Vec::new();
    for order in [1, 2, 3, 4, 7, 16] {
        for mirror in [true, false] {
            for flip in [false, true] {
                for bore in [0.0, 0.5] {
                    // Angles below half a turn, and no two cells alike by chance.
                    let angular = if order == 1 { 4 } else { 2 };
                    all.push(Structured {
                        order,
                        mirror,
                        flip,
                        bore,
                        radius: 2.0,
                        cells: [3, angular, 2],
                    });
                }
            }
        }
    }
    all
}

fn placed(document: &mut Document) {
    document.frame = Frame::from_axis(
        DVec3::new(3.0, -1.0, 0.25),
        DVec3::new(1.0, 2.0, 3.0),
        DVec3::new(0.0, 1.0, 0.2),
    )
    .unwrap();
}

fn wedge_mesh(document: &Document) -> Mesh {
    gather(&Plain::new(document).unwrap())
}

#[test]
fn wedges_are_valid_documents() {
    for wedge in wedges() {
        let document = wedge.document();
        assert_eq!(tmesh::validate(&document), [], "{wedge:?}");
        wedge_mesh(&document).assert_conforming();
    }
}

#[test]
fn meshes_are_whole() {
    for wedge in wedges() {
        // A single instance is a sector: nothing to assemble.
        if wedge.copies() == 1 {
            continue;
        }
        let mut document = wedge.document();
        placed(&mut document);
        let mesh = gather(&Assembled::new(&document).unwrap());
        let one = wedge_mesh(&document);
        let copies = f64::from(wedge.copies());
        for region in [INNER, OUTER] {
            let (whole, expected) = (mesh.volume(region), copies * one.volume(region));
            assert!((whole - expected).abs() < 1e-12 * expected, "{wedge:?}");
        }
        assert!(mesh.smallest() > 0.0, "{wedge:?}");
        assert_eq!(mesh.closest_pair(1e-4), None, "{wedge:?}");
        mesh.assert_conforming();
        mesh.assert_closed();
    }
}

#[test]
fn meshes_have_the_promised_symmetry() {
    for wedge in wedges() {
        if wedge.copies() == 1 {
            continue;
        }
        let mut document = wedge.document();
        placed(&mut document);
        let assembled = Assembled::new(&document).unwrap();
        let promise = assembled.promise();
        let kind = match (wedge.mirror, wedge.flip) {
            (false, false) => Kind::C,
            (true, false) => Kind::Cv,
            (false, true) => Kind::Ch,
            (true, true) => Kind::Dh,
        };
        assert_eq!(promise.group, Group::new(kind, wedge.order));
        let mesh = gather(&assembled);
        let frame = document.frame;
        let mut generators = vec![Isometry::rotation(1, wedge.order)];
        if wedge.mirror {
            generators.push(Isometry::reflection(0, 1));
        }
        if wedge.flip {
            generators.push(Isometry::new(0, 1, false, true));
        }
        for g in generators {
            let map = |p| frame.to_world(g.apply(frame.to_canonical(p)));
            mesh.assert_symmetric(map, 1e-13);
        }
    }
}

#[test]
fn surfaces_assemble_without_tetrahedra() {
    for wedge in wedges() {
        if wedge.copies() == 1 {
            continue;
        }
        let mut document = wedge.document();
        let full = gather(&Assembled::new(&document).unwrap());
        document.templates[0].tets.clear();
        let surface = gather(&Assembled::new(&document).unwrap());
        assert_eq!(surface.triangles, full.triangles);
        surface.assert_closed();
    }
}

#[test]
fn regions_that_instances_exchange_become_interfaces() {
    // Every other copy has its two regions exchanged, so walls become interfaces.
    for (order, mirror) in [(4, true), (2, true), (3, true), (4, false), (2, false)] {
        let wedge = Structured {
            order,
            mirror,
            flip: false,
            bore: 0.5,
            radius: 2.0,
            cells: [4, 2, 1],
        };
        let mut document = wedge.document();
        document.region_maps.push(tmesh::RegionMap {
            pairs: vec![[INNER, OUTER], [OUTER, INNER]],
        });
        for instance in &mut document.instances {
            let exchanged = if mirror {
                instance.isometry.mirrored()
            } else {
                (instance.isometry.k() * (order / instance.isometry.n())) % 2 == 1
            };
            instance.region_map = u32::from(exchanged);
        }
        let mesh = gather(&Assembled::new(&document).unwrap());
        mesh.assert_conforming();
        mesh.assert_closed();
        let half = 0.5 * (mesh.volume(INNER) + mesh.volume(OUTER));
        assert!((mesh.volume(INNER) - half).abs() < 1e-12 * half);
    }
}

#[test]
fn a_single_instance_stays_as_it_is() {
    for wedge in wedges() {
        let mut document = wedge.document();
        document.instances.truncate(1);
        let assembled = Assembled::new(&document).unwrap();
        let identity_seam = wedge.order == 1 && !wedge.mirror;
        assert_eq!(assembled.is_welded(), identity_seam);
        if !identity_seam {
            assert_eq!(
                gather(&assembled).triangles.len(),
                document.templates[0].triangles.len()
            );
        }
    }
}

/// A ring of order `order` around a hub of order `hub`, a divisor; `mirror` is possible where they
/// are equal.
fn with_hub(order: u32, hub: u32, mirror: bool) -> Document {
    let parts = order / hub;
    let ring = Structured {
        order,
        mirror,
        flip: false,
        bore: 0.5,
        radius: 2.0,
        cells: [3, 2, 2],
    };
    let column = Structured {
        order: hub,
        bore: 0.0,
        radius: 0.5,
        cells: [2, 2 * parts, 2],
        ..ring
    };
    let mut document = ring.document();
    let mut other = column.document();
    let faces = |template: &tmesh::Template, marker: u32| -> Vec<u32> {
        let all = (0..).zip(&template.triangles);
        all.filter(|(_, t)| t.marker == marker)
            .map(|(i, _)| i)
            .collect()
    };
    let inner = faces(&document.templates[0], 4);
    let outer = faces(&other.templates[0], 3);
    let mut hubs = Vec::new();
    for (part, outer) in (0..parts).zip(outer.chunks(inner.len())) {
        let grid = (0..=2).flat_map(|j| (0..=2).map(move |k| (j, k)));
        let mut vertex_pairs: Vec<[u32; 2]> = grid
            .map(|(j, k)| [column.vertex([2, 2 * part + j, k]), ring.vertex([0, j, k])])
            .collect();
        vertex_pairs.sort_unstable();
        hubs.push(Gluing {
            name: format!("hub-{part}"),
            other: 0,
            step: Isometry::rotation(i64::from(part), order),
            vertex_pairs,
            triangle_pairs: outer.iter().zip(&inner).map(|(&a, &b)| [a, b]).collect(),
        });
    }
    let gluings = &mut other.templates[0].gluings;
    gluings.iter_mut().for_each(|own| own.other = 1);
    gluings.extend(hubs);
    document.templates.append(&mut other.templates);
    document.instances.extend(
        other
            .instances
            .iter()
            .map(|i| Instance { template: 1, ..*i }),
    );
    document
}

#[test]
fn rings_and_hubs_of_other_orders_become_one() {
    let cases = [
        (4, 4, true),
        (7, 7, false),
        (12, 4, false),
        (12, 3, false),
        (9, 1, false),
    ];
    for (order, hub, mirror) in cases {
        let mut document = with_hub(order, hub, mirror);
        placed(&mut document);
        let assembled = Assembled::new(&document).unwrap();
        let kind = if mirror { Kind::Cv } else { Kind::C };
        assert_eq!(assembled.promise().group, Group::new(kind, hub));
        let mesh = gather(&assembled);
        mesh.assert_conforming();
        mesh.assert_closed();
        assert!(mesh.smallest() > 0.0);
        assert_eq!(mesh.closest_pair(1e-4), None);
        let frame = document.frame;
        let turn = Isometry::rotation(1, hub);
        let map = |p| frame.to_world(turn.apply(frame.to_canonical(p)));
        mesh.assert_symmetric(map, 1e-13);
        // Of copies with a common corner, exactly one point each.
        let sides = if mirror { 2 * order } else { order };
        assert_eq!(mesh.tets.len() as u32, sides * (3 * 2 * 2 * 6 + 2 * 2 * 9));
    }
}
