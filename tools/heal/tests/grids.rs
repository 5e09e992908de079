//! VTK files: those written here, and those of other programs.

mod common;

use common::*;
use glam::DVec3;
use interchange::Format::{self, Vtk, Vtu};
use interchange::{promise_title, sniff, write_document};
use tmesh::{Axis, Document, Group, Kind, OUTSIDE, Outside, Promise, RegionMap, Source, Symmetry};

/// Two tetrahedra of different regions, with surface and interface.
fn two_tets() -> Document {
    common::two_tets(
        DVec3::new(0.1, 0.2, -0.7),
        [
            ([0, 1, 3], 2, OUTSIDE, 0),
            ([1, 2, 3], 2, OUTSIDE, 0),
            ([0, 3, 2], 2, OUTSIDE, 0),
            ([0, 1, 2], 5, 0, 7),
            ([0, 4, 1], 2, OUTSIDE, 7),
            ([1, 4, 2], 2, OUTSIDE, 7),
            ([2, 4, 0], 2, OUTSIDE, 7),
        ],
        [([0, 1, 2, 3], 0), ([0, 2, 1, 4], 7)],
        [
            [(0, "silicon"), (7, "copper alloy")],
            [(2, "outer"), (5, "bond")],
        ],
    )
}

fn written(document: &Document, format: Format) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_document(document, format, &mut bytes).unwrap();
    bytes
}

#[test]
fn meshes_round_trip() {
    let document = two_tets();
    assert_eq!(tmesh::validate(&document), []);
    for format in [Vtk, Vtu] {
        let bytes = written(&document, format);
        assert_eq!(sniff(&bytes, None), Some(format));
        let back = good(&bytes, format).document;
        assert_eq!(back.templates, document.templates);
        assert_eq!(back.regions, document.regions);
        assert_eq!(back.markers, document.markers);
        assert_eq!(back.symmetry, None);
    }
}

#[test]
fn surfaces_round_trip() {
    let mut document = two_tets();
    document.templates[0].tets.clear();
    for format in [Vtk, Vtu] {
        let imported = good(&written(&document, format), format);
        assert_eq!(imported.document.templates, document.templates);
        let volumes = [(0, "silicon", 1.0 / 6.0), (7, "copper alloy", 0.7 / 6.0)];
        let volumes = volumes.map(|(id, name, v)| (id, name, round(v)));
        assert_eq!(regions(&imported), volumes);
        assert!(imported.document.source.is_some());
    }
}

/// A surface with an axis through its tip; the numbers are such that few digits do not hold them.
fn with_symmetry() -> Document {
    let mut document = two_tets();
    document.templates[0].tets.clear();
    let radius = 0.61_f64.sqrt();
    document.symmetry = Some(Symmetry {
        group: Group::new(Kind::Cv, 1),
        axis: Axis {
            point: [0.1 + 0.2, 1.0 / 3.0, 1e-300],
            direction: [0.0, 0.0, 1.0],
        },
        reference: [0.8, 0.6, 0.0],
        residual: 1.0 / 7e9,
        tolerance: 1e-3,
        axisymmetric: false,
        radius,
        regions: vec![RegionMap {
            pairs: vec![[0, 7], [7, 0]],
        }],
    });
    let symmetry = document.symmetry.as_mut().unwrap();
    let origin = DVec3::from_array(symmetry.axis.point);
    let distances = document.templates[0].vertices.iter();
    let distances = distances.map(|p| (*p - origin).truncate().length());
    symmetry.radius = distances.fold(0.0, f64::max);
    document.source = Some(Source {
        sector_of: None,
        format: "stl".to_owned(),
        triangles: 7,
        volume: 1.7 / 6.0,
        boundary_area: 1.0,
        precision: 1.0 / 3e7,
    });
    document
}

#[test]
fn the_symmetry_of_a_surface_comes_back() {
    let document = with_symmetry();
    assert_eq!(tmesh::validate(&document), []);
    for format in [Vtk, Vtu] {
        let back = good(&written(&document, format), format);
        assert_eq!(back.notices, Vec::<String>::new());
        assert_eq!(back.document.symmetry, document.symmetry);
        // The surface is known no better than in the file that it came from.
        let precision = |d: &Document| d.source.as_ref().map(|s| s.precision);
        assert_eq!(precision(&back.document), precision(&document));
    }
}

