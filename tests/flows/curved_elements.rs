//! Elements of second order follow the shape behind the facets of their body.

use bodies::{Body, HelicalGear, Placement, Prism, Tsv};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use support::{EXACT_STL, encode, run};

type Point = [f64; 3];

/// Nodes, and the region and the ten nodes of each tetrahedron.
struct Mesh {
    points: Vec<Point>,
    tets: Vec<(u32, [usize; 10])>,
}

/// Edges in Gmsh's order of the nodes on them.
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [3, 0], [2, 3], [3, 1]];

impl Mesh {
    /// Of an MSH 2.2 file in text.
    fn parse(text: &[u8]) -> Self {
        let text = std::str::from_utf8(text).expect("text");
        let section = |name: &str| {
            let (_, rest) = text.split_once(name).expect("a section");
            let lines = rest.lines().skip(1).take_while(|l| !l.starts_with('$'));
            lines.map(|l| l.split(' ').collect::<Vec<_>>())
        };
        let number = |word: &&str| word.parse::<f64>().expect("a number");
        let points = section("$Nodes\n").map(|n| [1, 2, 3].map(|i| number(&n[i])));
        let tets = section("$Elements\n").filter(|e| e[1] == "11").map(|e| {
            let node = |i: usize| number(&e[5 + i]) as usize - 1;
            (number(&e[3]) as u32, std::array::from_fn(node))
        });
        Self {
            points: points.collect(),
            tets: tets.collect(),
        }
    }

    /// Determinant of the Jacobian of an element at barycentric coordinates.
    fn jacobian(&self, nodes: &[usize; 10], at: [f64; 4]) -> f64 {
        // Derivatives of the coordinates along the edges from the first corner.
        let slope = |i: usize, k: usize| match i {
            0 => -1.0,
            i => f64::from(u8::from(i == k + 1)),
        };
        let mut m = [[0.0; 3]; 3];
        for (k, row) in m.iter_mut().enumerate() {
            let mut add = |node: usize, weight: f64| {
                let p = self.points[nodes[node]];
                row.iter_mut().zip(p).for_each(|(x, p)| *x += weight * p);
            };
            for (i, x) in at.iter().enumerate() {
                add(i, (4.0 * x - 1.0) * slope(i, k));
            }
            for (e, [i, j]) in EDGES.into_iter().enumerate() {
                add(4 + e, 4.0 * (at[i] * slope(j, k) + at[j] * slope(i, k)));
            }
        }
        let [a, b, c] = m;
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    }

    /// Volume of each region, by a rule of five points that is exact for the Jacobian, which is of degree 3. Where it is looked at,
    /// in these points and at the nodes, the Jacobian has to be positive.
    fn volumes(&self) -> BTreeMap<u32, f64> {
        let near = |c: usize| std::array::from_fn(|i| if i == c { 0.5 } else { 1.0 / 6.0 });
        let rule: Vec<([f64; 4], f64)> = std::iter::once(([0.25; 4], -0.8))
            .chain((0..4).map(|c| (near(c), 0.45)))
            .collect();
        let corners = (0..4).map(|c| std::array::from_fn(|i| f64::from(u8::from(i == c))));
        let halves = EDGES.map(|e| std::array::from_fn(|i| if e.contains(&i) { 0.5 } else { 0.0 }));
        let nodes: Vec<[f64; 4]> = corners.chain(halves).collect();
        let mut volumes = BTreeMap::new();
        for (region, tet) in &self.tets {
            assert!(nodes.iter().all(|at| self.jacobian(tet, *at) > 0.0));
            let parts = rule.iter().map(|(at, w)| w * self.jacobian(tet, *at));
            *volumes.entry(*region).or_default() += parts.sum::<f64>() / 6.0;
        }
        volumes
    }
}

/// The meshed wedge of a body, turned at random.
fn meshed(mut body: Body, sizes: &[&str]) -> Vec<u8> {
    let placement = Placement {
        rotate: Some(5),
        scale: 1.0,
        jitter: 0.0,
    };
    placement.apply(&mut body);
    let stl = encode(&body, EXACT_STL);
    let found = run("symdetect", &["-q"], &stl).success();
    let wedge = run("wedgecut", &[&["-q"], sizes].concat(), &found).success();
    run("tetwedge", &["-q"], &wedge).success()
}

/// The mesh of second order, or the sector.
fn second_order(wedge: &[u8], options: &[&str]) -> Mesh {
    let basic = ["-q", "--second-order", "--ascii", "--to", "msh2"];
    Mesh::parse(&run("rotassemble", &[&basic[..], options].concat(), wedge).success())
}

