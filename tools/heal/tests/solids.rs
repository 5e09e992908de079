//! How triangles in groups become regions and markers.

mod common;

use bodies::facets::*;
use common::*;
use heal::{RepairKind, Repairing, read_with};
use interchange::Format::Stl;
use tmesh::OUTSIDE;

#[test]
fn one_closed_surface_is_region_1() {
    let imported = good(&binary_stl(b"", &unit_cube([0.0; 3])), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 1.0)]);
    assert_eq!(markers(&imported), [(1, "region1", 6.0)]);
    let template = &imported.document.templates[0];
    assert_eq!((template.vertices.len(), template.triangles.len()), (8, 12));
    assert!(
        template
            .triangles
            .iter()
            .all(|t| (t.front, t.back) == (OUTSIDE, 1))
    );
    let source = imported.document.source.as_ref().unwrap();
    assert_eq!((source.format.as_str(), source.triangles), ("stl", 12));
    assert_eq!((round(source.volume), source.boundary_area), (1.0, 6.0));
    assert_eq!(source.precision, f64::from(2.0_f32.powi(-24)));
    assert!(imported.notices.is_empty());
}

#[test]
fn an_inward_surface_is_turned_over() {
    let imported = good(&binary_stl(b"", &reversed(&unit_cube([0.0; 3]))), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 1.0)]);
    assert!(
        imported.notices[0].contains("oriented inwards"),
        "{:?}",
        imported.notices
    );
}

#[test]
fn one_turned_triangle_is_turned_back() {
    let mut facets = unit_cube([0.0; 3]);
    facets[5].swap(0, 1);
    let imported = good(&binary_stl(b"", &facets), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 1.0)]);
    assert!(imported.notices[0].starts_with("1 triangle is oriented against"));
}

#[test]
fn voids_by_orientation_or_by_nesting() {
    let outer = cuboid([0.0; 3], [4.0; 3]);
    let inner = cuboid([1.0; 3], [3.0; 3]);
    let core = cuboid([1.5; 3], [2.5; 3]);
    let right = [outer.clone(), reversed(&inner), core.clone()].concat();
    let imported = good(&binary_stl(b"", &right), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 64.0 - 8.0 + 1.0)]);
    assert!(imported.notices.is_empty());
    let wrong = [outer, inner, core].concat();
    let imported = good(&binary_stl(b"", &wrong), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 57.0)]);
    assert_eq!(imported.notices.len(), 1);
    assert!(imported.notices[0].contains("taken as voids"));
}

#[test]
fn disjoint_pieces_are_one_region() {
    let both = [unit_cube([0.0; 3]), unit_cube([5.0, 0.0, 0.0])].concat();
    let imported = good(&binary_stl(b"", &both), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 2.0)]);
}

#[test]
fn an_edge_in_common_is_unambiguous() {
    // Two cubes of one solid that share an edge: four triangles around it.
    let both = [unit_cube([0.0; 3]), unit_cube([1.0, 1.0, 0.0])].concat();
    let imported = good(&binary_stl(b"", &both), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 2.0)]);
    assert_eq!(imported.document.templates[0].vertices.len(), 14);
}

#[test]
fn coincident_triangles_of_two_solids_become_an_interface() {
    let solids = [
        ("copper", unit_cube([0.0; 3])),
        ("", Vec::new()),
        ("Silicon Oxide", unit_cube([0.0, 0.0, 1.0])),
        ("", unit_cube([9.0, 0.0, 0.0])),
    ];
    let imported = good(&ascii_stl(&solids), Stl);
    assert_eq!(
        regions(&imported),
        [
            (1, "copper", 1.0),
            (2, "Silicon Oxide", 1.0),
            (3, "region3", 1.0)
        ]
    );
    assert_eq!(
        markers(&imported),
        [
            (1, "copper", 5.0),
            (2, "Silicon Oxide", 5.0),
            (3, "region3", 6.0),
            (4, "copper/Silicon Oxide", 1.0)
        ]
    );
    let triangles = &imported.document.templates[0].triangles;
    assert_eq!(triangles.len(), 34);
    let interface: Vec<_> = triangles.iter().filter(|t| t.marker == 4).collect();
    assert_eq!(interface.len(), 2);
    assert!(interface.iter().all(|t| (t.front, t.back) == (2, 1)));
    let source = imported.document.source.as_ref().unwrap();
    assert_eq!(round(source.boundary_area), 16.0);
}

