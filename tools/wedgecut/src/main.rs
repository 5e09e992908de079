//! The `wedgecut` tool; see its library.

fn main() -> std::process::ExitCode {
    kit::main::<wedgecut::Cli>()
}