/// All that is promised of the mesh still holds; its symmetry is exact but for the rounding of its place.
#[track_caller]
fn keeps_promises(wedge: &[u8]) {
    let whole = run("rotassemble", &["-q", "--second-order"], wedge).success();
    run("meshqual", &["-q", "--check"], &whole).success();
}

fn cylinder(order: u32) -> Body {
    let prism = Prism {
        order,
        ..Prism::default()
    };
    prism.build()
}

#[test]
fn a_prism_that_stands_for_a_cylinder_becomes_one() {
    // As coarse as facets allow, with points of the mesher on facets, and with facets across walls.
    for (order, sizes) in [
        (16, &[][..]),
        (16, &["--edge-length", "0.3"]),
        (24, &["--order", "3"]),
    ] {
        let body = cylinder(order);
        let wedge = meshed(cylinder(order), sizes);
        let whole = second_order(&wedge, &[]);
        let volume: f64 = whole.volumes().values().sum();
        let height =
            body.total_volume() / (0.5 * f64::from(order) * (2.0 * PI / f64::from(order)).sin());
        let missing = PI * height - body.total_volume();
        let reached = (volume - body.total_volume()) / missing;
        assert!(
            (reached - 1.0).abs() < 0.005,
            "{order} {sizes:?}: {reached}"
        );
        let sector = second_order(&wedge, &["--sector"]);
        let share = volume / sector.volumes().values().sum::<f64>();
        assert!((share - share.round()).abs() < 1e-9, "{share} copies");
        keeps_promises(&wedge);

        let straight = second_order(&wedge, &["--straight-edges"]);
        let volume: f64 = straight.volumes().values().sum();
        assert!((volume / body.total_volume() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn thin_layers_between_curved_interfaces_stay_valid() {
    let via = Tsv {
        order: 16,
        thickness: 0.005,
        ..Tsv::default()
    };
    let body = via.build();
    let wedge = meshed(via.build(), &["--hub", "none"]);
    let told = run("rotassemble", &["--second-order", "--to", "vtk"], &wedge).stderr;
    let sentence = "edges of the wedge follow the shape of curved faces\n";
    assert!(told.ends_with(sentence), "{told}");
    let sector = second_order(&wedge, &["--sector"]);
    let straight = second_order(&wedge, &["--sector", "--straight-edges"]);
    let turn = 2.0 * PI / 16.0;
    for ((region, curved), (_, facets)) in sector.volumes().iter().zip(straight.volumes()) {
        // All interfaces are polygons about one axis, so that all areas grow alike.
        let grown = (curved / facets - 1.0) / (turn / turn.sin() - 1.0);
        assert!((grown - 1.0).abs() < 0.01, "region {region}: {grown}");
    }
    assert_eq!(sector.volumes().len(), body.materials.len());
    keeps_promises(&wedge);
}

#[test]
fn seams_of_twisted_bodies_stay_images_of_each_other() {
    let gear = HelicalGear {
        order: 3,
        radius: 1.0,
        bore: 0.3,
        height: 0.6,
        twist: 0.3,
        layers: 4,
    };
    let wedge = meshed(gear.build(), &[]);
    let curved = run("rotassemble", &["-q", "--second-order"], &wedge).success();
    let flat = ["-q", "--second-order", "--straight-edges"];
    assert!(curved != run("rotassemble", &flat, &wedge).success());
    second_order(&wedge, &[]).volumes();
    keeps_promises(&wedge);
}

#[test]
fn flat_bodies_stay_as_they_are() {
    for (order, angle) in [(8, "30"), (16, "20")] {
        let wedge = meshed(cylinder(order), &["--feature-angle", angle]);
        for format in ["vtk", "vtu", "msh", "inp"] {
            let of = |options: &[&str]| {
                let basic = ["--second-order", "--to", format];
                let outcome = run("rotassemble", &[&basic[..], options].concat(), &wedge);
                assert!(!outcome.stderr.contains("follow"), "{}", outcome.stderr);
                outcome.success()
            };
            assert!(of(&[]) == of(&["--straight-edges"]), "{order} {format}");
        }
    }
    let usage = run("rotassemble", &["--straight-edges"], b"");
    usage.fails(2, &["--second-order"]);
}

#[test]
fn edges_of_first_order_are_straight_anyway() {
    run("rotassemble", &["--straight-edges"], b"").fails(2, &["--second-order"]);
}
