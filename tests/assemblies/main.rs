//! Assemblies: bodies of several solids, from several files, whose symmetry exchanges solids, in air.

mod air;
mod crossing;
mod exchange;
mod gaps;
mod heat;
mod inputs;
mod layers;
mod motor;
mod random;
