//! The `rotassemble` tool; see its library.

fn main() -> std::process::ExitCode {
    kit::main::<rotassemble::Cli>()
}
