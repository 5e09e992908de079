//! The `tetwedge` tool; see its library.

fn main() -> std::process::ExitCode {
    kit::main::<tetwedge::Cli>()
}
