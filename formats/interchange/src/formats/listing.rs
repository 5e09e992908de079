//! A readable listing of a document, for looking at what travels between two tools.

use glam::DVec3;
use std::fmt::Write as _;
use std::io::{self, Write};
use tmesh::{
    ChunkInfo, Deviation, Document, Isometry, OUTSIDE, Size, SizeField, Template, VERSION_MAJOR,
    VERSION_MINOR,
};

/// Writes the listing. `chunks` are those the document was read from; without them they are not
/// listed.
///
/// # Errors
/// Fails when writing fails.
pub fn write_text(
    document: &Document,
    chunks: &[ChunkInfo],
    out: &mut dyn Write,
) -> io::Result<()> {
    out.write_all(listing(document, chunks).as_bytes())
}

/// Lines of a table with its columns aligned; numbers to the right.
struct Table(Vec<Vec<String>>);

impl Table {
    fn new(head: &[&str]) -> Self {
        Self(vec![head.iter().map(|&h| h.to_owned()).collect()])
    }

    fn row(&mut self, cells: Vec<String>) {
        self.0.push(cells);
    }

    fn print(&self, text: &mut String) {
        let columns = self.0.first().map_or(0, Vec::len);
        let column = |c: usize| self.0.iter().filter_map(move |row| row.get(c));
        let width: Vec<usize> = (0..columns)
            .map(|c| {
                column(c)
                    .map(|cell| cell.chars().count())
                    .max()
                    .unwrap_or(0)
            })
            .collect();
        let number: Vec<bool> = (0..columns)
            .map(|c| column(c).skip(1).all(|cell| cell.parse::<f64>().is_ok()))
            .collect();
        for row in &self.0 {
            let mut line = String::from(" ");
            for (c, cell) in row.iter().enumerate() {
                let _ = if number[c] {
                    write!(line, " {cell:>w$} ", w = width[c])
                } else {
                    write!(line, " {cell:<w$} ", w = width[c])
                };
            }
            text.push_str(line.trim_end());
            text.push('\n');
        }
    }
}

fn number(x: f64) -> String {
    // No minus before zero.
    let text = format!("{:?}", x + 0.0);
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

fn point(p: [f64; 3]) -> String {
    format!("({}, {}, {})", number(p[0]), number(p[1]), number(p[2]))
}

fn isometry(i: Isometry) -> String {
    if i == Isometry::IDENTITY {
        "identity".to_owned()
    } else {
        i.to_string()
    }
}

fn yes(b: bool) -> &'static str {
    if b { "yes" } else { "no" }
}

fn optional(x: Option<f64>) -> String {
    x.map_or_else(|| "-".to_owned(), number)
}

fn size(size: Size) -> String {
    match size {
        Size::MaxVolume(volume) => format!("volume {}", number(volume)),
        Size::EdgeLength(edge) => format!("edges {}", number(edge)),
    }
}

fn listing(document: &Document, chunks: &[ChunkInfo]) -> String {
    let mut text = format!("tmesh document, format version {VERSION_MAJOR}.{VERSION_MINOR}\n");
    list_chunks(chunks, &mut text);
    for (index, template) in document.templates.iter().enumerate() {
        list_template(index, template, document, &mut text);
    }
    list_instances(document, &mut text);
    list_frame(document, &mut text);
    list_symmetry(document, &mut text);
    if let Some(promise) = &document.promise {
        let _ = writeln!(text, "promised exactly: {}", crate::promise_title(promise));
    }
    list_wishes(document, &mut text);
    list_tables(document, &mut text);
    list_origin(document, &mut text);
    text
}

fn list_chunks(chunks: &[ChunkInfo], text: &mut String) {
    if chunks.is_empty() {
        return;
    }
    let _ = writeln!(text, "\nchunks read: {}", chunks.len());
    let mut table = Table::new(&["id", "scope", "offset", "bytes", ""]);
    for chunk in chunks {
        table.row(vec![
            chunk.name(),
            chunk.scope.to_string(),
            chunk.offset.to_string(),
            chunk.length.to_string(),
            if chunk.known { "" } else { "skipped: unknown" }.to_owned(),
        ]);
    }
    table.print(text);
}

