//! Points by place: equal ones, and near ones.

pub mod grid;
pub mod weld;
