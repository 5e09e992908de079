//! Invariants of a document, in one place for decoder, tests and `meshqual --check`.

use crate::isometries::lcm;
use crate::{
    Document, Gluing, Instance, Isometry, MAX_TURN_DENOMINATOR, OUTSIDE, Plane, Promise, ROUNDING,
    SizeField, Symmetry, Template, Violation,
};
use glam::DVec3;
use std::collections::{BTreeSet, HashSet};

/// Deviation that directions of a symmetry may have from unit length and from a right angle: they are
/// reported values, which may have been written in single precision, and whoever computes with them
/// makes them orthonormal first. A component is off by 2^-25 then, a length by the square root of
/// three times that, and a product of two directions by twice as much, which is below 2^-23.
const DIRECTION_ROUNDING: f64 = f32::EPSILON as f64;

/// All broken invariants of a document; empty when it is valid.
///
/// Stops collecting after 1000, so that a damaged document does not produce a list of its own size.
/// Linear in the document.
pub fn validate(document: &Document) -> Vec<Violation> {
    let mut found = Collector(Vec::new());
    if document.templates.is_empty() {
        found.add(Violation::NoTemplate);
    }
    check_frame(document, &mut found);
    let regions: HashSet<u32> = document.regions.iter().map(|r| r.id).collect();
    check_tables(document, &regions, &mut found);
    check_names(document, &mut found);
    check_numbers(document, &mut found);
    check_turns(document, &mut found);
    if let Some(field) = &document.size_field {
        check_size_field(field, &mut found);
    }
    if let Some(symmetry) = &document.symmetry {
        check_symmetry(symmetry, &mut found);
    }
    if let Some(promise) = &document.promise {
        check_promise(promise, &mut found);
    }
    for (index, template) in document.templates.iter().enumerate() {
        check_template(index, template, &regions, &mut found);
    }
    // Gluings compare coordinates of vertices they name: only where all names are in range.
    if found.0.is_empty() {
        for (index, template) in document.templates.iter().enumerate() {
            check_axis(index, template, &mut found);
            let extent = extent(template);
            for gluing in &template.gluings {
                let side = Side {
                    document,
                    index,
                    gluing,
                    extent,
                };
                side.check(&mut found);
            }
        }
    }
    if found.0.is_empty() {
        check_instances(document, &mut found);
    }
    found.0
}

struct Collector(Vec<Violation>);

impl Collector {
    fn add(&mut self, violation: Violation) {
        if self.0.len() < 1000 {
            self.0.push(violation);
        }
    }
}

fn check_frame(document: &Document, found: &mut Collector) {
    let q = document.frame.rotation;
    let gram = q.transpose() * q - glam::DMat3::IDENTITY;
    let off = gram
        .to_cols_array()
        .iter()
        .fold(0.0_f64, |m, x| m.max(x.abs()));
    // A NaN anywhere makes both comparisons false.
    if !(off <= ROUNDING && q.determinant() > 0.0 && document.frame.origin.is_finite()) {
        found.add(Violation::BadFrame);
    }
}

fn check_tables(document: &Document, regions: &HashSet<u32>, found: &mut Collector) {
    let mut check = |table: &'static str, ids: &mut dyn Iterator<Item = u32>| {
        let mut last = None;
        for id in ids {
            if id == OUTSIDE || last.is_some_and(|l| id <= l) {
                found.add(Violation::BadTable { table, id });
            }
            last = Some(id);
        }
    };
    check("region", &mut document.regions.iter().map(|r| r.id));
    check("marker", &mut document.markers.iter().map(|m| m.id));
    for map in &document.region_maps {
        check("region map", &mut map.pairs.iter().map(|p| p[0]));
    }
    for [_, to] in document.region_maps.iter().flat_map(|m| &m.pairs) {
        if !regions.contains(to) {
            found.add(Violation::BadTable {
                table: "region map",
                id: *to,
            });
        }
    }
}

/// Checks that names can stand on a line, in any format and on a terminal.
fn check_names(document: &Document, found: &mut Collector) {
    let regions = document.regions.iter().map(|r| ("region", r.name.as_str()));
    let markers = document.markers.iter().map(|m| ("marker", m.name.as_str()));
    let walls = document.templates.iter().flat_map(|t| &t.gluings);
    let walls = walls.map(|w| ("wall", w.name.as_str()));
    for (what, name) in regions.chain(markers).chain(walls) {
        if name.chars().any(char::is_control) {
            found.add(Violation::BadName {
                what,
                name: name.to_owned(),
            });
        }
    }
}

