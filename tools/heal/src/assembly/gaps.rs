//! Gaps that stay between solids.
//!
//! Two solids have a gap between them where facets of both look at each other, with nothing in between, and are nearer to
//! each other than either of them is wide: so near are solids that were meant to touch, and those that leave room for a
//! layer of air, where elements are small.

use crate::imprint::{crossing, is_over};
use geom::measure::double_area_vector;
use geom::smooth::SMOOTH_COSINE;
use geom::tree::pairs;
use glam::DVec3;
use std::collections::BTreeMap;
use tmesh::{Document, OUTSIDE, Template};

/// A gap between two solids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// The regions of both, the lower one first.
    pub regions: [u32; 2],
    /// How far apart they are where they are nearest, model units.
    pub width: f64,
    /// The middle between them there.
    pub near: DVec3,
}

/// The gaps between the regions of a surface, one for each pair of regions that has any, the narrowest first.
pub fn gaps(document: &Document) -> Vec<Gap> {
    let [template] = document.templates.as_slice() else {
        return Vec::new();
    };
    if document.regions.len() < 2 {
        return Vec::new();
    }
    let precision = document.source.as_ref().map_or(0.0, |s| s.precision);
    let facets = Facet::all(template);
    let boxes = facets.iter().map(|f| {
        let [a, b, c] = f.corners;
        let reach = 0.5 * f.width;
        [a.min(b).min(c) - reach, a.max(b).max(c) + reach]
    });
    let mut narrowest: BTreeMap<[u32; 2], Gap> = BTreeMap::new();
    pairs(
        boxes,
        |i| facets[i as usize].region,
        |s, t| {
            let [s, t] = [s, t].map(|i| &facets[i as usize]);
            let Some((width, near)) = s.gap(t, precision) else {
                return true;
            };
            let regions = [s.region.min(t.region), s.region.max(t.region)];
            let gap = Gap {
                regions,
                width,
                near,
            };
            let known = narrowest.entry(regions).or_insert(gap);
            if width < known.width {
                *known = gap;
            }
            true
        },
    );
    let mut gaps: Vec<Gap> = narrowest.into_values().collect();
    gaps.sort_by(|a, b| a.width.total_cmp(&b.width));
    gaps
}

/// A triangle between a region and the outside.
struct Facet {
    /// Its corners, counter-clockwise as seen from outside.
    corners: [DVec3; 3],
    vertices: [u32; 3],
    region: u32,
    /// Unit normal.
    normal: DVec3,
    /// The least of its heights.
    width: f64,
}

impl Facet {
    fn all(template: &Template) -> Vec<Self> {
        let outer = template.triangles.iter().filter_map(|t| {
            let [a, b, c] = t.vertices;
            let (vertices, region) = match (t.front, t.back) {
                (OUTSIDE, region) if region != OUTSIDE => ([a, b, c], region),
                (region, OUTSIDE) if region != OUTSIDE => ([a, c, b], region),
                _ => return None,
            };
            let corners = vertices.map(|v| template.vertices[v as usize]);
            let [a, b, c] = corners;
            let area = double_area_vector(a, b, c);
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            Some(Self {
                corners,
                vertices,
                region,
                normal: area.try_normalize()?,
                width: area.length() / longest,
            })
        });
        outer.collect()
    }

    /// The distance to a facet that looks at this one from so near that there is a gap between both, and the middle.
    /// Distances up to `precision` are none.
    fn gap(&self, other: &Self, precision: f64) -> Option<(f64, DVec3)> {
        let touch = self.vertices.iter().any(|v| other.vertices.contains(v));
        if touch || self.normal.dot(other.normal) > -SMOOTH_COSINE {
            return None;
        }
        let most = self.width.min(other.width);
        let mut least: Option<(f64, DVec3)> = None;
        let mut found = |width: f64, near: DVec3| {
            if width > precision && width < least.map_or(most, |l| l.0) {
                least = Some((width, near));
            }
        };
        for (s, t) in [(self, other), (other, self)] {
            for p in s.corners {
                let height = (p - t.corners[0]).dot(t.normal);
                if is_over(p, &t.corners, t.normal) {
                    found(height, p - 0.5 * height * t.normal);
                }
            }
        }
        let side = |f: &Self, i: usize| [f.corners[i], f.corners[(i + 1) % 3]];
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let (e, f) = (side(self, i), side(other, j));
            let Some([along, beyond]) = crossing(e, f, most, 0.0) else {
                continue;
            };
            let (p, q) = (e[0].lerp(e[1], along), f[0].lerp(f[1], beyond));
            found((q - p).dot(self.normal), p.midpoint(q));
        }
        least
    }
}
