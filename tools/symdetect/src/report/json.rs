//! The JSON report.

use crate::report::defects::Defects;
use crate::report::detection::{Detection, OrderResidual};
use serde::Serialize;
use tmesh::{Document, Symmetry};

/// What `--report` writes: the symmetry, and what it was found in.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    /// The symmetry.
    #[serde(flatten)]
    pub symmetry: &'a Symmetry,
    /// Triangles of the surface.
    pub triangles: usize,
    /// Regions of the document.
    pub regions: Vec<ReportRegion<'a>>,
    /// How far the body is off under each order about the axis.
    pub orders: &'a [OrderResidual],
    /// Defects of the surface.
    pub defects: &'a Defects,
    /// What reading the input had to mend or leave, a sentence each.
    pub input: &'a [String],
    /// Remarks, a sentence each.
    pub notes: &'a [String],
}

/// A region in the report.
#[derive(Debug, Serialize)]
pub struct ReportRegion<'a> {
    /// Id.
    pub id: u32,
    /// Name.
    pub name: &'a str,
}

impl<'a> Report<'a> {
    /// The report on a document.
    pub fn new(
        document: &'a Document,
        found: &'a Detection,
        defects: &'a Defects,
        input: &'a [String],
    ) -> Self {
        Self {
            symmetry: &found.symmetry,
            triangles: document.templates.iter().map(|t| t.triangles.len()).sum(),
            regions: (document.regions.iter())
                .map(|r| ReportRegion {
                    id: r.id,
                    name: &r.name,
                })
                .collect(),
            orders: &found.profile,
            defects,
            input,
            notes: &found.notes,
        }
    }
}

/// What `--report` writes when there is no symmetry to report.
#[derive(Debug, Serialize)]
pub struct FailureReport<'a> {
    /// Why, as on standard error.
    pub error: String,
    /// Defects of the surface.
    pub defects: &'a Defects,
    /// What reading the input had to mend or leave, a sentence each.
    pub input: &'a [String],
}
