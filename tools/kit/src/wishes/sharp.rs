//! Edges of a surface at which material ends in a small angle. Elements fill that angle and share it, so none of them has
//! a larger one there, however they are made.

use super::place::Place;
use geom::edges::{EdgeUse, Edges, apex_of};
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{OUTSIDE, Template};

/// An edge between two faces of one region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sharp {
    /// The angle of the region there, degrees.
    pub angle: f64,
    /// The middle of the edge.
    pub middle: DVec3,
    /// What the faces are.
    pub place: Place,
}

impl Sharp {
    /// Whether it is on the axis, where copies share an angle.
    pub fn is_on_axis(&self) -> bool {
        self.place == Place::Axis
    }
}

/// The edges of a template, given with its index, at which a region has an angle below `asked`, degrees. Linear.
pub fn sharp_edges((index, template): (usize, &Template), asked: f64) -> Vec<Sharp> {
    let triangles: Vec<_> = template.triangles.iter().map(|t| t.vertices).collect();
    let edges = Edges::new(&triangles);
    let mut walls: Option<Walls> = None;
    let mut sharp = Vec::new();
    for edge in 0..edges.len() {
        let around = edges.sorted_around(edge, &triangles, &template.vertices);
        let ends = edges.ends[edge].map(|v| template.vertices[v as usize]);
        for (i, here) in around.iter().enumerate() {
            let there = &around[(i + 1) % around.len()];
            if around.len() < 2 || between(template, here) == OUTSIDE {
                continue;
            }
            let [a, b] = [here, there].map(|of| {
                let apex = apex_of(&triangles[of.triangle as usize], of.corner);
                template.vertices[apex as usize]
            });
            let angle = turn(ends, a, b).to_degrees();
            if angle < asked {
                // Few surfaces have such angles.
                let walls = walls.get_or_insert_with(|| walls_of((index, template)));
                let faces = [here, there].map(|of| of.triangle);
                sharp.push(Sharp {
                    angle,
                    middle: 0.5 * (ends[0] + ends[1]),
                    place: place(template, walls, edges.ends[edge], faces),
                });
            }
        }
    }
    sharp
}

/// The region that follows a triangle counter-clockwise around its edge: the front of triangles that run along the edge's
/// direction, the back of others.
fn between(template: &Template, of: &EdgeUse) -> u32 {
    let triangle = &template.triangles[of.triangle as usize];
    if of.forward {
        triangle.front
    } else {
        triangle.back
    }
}

/// The right-handed turn about an edge that takes the half plane of `a` to that of `b`, radians, from 0 to a whole turn.
fn turn([from, to]: [DVec3; 2], a: DVec3, b: DVec3) -> f64 {
    let direction = (to - from).normalize_or_zero();
    let [a, b] = [a, b].map(|p| (p - from).reject_from_normalized(direction));
    let turn = libm::atan2(direction.dot(a.cross(b)), a.dot(b));
    if turn < 0.0 {
        turn + std::f64::consts::TAU
    } else {
        turn
    }
}

/// The glued face that a triangle is part of.
type Walls = FxHashMap<u32, Place>;

fn walls_of((index, template): (usize, &Template)) -> Walls {
    let gluings = template.gluings.iter().enumerate();
    let of_gluings = gluings.flat_map(|(i, gluing)| {
        let triangles = gluing.triangles_of(index);
        triangles.map(move |t| (t, Place::Wall(index, i)))
    });
    of_gluings.collect()
}

/// What the two faces at an edge are: on the axis, one of them a glued face, or surface.
fn place(template: &Template, walls: &Walls, ends: [u32; 2], faces: [u32; 2]) -> Place {
    if ends.iter().all(|v| template.axis.binary_search(v).is_ok()) {
        return Place::Axis;
    }
    let glued = faces.iter().filter_map(|face| walls.get(face)).min();
    let surface = Place::Surface(template.triangles[faces[0] as usize].marker);
    glued.copied().unwrap_or(surface)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::Triangle;

    #[test]
    fn angles_are_those_of_the_material() {
        // A tetrahedron that is flat at its first edge, and the same as a void in something else.
        let vertices = vec![
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(0.5, 1.0, 0.0),
            DVec3::new(0.5, 1.0, 0.1),
        ];
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        let of = |front: u32, back: u32| Template {
            vertices: vertices.clone(),
            triangles: faces
                .map(|vertices| Triangle {
                    vertices,
                    marker: 7,
                    front,
                    back,
                })
                .to_vec(),
            ..Template::default()
        };
        let solid = sharp_edges((0, &of(OUTSIDE, 1)), 10.0);
        assert_eq!(solid.len(), 1);
        assert!((solid[0].angle - 0.1_f64.atan().to_degrees()).abs() < 1e-12);
        assert_eq!(solid[0].middle, DVec3::new(0.5, 0.0, 0.0));
        assert_eq!(solid[0].place, Place::Surface(7));
        assert_eq!(sharp_edges((0, &of(1, OUTSIDE)), 10.0), []);
    }
}
