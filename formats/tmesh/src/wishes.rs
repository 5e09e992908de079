//! What is asked of the elements, by whoever said so first.

use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Bounds and sizes of elements. The first tool that is told writes them into the document, the
/// others inherit them, and each may be told otherwise. Sizes of single regions are in
/// [`crate::Region::size`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Wishes {
    /// Whether elements are improved at all; false asks for a plain constrained tetrahedralization.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quality: Option<bool>,
    /// Largest ratio of circumradius to shortest edge.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_edge: Option<f64>,
    /// Smallest dihedral angle, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_dihedral: Option<f64>,
    /// Dihedral angle above which elements are optimized away, degrees; 180 leaves all as they are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub optimize: Option<f64>,
    /// Size of elements wanted.
    #[serde(default, flatten, skip_serializing_if = "Option::is_none")]
    pub size: Option<Size>,
    /// How far the surface that is meshed may be from the input's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub deviation: Option<Deviation>,
    /// Angle between the triangles at an edge, degrees, from which on the edge is a feature that stays.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feature_angle: Option<f64>,
    /// Edges in a whole turn of a curved surface that is remeshed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub segments_per_turn: Option<f64>,
    /// Largest ratio of the lengths of edges that follow each other where a surface is remeshed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gradation: Option<f64>,
    /// Elements across walls, at least.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layers_across: Option<u32>,
    /// Time limit of the mesher for each template, seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timeout: Option<f64>,
    /// Whether the faces that copies share have been divided as the elements need, so that their triangles are to
    /// stay. Mirror walls may be refined all the same.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keep_surface: Option<bool>,
    /// How far the surface is from the input's beyond what the symmetry is off, relative to the radius about the axis: because faces that
    /// are nearly flat were meshed as flat ones, see [`crate::Document::unevenness`], because it was remeshed for lengths of edges or
    /// without a symmetry, or because the sectors of the input differ or cutting took detail out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moved: Option<f64>,
}

/// How far the surface that is meshed may be from the input's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Deviation {
    /// What the tolerance of the symmetry is, or as far as the input is from it if that is more; nothing where the input
    /// has the symmetry exactly. See [`crate::Document::deviation`]. Where a length of edges is asked for, surfaces that are not
    /// exact may move as far as chords of that length take; whoever moves them replaces this by how far they have.
    Auto,
    /// So far, relative to the radius about the axis; 0 keeps every triangle.
    #[serde(untagged)]
    Within(f64),
}

impl Deviation {
    /// The largest one that makes sense, relative to the radius about the axis, as that of the symmetry that `symdetect` searches
    /// for: a tenth of the radius leaves little of a body's shape.
    pub const LARGEST: f64 = 0.1;
}

/// A size of elements.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Size {
    /// Largest volume, model units cubed.
    MaxVolume(f64),
    /// Edge length, model units.
    EdgeLength(f64),
}

impl Size {
    /// Largest volume of an element over the cube of the edge length wanted.
    ///
    /// An element of a mesh by Delaunay refinement has 0.094 of the cube of the mean edge (0.091 to 0.099 on a cube, prisms and a gear
    /// of `body`, each from two hundred to a million elements; the regular tetrahedron has 0.118). What is larger than
    /// the bound is split, which leaves elements of a third to half of it in the mean: 0.31 to 0.39 with five to nine edges along
    /// the diagonal, and down to 0.15 where the length does not divide a wedge, 0.41 to 0.46 with twenty, 0.51 with ninety. From
    /// 0.38, in between, the quarter follows: 0.094 / 0.38. So edges are as long as wanted with nine of
    /// them along the diagonal, up to an eighth longer in fine meshes, and shorter in coarse ones, 0.72 to 0.99 times.
    pub const OF_CUBE: f64 = 0.25;

    /// Largest volume of an element: of an edge length, that for which edges have this length in the mean.
    pub fn max_volume(self) -> f64 {
        match self {
            Self::MaxVolume(volume) => volume,
            Self::EdgeLength(edge) => Self::OF_CUBE * edge * edge * edge,
        }
    }

