//! Every promise is broken on purpose, and the check has to say so.

mod groups;

use crate::{Params, Report, analyse};
use bodies::meshes::{assembled, wedge};
use glam::DVec3;
use tmesh::{
    Document, Gluing, Group, Instance, Isometry, Kind, OUTSIDE, Outside, Plane, Promise, Template,
    Tet,
};

fn report(document: &Document) -> Report {
    let params = Params {
        bins: 10,
        limits: Vec::new(),
        bounds: Vec::new(),
        worst: 1,
    };
    analyse(document, None, &params).unwrap()
}

/// The document breaks the promise, in words that contain `part`.
#[track_caller]
fn broken(document: &Document, promise: &str, part: &str) -> Report {
    let report = report(document);
    let texts = report.failures(true);
    let found = report
        .checks
        .violations
        .iter()
        .any(|b| b.promise == promise && b.text.contains(part));
    assert!(found, "{promise} ... {part} not among {texts:#?}");
    assert!(!report.checks.passed);
    report
}

#[track_caller]
fn sound(document: &Document) -> Report {
    let report = report(document);
    assert_eq!(report.failures(true), Vec::<String>::new());
    assert!(report.checks.passed);
    report
}

/// A mirror wall of the first template.
fn mirror(document: &mut Document, wall: usize) -> &mut Gluing {
    &mut document.templates[0].gluings[wall]
}

/// The seam of the first template.
fn seam(document: &mut Document) -> &mut Gluing {
    &mut document.templates[0].gluings[0]
}

fn rotations(n: u32) -> Group {
    Group::new(Kind::C, n)
}

fn mirrors(n: u32) -> Group {
    Group::new(Kind::Cv, n)
}

#[test]
fn sound_meshes_pass_instanced_and_assembled_alike() {
    for (n, with_mirror) in [
        (3, true),
        (5, true),
        (16, true),
        (2, true),
        (2, false),
        (3, false),
        (12, false),
    ] {
        let instanced = wedge(n, with_mirror);
        let a = sound(&instanced);
        let b = sound(&assembled(&instanced));
        assert_eq!(a.summary.vertices, b.summary.vertices);
        assert_eq!(a.summary.tetrahedra, b.summary.tetrahedra);
        assert_eq!(a.summary.surface.triangles, b.summary.surface.triangles);
        assert!((a.summary.volume / b.summary.volume - 1.0).abs() < 1e-13);
        for (x, y) in a.summary.regions.iter().zip(&b.summary.regions) {
            assert_eq!((x.id, &x.name, x.tetrahedra), (y.id, &y.name, y.tetrahedra));
            assert!((x.volume / y.volume - 1.0).abs() < 1e-13);
        }
        for metric in crate::Metric::ALL {
            let (x, y) = (
                a.summary.metrics.get(metric).unwrap(),
                b.summary.metrics.get(metric).unwrap(),
            );
            for statistic in crate::Statistic::ALL {
                let (x, y) = (x.get(statistic), y.get(statistic));
                assert!(
                    (x - y).abs() <= 1e-12 * y.abs(),
                    "{metric:?} {statistic:?} {x} {y}"
                );
            }
        }
        for checks in [&a.checks, &b.checks] {
            assert_eq!(checks.conforming, Some(true));
            assert_eq!(checks.inverted, Some(0));
            assert_eq!(checks.coincident_vertices, Some(0));
            assert_eq!(checks.connectivity_symmetric, Some(true));
            assert!(checks.symmetry_residual.unwrap() < 1e-14);
            assert!(checks.volume_error.unwrap() < 1e-13);
            assert!(checks.boundary_area_error.unwrap() < 1e-13);
        }
        let symmetry = a.summary.symmetry.unwrap();
        let expected = if with_mirror {
            mirrors(n)
        } else {
            rotations(n)
        };
        assert_eq!(symmetry.group, expected);
    }
}

#[test]
fn a_turned_over_tetrahedron() {
    let mut whole = assembled(&wedge(5, true));
    whole.templates[0].tets[17].vertices.swap(2, 3);
    let r = broken(
        &whole,
        "orientation",
        "1 tetrahedra that are not positively oriented; first: tetrahedron 17 is inside out near (",
    );
    assert_eq!(r.checks.inverted, Some(1));
    // The turn is reported once, not again as faces on the wrong side.
    assert_eq!(r.checks.conforming, Some(true));
    let mut instanced = wedge(5, true);
    instanced.templates[0].tets[3].vertices.swap(0, 1);
    broken(&instanced, "orientation", "tetrahedron 3 is inside out");
}

