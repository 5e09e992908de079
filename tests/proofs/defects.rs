//! What another writer may do wrong, and what looks wrong and is not.

use crate::part::{Part, Placement};
use glam::DVec3;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defect {
    None,
    OtherOrderOfInstances,
    NoWalls,
    NoWallsAndOneCopy,
    OneWallMissing,
    VertexPairsShuffled,
    TrianglePairsShuffled,
    AVertexPairMissing,
    ATrianglePairMissing,
    ACopyLeftOut,
    ACopyLeftOutWithoutWalls,
    EverySecondCopyWithoutWalls,
    ACopyTwice,
    ACopyTwiceByRounding,
    ACopyTwiceByRoundingWithoutWalls,
    ACopyTurnedOverWithoutWalls,
    CopiesApartWithoutWalls,
    NothingPlaced,
    AnotherVolume,
    AnotherBoundary,
    AVertexMoved,
    AWallVertexMoved,
    ATetrahedronMissing,
    ATetrahedronInsideOut,
    ATriangleMissing,
    AnAxisVertexTwice,
}

impl Defect {
    pub const ALL: [Self; 26] = [
        Self::None,
        Self::OtherOrderOfInstances,
        Self::NoWalls,
        Self::NoWallsAndOneCopy,
        Self::OneWallMissing,
        Self::VertexPairsShuffled,
        Self::TrianglePairsShuffled,
        Self::AVertexPairMissing,
        Self::ATrianglePairMissing,
        Self::ACopyLeftOut,
        Self::ACopyLeftOutWithoutWalls,
        Self::EverySecondCopyWithoutWalls,
        Self::ACopyTwice,
        Self::ACopyTwiceByRounding,
        Self::ACopyTwiceByRoundingWithoutWalls,
        Self::ACopyTurnedOverWithoutWalls,
        Self::CopiesApartWithoutWalls,
        Self::NothingPlaced,
        Self::AnotherVolume,
        Self::AnotherBoundary,
        Self::AVertexMoved,
        Self::AWallVertexMoved,
        Self::ATetrahedronMissing,
        Self::ATetrahedronInsideOut,
        Self::ATriangleMissing,
        Self::AnAxisVertexTwice,
    ];

    /// Changes a sound document; false where that cannot be done to it.
    pub fn apply(self, part: &mut Part) -> bool {
        let copies = part.instances.len();
        let ends = |pairs: &mut Vec<[u32; 2]>| {
            let last = pairs.len() - 1;
            let there = pairs[0][1];
            pairs[0][1] = pairs[last][1];
            pairs[last][1] = there;
        };
        match self {
            Self::None => {}
            Self::OtherOrderOfInstances => part.instances.rotate_left(copies / 2),
            Self::NoWalls => part.glues.clear(),
            Self::NoWallsAndOneCopy => {
                part.glues.clear();
                part.instances.truncate(1);
            }
            Self::OneWallMissing => drop(part.glues.pop()),
            Self::VertexPairsShuffled => ends(&mut part.glues[0].vertices),
            Self::TrianglePairsShuffled => ends(&mut part.glues[0].triangles),
            Self::AVertexPairMissing => drop(part.glues[0].vertices.pop()),
            Self::ATrianglePairMissing => drop(part.glues[0].triangles.pop()),
            Self::ACopyLeftOut => drop(part.instances.pop()),
            Self::ACopyLeftOutWithoutWalls => {
                part.glues.clear();
                part.instances.pop();
            }
            Self::EverySecondCopyWithoutWalls => {
                part.glues.clear();
                let mut number = 0;
                part.instances.retain(|_| {
                    number += 1;
                    number % 2 == 1
                });
            }
            Self::ACopyTwice => part.instances.push(part.instances[1]),
            Self::ACopyTwiceByRounding => part.instances.push(nearly(part.instances[1])),
            Self::ACopyTwiceByRoundingWithoutWalls => {
                part.glues.clear();
                part.instances.truncate(1);
                part.instances.push(nearly(part.instances[0]));
            }
            Self::ACopyTurnedOverWithoutWalls => {
                part.glues.clear();
                part.vertices.iter_mut().for_each(|p| p.z -= 0.25);
                part.instances = [false, true]
                    .map(|f| Placement::new(0, 1, false, f))
                    .to_vec();
            }
            Self::CopiesApartWithoutWalls => {
                part.glues.clear();
                part.vertices.iter_mut().for_each(|p| p.z += 1.0);
                part.instances = [false, true]
                    .map(|f| Placement::new(0, 1, false, f))
                    .to_vec();
            }
            Self::NothingPlaced => part.instances.clear(),
            Self::AnotherVolume | Self::AnotherBoundary => {
                let Some(source) = &mut part.source else {
                    return false;
                };
                source[usize::from(self == Self::AnotherBoundary)] *= 1.001;
            }
            Self::AVertexMoved => {
                let last = part.vertices.len() - 1;
                part.vertices[last] += DVec3::splat(1e-3);
            }
            Self::AWallVertexMoved => {
                let v = part.glues[0].vertices[0][0] as usize;
                part.vertices[v] += DVec3::splat(1e-9);
            }
            Self::ATetrahedronMissing => drop(part.tets.pop()),
            Self::ATetrahedronInsideOut => part.tets[0].0.swap(0, 1),
            Self::ATriangleMissing => {
                let glued = |t: u32| {
                    part.glues
                        .iter()
                        .flat_map(|g| g.triangles.iter().flatten())
                        .any(|&u| u == t)
                };
                let last = part.triangles.len() as u32 - 1;
                if glued(last) {
                    return false;
                }
                part.triangles.pop();
            }
            Self::AnAxisVertexTwice => {
                // As if the axis had not been welded: the last tetrahedron gets a corner of its own.
                let tet = &mut part.tets.last_mut().expect("tetrahedra").0;
                part.vertices.push(part.vertices[tet[0] as usize]);
                tet[0] = part.vertices.len() as u32 - 1;
            }
        }
        true
    }
}

/// A placement a ten thousandth of a turn or so farther, as a fraction that the format can hold.
fn nearly(p: Placement) -> Placement {
    let fine = 65_536 / p.n;
    Placement::new(p.k * fine + 1, p.n * fine, p.mirrored, p.flipped)
}