    /// Length of edges, model units, if that is what is asked for.
    pub fn edge_length(self) -> Option<f64> {
        match self {
            Self::EdgeLength(length) => Some(length),
            Self::MaxVolume(_) => None,
        }
    }
}

impl Wishes {
    /// Ratio of circumradius to shortest edge that is asked for unless something else is: below it
    /// Delaunay refinement is not sure to end in practice, above it elements get worse for few saved.
    pub const RADIUS_EDGE: f64 = 1.4;
    /// Smallest dihedral angle that is asked for unless something else is, degrees: what the mesher
    /// reaches on most bodies.
    pub const MIN_DIHEDRAL: f64 = 10.0;
    /// Dihedral angle above which elements are optimized away unless something else is asked for,
    /// degrees. On wedges of coated rings, vias, ratchets and prisms the first percentile of the
    /// smallest angle goes from 13 degrees without to 20 at 145 and 25 at 130, the smallest from 8 to
    /// 17 and 21, for 5 to 15 % of the mesher's time; elements past a radius-edge ratio of 1.4 stay
    /// below 1 %.
    pub const OPTIMIZE: f64 = 130.0;

    /// Angle from which on an edge is a feature unless something else is asked for, degrees: kernels turn facets of one
    /// smooth surface by up to half a radian unless told otherwise.
    pub const FEATURE_ANGLE: f64 = 30.0;

    /// Edges in a whole turn of a curved surface that is remeshed, unless something else is asked for: as many as solvers'
    /// guides ask for at least, 30 degrees each, the angle from which on edges are features.
    pub const SEGMENTS_PER_TURN: f64 = 360.0 / Self::FEATURE_ANGLE;
    /// Ratio of the lengths of edges that follow each other, unless something else is asked for: each of a row of edges is
    /// half as long again as the one before. A choice: near 1 small features make everything beside them small, and from 2 on
    /// triangles between such edges have corners below 30 degrees.
    pub const GRADATION: f64 = 1.5;

    /// These wishes, and those of an earlier tool where these say nothing.
    #[must_use]
    pub fn over(self, earlier: &Self) -> Self {
        Self {
            quality: self.quality.or(earlier.quality),
            radius_edge: self.radius_edge.or(earlier.radius_edge),
            min_dihedral: self.min_dihedral.or(earlier.min_dihedral),
            optimize: self.optimize.or(earlier.optimize),
            size: self.size.or(earlier.size),
            deviation: self.deviation.or(earlier.deviation),
            feature_angle: self.feature_angle.or(earlier.feature_angle),
            segments_per_turn: self.segments_per_turn.or(earlier.segments_per_turn),
            gradation: self.gradation.or(earlier.gradation),
            layers_across: self.layers_across.or(earlier.layers_across),
            timeout: self.timeout.or(earlier.timeout),
            keep_surface: self.keep_surface.or(earlier.keep_surface),
            moved: self.moved.or(earlier.moved),
        }
    }

    /// Whether nothing is asked for.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Whether elements are improved at all.
    pub fn quality(&self) -> bool {
        self.quality.unwrap_or(true)
    }

    /// Largest ratio of circumradius to shortest edge.
    pub fn radius_edge(&self) -> f64 {
        self.radius_edge.unwrap_or(Self::RADIUS_EDGE)
    }

    /// Smallest dihedral angle, degrees.
    pub fn min_dihedral(&self) -> f64 {
        self.min_dihedral.unwrap_or(Self::MIN_DIHEDRAL)
    }

    /// Dihedral angle above which elements are optimized away, degrees; `None` for not at all.
    pub fn optimize(&self) -> Option<f64> {
        Some(self.optimize.unwrap_or(Self::OPTIMIZE)).filter(|&angle| angle < 180.0)
    }