#[test]
fn a_solid_in_the_cavity_of_another() {
    let core = cuboid([1.0; 3], [3.0; 3]);
    let shell = [cuboid([0.0; 3], [4.0; 3]), reversed(&core)].concat();
    for solids in [
        [("shell", shell.clone()), ("core", core.clone())],
        [("shell", reversed(&shell)), ("core", core.clone())],
    ] {
        let imported = good(&ascii_stl(&solids), Stl);
        assert_eq!(regions(&imported), [(1, "shell", 56.0), (2, "core", 8.0)]);
        assert_eq!(markers(&imported)[1], (3, "shell/core", 24.0));
    }
}

#[test]
fn repeated_names_are_told_apart() {
    let solids = [
        ("part", unit_cube([0.0; 3])),
        ("part", unit_cube([2.0, 0.0, 0.0])),
    ];
    let imported = good(&ascii_stl(&solids), Stl);
    assert_eq!(regions(&imported), [(1, "part", 1.0), (2, "part-2", 1.0)]);
}

#[test]
fn open_solids_are_pieces_of_one_boundary() {
    let cube = unit_cube([0.0; 3]);
    let solids = [
        ("bottom", cube[..2].to_vec()),
        ("top", cube[2..4].to_vec()),
        ("sides", cube[4..].to_vec()),
    ];
    let imported = good(&ascii_stl(&solids), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 1.0)]);
    assert_eq!(
        markers(&imported),
        [(1, "bottom", 1.0), (2, "top", 1.0), (3, "sides", 4.0)]
    );
}

/// Why a file is refused where nothing may be changed.
fn refused_as_it_is(bytes: &[u8]) -> String {
    match read_with(bytes, Stl, Repairing::Off) {
        Ok(imported) => panic!("accepted: {:?}", imported.document.regions),
        Err(error) => error.to_string(),
    }
}

#[test]
fn overlapping_solids_are_refused_with_a_place_where_nothing_may_be_changed() {
    let overlap = |a, b| refused_as_it_is(&ascii_stl(&[("a", a), ("b", b)]));
    let cube = || unit_cube([0.0; 3]);
    // Crossing, identical, nested, and with one face in common but both on the same side.
    let crossing = overlap(cube(), unit_cube([0.5, 0.25, 0.125]));
    assert!(
        crossing.starts_with("solid 'a' and solid 'b' cross or touch at (0.5"),
        "{crossing}"
    );
    let same = overlap(cube(), cube());
    assert!(same.contains("overlap"), "{same}");
    let nested = overlap(cuboid([-1.0; 3], [2.0; 3]), cube());
    assert!(
        nested.starts_with("solid 'a' and solid 'b' overlap") && nested.contains("cavity"),
        "{nested}"
    );
    let flush = overlap(cube(), cuboid([0.0; 3], [1.0, 1.0, 2.0]));
    assert!(
        flush.contains("cross or touch") || flush.contains("overlap"),
        "{flush}"
    );
}

#[test]
fn solids_that_touch_without_matching_triangles_are_refused_where_nothing_may_be_changed() {
    let touch = |b| refused_as_it_is(&ascii_stl(&[("a", unit_cube([0.0; 3])), ("b", b)]));
    // Faces that overlap in part, a vertex on a face, an edge on a face, and the other diagonal.
    let part = touch(unit_cube([0.5, 0.25, 1.0]));
    assert!(part.contains("with different triangles"), "{part}");
    let tip = [0.5, 0.25, 1.0];
    let (p, q, r) = ([0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]);
    let spike = vec![[tip, q, p], [tip, r, q], [tip, p, r], [p, q, r]];
    let tip = touch(spike);
    assert!(tip.contains("at (0.5, 0.25, 1)"), "{tip}");
    let turned: Vec<Facet> = unit_cube([0.0, 0.0, 1.0])
        .into_iter()
        .map(|f| f.map(|[x, y, z]| [1.0 - x, y, z]))
        .map(|[a, b, c]| [a, c, b])
        .collect();
    let diagonal = touch(turned);
    assert!(diagonal.contains("with different triangles"), "{diagonal}");
}

