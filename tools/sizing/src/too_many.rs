//! Sizes that take more elements than can be made.

use crate::across::Thinnest;
use std::fmt;

/// What is asked for would take more elements than can be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TooMany {
    /// Elements across walls.
    Walls {
        /// Template.
        template: usize,
        /// Elements asked for across.
        layers: u32,
        /// The thinnest place of its walls that was seen, and how thick it is, model units.
        thinnest: Thinnest,
    },
    /// Lengths of a size field.
    Field {
        /// Template.
        template: usize,
    },
}

impl fmt::Display for TooMany {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Walls {
                template,
                layers,
                thinnest: (thickness, near),
            } => {
                let [x, y, z] = near.to_array();
                write!(
                    f,
                    "{layers} elements across all walls of template {template} are more than can be made: walls are too thin for their \
                     width, the thinnest has {thickness:.3e} near ({x:.6e}, {y:.6e}, {z:.6e}); leave --layers-across out, and ask for \
                     small elements by --region"
                )
            }
            Self::Field { template } => write!(
                f,
                "the lengths that the size field wants in template {template} mean more elements than can be made; are they in the unit \
                 of the model?"
            ),
        }
    }
}

impl std::error::Error for TooMany {}
