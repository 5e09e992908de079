//! Random assemblies: solids drawn one by one, each with triangles of its own, that touch in planes and on cylinders,
//! overlap, lie in one another or leave gaps. What each of them has in the end is known.

mod blocks;
mod draw;
mod inlays;
mod pins;
mod rings;
mod sectors;

use crate::{Body, Dice, Encoding, Placement};
use draw::Drawing;

/// A random assembly, where it is, and what is known of it.
pub struct Assembly {
    /// A material per solid, each closed by itself; placed.
    pub body: Body,
    /// File format it is to be read from.
    pub encoding: Encoding,
    /// What its regions have, in the order of the materials.
    pub regions: Vec<Claim>,
    /// An order of a rotation that maps it onto itself, names of solids left out.
    pub order: usize,
    /// Features, in a few words.
    pub features: Vec<String>,
}

/// What a region has.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Volume, model units cubed.
    pub volume: f64,
    /// By how much facets let that differ: two polygons for one circle.
    pub slack: f64,
}

/// Of so many seeds, one has an assembly of solids that fill what is between others.
const INLAID: u64 = 7;

/// The assembly of a seed.
pub fn assembly(seed: u64) -> Assembly {
    let mut dice = Dice::new(seed);
    let mut drawing = Drawing::default();
    // The others are as seeds had them before there were inlays.
    match dice.below(4) {
        _ if seed % INLAID == INLAID / 2 => inlays::draw(&mut drawing, &mut dice),
        0 => blocks::draw(&mut drawing, &mut dice),
        1 => rings::draw(&mut drawing, &mut dice),
        2 => pins::draw(&mut drawing, &mut dice),
        _ => sectors::draw(&mut drawing, &mut dice),
    }
    let Drawing {
        mut body,
        mut regions,
        order,
        mut features,
    } = drawing;
    let scale = match dice.chance(0.3) {
        true => dice.log_between(1e-3, 1e3),
        false => 1.0,
    };
    let rotate = dice.chance(0.7).then(|| dice.seed());
    let placement = Placement {
        rotate,
        scale,
        jitter: 0.0,
    };
    placement.apply(&mut body);
    for claim in &mut regions {
        claim.volume *= scale.powi(3);
        claim.slack *= scale.powi(3);
    }
    let encoding = match dice.below(4) {
        0 => Encoding::Obj,
        // As kernels write them: six digits and more.
        1 => Encoding::StlAscii { digits: Some(8) },
        _ => Encoding::StlAscii { digits: None },
    };
    let placed = if rotate.is_some() { "placed, " } else { "" };
    features.push(format!("{placed}scale {scale:.1e}, {encoding:?}"));
    Assembly {
        body,
        encoding,
        regions,
        order,
        features,
    }
}
