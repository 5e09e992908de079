//! What counts as equal.
//!
//! Three things keep points that should be at one place apart: the precision of the input's coordinates, the rounding
//! of what is computed from them, and that a body is only nearly symmetric. [`Tolerance`] is built from these once
//! per document, and each comparison asks it by the name of its question.
//!
//! The values are nested: `rounding <= equal <= on_plane <= on_axis`, unless the user says how far points are moved, and
//! `2 on_plane <= partner`. So points that are equal stay equal on a plane, and two points that are each moved onto
//! a plane are still partners.

use glam::DVec3;

/// Distances that are lost in computing, relative to the size. Each step of the pipe (frame, crossing, projection) adds
/// a few times 2.2e-16, but divides by sines of angles and by ratios of layers down to 1e-4, so that a
/// distance of 1e-10 has a few correct digits left and a smaller one may have none. A smaller value lets noise
/// through as detail (slivers that the mesher aborts on); a larger one reaches the layers of 1e-4 that have
/// details of 1e-4 themselves.
pub const ROUNDING: f64 = 1e-10;

/// The promise of assembled meshes: coordinates agree to this share of the size, which is the diagonal of the bounding
/// box. A vertex has to fall on its image to this; vertices nearer than this coincide; the frame of a
/// promise has to be a rotation to this, and a radius is known to this. Copies of a vertex that were not
/// welded are some 1e-16 of the size apart, and edges as short as this would have no direction left to
/// compute with.
pub const PROMISE: f64 = 1e-12;

/// Relative difference of volumes and areas that is allowed where the input is exact and exactly
/// symmetric: a choice. The volume of a layer a millionth as thick as wide, of coordinates with 16
/// digits, is good to 1e-10; the smallest part of a body that could be lost unnoticed is a millionth.
pub const VOLUME: f64 = 1e-6;

/// By how many times what its surface is off a body of copies of a wedge may be off: by once in the sector that was cut, once in that which a copy
/// replaces, and twice that near the cuts, onto which points are moved.
const SIDES: f64 = 4.0;

/// How much an amount may differ, in its units, whose border is off by `displacement`: of a volume, the border is the area around it; of an area, half of the
/// perimeters of its triangles.
pub fn may_differ(amount: f64, border: f64, displacement: f64) -> f64 {
    VOLUME * amount + SIDES * displacement * border
}

/// The least displacement by which an amount [`may_differ`] by this, with its border above zero.
pub fn displacement_of(difference: f64, amount: f64, border: f64) -> f64 {
    ((difference - VOLUME * amount) / (SIDES * border)).max(0.0)
}

/// Multiple of a coordinate's precision within which values count as equal. Two points, each off by up to `sqrt(3)`
/// times the precision through its three coordinates, and by as much again through the axis' place and once more
/// through its direction: 10.4, rounded up to a power of two.
const PRECISIONS: f64 = 16.0;

/// Largest distance, relative to the radius about the axis, that a point is moved onto a plane because the body is
/// only nearly symmetric. A choice: real tessellations that do not share the symmetry are off by 5e-5 to 9e-4;
/// moving points by more than this would bend faces that are to be flat, and moving them by less leaves slivers
/// beside the plane, which cleaning has to find.
const LARGEST_SNAP: f64 = 1e-4;

/// The same where the surface is hardly changed by it: of a point in the middle of a face that the axis passes through,
/// and of points that are moved along the surface.
const LARGEST_SLIDE: f64 = 5.0 * LARGEST_SNAP;

/// How far a point is moved along the surface, in multiples of what the body is symmetric to. A facet across the plane
/// whose image is off by the drift ends up to `drift / sin` beyond it: this covers angles down to 3.6 degrees, and
/// flatter ones make no sliver.
const SLIDE: f64 = 16.0;

/// The reach of a body about its axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// Largest distance of a point from the axis, model units.
    pub radius: f64,
    /// Largest distance of a point from the plane across the axis' origin, model units.
    pub height: f64,
}

