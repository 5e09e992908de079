//! The coefficients of the estimate.

/// What elements and cuts cost. The unit of all costs is an element of the estimate: the integral of the inverse
/// cube of the size of elements, of which [`CostModel::tetrahedra`] tetrahedra make one.
///
/// `make calibrate` measures the coefficients: it meshes the bodies listed in
/// `tools/estimate/examples/calibrate.rs` whole and cut in several ways, and compares the tetrahedra over those of
/// the whole body with what the estimate says. Each field says what it found. Of the values of
/// [`CostModel::CALIBRATED`] the spread (the root mean square of the logarithm of measured over estimated) is 0.093
/// for wedges between mirror planes, hubs among them, 0.15 for seams (0.13 at best), 0.34 for hubs (0.22), of which one, of
/// a coarse prism, has 0.6 times what is estimated. Within that they are chosen for what follows from them: where a field differs from what it measures,
/// it says which choices would change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostModel {
    /// Tetrahedra that make one element of the estimate; measured 8.0, in the mean of bodies that differ by a factor of
    /// two up and down. Only messages use it.
    pub tetrahedra: f64,
    /// Seconds in which a tetrahedron is made, once the mesher has started; measured 9.5e-6. Only messages use it.
    pub seconds: f64,
    /// How fast the size of elements grows with the distance from a feature. A choice: TetGen grades from an edge of
    /// one size to one twice as long over about three of them.
    pub growth: f64,
    /// Size of elements over the width of a wedge that does not disturb them, between mirror planes, whose
    /// triangles the mesher may divide. Measured 1.08 to 1.32, with hubs more than without; at 1.16 the rings of order 64 of the
    /// benchmark are meshed at order 32 instead of 64, with half of the copies.
    pub span: f64,
    /// The same between the faces of a seam, whose triangles stay as they are. Measured 0.3 to 0.8, since few wedges
    /// with a seam are so narrow that it is felt; at 0.3, coarse ratchets and bevel gears get half of the copies.
    pub seam_span: f64,
    /// Angle of a wedge, radians, from which its width at the axis does not disturb elements: there is no narrow
    /// place for a hub to take out. An eighth of a turn, so that half of a square is wide; between 40 and 45 degrees
    /// there is no wedge. That of a hub is a wide one.
    pub wide: f64,
    /// Elements beside a square of the boundary of their size, over those in a cube of it, where a size that was
    /// asked for limits them: wedges have more boundary than their part of the body. Measured 0.12 to 0.28;
    /// with the latter, coarse prisms are cut into as many copies without being halved across the axis.
    pub skin: f64,
    /// The same for the wall between wedge and hub, which gets the triangles of two meshes: twice as many, of both
    /// sides.
    pub hub_skin: f64,
    /// What a seam costs in each copy for each unit of [`crate::harm::sliced::Harm::sliced`]. Measured 4
    /// to 10, by what else is fitted; at 10, ratchets, impellers and helical gears get half of the copies.
    pub sliced: f64,
    /// Time for an element of the hub, which is meshed once for its wall and once within it, over that for one of
    /// the wedge; measured 1.3 to 2.6.
    pub hub_time: f64,
    /// Elements that are meshed in the time that it takes to start the mesher. With tiny meshes, nothing is won by
    /// a narrower wedge, nor by a hub. Measured 16 to 149, by how busy the machine is;
    /// at 45, what changes is how coarse meshes of an antiprism and of cubes are cut.
    pub start: f64,
    /// Which ways to cut are good enough.
    pub accepted: Accepted,
}

/// Elements of the assembled mesh over those of a mesh of the whole body that are accepted.
///
/// The budget is 1.3 times the direct mesh's elements; of it, each way may use what is left when the estimate errs by
/// its spread, `1.3 exp(-spread)`: 1.22 with 0.068, 1.15 with 0.12, 1.07 to 1.09 with 0.18 to 0.2. Smaller values give
/// up narrow wedges that would have been faster. Since fewer vertices are left, the spread is 0.093 for wedges between mirror planes, but the
/// whole body has fewer elements than the direct mesh as well, so that the budget is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accepted {
    /// Of wedges between mirror planes.
    pub mirror: f64,
    /// Of wedges whose faces have to keep their triangles: these limit what can be done about bad elements.
    pub seam: f64,
    /// Where a hub or the plane across the axis is cut: their elements are estimated less well.
    pub more_cuts: f64,
    /// Of hubs where the bound on the radius-edge ratio is [`Accepted::loose`] or more: with every looser bound
    /// the whole body loses more elements than hub and narrow wedge do.
    pub loose_hub: f64,
    /// Bounds on the radius-edge ratio up to which [`Accepted::more_cuts`] holds for hubs, and from which
    /// [`Accepted::loose_hub`] does; in between, the share of the way.
    pub loose: [f64; 2],
    /// Ways within this factor of the fastest are as fast; the one of the lowest order has the fewest cuts. The
    /// time of one run differs from that of the next by as much.
    pub as_fast: f64,
}

impl CostModel {
    /// The coefficients that `make calibrate` gave.
    pub const CALIBRATED: Self = Self {
        tetrahedra: 8.0,
        seconds: 9.5e-6,
        growth: 0.35,
        span: 1.2,
        seam_span: 0.7,
        wide: std::f64::consts::FRAC_PI_4,
        skin: 0.25,
        hub_skin: 0.6,
        sliced: 6.0,
        hub_time: 2.0,
        start: 25.0,
        accepted: Accepted {
            mirror: 1.22,
            seam: 1.15,
            more_cuts: 1.09,
            loose_hub: 1.03,
            loose: [1.7, 2.0],
            as_fast: 1.02,
        },
    };
}

impl Default for CostModel {
    fn default() -> Self {
        Self::CALIBRATED
    }
}
