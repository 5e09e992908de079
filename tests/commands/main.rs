//! The command line of each tool: options, exit codes, messages, reports, what happens to files.

mod bounds;
mod meshqual;
mod messages;
mod progress;
mod readme;
mod repairs;
mod rotassemble;
mod symdetect;
mod symtet;
mod tetwedge;
