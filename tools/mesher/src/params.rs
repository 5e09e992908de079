//! What is asked of the mesher, in numbers.

use std::time::Duration;
use tmesh::Wishes;

/// What is asked of the elements and of the mesher, in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Params {
    /// Whether elements are improved at all; false gives a plain constrained tetrahedralization.
    pub quality: bool,
    /// Largest ratio of circumradius to shortest edge, above 0.612.
    pub radius_edge: f64,
    /// Smallest dihedral angle, degrees.
    pub min_dihedral: f64,
    /// Whether these bounds are those that hold where nobody asks for others.
    pub default_bounds: bool,
    /// Largest dihedral angle that optimization leaves alone, degrees; `None` leaves elements as the mesher
    /// makes them.
    pub optimize: Option<f64>,
    /// Time limit for each template.
    pub timeout: Option<Duration>,
    /// Memory that the mesher may take for each template, bytes.
    pub max_memory: Option<u64>,
    /// Switches of the mesher's own, appended.
    pub switches: String,
}

impl Params {
    /// What a document's wishes come to, and no limit of memory.
    pub fn new(wishes: &Wishes) -> Self {
        Self {
            quality: wishes.quality(),
            radius_edge: wishes.radius_edge(),
            min_dihedral: wishes.min_dihedral(),
            default_bounds: wishes.radius_edge() == Wishes::RADIUS_EDGE
                && wishes.min_dihedral() == Wishes::MIN_DIHEDRAL,
            optimize: wishes.optimize(),
            timeout: wishes.timeout(),
            max_memory: None,
            switches: String::new(),
        }
    }

    /// The smallest dihedral angle that improvement is to reach, degrees: that beside the largest one, and the one asked for at
    /// least. `None` where elements stay as the mesher makes them.
    pub fn angle(&self) -> Option<f64> {
        let largest = self.optimize.filter(|_| self.quality)?;
        Some(Wishes::smallest_beside(largest).max(self.min_dihedral))
    }
}

impl Default for Params {
    fn default() -> Self {
        Self::new(&Wishes::default())
    }
}
