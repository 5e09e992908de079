//! The `periodic-surf` tool; see its library.

fn main() -> std::process::ExitCode {
    kit::main::<periodic_surf::Cli>()
}