#[test]
fn open_surfaces_say_how_many_edges_and_where() {
    let cube = unit_cube([0.0; 3]);
    let open = refused(&binary_stl(b"", &cube[1..]), Stl);
    assert!(
        open.starts_with("the surface is not closed: 3 open edges (the first from (0, 0, 0) to"),
        "{open}"
    );
    let named = refused(
        &ascii_stl(&[("a", unit_cube([3.0, 0.0, 0.0])), ("b", cube[1..].to_vec())]),
        Stl,
    );
    assert!(named.contains("in solid 'b'"), "{named}");
    // A wall too many: edges with three triangles.
    let fin = [
        cube.clone(),
        vec![[[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [-1.0, -1.0, 0.5]]],
    ]
    .concat();
    let fin = refused(&binary_stl(b"", &fin), Stl);
    assert!(
        fin.contains("2 open edges") && fin.contains("1 edge with an odd number of triangles"),
        "{fin}"
    );
}

#[test]
fn repeated_and_degenerate_triangles_are_dropped() {
    let cube = unit_cube([0.0; 3]);
    let p = cube[0][0];
    let mut facets = [cube.clone(), cube[3..5].to_vec(), reversed(&cube[3..4])].concat();
    facets.push([p, p, cube[4][1]]);
    let imported = good(&binary_stl(b"", &facets), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 1.0)]);
    assert_eq!(imported.document.templates[0].triangles.len(), 12);
    assert_eq!(imported.notices.len(), 2);
    // An inner wall that both halves bring along.
    let halves = [unit_cube([0.0; 3]), unit_cube([0.0, 0.0, 1.0])].concat();
    let imported = good(&binary_stl(b"", &halves), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 2.0)]);
    assert_eq!(imported.document.templates[0].triangles.len(), 20);
}

#[test]
fn rounding_is_welded_where_the_surface_would_be_open() {
    let mut facets = unit_cube([0.0; 3]);
    for x in &mut facets[7][1] {
        *x += 1.2e-7;
    }
    let imported = good(&binary_stl(b"", &facets), Stl);
    assert_eq!(regions(&imported), [(1, "region1", 1.0)]);
    assert!(
        imported.notices[0].contains("joined"),
        "{:?}",
        imported.notices
    );
    for x in &mut facets[7][1] {
        *x += 1e-3;
    }
    assert!(refused(&binary_stl(b"", &facets), Stl).contains("not closed"));
}

#[test]
fn gaps_are_closed_where_that_closes_the_surface() {
    // Every corner of every facet somewhere else.
    let mut facets = unit_cube([0.0; 3]);
    for (i, facet) in facets.iter_mut().enumerate() {
        for (j, x) in facet.iter_mut().flatten().enumerate() {
            *x += 2e-5 * ((7 * i + 5 * j) % 11) as f64 / 11.0;
        }
    }
    let imported = good(&binary_stl(b"", &facets), Stl);
    let template = &imported.document.templates[0];
    assert_eq!((template.vertices.len(), template.triangles.len()), (8, 12));
    let said = &imported.notices[0];
    assert!(said.contains("which closes the surface"), "{said}");
    // Without a facet nothing closes it, and nothing is joined.
    facets.pop();
    let said = refused(&binary_stl(b"", &facets), Stl);
    assert!(said.contains("open edges"), "{said}");
}

