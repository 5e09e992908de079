//! Polygons as surface formats list them.

use glam::DVec3;

/// Polygons in groups, not yet welded.
#[derive(Clone, Debug, Default)]
pub struct Soup {
    /// Positions; the same point may be listed many times. All finite.
    pub points: Vec<DVec3>,
    /// The polygons.
    pub faces: Faces,
    /// Index into `groups` of each polygon. Empty where all are in the first group.
    pub group_of: Vec<u32>,
    /// Solids, groups or objects, in order of appearance.
    pub groups: Vec<Group>,
    /// What to call a group in messages: `solid`, `group`.
    pub group_word: &'static str,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
    /// The same if a text has no more of its numbers than the digits that it prints; zero where that is not told.
    pub printed_precision: f64,
    /// What the user should know about the file.
    pub notices: Vec<String>,
}

/// Polygons by the points of a [`Soup`] that are their corners. All indices exist.
#[derive(Clone, Debug)]
pub enum Faces {
    /// Triangles.
    Triangles(Vec<[u32; 3]>),
    /// Polygons of any number of corners.
    Polygons {
        /// Corners of all polygons, one polygon after another.
        corners: Vec<u32>,
        /// Where the corners of each polygon end in `corners`.
        ends: Vec<usize>,
    },
}

impl Default for Faces {
    fn default() -> Self {
        Self::Triangles(Vec::new())
    }
}

impl Faces {
    /// Number of polygons.
    pub fn len(&self) -> usize {
        match self {
            Self::Triangles(all) => all.len(),
            Self::Polygons { ends, .. } => ends.len(),
        }
    }

    /// Whether there is no polygon.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Adds a polygon.
    pub fn add(&mut self, polygon: &[u32]) {
        if let (Self::Triangles(all), &[a, b, c]) = (&mut *self, polygon) {
            all.push([a, b, c]);
            return;
        }
        let (mut corners, mut ends) = match std::mem::take(self) {
            Self::Triangles(all) => {
                let ends = (1..=all.len()).map(|n| 3 * n).collect();
                (all.into_flattened(), ends)
            }
            Self::Polygons { corners, ends } => (corners, ends),
        };
        corners.extend_from_slice(polygon);
        ends.push(corners.len());
        *self = Self::Polygons { corners, ends };
    }
}

/// A named part of a [`Soup`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Group {
    /// Name as the file gives it; empty when it gives none.
    pub name: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_polygon_that_is_no_triangle_makes_all_of_them_polygons() {
        let mut faces = Faces::default();
        faces.add(&[0, 1, 2]);
        faces.add(&[2, 1, 3]);
        assert!(matches!(&faces, Faces::Triangles(all) if all.len() == 2));
        faces.add(&[0, 1, 2, 3]);
        faces.add(&[]);
        faces.add(&[3, 1, 0]);
        let Faces::Polygons { corners, ends } = faces else {
            panic!("there is a quadrilateral");
        };
        assert_eq!(corners, [0, 1, 2, 2, 1, 3, 0, 1, 2, 3, 3, 1, 0]);
        assert_eq!(ends, [3, 6, 10, 10, 13]);
    }
}
