//! The whole pipe on bodies whose symmetry, regions and volumes are known.

use bodies::{
    Body, Coating, Encoding, Gear, Impeller, Placement, PracticalTsv, Prism, Ratchet, Tessellation,
    Tsv, cube,
};
use serde_json::Value;
use support::{EXACT_STL, encode, pipe, run};

/// Stages up to the meshed wedge.
const MESH: [&[&str]; 4] = [
    &["symdetect", "-q"],
    &["wedgecut", "-q"],
    &["periodic-surf", "-q"],
    &["tetwedge", "-q"],
];

/// What must come out of a body.
struct Expected {
    order: u64,
    mirror: bool,
    /// Name and volume of each region.
    regions: Vec<(String, f64)>,
    /// Relative error that the encoding may cause in a volume.
    tolerance: f64,
}

impl Expected {
    fn of(body: &Body, encoding: Encoding) -> Self {
        let names = body.materials.iter().enumerate();
        let regions = names.map(|(i, m)| (m.name.clone(), body.volume(i)));
        // The lengths of thin parts have few digits in single precision, and fewer far from the
        // origin.
        let tolerance = match encoding {
            Encoding::StlBinary => 2e-5,
            _ => 1e-9,
        };
        Self {
            order: body.order.into(),
            mirror: body.group.has_vertical_mirrors(),
            regions: regions.collect(),
            tolerance,
        }
    }
}

fn json(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes).expect("meshqual writes JSON")
}

/// Checks of `meshqual` as JSON.
const CHECK: [&str; 5] = ["meshqual", "-q", "--check", "--json", "-"];

/// Meshes a body and checks everything that an assembled mesh promises on the document of
/// instances. Returns the meshed wedge and the report.
fn mesh_wedge(name: &str, body: &Body, encoding: Encoding, stages: &[&[&str]]) -> (Vec<u8>, Value) {
    let expected = Expected::of(body, encoding);
    let outcomes = pipe(stages, &encode(body, encoding));
    for outcome in &outcomes {
        assert_eq!(
            outcome.code, 0,
            "{name}: {}: {}",
            outcome.tool, outcome.stderr
        );
    }
    let wedge = outcomes.into_iter().last().expect("stages").stdout;
    let checked = run("meshqual", &CHECK[1..], &wedge);
    assert_eq!(checked.code, 0, "{name}: {}", checked.stderr);
    let report = json(&checked.stdout);
    check_report(name, &report, &expected);
    let symmetry = &report["symmetry"];
    // The order used is a divisor of the order found; with a hub, a divisor of that.
    let order = symmetry["order"].as_u64().expect("a number");
    assert!(expected.order.is_multiple_of(order), "{name}: {order}");
    assert_eq!(symmetry["mirror"], expected.mirror, "{name}");
    (wedge, report)
}

/// As [`mesh_wedge`], and checks the whole mesh as well, without the help of the instances.
fn mesh_and_check(name: &str, body: &Body, encoding: Encoding, stages: &[&[&str]]) -> Vec<u8> {
    let (wedge, instanced) = mesh_wedge(name, body, encoding, stages);
    let whole = pipe(&[&["rotassemble", "-q", "--to", "tmesh"], &CHECK], &wedge);
    for outcome in &whole {
        assert_eq!(outcome.code, 0, "{name}: whole: {}", outcome.stderr);
    }
    let whole = json(&whole[1].stdout);
    check_report(name, &whole, &Expected::of(body, encoding));
    for key in ["vertices", "tetrahedra"] {
        assert_eq!(instanced[key], whole[key], "{name}: {key}");
    }
    wedge
}

fn check_report(name: &str, report: &Value, expected: &Expected) {
    let checks = &report["checks"];
    for key in ["conforming", "connectivity_symmetric", "passed"] {
        assert_eq!(checks[key], true, "{name}: {checks}");
    }
    for key in ["inverted", "coincident_vertices"] {
        assert_eq!(checks[key], 0, "{name}: {checks}");
    }
    let residual = checks["symmetry_residual"].as_f64().expect("a number");
    assert!(residual < 1e-12, "{name}: {checks}");
    let regions = report["regions"].as_array().expect("an array");
    assert_eq!(regions.len(), expected.regions.len(), "{name}: {regions:?}");
    for (region, volume) in &expected.regions {
        let found = regions.iter().find(|r| r["name"] == region.as_str());
        // Binary STL has no names.
        let found = found.or(regions.first().filter(|_| regions.len() == 1));
        let found = found.unwrap_or_else(|| panic!("{name}: no {region} in {regions:?}"));
        let found = found["volume"].as_f64().expect("a number");
        let error = (found - volume).abs() / volume;
        assert!(
            error < expected.tolerance,
            "{name}: {region} {found} for {volume}: {error:e}"
        );
    }
}