#[test]
fn a_flat_tetrahedron() {
    let mut template = Template {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y],
        ..Template::default()
    };
    template.tets.push(Tet {
        vertices: [0, 1, 2, 3],
        region: 0,
    });
    let mut flat = Document::single(template);
    flat.regions = wedge(3, true).regions;
    flat.regions[0].id = 0;
    let r = broken(&flat, "orientation", "is flat");
    let metrics = &r.summary.metrics;
    assert!(
        metrics
            .get(crate::Metric::AspectRatio)
            .unwrap()
            .max
            .is_infinite()
    );
    // Infinite values neither break the histogram nor the JSON.
    assert!(serde_json::to_string(&r).unwrap().contains("\"max\":null"));
}

#[test]
fn a_doubled_tetrahedron() {
    let mut whole = assembled(&wedge(5, true));
    let tet = whole.templates[0].tets[40];
    whole.templates[0].tets.push(tet);
    broken(&whole, "conforming", "faces with more than two tetrahedra");
    broken(&whole, "volume", "the volume is");
}

#[test]
fn two_tetrahedra_on_one_side() {
    // Two tetrahedra over the same base overlap.
    let mut overlapping = Document::single(Template {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, DVec3::splat(0.4)],
        tets: [[0, 1, 2, 3], [0, 1, 2, 4]]
            .map(|vertices| Tet {
                vertices,
                region: 1,
            })
            .to_vec(),
        ..Template::default()
    });
    overlapping.regions = wedge(3, true).regions;
    broken(
        &overlapping,
        "conforming",
        "two tetrahedra on the same side; first: face 0 1 2 of tetrahedra 0 and 1",
    );
}

#[test]
fn a_missing_tetrahedron() {
    let mut whole = assembled(&wedge(5, true));
    whole.templates[0].tets.remove(40);
    let r = broken(&whole, "conforming", "open faces inside");
    assert_eq!(r.checks.connectivity_symmetric, Some(false));
    broken(
        &whole,
        "symmetry",
        "tetrahedra whose image is no tetrahedron",
    );
    broken(&whole, "volume", "the volume is");
    let mut instanced = wedge(5, false);
    instanced.templates[0].tets.remove(4);
    broken(&instanced, "conforming", "open faces inside");
    broken(&instanced, "volume", "the volume of region");
}

#[test]
fn a_displaced_vertex() {
    for distance in [1e-9, 1e-10] {
        let mut whole = assembled(&wedge(5, true));
        whole.templates[0].vertices[7] += DVec3::new(0.0, 0.6, 0.8) * distance;
        let r = broken(&whole, "symmetry", "vertices that miss their image");
        let residual = r.checks.symmetry_residual.unwrap() * whole.diagonal();
        assert!((residual / distance - 1.0).abs() < 0.5, "{residual}");
        assert_eq!(r.checks.connectivity_symmetric, Some(true));
    }
    let mut whole = assembled(&wedge(5, false));
    whole.templates[0].vertices[7].x += 1e-3;
    let r = broken(&whole, "symmetry", "vertices whose image is no vertex");
    assert_eq!(r.checks.connectivity_symmetric, Some(false));
}

#[test]
fn coincident_vertices() {
    // One tetrahedron gets a vertex of its own: a crack of no width.
    for shift in [0.0, 1e-13] {
        let mut whole = assembled(&wedge(4, true));
        let template = &mut whole.templates[0];
        let v = template.tets[20].vertices[2];
        let p = template.vertices[v as usize];
        template.vertices.push(p + DVec3::splat(shift));
        template.tets[20].vertices[2] = template.vertices.len() as u32 - 1;
        let r = broken(
            &whole,
            "coincidence",
            "vertices that coincide with another; first: vertices",
        );
        assert_eq!(r.checks.coincident_vertices, Some(1));
        assert_eq!(r.checks.conforming, Some(false));
    }
}

