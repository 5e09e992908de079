//! The JSON report.

use crate::nearly::Nearly;
use crate::report::defects::Defects;
use crate::report::detection::{Detection, OrderResidual};
use crate::report::deviations::Deviations;
use heal::{Gap, Joined, Repair};
use kit::{InputFile, Session};
use serde::Serialize;
use tmesh::{Axis, Document, Group, Isometry, OtherAxis, RejectedOrder, Symmetry};

/// What `--report` writes: the symmetry, and what it was found in.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    /// The group about the main axis.
    pub group: Group,
    /// Order of the rotation about the main axis.
    pub order: u32,
    /// Whether mirror planes contain the axis.
    pub mirror: bool,
    /// Whether a mirror plane is orthogonal to the axis.
    pub horizontal_mirror: bool,
    /// The main axis.
    pub axis: &'a Axis,
    /// The canonical x axis; see [`Symmetry::reference`].
    pub mirror_direction: [f64; 3],
    /// Largest deviation, relative to the radius.
    pub residual: f64,
    /// Deviation allowed, relative to the radius.
    pub tolerance: f64,
    /// What facets explain of the residual, and what remains.
    pub deviations: Deviations,
    /// Whether the body is one of revolution.
    pub axisymmetric: bool,
    /// Largest distance of a surface point from the axis.
    pub radius: f64,
    /// Further axes, and orders that do not hold.
    #[serde(flatten)]
    pub search: ReportSearch<'a>,
    /// A rotation that nearly holds, and what breaks it; null where there is none.
    pub nearly: Option<&'a Nearly>,
    /// How the rotation and the mirrors permute regions.
    #[serde(flatten)]
    pub permutations: ReportPermutations,
    /// Triangles of the surface.
    pub triangles: usize,
    /// Regions of the document.
    pub regions: Vec<ReportRegion<'a>>,
    /// How far the body is off under each order about the axis.
    pub orders: &'a [OrderResidual],
    /// Defects of the surface.
    pub defects: &'a Defects,
    /// The files that the body was read from.
    pub files: Vec<String>,
    /// What reading the input had to mend or leave, a sentence each.
    pub input: &'a [String],
    /// What was repaired of the input.
    pub repairs: Vec<ReportRepair>,
    /// What was done to make one body of solids that touch or overlap.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joined: Option<ReportJoined<'a>>,
    /// Gaps between solids, the narrowest first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gaps: Vec<ReportGap<'a>>,
    /// Remarks, a sentence each.
    pub notes: &'a [String],
}

/// What else the search came across.
#[derive(Debug, Serialize)]
pub struct ReportSearch<'a> {
    /// Further symmetry axes, strongest first.
    pub other_axes: &'a [OtherAxis],
    /// Orders that were tried and do not hold.
    pub rejected: &'a [RejectedOrder],
}

/// Pairs (from, to) of region ids that operations exchange; left out where there are none.
#[derive(Debug, Serialize)]
pub struct ReportPermutations {
    /// By one step of the rotation.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rotation_regions: Vec<[u32; 2]>,
    /// By the mirror at the mirror direction.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mirror_regions: Vec<[u32; 2]>,
    /// By the mirror across the axis.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub horizontal_regions: Vec<[u32; 2]>,
    /// Sets of regions that the group exchanges.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub exchanged_regions: Vec<Vec<u32>>,
    /// The part of the group that keeps every region, where that is not all of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub keeping_regions: Option<ReportGroup>,
}

impl ReportPermutations {
    fn of(symmetry: &Symmetry) -> Self {
        let pairs = |g: Isometry| symmetry.region_map(g).pairs;
        Self {
            rotation_regions: pairs(symmetry.group.rotation()),
            mirror_regions: pairs(Isometry::MIRROR),
            horizontal_regions: pairs(Isometry::FLIP),
            exchanged_regions: symmetry.exchanged_regions(),
            keeping_regions: Some(symmetry.keeping_regions())
                .filter(|keeping| *keeping != symmetry.group)
                .map(|group| ReportGroup {
                    group,
                    order: group.order,
                }),
        }
    }
}

/// A group in the report.
#[derive(Debug, Serialize)]
pub struct ReportGroup {
    /// The group about the main axis.
    pub group: Group,
    /// Order of the rotation.
    pub order: u32,
}

/// A region in the report.
#[derive(Debug, Serialize)]
pub struct ReportRegion<'a> {
    /// Id.
    pub id: u32,
    /// Name.
    pub name: &'a str,
}

/// A kind of repair in the report.
#[derive(Debug, Serialize)]
pub struct ReportRepair {
    /// The kind.
    pub name: &'static str,
    /// How many there were.
    pub count: usize,
    /// The farthest that a point of the surface was moved, model units.
    pub largest_gap: f64,
    /// Where that was, or where the first one was if nothing moved.
    pub at: [f64; 3],
}

