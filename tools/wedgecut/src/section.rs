//! The section of the clipped surface with a side of the wedge, and the cap that closes it.

use crate::error::CutError;
use crate::opening::{Class, Opening, Side};
use crate::surface::Surface;
use geom::cdt::{CdtError, Segment, triangulate};
use geom::edges::orientation;
use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::{Frame, OUTSIDE, Triangle};

/// Marker of triangles on walls: they belong to no boundary piece of the body.
pub const NO_MARKER: u32 = u32::MAX;

/// Which part of which plane a wall takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The half plane of a side.
    HalfPlane(Side),
    /// All of the plane of side A: the one mirror wall of half a body.
    WholePlane,
    /// The part of side A's plane beyond the axis: the second side of a wedge of half a turn.
    FarHalf,
    /// The hub's plane between the sides, as the end of the wedge.
    Hub,
    /// The same as the end of the hub.
    HubInside,
    /// The plane z = 0 between the sides.
    Level,
}

impl Extent {
    /// The plane.
    pub fn side(self) -> Side {
        match self {
            Self::HalfPlane(side) => side,
            Self::WholePlane | Self::FarHalf => Side::A,
            Self::Hub | Self::HubInside => Side::Hub,
            Self::Level => Side::Level,
        }
    }

    /// Whether a point of the clipped surface lies on the wall.
    pub fn contains(self, opening: &Opening, p: DVec3, class: Class) -> bool {
        class.of(self.side()) == 0
            && match self {
                Self::WholePlane | Self::Hub | Self::HubInside | Self::Level => true,
                Self::HalfPlane(_) if !opening.is_half() => true,
                Self::HalfPlane(_) => class.is_axis() || p.x > 0.0,
                Self::FarHalf => class.is_axis() || p.x < 0.0,
            }
    }

    /// Distance from the axis along the wall.
    pub fn radius(self, opening: &Opening, p: DVec3) -> f64 {
        match self {
            Self::FarHalf => -p.x,
            other => opening.radius_on(other.side(), p),
        }
    }

    /// Coordinates of a point within the plane: distance from the axis and height, or x and y.
    fn plane(self, opening: &Opening, p: DVec3) -> [f64; 2] {
        match self {
            Self::Level => [p.x, p.y],
            other => [other.radius(opening, p), p.z],
        }
    }

    /// Whether turning from the direction away from the axis to the axis direction, within the
    /// wall, is counter-clockwise seen from outside of the wedge.
    fn faces_out(self) -> bool {
        matches!(
            self,
            Self::WholePlane | Self::HalfPlane(Side::A) | Self::HubInside
        )
    }

    fn name(self) -> &'static str {
        match self {
            Self::WholePlane | Self::HalfPlane(Side::A) => "wall-a",
            Self::Hub | Self::HubInside => "the hub",
            Self::Level => "wall-level",
            _ => "wall-b",
        }
    }
}

/// An edge of a section with the regions on either side of it within the wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SectionEdge {
    /// Point ids, lower one first.
    pub ends: [u32; 2],
    /// Region to the left, seen with the axis upwards and the axis on the left hand.
    pub left: u32,
    /// Region to the right.
    pub right: u32,
}

/// A line where a wall ends.
struct Border {
    /// The section's points on it.
    points: Vec<u32>,
    /// The side that the line is on, if it is not parallel to the axis.
    along: Option<Side>,
    /// Whether the wall is to the left of the line, walked upwards or away from the axis.
    left: bool,
}

/// The regions at the edges of caps, lower point first.
#[derive(Clone, Debug, Default)]
pub struct Borders(FxHashMap<[u32; 2], u32>);

impl Borders {
    /// Takes over the edges of a cap.
    pub fn add(&mut self, cap: &[Triangle]) {
        for t in cap {
            for k in 0..3 {
                let (v, w) = (t.vertices[k], t.vertices[(k + 1) % 3]);
                self.0.insert([v.min(w), v.max(w)], t.back);
            }
        }
    }
}

/// Where the clipped surface meets a wall.
#[derive(Clone, Debug)]
pub struct Section {
    /// The wall.
    pub extent: Extent,
    /// Points of the surface on the wall, increasing.
    pub points: Vec<u32>,
    /// Edges, in order of their ends.
    pub edges: Vec<SectionEdge>,
}