/// Other programs move, scale and cut meshes and leave the symmetry beside them as it was.
#[test]
fn the_symmetry_of_a_surface_that_was_changed_is_ignored() {
    let unchanged = with_symmetry();
    let moved = |motion: fn(DVec3) -> DVec3| {
        let mut document = unchanged.clone();
        let vertices = &mut document.templates[0].vertices;
        vertices.iter_mut().for_each(|p| *p = motion(*p));
        document
    };
    let mut more = unchanged.clone();
    let symmetry = more.symmetry.as_mut().unwrap();
    symmetry.regions.push(symmetry.regions[0].clone());
    let mut bent = unchanged.clone();
    bent.symmetry.as_mut().unwrap().reference = [0.0, 0.6, 0.8];
    for (document, part) in [
        (moved(|p| 1.01 * p), "the surface has been changed since"),
        (
            moved(|p| p + DVec3::X),
            "the surface has been changed since",
        ),
        (more, "C1v"),
        (bent, "symmetry"),
    ] {
        for format in [Vtk, Vtu] {
            let back = good(&written(&document, format), format);
            assert_eq!(back.document.symmetry, None, "{part}");
            let [notice] = &back.notices[..] else {
                panic!("{:?}", back.notices)
            };
            assert!(notice.contains("symdetect can find it anew"), "{notice}");
            assert!(notice.contains(part), "{notice}");
        }
    }
    let broken = written(&unchanged, Vtk);
    let broken = replaced(&broken, b"{\"group\":", b"{\"grupp\":");
    let back = good(&broken, Vtk);
    assert_eq!(back.document.symmetry, None);
    assert_eq!(
        back.notices,
        ["its array 'symmetry' is not as expected: ignored"]
    );
}

/// Names are words of other formats, and parts of tags.
#[test]
fn names_of_all_letters_come_back() {
    let mut document = two_tets();
    let names = ["50 % \"Kupfer\" & <Öl>", "a=b;c'd/%41"];
    for (region, name) in document.regions.iter_mut().zip(names) {
        region.name = name.to_owned();
    }
    document.markers[0].name = "METADATA".to_owned();
    document.markers[1].name = "POINTS 4 double".to_owned();
    for format in [Vtk, Vtu] {
        let back = good(&written(&document, format), format).document;
        assert_eq!(back.regions, document.regions);
        assert_eq!(back.markers, document.markers);
    }
}

#[test]
fn the_promise_comes_back() {
    let promise = Promise {
        group: Group::new(Kind::Cv, 12),
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        origin: [1.0, 2.0, 3.0],
        outside: Some(Outside {
            group: Group::new(Kind::Cv, 48),
            radius: 0.7,
        }),
    };
    let title = promise_title(&promise);
    for format in [Vtk, Vtu] {
        let text = written(&two_tets(), format);
        // The title of a mesh that promises nothing, replaced by hand.
        let bytes = match format {
            Vtk => replaced(&text, b"symtet mesh", title.as_bytes()),
            _ => {
                let codes = |t: &str| {
                    let list: Vec<String> = t.bytes().map(|b| b.to_string()).collect();
                    format!(">{}<", list.join(" "))
                };
                replaced(
                    &text,
                    codes("symtet mesh").as_bytes(),
                    codes(&title).as_bytes(),
                )
            }
        };
        let back = good(&bytes, format).document.promise;
        assert_eq!(back, Some(promise.clone()));
    }
}

fn replaced(bytes: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let at = bytes
        .windows(from.len())
        .position(|w| w == from)
        .expect("is there");
    [&bytes[..at], to, &bytes[at + from.len()..]].concat()
}

const ASCII: &str = "# vtk DataFile Version 4.2\nby hand\nASCII\nDATASET UNSTRUCTURED_GRID\n\
    POINTS 5 float\n0 0 0 1 0 0 0 1 0\n0 0 1 0 0 -1\nMETADATA\nINFORMATION 0\n\n\
    CELLS 3 12\n4 0 1 2 3\n4 0 2 1 4\n1 0\nCELL_TYPES 3\n10 10 1\nPOINT_DATA 5\nSCALARS t double\n\
    LOOKUP_TABLE default\n1 2 3 4 nan\nVECTORS v float\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n\
    CELL_DATA 3\nFIELD FieldData 2\nother 2 3 int\n1 2 3 4 5 6\nregion 1 3 int\n3 4 0\n";

