//! The mesh files as other programs read them: meshio and VTK's own reader.
//!
//! `make test` installs both into the folder that REFEREE names. Without them these tests check
//! nothing and say so.

use bodies::{Placement, Tsv};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;
use support::{EXACT_STL, binary, encode, pipe};

/// Reads a file with both libraries and prints points, tetrahedra, and volume per region as JSON.
const SCRIPT: &str = r#"
import json, sys
import meshio, numpy, vtk
from vtk.util.numpy_support import vtk_to_numpy

def measure(points, tets, region):
    corners = points[tets]
    a, b, c, d = (corners[:, i] for i in range(4))
    volumes = numpy.einsum('ij,ij->i', numpy.cross(b - a, c - a), d - a) / 6
    return {
        'points': len(points),
        'tetrahedra': len(tets),
        'least': float(volumes.min()),
        'regions': {str(r): float(volumes[region == r].sum()) for r in numpy.unique(region)},
    }

path = sys.argv[1]
mesh = meshio.read(path)
blocks = [(i, c.data) for i, c in enumerate(mesh.cells) if c.type == 'tetra']
first = measure(
    mesh.points,
    numpy.concatenate([data for _, data in blocks]),
    numpy.concatenate([mesh.cell_data['region'][i] for i, _ in blocks]).ravel(),
)

reader = vtk.vtkXMLUnstructuredGridReader() if path.endswith('.vtu') else vtk.vtkUnstructuredGridReader()
if path.endswith('.vtk'):
    reader.ReadAllScalarsOn()
reader.SetFileName(path)
reader.Update()
grid = reader.GetOutput()
types = {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}
assert types == {vtk.VTK_TETRA}, types
second = measure(
    vtk_to_numpy(grid.GetPoints().GetData()).astype(float),
    vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4),
    vtk_to_numpy(grid.GetCellData().GetArray('region')),
)
json.dump([first, second], sys.stdout)
"#;

/// Python of the referee's environment, or `None` with a message.
fn python() -> Option<PathBuf> {
    let Some(folder) = std::env::var_os("REFEREE") else {
        println!(
            "skipped: REFEREE does not name an environment with meshio and vtk; run make test"
        );
        return None;
    };
    let python = Path::new(&folder).join("bin/python");
    let check = Command::new(&python)
        .args(["-c", "import meshio, vtk"])
        .output();
    match check {
        Ok(output) if output.status.success() => Some(python),
        Ok(output) => {
            let text = String::from_utf8_lossy(&output.stderr).into_owned();
            println!("skipped: {}", text.lines().last().unwrap_or_default());
            None
        }
        Err(error) => {
            println!("skipped: {}: {error}", python.display());
            None
        }
    }
}

#[test]
fn meshio_and_vtk_read_what_was_meshed() {
    let Some(python) = python() else { return };
    let mut body = Tsv {
        order: 8,
        core: 0.3,
        thickness: 1e-2,
        ..Tsv::default()
    }
    .build();
    let placement = Placement {
        rotate: Some(11),
        scale: 10.0,
        ..Placement::default()
    };
    placement.apply(&mut body);
    let stages: [&[&str]; 3] = [
        &["symdetect", "-q"],
        &["wedgecut", "-q"],
        &["tetwedge", "-q"],
    ];
    let outcomes = pipe(&stages, &encode(&body, EXACT_STL));
    let wedge = outcomes.into_iter().last().expect("stages").success();
    let document = tmesh::read(wedge.as_slice()).expect("valid");
    let placed = document.instances.iter().map(|i| i.template as usize);
    let tets: usize = placed.map(|t| document.templates[t].tets.len()).sum();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let input = folder.path().join("wedge.tmesh");
    std::fs::write(&input, &wedge).expect("a file");
    for extension in ["vtk", "vtu"] {
        let file = folder.path().join(format!("mesh.{extension}"));
        let status = Command::new(binary("rotassemble"))
            .arg(&input)
            .arg("-o")
            .arg(&file)
            .status();
        assert!(status.expect("it runs").success());
        let output = Command::new(&python)
            .args(["-c", SCRIPT])
            .arg(&file)
            .output();
        let output = output.expect("Python runs");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{extension}: {errors}");
        let read: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        for (reader, found) in ["meshio", "vtk"].iter().zip(read.as_array().expect("two")) {
            assert_eq!(found["tetrahedra"], tets, "{reader} on {extension}");
            assert!(
                found["least"].as_f64() > Some(0.0),
                "{reader} on {extension}"
            );
            for (index, material) in body.materials.iter().enumerate() {
                let region = document.regions.iter().find(|r| r.name == material.name);
                let id = region.expect("regions keep their names").id.to_string();
                let volume = found["regions"][&id].as_f64().expect("a volume");
                let error = (volume / body.volume(index) - 1.0).abs();
                assert!(
                    error < 1e-9,
                    "{reader} on {extension}: {}: {error:e}",
                    material.name
                );
            }
        }
        assert_eq!(read[0]["points"], read[1]["points"]);
    }
}
