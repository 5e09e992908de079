//! From triangles in groups to a document.

use crate::closure::{groups_are_closed, odd_edges, open_surface};
use crate::coincident::merge;
use crate::document::{Labelled, check_scale, document, dropped, largest_coordinate, unique_names};
use crate::near::near_points;
use crate::needles;
use crate::place::{counted, short};
use crate::solids::{Labels, label};
use crate::soup::Soup;
use crate::{Imported, ReadError};
use geom::edges::Edges;
use glam::DVec3;
use tmesh::{OUTSIDE, Region, Template, Triangle};

/// No solid.
pub const NONE: u32 = u32::MAX;

/// Points that differ by this many roundings of the largest coordinate are joined where the surface
/// would stay open otherwise.
const ROUNDINGS: f64 = 4.0;

/// Gaps that are closed where that closes the whole surface, as shares of its size.
const GAPS: [f64; 4] = [1e-7, 1e-6, 1e-5, 1e-4];

/// A welded surface whose triangles belong to solids.
pub struct Surface {
    /// Distinct points.
    pub points: Vec<DVec3>,
    /// Three different point ids each.
    pub triangles: Vec<[u32; 3]>,
    /// Group of each triangle, as in the file.
    pub group: Vec<u32>,
    /// Solid of each triangle: its group, or 0 when the groups are pieces of one boundary.
    pub solid: Vec<u32>,
    /// The solid on the other side of an interface, or [`NONE`].
    pub partner: Vec<u32>,
    /// Names of the groups, unique.
    pub groups: Vec<String>,
    /// What a group is called in the file format.
    pub group_word: &'static str,
}

impl Surface {
    /// Positions of a triangle's corners.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.points[v as usize])
    }

    /// A group's name for a message.
    pub fn group_name(&self, group: u32) -> String {
        format!("{} '{}'", self.group_word, self.groups[group as usize])
    }

    /// Keeps the triangles that `keep` accepts.
    pub fn retain(&mut self, keep: impl Fn(usize) -> bool) {
        fn filter<T>(list: &mut Vec<T>, keep: impl Fn(usize) -> bool) {
            let mut i = 0;
            list.retain(|_| {
                i += 1;
                keep(i - 1)
            });
        }
        filter(&mut self.triangles, &keep);
        filter(&mut self.group, &keep);
        filter(&mut self.solid, &keep);
        filter(&mut self.partner, &keep);
    }

    /// Drops triangles that name a point twice; returns how many.
    pub fn drop_degenerate(&mut self) -> usize {
        let before = self.triangles.len();
        let good = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[0] != t[2];
        if !self.triangles.iter().all(good) {
            let keep: Vec<bool> = self.triangles.iter().map(good).collect();
            self.retain(|t| keep[t]);
        }
        before - self.triangles.len()
    }
}