#[test]
fn triangles_without_area_are_removed() {
    // An edge divided on one side only, a triangle without area in between.
    let mut facets = unit_cube([0.0; 3]);
    let [a, b, c] = facets[0];
    let middle = [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
    facets[0] = [a, middle, c];
    facets.extend([[middle, b, c], [a, b, middle]]);
    let imported = good(&binary_stl(b"", &facets), Stl);
    assert_eq!(imported.notices, ["1 triangle without area: removed"]);
    assert_eq!(regions(&imported), [(1, "region1", 1.0)]);
    let template = &imported.document.templates[0];
    assert_eq!((template.vertices.len(), template.triangles.len()), (9, 14));
    for t in &template.triangles {
        let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
        assert!((b - a).cross(c - a).length() > 0.1);
    }
}

#[test]
fn pieces_of_one_solid_that_cross_are_read_with_a_warning_where_nothing_may_be_changed() {
    let both = [unit_cube([0.0; 3]), unit_cube([0.5, 0.25, 0.125])].concat();
    let imported = read_with(&binary_stl(b"", &both), Stl, Repairing::Off).expect("read");
    assert!(imported.notices[0].contains("cross or touch at"));
    assert_eq!(regions(&imported), [(1, "region1", 2.0)]);
}

#[test]
fn a_surface_without_volume_is_refused() {
    let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let pillow = refused(&binary_stl(b"", &[[a, b, c], [a, c, b]]), Stl);
    assert!(pillow.contains("cancel"), "{pillow}");
    let d = [0.25, 0.25, 0.0];
    let flat = [[a, c, b], [a, b, d], [b, c, d], [c, a, d]];
    let flat = refused(&binary_stl(b"", &flat), Stl);
    assert!(flat.contains("no volume"), "{flat}");
    let points = refused(&binary_stl(b"", &[[a, a, b]]), Stl);
    assert!(points.contains("two equal corners"), "{points}");
    assert!(refused(&binary_stl(b"", &[]), Stl).contains("no triangles"));
}

#[test]
fn any_scale_within_reason_will_do() {
    let scaled = |s: f64| -> Vec<Facet> {
        let cube = cuboid([0.0; 3], [4.0; 3]);
        let inner = reversed(&cuboid([1.0; 3], [3.0; 3]));
        [cube, inner]
            .concat()
            .iter()
            .map(|f| f.map(|p| p.map(|x| x * s)))
            .collect()
    };
    for s in [1e-60, 1e-6, 1e6, 1e60] {
        let imported = good(&ascii_stl(&[("a", scaled(s))]), Stl);
        let volume = imported.document.regions[0].volume.unwrap();
        assert!(
            (volume / (56.0 * s * s * s) - 1.0).abs() < 1e-12,
            "{volume}"
        );
    }
    for s in [1e-100, 1e100] {
        assert!(refused(&ascii_stl(&[("a", scaled(s))]), Stl).contains("too "));
    }
}

#[test]
fn cubes_that_cross_at_a_common_edge_are_named_as_the_cause() {
    // The second cube stands on an edge of the first and leans into it: around that edge their faces take turns.
    let turned = unit_cube([0.0; 3])
        .into_iter()
        .map(|facet| facet.map(|[x, y, z]| [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, z]));
    let both = [unit_cube([0.0; 3]), turned.collect()].concat();
    let said = refused_as_it_is(&binary_stl(b"", &both));
    assert!(
        said.contains("pairs of triangles cross or touch, the first at ("),
        "{said}"
    );
    assert!(
        said.contains("1 edge has more than two triangles, the first from (0, 0, 0) to"),
        "{said}"
    );
}

#[test]
fn a_corner_on_an_edge_is_stitched() {
    // One triangle has a corner more on its edge than its neighbour, on the edge or a little off it.
    for off in [0.0, 2e-5] {
        let mut facets = unit_cube([0.0; 3]);
        let [a, b, c] = facets[0];
        let mut middle = [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
        middle[2] += off;
        facets[0] = [a, middle, c];
        facets.push([middle, b, c]);
        let imported = good(&binary_stl(b"", &facets), Stl);
        let [repair] = &imported.repairs[..] else {
            panic!("{:?}", imported.repairs);
        };
        assert_eq!((repair.kind, repair.count), (RepairKind::Stitched, 1));
        assert!((repair.largest - off).abs() < 1e-7, "{repair:?}");
        assert!((imported.document.regions[0].volume.unwrap() - 1.0).abs() < 1e-4);
        // As it is, it is refused with its open edges.
        let as_it_is = read_with(&binary_stl(b"", &facets), Stl, Repairing::Off);
        let said = as_it_is.map(|_| ()).unwrap_err().to_string();
        assert!(said.contains("3 open edges (the first from"), "{said}");
    }
}

#[test]
fn a_gap_wider_than_the_facets_explain_is_refused_with_its_place() {
    let mut facets = unit_cube([0.0; 3]);
    facets[7][1][2] += 0.01;
    let said = refused(&binary_stl(b"", &facets), Stl);
    assert!(said.contains("open edges (the first from"), "{said}");
    assert!(
        said.contains("1 gap is wider than the facets there explain, 0.00999"),
        "{said}"
    );
}

#[test]
fn without_repairs_nothing_is_dropped() {
    let cube = unit_cube([0.0; 3]);
    let whole = read_with(&binary_stl(b"", &cube), Stl, Repairing::Off).unwrap();
    assert!(whole.repairs.is_empty());
    let twice = [cube.clone(), cube[3..5].to_vec()].concat();
    let said = read_with(&binary_stl(b"", &twice), Stl, Repairing::Off);
    let said = said.map(|_| ()).unwrap_err().to_string();
    assert!(
        said.starts_with("2 triangles that the surface has twice, the first at ("),
        "{said}"
    );
    assert_eq!(good(&binary_stl(b"", &twice), Stl).repairs[0].count, 2);
}
