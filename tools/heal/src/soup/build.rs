//! From polygons in groups to a document.

use super::closure::{groups_are_closed, odd_edges, open_surface};
use super::coincident::merge;
use super::gaps::close_gaps;
use super::solids::label;
use super::surface::{NONE, Surface};
use super::tables::tables;
use super::{needles, weld};
use crate::HealError;
use crate::document::{Imported, check_scale, document, largest_coordinate};
use crate::words::{dropped, unique_names};
use geom::edges::Edges;
use interchange::parsed::Soup;
use interchange::text::counted;

/// Builds the document of a surface: welded, closed, with regions on the inside.
///
/// Where every group is closed by itself, groups are solids, and each is a region. Otherwise all
/// groups together must be closed: one region, and the groups are pieces of its boundary. Regions
/// and markers are numbered from 1. Linear but for nested or several pieces, which take
/// O(n log n).
///
/// # Errors
/// Open surfaces; solids that overlap, cross, or touch with different triangles.
pub fn build(mut soup: Soup, format: &'static str) -> Result<Imported, HealError> {
    let relative_precision = soup.relative_precision;
    let notices = std::mem::take(&mut soup.notices);
    let mut surface = welded(soup)?;
    let (one, many) = ("triangle", "triangles");
    let degenerate = surface.drop_degenerate();
    if surface.triangles.is_empty() {
        return Err(HealError::BadSurface(
            "all its triangles have two equal corners".to_owned(),
        ));
    }
    let mut mending = Mending::new(surface, relative_precision, notices);
    mending.merge(false)?;
    mending.close_gaps();
    mending.remove_needles();
    let solids = mending.tell_solids();
    if mending.surface.groups.len() > 1 {
        mending.merge(true)?;
    }
    let Mending {
        surface,
        edges,
        odd,
        repeated,
        mut notices,
        ..
    } = mending;
    if surface.triangles.is_empty() {
        return Err(HealError::BadSurface(
            "all its triangles cancel each other in pairs".to_owned(),
        ));
    }
    if solids == 1
        && let Some(error) = open_surface(&surface, &edges, &odd)
    {
        return Err(error);
    }
    if degenerate > 0 {
        notices.push(dropped(degenerate, one, many, "with two equal corners"));
    }
    if repeated > 0 {
        notices.push(dropped(repeated, one, many, "that the surface has twice"));
    }
    let mut labels = label(&surface, &edges, solids)?;
    notices.append(&mut labels.notices);
    let mut labelled = tables(surface, labels, solids);
    labelled.relative_precision = relative_precision;
    labelled.notices = notices;
    document(labelled, format)
}

/// The triangles of a soup by distinct points, in groups that have triangles.
fn welded(soup: Soup) -> Result<Surface, HealError> {
    let weld::Welded {
        points,
        triangles,
        group,
    } = weld::weld(soup.points, soup.faces, &soup.group_of);
    if triangles.is_empty() {
        return Err(HealError::BadSurface("it has no triangles".to_owned()));
    }
    check_scale(&points)?;
    let names = soup.groups.into_iter().map(|g| g.name).collect();
    let (group, groups) = used_groups(group, names);
    Ok(Surface {
        solid: group.clone(),
        partner: vec![NONE; triangles.len()],
        points,
        triangles,
        group,
        groups: unique_names(groups.iter().map(String::as_str), "region"),
        group_word: soup.group_word,
    })
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

/// A surface while it is mended, and what was done.
struct Mending {
    surface: Surface,
    edges: Edges,
    /// Edges with an odd number of triangles.
    odd: Vec<usize>,
    /// Triangles dropped because the surface has them more than once.
    repeated: usize,
    relative_precision: f64,
    notices: Vec<String>,
}

impl Mending {
    fn new(surface: Surface, relative_precision: f64, notices: Vec<String>) -> Self {
        let edges = Edges::new(&surface.triangles);
        Self {
            odd: odd_edges(&edges),
            surface,
            edges,
            repeated: 0,
            relative_precision,
            notices,
        }
    }

    fn update_edges(&mut self) {
        self.edges = Edges::new(&self.surface.triangles);
        self.odd = odd_edges(&self.edges);
    }

    /// Merges triangles with the same corners, of one solid, or `across` solids.
    fn merge(&mut self, across: bool) -> Result<(), HealError> {
        let merged = merge(&mut self.surface, &self.edges, across)?;
        self.repeated += merged.dropped;
        if merged.dropped + merged.interfaces > 0 {
            self.update_edges();
        }
        Ok(())
    }

    fn close_gaps(&mut self) {
        if self.odd.is_empty() {
            return;
        }
        let (edges, odd) = (&self.edges, &self.odd);
        if let Some(joined) = close_gaps(&mut self.surface, edges, odd, self.relative_precision) {
            self.notices.push(joined);
            self.update_edges();
        }
    }

    /// Removes triangles without area, unless the surface is open: then they may belong to its rim.
    fn remove_needles(&mut self) {
        if !self.odd.is_empty() {
            return;
        }
        let rounding = self.relative_precision * largest_coordinate(&self.surface.points);
        if let Some(removed) = needles::remove(&mut self.surface, rounding) {
            if removed > 0 {
                let what = counted(removed, "triangle", "triangles");
                self.notices.push(format!("{what} without area: removed"));
            }
            self.update_edges();
        }
    }

    /// The number of solids: groups are solids where each is closed, else all of them are one.
    fn tell_solids(&mut self) -> usize {
        let several = self.surface.groups.len() > 1;
        if self.odd.is_empty() && several && groups_are_closed(&self.surface, &self.edges) {
            return self.surface.groups.len();
        }
        self.surface.solid.fill(0);
        1
    }
}
