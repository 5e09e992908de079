//! Why a wedge could not be cut.

use glam::DVec3;
use kit::Failure;
use thiserror::Error;

/// What to do where sections differ that were found to be images of each other.
const OTHERWISE: &str = "sectors are not the same there, or the surface crosses itself: another --order or --start-angle may cut \
                         elsewhere, --order 1 keeps the body whole";

/// Why a wedge could not be cut. Positions are in the frame of the input.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CutError {
    /// `symdetect` did not run.
    #[error("the document states no symmetry; run symdetect first")]
    NoSymmetry,
    /// The document is not a surface in world coordinates.
    #[error("wedgecut takes the surface of a whole body, but {0}")]
    NotASurface(&'static str),
    /// The order asked for does not divide the order found.
    #[error(
        "--order {asked} does not divide the order found, {found}; its divisors are {divisors}{hint}"
    )]
    NotADivisor {
        /// Order asked for.
        asked: u32,
        /// Order found.
        found: u32,
        /// Divisors of the order found, as text.
        divisors: String,
        /// What else can be done.
        hint: String,
    },
    /// Mirror walls asked for, but there are no mirror planes.
    #[error(
        "--domain mirror needs mirror planes that contain the axis, and the body is {0}; use --domain rotation"
    )]
    NoMirror(String),
    /// A start angle that is not a mirror plane's.
    #[error(
        "--start-angle {angle} is not a mirror plane: mirror planes follow each other every {step} degrees from 0"
    )]
    NotAMirrorPlane {
        /// Degrees.
        angle: f64,
        /// Degrees.
        step: f64,
    },
    /// A seam where it harms the mesh.
    #[error(
        "the cut at --start-angle {angle} passes close by edges or meets faces at sharp angles: about {elements:.0} \
         more elements in each copy; at --start-angle {better} about {fewer:.0}"
    )]
    BadPlace {
        /// Degrees.
        angle: String,
        /// Elements that it costs, by estimate.
        elements: f64,
        /// Degrees; a better place.
        better: String,
        /// Elements that it costs there.
        fewer: f64,
    },
    /// The axis or its reference direction is unusable.
    #[error("the symmetry's axis ({0}, {1}, {2}) or mirror direction is not a direction")]
    BadAxis(f64, f64, f64),
    /// The section of the body with a cut plane is not a clean planar figure.
    #[error(
        "the body's section at {wall} is not a clean figure: {reason}, near ({:.6}, {:.6}, {:.6}); \
         the surface intersects or touches itself there", .near.x, .near.y, .near.z
    )]
    BadSection {
        /// The wall's name.
        wall: &'static str,
        /// What is wrong.
        reason: String,
        /// Where.
        near: DVec3,
    },
    /// The sections at the two sides of a rotation wedge are not images of each other.
    #[error(
        "the sections at the two sides of the wedge do not match: {low} points against {high}, {} \
         (tolerance {tolerance:.3e}) near ({:.6}, {:.6}, {:.6}); {OTHERWISE}",
        partner(*.distance), .near.x, .near.y, .near.z
    )]
    SectionsDiffer {
        /// Points on the low side.
        low: usize,
        /// Points on the high side.
        high: usize,
        /// Largest distance of a point to its nearest partner, model units; infinite where the other side has
        /// nothing to compare it with.
        distance: f64,
        /// What is allowed, model units.
        tolerance: f64,
        /// Where.
        near: DVec3,
    },
    /// A curve of one section has no counterpart between the same points and regions in the other.
    #[error(
        "the sections at the two sides of the wedge are joined differently: {low} curves against {high}, one \
         of them without counterpart near ({:.6}, {:.6}, {:.6}); {OTHERWISE}", .near.x, .near.y, .near.z
    )]
    SectionsJoinedDifferently {
        /// Curves of the low side.
        low: usize,
        /// Curves of the high side.
        high: usize,
        /// Where.
        near: DVec3,
    },
    /// A seam that is no plane crosses the surface, though none of its points is beyond.
    #[error(
        "the seam, between its points, crosses the surface or another cut face near ({:.6}, {:.6}, {:.6})",
        .near.x, .near.y, .near.z
    )]
    SeamCrosses {
        /// Where.
        near: DVec3,
    },
    /// A piece of the body that touches nothing else lies between a seam that is no plane and its chords.
    #[error(
        "a piece of the body lies beyond the seam, between its points, near ({:.6}, {:.6}, {:.6})",
        .near.x, .near.y, .near.z
    )]
    BeyondSeam {
        /// Where.
        near: DVec3,
    },
    /// Faces that have points of a seam cross, though sections are clean.
    #[error(
        "faces cross at the seam near ({:.6}, {:.6}, {:.6}), whose points were moved by up to {moved:.3e} to make its \
         sides images of each other; parts of the body are nearer to each other than it is symmetric",
        .near.x, .near.y, .near.z
    )]
    MovedFacesCross {
        /// Where.
        near: DVec3,
        /// Largest distance that a point was moved, model units.
        moved: f64,
    },
    /// A seam that the group cannot have.
    #[error("--seam FILE does not fit: {0}")]
    NoSeam(&'static str),
    /// The wedge's surface does not close.
    #[error(
        "the cut surface does not close at {count} edges, the first near ({:.6}, {:.6}, {:.6})",
        .near.x, .near.y, .near.z
    )]
    NotClosed {
        /// Edges where regions do not add up.
        count: usize,
        /// Where.
        near: DVec3,
    },
    /// The wedge's copies do not add up to the body.
    #[error(
        "{copies} copies of the wedge have the volume {wedge:.9e}, the body has {body:.9e}: {relative:.1e} \
         apart, more than the symmetry's residual allows ({allowed:.1e}); the body is less symmetric than stated"
    )]
    VolumeDiffers {
        /// Number of instances.
        copies: usize,
        /// Volume of all copies, model units cubed.
        wedge: f64,
        /// Volume of the body, model units cubed.
        body: f64,
        /// Relative difference.
        relative: f64,
        /// Largest relative difference accepted.
        allowed: f64,
    },
    /// The wedge's copies do not add up to a region of the body.
    #[error(
        "{copies} copies of the wedge give region {region} the volume {wedge:.9e}, in the body it has {body:.9e}, \
         more than the symmetry's residual allows ({allowed:.1e}); regions are less symmetric than stated"
    )]
    RegionVolumeDiffers {
        /// Id of the region.
        region: u32,
        /// Number of instances.
        copies: usize,
        /// Volume in all copies, model units cubed.
        wedge: f64,
        /// Volume in the body, model units cubed.
        body: f64,
        /// Largest difference accepted, model units cubed.
        allowed: f64,
    },
    /// Nothing is left of a region of the body.
    #[error(
        "nothing is left of region {region} '{name}', of volume {body:.1e}, in the wedge: points within {within:.1e} of the \
         axis and of cut planes are moved onto these; leave it out, or move less with --snap, relative to the radius"
    )]
    RegionLost {
        /// Id of the region.
        region: u32,
        /// Its name.
        name: String,
        /// Volume in the body, model units cubed.
        body: f64,
        /// How far points are moved at most, model units.
        within: f64,
    },
    /// A hub that cannot be made.
    #[error("there can be no hub of radius {radius}: {reason}; use --hub none or another radius")]
    BadHub {
        /// Inscribed radius, model units.
        radius: f64,
        /// Why not.
        reason: String,
    },
    /// Nothing of the body lies in the wedge.
    #[error("the wedge is empty")]
    Empty,
}

