//! How thick the walls of a body are, and the sizes for so many elements across them.
//!
//! Each triangle of the surface is divided until its parts are no wider than the wall is thick below them. There the distance
//! through the material to what is opposite is divided by the number of elements. A ray that meets a face glued to its image goes
//! on from there, as the material does.

use crate::tree::Source;
use geom::measure::{double_area_vector, triangle_area};
use geom::tree::Rays;
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{Isometry, OUTSIDE, Template};

/// Least cosine of the angle between the directions in which the two faces of a wall look: 30 degrees, from which on faces that meet
/// are told apart as well. What is steeper is an edge of the body, not a wall.
const OPPOSITE: f64 = 0.866_025_403_784_438_6;

/// A wall that gets thinner is followed down to this share of its thickness below the middle of a facet, as no number of elements
/// fits into the edge in which it may end. A choice: each halving of it doubles the elements along such an edge.
const THINNEST: f64 = 0.25;

/// Size of elements over the thickness for each element across. Edges differ in length: on the shortest ways through walls there were
/// 0.91 to 0.99 times as many in the mean as the size fits into the thickness, on flat ratchets of `body` with two to six asked for.
const SHARE: f64 = 0.9;

/// Places that are looked at, at most, which takes some seconds. Each of them becomes a cube of elements or more, so that what is beyond has
/// millions of them.
const MOST: usize = 1 << 20;

/// What walls ask for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Across {
    /// Boxes about parts of walls, each with a size.
    pub sources: Vec<Source>,
    /// Cubes of the size that walls hold, about.
    pub cubes: f64,
}

/// A place in a wall: how thick that is, model units, and where.
pub type Thinnest = (f64, DVec3);

/// Sizes for at least `layers` elements across the walls of a template, the `index`th of a document with so many `copies` of all
/// templates.
///
/// # Errors
/// The thinnest place seen, where that takes more places than can be looked at.
pub fn across_walls(
    (template, index): (&Template, usize),
    copies: usize,
    layers: f64,
) -> Result<Across, Thinnest> {
    let triangles = corners_of(template);
    let walls = Walls::new((template, index), &triangles, copies);
    let mut across = Across::default();
    let mut merged = Merged::default();
    let mut looked_at = 0;
    let mut thinnest = (f64::INFINITY, DVec3::ZERO);
    for (t, triangle) in (0..).zip(&template.triangles) {
        let corners = triangle.vertices.map(|v| template.vertices[v as usize]);
        for inward in walls.inward(t) {
            let Some((first, _)) = walls.thickness(t, middle(corners), inward) else {
                continue;
            };
            let least = THINNEST * first;
            let mut open = vec![corners];
            while let Some(part) = open.pop() {
                looked_at += 1;
                if looked_at > MOST {
                    return Err(thinnest);
                }
                let Some((thickness, is_wall)) = walls.thickness(t, middle(part), inward) else {
                    continue;
                };
                if is_wall && thickness < thinnest.0 {
                    thinnest = (thickness, middle(part));
                }
                // Beside an edge of the body it gets as thin as one likes without a wall.
                let thickness = thickness.max(if is_wall { least } else { first });
                if longest(part) > thickness {
                    open.extend(halves(part));
                } else if is_wall {
                    let size = SHARE * thickness / layers;
                    let all = || part.into_iter().chain(part.map(|p| p + inward * thickness));
                    // By an element more, so that boxes beside each other overlap.
                    let source = Source {
                        ends: [
                            all().fold(DVec3::INFINITY, DVec3::min) - size,
                            all().fold(DVec3::NEG_INFINITY, DVec3::max) + size,
                        ],
                        size,
                    };
                    merged.add(source, thickness, &mut across.sources);
                    let [a, b, c] = part;
                    // The other face of the wall sees it, too.
                    across.cubes += 0.5 * triangle_area(a, b, c) * thickness / size.powi(3);
                }
            }
        }
    }
    Ok(across)
}

