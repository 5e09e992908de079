//! Why candidates could not be cut.

use crate::cutting::Candidate;
use crate::error::CutError;

/// A candidate that could not be cut at a place.
#[derive(Debug)]
struct Refusal {
    candidate: Candidate,
    error: CutError,
}

/// Candidates that could not be cut, in the order in which they were tried.
#[derive(Debug, Default)]
pub struct Refusals(Vec<Refusal>);

impl Refusals {
    /// Keeps why a candidate could not be cut at a place.
    pub fn add(&mut self, candidate: Candidate, error: CutError) {
        self.0.push(Refusal { candidate, error });
    }

    /// Whether a candidate has been refused.
    pub fn has(&self, candidate: Candidate) -> bool {
        self.0.iter().any(|r| r.candidate == candidate)
    }

    /// Why the first could not be cut.
    pub fn into_first(self) -> CutError {
        let first = self.0.into_iter().next();
        first.map_or(CutError::Empty, |r| r.error)
    }

    /// What was tried before a candidate was cut, a sentence for each order, for more planes, and for more places.
    pub fn notes(&self, chosen: Candidate) -> Vec<String> {
        let mut notes: Vec<String> = Vec::new();
        let order = |r: &&Refusal| r.candidate.group.order == chosen.group.order;
        let here: Vec<&Refusal> = self.0.iter().filter(|r| r.candidate == chosen).collect();
        if let Some(first) = here.first() {
            notes.push(format!(
                "cut at the angle tried as number {} (--start-angle says which): {}",
                here.len() + 1,
                first.error
            ));
        }
        if let Some(more) = self.0.iter().filter(order).find(|r| r.candidate != chosen) {
            let (wanted, less) = (more.candidate.group, chosen.group);
            notes.push(match wanted.kind == less.kind {
                true => format!("cut with fewer planes: {}", more.error),
                false => format!("cut as {less} instead of {wanted}: {}", more.error),
            });
        }
        let mut told = vec![chosen.group.order];
        for r in &self.0 {
            let order = r.candidate.group.order;
            if !told.contains(&order) {
                told.push(order);
                notes.push(format!("order {order} not cut: {}", r.error));
            }
        }
        notes
    }
}
