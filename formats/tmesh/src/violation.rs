//! What can be wrong with a document.

use crate::Isometry;
use glam::DVec3;
use thiserror::Error;

/// One broken invariant.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Violation {
    /// No template.
    #[error("it has no template")]
    NoTemplate,
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} of template {template} has the coordinates ({}, {}, {})", .position.x, .position.y, .position.z)]
    NotFinite {
        /// Template index.
        template: usize,
        /// Vertex index.
        vertex: usize,
        /// Its position.
        position: DVec3,
    },
    /// An element names a vertex that is not there.
    #[error(
        "{element} {index} of template {template} names vertex {vertex}, and there are {count}"
    )]
    VertexOutOfRange {
        /// `triangle`, `tetrahedron`, `axis entry`, or a wall's name.
        element: String,
        /// Which one.
        index: usize,
        /// Template index.
        template: usize,
        /// The vertex it names.
        vertex: u32,
        /// Vertices there are.
        count: usize,
    },
    /// A wall names a triangle that is not there.
    #[error(
        "wall '{wall}' of template {template} names triangle {triangle}, and there are {count}"
    )]
    TriangleOutOfRange {
        /// The wall's name.
        wall: String,
        /// Template index.
        template: usize,
        /// The triangle it names.
        triangle: u32,
        /// Triangles there are.
        count: usize,
    },
    /// An element names a vertex twice.
    #[error("{element} {index} of template {template} names vertex {vertex} twice")]
    RepeatedVertex {
        /// `triangle` or `tetrahedron`.
        element: &'static str,
        /// Which one.
        index: usize,
        /// Template index.
        template: usize,
        /// The vertex.
        vertex: u32,
    },
    /// A region id is used that the region table does not list.
    #[error(
        "{element} {index} of template {template} has region {region}, which the region table does not list"
    )]
    UnknownRegion {
        /// `triangle` or `tetrahedron`.
        element: &'static str,
        /// Which one.
        index: usize,
        /// Template index.
        template: usize,
        /// The region id.
        region: u32,
    },
    /// The region or marker table has an id twice, out of order, or the reserved one.
    #[error("the {table} table lists id {id} twice, out of order, or where it must not be")]
    BadTable {
        /// `region`, `marker` or `region map`.
        table: &'static str,
        /// The id.
        id: u32,
    },
    /// A name has a line end or another control character.
    #[error("the name {name:?} of a {what} has a control character")]
    BadName {
        /// `region`, `marker` or `wall`.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A number of the tables is not one, or has a value that it cannot have.
    #[error("{what} is {value}, and must be a finite{} number", if *.positive { " positive" } else { "" })]
    BadNumber {
        /// Such as `the volume of region 'copper'`.
        what: String,
        /// The value.
        value: f64,
        /// Whether it must be above zero.
        positive: bool,
    },
    /// A wall's list is not increasing.
    #[error(
        "wall '{wall}' of template {template}: its list of {what} is not increasing at entry {index}"
    )]
    Unordered {
        /// The wall's name.
        wall: String,
        /// Template index.
        template: usize,
        /// `vertex pairs` or `triangle pairs`.
        what: &'static str,
        /// First entry that is not larger than the one before.
        index: usize,
    },
    /// A reflection pairs a vertex or a triangle with another one of the same template.
    #[error(
        "wall '{wall}' of template {template}: {what} {first} and {second} are paired by a reflection, \
         which pairs each with itself"
    )]
    NotItself {
        /// The wall's name.
        wall: String,
        /// Template index.
        template: usize,
        /// `vertices` or `triangles`.
        what: &'static str,
        /// First member of the pair.
        first: u32,
        /// Second member.
        second: u32,
    },
    /// A vertex listed on a mirror wall is away from its plane.
    #[error(
        "wall '{wall}' of template {template}: vertex {vertex} is {distance:e} away from the plane"
    )]
    OffPlane {
        /// The wall's name.
        wall: String,
        /// Template index.
        template: usize,
        /// The vertex.
        vertex: u32,
        /// Its distance, model units.
        distance: f64,
    },
    /// A pair whose first member is not the image of the second.
    #[error(
        "wall '{wall}' of template {template}: vertex {first} is not the image of vertex {second} (distance {distance:e})"
    )]
    NotAnImage {
        /// The wall's name.
        wall: String,
        /// Template index.
        template: usize,
        /// First vertex of the pair.
        first: u32,
        /// Second vertex of the pair.
        second: u32,
        /// Distance between the image of one and the other, model units.
        distance: f64,
    },
    /// A pair of triangles whose vertices are not paired.
    #[error(
        "wall '{wall}' of template {template}: triangles {first} and {second} are paired, but their vertices are not"
    )]
    TrianglesDiffer {
        /// The wall's name.
        wall: String,
        /// Template index.
        template: usize,
        /// First triangle of the pair.
        first: u32,
        /// Second triangle of the pair.
        second: u32,
    },
    /// An axis vertex is away from the axis.
    #[error(
        "vertex {vertex} of template {template} is listed on the axis, but lies {distance:e} away from it"
    )]
    OffAxis {
        /// Template index.
        template: usize,
        /// The vertex.
        vertex: u32,
        /// Its distance, model units.
        distance: f64,
    },
    /// A template's list of vertices on the axis is not increasing.
    #[error(
        "template {template}: its list of vertices on the axis is not increasing at entry {index}"
    )]
    AxisUnordered {
        /// Template index.
        template: usize,
        /// First entry that is not larger than the one before.
        index: usize,
    },
    /// An instance or a gluing names something that is not there.
    #[error("{what} names {target} {index}, and there are {count}")]
    IndexOutOfRange {
        /// Who names it.
        what: String,
        /// `template` or `region map`.
        target: &'static str,
        /// The index it names.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// Two instances place the same template in the same way.
    #[error("template {template} is placed twice by {isometry}")]
    RepeatedInstance {
        /// Template index.
        template: usize,
        /// The placement.
        isometry: Isometry,
    },
    /// The instance beyond a wall is missing.
    #[error(
        "instance {isometry} of template {template} has no neighbour {neighbour} across wall '{wall}'"
    )]
    MissingNeighbour {
        /// Template index.
        template: usize,
        /// The instance's placement.
        isometry: Isometry,
        /// The placement that is missing.
        neighbour: Isometry,
        /// The wall's name.
        wall: String,
    },
    /// The turns of the document's isometries have no common denominator in the allowed range.
    #[error(
        "the turns of its instances and gluings have {denominator} for common denominator, and {} is the largest allowed",
        crate::MAX_TURN_DENOMINATOR
    )]
    TurnsTooFine {
        /// Least common multiple of the denominators up to the first that leaves the range.
        denominator: u64,
    },
    /// The symmetry found or promised makes no sense.
    #[error("the symmetry {reason}")]
    BadSymmetry {
        /// What is wrong with it.
        reason: String,
    },
    /// The lengths that change from place to place make no sense.
    #[error("the size field: {reason}")]
    BadSizeField {
        /// What is wrong with it.
        reason: String,
    },
    /// The frame is not a rotation and a finite shift.
    #[error("the frame is not a rotation and a finite shift")]
    BadFrame,
}
