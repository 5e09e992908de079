//! Binding to the system's TetGen library (Si 2015, "TetGen, a Delaunay-based quality tetrahedral
//! mesh generator", ACM TOMS 41(2)).
//!
//! TetGen prints to standard output, throws integers, and on hard input may abort, crash, exit or
//! never return. So [`tetrahedralize`] runs it in a forked child process: the input is shared by the
//! fork, the result comes back through a memory file that the caller maps, and whatever happens to
//! the child is one [`Error`] value here. There are no temporary files; the child ends with us.

mod child;
mod error;
mod ffi;
mod input;
mod mesh;

pub use child::Child;
pub use error::{Error, Failure};
pub use input::{Complex, Limits, RegionSeed};
pub use mesh::Mesh;

/// Meshes a piecewise linear complex with the given TetGen switches.
///
/// `chatter` receives what TetGen prints, as it prints it, in pieces of any length.
///
/// # Errors
/// Everything that can happen to TetGen; see [`Error`].
pub fn tetrahedralize(
    complex: &Complex<'_>,
    switches: &str,
    limits: Limits,
    chatter: &mut dyn FnMut(&[u8]),
) -> Result<Mesh, Error> {
    Child::start(complex, switches, limits.memory)?.finish(limits, chatter)
}

#[cfg(test)]
mod tests;