#[test]
fn wrong_regions() {
    let mut whole = assembled(&wedge(4, true));
    let tet = &mut whole.templates[0].tets[5];
    tet.region = 3 - tet.region;
    broken(
        &whole,
        "conforming",
        "faces between regions without a surface triangle",
    );
    broken(&whole, "symmetry", "region at odds");
    broken(&whole, "volume", "region 1 'core'");
    let mut whole = assembled(&wedge(4, true));
    let triangle = &mut whole.templates[0].triangles[5];
    std::mem::swap(&mut triangle.front, &mut triangle.back);
    broken(
        &whole,
        "conforming",
        "whose regions are not those of the tetrahedra",
    );
    broken(&whole, "symmetry", "surface triangles whose image");
    // A permutation of regions by the symmetry is in order.
    let mut sectors = assembled(&wedge(4, false));
    let template = &mut sectors.templates[0];
    let per = template.tets.len() / 4;
    template.triangles.clear();
    sectors.source = None;
    for (i, t) in template.tets.iter_mut().enumerate() {
        t.region += 10 * (i / per) as u32;
    }
    sectors.regions = (0..4)
        .flat_map(|k| [1, 2].map(|r| (10 * k + r, r)))
        .map(|(id, r)| tmesh::Region {
            id,
            name: format!("{r}"),
            size: None,
            volume: None,
        })
        .collect();
    sound(&sectors);
    sectors.templates[0].tets[3].region = 11;
    broken(&sectors, "symmetry", "region at odds");
}

#[test]
fn asymmetric_connectivity_on_symmetric_vertices() {
    // Two tetrahedra at a flipped edge: the diagonal of a quadrilateral on the outer side runs the
    // other way in one place.
    let mut whole = assembled(&wedge(6, false));
    let template = &mut whole.templates[0];
    // Swap the roles of two vertices in all tetrahedra of one copy's cell: vertices stay put.
    let [a, b] = [template.tets[1].vertices[0], template.tets[1].vertices[1]];
    let swap = |v: u32| match v {
        v if v == a => b,
        v if v == b => a,
        v => v,
    };
    for tet in &mut template.tets {
        tet.vertices = tet.vertices.map(swap);
    }
    for t in &mut template.triangles {
        t.vertices = t.vertices.map(swap);
    }
    let r = broken(
        &whole,
        "symmetry",
        "tetrahedra whose image is no tetrahedron",
    );
    assert_eq!(r.checks.connectivity_symmetric, Some(false));
    assert!(r.checks.symmetry_residual.unwrap() < 1e-14);
}

#[test]
fn a_promise_too_high() {
    let mut whole = assembled(&wedge(5, false));
    promise(&mut whole).group = rotations(10);
    broken(&whole, "symmetry", "no vertex within");
    let mut mirrored = assembled(&wedge(5, false));
    promise(&mut mirrored).group = mirrors(5);
    broken(&mirrored, "symmetry", "under the mirror");
}

/// The whole of a wedge of order 8, which promises no more than order 4, but 8 outside of a radius
/// between the second ring of vertices (at radius 2) and the third.
fn of_order_eight_outside() -> Document {
    let mut whole = assembled(&wedge(8, false));
    promise(&mut whole).group = rotations(4);
    promise(&mut whole).outside = Some(Outside {
        group: rotations(8),
        radius: 2.5,
    });
    whole
}

fn promise(document: &mut Document) -> &mut Promise {
    document.promise.as_mut().unwrap()
}

/// Moves a vertex at a distance from the axis, and its images under the rotation of order 4, along
/// the axis.
fn move_symmetrically(whole: &mut Document, radius: f64) {
    let frame = {
        let p = promise(whole);
        let rows = p.rotation.map(DVec3::from_array);
        tmesh::Frame {
            rotation: glam::DMat3::from_cols_array_2d(&rows.map(|r| r.to_array())).transpose(),
            origin: DVec3::from_array(p.origin),
        }
    };
    let vertices = &mut whole.templates[0].vertices;
    let own: Vec<DVec3> = vertices.iter().map(|&p| frame.to_canonical(p)).collect();
    let inside = |p: &DVec3| p.z > 0.5 && p.z < 1.5;
    let at = |p: &DVec3| (p.truncate().length() - radius).abs() < 1e-9 && inside(p);
    let first = *own.iter().find(|p| at(p)).unwrap();
    for k in 0..4 {
        let image = Isometry::rotation(k, 4).apply(first);
        let near = own.iter().position(|p| p.distance(image) < 1e-9).unwrap();
        vertices[near] = frame.to_world(image + DVec3::new(0.0, 0.0, 0.01));
    }
}