impl Extent {
    /// The reach of points about the line through `origin` along the unit vector `axis`.
    pub fn about(points: &[DVec3], origin: DVec3, axis: DVec3) -> Self {
        let largest = |of: &dyn Fn(DVec3) -> f64| points.iter().map(|&p| of(p)).fold(0.0, f64::max);
        Self {
            radius: largest(&|p| (p - origin).cross(axis).length()),
            height: largest(&|p| (p - origin).dot(axis).abs()),
        }
    }

    /// The larger of both, model units.
    pub fn size(&self) -> f64 {
        self.radius.max(self.height)
    }
}

/// What counts as equal in a document. All distances are in model units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    extent: Extent,
    precision: f64,
    drift: f64,
    snap: Option<f64>,
    detail: f64,
}

impl Tolerance {
    /// For a body of this extent whose coordinates are off by up to `precision` (model units) and that is symmetric to
    /// `residual` (relative to the radius about the axis). While the symmetry is still searched for, the
    /// residual is what the search accepts.
    pub fn new(extent: Extent, precision: f64, residual: f64) -> Self {
        Self {
            extent,
            precision,
            drift: residual.max(0.0) * extent.radius,
            snap: None,
            detail: 0.0,
        }
    }

    /// The same where the user says, relative to the radius, how far points are moved onto planes and the axis.
    pub fn with_snap(self, relative: Option<f64>) -> Self {
        Self {
            snap: relative,
            ..self
        }
    }

    /// The same where detail below this, relative to the radius, is removed; 0 for none.
    pub fn with_detail(self, relative: f64) -> Self {
        Self {
            detail: relative * self.extent.radius,
            ..self
        }
    }

    /// The reach of the body.
    pub fn extent(&self) -> Extent {
        self.extent
    }

    /// What computing may lose.
    pub fn rounding(&self) -> f64 {
        ROUNDING * self.extent.size()
    }

    /// Within this, coordinates count as equal.
    pub fn equal(&self) -> f64 {
        (PRECISIONS * self.precision).max(self.rounding())
    }

    /// Within this of a face's plane, faces count as in one plane.
    pub fn flat(&self) -> f64 {
        self.equal()
    }

    /// How far the body is from its own images.
    pub fn drift(&self) -> f64 {
        self.drift
    }

    /// Within this, points count as on a cutting plane. A point of the plane that is off by the drift has an image that
    /// is off as much on the other side, so that both together are off by twice the drift.
    pub fn on_plane(&self) -> f64 {
        match self.snap {
            Some(relative) => (relative * self.extent.radius).max(self.rounding()),
            None => self
                .equal()
                .max((2.0 * self.drift).min(LARGEST_SNAP * self.extent.radius)),
        }
    }

    /// Within this, points count as on the axis, where two planes meet that each may be off. Of a body that is only
    /// nearly symmetric, the middle of a face may be off the axis by more than what is moved onto a plane.
    pub fn on_axis(&self) -> f64 {
        match self.snap {
            Some(_) => self.on_plane(),
            None => self
                .on_plane()
                .max((4.0 * self.drift).min(LARGEST_SLIDE * self.extent.radius)),
        }
    }

    /// Within this, points of two faces that are to be glued count as partners: each may have been moved by any of what
    /// is moved. Partners up to half of that apart are one point, as two would leave detail that is
    /// removed elsewhere.
    pub fn partner(&self) -> f64 {
        (4.0 * self.drift)
            .max(4.0 * self.equal())
            .max(2.0 * self.on_plane())
            .max(2.0 * self.detail)
    }

    /// The same for points of faces that a plane cuts at a small angle: what these are off across themselves is more along the plane, and
    /// both points may be moved there as far as onto a plane.
    pub fn partner_along(&self) -> f64 {
        let slide = SLIDE * self.drift.max(self.equal());
        self.partner()
            .max(2.0 * slide.min(LARGEST_SLIDE * self.extent.radius))
    }

    /// Edges shorter than this are collapsed; 0 for none.
    pub fn detail(&self) -> f64 {
        self.detail
    }

