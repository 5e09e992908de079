//! The command line of each tool: options, exit codes, messages, reports, what happens to files.

mod bounds;
mod meshqual;
mod messages;
mod packages;
mod progress;
mod readme;
mod repairs;
mod rotassemble;
mod size_field;
mod symdetect;
mod symtet;
mod tetwedge;