#[test]
fn a_higher_order_outside_holds_there_only() {
    let r = sound(&of_order_eight_outside());
    let symmetry = r.summary.symmetry.unwrap();
    assert_eq!(symmetry.outside.map(|o| o.group), Some(rotations(8)));
    let text = crate::text(&r, true);
    assert!(
        text.contains("a symmetry of C4, of C8 outside of the radius 2.5\n"),
        "{text}"
    );
    // The whole keeps order 4 all the same.
    let mut inside = of_order_eight_outside();
    move_symmetrically(&mut inside, 1.0);
    sound(&inside);
    promise(&mut inside).outside.as_mut().unwrap().radius = 1.5;
    broken(&inside, "symmetry", "order 8 outside of the radius 1.5");
    let mut outside = of_order_eight_outside();
    for radius in [3.0, 2.0] {
        move_symmetrically(&mut outside, radius);
        let r = broken(&outside, "symmetry", "order 8 outside of the radius 2.5");
        assert!(r.failures(true).iter().all(|f| f.contains("order 8")));
        outside = of_order_eight_outside();
    }
}

#[test]
fn a_higher_order_outside_holds_for_elements_and_regions() {
    // One cell of every second eighth is of another region.
    let mut regions = of_order_eight_outside();
    let far = regions.templates[0].tets.len() / 8 - 1;
    let per_copy = regions.templates[0].tets.len() / 8;
    for copy in [0, 2, 4, 6] {
        regions.templates[0].tets[copy * per_copy + far].region = 1;
    }
    let r = report(&regions);
    let texts = r.failures(true);
    let of = |what: &str| texts.iter().any(|t| t.contains(what));
    assert!(
        of("order 8 outside of the radius 2.5 maps tetrahedron"),
        "{texts:?}"
    );
    let mut missing = of_order_eight_outside();
    for copy in [6, 4, 2, 0] {
        missing.templates[0].tets.remove(copy * per_copy + far);
    }
    broken(&missing, "symmetry", "order 8 outside of the radius 2.5");
}

#[test]
fn a_promise_too_high_outside() {
    let mut whole = of_order_eight_outside();
    promise(&mut whole).outside.as_mut().unwrap().group = rotations(16);
    broken(&whole, "symmetry", "order 16 outside of the radius 2.5");
    let mut mirrored = of_order_eight_outside();
    promise(&mut mirrored).outside.as_mut().unwrap().group = mirrors(8);
    broken(
        &mirrored,
        "symmetry",
        "the mirror outside of the radius 2.5",
    );
    let mut mirrored = assembled(&wedge(8, true));
    *promise(&mut mirrored) = promise(&mut of_order_eight_outside()).clone();
    promise(&mut mirrored).outside.as_mut().unwrap().group = mirrors(8);
    sound(&mirrored);
    for (order, radius) in [(6, 2.5), (8, f64::NAN), (8, -1.0), (0, 2.5)] {
        let mut odd = of_order_eight_outside();
        promise(&mut odd).outside = Some(Outside {
            group: rotations(order),
            radius,
        });
        let params = Params {
            bins: 10,
            limits: Vec::new(),
            bounds: Vec::new(),
            worst: 1,
        };
        let refused = analyse(&odd, None, &params).map_or(true, |r| !r.checks.passed);
        assert!(refused, "{order} {radius}");
    }
    // Of instances.
    let mut instanced = wedge(8, false);
    instanced.promise = of_order_eight_outside().promise;
    sound(&instanced);
    promise(&mut instanced).outside.as_mut().unwrap().group = rotations(16);
    broken(&instanced, "symmetry", "promises C16 outside of 2.5");
}

#[test]
fn missing_and_repeated_instances() {
    let mut instanced = wedge(5, true);
    instanced.instances.remove(3);
    let r = broken(&instanced, "document", "has no neighbour");
    assert_eq!(r.checks.connectivity_symmetric, Some(false));
    broken(&instanced, "volume", "the volume is");
    let mut instanced = wedge(5, true);
    instanced.instances.push(instanced.instances[2]);
    broken(&instanced, "document", "placed twice");
}

