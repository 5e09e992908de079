//! Size fields as files.

use glam::DVec3;
use std::fmt::Write as _;

/// A mesh with a length at each point.
pub struct Field {
    /// Points.
    pub points: Vec<DVec3>,
    /// Tetrahedra.
    pub tets: Vec<[u32; 4]>,
    /// Lengths.
    pub sizes: Vec<f64>,
}

impl Field {
    /// A box between two points, `n` cells along each side, each divided into six tetrahedra.
    pub fn in_box(n: u32, low: DVec3, high: DVec3, size: impl Fn(DVec3) -> f64) -> Self {
        let at = |x: u32, y: u32, z: u32| x + (n + 1) * (y + (n + 1) * z);
        let all = |count: u32| {
            (0..count * count * count)
                .map(move |i| (i % count, i / count % count, i / count / count))
        };
        let points: Vec<DVec3> = all(n + 1)
            .map(|(x, y, z)| {
                let p = DVec3::new(f64::from(x), f64::from(y), f64::from(z)) / f64::from(n);
                low + (high - low) * p
            })
            .collect();
        let orders = [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ];
        let mut tets = Vec::new();
        for (x, y, z) in all(n) {
            for order in orders {
                let mut corner = [x, y, z];
                let mut tet = [at(x, y, z); 4];
                for (k, axis) in order.into_iter().enumerate() {
                    corner[axis] += 1;
                    tet[k + 1] = at(corner[0], corner[1], corner[2]);
                }
                tets.push(tet);
            }
        }
        Self {
            sizes: points.iter().map(|&p| size(p)).collect(),
            points,
            tets,
        }
    }

    /// Legacy VTK, as text; what follows the cells is given.
    pub fn vtk_with(&self, data: &str) -> Vec<u8> {
        let mut text =
            "# vtk DataFile Version 3.0\nfield\nASCII\nDATASET UNSTRUCTURED_GRID\n".to_owned();
        let _ = writeln!(text, "POINTS {} double", self.points.len());
        for p in &self.points {
            let _ = writeln!(text, "{:e} {:e} {:e}", p.x, p.y, p.z);
        }
        let count = self.tets.len();
        let _ = writeln!(text, "CELLS {count} {}", 5 * count);
        for [a, b, c, d] in &self.tets {
            let _ = writeln!(text, "4 {a} {b} {c} {d}");
        }
        let _ = writeln!(text, "CELL_TYPES {count}");
        text.extend((0..count).map(|_| "10\n"));
        text.push_str(data);
        text.into_bytes()
    }

    /// Legacy VTK, as text.
    pub fn vtk(&self) -> Vec<u8> {
        let count = self.points.len();
        let mut data =
            format!("POINT_DATA {count}\nSCALARS length double 1\nLOOKUP_TABLE default\n");
        for size in &self.sizes {
            let _ = writeln!(data, "{size:e}");
        }
        self.vtk_with(&data)
    }

    /// Legacy VTK, binary, the lengths as an array of a field.
    pub fn vtk_binary(&self) -> Vec<u8> {
        let mut bytes =
            b"# vtk DataFile Version 3.0\nfield\nBINARY\nDATASET UNSTRUCTURED_GRID\n".to_vec();
        let line = |bytes: &mut Vec<u8>, text: String| bytes.extend(text.into_bytes());
        let count = self.points.len();
        line(&mut bytes, format!("POINTS {count} double\n"));
        let numbers = self.points.iter().flat_map(|p| p.to_array());
        bytes.extend(numbers.flat_map(f64::to_be_bytes));
        line(
            &mut bytes,
            format!("\nCELLS {} {}\n", self.tets.len(), 5 * self.tets.len()),
        );
        for tet in &self.tets {
            bytes.extend(4_i32.to_be_bytes());
            bytes.extend(tet.iter().flat_map(|&v| (v as i32).to_be_bytes()));
        }
        line(&mut bytes, format!("\nCELL_TYPES {}\n", self.tets.len()));
        bytes.extend(self.tets.iter().flat_map(|_| 10_i32.to_be_bytes()));
        line(
            &mut bytes,
            format!("\nPOINT_DATA {count}\nFIELD FieldData 1\nlength 1 {count} double\n"),
        );
        bytes.extend(self.sizes.iter().flat_map(|s| s.to_be_bytes()));
        bytes.push(b'\n');
        bytes
    }