fn prism(order: u32, tessellation: Tessellation) -> Body {
    Prism {
        order,
        tessellation,
        ..Prism::default()
    }
    .build()
}

fn ring(order: u32, thickness: f64) -> Body {
    Coating {
        order,
        radius: 1.0,
        bore: 0.5,
        thickness,
        height: 1.0,
        tessellation: Tessellation::Symmetric,
    }
    .build()
}

fn tsv(order: u32, thickness: f64) -> Body {
    Tsv {
        order,
        core: 0.2,
        thickness,
        ..Tsv::default()
    }
    .build()
}

fn practical_tsv(thickness: f64, hole: f64) -> Body {
    PracticalTsv {
        order: 24,
        radius: 1.0,
        hole,
        thickness,
        layers: 6,
        height: 1.0,
        tessellation: Tessellation::Symmetric,
    }
    .build()
}

fn gear(order: u32, bore: f64) -> Body {
    Gear {
        order,
        bore,
        height: 0.4,
        tessellation: Tessellation::Asymmetric,
        ..Gear::default()
    }
    .build()
}

pub fn ratchet(order: u32, bore: f64) -> Body {
    Ratchet {
        order,
        bore,
        height: 0.4,
        ..Ratchet::default()
    }
    .build()
}

fn impeller(order: u32, bore: f64) -> Body {
    Impeller {
        order,
        bore,
        twist: 0.4,
        layers: 4,
        ..Impeller::default()
    }
    .build()
}

pub fn placed(mut body: Body, seed: u64, scale: f64) -> Body {
    let placement = Placement {
        rotate: Some(seed),
        scale,
        ..Placement::default()
    };
    placement.apply(&mut body);
    body
}

/// Runs the body as it is, under random placements, and very small and very large.
fn everywhere(name: &str, body: impl Fn() -> Body, seeds: &[u64], encodings: &[Encoding]) {
    for &encoding in encodings {
        mesh_and_check(name, &body(), encoding, &MESH);
        for &seed in seeds {
            let name = format!("{name}, placement {seed}, {encoding:?}");
            mesh_and_check(&name, &placed(body(), seed, 1.0), encoding, &MESH);
        }
        for scale in [1e-6, 1e6] {
            let name = format!("{name}, scale {scale:e}, {encoding:?}");
            mesh_and_check(&name, &placed(body(), 99, scale), encoding, &MESH);
        }
    }
}

const SEEDS: [u64; 5] = [1, 2, 3, 4, 5];

#[test]
fn prisms() {
    for order in [3, 4, 5, 16] {
        let name = format!("prism {order}");
        let body = || prism(order, Tessellation::Asymmetric);
        everywhere(&name, body, &SEEDS, &[EXACT_STL, Encoding::StlBinary]);
    }
    for order in [7, 64, 128] {
        let name = format!("prism {order}");
        mesh_and_check(
            &name,
            &prism(order, Tessellation::Symmetric),
            EXACT_STL,
            &MESH,
        );
    }
}

#[test]
fn coated_rings() {
    for (order, thickness) in [(3, 5e-2), (12, 2e-2), (32, 2e-2)] {
        let name = format!("ring {order}");
        everywhere(&name, || ring(order, thickness), &SEEDS, &[EXACT_STL]);
    }
    mesh_wedge("ring 64", &placed(ring(64, 5e-3), 1, 1.0), EXACT_STL, &MESH);
}

#[test]
fn filled_vias() {
    for (order, thickness) in [(4, 5e-2), (16, 2e-2)] {
        let name = format!("tsv {order}");
        everywhere(&name, || tsv(order, thickness), &SEEDS, &[EXACT_STL]);
    }
    for (order, thickness) in [(16, 5e-3), (128, 5e-3)] {
        let name = format!("tsv {order}");
        mesh_wedge(
            &name,
            &placed(tsv(order, thickness), 1, 1.0),
            EXACT_STL,
            &MESH,
        );
    }
}

#[test]
fn the_open_via_with_six_films() {
    for (thickness, hole) in [(1e-2, 0.1), (7e-4, 0.01)] {
        let name = format!("practical tsv {thickness}");
        let body = placed(practical_tsv(thickness, hole), 5, 1.0);
        mesh_wedge(&name, &body, EXACT_STL, &MESH);
    }
}

#[test]
fn gears() {
    for bore in [0.0, 0.3] {
        let name = format!("gear 12 with bore {bore}");
        let encodings = [EXACT_STL, Encoding::StlBinary];
        everywhere(&name, || gear(12, bore), &SEEDS, &encodings);
    }
}

