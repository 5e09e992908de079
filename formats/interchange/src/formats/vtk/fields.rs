//! What the VTK formats hold beside points and cells, as field data: names, and what is known of the symmetry.
//!
//! Names are integer arrays `region_names`, `marker_names` and `wall_names` of one tuple, with a component for
//! each name: its value is the id, the component is called by the name. Arrays of strings would be the other
//! way to have names in field data, and meshio opens no file that has one.
//!
//! What the document of a surface says of its body is text, the codes of its bytes: `symmetry` and `source`,
//! objects of JSON like the chunks `SYMM` and `srce` of a document (`SPEC.md`, section 5).

use super::cells::Cells;
use crate::parsed::{Grid, SOURCE, SYMMETRY};
use crate::stream::MeshStream;
use crate::text::one_line;
use std::fmt::Write as _;

/// The arrays of names that are read.
pub const NAMES: [&str; 2] = ["region_names", "marker_names"];

/// Ids and their names.
pub struct Names {
    /// Name of the array.
    pub array: &'static str,
    /// The ids, at least one.
    pub ids: Vec<u32>,
    /// As many names.
    pub names: Vec<String>,
}

/// Names of regions, and of markers and walls when there are triangles. Tables without any are left out.
pub fn names(mesh: &dyn MeshStream, cells: Cells) -> Vec<Names> {
    fn table<'a>(array: &'static str, names: impl Iterator<Item = (u32, &'a str)>) -> Names {
        let (ids, names) = names.map(|(id, name)| (id, one_line(name))).unzip();
        Names { array, ids, names }
    }
    let regions = mesh.regions().iter().map(|r| (r.id, r.name.as_str()));
    let mut tables = vec![table(NAMES[0], regions)];
    if cells.triangles > 0 {
        let markers = mesh.markers().iter().map(|m| (m.id, m.name.as_str()));
        tables.push(table(NAMES[1], markers));
        let walls = (1..).zip(mesh.wall_names().iter().map(String::as_str));
        tables.push(table("wall_names", walls));
    }
    tables.retain(|table| !table.ids.is_empty());
    tables
}

/// Texts about the body, by array name.
pub fn texts(mesh: &dyn MeshStream) -> Vec<(&'static str, String)> {
    let Some((symmetry, source)) = mesh.findings() else {
        return Vec::new();
    };
    let symmetry = serde_json::to_string(symmetry).map(|text| (SYMMETRY, text));
    let source = source.and_then(|source| serde_json::to_string(source).ok());
    // Both are plain structures, which have a form in JSON.
    let texts = symmetry.into_iter();
    texts.chain(source.map(|text| (SOURCE, text))).collect()
}

/// Gives a grid the names of an array's components, whose values are the ids.
pub fn take_names(grid: &mut Grid, array: &str, ids: &[u32], names: &[String]) {
    let mut lines = String::new();
    for (id, name) in ids.iter().zip(names) {
        let _ = writeln!(lines, "{id} {}", one_line(name));
    }
    grid.texts.insert(array.to_owned(), lines);
}
