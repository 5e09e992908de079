//! The `meshqual` tool; see its library.

fn main() -> std::process::ExitCode {
    kit::main::<meshqual::Cli>()
}