fn list_template(index: usize, template: &Template, document: &Document, text: &mut String) {
    let _ = writeln!(text, "\ntemplate {index}");
    let sides = |t: &&tmesh::Triangle| (t.front == OUTSIDE) != (t.back == OUTSIDE);
    let on_walls: usize = template
        .gluings
        .iter()
        .map(|g| g.triangles_of(index).count())
        .sum();
    let boundary = template.triangles.iter().filter(sides).count();
    let mut lines = vec![
        ("vertices", template.vertices.len().to_string()),
        (
            "triangles",
            format!(
                "{} ({boundary} with material on one side, {on_walls} on walls)",
                template.triangles.len()
            ),
        ),
        ("tetrahedra", template.tets.len().to_string()),
        ("on the axis", template.axis.len().to_string()),
    ];
    if let Some((low, high)) = bounds(&template.vertices) {
        lines.push(("bounds, low", point(low.to_array())));
        lines.push(("bounds, high", point(high.to_array())));
    }
    print_pairs(&lines, text);
    list_template_regions(template, document, text);
    if template.gluings.is_empty() {
        return;
    }
    let _ = writeln!(text, "  glued faces: {}", template.gluings.len());
    let head = [
        "name",
        "step",
        "to",
        "vertex pairs",
        "triangle pairs",
        "mirror plane",
    ];
    let mut table = Table::new(&head);
    for gluing in &template.gluings {
        let other = match gluing.other_than(index) {
            Some(other) => format!("template {other}"),
            None if gluing.is_mirror(index) => "itself".to_owned(),
            None => "another face".to_owned(),
        };
        let plane = gluing.mirror_plane(index);
        let plane = plane.map(|p| format!("normal {}", point(p.normal.to_array())));
        table.row(vec![
            gluing.name.clone(),
            isometry(gluing.step),
            other,
            gluing.vertex_pairs.len().to_string(),
            gluing.triangle_pairs.len().to_string(),
            plane.unwrap_or_default(),
        ]);
    }
    table.print(text);
}

/// Elements per region and per marker of one template.
fn list_template_regions(template: &Template, document: &Document, text: &mut String) {
    use std::collections::BTreeMap;
    let name = |id: u32| match document.regions.iter().find(|r| r.id == id) {
        Some(region) => region.name.clone(),
        None => "not listed".to_owned(),
    };
    // Tetrahedra, front sides, back sides.
    let mut regions: BTreeMap<u32, [usize; 3]> = BTreeMap::new();
    let mut markers: BTreeMap<u32, usize> = BTreeMap::new();
    for tet in &template.tets {
        regions.entry(tet.region).or_default()[0] += 1;
    }
    for triangle in &template.triangles {
        regions.entry(triangle.front).or_default()[1] += 1;
        regions.entry(triangle.back).or_default()[2] += 1;
        *markers.entry(triangle.marker).or_default() += 1;
    }
    regions.remove(&OUTSIDE);
    if !regions.is_empty() {
        let head = [
            "region",
            "name",
            "tetrahedra",
            "in front of triangles",
            "behind triangles",
        ];
        let mut table = Table::new(&head);
        for (id, counts) in regions {
            let mut row = vec![id.to_string(), name(id)];
            row.extend(counts.map(|n| n.to_string()));
            table.row(row);
        }
        table.print(text);
    }
    if !markers.is_empty() {
        let mut table = Table::new(&["marker", "name", "triangles"]);
        for (id, count) in markers {
            let name = match document.markers.iter().find(|m| m.id == id) {
                Some(marker) => marker.name.clone(),
                None if id == OUTSIDE => "none".to_owned(),
                None => "not listed".to_owned(),
            };
            table.row(vec![id.to_string(), name, count.to_string()]);
        }
        table.print(text);
    }
}

fn list_instances(document: &Document, text: &mut String) {
    let _ = writeln!(text, "\ninstances: {}", document.instances.len());
    let mut table = Table::new(&["index", "template", "isometry", "orientation", "region map"]);
    for (i, instance) in document.instances.iter().enumerate() {
        table.row(vec![
            i.to_string(),
            instance.template.to_string(),
            isometry(instance.isometry),
            if instance.isometry.reverses_orientation() {
                "reversed"
            } else {
                "kept"
            }
            .to_owned(),
            match instance.region_map {
                0 => "-".to_owned(),
                map => (map - 1).to_string(),
            },
        ]);
    }
    table.print(text);
    for (i, map) in document.region_maps.iter().enumerate() {
        let pairs: Vec<_> = map
            .pairs
            .iter()
            .map(|[a, b]| format!("{a} to {b}"))
            .collect();
        let _ = writeln!(text, "  region map {i}: {}", pairs.join(", "));
    }
}

