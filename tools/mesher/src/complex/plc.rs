//! The piecewise linear complex that the mesher is given for a template.

use super::description::{Description, Order, mixed};
use super::facets::{Facets, Flat};
use super::flat::flatten;
use super::relief::Relief;
use super::seeds::{Seed, seeds};
use crate::faces::Faces;
use crate::{Error, Piece, Sizes};
use geom::edges::Edges;
use geom::tolerance::{Extent, Tolerance};
use glam::DVec3;
use sizing::Graded;
use tmesh::{Document, OUTSIDE, Template};

/// A point in a cell, with the size wanted there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizeSeed {
    /// The point, scaled.
    pub point: [f64; 3],
    /// Number of the cell's region.
    pub number: u32,
    /// Largest volume, the mesher's unit cubed.
    pub max_volume: Option<f64>,
}

/// A template in the mesher's terms. Lengths are scaled by a power of two, so that coordinates are near
/// one (models come in metres and in nanometres) and no bit of them changes.
#[derive(Default)]
pub struct Plc {
    /// The template's number, for messages.
    pub template: usize,
    /// The mesher's length unit per model unit.
    pub scale: f64,
    /// Template vertex of each point.
    pub vertex_of_point: Vec<u32>,
    /// Scaled positions; those on walls are exactly coplanar (see [`super::flat`]).
    pub points: Vec<[f64; 3]>,
    /// How far positions differ from the template's, at most; model units.
    pub shift: f64,
    /// Facets, not on faces glued to the template itself, with vertices that were shifted.
    pub shifted: Vec<bool>,
    /// Point numbers.
    pub triangles: Vec<[i32; 3]>,
    /// Marker of each triangle: one more than its facet.
    pub markers: Vec<i32>,
    /// A point in each void.
    pub holes: Vec<[f64; 3]>,
    /// Sizes of single cells; none where no region has one.
    pub sizes: Vec<SizeSeed>,
    /// Facets; the marker of facet `f` is `f + 1`.
    pub facets: Facets,
    /// The shape of those that are uneven.
    pub relief: Relief,
    /// Wall faces of the template's triangles.
    pub faces: Faces,
    /// Largest coordinate, model units.
    pub extent: f64,
    /// What computing may lose, model units; see [`Tolerance::rounding`].
    pub rounding: f64,
    /// Length of edges that changes from place to place, scaled.
    pub graded: Option<Graded>,
}

