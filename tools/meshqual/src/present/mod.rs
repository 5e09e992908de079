//! The report as people see it: text, page, histograms and pictures.

mod drawing;
mod html;
mod svg;
mod text;
mod words;

pub use html::{Pictures, html};
pub use svg::svg;
pub use text::text;
