//! The tools as their users run them: real processes, real pipes, real files.

#[path = "../../examples/body/generator/mod.rs"]
#[allow(dead_code, unused_imports)]
mod generator;

mod bodies;
mod bounds;
mod determinism;
mod elements;
mod exchanged;
mod failures;
mod hubs;
mod makefiles;
mod pipe;
mod referee;
mod seams;
mod sections;
mod support;
