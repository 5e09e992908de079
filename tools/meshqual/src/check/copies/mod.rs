//! Copies meet nowhere but where they are glued.
//!
//! The mesh that instances stand for conforms if the templates do, if the faces that gluings list are paired
//! one to one (both checked elsewhere), and if the rest of the copies' boundaries keep apart: no two vertices
//! coincide that no gluing makes one, no two faces lie on each other, and no two faces cross. Only outer faces are placed
//! for that, never the inside of a copy, and only of copies that may meet: see [`near`].

mod near;
mod rim;
mod surface;
mod unglued;

pub use unglued::check;
