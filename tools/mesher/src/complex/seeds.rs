//! Points inside the cells of a surface, computed from its triangles' two sides.

use crate::Error;
use crate::error::{Place, RegionName};
use geom::edges::Edges;
use geom::measure::double_area_vector;
use geom::sides::{SideComponents, side_components};
use geom::tree::Rays;
use glam::DVec3;
use tmesh::{OUTSIDE, Template};

/// A point inside a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seed {
    /// The point, model units.
    pub point: DVec3,
    /// The cell's region; [`OUTSIDE`] for a void.
    pub region: u32,
}

/// Checks that the triangles around each cell agree about its region, and returns a point inside
/// every bounded cell, once per connected piece of the cell's boundary.
///
/// The point lies half way between the roundest triangle of the piece and what a ray along its
/// normal meets next, so no facet is between it and the triangle.
///
/// # Errors
/// [`Error::Open`], [`Error::MixedCell`], [`Error::Unbounded`].
pub fn seeds(
    index: usize,
    template: &Template,
    corners: &[[u32; 3]],
    edges: &Edges,
) -> Result<Vec<Seed>, Error> {
    check_open(index, template, edges)?;
    let sides = side_components(&template.vertices, corners, edges);
    let regions = regions(index, template, &sides)?;
    let best = roundest(template, &sides);
    let rays = Rays::new(&template.vertices, corners);
    let mut seeds = Vec::new();
    for (&region, &(side, _)) in regions.iter().zip(&best) {
        let triangle = side / 2;
        let [a, b, c] = corners[triangle].map(|v| template.vertices[v as usize]);
        let Some(normal) = double_area_vector(a, b, c).try_normalize() else {
            continue;
        };
        let direction = if side % 2 == 0 { normal } else { -normal };
        let weights = [(b - c).length(), (c - a).length(), (a - b).length()];
        let incentre = (a * weights[0] + b * weights[1] + c * weights[2])
            / (weights[0] + weights[1] + weights[2]);
        match rays.first(incentre, direction, triangle as u32) {
            Some(distance) => seeds.push(Seed {
                point: incentre + direction * (0.5 * distance),
                region,
            }),
            None if region == OUTSIDE => {}
            None => {
                return Err(Error::Unbounded {
                    template: index,
                    region: RegionName(region),
                    place: Place(incentre),
                });
            }
        }
    }
    Ok(seeds)
}

/// An edge with a single triangle borders nothing, unless the triangle is a sheet inside a region.
fn check_open(index: usize, template: &Template, edges: &Edges) -> Result<(), Error> {
    let mut open = 0;
    let mut first = None;
    for edge in 0..edges.len() {
        if let [only] = edges.around(edge) {
            let t = &template.triangles[only.triangle as usize];
            if t.front != t.back {
                open += 1;
                let [a, b] = edges.ends[edge].map(|v| template.vertices[v as usize]);
                first.get_or_insert(0.5 * (a + b));
            }
        }
    }
    match first {
        Some(place) => Err(Error::Open {
            template: index,
            edges: open,
            place: Place(place),
        }),
        None => Ok(()),
    }
}

/// Region of each component of sides.
fn regions(index: usize, template: &Template, sides: &SideComponents) -> Result<Vec<u32>, Error> {
    let mut regions: Vec<Option<u32>> = vec![None; sides.count];
    for (i, t) in template.triangles.iter().enumerate() {
        for (component, region) in [(sides.front(i), t.front), (sides.back(i), t.back)] {
            let known = *regions[component as usize].get_or_insert(region);
            if known != region {
                let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
                return Err(Error::MixedCell {
                    template: index,
                    first: RegionName(known),
                    second: RegionName(region),
                    place: Place((a + b + c) / 3.0),
                });
            }
        }
    }
    Ok(regions.into_iter().map(|r| r.unwrap_or(OUTSIDE)).collect())
}

/// For each component the side (`2 t` front, `2 t + 1` back) of the triangle with the largest
/// inscribed circle, and its radius.
fn roundest(template: &Template, sides: &SideComponents) -> Vec<(usize, f64)> {
    let mut best = vec![(0, -1.0); sides.count];
    for (i, t) in template.triangles.iter().enumerate() {
        let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
        let perimeter = (b - a).length() + (c - b).length() + (a - c).length();
        let radius = if perimeter > 0.0 {
            double_area_vector(a, b, c).length() / perimeter
        } else {
            0.0
        };
        for side in [2 * i, 2 * i + 1] {
            let entry = &mut best[sides.component[side] as usize];
            if radius > entry.1 {
                *entry = (side, radius);
            }
        }
    }
    best
}