impl CutError {
    /// The same at another place.
    pub fn moved(mut self, to: impl Fn(DVec3) -> DVec3) -> Self {
        match &mut self {
            Self::BadSection { near, .. }
            | Self::SectionsDiffer { near, .. }
            | Self::SectionsJoinedDifferently { near, .. }
            | Self::NotClosed { near, .. } => *near = to(*near),
            _ => {}
        }
        self
    }

    /// Whether the body's shape where it was cut is the reason, so that another cut may do.
    pub fn is_of_the_shape(&self) -> bool {
        match self {
            Self::BadSection { .. }
            | Self::SectionsDiffer { .. }
            | Self::SectionsJoinedDifferently { .. }
            | Self::SeamCrosses { .. }
            | Self::BeyondSeam { .. }
            | Self::MovedFacesCross { .. }
            | Self::NotClosed { .. }
            | Self::VolumeDiffers { .. }
            | Self::RegionVolumeDiffers { .. }
            | Self::RegionLost { .. }
            | Self::BadHub { .. }
            | Self::Empty => true,
            Self::NoSymmetry
            | Self::NotASurface(_)
            | Self::NotADivisor { .. }
            | Self::NoMirror(_)
            | Self::NotAMirrorPlane { .. }
            | Self::BadPlace { .. }
            | Self::NoSeam(_)
            | Self::BadAxis(..) => false,
        }
    }
}

impl From<CutError> for Failure {
    fn from(error: CutError) -> Self {
        match error {
            CutError::NotADivisor { .. } | CutError::NoMirror(_) => {
                Self::Impossible(error.to_string())
            }
            CutError::NotAMirrorPlane { .. } | CutError::NoSeam(_) => {
                Self::Usage(error.to_string())
            }
            CutError::NoSymmetry | CutError::NotASurface(_) | CutError::BadAxis(..) => {
                Self::Input(error.to_string())
            }
            _ => Self::Impossible(error.to_string()),
        }
    }
}

/// How far a point is from a partner, in words.
fn partner(distance: f64) -> String {
    if distance.is_finite() {
        format!("the farthest {distance:.3e} from a partner")
    } else {
        "and there is nothing on the other side where curves end".to_owned()
    }
}