    /// VTK XML, as text, beside a vector.
    pub fn vtu(&self) -> Vec<u8> {
        let words = |values: &mut dyn Iterator<Item = String>| values.collect::<Vec<_>>().join(" ");
        let points = words(
            &mut self
                .points
                .iter()
                .flat_map(|p| p.to_array())
                .map(|x| format!("{x:e}")),
        );
        let cells = words(&mut self.tets.as_flattened().iter().map(u32::to_string));
        let ends = words(&mut (1..=self.tets.len()).map(|i| (4 * i).to_string()));
        let types = words(&mut self.tets.iter().map(|_| "10".to_owned()));
        let sizes = words(&mut self.sizes.iter().map(|x| format!("{x:e}")));
        let (n, m) = (self.points.len(), self.tets.len());
        format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
             <UnstructuredGrid><Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{m}\">\n\
             <PointData Scalars=\"length\">\n\
             <DataArray type=\"Float64\" Name=\"velocity\" NumberOfComponents=\"3\" format=\"ascii\">{points}</DataArray>\n\
             <DataArray type=\"Float64\" Name=\"length\" format=\"ascii\">{sizes}</DataArray></PointData>\n\
             <Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">{points}</DataArray></Points>\n\
             <Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">{cells}</DataArray>\n\
             <DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">{ends}</DataArray>\n\
             <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">{types}</DataArray></Cells>\n\
             </Piece></UnstructuredGrid></VTKFile>\n"
        )
        .into_bytes()
    }

    /// Gmsh 2.2, as text.
    pub fn msh2(&self) -> Vec<u8> {
        let mut text = format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n",
            self.points.len()
        );
        for (i, p) in (1_u32..).zip(&self.points) {
            let _ = writeln!(text, "{i} {:e} {:e} {:e}", p.x, p.y, p.z);
        }
        let _ = writeln!(text, "$EndNodes\n$Elements\n{}", self.tets.len());
        for (i, tet) in (1_u32..).zip(&self.tets) {
            let [a, b, c, d] = tet.map(|v| v + 1);
            let _ = writeln!(text, "{i} 4 2 1 1 {a} {b} {c} {d}");
        }
        let count = self.points.len();
        let _ = writeln!(
            text,
            "$EndElements\n$NodeData\n1\n\"length\"\n1\n0.0\n3\n0\n1\n{count}"
        );
        for (i, size) in (1_u32..).zip(&self.sizes) {
            let _ = writeln!(text, "{i} {size:e}");
        }
        text.push_str("$EndNodeData\n");
        text.into_bytes()
    }

    /// Gmsh 4.1, binary.
    pub fn msh4(&self) -> Vec<u8> {
        let mut bytes = b"$MeshFormat\n4.1 1 8\n".to_vec();
        bytes.extend(1_i32.to_le_bytes());
        bytes.extend(b"\n$EndMeshFormat\n$Nodes\n");
        let count = self.points.len() as u64;
        bytes.extend([1, count, 1, count].into_iter().flat_map(u64::to_le_bytes));
        bytes.extend([3, 1, 0].into_iter().flat_map(i32::to_le_bytes));
        bytes.extend(count.to_le_bytes());
        bytes.extend((1..=count).flat_map(u64::to_le_bytes));
        let numbers = self.points.iter().flat_map(|p| p.to_array());
        bytes.extend(numbers.flat_map(f64::to_le_bytes));
        bytes.extend(b"\n$EndNodes\n$Elements\n");
        let tets = self.tets.len() as u64;
        bytes.extend([1, tets, 1, tets].into_iter().flat_map(u64::to_le_bytes));
        bytes.extend([3, 1, 4].into_iter().flat_map(i32::to_le_bytes));
        bytes.extend(tets.to_le_bytes());
        for (i, tet) in (1_u64..).zip(&self.tets) {
            bytes.extend(i.to_le_bytes());
            bytes.extend(tet.iter().flat_map(|&v| (u64::from(v) + 1).to_le_bytes()));
        }
        let head = format!("\n$EndElements\n$NodeData\n1\n\"length\"\n1\n0.0\n3\n0\n1\n{count}\n");
        bytes.extend(head.into_bytes());
        for (i, size) in (1_i32..).zip(&self.sizes) {
            bytes.extend(i.to_le_bytes());
            bytes.extend(size.to_le_bytes());
        }
        bytes.extend(b"\n$EndNodeData\n");
        bytes
    }
}
