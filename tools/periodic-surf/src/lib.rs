//! Makes the surface mesh of a wedge whose glued faces are images of each other, by the libraries `surface` and `tetwedge`.

mod cli;

pub use cli::Cli;
