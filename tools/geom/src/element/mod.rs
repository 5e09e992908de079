//! Single triangles and tetrahedra: measures and exact predicates.

pub mod measure;
pub mod predicate;
pub mod tet;