/// Checks the numbers of the tables: JSON has no infinite ones, and none that is not a number.
fn check_numbers(document: &Document, found: &mut Collector) {
    let mut check = |value: f64, positive: bool, what: &dyn Fn() -> String| {
        if !value.is_finite() || positive && value <= 0.0 {
            found.add(Violation::BadNumber {
                what: what(),
                value,
                positive,
            });
        }
    };
    for region in &document.regions {
        let name = &region.name;
        match region.size {
            Some(crate::Size::MaxVolume(limit)) => check(limit, true, &|| {
                format!("the volume limit of region '{name}'")
            }),
            Some(crate::Size::EdgeLength(length)) => check(length, true, &|| {
                format!("the length of edges in region '{name}'")
            }),
            None => {}
        }
        if let Some(volume) = region.volume {
            check(volume, false, &|| format!("the volume of region '{name}'"));
        }
    }
    for marker in &document.markers {
        if let Some(area) = marker.area {
            check(area, false, &|| format!("the area of '{}'", marker.name));
        }
    }
    if let Some(source) = &document.source {
        let numbers = [
            (source.volume, "volume"),
            (source.boundary_area, "boundary area"),
            (source.precision, "precision"),
        ];
        for (value, what) in numbers {
            check(value, false, &|| format!("the source's {what}"));
        }
    }
    let wishes = &document.wishes;
    let size = wishes.size.map(|size| match size {
        crate::Size::MaxVolume(x) | crate::Size::EdgeLength(x) => x,
    });
    for (value, what) in [
        (wishes.radius_edge, "radius-edge ratio"),
        (wishes.optimize, "largest dihedral angle"),
        (wishes.feature_angle, "angle of features"),
        (wishes.segments_per_turn, "number of edges in a turn"),
        (wishes.gradation, "gradation"),
        (
            wishes.layers_across.map(f64::from),
            "number of elements across walls",
        ),
        (size, "size of elements"),
        (wishes.timeout, "time limit"),
    ] {
        if let Some(value) = value {
            check(value, true, &|| format!("the {what} wished for"));
        }
    }
    if let Some(crate::Deviation::Within(value)) = wishes.deviation {
        check(value, false, &|| "the deviation wished for".to_owned());
    }
    if let Some(value) = wishes.moved {
        check(value, false, &|| {
            "the distance that the surface was moved by".to_owned()
        });
    }
    if let Some(value) = wishes.min_dihedral {
        check(value, false, &|| {
            "the smallest dihedral angle wished for".to_owned()
        });
    }
    let symmetry = document.symmetry.iter();
    let symmetry = symmetry.flat_map(|s| [s.residual, s.tolerance, s.radius]);
    let search = document.search.iter();
    let search = search.flat_map(|s| {
        let rejected = s.rejected.iter().map(|r| r.residual);
        let others = s.other_axes.iter();
        rejected.chain(others.flat_map(|o| o.direction.into_iter().chain([o.residual])))
    });
    let promise = document.promise.iter();
    let promise = promise.flat_map(|p| p.rotation.into_iter().flatten().chain(p.origin));
    for value in symmetry.chain(search).chain(promise) {
        check(value, false, &|| "a number of the symmetry".to_owned());
    }
}

/// Checks lengths that change from place to place.
fn check_size_field(field: &SizeField, found: &mut Collector) {
    let mut bad = |reason: String| found.add(Violation::BadSizeField { reason });
    for (i, point) in field.points.iter().enumerate() {
        if !point.position.is_finite() {
            bad(format!("point {i} has the coordinates {}", point.position));
        }
        if !(point.size.is_finite() && point.size > 0.0) {
            let size = point.size;
            bad(format!(
                "point {i} has the length {size}, which must be a finite positive number"
            ));
        }
    }
    if field.tets.is_empty() && field.triangles.is_empty() {
        bad("it has no elements".to_owned());
    }
    let tets = field.tets.iter().map(|t| t.as_slice());
    let triangles = field.triangles.iter().map(|t| t.as_slice());
    for (kind, list) in [
        (
            "tetrahedron",
            &mut tets.enumerate() as &mut dyn Iterator<Item = (usize, &[u32])>,
        ),
        ("triangle", &mut triangles.enumerate()),
    ] {
        for (i, corners) in list {
            let count = field.points.len();
            if let Some(v) = corners.iter().find(|&&v| v as usize >= count) {
                bad(format!("{kind} {i} names point {v}, and there are {count}"));
            } else if (1..corners.len()).any(|k| corners[..k].contains(&corners[k])) {
                bad(format!("{kind} {i} names a point twice"));
            }
        }
    }
}