impl Plc {
    /// Describes a template.
    ///
    /// # Errors
    /// [`Error::NoSurface`], and what is said about surfaces that bound nothing.
    pub fn new(piece: Piece<'_>, sizes: &Sizes, description: Description) -> Result<Self, Error> {
        let Piece {
            document,
            index,
            template,
            apart,
        } = piece;
        let corners: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
        if corners.len() < 4 {
            return Err(Error::NoSurface { template: index });
        }
        let (vertex_of_point, point_of_vertex) =
            used(template.vertices.len(), &corners, description.order);
        let (low, high) = vertex_of_point
            .iter()
            .map(|&v| template.vertices[v as usize])
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| {
                (l.min(p), h.max(p))
            });
        let diagonal = (high - low).length();
        let edges = Edges::new(&corners);
        let seeds = seeds(index, template, &corners, &edges)?;
        let faces = Faces::new(piece);
        let precision = document.source.as_ref().map_or(0.0, |s| s.precision);
        let extent = Extent::about(&template.vertices, DVec3::ZERO, DVec3::Z);
        let tolerance = Tolerance::new(extent, precision, 0.0);
        let flat = tolerance.flat();
        let flat = match description.apart {
            true => Flat {
                walls: flat,
                ..Flat::default()
            },
            false => Flat {
                walls: flat,
                elsewhere: flat,
                folds: document.unevenness(),
            },
        };
        let facets = Facets::new(template, &edges, (&faces.of_triangle, apart), flat);
        let relief = Relief::new(template, &facets, flat.elsewhere);
        let mut order: Vec<usize> = (0..corners.len()).collect();
        description.order.apply(&mut order);
        let mut plc = Self {
            template: index,
            scale: power_of_two_near(diagonal),
            extent: low.abs().max(high.abs()).max_element(),
            rounding: tolerance.rounding(),
            triangles: order
                .iter()
                .map(|&t| corners[t])
                .map(|t| t.map(|v| point_of_vertex[v as usize] as i32))
                .collect(),
            markers: order
                .iter()
                .map(|&t| facets.of_triangle[t] as i32 + 1)
                .collect(),
            vertex_of_point,
            facets,
            relief,
            faces,
            ..Self::default()
        };
        plc.place_points(template, &point_of_vertex, description);
        plc.place_seeds(document, sizes, &seeds);
        Ok(plc)
    }

    /// Gives points their positions, and notes which facets they have left.
    fn place_points(
        &mut self,
        template: &Template,
        point_of_vertex: &[u32],
        description: Description,
    ) {
        let scaled = |v: u32| (template.vertices[v as usize] * self.scale).to_array();
        let mut points: Vec<[f64; 3]> = self.vertex_of_point.iter().map(|&v| scaled(v)).collect();
        if let Some(size) = description.stir {
            for (&v, p) in self.vertex_of_point.iter().zip(&mut points) {
                // What is zero keeps points in the plane of a mirror across the axis.
                for (axis, x) in p.iter_mut().enumerate().filter(|(_, x)| **x != 0.0) {
                    let random = mixed(3 * u64::from(v) + axis as u64);
                    *x += size * (random as f64 / u64::MAX as f64 - 0.5);
                }
            }
        }
        for plane in self.faces.planes.iter().filter(|_| description.flat) {
            let [cos, sin] = plane.direction;
            // Seams are paired exactly only where they are walls: a vertex elsewhere may be listed.
            let near = |p: &usize| {
                let [x, y, _] = scaled(self.vertex_of_point[*p]);
                (y * cos - x * sin).abs() <= self.rounding * self.scale
            };
            let listed = plane.vertices.iter();
            let used = listed.map(|&v| point_of_vertex[v as usize] as usize);
            let on: Vec<usize> = used.filter(|&p| p < points.len()).filter(near).collect();
            flatten(&mut points, &on, cos, sin);
        }
        let moved = |(&v, p): (&u32, &[f64; 3])| {
            let before = DVec3::from_array(scaled(v));
            DVec3::from_array(*p).distance(before)
        };
        let moved = self.vertex_of_point.iter().zip(&points).map(moved);
        let shift = moved.fold(0.0, f64::max);
        self.shifted = vec![false; self.facets.facets.len()];
        for (t, &facet) in template.triangles.iter().zip(&self.facets.of_triangle) {
            let moved = |&v: &u32| points[point_of_vertex[v as usize] as usize] != scaled(v);
            self.shifted[facet as usize] |= t.vertices.iter().any(moved);
        }
        for (shifted, facet) in self.shifted.iter_mut().zip(&self.facets.facets) {
            // Walls have a plane of their own to be put back onto.
            let has_own = self.faces.is_glued_to_itself(facet.attributes.face);
            *shifted &= !has_own && facet.normal != DVec3::ZERO;
        }
        self.shift = shift / self.scale;
        self.points = points;
    }

    /// Says where voids are, and which sizes are wanted where.
    fn place_seeds(&mut self, document: &Document, sizes: &Sizes, seeds: &[Seed]) {
        let number = |id: u32| document.regions.binary_search_by_key(&id, |r| r.id).ok();
        let cube = self.scale * self.scale * self.scale;
        let local = sizes.local.get(self.template).and_then(Option::as_ref);
        self.graded = local.map(|local| local.graded.scaled(self.scale));
        let is_sized = |s: &Seed| number(s.region).is_some_and(|r| sizes.of_region[r].is_some());
        let are_sized = seeds.iter().any(is_sized);
        for seed in seeds {
            let point = (seed.point * self.scale).to_array();
            if seed.region == OUTSIDE {
                self.holes.push(point);
            } else if let Some(r) = number(seed.region).filter(|_| are_sized) {
                self.sizes.push(SizeSeed {
                    point,
                    number: r as u32,
                    max_volume: sizes.of_region[r].map(|v| v * cube),
                });
            }
        }
    }

    /// Model position of a scaled point.
    pub fn to_model(&self, p: [f64; 3]) -> DVec3 {
        // Exact: the scale is a power of two.
        DVec3::from_array(p) / self.scale
    }

    /// Middle of a triangle given to the mesher, model units.
    pub fn middle(&self, triangle: usize) -> DVec3 {
        let corners = self.triangles[triangle].map(|v| self.to_model(self.points[v as usize]));
        corners.iter().sum::<DVec3>() / 3.0
    }
}

/// Vertices that triangles use, in the order asked for, and the place of each in that list.
fn used(vertices: usize, corners: &[[u32; 3]], order: Order) -> (Vec<u32>, Vec<u32>) {
    let mut place = vec![u32::MAX; vertices];
    for &v in corners.iter().flatten() {
        place[v as usize] = 0;
    }
    let mut list: Vec<u32> = (0..vertices as u32)
        .filter(|&v| place[v as usize] == 0)
        .collect();
    order.apply(&mut list);
    for (i, &v) in list.iter().enumerate() {
        place[v as usize] = i as u32;
    }
    (list, place)
}

/// A power of two that brings `size` into [1, 2); 1 for sizes without one.
fn power_of_two_near(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() {
        // Within bounds where the cube of the scale is still a normal number.
        let exponent = libm::ilogb(size).clamp(-300, 300);
        libm::scalbn(1.0, -exponent)
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_powers_of_two() {
        for size in [1e-6, 0.99, 1.0, 1.01, 2.0, 1e6, 1e-80, 3e5] {
            let scale = power_of_two_near(size);
            assert!((1.0..2.0).contains(&(size * scale)), "{size} {scale}");
            assert_eq!(scale.to_bits() & ((1 << 52) - 1), 0);
            let x = size * 0.1;
            assert_eq!((x * scale) / scale, x);
        }
        assert_eq!(power_of_two_near(0.0), 1.0);
    }
}
