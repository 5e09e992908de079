//! The piecewise linear complex that TetGen is given for a template.

use crate::facets::Facets;
use crate::flat::flatten;
use crate::seeds::seeds;
use crate::walls::{Faces, vertical_planes};
use crate::{Error, Sizes};
use geom::edges::Edges;
use glam::DVec3;
use tetgen_sys::{Complex, RegionSeed};
use tmesh::{Document, OUTSIDE};

/// Facets may be uneven by this part of the body's diagonal, or by a few times the input's
/// precision where that is more.
const FLATNESS: f64 = 1e-9;
const PRECISIONS: f64 = 4.0;

/// Order in which TetGen is given points and triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// That of the template.
    AsGiven,
    /// Back to front.
    Reversed,
    /// Second half first.
    FromTheMiddle,
    /// In no order, but always the same; a number for each.
    Shuffled(u64),
}

impl Order {
    fn apply<T: Copy>(self, list: &mut [T]) {
        match self {
            Self::AsGiven => {}
            Self::Reversed => list.reverse(),
            Self::FromTheMiddle => list.rotate_left(list.len() / 2),
            Self::Shuffled(seed) => {
                let mut order: Vec<usize> = (0..list.len()).collect();
                order.sort_unstable_by_key(|&i| mixed(i as u64 + (seed << 32)));
                let shuffled: Vec<T> = order.into_iter().map(|i| list[i]).collect();
                list.copy_from_slice(&shuffled);
            }
        }
    }
}

/// A number that looks random, the same on every machine (splitmix64, S. Vigna, public domain).
fn mixed(number: u64) -> u64 {
    let z = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// One of the equivalent descriptions of a template.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description {
    /// Order of triangles.
    pub order: Order,
    /// Whether walls are made exactly coplanar; see [`crate::flat`].
    pub flat: bool,
    /// Where the whole surface is preserved: how far points are moved at random, in TetGen's unit (the
    /// diagonal is from 1 to 2). Many cospherical points, as symmetric ones are, make TetGen lose its
    /// way.
    pub stir: Option<f64>,
    /// Points from which on TetGen inserts them in random rounds, instead of the 64 it takes; below that the
    /// order depends on where the points are alone, and is the same for all descriptions.
    pub rounds_from: Option<u32>,
    /// Whether triangles off the walls are facets of their own unless they are exactly coplanar: nothing is
    /// uneven then, but their edges all stay.
    pub apart: bool,
}

/// Descriptions in the order in which they are tried.
///
/// Where layers are thin, TetGen's own points on segments are coplanar up to rounding only, and some
/// of its assertions fail by bad luck; so does its walk through the Delaunay mesh of symmetric points
/// in some of their orders. Another description of the same surface is another draw: of
/// 32 open vias with films of 1e-4 to 7e-4 at orders 7 to 64, turned at random, the first failed for
/// 2, the second for none, the third for 5, and with walls as they are 4 to 9 failed.
pub const DESCRIPTIONS: [Description; 8] = [
    Description {
        order: Order::AsGiven,
        flat: true,
        stir: None,
        rounds_from: None,
        apart: false,
    },
    Description {
        order: Order::Reversed,
        flat: true,
        stir: Some(1e-11),
        rounds_from: None,
        apart: false,
    },
    Description {
        order: Order::FromTheMiddle,
        flat: true,
        stir: Some(1e-9),
        rounds_from: Some(4),
        apart: false,
    },
    Description {
        order: Order::AsGiven,
        flat: false,
        stir: None,
        rounds_from: None,
        apart: false,
    },
    Description {
        order: Order::Shuffled(1),
        flat: true,
        stir: Some(1e-12),
        rounds_from: Some(1),
        apart: false,
    },
    Description {
        order: Order::Shuffled(2),
        flat: false,
        stir: Some(1e-10),
        rounds_from: Some(8),
        apart: false,
    },
    Description {
        order: Order::AsGiven,
        flat: true,
        stir: None,
        rounds_from: None,
        apart: true,
    },
    Description {
        order: Order::Shuffled(3),
        flat: true,
        stir: Some(1e-11),
        rounds_from: Some(4),
        apart: true,
    },
];

/// A template in TetGen's terms. Lengths are scaled by a power of two, so that coordinates are near
/// one (models come in metres and in nanometres) and no bit of them changes.
pub struct Plc {
    /// TetGen's length unit per model unit.
    pub scale: f64,
    /// Template vertex of each point.
    pub vertex_of_point: Vec<u32>,
    /// Scaled positions; those on walls are exactly coplanar (see [`crate::flat`]).
    pub points: Vec<[f64; 3]>,
    /// How far positions differ from the template's, at most; model units.
    pub shift: f64,
    /// Facets, not on walls through the axis, with vertices that were shifted.
    pub shifted: Vec<bool>,
    triangles: Vec<[i32; 3]>,
    markers: Vec<i32>,
    holes: Vec<[f64; 3]>,
    regions: Vec<RegionSeed>,
    /// Facets; the marker of facet `f` is `f + 1`.
    pub facets: Facets,
    /// Wall faces of the template's triangles.
    pub faces: Faces,
    /// Largest coordinate, model units.
    pub extent: f64,
    /// Limit that holds in all regions, TetGen's unit cubed.
    pub max_volume: Option<f64>,
    /// Whether seeds carry limits for single regions.
    pub per_region: bool,
}