/// How thick walls are at each vertex of a template, model units: the least distance through the material below the middle of a triangle
/// there to what looks the other way; infinite where nothing does. n log n.
pub fn thickness((template, index): (&Template, usize), copies: usize) -> Vec<f64> {
    let triangles = corners_of(template);
    let walls = Walls::new((template, index), &triangles, copies);
    let mut thickness = vec![f64::INFINITY; template.vertices.len()];
    for (t, triangle) in (0..).zip(&template.triangles) {
        let middle = middle(triangle.vertices.map(|v| template.vertices[v as usize]));
        for inward in walls.inward(t) {
            if let Some((distance, true)) = walls.thickness(t, middle, inward) {
                for v in triangle.vertices {
                    let known = &mut thickness[v as usize];
                    *known = known.min(distance);
                }
            }
        }
    }
    thickness
}

fn corners_of(template: &Template) -> Vec<[u32; 3]> {
    template.triangles.iter().map(|t| t.vertices).collect()
}

/// Sources of about one size in about one place, which are one: both faces of a wall tell of it, and several parts of each.
#[derive(Default)]
struct Merged(FxHashMap<(i32, [i64; 3]), usize>);

impl Merged {
    /// Adds a source of a wall to a list, or to one that is there.
    fn add(&mut self, source: Source, thickness: f64, sources: &mut Vec<Source>) {
        let exponent = thickness.log2().floor();
        let width = exponent.exp2();
        let middle = 0.5 * (source.ends[0] + source.ends[1]);
        let cell = (middle / width).floor().to_array().map(|x| x as i64);
        let at = *self
            .0
            .entry((exponent as i32, cell))
            .or_insert(sources.len());
        match sources.get_mut(at) {
            Some(known) => {
                known.ends[0] = known.ends[0].min(source.ends[0]);
                known.ends[1] = known.ends[1].max(source.ends[1]);
                known.size = known.size.min(source.size);
            }
            None => sources.push(source),
        }
    }
}

/// Where what is beyond a glued face is: the triangle that it is glued to, and the isometry that takes this side there. `None` for
/// faces of other templates.
fn beyond(template: &Template, index: usize) -> FxHashMap<u32, Option<(u32, Isometry)>> {
    let mut beyond = FxHashMap::default();
    for gluing in &template.gluings {
        let own = gluing.other_than(index).is_none();
        for &[here, there] in &gluing.triangle_pairs {
            let inverse = gluing.step.inverse();
            beyond.insert(here, own.then_some((there, inverse)));
            if own && here != there {
                beyond.insert(there, Some((here, gluing.step)));
            }
        }
    }
    beyond
}

/// The surface of a template.
struct Walls<'a> {
    template: &'a Template,
    triangles: &'a [[u32; 3]],
    rays: Rays<'a>,
    beyond: FxHashMap<u32, Option<(u32, Isometry)>>,
    most_crossed: usize,
}