    /// The smallest dihedral angle that elements are brought to where none may be larger than `largest`, degrees: what that leaves of a
    /// straight angle, halved.
    pub fn smallest_beside(largest: f64) -> f64 {
        0.5 * (180.0 - largest)
    }

    /// Largest volume of an element where a region has no limit of its own, model units cubed.
    pub fn max_volume(&self) -> Option<f64> {
        self.size.map(Size::max_volume)
    }

    /// The angle by which edges turn along a curved surface that is remeshed, radians.
    pub fn turn(&self) -> f64 {
        let segments = self.segments_per_turn;
        std::f64::consts::TAU / segments.unwrap_or(Self::SEGMENTS_PER_TURN)
    }

    /// How far surfaces have to be able to move for edges of a length, model units as that and the `radius` about the axis: a chord on the tightest
    /// arc that it turns along by the angle wanted, a smaller one gets shorter chords, is its length times that angle over eight
    /// above it. Twice that, since remeshing takes half of it for the height of its chords.
    pub fn room_for(&self, length: f64, radius: f64) -> f64 {
        (0.25 * length * self.turn()).min(Deviation::LARGEST * radius)
    }

    /// How far the surface may be from the input's.
    pub fn deviation(&self) -> Deviation {
        self.deviation.unwrap_or(Deviation::Auto)
    }

    /// Angle from which on an edge is a feature, degrees.
    pub fn feature_angle(&self) -> f64 {
        self.feature_angle.unwrap_or(Self::FEATURE_ANGLE)
    }

    /// Length of edges that is wanted, model units.
    pub fn edge_length(&self) -> Option<f64> {
        self.size?.edge_length()
    }

    /// Largest ratio of the lengths of edges that follow each other where a surface is remeshed.
    pub fn gradation(&self) -> f64 {
        self.gradation.unwrap_or(Self::GRADATION)
    }

    /// Time limit of the mesher for each template; none if it is longer than can be told.
    pub fn timeout(&self) -> Option<Duration> {
        Duration::try_from_secs_f64(self.timeout?).ok()
    }

    /// Whether the faces that copies share have been settled.
    pub fn keep_surface(&self) -> bool {
        self.keep_surface.unwrap_or(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_wishes_overrule_earlier_ones() {
        let earlier = Wishes {
            radius_edge: Some(2.0),
            size: Some(Size::EdgeLength(0.5)),
            ..Wishes::default()
        };
        let later = Wishes {
            min_dihedral: Some(5.0),
            size: Some(Size::MaxVolume(1.0)),
            ..Wishes::default()
        };
        let both = later.over(&earlier);
        assert_eq!((both.radius_edge(), both.min_dihedral()), (2.0, 5.0));
        assert_eq!(both.max_volume(), Some(1.0));
        assert_eq!(both.optimize(), Some(Wishes::OPTIMIZE));
        let off = Wishes {
            optimize: Some(180.0),
            ..Wishes::default()
        };
        assert_eq!(off.over(&both).optimize(), None);
    }

    #[test]
    fn wishes_are_read_back_and_silence_is_empty() {
        let wishes = Wishes {
            quality: Some(false),
            size: Some(Size::EdgeLength(0.5)),
            ..Wishes::default()
        };
        let text = serde_json::to_string(&wishes).unwrap();
        assert_eq!(text, r#"{"quality":false,"edge_length":0.5}"#);
        assert_eq!(serde_json::from_str::<Wishes>(&text).unwrap(), wishes);
        for (deviation, words) in [
            (Deviation::Auto, r#""auto""#),
            (Deviation::Within(0.25), "0.25"),
        ] {
            let wishes = Wishes {
                deviation: Some(deviation),
                ..Wishes::default()
            };
            let text = serde_json::to_string(&wishes).unwrap();
            assert_eq!(text, format!(r#"{{"deviation":{words}}}"#));
            assert_eq!(serde_json::from_str::<Wishes>(&text).unwrap(), wishes);
        }
        assert_eq!(
            serde_json::from_str::<Wishes>("{}").unwrap(),
            Wishes::default()
        );
    }
}