impl Plc {
    /// Describes template `index`.
    ///
    /// # Errors
    /// [`Error::NoSurface`], and what [`seeds`] says about surfaces that bound nothing.
    pub fn new(
        document: &Document,
        index: usize,
        sizes: &Sizes,
        description: Description,
    ) -> Result<Self, Error> {
        let template = &document.templates[index];
        let corners: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
        if corners.len() < 4 {
            return Err(Error::NoSurface { template: index });
        }
        let (vertex_of_point, point_of_vertex) =
            used(template.vertices.len(), &corners, description.order);
        let position = |&v: &u32| template.vertices[v as usize];
        let (low, high) = vertex_of_point
            .iter()
            .map(position)
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| {
                (l.min(p), h.max(p))
            });
        let extent = low.abs().max(high.abs()).max_element();
        let diagonal = (high - low).length();
        let scale = power_of_two_near(diagonal);

        let edges = Edges::new(&corners);
        let seeds = seeds(index, template, &corners, &edges)?;
        let faces = Faces::new(document, index);
        let precision = document.source.as_ref().map_or(0.0, |s| s.precision);
        let tolerance = (FLATNESS * diagonal).max(PRECISIONS * precision);
        let elsewhere = if description.apart { 0.0 } else { tolerance };
        let facets = Facets::new(template, &edges, &faces.of_triangle, [tolerance, elsewhere]);

        let mut points: Vec<[f64; 3]> = vertex_of_point
            .iter()
            .map(|v| (position(v) * scale).to_array())
            .collect();
        if let Some(size) = description.stir.filter(|_| faces.preserve()) {
            for (i, p) in points.iter_mut().enumerate() {
                for (axis, x) in p.iter_mut().enumerate() {
                    let random = mixed(3 * u64::from(vertex_of_point[i]) + axis as u64);
                    *x += size * (random as f64 / u64::MAX as f64 - 0.5);
                }
            }
        }
        let place =
            |v: u32| Some(point_of_vertex[v as usize] as usize).filter(|&p| p < points.len());
        let planes: Vec<([f64; 2], Vec<usize>)> = vertical_planes(template, index)
            .into_iter()
            .map(|(angle, list)| (angle, list.into_iter().filter_map(place).collect()))
            .collect();
        let mut shift = 0.0_f64;
        for ([cos, sin], list) in planes.iter().filter(|_| description.flat) {
            // Seams are paired exactly only where they are walls: a vertex elsewhere may be listed.
            let on: Vec<usize> = list
                .iter()
                .copied()
                .filter(|&p| {
                    let [x, y, _] = points[p];
                    (y * cos - x * sin).abs() <= FLATNESS
                })
                .collect();
            shift = shift.max(flatten(&mut points, &on, *cos, *sin));
        }
        let mut shifted = vec![false; facets.facets.len()];
        for (t, &facet) in corners.iter().zip(&facets.of_triangle) {
            let moved = |v: &u32| {
                let now = points[point_of_vertex[*v as usize] as usize];
                now != (position(v) * scale).to_array()
            };
            shifted[facet as usize] |= t.iter().any(moved);
        }
        for (shifted, facet) in shifted.iter_mut().zip(&facets.facets) {
            let wall = facet.attributes.face.checked_sub(1).map(|k| k as usize / 2);
            // Walls through the axis have a plane of their own to be put back onto.
            let upright = wall.is_some_and(|w| {
                template
                    .gluings
                    .get(w)
                    .is_some_and(|g| g.other_than(index).is_none())
            });
            *shifted &= !upright && facet.normal != DVec3::ZERO;
        }
        let shift = shift / scale;

        let region_index = |id: u32| document.regions.binary_search_by_key(&id, |r| r.id).ok();
        let mut present: Vec<usize> = seeds
            .iter()
            .filter_map(|s| region_index(s.region))
            .collect();
        present.sort_unstable();
        present.dedup();
        let per_region = sizes.differ(&present);
        let cube = scale * scale * scale;
        let regions = seeds
            .iter()
            .filter(|s| per_region && s.region != OUTSIDE)
            .filter_map(|s| {
                let r = region_index(s.region)?;
                Some(RegionSeed {
                    point: (s.point * scale).to_array(),
                    attribute: r as f64,
                    max_volume: sizes.of_region[r].map_or(-1.0, |v| v * cube),
                })
            })
            .collect();
        let holes = seeds
            .iter()
            .filter(|s| s.region == OUTSIDE)
            .map(|s| (s.point * scale).to_array())
            .collect();
        let mut order: Vec<usize> = (0..corners.len()).collect();
        description.order.apply(&mut order);
        Ok(Self {
            scale,
            points,
            shift,
            shifted,
            vertex_of_point,
            triangles: order
                .iter()
                .map(|&t| corners[t])
                .map(|t| t.map(|v| point_of_vertex[v as usize] as i32))
                .collect(),
            markers: order
                .iter()
                .map(|&t| facets.of_triangle[t] as i32 + 1)
                .collect(),
            holes,
            regions,
            facets,
            faces,
            extent,
            max_volume: sizes.loosest(&present).map(|v| v * cube),
            per_region,
        })
    }

    /// The complex, as the binding takes it.
    pub fn complex(&self) -> Complex<'_> {
        Complex {
            points: &self.points,
            triangles: &self.triangles,
            markers: &self.markers,
            holes: &self.holes,
            regions: &self.regions,
        }
    }

    /// Model position of a scaled point.
    pub fn to_model(&self, p: [f64; 3]) -> DVec3 {
        // Exact: the scale is a power of two.
        DVec3::from_array(p) / self.scale
    }

    /// Middle of a triangle given to TetGen, model units.
    pub fn middle(&self, triangle: usize) -> DVec3 {
        let corners = self.triangles[triangle].map(|v| self.to_model(self.points[v as usize]));
        corners.iter().sum::<DVec3>() / 3.0
    }

    /// Number of voids to be left empty.
    pub fn hole_count(&self) -> usize {
        self.holes.len()
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