#[test]
fn a_sector_on_its_own() {
    let mut sector = wedge(5, true);
    sector.instances.truncate(1);
    let r = sound(&sector);
    assert_eq!(
        r.summary.vertices,
        sector.templates[0].vertices.len() as u64
    );
    assert_eq!(r.checks.volume_error, None);
    assert!(r.notes.iter().any(|n| n.contains("one sector")));
}

#[test]
fn walls_that_leave_something_out() {
    // A face on the wall that is not listed.
    let mut instanced = wedge(5, true);
    mirror(&mut instanced, 0).triangle_pairs.remove(2);
    broken(
        &instanced,
        "conforming",
        "lie on a wall and are not listed on it; first: face",
    );
    // A vertex on the wall that is not listed.
    let mut instanced = wedge(5, true);
    let [v, _] = mirror(&mut instanced, 1).vertex_pairs.remove(2);
    let r = broken(&instanced, "coincidence", &format!("vertex {v} lies"));
    assert_eq!(r.checks.coincident_vertices, Some(1));
    broken(&instanced, "conforming", "has vertices that are not on it");
    // A vertex beyond the wall.
    let mut instanced = wedge(5, true);
    let on_a: Vec<u32> = mirror(&mut instanced, 0).vertices_here().collect();
    let on_b: Vec<u32> = mirror(&mut instanced, 1).vertices_here().collect();
    let count = instanced.templates[0].vertices.len() as u32;
    let free = (0..count)
        .find(|v| !on_a.contains(v) && !on_b.contains(v))
        .unwrap();
    instanced.templates[0].vertices[free as usize].y = -0.01;
    broken(&instanced, "conforming", "vertices beyond a mirror wall");
    // One listed on the wall, but off its plane.
    let mut instanced = wedge(5, true);
    let v = on_a[5] as usize;
    instanced.templates[0].vertices[v].y = 1e-9;
    broken(&instanced, "document", "away from the plane");
    // A triangle listed on the wall that is inside.
    let mut instanced = wedge(5, true);
    let inside = instanced.templates[0]
        .triangles
        .iter()
        .position(|t| t.front != OUTSIDE && t.back != OUTSIDE);
    let wall = mirror(&mut instanced, 0);
    wall.triangle_pairs.push([inside.unwrap() as u32; 2]);
    wall.triangle_pairs.sort();
    broken(
        &instanced,
        "conforming",
        "wall triangles without exactly one tetrahedron",
    );
}

#[test]
fn seams_that_leave_something_out() {
    let mut instanced = wedge(5, false);
    seam(&mut instanced).triangle_pairs.remove(2);
    broken(
        &instanced,
        "conforming",
        "lie on a wall and are not listed on it",
    );
    let mut instanced = wedge(5, false);
    let s = seam(&mut instanced);
    let [v, w] = s.vertex_pairs.remove(3);
    let touched: Vec<u32> = instanced.templates[0]
        .triangles
        .iter()
        .enumerate()
        .filter(|(_, t)| t.vertices.contains(&v) || t.vertices.contains(&w))
        .map(|(i, _)| i as u32)
        .collect();
    seam(&mut instanced)
        .triangle_pairs
        .retain(|p| !touched.contains(&p[0]));
    let r = broken(&instanced, "coincidence", "unpaired");
    assert_eq!(r.checks.coincident_vertices, Some(1));
    // A high vertex one rounding off.
    let mut instanced = wedge(5, false);
    let [_, w] = seam(&mut instanced).vertex_pairs[3];
    let p = &mut instanced.templates[0].vertices[w as usize];
    p.x = p.x.next_up();
    broken(&instanced, "document", "is not the image of vertex");
}

