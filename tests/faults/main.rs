//! Faults injected for real into the tools: signals, pipes that break or trickle, full disks, inputs that
//! vanish, a mesher that dies. After each the exit code is the contract's, one sentence says why, no part
//! of an output stands under its name, and no temporary file is left (but by SIGKILL).
//!
//! Every test prints a line per kind of fault and stage. `FAULTS=N` runs each fault N times as often;
//! `make faults` does, and shows the lines.

#[path = "../../examples/body/generator/mod.rs"]
#[allow(dead_code, unused_imports)]
mod generator;
#[path = "../flows/support.rs"]
#[allow(dead_code)]
mod support;

mod bench;
mod disks;
mod inputs;
mod makefiles;
mod mesher;
mod pipes;
mod signals;