/// Checks that all isometries belong to one group of bounded order, so that no product of them can
/// leave the range of [`Isometry`].
fn check_turns(document: &Document, found: &mut Collector) {
    let steps = document.templates.iter().flat_map(|t| &t.gluings);
    let steps = steps.map(|gluing| gluing.step);
    let placements = document.instances.iter().map(|i| i.isometry);
    let mut common = 1;
    for isometry in placements.chain(steps) {
        common = lcm(common, u64::from(isometry.n()));
        if common > u64::from(MAX_TURN_DENOMINATOR) {
            found.add(Violation::TurnsTooFine {
                denominator: common,
            });
            return;
        }
    }
}

fn check_symmetry(symmetry: &Symmetry, found: &mut Collector) {
    let mut bad = |reason: String| found.add(Violation::BadSymmetry { reason });
    let axis = DVec3::from_array(symmetry.axis.direction);
    let reference = DVec3::from_array(symmetry.reference);
    for (what, direction) in [("axis", axis), ("reference direction", reference)] {
        let length = direction.length();
        // A NaN is not near to anything.
        let is_unit = (length - 1.0).abs() <= DIRECTION_ROUNDING;
        if !is_unit {
            bad(format!("has the {what} {direction}, of length {length}"));
        }
    }
    let is_orthogonal = axis.dot(reference).abs() <= DIRECTION_ROUNDING;
    if !is_orthogonal {
        bad(format!(
            "has the reference direction {reference}, which is not orthogonal to the axis {axis}"
        ));
    }
    if !DVec3::from_array(symmetry.axis.point).is_finite() {
        bad("has an axis through a point that is not finite".to_owned());
    }
    let (maps, generators) = (symmetry.regions.len(), symmetry.group.generators().len());
    if maps > 0 && maps != generators {
        bad(format!(
            "says of {maps} operations how they permute regions, and {} has {generators} generators",
            symmetry.group
        ));
    }
}

fn check_promise(promise: &Promise, found: &mut Collector) {
    let mut bad = |reason: String| found.add(Violation::BadSymmetry { reason });
    let Some(outside) = promise.outside else {
        return;
    };
    let [whole, order] = [promise.group.order, outside.group.order];
    if !order.is_multiple_of(whole) {
        bad(format!(
            "has the order {order} outside, which is no multiple of the order {whole} of the whole"
        ));
    }
    if !(0.0..f64::INFINITY).contains(&outside.radius) {
        let radius = outside.radius;
        bad(format!(
            "has an order that holds outside of the radius {radius}"
        ));
    }
}

fn check_template(
    index: usize,
    template: &Template,
    regions: &HashSet<u32>,
    found: &mut Collector,
) {
    let count = template.vertices.len();
    for (vertex, &position) in template.vertices.iter().enumerate() {
        if !position.is_finite() {
            found.add(Violation::NotFinite {
                template: index,
                vertex,
                position,
            });
        }
    }
    let mut out_of_range = |element: &str, i: usize, vertex: u32| {
        if vertex as usize >= count {
            found.add(Violation::VertexOutOfRange {
                element: element.to_owned(),
                index: i,
                template: index,
                vertex,
                count,
            });
        }
    };
    for (i, t) in template.triangles.iter().enumerate() {
        t.vertices
            .iter()
            .for_each(|&v| out_of_range("triangle", i, v));
    }
    for (i, t) in template.tets.iter().enumerate() {
        t.vertices
            .iter()
            .for_each(|&v| out_of_range("tetrahedron", i, v));
    }
    for (i, &v) in template.axis.iter().enumerate() {
        out_of_range("axis entry", i, v);
    }
    for gluing in &template.gluings {
        let element = format!("wall '{}'", gluing.name);
        // Pairs may name vertices of two templates; these are only ours.
        gluing
            .vertices_of(index)
            .enumerate()
            .for_each(|(i, v)| out_of_range(&element, i, v));
    }
    let triangles = template.triangles.len();
    for gluing in &template.gluings {
        for triangle in gluing.triangles_of(index) {
            if triangle as usize >= triangles {
                found.add(Violation::TriangleOutOfRange {
                    wall: gluing.name.clone(),
                    template: index,
                    triangle,
                    count: triangles,
                });
            }
        }
    }
    check_elements(index, template, regions, found);
}

