//! The rungs: what is done about the ways in which an attempt can end.

use crate::complex::{Description, Order};

/// How an attempt ended that did not give a mesh as asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The mesher failed, or its mesh cannot be used, for a reason that another description of the same surface may not
    /// meet: TetGen's own points on segments are coplanar up to rounding only, and where layers are thin some of its
    /// assertions fail by bad luck; so does its walk through the Delaunay mesh of symmetric points in some orders.
    Chance,
    /// The mesher failed so, in every description, while it put the surface into its mesh.
    Recovery,
    /// A triangle of the mesh is one that copies have as well: an uneven facet was divided so.
    Doubled,
    /// All points that may be added were used, on edges not much shorter than the surface's: the mesh is to be that large.
    Large,
    /// All points that may be added were used, and heap up at sharp places.
    Heaped,
}

/// What an attempt does differently.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// Lets the mesher add far more points.
    AllowMore,
    /// Leaves out the bound of the dihedral angle, and asks for a radius-edge ratio for which refinement ends.
    Loosen,
    /// Lets the mesher add a number of points for each of the surface, whatever comes of it.
    Stop,
    /// Describes the surface in another way.
    Describe(Description),
    /// Lets the mesher add no points to the surface.
    KeepSurface,
}

/// An attempt, given how the one before ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rung {
    /// The ending that it answers.
    pub after: Ending,
    /// What it does differently from the attempt before.
    pub change: Change,
}

const fn rung(after: Ending, change: Change) -> Rung {
    Rung { after, change }
}

const fn describe(order: Order, stir: Option<f64>, rounds_from: Option<u32>) -> Rung {
    let description = Description {
        order,
        stir,
        rounds_from,
        ..Description::PLAIN
    };
    rung(Ending::Chance, Change::Describe(description))
}

/// The rungs, each of which is taken once at most, so that there is one attempt more than rungs in the worst case.
///
/// - The limit of points is a guess (see `room.rs`); where the mesh is to be large, it is raised in two steps.
/// - Where points heap up, refinement would not end: Delaunay refinement is sure to end for radius-edge bounds of 2 and above
///   without a bound of the angle, if no angle of the input is acute (Shewchuk, "Tetrahedral mesh generation by
///   Delaunay refinement", 1998). Acute ones are left to the last limit, some points for each of the surface.
/// - What is divided within an uneven facet is divided otherwise where that is none.
/// - Equivalent descriptions of the surface are draws of the same lot. Of 72 open vias with films of 1e-4 to 7e-4 at orders
///   24 to 64 the first failed for 10, and the third for none; the others came with ten thousand random bodies. An
///   order by itself is another draw; a stir breaks up points that are cospherical or coplanar up to the rounding of a file,
///   by no more than single precision rounds, and all that is stirred is put back;
///   random rounds, and the order given, break up an order that depends on the places alone (TetGen's walk fails for seven
///   points that it sorts, and for 3 in 30 orders of them); walls as they are, and no facet but exactly
///   coplanar triangles, are for surfaces on which flattening or merging is what fails.
/// - Where all of them fail, it is TetGen's points on segments that do, in gaps of a hundred-thousandth of the body between curved faces:
///   without any, the surface can be filled, if not as well.
pub const LADDER: [Rung; 13] = [
    rung(Ending::Large, Change::AllowMore),
    rung(Ending::Large, Change::AllowMore),
    rung(Ending::Heaped, Change::Loosen),
    rung(Ending::Heaped, Change::Stop),
    rung(
        Ending::Doubled,
        Change::Describe(Description {
            apart: true,
            ..Description::PLAIN
        }),
    ),
    describe(Order::Reversed, Some(1e-9), Some(0)),
    describe(Order::FromTheMiddle, Some(1e-7), Some(4)),
    rung(
        Ending::Chance,
        Change::Describe(Description {
            flat: false,
            ..Description::PLAIN
        }),
    ),
    describe(Order::Shuffled(1), Some(1e-8), Some(1)),
    rung(
        Ending::Chance,
        Change::Describe(Description {
            order: Order::Shuffled(2),
            flat: false,
            stir: Some(1e-10),
            rounds_from: Some(8),
            apart: false,
        }),
    ),
    rung(
        Ending::Chance,
        Change::Describe(Description {
            apart: true,
            ..Description::PLAIN
        }),
    ),
    rung(
        Ending::Chance,
        Change::Describe(Description {
            order: Order::Shuffled(3),
            stir: Some(1e-11),
            rounds_from: Some(4),
            apart: true,
            ..Description::PLAIN
        }),
    ),
    rung(Ending::Recovery, Change::KeepSurface),
];
