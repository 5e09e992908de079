//! Invariants of a document, in one place for decoder, tests and `meshqual --check`.

use crate::isometry::lcm;
use crate::{
    Document, Instance, Isometry, MAX_TURN_DENOMINATOR, OUTSIDE, Symmetry, Template, Violation,
    Wall,
};
use glam::DVec3;
use std::collections::{BTreeSet, HashSet};

/// Distance from a mirror plane, relative to the template's extent, up to which a vertex counts as
/// on the plane: a few units in the last place of the coordinates.
const PLANE_ROUNDING: f64 = 1e-14;

/// Distance from its image, relative to the extent, up to which a vertex of a hub wall counts as
/// equal to it: where two copies of a template meet on another one, a vertex has two images.
const HUB_ROUNDING: f64 = 1e-14;

/// Deviation from orthonormality up to which a frame counts as a rotation.
const FRAME_ROUNDING: f64 = 1e-12;

/// Deviation from unit length and from a right angle that directions of a symmetry may have: they
/// are reported values, and whoever computes with them makes them orthonormal first.
const DIRECTION_ROUNDING: f64 = 1e-6;

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
    if let Some(symmetry) = &document.symmetry {
        check_symmetry(symmetry, &mut found);
    }
    for (index, template) in document.templates.iter().enumerate() {
        check_template(index, template, &regions, &mut found);
    }
    // Walls compare coordinates of vertices they name: only where all names are in range.
    if found.0.is_empty() {
        for (index, template) in document.templates.iter().enumerate() {
            check_walls(index, template, document, &mut found);
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
    if !(off <= FRAME_ROUNDING && q.determinant() > 0.0 && document.frame.origin.is_finite()) {
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
    let walls = document.templates.iter().flat_map(|t| &t.walls);
    let walls = walls.map(|w| ("wall", w.name()));
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
        if let Some(limit) = region.max_volume {
            check(limit, true, &|| {
                format!("the volume limit of region '{name}'")
            });
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
    let Some(symmetry) = &document.symmetry else {
        return;
    };
    let own = [symmetry.residual, symmetry.tolerance, symmetry.radius];
    let rejected = symmetry.rejected.iter().map(|r| r.residual);
    let others = symmetry.other_axes.iter();
    let others = others.flat_map(|o| o.direction.into_iter().chain([o.residual]));
    let promise = symmetry.promise.iter();
    let promise = promise.flat_map(|p| p.rotation.into_iter().flatten().chain(p.origin));
    for value in own.into_iter().chain(rejected).chain(others).chain(promise) {
        check(value, false, &|| "a number of the symmetry".to_owned());
    }
}

/// Checks that all isometries belong to one group of bounded order, so that no product of them can
/// leave the range of [`Isometry`].
fn check_turns(document: &Document, found: &mut Collector) {
    let steps = document.templates.iter().flat_map(|t| &t.walls);
    let steps = steps.map(|wall| match wall {
        Wall::Mirror(w) => w.reflection,
        Wall::Seam(w) => w.rotation,
        Wall::Hub(w) => w.placement,
    });
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
    // Half steps of the order have to be turns too.
    let most = MAX_TURN_DENOMINATOR / 2;
    let promise = symmetry.promise.as_ref();
    let promised = promise.map(|p| p.order);
    let outside = promise.and_then(|p| p.outside);
    let orders = [Some(symmetry.order), promised, outside.map(|o| o.order)];
    for order in orders.into_iter().flatten() {
        if !(1..=most).contains(&order) {
            bad(format!("has the order {order}, which is not in 1..={most}"));
        }
    }
    if let (Some(whole), Some(outside)) = (promised, outside) {
        if !outside.order.is_multiple_of(whole.max(1)) {
            let order = outside.order;
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
    let axis = DVec3::from_array(symmetry.axis.direction);
    let mirror = DVec3::from_array(symmetry.mirror_direction);
    for (what, direction) in [("axis", axis), ("mirror direction", mirror)] {
        let length = direction.length();
        // A NaN is not near to anything.
        let is_unit = (length - 1.0).abs() <= DIRECTION_ROUNDING;
        if !is_unit {
            bad(format!("has the {what} {direction}, of length {length}"));
        }
    }
    let is_orthogonal = axis.dot(mirror).abs() <= DIRECTION_ROUNDING;
    if !is_orthogonal {
        bad(format!(
            "has the mirror direction {mirror}, which is not orthogonal to the axis {axis}"
        ));
    }
    if !DVec3::from_array(symmetry.axis.point).is_finite() {
        bad("has an axis through a point that is not finite".to_owned());
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
    for wall in &template.walls {
        let element = format!("wall '{}'", wall.name());
        // Hub pairs name vertices of two templates; Wall::vertices yields only ours.
        wall.vertices()
            .enumerate()
            .for_each(|(i, v)| out_of_range(&element, i, v));
    }
    let triangles = template.triangles.len();
    for wall in &template.walls {
        for triangle in wall.triangles().filter(|&t| t as usize >= triangles) {
            found.add(Violation::TriangleOutOfRange {
                wall: wall.name().to_owned(),
                template: index,
                triangle,
                count: triangles,
            });
        }
    }
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

fn check_walls(index: usize, template: &Template, document: &Document, found: &mut Collector) {
    let extent = template
        .vertices
        .iter()
        .fold(0.0_f64, |m, p| m.max(p.abs().max_element()));
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
    for wall in &template.walls {
        match wall {
            Wall::Mirror(w) => {
                let unordered = first_unordered(w.vertices.iter().copied())
                    .map(|i| ("vertices", i))
                    .or(first_unordered(w.triangles.iter().copied()).map(|i| ("triangles", i)));
                if let Some((what, i)) = unordered {
                    found.add(Violation::Unordered {
                        wall: w.name.clone(),
                        template: index,
                        what,
                        index: i,
                    });
                }
                // A reflection maps the normal to its opposite and fixes the plane.
                let image = w.reflection.apply(w.plane.normal);
                let unit = (w.plane.normal.length() - 1.0).abs() <= FRAME_ROUNDING;
                let opposite = (image + w.plane.normal).length() <= FRAME_ROUNDING;
                if !(unit && opposite && w.plane.offset == 0.0) {
                    found.add(Violation::BadPlane {
                        wall: w.name.clone(),
                        template: index,
                    });
                }
                for &vertex in &w.vertices {
                    let distance = w.plane.distance(template.vertices[vertex as usize]).abs();
                    if distance > PLANE_ROUNDING * extent {
                        found.add(Violation::OffPlane {
                            wall: w.name.clone(),
                            template: index,
                            vertex,
                            distance,
                        });
                    }
                }
                for &triangle in &w.triangles {
                    let corners = template.triangles[triangle as usize].vertices;
                    let off = corners
                        .iter()
                        .find(|v| w.vertices.binary_search(v).is_err());
                    if let Some(&vertex) = off {
                        found.add(Violation::OpenWall {
                            wall: w.name.clone(),
                            template: index,
                            triangle,
                            vertex,
                        });
                    }
                }
            }
            Wall::Seam(w) => {
                let pairs = Pairs {
                    wall: &w.name,
                    index,
                    vertex_pairs: &w.vertex_pairs,
                    triangle_pairs: &w.triangle_pairs,
                };
                pairs.check(template, template, w.rotation, None, found);
            }
            Wall::Hub(w) => {
                let count = document.templates.len();
                let Some(other) = document.templates.get(w.other as usize) else {
                    found.add(Violation::IndexOutOfRange {
                        what: format!("wall '{}' of template {index}", w.name),
                        target: "template",
                        index: w.other as usize,
                        count,
                    });
                    continue;
                };
                let vertex = w.vertex_pairs.iter().map(|p| p[1]).max();
                let triangle = w.triangle_pairs.iter().map(|p| p[1]).max();
                if let Some(vertex) = vertex.filter(|&v| v as usize >= other.vertices.len()) {
                    found.add(Violation::VertexOutOfRange {
                        element: format!("wall '{}'", w.name),
                        index: 0,
                        template: w.other as usize,
                        vertex,
                        count: other.vertices.len(),
                    });
                    continue;
                }
                if let Some(triangle) = triangle.filter(|&t| t as usize >= other.triangles.len()) {
                    found.add(Violation::TriangleOutOfRange {
                        wall: w.name.clone(),
                        template: w.other as usize,
                        triangle,
                        count: other.triangles.len(),
                    });
                    continue;
                }
                let pairs = Pairs {
                    wall: &w.name,
                    index,
                    vertex_pairs: &w.vertex_pairs,
                    triangle_pairs: &w.triangle_pairs,
                };
                pairs.check(template, other, w.placement, Some(extent), found);
            }
        }
    }
}

struct Pairs<'a> {
    wall: &'a str,
    index: usize,
    vertex_pairs: &'a [[u32; 2]],
    triangle_pairs: &'a [[u32; 2]],
}

impl Pairs<'_> {
    /// Checks that second members are images of first ones, or, on a hub wall of a template of the
    /// given extent, first members images of second ones but for rounding; and that paired triangles
    /// have paired vertices.
    fn check(
        &self,
        first: &Template,
        second: &Template,
        isometry: Isometry,
        hub: Option<f64>,
        found: &mut Collector,
    ) {
        if let Some(i) = first_unordered(self.vertex_pairs.iter().map(|p| p[0])) {
            found.add(Violation::Unordered {
                wall: self.wall.to_owned(),
                template: self.index,
                what: "pairs",
                index: i,
            });
            return;
        }
        let placed = isometry.placed();
        for &[a, b] in self.vertex_pairs {
            let p = first.vertices[a as usize];
            let q = second.vertices[b as usize];
            let (image, target, allowed) = match hub {
                Some(extent) => (placed.apply(q), p, HUB_ROUNDING * extent),
                None => (placed.apply(p), q, 0.0),
            };
            let distance = (image - target).abs().max_element();
            if distance > allowed {
                found.add(Violation::NotAnImage {
                    wall: self.wall.to_owned(),
                    template: self.index,
                    first: a,
                    second: b,
                    distance: (image - target).length(),
                });
            }
        }
        let partner = |v: u32| {
            self.vertex_pairs
                .binary_search_by_key(&v, |p| p[0])
                .ok()
                .map(|i| self.vertex_pairs[i][1])
        };
        for &[a, b] in self.triangle_pairs {
            let low = first.triangles[a as usize].vertices.map(partner);
            let [x, y, z] = second.triangles[b as usize].vertices;
            // Once placed the two faces face each other, in reverse orientation; the placement may
            // itself reverse it.
            let facing = if isometry.reverses_orientation() {
                [[x, y, z], [y, z, x], [z, x, y]]
            } else {
                [[x, z, y], [z, y, x], [y, x, z]]
            };
            if !facing.map(|r| r.map(Some)).contains(&low) {
                found.add(Violation::TrianglesDiffer {
                    wall: self.wall.to_owned(),
                    template: self.index,
                    first: a,
                    second: b,
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
        for wall in &template.walls {
            let (target, step) = match wall {
                Wall::Mirror(w) => (index, w.reflection),
                Wall::Seam(w) => (index, w.rotation),
                Wall::Hub(w) => (w.other as usize, w.placement),
            };
            for &isometry in &placed[index] {
                let neighbour = isometry.compose(step);
                if !placed[target].contains(&neighbour) {
                    found.add(Violation::MissingNeighbour {
                        template: index,
                        isometry,
                        neighbour,
                        wall: wall.name().to_owned(),
                    });
                }
            }
        }
    }
}