/// Builds the document of a surface: welded, closed, with regions on the inside.
///
/// Where every group is closed by itself, groups are solids, and each is a region. Otherwise all
/// groups together must be closed: one region, and the groups are pieces of its boundary. Regions
/// and markers are numbered from 1. Linear but for nested or several pieces, which take
/// O(n log n).
///
/// # Errors
/// Open surfaces; solids that overlap, cross, or touch with different triangles.
pub fn build(soup: Soup, format: &'static str) -> Result<Imported, ReadError> {
    let Soup {
        points,
        triangles,
        group_of,
        groups,
        group_word,
        relative_precision,
        mut notices,
    } = soup;
    if triangles.is_empty() {
        return Err(ReadError::BadSurface("it has no triangles".to_owned()));
    }
    check_scale(&points)?;
    let (group, groups) = used_groups(group_of, groups.into_iter().map(|g| g.name).collect());
    let mut surface = Surface {
        solid: group.clone(),
        partner: vec![NONE; triangles.len()],
        points,
        triangles,
        group,
        groups: unique_names(groups.iter().map(String::as_str), "region"),
        group_word,
    };
    let degenerate = surface.drop_degenerate();
    if surface.triangles.is_empty() {
        return Err(ReadError::BadSurface(
            "all its triangles have two equal corners".to_owned(),
        ));
    }
    let mut edges = Edges::new(&surface.triangles);
    let mut repeated = 0;
    let merged = merge(&mut surface, &edges, false)?.dropped;
    if merged > 0 {
        repeated += merged;
        edges = Edges::new(&surface.triangles);
    }
    let mut odd = odd_edges(&edges);
    if !odd.is_empty()
        && let Some(joined) = close_gaps(&mut surface, &edges, &odd, relative_precision)
    {
        notices.push(joined);
        edges = Edges::new(&surface.triangles);
        odd = odd_edges(&edges);
    }
    if odd.is_empty() {
        let rounding = relative_precision * largest_coordinate(&surface.points);
        if let Some(removed) = needles::remove(&mut surface, rounding) {
            if removed > 0 {
                let what = counted(removed, "triangle", "triangles");
                notices.push(format!("{what} without area: removed"));
            }
            edges = Edges::new(&surface.triangles);
            odd = odd_edges(&edges);
        }
    }
    let several = surface.groups.len() > 1;
    let solids = if odd.is_empty() && several && groups_are_closed(&surface, &edges) {
        surface.groups.len()
    } else {
        surface.solid.fill(0);
        1
    };
    if several {
        let merged = merge(&mut surface, &edges, true)?;
        repeated += merged.dropped;
        if merged.dropped + merged.interfaces > 0 {
            edges = Edges::new(&surface.triangles);
            odd = odd_edges(&edges);
        }
    }
    if surface.triangles.is_empty() {
        return Err(ReadError::BadSurface(
            "all its triangles cancel each other in pairs".to_owned(),
        ));
    }
    if solids == 1
        && let Some(error) = open_surface(&surface, &edges, &odd)
    {
        return Err(error);
    }
    if degenerate > 0 {
        let (one, many) = ("triangle", "triangles");
        notices.push(dropped(degenerate, one, many, "with two equal corners"));
    }
    if repeated > 0 {
        let (one, many) = ("triangle", "triangles");
        notices.push(dropped(repeated, one, many, "that the surface has twice"));
    }
    let labels = label(&surface, &edges, solids)?;
    document(
        tables(surface, labels, solids, relative_precision, notices),
        format,
    )
}

/// Drops groups without triangles.
fn used_groups(group_of: Vec<u32>, groups: Vec<String>) -> (Vec<u32>, Vec<String>) {
    let mut new_id = vec![NONE; groups.len()];
    for &g in &group_of {
        new_id[g as usize] = 0;
    }
    let mut kept = Vec::new();
    for (id, name) in new_id.iter_mut().zip(groups) {
        if *id != NONE {
            *id = kept.len() as u32;
            kept.push(name);
        }
    }
    let group = group_of.into_iter().map(|g| new_id[g as usize]).collect();
    (group, kept)
}

/// Joins ends of odd edges: those that differ by rounding, and if that does not close the surface,
/// those within the smallest of a few shares of the size that does. Says so if that did anything.
fn close_gaps(
    surface: &mut Surface,
    edges: &Edges,
    odd: &[usize],
    relative_precision: f64,
) -> Option<String> {
    let mut ends: Vec<u32> = odd.iter().flat_map(|&e| edges.ends[e]).collect();
    ends.sort_unstable();
    ends.dedup();
    let rounding = ROUNDINGS * relative_precision * largest_coordinate(&surface.points);
    let by_rounding = joined(surface, &ends, rounding);
    let is_closed = |triangles: &[[u32; 3]]| odd_edges(&Edges::new(triangles)).is_empty();
    let rounded = by_rounding.as_ref().map(|(_, triangles)| triangles);
    if rounded.is_none_or(|triangles| !is_closed(triangles)) {
        let size = extent(surface);
        // Gaps are small beside the edges along them.
        let mut lengths: Vec<f64> = (odd.iter())
            .map(|&e| {
                let [a, b] = edges.ends[e].map(|v| surface.points[v as usize]);
                (b - a).length()
            })
            .collect();
        lengths.sort_by(f64::total_cmp);
        let shortest = lengths.first().copied().unwrap_or(0.0);
        for share in GAPS {
            let gap = share * size;
            if gap <= rounding || gap > 0.1 * shortest {
                continue;
            }
            if let Some((count, triangles)) = joined(surface, &ends, gap)
                && is_closed(&triangles)
            {
                surface.triangles = triangles;
                surface.drop_degenerate();
                return Some(format!(
                    "{} to within {}, {share:e} of the size: joined, which closes the surface",
                    counted(count, "point agrees", "points agree"),
                    short(gap)
                ));
            }
        }
    }
    let (count, triangles) = by_rounding?;
    surface.triangles = triangles;
    surface.drop_degenerate();
    Some(format!(
        "{} to within {} of each other, the rounding of the file: joined",
        counted(count, "point agrees", "points agree"),
        short(rounding)
    ))
}

