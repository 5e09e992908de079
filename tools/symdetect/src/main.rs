//! The `symdetect` tool; see its library.

fn main() -> std::process::ExitCode {
    kit::main::<symdetect::Cli>()
}
