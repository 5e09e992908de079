//! What other programs read from the mesh files: counts, volumes, names, markers, couplings.
//!
//! `make test` installs meshio, VTK and Gmsh into the folder that REFEREE names, and CalculiX. Without
//! them these tests check nothing and say so.

mod boundary;
mod calculix;
mod heat;
mod poisson;
mod referee;
mod second_reader;
mod solvers;
mod sweep;
mod tools;

use bodies::{Encoding, Impeller, Placement, Tsv};
use referee::{Job, close, read};
use serde_json::Value;
use std::path::Path;
use support::{EXACT_STL, encode};
use tools::{mesh, rotassemble};

/// A via of three materials, placed anyhow.
fn via() -> bodies::Body {
    let mut body = Tsv {
        order: 8,
        core: 0.3,
        thickness: 5e-2,
        ..Tsv::default()
    }
    .build();
    let placement = Placement {
        rotate: Some(11),
        scale: 10.0,
        ..Placement::default()
    };
    placement.apply(&mut body);
    body
}

/// Angle of the blades of such an impeller over its height of one, radians.
const TWIST: f64 = 0.8;

/// An impeller whose blades turn so far that a seam between them is no plane.
fn twisted_impeller(order: u32) -> bodies::Body {
    Impeller {
        order,
        bore: 0.2,
        height: 1.0,
        twist: TWIST,
        layers: 4,
        ..Impeller::default()
    }
    .build()
}

/// How the wedge of such an impeller is cut.
const BETWEEN_BLADES: [&str; 4] = ["--hub", "none", "--seam", "auto"];

/// The largest distance of the points of a seam's low face from the plane through the axis where they are
/// seen from the axis on average.
fn off_plane(document: &tmesh::Document) -> f64 {
    let template = &document.templates[0];
    let seam = template.gluings.iter().find(|g| g.is_seam(0));
    let low: Vec<glam::DVec2> = seam
        .expect("a seam")
        .vertex_pairs
        .iter()
        .map(|&[_, there]| template.vertices[there as usize].truncate())
        .collect();
    let mean = low
        .iter()
        .map(|p| p.normalize_or_zero())
        .sum::<glam::DVec2>();
    let mean = mean.normalize();
    let off = low.iter().map(|p| mean.perp_dot(*p).abs());
    off.fold(0.0, f64::max)
}

fn write(folder: &Path, name: &str, input: &Path, options: &[&str]) -> String {
    let path = folder.join(name).to_str().expect("text").to_owned();
    let output = [&["-o", path.as_str()], options].concat();
    rotassemble(input, &output);
    path
}