/// Checks that elements have different vertices and known regions.
fn check_elements(
    index: usize,
    template: &Template,
    regions: &HashSet<u32>,
    found: &mut Collector,
) {
    // Elements come in long runs of one region: a look-up per change of region.
    let mut known = OUTSIDE;
    let mut unknown = |region: u32| {
        region != known && region != OUTSIDE && {
            let missing = !regions.contains(&region);
            if !missing {
                known = region;
            }
            missing
        }
    };
    for (i, t) in template.triangles.iter().enumerate() {
        let [a, b, c] = t.vertices;
        if a == b || b == c || a == c {
            let vertex = if b == c { b } else { a };
            found.add(Violation::RepeatedVertex {
                element: "triangle",
                index: i,
                template: index,
                vertex,
            });
        }
        for region in [t.front, t.back] {
            if unknown(region) {
                found.add(Violation::UnknownRegion {
                    element: "triangle",
                    index: i,
                    template: index,
                    region,
                });
            }
        }
    }
    for (i, t) in template.tets.iter().enumerate() {
        let [a, b, c, d] = t.vertices;
        if a == b || a == c || a == d || b == c || b == d || c == d {
            let vertex = if b == c || b == d {
                b
            } else if c == d {
                c
            } else {
                a
            };
            found.add(Violation::RepeatedVertex {
                element: "tetrahedron",
                index: i,
                template: index,
                vertex,
            });
        }
        if t.region == OUTSIDE || unknown(t.region) {
            found.add(Violation::UnknownRegion {
                element: "tetrahedron",
                index: i,
                template: index,
                region: t.region,
            });
        }
    }
}

fn check_axis(index: usize, template: &Template, found: &mut Collector) {
    if let Some(at) = first_unordered(template.axis.iter().copied()) {
        found.add(Violation::AxisUnordered {
            template: index,
            index: at,
        });
    }
    for &vertex in &template.axis {
        let p = template.vertices[vertex as usize];
        if p.x != 0.0 || p.y != 0.0 {
            let distance = p.x.hypot(p.y);
            found.add(Violation::OffAxis {
                template: index,
                vertex,
                distance,
            });
        }
    }
}

/// Largest coordinate of a template.
fn extent(template: &Template) -> f64 {
    let points = template.vertices.iter();
    points.fold(0.0_f64, |m, p| m.max(p.abs().max_element()))
}

/// A gluing, seen from the template that lists it.
struct Side<'a> {
    document: &'a Document,
    index: usize,
    gluing: &'a Gluing,
    /// Largest coordinate of the template.
    extent: f64,
}

