//! The cyclic symmetry of a sector.

use super::names::fitting;
use super::number::coordinate;
use crate::sink::ByteSink;
use crate::stream::{Coupling, Label, MeshStream};
use rustc_hash::FxHashSet;
use std::io;

/// Points whose values the tie of a seam or the solver's own conditions on the axis give.
pub fn tied(mesh: &dyn MeshStream) -> FxHashSet<u32> {
    let couplings = mesh.couplings().iter().filter(|c| c.low != c.high);
    couplings.flat_map(|c| &c.points).map(|p| p[0]).collect()
}

/// Ties of the faces of seams, and the cyclic symmetry of a sector that has one seam.
pub fn write(mesh: &dyn MeshStream, names: &[String], sink: &mut ByteSink<'_>) -> io::Result<()> {
    let name = |wall: u32| {
        let mut patches = mesh.patches().iter();
        let at = patches.position(|p| p.label == Label::Wall(wall))?;
        Some(names[at].as_str())
    };
    let mut seams: Vec<(&Coupling, u32, &str, &str)> = Vec::new();
    for coupling in mesh.couplings() {
        if let (Some(n), Some(low), Some(high)) =
            (coupling.sectors, name(coupling.low), name(coupling.high))
            && low != high
        {
            seams.push((coupling, n, low, high));
        }
    }
    let alike = |(coupling, n, ..): &(&Coupling, u32, &str, &str)| {
        seams.first().is_some_and(|first| first.1 == *n) && coupling.axis == seams[0].0.axis
    };
    if seams.len() < mesh.couplings().len() || !seams.iter().all(alike) {
        return sink.text(
            "** No cyclic symmetry model: the column around the axis has a symmetry of its own, and\n\
             ** faces that other sectors touch elsewhere. Cut without it (wedgecut --hub none).\n",
        );
    }
    if seams.first().is_some_and(|s| s.1 > 2) && !mesh.axis_edges().is_empty() {
        sink.text(
            "** Material lies on the axis. In frequency steps CalculiX holds these nodes by nodal diameter:\n\
             ** along the axis (1), across it (0) or both (above), each in a step of its own. For nodal\n\
             ** diameter 1 that leaves them more freedom than they have in the whole body, which has them\n\
             ** move on a circle; take its frequencies from the whole mesh.\n",
        )?;
    }
    let tied = fitting(seams.iter().map(|s| Some(s.0.name.clone())));
    for ((_, _, low, high), tie) in seams.iter().zip(&tied) {
        // The dependent face comes first; copies go from it towards the other one.
        sink.text(&format!(
            "*TIE, NAME={tie}, CYCLIC SYMMETRY\n{low}, {high}\n"
        ))?;
    }
    for ((coupling, n, ..), tie) in seams.iter().zip(&tied) {
        let points = coupling.axis.map(|p| p.to_array().map(coordinate));
        let points = points.as_flattened().join(", ");
        sink.text(&format!(
            "*CYCLIC SYMMETRY MODEL, N={n}, TIE={tie}\n{points}\n"
        ))?;
    }
    Ok(())
}
