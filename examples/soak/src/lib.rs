//! A trial of the soak test: a random body goes through the whole pipe with random options, and what comes
//! out is compared with what is known of the body.

mod trial;

pub use trial::{Figures, Kind, Laboratory, Subject, Trial, Verdict, Versus};