#[test]
fn ratchets() {
    for (order, bore) in [(12, 0.3), (12, 0.0), (7, 0.3), (7, 0.0)] {
        let name = format!("ratchet {order} with bore {bore}");
        let encodings = [EXACT_STL, Encoding::StlBinary];
        everywhere(&name, || ratchet(order, bore), &SEEDS, &encodings);
    }
}

#[test]
fn impellers() {
    for (order, bore) in [(7, 0.0), (5, 0.3)] {
        let name = format!("impeller {order} with bore {bore}");
        let encodings = [EXACT_STL, Encoding::StlBinary];
        everywhere(&name, || impeller(order, bore), &SEEDS, &encodings);
    }
}

/// Quality, size limits, and the four-stage pipe as people type it.
#[test]
fn element_limits_hold_per_region() {
    let stages: [&[&str]; 3] = [
        &["symdetect", "-q"],
        &["wedgecut", "-q"],
        &[
            "tetwedge",
            "-q",
            "--max-volume",
            "0.01",
            "--region",
            "liner:max-volume=1e-5",
        ],
    ];
    let wedge = mesh_and_check("limits", &tsv(16, 1e-2), EXACT_STL, &stages);
    let document = tmesh::read(wedge.as_slice()).expect("valid");
    let liner = document.regions.iter().find(|r| r.name == "liner");
    let liner = liner.expect("a region called liner").id;
    for template in &document.templates {
        for tet in &template.tets {
            let [a, b, c, d] = tet.vertices.map(|v| template.vertices[v as usize]);
            let volume = (b - a).cross(c - a).dot(d - a) / 6.0;
            let limit = if tet.region == liner { 1e-5 } else { 0.01 };
            assert!(volume > 0.0 && volume <= limit * (1.0 + 1e-9));
        }
    }
}

#[test]
fn any_divisor_of_the_order_will_do() {
    let body = placed(gear(12, 0.3), 4, 1.0);
    for (domain, order, copies) in [
        ("mirror", "12", 24),
        ("mirror", "6", 12),
        ("mirror", "3", 6),
        ("rotation", "12", 12),
        ("rotation", "4", 4),
    ] {
        let stages: [&[&str]; 4] = [
            MESH[0],
            &[
                "wedgecut",
                "-q",
                "--horizontal-mirror",
                "off",
                "--domain",
                domain,
                "--order",
                order,
            ],
            MESH[2],
            MESH[3],
        ];
        let input = encode(&body, EXACT_STL);
        let outcomes = pipe(&stages, &input);
        for outcome in &outcomes {
            assert_eq!(outcome.code, 0, "{domain} {order}: {}", outcome.stderr);
        }
        let document = tmesh::read(outcomes[3].stdout.as_slice()).expect("valid");
        assert_eq!(document.instances.len(), copies, "{domain} {order}");
        let report = run("meshqual", &["--check", "--json", "-"], &outcomes[3].stdout);
        let report = json(&report.success());
        let volume = report["volume"].as_f64().expect("a number");
        assert!((volume / body.total_volume() - 1.0).abs() < 1e-9);
    }
}

/// The same input and options give the same bytes, whatever the machine is doing.
#[test]
fn the_same_bytes_every_time() {
    for body in [
        placed(tsv(8, 1e-2), 3, 1.0),
        placed(ratchet(7, 0.3), 3, 1.0),
    ] {
        let stages = [MESH.as_slice(), &[&["rotassemble", "-q"]]].concat();
        let input = encode(&body, EXACT_STL);
        let runs = [(); 2].map(|()| {
            let outcomes = pipe(&stages, &input);
            outcomes.into_iter().last().expect("stages").success()
        });
        assert!(!runs[0].is_empty());
        assert!(runs[0] == runs[1]);
    }
}

/// OBJ groups and the document itself carry the same body as STL.
#[test]
fn other_encodings_of_the_same_body() {
    let body = placed(tsv(8, 1e-2), 6, 1.0);
    for encoding in [Encoding::Obj, Encoding::Tmesh] {
        mesh_and_check(&format!("{encoding:?}"), &body, encoding, &MESH);
    }
    // A .poly file has numbers for names.
    let mut numbered = body;
    for (index, material) in numbered.materials.iter_mut().enumerate() {
        material.name = (index + 1).to_string();
    }
    mesh_and_check("poly", &numbered, Encoding::Poly, &MESH);
    let body = cube(2.0, Tessellation::Asymmetric);
    mesh_and_check("cube", &body, Encoding::Tmesh, &MESH);
}