    /// Edges shorter than this are collapsed beside cutting planes, where the drift makes them; 0 for none.
    pub fn detail_at_planes(&self) -> f64 {
        if self.detail > 0.0 && self.drift > self.detail {
            self.drift
        } else {
            0.0
        }
    }

    /// Within this of a mirror plane, points are moved onto it along the surface; 0 for none.
    pub fn slide(&self) -> f64 {
        if self.snap.is_none() && self.drift > self.equal() {
            (SLIDE * self.drift).min(LARGEST_SLIDE * self.extent.radius)
        } else {
            0.0
        }
    }

    /// Sine of the angle up to which two directions count as parallel: each is told from points at most the radius away
    /// that are off by the drift or by what counts as equal.
    pub fn parallel(&self) -> f64 {
        let off = self.drift.max(self.equal());
        if self.extent.radius > 0.0 {
            (2.0 * off / self.extent.radius).min(1.0)
        } else {
            1.0
        }
    }

    /// How much two volumes of a body may differ, relative to the volume, when its boundary of the given area was moved
    /// by what is allowed to be moved. That is more than what computing loses, as points
    /// may be moved onto planes by as much.
    pub fn volume(&self, area: f64, volume: f64) -> f64 {
        let moved = self.drift + self.on_plane() + self.detail + self.detail_at_planes();
        SIDES * moved * area / volume.abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> impl Iterator<Item = Tolerance> {
        let sizes = [1e-6, 1.0, 1e6];
        let relative = [0.0, 1e-16, 6e-8, 1e-5];
        let residuals = [0.0, 1e-15, 1e-8, 3e-5, 1e-3];
        sizes.into_iter().flat_map(move |radius| {
            relative.into_iter().flat_map(move |precision| {
                residuals.into_iter().map(move |residual| {
                    let extent = Extent {
                        radius,
                        height: 3.0 * radius,
                    };
                    Tolerance::new(extent, precision * radius, residual)
                })
            })
        })
    }

    #[test]
    fn tolerances_are_nested() {
        for exact in all() {
            for snap in [None, Some(0.0), Some(1e-5)] {
                let t = exact.with_snap(snap).with_detail(1e-6);
                assert!(t.rounding() <= t.equal(), "{t:?}");
                assert!(t.rounding() <= t.on_plane(), "{t:?}");
                assert!(snap.is_some() || t.equal() <= t.on_plane(), "{t:?}");
                assert!(t.on_plane() <= t.on_axis(), "{t:?}");
                assert!(2.0 * t.on_plane() <= t.partner(), "{t:?}");
                assert!(t.drift() <= t.partner(), "{t:?}");
            }
        }
    }

    #[test]
    fn tolerances_do_not_depend_on_the_unit() {
        let [small, large]: [Vec<Tolerance>; 2] =
            [1e-6, 1e6].map(|r| all().filter(|t| t.extent.radius == r).collect());
        for (a, b) in small.iter().zip(&large) {
            for of in [Tolerance::equal, Tolerance::on_axis, Tolerance::slide] {
                let (x, y) = (of(a) / 1e-6, of(b) / 1e6);
                assert!((x - y).abs() <= 1e-12 * x.abs());
            }
            assert!((a.parallel() / b.parallel() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn an_exact_body_is_cut_where_it_is() {
        let extent = Extent::about(
            &[DVec3::X, DVec3::new(0.0, 2.0, -0.5)],
            DVec3::ZERO,
            DVec3::Z,
        );
        assert_eq!((extent.radius, extent.height), (2.0, 0.5));
        let t = Tolerance::new(extent, 0.0, 0.0);
        assert_eq!(t.on_plane(), t.rounding());
        assert_eq!(
            (t.slide(), t.detail(), t.detail_at_planes()),
            (0.0, 0.0, 0.0)
        );
        assert!(t.volume(6.0, 1.0) < 1e-8);
        // What a search accepts makes directions parallel.
        assert_eq!(Tolerance::new(extent, 0.0, 1e-3).parallel(), 2e-3);
    }
}