fn list_frame(document: &Document, text: &mut String) {
    let frame = &document.frame;
    if frame.is_identity() {
        text.push_str("\nframe: canonical coordinates are world coordinates\n");
        return;
    }
    text.push_str("\nframe, canonical axes in the world\n");
    let axes = [
        ("x", frame.rotation.x_axis),
        ("y", frame.rotation.y_axis),
        ("z", frame.rotation.z_axis),
    ];
    let mut lines: Vec<_> = axes.map(|(name, a)| (name, point(a.to_array()))).to_vec();
    lines.push(("origin", point(frame.origin.to_array())));
    print_pairs(&lines, text);
}

fn list_symmetry(document: &Document, text: &mut String) {
    let Some(s) = &document.symmetry else {
        text.push_str("\nsymmetry: not determined\n");
        return;
    };
    text.push_str("\nsymmetry\n");
    let mut lines = vec![
        ("group", s.group.symbol()),
        ("axis point", point(s.axis.point)),
        ("axis direction", point(s.axis.direction)),
        ("canonical x axis", point(s.reference)),
        (
            "residual",
            format!("{} (tolerance {})", number(s.residual), number(s.tolerance)),
        ),
        ("radius", number(s.radius)),
        ("body of revolution", yes(s.axisymmetric).to_owned()),
    ];
    for other in document.search.iter().flat_map(|s| &s.other_axes) {
        let (order, residual) = (other.order, number(other.residual));
        let line = format!(
            "{}, order {order}, residual {residual}",
            point(other.direction)
        );
        lines.push(("other axis", line));
    }
    for rejected in document.search.iter().flat_map(|s| &s.rejected) {
        let line = format!("{}, residual {}", rejected.order, number(rejected.residual));
        lines.push(("rejected order", line));
    }
    for (generator, map) in s.group.generators().into_iter().zip(&s.regions) {
        if !map.pairs.is_empty() {
            let pairs: Vec<_> = map
                .pairs
                .iter()
                .map(|[a, b]| format!("{a} to {b}"))
                .collect();
            let line = format!("{}: {}", isometry(generator), pairs.join(", "));
            lines.push(("regions under", line));
        }
    }
    print_pairs(&lines, text);
}

fn list_wishes(document: &Document, text: &mut String) {
    let wishes = &document.wishes;
    let mut lines: Vec<(&str, String)> = Vec::new();
    let mut add = |what, value: Option<String>| lines.extend(value.map(|v| (what, v)));
    add("improved", wishes.quality.map(|q| yes(q).to_owned()));
    add("radius-edge ratio", wishes.radius_edge.map(number));
    add("smallest dihedral angle", wishes.min_dihedral.map(number));
    add("optimized above", wishes.optimize.map(number));
    add("size", wishes.size.map(size));
    add(
        "deviation of the surface",
        wishes.deviation.map(|deviation| match deviation {
            Deviation::Auto => "auto".to_owned(),
            Deviation::Within(relative) => number(relative),
        }),
    );
    add("features from", wishes.feature_angle.map(number));
    add("edges in a turn", wishes.segments_per_turn.map(number));
    add("gradation", wishes.gradation.map(number));
    let layers = wishes.layers_across.map(|n| n.to_string());
    add("elements across walls", layers);
    let field = document.size_field.as_ref();
    add("size field", field.map(size_field));
    add(
        "shared faces settled",
        wishes.keep_surface.map(|k| yes(k).to_owned()),
    );
    add("surface moved by", wishes.moved.map(number));
    if !lines.is_empty() {
        text.push_str("\nelements wished for\n");
        print_pairs(&lines, text);
    }
}

fn size_field(field: &SizeField) -> String {
    let sizes = || field.points.iter().map(|p| p.size);
    let [least, most] = [
        sizes().fold(f64::INFINITY, f64::min),
        sizes().fold(0.0, f64::max),
    ];
    let (points, tets, triangles) = (field.points.len(), field.tets.len(), field.triangles.len());
    format!(
        "{points} points, {tets} tetrahedra, {triangles} triangles; lengths {} to {}",
        number(least),
        number(most)
    )
}

