//! A trial of the soak test: a random solid goes through the whole pipe with random options, and what comes
//! out is compared with what is known of the solid.

mod trial;

pub use trial::{Laboratory, Trial, Verdict};