#[test]
fn ascii_files_of_others() {
    assert_eq!(sniff(ASCII.as_bytes(), None), Some(Vtk));
    let imported = good(ASCII.as_bytes(), Vtk);
    let template = &imported.document.templates[0];
    let tets: Vec<u32> = template.tets.iter().map(|t| t.region).collect();
    assert_eq!(tets, [3, 4]);
    assert_eq!(imported.document.regions[1].name, "region4");
    assert_eq!(imported.notices, ["1 cell that is no tetrahedron ignored"]);
    let version5 = ASCII.replace(
        "CELLS 3 12\n4 0 1 2 3\n4 0 2 1 4\n1 0\n",
        "CELLS 4 9\nOFFSETS vtktypeint64\n0 4 8 9\nCONNECTIVITY vtktypeint64\n0 1 2 3 0 2 1 4 0\n",
    );
    let same = good(version5.as_bytes(), Vtk);
    assert_eq!(same.document.templates, imported.document.templates);
    let polydata = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n\
                    0 0 0 1 0 0 0 1 0 0 0 1\nPOLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    let surface = good(polydata.as_bytes(), Vtk);
    assert_eq!(regions(&surface), [(1, "region1", round(1.0 / 6.0))]);
    let xml = "<?xml version='1.0'?>\n<VTKFile type=\"UnstructuredGrid\" byte_order='LittleEndian'>\
               <UnstructuredGrid><Piece NumberOfPoints='4' NumberOfCells='1'><Points>\
               <DataArray type='Float32' NumberOfComponents='3' format='ascii'>\
               0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>\
               <DataArray type='Int32' Name='connectivity' format='binary'>\
               EAAAAA==AAAAAAEAAAACAAAAAwAAAA==</DataArray>\
               <DataArray type='Int32' Name='offsets'>4</DataArray>\
               <DataArray type='UInt8' Name='types' format='ascii'>10</DataArray>\
               </Cells></Piece></UnstructuredGrid></VTKFile>";
    assert_eq!(sniff(xml.as_bytes(), None), Some(Vtu));
    let imported = good(xml.as_bytes(), Vtu);
    assert_eq!(
        imported.document.templates[0].tets[0].vertices,
        [0, 1, 2, 3]
    );
}

#[test]
fn files_without_cells_are_refused() {
    let array = |kind: &str, name: &str| format!("<DataArray type='{kind}' Name='{name}'/>");
    let cells: String = [
        ("Int32", "connectivity"),
        ("Int32", "offsets"),
        ("UInt8", "types"),
    ]
    .map(|(kind, name)| array(kind, name))
    .concat();
    let points = "<DataArray type='Float32' NumberOfComponents='3'/>";
    for sides in [
        String::new(),
        array("Int32", "front") + &array("Int32", "back"),
    ] {
        let xml = format!(
            "<?xml version='1.0'?>\n<VTKFile type='UnstructuredGrid' byte_order='LittleEndian'>\
             <UnstructuredGrid><Piece NumberOfPoints='0' NumberOfCells='0'><Points>{points}</Points>\
             <Cells>{cells}</Cells><CellData>{sides}</CellData></Piece></UnstructuredGrid></VTKFile>"
        );
        let message = refused(xml.as_bytes(), Vtu);
        assert!(message.contains("triangles"), "{message}");
    }
}

#[test]
fn faults_are_located() {
    let fault = |from: &str, to: &str| refused(ASCII.replacen(from, to, 1).as_bytes(), Vtk);
    assert_eq!(
        fault("4 0 1 2 3", "4 0 1 2 5"),
        "vtk: cell 0 names point 5, and there are 5"
    );
    assert!(fault("4 0 1 2 3", "4 0 1 2 2").contains("cell 0 of type 10 names a point twice"));
    assert!(fault("4 0 1 2 3", "3 0 1 2 3").contains("vtk"));
    assert!(fault("0 0 1 0 0 -1", "0 0 1 0 nan -1").contains("point 4 is (0, NaN, -1)"));
    assert!(fault("10 10 1", "10 12 1").contains("cell 1 has the type 12"));
    assert!(fault("CELL_TYPES 3\n10 10 1", "CELL_TYPES 2\n10 10").contains("3 cells have 2 types"));
    assert!(fault("POINTS 5", "POINTS 5000000000").contains("and"));
    assert!(fault("UNSTRUCTURED_GRID", "STRUCTURED_POINTS").contains("only UNSTRUCTURED_GRID"));
    assert!(fault("3 4 0", "-1 4 0").contains("cell 0 is a tetrahedron with region -1"));
    let binary = written(&two_tets(), Vtk);
    let cut = refused(&binary[..binary.len() / 2], Vtk);
    assert!(cut.contains("bytes, and"), "{cut}");
}