/// The number of points among `ends` that others within `tolerance` stand for, and the triangles
/// with those; `None` for none.
fn joined(surface: &Surface, ends: &[u32], tolerance: f64) -> Option<(usize, Vec<[u32; 3]>)> {
    let pairs = near_points(&surface.points, ends, tolerance);
    if pairs.is_empty() {
        return None;
    }
    let mut new_id: Vec<u32> = (0..surface.points.len() as u32).collect();
    for &(from, to) in &pairs {
        new_id[from as usize] = to;
    }
    let triangles = surface.triangles.iter();
    let triangles = triangles.map(|t| t.map(|v| new_id[v as usize])).collect();
    Some((pairs.len(), triangles))
}

/// Diagonal of the bounding box.
fn extent(surface: &Surface) -> f64 {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for p in surface
        .triangles
        .iter()
        .flatten()
        .map(|v| surface.points[*v as usize])
    {
        low = low.min(p);
        high = high.max(p);
    }
    (high - low).length()
}

/// Regions and markers from labels.
fn tables(
    surface: Surface,
    labels: Labels,
    solids: usize,
    relative_precision: f64,
    mut notices: Vec<String>,
) -> Labelled {
    notices.extend(labels.notices);
    let region = |solid: u32| if solid == NONE { OUTSIDE } else { solid + 1 };
    // Interfaces are markers of their own, after those of the groups.
    let mut pairs: Vec<[u32; 2]> = (0..surface.triangles.len())
        .filter(|&t| surface.partner[t] != NONE)
        .map(|t| sorted(surface.solid[t], surface.partner[t]))
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    let groups = surface.groups.len();
    let triangles = (0..surface.triangles.len())
        .map(|t| {
            let [a, b, c] = surface.triangles[t];
            let marker = match surface.partner[t] {
                NONE => surface.group[t] as usize,
                partner => {
                    let pair = sorted(surface.solid[t], partner);
                    groups + pairs.partition_point(|p| *p < pair)
                }
            };
            let turned = labels.turned[t];
            Triangle {
                vertices: if turned { [a, c, b] } else { [a, b, c] },
                marker: marker as u32 + 1,
                front: region(labels.front[t]),
                back: region(labels.back[t]),
            }
        })
        .collect();
    let name = |solid: u32| surface.groups[solid as usize].as_str();
    let interfaces = pairs
        .iter()
        .map(|&[a, b]| format!("{}/{}", name(a), name(b)));
    let markers = (1..).zip(surface.groups.iter().cloned().chain(interfaces));
    let regions = (1..=solids as u32).map(|id| Region {
        id,
        name: if solids == groups {
            surface.groups[id as usize - 1].clone()
        } else {
            "region1".to_owned()
        },
        max_volume: None,
        volume: None,
    });
    Labelled {
        regions: regions.collect(),
        markers: markers.collect(),
        template: Template {
            triangles,
            vertices: surface.points,
            ..Template::default()
        },
        relative_precision,
        notices,
    }
}

fn sorted(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