#[test]
fn every_reader_finds_the_same_mesh_in_every_format() {
    if !referee::is_there() {
        return;
    }
    let body = via();
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let cut = ["--order", "8", "--hub", "none"];
    let input = mesh(folder, &encode(&body, EXACT_STL), &cut);
    let document = tmesh::read(std::fs::read(&input).expect("a file").as_slice()).expect("valid");
    let tets: usize = document.templates.iter().map(|t| t.tets.len()).sum();
    let tets = tets * document.instances.len();
    let boundary = &["--boundary"];
    let ascii = &["--ascii"];
    let files = [
        ("a.msh", &[][..], "gmsh msh, meshio msh"),
        ("b.msh", ascii, "gmsh msh, meshio msh"),
        ("c.msh2", &[], "meshio msh2"),
        ("d.msh2", ascii, "meshio msh2"),
        ("e.mesh", &[], "gmsh mesh, meshio mesh"),
        ("f.inp", &[], "manual inp, meshio inp"),
        ("g.node", &[], "meshio node"),
        ("m.bdf", &[], "meshio bdf"),
        ("h.vtk", boundary, "vtk vtk, meshio vtk"),
        ("i.vtu", boundary, "vtk vtu, meshio vtu"),
        (
            "j.vtu",
            &["--boundary", "--compress"],
            "vtk vtu, meshio vtu",
        ),
        ("k.pvtu", boundary, "vtk pvtu"),
        ("l.pvtu", &["--compress"], "ranks pvtu"),
    ];
    let mut jobs: Vec<Job> = Vec::new();
    for (name, options, readers) in files {
        let path = write(folder, name, &input, options);
        for reader in readers.split(", ") {
            let (reader, kind) = reader.split_once(' ').expect("two words");
            jobs.push(Job::new(reader, kind, &path));
        }
    }
    let found = read(&jobs);
    let first = &found[0];
    assert_eq!(first["tetrahedra"], tets);
    for (job, result) in jobs.iter().zip(&found) {
        let what = job.to_string();
        for key in ["points", "tetrahedra"] {
            assert_eq!(result[key], first[key], "{what}: {key}");
        }
        assert!(result["least"].as_f64() > Some(0.0), "{what}");
        for (index, material) in body.materials.iter().enumerate() {
            let region = document.regions.iter().find(|r| r.name == material.name);
            let id = region.expect("regions keep their names").id.to_string();
            let volumes = result["volumes"].as_object().expect("volumes");
            let volume = volumes.get(&id).or_else(|| volumes.get(&material.name));
            let volume = volume.unwrap_or_else(|| panic!("{what}: {result}"));
            close(volume, body.volume(index), 1e-9, &what);
        }
        // Some readers leave triangles out, or mix names of surfaces and volumes up.
        for marker in &document.markers {
            let expected = first["areas"][&marker.name].as_f64().expect("an area");
            close(
                &expected.into(),
                marker.area.expect("an area"),
                1e-6,
                &marker.name,
            );
            let areas = result["areas"].as_object().expect("areas");
            let name = marker.name.replace('/', "_");
            let names = [&marker.name, &name, &marker.id.to_string()];
            let area = names.iter().find_map(|n| areas.get(n.as_str()));
            let complete = matches!(job.reader, "gmsh" | "manual")
                || (job.reader == "vtk" && result["triangles"] != 0);
            match area {
                Some(area) => close(area, expected, 1e-12, &what),
                None if complete => panic!("{what}: no {}", marker.name),
                None => {}
            }
        }
    }
    let ranks = found.last().expect("the last one");
    assert_eq!(
        ranks["boundary_faces"],
        found[found.len() - 2]["boundary_faces"]
    );
    let shares: Vec<u64> = ranks["shares"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(Value::as_u64)
        .collect();
    assert_eq!(shares, [tets as u64 / 4; 4]);
}

#[test]
fn gmsh_reads_the_couplings_of_a_sector() {
    if !referee::is_there() {
        return;
    }
    let body = via();
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let cut = ["--domain", "rotation", "--order", "8", "--hub", "none"];
    let cut = [&cut[..], &["--horizontal-mirror", "off"]].concat();
    let input = mesh(folder, &encode(&body, EXACT_STL), &cut);
    let document = tmesh::read(std::fs::read(&input).expect("a file").as_slice()).expect("valid");
    let table = folder.join("pairs.json");
    let table = table.to_str().expect("text");
    for (name, options) in [
        ("a.msh", &["--pairs", table][..]),
        ("b.msh", &["--ascii"]),
        ("c.msh", &["--second-order"]),
    ] {
        let second = options.contains(&"--second-order");
        let path = write(folder, name, &input, &[&["--sector"], options].concat());
        let found = &read(&[Job::new("gmsh", "msh", &path)])[0];
        let periodic = found["periodic"].as_array().expect("a list");
        assert_eq!(periodic.len(), 1, "{found}");
        let link = &periodic[0];
        assert_eq!(
            (&link["master"], &link["dependent"]),
            (&"wall-a".into(), &"wall-b".into())
        );
        let size = found["size"].as_f64().expect("a size");
        assert!(link["error"].as_f64() < Some(1e-12 * size), "{link}");
        let seam = &document.templates[0].gluings[0];
        assert!(seam.is_seam(0));
        if !second {
            assert_eq!(link["pairs"], seam.vertex_pairs.len());
        } else {
            // By Euler's formula a disk of v vertices and t triangles has v + t - 1 edges.
            let edges = seam.vertex_pairs.len() + seam.triangle_pairs.len() - 1;
            assert_eq!(link["pairs"], seam.vertex_pairs.len() + edges);
        }
        let axis = document.templates[0].axis.len() - 1;
        assert_eq!(found["axis_edges"], if second { 2 * axis } else { axis });
        close(
            &found["areas"]["wall-a"],
            found["areas"]["wall-b"].as_f64().unwrap(),
            1e-12,
            name,
        );
        let total: f64 = (0..3).map(|i| body.volume(i)).sum();
        let volumes = found["volumes"].as_object().expect("volumes");
        let sum: f64 = volumes.values().filter_map(Value::as_f64).sum();
        assert!((8.0 * sum / total - 1.0).abs() < 1e-9);
    }
    let table: Value =
        serde_json::from_slice(&std::fs::read(table).expect("a file")).expect("JSON");
    let coupling = &table["couplings"][0];
    assert_eq!(
        (&table["first_id"], &coupling["sectors"]),
        (&1.into(), &8.into())
    );
    assert!(coupling["max_residual"].as_f64() < Some(1e-13));
    let nodes = coupling["nodes"].as_array().expect("pairs");
    let on_axis = nodes.iter().filter(|p| p[0] == p[1]).count();
    assert_eq!(on_axis, document.templates[0].axis.len());
    assert_eq!(table["axis"].as_array().expect("a list").len(), on_axis);
}

#[test]
fn gmsh_reads_the_couplings_of_a_curved_seam() {
    if !referee::is_there() {
        return;
    }
    let body = twisted_impeller(7);
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let input = mesh(folder, &encode(&body, EXACT_STL), &BETWEEN_BLADES);
    let document = tmesh::read(std::fs::read(&input).expect("a file").as_slice()).expect("valid");
    let off = off_plane(&document);
    assert!(off > 0.05, "{off}");
    let seam = &document.templates[0].gluings[0];
    assert!(seam.is_seam(0));
    let [first, bent] = ["a.msh", "c.msh"];
    for (name, options) in [
        (first, &["--sector"][..]),
        ("b.msh", &["--sector", "--second-order", "--straight-edges"]),
        (bent, &["--sector", "--second-order"]),
    ] {
        let path = write(folder, name, &input, options);
        let found = &read(&[Job::new("gmsh", "msh", &path)])[0];
        let periodic = found["periodic"].as_array().expect("a list");
        assert_eq!(periodic.len(), 1, "{found}");
        let link = &periodic[0];
        assert_eq!(
            (&link["master"], &link["dependent"]),
            (&"wall-a".into(), &"wall-b".into())
        );
        let size = found["size"].as_f64().expect("a size");
        assert!(link["error"].as_f64() < Some(1e-12 * size), "{link}");
        if name == first {
            assert_eq!(link["pairs"], seam.vertex_pairs.len());
        } else {
            assert!(link["pairs"].as_u64() > Some(seam.vertex_pairs.len() as u64));
        }
        close(
            &found["areas"]["wall-a"],
            found["areas"]["wall-b"].as_f64().expect("an area"),
            1e-12,
            name,
        );
        // On the shape behind the facets there is a little more or less than between these.
        if name != bent {
            let seventh = body.volume(0) / 7.0;
            close(&found["volumes"]["body"], seventh, 1e-6, name);
        }
    }
}

#[test]
fn a_hub_of_the_same_order_is_part_of_the_sector() {
    if !referee::is_there() {
        return;
    }
    let body = Impeller {
        order: 5,
        height: 1.0,
        twist: 0.4,
        layers: 3,
        ..Impeller::default()
    }
    .build();
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let cut = ["--hub", "0.15", "--order", "5"];
    let input = mesh(folder, &encode(&body, Encoding::Obj), &cut);
    let document = tmesh::read(std::fs::read(&input).expect("a file").as_slice()).expect("valid");
    assert_eq!(document.templates.len(), 2);
    let whole = write(folder, "whole.msh", &input, &[]);
    let sector = write(folder, "sector.msh", &input, &["--sector"]);
    let deck = write(folder, "sector.inp", &input, &["--sector"]);
    let found = read(&[
        Job::new("gmsh", "msh", &whole),
        Job::new("gmsh", "msh", &sector),
        Job::new("manual", "inp", &deck),
    ]);
    let volume = |i: usize| found[i]["volumes"]["body"].as_f64().expect("a volume");
    close(&volume(0).into(), body.volume(0), 1e-9, "the whole");
    close(&volume(1).into(), body.volume(0) / 5.0, 1e-9, "the sector");
    let periodic = found[1]["periodic"].as_array().expect("a list");
    assert_eq!(periodic.len(), 1, "{periodic:?}");
    // Wedge and hub are welded: the points on both are there once, and coupled once.
    let points: usize = document.templates.iter().map(|t| t.vertices.len()).sum();
    assert!(found[1]["points"].as_u64() < Some(points as u64));
    let model = &found[2]["model"];
    assert_eq!(model["sectors"], 5);
    assert_eq!(found[2]["points"], found[1]["points"]);
}