impl Side<'_> {
    fn check(&self, found: &mut Collector) {
        let Some(other) = self.other(found) else {
            return;
        };
        let orders = [
            ("vertex pairs", first_unordered(self.gluing.vertices_here())),
            (
                "triangle pairs",
                first_unordered(self.gluing.triangles_here()),
            ),
        ];
        for (what, index) in orders {
            if let Some(index) = index {
                found.add(Violation::Unordered {
                    wall: self.gluing.name.clone(),
                    template: self.index,
                    what,
                    index,
                });
                return;
            }
        }
        match Plane::of_reflection(self.gluing.step) {
            Some(plane) if self.gluing.is_mirror(self.index) => self.check_mirror(plane, found),
            _ => self.check_images(other, found),
        }
        self.check_triangles(other, found);
    }

    /// The template on the other side, if all that the pairs name of it is there.
    fn other(&self, found: &mut Collector) -> Option<&Template> {
        let (gluing, other) = (self.gluing, self.gluing.other as usize);
        let count = self.document.templates.len();
        let Some(template) = self.document.templates.get(other) else {
            found.add(Violation::IndexOutOfRange {
                what: format!("wall '{}' of template {}", gluing.name, self.index),
                target: "template",
                index: other,
                count,
            });
            return None;
        };
        let (vertices, triangles) = (template.vertices.len(), template.triangles.len());
        if let Some(vertex) = gluing.vertices_there().max()
            && vertex as usize >= vertices
        {
            found.add(Violation::VertexOutOfRange {
                element: format!("wall '{}'", gluing.name),
                index: 0,
                template: other,
                vertex,
                count: vertices,
            });
            return None;
        }
        if let Some(triangle) = gluing.triangles_there().max()
            && triangle as usize >= triangles
        {
            found.add(Violation::TriangleOutOfRange {
                wall: gluing.name.clone(),
                template: other,
                triangle,
                count: triangles,
            });
            return None;
        }
        Some(template)
    }

    /// Checks that a reflection pairs everything with itself, and vertices lie on its plane.
    fn check_mirror(&self, plane: Plane, found: &mut Collector) {
        let template = &self.document.templates[self.index];
        for (what, pairs) in [
            ("vertices", &self.gluing.vertex_pairs),
            ("triangles", &self.gluing.triangle_pairs),
        ] {
            if let Some(&[first, second]) = pairs.iter().find(|p| p[0] != p[1]) {
                found.add(Violation::NotItself {
                    wall: self.gluing.name.clone(),
                    template: self.index,
                    what,
                    first,
                    second,
                });
                return;
            }
        }
        for vertex in self.gluing.vertices_here() {
            let distance = plane.distance(template.vertices[vertex as usize]).abs();
            if distance > ROUNDING * self.extent {
                found.add(Violation::OffPlane {
                    wall: self.gluing.name.clone(),
                    template: self.index,
                    vertex,
                    distance,
                });
            }
        }
    }

    /// Checks that first members are images of second ones.
    fn check_images(&self, other: &Template, found: &mut Collector) {
        let template = &self.document.templates[self.index];
        let is_seam = self.gluing.is_seam(self.index);
        let placed = self.gluing.step.placed();
        for &[here, there] in &self.gluing.vertex_pairs {
            // A vertex on the axis of the step is its own image only within rounding.
            let allowed = match is_seam && here != there {
                true => 0.0,
                false => ROUNDING * self.extent,
            };
            let image = placed.apply(other.vertices[there as usize]);
            let off = image - template.vertices[here as usize];
            if off.abs().max_element() > allowed {
                found.add(Violation::NotAnImage {
                    wall: self.gluing.name.clone(),
                    template: self.index,
                    first: here,
                    second: there,
                    distance: off.length(),
                });
            }
        }
    }

    /// Checks that paired triangles have paired vertices and face each other.
    fn check_triangles(&self, other: &Template, found: &mut Collector) {
        let template = &self.document.templates[self.index];
        let pairs = &self.gluing.vertex_pairs;
        let partner = |v: u32| {
            let at = pairs.binary_search_by_key(&v, |p| p[0]);
            at.ok().map(|i| pairs[i][1])
        };
        for &[here, there] in &self.gluing.triangle_pairs {
            let partners = template.triangles[here as usize].vertices.map(partner);
            let [x, y, z] = other.triangles[there as usize].vertices;
            // Once placed the two faces face each other, in reverse orientation; the step may itself
            // reverse it.
            let facing = if self.gluing.step.reverses_orientation() {
                [[x, y, z], [y, z, x], [z, x, y]]
            } else {
                [[x, z, y], [z, y, x], [y, x, z]]
            };
            if !facing.map(|r| r.map(Some)).contains(&partners) {
                found.add(Violation::TrianglesDiffer {
                    wall: self.gluing.name.clone(),
                    template: self.index,
                    first: here,
                    second: there,
                });
            }
        }
    }
}

fn first_unordered(values: impl Iterator<Item = u32>) -> Option<usize> {
    let mut last = None;
    for (i, v) in values.enumerate() {
        if last.is_some_and(|l| v <= l) {
            return Some(i);
        }
        last = Some(v);
    }
    None
}

fn check_instances(document: &Document, found: &mut Collector) {
    let mut placed: Vec<BTreeSet<Isometry>> = vec![BTreeSet::new(); document.templates.len()];
    for (i, instance) in document.instances.iter().enumerate() {
        let Instance {
            template,
            isometry,
            region_map,
        } = *instance;
        let count = document.templates.len();
        if template as usize >= count {
            found.add(Violation::IndexOutOfRange {
                what: format!("instance {i}"),
                target: "template",
                index: template as usize,
                count,
            });
            return;
        }
        if region_map as usize > document.region_maps.len() {
            found.add(Violation::IndexOutOfRange {
                what: format!("instance {i}"),
                target: "region map",
                index: region_map as usize,
                count: document.region_maps.len(),
            });
        }
        if !placed[template as usize].insert(isometry) {
            found.add(Violation::RepeatedInstance {
                template: template as usize,
                isometry,
            });
        }
    }
    // Templates placed once each are a wedge taken out of its context: a sector.
    if placed.iter().all(|places| places.len() <= 1) {
        return;
    }
    for (index, template) in document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            for &isometry in &placed[index] {
                let neighbour = isometry.compose(gluing.step);
                if !placed[gluing.other as usize].contains(&neighbour) {
                    found.add(Violation::MissingNeighbour {
                        template: index,
                        isometry,
                        neighbour,
                        wall: gluing.name.clone(),
                    });
                }
            }
        }
    }
}