impl Section {
    /// Collects the points and edges of the clipped surface on a wall.
    pub fn new(surface: &Surface, opening: &Opening, extent: Extent) -> Self {
        let on: Vec<bool> = surface
            .points
            .iter()
            .zip(&surface.classes)
            .map(|(&p, &class)| extent.contains(opening, p, class))
            .collect();
        let mut points = FxHashSet::default();
        let mut fans: FxHashMap<[u32; 2], Vec<(u32, bool)>> = FxHashMap::default();
        for (i, face) in surface.faces.iter().enumerate() {
            for k in 0..3 {
                let (v, w) = (face.vertices[k], face.vertices[(k + 1) % 3]);
                if !on[v as usize] {
                    continue;
                }
                points.insert(v);
                if on[w as usize] {
                    let (key, forward) = if v < w {
                        ([v, w], true)
                    } else {
                        ([w, v], false)
                    };
                    fans.entry(key).or_default().push((i as u32, forward));
                }
            }
        }
        let corners = surface.corners.iter().filter(|&&v| on[v as usize]);
        points.extend(corners);
        let mut points: Vec<u32> = points.into_iter().collect();
        points.sort_unstable();
        let mut edges: Vec<SectionEdge> = fans
            .into_iter()
            .map(|(ends, fan)| Self::edge(surface, extent, ends, &fan))
            .collect();
        edges.sort_unstable_by_key(|e| e.ends);
        Self {
            extent,
            points,
            edges,
        }
    }

    /// Distance from the axis and height of a point.
    pub fn place(&self, surface: &Surface, opening: &Opening, v: u32) -> DVec2 {
        let p = surface.points[v as usize];
        DVec2::new(self.extent.radius(opening, p), p.z)
    }

    /// The regions beside an edge: those that its outermost faces turn towards the wall.
    fn edge(surface: &Surface, extent: Extent, ends: [u32; 2], fan: &[(u32, bool)]) -> SectionEdge {
        let [a, b] = ends.map(|v| surface.points[v as usize]);
        let apex = |f: u32| {
            let v = surface.faces[f as usize]
                .vertices
                .into_iter()
                .find(|v| !ends.contains(v));
            surface.points[v.unwrap_or(ends[0]) as usize]
        };
        // All apexes lie on one side of the wall, so pairwise order is a total one. A positive
        // orientation puts q to the left of p on walls that face out as (radius, height) does.
        let out = if extent.faces_out() { 1.0 } else { -1.0 };
        let (mut leftmost, mut rightmost) = (fan[0], fan[0]);
        for &use_ in &fan[1..] {
            if out * orientation(a, b, apex(leftmost.0), apex(use_.0)) > 0.0 {
                leftmost = use_;
            }
            if out * orientation(a, b, apex(rightmost.0), apex(use_.0)) < 0.0 {
                rightmost = use_;
            }
        }
        let towards = |(f, forward): (u32, bool), left: bool| {
            let face = &surface.faces[f as usize];
            if (forward == extent.faces_out()) == left {
                face.front
            } else {
                face.back
            }
        };
        SectionEdge {
            ends,
            left: towards(leftmost, true),
            right: towards(rightmost, false),
        }
    }

    /// The lines where the wall ends; `hub`: the section is the hub's.
    fn borders(&self, surface: &Surface, hub: bool) -> Vec<Border> {
        let border = |is_on: &dyn Fn(Class) -> bool, along: Option<Side>, left: bool| {
            let points = self.points.iter().copied();
            Border {
                points: points
                    .filter(|&v| is_on(surface.classes[v as usize]))
                    .collect(),
                along,
                left,
            }
        };
        let is_level = |c: Class| c.level == 0;
        match self.extent {
            Extent::WholePlane => vec![border(&is_level, Some(Side::A), true)],
            Extent::Hub | Extent::HubInside => vec![
                border(&|c| c.a == 0, None, false),
                border(&|c| c.b == 0, None, true),
                border(&is_level, Some(Side::Hub), true),
            ],
            Extent::Level => vec![
                border(&|c| c.a == 0, Some(Side::A), true),
                border(&|c| c.b == 0, Some(Side::B), false),
                border(&|c| c.hub == 0, Some(Side::Hub), hub),
            ],
            Extent::HalfPlane(_) | Extent::FarHalf => vec![
                border(&Class::is_axis, None, false),
                border(&|c| c.hub == 0, None, hub),
                border(&is_level, Some(self.extent.side()), true),
            ],
        }
    }