impl<'a> Walls<'a> {
    fn new(
        (template, index): (&'a Template, usize),
        triangles: &'a [[u32; 3]],
        copies: usize,
    ) -> Self {
        Self {
            template,
            triangles,
            rays: Rays::new(&template.vertices, triangles),
            beyond: beyond(template, index),
            // A straight line passes half a turn about the axis at most, and its mirror image.
            most_crossed: copies + 2,
        }
    }

    /// The sides of a triangle on which there is material, each with the direction into it; none of faces that are glued.
    fn inward(&self, t: u32) -> impl Iterator<Item = DVec3> {
        let triangle = &self.template.triangles[t as usize];
        let [a, b, c] = triangle
            .vertices
            .map(|v| self.template.vertices[v as usize]);
        let normal = double_area_vector(a, b, c).normalize_or_zero();
        let is_face = normal != DVec3::ZERO && !self.beyond.contains_key(&t);
        let sides = [(triangle.front, normal), (triangle.back, -normal)].into_iter();
        sides
            .filter(move |side| is_face && side.0 != OUTSIDE)
            .map(|side| side.1)
    }

    /// The distance from a point of a triangle through the material to what is opposite, and whether that looks the other way. `None`
    /// where a ray leaves the template.
    fn thickness(&self, triangle: u32, from: DVec3, direction: DVec3) -> Option<(f64, bool)> {
        let (mut from, mut direction, mut except) = (from, direction, triangle);
        let mut distance = 0.0;
        for _ in 0..self.most_crossed {
            let (passed, hit) = self.rays.met(from, direction, except)?;
            distance += passed;
            match self.beyond.get(&hit) {
                Some(&Some((image, step))) => {
                    let place = step.placed();
                    let met = from + direction * passed;
                    (from, direction) = (place.apply(met), place.apply(direction));
                    except = image;
                }
                Some(None) => return None,
                None => {
                    let [a, b, c] =
                        self.triangles[hit as usize].map(|v| self.template.vertices[v as usize]);
                    let normal = double_area_vector(a, b, c).normalize_or_zero();
                    return Some((distance, normal.dot(direction).abs() >= OPPOSITE));
                }
            }
        }
        None
    }
}

fn middle([a, b, c]: [DVec3; 3]) -> DVec3 {
    (a + b + c) / 3.0
}

fn longest([a, b, c]: [DVec3; 3]) -> f64 {
    a.distance(b).max(b.distance(c)).max(c.distance(a))
}

/// The halves of a triangle beside the middle of its longest edge.
fn halves([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 2] {
    let [ab, bc, ca] = [a.distance(b), b.distance(c), c.distance(a)];
    let [a, b, c] = match ab.max(bc).max(ca) {
        most if most == ab => [a, b, c],
        most if most == bc => [b, c, a],
        _ => [c, a, b],
    };
    let middle = 0.5 * (a + b);
    [[a, middle, c], [middle, b, c]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{Gluing, Triangle};

    /// A box of these lengths from the origin on, whose face y = 0 is a mirror wall.
    fn half(lengths: [f64; 3]) -> Template {
        let corner = |i: usize| {
            let at = |axis: usize| {
                if i >> axis & 1 == 1 {
                    lengths[axis]
                } else {
                    0.0
                }
            };
            DVec3::new(at(0), at(1), at(2))
        };
        // Outward, the wall first.
        let faces = [
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangle = |vertices| Triangle {
            vertices,
            marker: 0,
            front: OUTSIDE,
            back: 1,
        };
        let mut template = Template {
            vertices: (0..8).map(corner).collect(),
            triangles: faces
                .iter()
                .flat_map(|&[a, b, c, d]| [triangle([a, b, c]), triangle([a, c, d])])
                .collect(),
            ..Template::default()
        };
        let wall = Gluing::mirror("wall", 0, Isometry::MIRROR, [0, 1, 4, 5], [0, 1]);
        template.gluings.push(wall);
        template
    }

    fn sizes(template: &Template, layers: f64) -> Vec<f64> {
        let across = across_walls((template, 0), 2, layers).unwrap();
        across.sources.iter().map(|s| s.size).collect()
    }

    #[test]
    fn walls_go_on_beyond_a_mirror() {
        // The whole is 1 x 0.2 x 1: twice as thick as its half.
        let found = sizes(&half([1.0, 0.1, 1.0]), 2.0);
        let least = found.iter().copied().fold(f64::INFINITY, f64::min);
        assert!((least - SHARE * 0.2 / 2.0).abs() < 1e-12, "{least}");
        // A long bar is as thick as it is high.
        let found = sizes(&half([10.0, 3.0, 0.5]), 1.0);
        let least = found.iter().copied().fold(f64::INFINITY, f64::min);
        assert!((least - SHARE * 0.5).abs() < 1e-12, "{least}");
        assert!(found.len() > 20 && found.len() < 2000, "{}", found.len());
    }

    #[test]
    fn vertices_know_how_thick_their_wall_is() {
        // Half of a plate: with its image, 1 x 0.2 x 1. Its middle is on the narrow sides alone.
        let plate = half([1.0, 0.1, 1.0]);
        let found = thickness((&plate, 0), 2);
        for (p, t) in plate.vertices.iter().zip(&found) {
            let expected = if p.y > 0.0 { 0.2 } else { 1.0 };
            assert!((t - expected).abs() < 1e-12, "{p}: {t}");
        }
        // Behind a wall that belongs to another template there is no telling.
        let mut other = half([1.0, 0.1, 1.0]);
        other.gluings[0].other = 1;
        let found = thickness((&other, 0), 2);
        assert!(found.iter().all(|t| (t - 1.0).abs() < 1e-12), "{found:?}");
    }

    #[test]
    fn what_is_far_too_thin_is_refused_with_its_place() {
        let film = half([1.0, 1.0, 1e-5]);
        let (thickness, near) = across_walls((&film, 0), 2, 2.0).unwrap_err();
        assert!((thickness / 1e-5 - 1.0).abs() < 1e-9, "{thickness}");
        assert!(near.x > 0.0 && near.x < 1.0);
    }
}