impl ReportRepair {
    fn of(repair: &Repair) -> Self {
        Self {
            name: repair.name(),
            count: repair.count,
            largest_gap: repair.largest,
            at: repair.place.to_array(),
        }
    }
}

impl<'a> Report<'a> {
    /// The report on a document.
    pub fn new(
        document: &'a Document,
        found: &'a Detection,
        (joined, defects, gaps): (Option<&'a Joined>, &'a Defects, &[Gap]),
        session: &'a Session,
    ) -> Self {
        let symmetry = &found.symmetry;
        Self {
            group: symmetry.group,
            order: symmetry.group.order,
            mirror: symmetry.group.has_vertical_mirrors(),
            horizontal_mirror: symmetry.group.has_horizontal_mirror(),
            axis: &symmetry.axis,
            mirror_direction: symmetry.reference,
            residual: symmetry.residual,
            tolerance: symmetry.tolerance,
            deviations: found.deviations,
            axisymmetric: symmetry.axisymmetric,
            radius: symmetry.radius,
            search: ReportSearch {
                other_axes: &found.search.other_axes,
                rejected: &found.search.rejected,
            },
            nearly: found.nearly.as_ref(),
            permutations: ReportPermutations::of(symmetry),
            triangles: document.templates.iter().map(|t| t.triangles.len()).sum(),
            regions: (document.regions.iter())
                .map(|r| ReportRegion {
                    id: r.id,
                    name: &r.name,
                })
                .collect(),
            orders: &found.profile,
            defects,
            files: session.inputs().iter().map(InputFile::label).collect(),
            input: session.notices(),
            repairs: session.repairs().iter().map(ReportRepair::of).collect(),
            joined: joined.map(ReportJoined::of),
            gaps: gaps.iter().map(|g| ReportGap::of(g, document)).collect(),
            notes: &found.notes,
        }
    }
}

/// A gap between two solids.
#[derive(Debug, Serialize)]
pub struct ReportGap<'a> {
    /// The names of both.
    pub regions: [&'a str; 2],
    /// How far apart they are where they are nearest, model units.
    pub width: f64,
    /// The middle between them there.
    pub near: [f64; 3],
}

impl<'a> ReportGap<'a> {
    /// A gap between regions of a document.
    pub fn of(gap: &Gap, document: &'a Document) -> Self {
        let name = |id: u32| {
            let region = document.regions.iter().find(|r| r.id == id);
            region.map_or("", |r| r.name.as_str())
        };
        Self {
            regions: gap.regions.map(name),
            width: gap.width,
            near: gap.near.to_array(),
        }
    }
}

/// What was done to make one body of solids that touch or overlap.
#[derive(Debug, Serialize)]
pub struct ReportJoined<'a> {
    /// Triangles between solids.
    pub interfaces: usize,
    /// The farthest that something was moved, model units.
    pub largest: f64,
    /// Points that were added where faces cross.
    pub points: usize,
    /// Pairs of solids that claimed the same space.
    pub overlaps: Vec<ReportOverlap<'a>>,
    /// The volumes of solids before and after.
    pub volumes: Vec<ReportVolume<'a>>,
}

/// Space that two solids claimed.
#[derive(Debug, Serialize)]
pub struct ReportOverlap<'a> {
    /// The solid that has it.
    pub by: &'a str,
    /// The one that it was taken from.
    pub from: &'a str,
    /// Its volume.
    pub volume: f64,
}

/// The volume of a solid before and after.
#[derive(Debug, Serialize)]
pub struct ReportVolume<'a> {
    /// Its name.
    pub name: &'a str,
    /// In the file.
    pub before: f64,
    /// Of its region.
    pub after: f64,
}

impl<'a> ReportJoined<'a> {
    fn of(joined: &'a Joined) -> Self {
        let overlap = |c: &'a heal::Claimed| ReportOverlap {
            by: &c.by,
            from: &c.from,
            volume: c.volume,
        };
        let volume = |v: &'a heal::Changed| ReportVolume {
            name: &v.name,
            before: v.before,
            after: v.after,
        };
        Self {
            interfaces: joined.interfaces,
            largest: joined.largest,
            points: joined.points,
            overlaps: joined.overlaps.iter().map(overlap).collect(),
            volumes: joined.volumes.iter().map(volume).collect(),
        }
    }
}

/// What `--report` writes when there is no symmetry to report.
#[derive(Debug, Serialize)]
pub struct FailureReport<'a> {
    /// Why, as on standard error.
    pub error: String,
    /// The files that the body was to be read from.
    pub files: Vec<String>,
    /// Defects of the surface.
    pub defects: &'a Defects,
    /// What reading the input had to mend or leave, a sentence each.
    pub input: &'a [String],
}
