//! How many edges feature curves have, and how many they should have.

use crate::mesh::Mesh;

/// Of each feature curve, how many edges it has too many, less than zero for too few.
///
/// Edges that are joined by twos from short ones end up anywhere between 0.7 and 1.4 times the length wanted, all alike along a
/// curve, and no single one of them is worth joining. But a curve as long as six edges that has seven of them has one too
/// many: without it the others get, moved along the curve, the length that is wanted.
pub struct Rows(Vec<f64>);

impl Rows {
    /// Counts edges and what lengths are wanted for. n log n.
    pub fn new(mesh: &Mesh<'_>) -> Self {
        let mut spare: Vec<f64> = Vec::new();
        for [a, b] in mesh.edges() {
            if let Some(curve) = mesh.curve(a, b) {
                let curve = curve as usize;
                spare.resize(spare.len().max(curve + 1), 0.0);
                spare[curve] += 1.0 - mesh.relative([a, b]);
            }
        }
        Self(spare)
    }

    /// No curve has too many or too few.
    pub fn unknown() -> Self {
        Self(Vec::new())
    }

    /// Whether a curve is nearer to what is wanted with one edge fewer.
    pub fn has_too_many(&self, curve: u32) -> bool {
        self.spare(curve) >= 0.5
    }

    /// Whether a curve is known to have as many edges as are wanted, or more.
    pub fn has_enough(&self, curve: u32) -> bool {
        self.0.len() > curve as usize && self.spare(curve) > -0.5
    }

    /// Notes edges that a curve has gained, or lost.
    pub fn change(&mut self, curve: u32, by: f64) {
        if let Some(spare) = self.0.get_mut(curve as usize) {
            *spare += by;
        }
    }

    fn spare(&self, curve: u32) -> f64 {
        self.0.get(curve as usize).copied().unwrap_or(0.0)
    }
}
