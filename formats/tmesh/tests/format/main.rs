//! The bytes of a document: what is written, what is read back, what is refused.

mod golden;
mod isometries;
mod refused;
mod samples;
