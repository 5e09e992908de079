//! Faults injected for real into the tools: signals, pipes that break or trickle, full disks, inputs that
//! vanish, a mesher that dies. After each the exit code is the contract's, one sentence says why, no part
//! of an output stands under its name, and no temporary file is left (but by SIGKILL).
//!
//! Every test prints a line per kind of fault and stage. `FAULTS=N` runs each fault N times as often;
//! `make faults` does, and shows the lines.

mod bench;
mod disks;
mod inputs;
mod makefiles;
mod mesher;
mod pipes;
mod signals;
