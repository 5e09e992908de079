//! The cap that closes a surface on a part of a cutting face.

use super::edges::{Piece, Section};
use crate::cell::{Border, Cell};
use crate::error::CutError;
use geom::cdt::{CdtError, Segment, triangulate};
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{Frame, OUTSIDE, Triangle};

/// Marker of triangles on walls: they belong to no boundary piece of the body.
pub const NO_MARKER: u32 = u32::MAX;

/// The regions at the edges of caps, lower point first.
#[derive(Clone, Debug, Default)]
pub struct Known(FxHashMap<[u32; 2], u32>);

impl Known {
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

impl Section {
    /// Closes a piece of the surface on the section's part: triangles that face out of it, each with the region
    /// behind.
    ///
    /// Where the part ends at the axis or at another cutting face, consecutive points there are joined, so that the
    /// caps of both share those edges; `known` says which region is at them, for sections without any edge of the
    /// body's surface.
    ///
    /// # Errors
    /// A section whose edges cross, or do not agree on what is inside.
    pub fn cap(
        &self,
        piece: &Piece<'_>,
        cell: &Cell,
        frame: &Frame,
        known: &Known,
    ) -> Result<Vec<Triangle>, CutError> {
        let numbers = self.points.iter().enumerate();
        let local: FxHashMap<u32, u32> = numbers.map(|(i, &v)| (v, i as u32)).collect();
        let places = self
            .points
            .iter()
            .map(|&v| self.place(piece.surface, cell, v));
        let plane: Vec<[f64; 2]> = places.map(|q| q.to_array()).collect();
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
        let others = (0..cell.faces.len()).filter_map(|other| self.part.border(&cell.faces, other));
        for border in self.part.axis_border(&cell.faces).into_iter().chain(others) {
            let open = self.open(piece, cell, &border);
            segments.extend(open.into_iter().map(|ends| {
                // Points of the line may be off it by rounding: beyond there is nothing.
                let known = known.0.get(&ends_in_order(ends)).copied();
                let [left, right] = if border.left {
                    [known, Some(OUTSIDE)]
                } else {
                    [Some(OUTSIDE), known]
                };
                Segment {
                    ends: ends.map(|v| local[&v]),
                    left,
                    right,
                }
            }));
        }
        let triangles = triangulate(&plane, &segments, OUTSIDE)
            .map_err(|error| self.bad_section(&error, piece, cell, frame))?;
        let out = self.part.faces_out(&cell.faces);
        Ok(triangles
            .into_iter()
            .map(|([a, b, c], region)| {
                let [a, b, c] = [a, b, c].map(|i| self.points[i as usize]);
                Triangle {
                    vertices: if out { [a, b, c] } else { [a, c, b] },
                    marker: NO_MARKER,
                    front: OUTSIDE,
                    back: region,
                }
            })
            .collect())
    }

    /// Pairs of consecutive points on a border that no edge of the section joins.
    fn open(&self, piece: &Piece<'_>, cell: &Cell, border: &Border) -> Vec<[u32; 2]> {
        let points = self.points.iter().copied();
        let mut on: Vec<u32> = points
            .filter(|&v| border.contains(piece.surface.classes[v as usize]))
            .collect();
        let place = |v: u32| border.along(&cell.faces, piece.surface.points[v as usize]);
        on.sort_unstable_by(|&v, &w| place(v).total_cmp(&place(w)));
        let pairs = on.windows(2).map(|pair| [pair[0], pair[1]]);
        let is_open = |ends: &[u32; 2]| {
            let key = ends_in_order(*ends);
            self.edges.binary_search_by_key(&key, |e| e.ends).is_err()
        };
        pairs.filter(is_open).collect()
    }

    fn bad_section(
        &self,
        error: &CdtError,
        piece: &Piece<'_>,
        cell: &Cell,
        frame: &Frame,
    ) -> CutError {
        let (at, reason) = match error {
            CdtError::Coincident(a, _) => (*a, "two of its points coincide".to_owned()),
            CdtError::Crossing(a, _) => (*a, "two of its edges cross or touch".to_owned()),
            CdtError::Coordinate => (0, "a coordinate cannot be represented".to_owned()),
            CdtError::Ambiguous {
                labels: [a, b],
                near,
            } => {
                let reason = format!("{} and {} claim the same part of it", name(*a), name(*b));
                (*near, reason)
            }
        };
        let place = |&v: &u32| frame.to_world(piece.surface.points[v as usize]);
        CutError::BadSection {
            wall: cell.faces[self.part.face].name,
            reason,
            near: self.points.get(at as usize).map_or(DVec3::ZERO, place),
        }
    }
}

fn ends_in_order([v, w]: [u32; 2]) -> [u32; 2] {
    [v.min(w), v.max(w)]
}

fn name(region: u32) -> String {
    if region == OUTSIDE {
        "the outside".to_owned()
    } else {
        format!("region {region}")
    }
}