    /// Closes the wedge on this wall: triangles that face out of it, each with the region behind.
    ///
    /// Where the wall ends at the axis or at another wall, consecutive points there are joined, so that the
    /// caps of both walls share those edges; `hub`: the section is the hub's; `known` says which region is
    /// at them, for sections without any edge of the body's surface.
    ///
    /// # Errors
    /// A section whose edges cross, or do not agree on what is inside.
    pub fn cap(
        &self,
        surface: &Surface,
        opening: &Opening,
        frame: &Frame,
        hub: bool,
        known: &Borders,
    ) -> Result<Vec<Triangle>, CutError> {
        let local: FxHashMap<u32, u32> = self
            .points
            .iter()
            .enumerate()
            .map(|(i, &v)| (v, i as u32))
            .collect();
        let plane: Vec<[f64; 2]> = self
            .points
            .iter()
            .map(|&v| self.extent.plane(opening, surface.points[v as usize]))
            .collect();
        let mut segments: Vec<Segment> = self
            .edges
            .iter()
            .filter(|e| (e.left, e.right) != (OUTSIDE, OUTSIDE))
            .map(|e| Segment {
                ends: e.ends.map(|v| local[&v]),
                left: Some(e.left),
                right: Some(e.right),
            })
            .collect();
        for mut border in self.borders(surface, hub) {
            let place = |v: u32| {
                let p = surface.points[v as usize];
                let side = border.along.map(|side| opening.radius_on(side, p));
                side.unwrap_or(p.z)
            };
            border
                .points
                .sort_unstable_by(|&v, &w| place(v).total_cmp(&place(w)));
            for pair in border.points.windows(2) {
                let key = if pair[0] < pair[1] {
                    [pair[0], pair[1]]
                } else {
                    [pair[1], pair[0]]
                };
                if self.edges.binary_search_by_key(&key, |e| e.ends).is_err() {
                    // Points of the line may be off it by rounding: beyond there is nothing.
                    let known = known.0.get(&key).copied();
                    let [left, right] = if border.left {
                        [known, Some(OUTSIDE)]
                    } else {
                        [Some(OUTSIDE), known]
                    };
                    segments.push(Segment {
                        ends: [local[&pair[0]], local[&pair[1]]],
                        left,
                        right,
                    });
                }
            }
        }
        let triangles = triangulate(&plane, &segments, OUTSIDE).map_err(|error| {
            let at = match error {
                CdtError::Coincident(a, _) | CdtError::Crossing(a, _) => a,
                CdtError::Ambiguous { near, .. } => near,
                CdtError::Coordinate => 0,
            };
            let near = self
                .points
                .get(at as usize)
                .map_or(DVec3::ZERO, |&v| frame.to_world(surface.points[v as usize]));
            let reason = match error {
                CdtError::Coincident(..) => "two of its points coincide".to_owned(),
                CdtError::Coordinate => "a coordinate cannot be represented".to_owned(),
                CdtError::Crossing(..) => "two of its edges cross or touch".to_owned(),
                CdtError::Ambiguous { labels: [a, b], .. } => {
                    format!("{} and {} claim the same part of it", name(a), name(b))
                }
            };
            CutError::BadSection {
                wall: self.extent.name(),
                reason,
                near,
            }
        })?;
        Ok(triangles
            .into_iter()
            .map(|([a, b, c], region)| {
                let [a, b, c] = [a, b, c].map(|i| self.points[i as usize]);
                let vertices = if self.extent.faces_out() {
                    [a, b, c]
                } else {
                    [a, c, b]
                };
                Triangle {
                    vertices,
                    marker: NO_MARKER,
                    front: OUTSIDE,
                    back: region,
                }
            })
            .collect())
    }
}

fn name(region: u32) -> String {
    if region == OUTSIDE {
        "the outside".to_owned()
    } else {
        format!("region {region}")
    }
}
