//! The report as people see it: text, page, histograms and pictures.

mod canvas;
mod html;
mod layout;
mod palette;
mod picture;
mod svg;
mod text;
mod view;
mod words;

pub use html::{Pictures, html};
pub use svg::svg;
pub use text::text;