#[test]
fn region_maps_count() {
    // Every copy of the wedge is a material of its own.
    let mut instanced = wedge(4, false);
    instanced.source = None;
    instanced.regions = (1..=8)
        .map(|id| tmesh::Region {
            id,
            name: format!("part {id}"),
            size: None,
            volume: None,
        })
        .collect();
    for (k, instance) in instanced.instances.iter_mut().enumerate() {
        let k = k as u32;
        instance.region_map = k;
        if k > 0 {
            instanced.region_maps.push(tmesh::RegionMap {
                pairs: vec![[1, 1 + 2 * k], [2, 2 + 2 * k]],
            });
        }
    }
    let r = sound(&instanced);
    assert_eq!(r.summary.regions.len(), 8);
    assert_eq!(r.summary.symmetry.unwrap().group.order, 4);
    let per = r.summary.regions[0].tetrahedra;
    assert!(
        r.summary
            .regions
            .iter()
            .step_by(2)
            .all(|r| r.tetrahedra == per)
    );
    // Two materials in turn: still a symmetry of order 4, which exchanges them.
    for (k, instance) in instanced.instances.iter_mut().enumerate() {
        instance.region_map = (k % 2) as u32;
    }
    instanced.region_maps[0].pairs = vec![[1, 2], [2, 1]];
    assert_eq!(sound(&instanced).summary.symmetry.unwrap().group.order, 4);
    // One copy apart from the others: no symmetry left.
    for (k, instance) in instanced.instances.iter_mut().enumerate() {
        instance.region_map = u32::from(k == 0);
    }
    assert_eq!(sound(&instanced).summary.symmetry.unwrap().group.order, 1);
}

#[test]
fn volumes_that_differ() {
    let mut whole = assembled(&wedge(5, true));
    whole.source.as_mut().unwrap().volume *= 1.0 + 3e-6;
    broken(&whole, "volume", "the volume is");
    // An input that is symmetric only within a residual has that much play.
    whole.symmetry.as_mut().unwrap().residual = 1e-5;
    sound(&whole);
    whole.source.as_mut().unwrap().boundary_area *= 1.01;
    broken(&whole, "volume", "the area of the boundary is");
}

#[test]
fn surfaces_are_checked_as_such() {
    let strip = |mut d: Document| {
        d.templates[0].tets.clear();
        d
    };
    for document in [
        strip(wedge(5, true)),
        strip(wedge(7, false)),
        strip(assembled(&wedge(5, true))),
    ] {
        let r = sound(&document);
        assert_eq!(r.summary.tetrahedra, 0);
        assert_eq!(r.checks.inverted, None);
        assert!(r.checks.volume_error.unwrap() < 1e-14);
        assert!(r.checks.boundary_area_error.unwrap() < 1e-13);
        assert!(r.notes[0].contains("no tetrahedra"));
        let mut open = document.clone();
        open.templates[0].triangles.remove(0);
        let wall_lists = open.templates[0].gluings.len();
        if wall_lists == 0 {
            let r = broken(
                &open,
                "conforming",
                "edges at which the surface does not close; first: edge",
            );
            assert_eq!(r.checks.violations[0].count, 3);
        }
        let mut twice = document;
        let t = twice.templates[0].triangles[4];
        twice.templates[0].triangles.push(t);
        broken(
            &twice,
            "conforming",
            "surface triangles that occur more than once",
        );
    }
}

#[test]
fn nothing_to_measure() {
    let empty = Document::single(Template::default());
    let params = Params {
        bins: 3,
        limits: Vec::new(),
        bounds: Vec::new(),
        worst: 1,
    };
    let error = analyse(&empty, None, &params).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("neither tetrahedra nor triangles")
    );
    let mut wild = assembled(&wedge(3, true));
    wild.templates[0].tets[1].vertices[2] = 1_000_000;
    let error = analyse(&wild, None, &params).unwrap_err();
    assert!(
        error.to_string().contains("names vertex 1000000"),
        "{error}"
    );
    let mut unplaced = wedge(3, true);
    unplaced.instances.clear();
    let r = report(&unplaced);
    assert_eq!((r.summary.vertices, r.summary.tetrahedra), (0, 0));
}

/// A wedge of order 8 around a hub of order 4: each hub half-wedge spans two half-wedges.
#[test]
fn hub_walls_join_templates() {
    let document = hub();
    let r = sound(&document);
    // Weld by coordinates for comparison.
    let mut seen = std::collections::BTreeSet::new();
    for instance in &document.instances {
        let placed = instance.isometry.placed();
        for &p in &document.templates[instance.template as usize].vertices {
            seen.insert(placed.apply(p).to_array().map(|x| (x * 1e9).round() as i64));
        }
    }
    assert_eq!(r.summary.vertices, seen.len() as u64);
    assert_eq!(r.summary.symmetry.unwrap().group.order, 4);

    let mut broken_pair = document.clone();
    broken_pair.templates[1].gluings[2].triangle_pairs.pop();
    broken(
        &broken_pair,
        "conforming",
        "do not meet each instance exactly once",
    );
    broken(&broken_pair, "conforming", "are not listed on it");
    let mut unwalled = document;
    unwalled.templates[1].gluings.truncate(2);
    let r = report(&unwalled);
    assert!(!r.checks.passed || r.summary.vertices > seen.len() as u64);
}

