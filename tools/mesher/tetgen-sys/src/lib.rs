//! Binding to the system's TetGen library (Si 2015, "TetGen, a Delaunay-based quality tetrahedral
//! mesh generator", ACM TOMS 41(2)).
//!
//! TetGen prints to standard output, throws integers, and on hard input may abort, crash, exit or
//! never return. So [`tetrahedralize`] runs it in a forked child process: the input is shared by the
//! fork, the result comes back through a memory file that the caller maps, and whatever happens to
//! the child is one [`Error`] value here. There are no temporary files; the child ends with us.

mod child;
mod counts;
mod error;
mod ffi;
mod input;
mod mesh;
mod news;
mod silence;

pub use child::Child;
pub use counts::Counts;
pub use error::{Error, Failure};
pub use input::{Complex, Limits, RegionSeed, SizeNode, Sizes};
pub use mesh::Mesh;
pub use news::News;

/// Meshes a piecewise linear complex with the given TetGen switches.
///
/// `listener` hears of it meanwhile; the mesh is the same with and without counts.
///
/// # Errors
/// Everything that can happen to TetGen; see [`Error`].
pub fn tetrahedralize(
    complex: &Complex<'_>,
    switches: &str,
    limits: Limits,
    listener: &mut dyn FnMut(News<'_>),
) -> Result<Mesh, Error> {
    Child::start(complex, switches, limits)?.finish(listener)
}

#[cfg(test)]
mod tests;
