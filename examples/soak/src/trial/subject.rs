//! What goes through the pipe, and what is known of it.

use bodies::assembly::{Assembly, Claim, assembly};
use bodies::bladed::bladed;
use bodies::folded::{folded, unfolded};
use bodies::random_solid::{Solid, solid};
use bodies::{Body, Encoding};

/// Which bodies seeds choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Kind {
    /// Bodies drawn as one complex, with symmetry.
    Solids,
    /// Solids drawn one by one that touch, overlap or leave gaps.
    Assemblies,
    /// Hubs with blades, twisted, swept and leant.
    Bladed,
    /// Bodies whose flat facets are bent a little.
    Folded,
    /// The same bodies with the same triangles, but flat.
    Unfolded,
}

/// A body of a seed.
pub struct Subject {
    /// The body, a material per region.
    pub body: Body,
    /// File format it is to be read from.
    pub encoding: Encoding,
    /// What it is, in a few words.
    pub description: String,
    /// What is known of its symmetry.
    pub symmetry: Symmetry,
    /// What regions have, in the order of the materials.
    pub regions: Vec<Claim>,
    /// Whether that is so where solids overlap, too: otherwise they were not meant to.
    pub settled: bool,
    /// Largest distance from the axis, or from the middle.
    pub radius: f64,
    /// Largest angle by which flat facets were bent, degrees.
    pub bent: f64,
}

/// What is known of the symmetry of a body.
#[derive(Clone, Copy, Debug)]
pub enum Symmetry {
    /// The highest order about the axis it was made for, and whether mirror planes contain that.
    Known {
        /// Highest order of a rotation.
        order: usize,
        /// Whether there are mirror planes.
        mirrors: bool,
    },
    /// It has a rotation of this order; it may have more.
    AtLeast(usize),
}

impl Symmetry {
    /// The order that is known.
    pub fn order(self) -> usize {
        match self {
            Self::Known { order, .. } | Self::AtLeast(order) => order,
        }
    }
}

impl Subject {
    /// The body of a seed.
    pub fn of(kind: Kind, seed: u64) -> Self {
        match kind {
            Kind::Solids => solid(seed).into(),
            Kind::Assemblies => assembly(seed).into(),
            Kind::Folded | Kind::Unfolded => {
                let folded = match kind {
                    Kind::Folded => folded(seed),
                    _ => unfolded(seed),
                };
                let subject: Self = folded.solid.into();
                // Bends may leave out what the body was made for, and solids are symmetric by chance.
                Self {
                    symmetry: Symmetry::AtLeast(subject.symmetry.order()),
                    bent: folded.angle,
                    ..subject
                }
            }
            Kind::Bladed => {
                let subject: Self = bladed(seed).into();
                // Without twist they have mirrors, and some half turns.
                Self {
                    symmetry: Symmetry::AtLeast(subject.symmetry.order()),
                    ..subject
                }
            }
        }
    }
}

impl From<Solid> for Subject {
    fn from(solid: Solid) -> Self {
        let Solid {
            body,
            encoding,
            facts,
        } = solid;
        let description = format!(
            "{}, order {}, {} triangles, {} materials; {}",
            facts.group.symbol(),
            facts.order,
            body.faces.len(),
            body.materials.len(),
            facts.features.join(", ")
        );
        let exact = |material| Claim {
            volume: body.volume(material),
            slack: 0.0,
        };
        Self {
            description,
            symmetry: Symmetry::Known {
                order: facts.order,
                mirrors: facts.group.has_vertical_mirrors(),
            },
            regions: (0..body.materials.len()).map(exact).collect(),
            settled: false,
            radius: facts.radius,
            bent: 0.0,
            body,
            encoding,
        }
    }
}

impl From<Assembly> for Subject {
    fn from(assembly: Assembly) -> Self {
        let Assembly {
            body,
            encoding,
            regions,
            order,
            features,
        } = assembly;
        let description = format!(
            "{} triangles, {} solids; {}",
            body.faces.len(),
            body.materials.len(),
            features.join(", ")
        );
        let count = body.vertices.len().max(1) as f64;
        let middle = body.vertices.iter().sum::<glam::DVec3>() / count;
        let distances = body.vertices.iter().map(|p| p.distance(middle));
        Self {
            description,
            symmetry: Symmetry::AtLeast(order),
            regions,
            settled: true,
            radius: distances.fold(0.0, f64::max),
            bent: 0.0,
            body,
            encoding,
        }
    }
}