/// Template 0: the shell of `wedge(8, true)` (order 8); template 1: its core, with two half-wedges
/// joined into one of order 4.
fn hub() -> Document {
    let mut document = wedge(8, true);
    let full = document.templates[0].clone();
    let part = |region: u32, images: &[Isometry]| {
        let mut ids = std::collections::BTreeMap::new();
        let mut t = Template::default();
        for image in images {
            let placed = image.placed();
            for tet in full.tets.iter().filter(|t| t.region == region) {
                let mut vertices = tet.vertices.map(|v| {
                    let p = placed.apply(full.vertices[v as usize]);
                    // Points on the far wall are their own images.
                    let key = p.to_array().map(|x| (x * 1e9).round() as i64);
                    *ids.entry(key).or_insert_with(|| {
                        t.vertices.push(p);
                        t.vertices.len() as u32 - 1
                    })
                });
                if image.reverses_orientation() {
                    vertices.swap(0, 1);
                }
                t.tets.push(Tet { vertices, region });
            }
        }
        t.triangles = bodies::meshes::skin(&t.tets);
        t
    };
    let far = Isometry::reflection(1, 8);
    let mut shell = part(2, &[Isometry::IDENTITY]);
    let mut core = part(1, &[Isometry::IDENTITY, far]);
    let wall = |own: u32, t: &mut Template, name: &str, reflection: Isometry| {
        let plane = Plane::of_reflection(reflection).unwrap();
        let on = |v: u32| plane.distance(t.vertices[v as usize]).abs() < 1e-12;
        let vertices = (0..t.vertices.len() as u32).filter(|&v| on(v));
        let triangles = (0..t.triangles.len() as u32)
            .filter(|&i| t.triangles[i as usize].vertices.iter().all(|&v| on(v)));
        let gluing = Gluing::mirror(name, own, reflection, vertices, triangles);
        t.gluings.push(gluing);
    };
    wall(0, &mut shell, "a", Isometry::reflection(0, 1));
    wall(0, &mut shell, "b", far);
    wall(1, &mut core, "a", Isometry::reflection(0, 1));
    wall(1, &mut core, "b", Isometry::reflection(1, 4));
    for (name, placement) in [("hub-0", Isometry::IDENTITY), ("hub-1", far)] {
        let placed = placement.placed();
        let find = |p: DVec3| {
            let near = |q: &DVec3| q.distance(p) < 1e-9;
            core.vertices.iter().position(near).map(|i| i as u32)
        };
        let inner = |p: &DVec3| p.x.hypot(p.y) < 1.0 + 1e-9;
        let mut vertex_pairs = Vec::new();
        for (v, p) in shell.vertices.iter().enumerate().filter(|v| inner(v.1)) {
            let here = find(placed.apply(*p)).unwrap();
            vertex_pairs.push([here, v as u32]);
        }
        vertex_pairs.sort();
        // Bit-exact images.
        for &[here, there] in &vertex_pairs {
            core.vertices[here as usize] = placed.apply(shell.vertices[there as usize]);
        }
        let partner = |v: u32| vertex_pairs.iter().find(|p| p[1] == v).map(|p| p[0]);
        let mut triangle_pairs = Vec::new();
        for (i, t) in shell.triangles.iter().enumerate() {
            let [Some(a), Some(b), Some(c)] = t.vertices.map(partner) else {
                continue;
            };
            let key = crate::check::faces::sorted([a, b, c]).0;
            let here = core
                .triangles
                .iter()
                .position(|t| crate::check::faces::sorted(t.vertices).0 == key);
            triangle_pairs.push([here.unwrap() as u32, i as u32]);
        }
        triangle_pairs.sort();
        core.gluings.push(Gluing {
            name: name.to_owned(),
            other: 0,
            step: placement,
            vertex_pairs,
            triangle_pairs,
        });
    }
    document.templates = vec![shell, core];
    for k in 0..4 {
        for mirrored in [false, true] {
            document.instances.push(Instance {
                template: 1,
                isometry: Isometry::new(k, 4, mirrored, false),
                region_map: 0,
            });
        }
    }
    document
}