fn list_tables(document: &Document, text: &mut String) {
    let _ = writeln!(text, "\nregions: {}", document.regions.len());
    if !document.regions.is_empty() {
        let mut table = Table::new(&["id", "name", "volume of the body", "size of elements"]);
        for r in &document.regions {
            let (volume, max) = (
                optional(r.volume),
                r.size.map_or_else(|| "-".to_owned(), size),
            );
            table.row(vec![r.id.to_string(), r.name.clone(), volume, max]);
        }
        table.print(text);
    }
    let _ = writeln!(text, "\nmarkers: {}", document.markers.len());
    if !document.markers.is_empty() {
        let mut table = Table::new(&["id", "name", "area of the body"]);
        for m in &document.markers {
            table.row(vec![m.id.to_string(), m.name.clone(), optional(m.area)]);
        }
        table.print(text);
    }
}

fn list_origin(document: &Document, text: &mut String) {
    if let Some(s) = &document.source {
        text.push_str("\nsource\n");
        let lines = [
            ("format", s.format.clone()),
            ("triangles", s.triangles.to_string()),
            ("volume", number(s.volume)),
            ("boundary area", number(s.boundary_area)),
            ("precision", number(s.precision)),
        ];
        print_pairs(&lines, text);
    }
    let _ = writeln!(text, "\nhistory: {}", document.history.len());
    for entry in &document.history {
        let command = [
            std::slice::from_ref(&entry.tool),
            entry.arguments.as_slice(),
        ]
        .concat();
        let _ = writeln!(text, "  {} ({})", command.join(" "), entry.version);
        for note in &entry.notes {
            let _ = writeln!(text, "    {note}");
        }
    }
}

fn print_pairs(lines: &[(&str, String)], text: &mut String) {
    let width = lines.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    for (name, value) in lines {
        let _ = writeln!(text, "  {name:<width$}  {value}");
    }
}

fn bounds(points: &[DVec3]) -> Option<(DVec3, DVec3)> {
    let first = *points.first()?;
    Some(
        points
            .iter()
            .fold((first, first), |(low, high), &p| (low.min(p), high.max(p))),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stream::test_document;

    #[test]
    fn a_listing() {
        let mut document = test_document();
        document.history.push(tmesh::HistoryEntry {
            tool: "wedgecut".to_owned(),
            version: "1.0".to_owned(),
            arguments: vec!["--order".to_owned(), "4".to_owned()],
            notes: vec!["mirror wedge of order 4".to_owned()],
        });
        let mut bytes = Vec::new();
        tmesh::write(&document, &mut bytes).unwrap();
        let (document, chunks) = tmesh::read_with_chunks(bytes.as_slice()).unwrap();
        let mut text = Vec::new();
        write_text(&document, &chunks, &mut text).unwrap();
        let expected = "\
tmesh document, format version 1.0

chunks read: 10
  id    scope  offset  bytes
  FRAM      0      16     96
  REGN      0     144     26
  MARK      0     208     23
  hist      0     264    101
  VERT      0     400     96
  TRIS      0     528     96
  TETS      0     656     20
  AXIS      0     712      8
  GLUE      0     752     72
  INST      0     856     24

template 0
  vertices      4
  triangles     4 (4 with material on one side, 1 on walls)
  tetrahedra    1
  on the axis   2
  bounds, low   (0, 0, 0)
  bounds, high  (1, 1, 1)
  region  name    tetrahedra  in front of triangles  behind triangles
       7  copper           1                      0                 4
  marker  name        triangles
       0  not listed          1
       2  top                 3
  glued faces: 1
  name   step         to      vertex pairs  triangle pairs  mirror plane
  floor  0/1 flipped  itself             3               1  normal (0, 0, -1)

instances: 1
  index  template  isometry  orientation  region map
      0         0  identity  kept         -

frame, canonical axes in the world
  x       (1, 0, 0)
  y       (0, 1, 0)
  z       (0, 0, 1)
  origin  (1, 0, 0)

symmetry: not determined

regions: 1
  id  name    volume of the body  size of elements
   7  copper  -                   -

markers: 1
  id  name  area of the body
   2  top   -

history: 1
  wedgecut --order 4 (1.0)
    mirror wedge of order 4
";
        let text = String::from_utf8(text).unwrap();
        for (found, wanted) in text.lines().zip(expected.lines()) {
            assert_eq!(found, wanted);
        }
        assert_eq!(text, expected);
    }
}
