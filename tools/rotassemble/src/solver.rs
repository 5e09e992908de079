//! What a solver has to be told about the cut faces of a sector.

use interchange::{Coupling, MeshStream, Parity};
use kit::Failure;
use std::str::FromStr;

/// What is wished for a mirror plane: a wall, or all of them, and what holds there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MirrorWish {
    wall: Option<String>,
    parity: Option<Parity>,
}

impl FromStr for MirrorWish {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (wall, word) = match text.rsplit_once('=') {
            Some((wall, word)) => (Some(wall.to_owned()), word),
            None => (None, text),
        };
        let parity = match word {
            "symmetric" => Some(Parity::Symmetric),
            "antisymmetric" => Some(Parity::Antisymmetric),
            "none" => None,
            other => {
                return Err(format!(
                    "`{other}` is none of symmetric, antisymmetric, none"
                ));
            }
        };
        Ok(Self { wall, parity })
    }
}

/// What goes into the solver's deck: the condition at each wall, by position, and what to tell the user.
#[derive(Debug)]
pub struct Conditions {
    /// See [`interchange::WriteOptions::parities`].
    pub parities: Vec<Option<Parity>>,
    /// What a user of the deck has to know.
    pub note: Option<String>,
}

/// Settles what holds at the walls of a sector.
///
/// # Errors
/// Sectors whose deck would be that of another body: with a column around the axis that has a symmetry
/// of its own, coupled by operations that turn the axis over, or halved at a mirror plane with nothing
/// wished for it. Wishes for walls that there are not.
pub fn conditions(mesh: &dyn MeshStream, wishes: &[MirrorWish]) -> Result<Conditions, Failure> {
    let names = mesh.wall_names();
    let mirrors: Vec<usize> = (0..names.len())
        .filter(|&i| matches!(mesh.wall_normals().get(i), Some(Some(_))))
        .collect();
    let mut parities = vec![None; names.len()];
    let mut settled = vec![false; names.len()];
    for wish in wishes {
        let meant = |i: &&usize| wish.wall.as_ref().is_none_or(|w| *w == names[**i]);
        let mut any = false;
        for &i in mirrors.iter().filter(meant) {
            (parities[i], settled[i], any) = (wish.parity, true, true);
        }
        if !any {
            let there: Vec<&str> = mirrors.iter().map(|&i| names[i].as_str()).collect();
            let which = wish.wall.as_ref().map_or_else(
                || "no wall of the sector is a mirror plane".to_owned(),
                |w| format!("no wall `{w}` of the sector is a mirror plane"),
            );
            let there = match &there[..] {
                [] => String::new(),
                list => format!("; these are: {}", list.join(", ")),
            };
            return Err(Failure::Usage(format!("{which}{there}")));
        }
    }
    if let Some(coupling) = mesh.couplings().iter().find(|c| turns_over(c)) {
        return Err(Failure::Impossible(format!(
            "the neighbour of a sector across `{}` is turned over, which is no cyclic symmetry, and a solver \
             cannot couple them; cut sectors of rotations alone: wedgecut --domain rotation",
            coupling.name
        )));
    }
    if !mesh.uncoupled().is_empty() || mesh.couplings().iter().any(|c| c.sectors.is_none()) {
        return Err(Failure::Impossible(
            "the column around the axis (the hub) has a symmetry of its own, so that other sectors touch \
             this one elsewhere, and a solver cannot couple them; cut without it: wedgecut --hub none"
                .to_owned(),
        ));
    }
    let sectors = mesh.couplings().iter().find_map(|c| c.sectors);
    let (Some(sectors), on_axis) = (sectors, !mesh.axis_edges().is_empty()) else {
        // Nothing is solved before conditions are given: a deck without a model misleads nobody.
        return Ok(Conditions {
            parities,
            note: None,
        });
    };
    if let Some(&open) = mirrors.iter().find(|&&i| !settled[i]) {
        return Err(Failure::Impossible(format!(
            "the sector ends at the mirror plane `{}`, so a deck with cyclic symmetry alone would be one of \
             half the body; cut the full height with wedgecut --horizontal-mirror off, or say what holds \
             there: --mirror symmetric, antisymmetric, or none (nothing, which is right for heat)",
            names[open]
        )));
    }
    if on_axis && let Some(wall) = parities.iter().position(Option::is_some) {
        return Err(Failure::Impossible(format!(
            "material lies on the axis, where CalculiX sets conditions of its own, and takes none at the \
             nodes that are on the axis and on `{}`; cut the full height with wedgecut --horizontal-mirror off",
            names[wall]
        )));
    }
    let note = (on_axis && sectors > 2).then(|| {
        "material lies on the axis: CalculiX takes nodal diameters 0, 1 and those above in separate steps, \
         and its frequencies for nodal diameter 1 are inexact; take these from the whole mesh"
            .to_owned()
    });
    Ok(Conditions { parities, note })
}

/// Whether a coupling maps the axis onto itself in reverse, as half turns across it and rotary
/// reflections do.
fn turns_over(coupling: &Coupling) -> bool {
    let [from, to] = coupling.axis;
    let direction = to - from;
    (coupling.matrix * direction).dot(direction) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wishes_are_read() {
        let wish = |text: &str| text.parse::<MirrorWish>();
        let all = wish("antisymmetric").unwrap();
        assert_eq!((all.wall, all.parity), (None, Some(Parity::Antisymmetric)));
        let one = wish("a=b=none").unwrap();
        assert_eq!((one.wall.as_deref(), one.parity), (Some("a=b"), None));
        assert_eq!(
            wish("wall-a=even").unwrap_err(),
            "`even` is none of symmetric, antisymmetric, none"
        );
    }
}
