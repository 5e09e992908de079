//! What is done to a welded surface before its sides are told apart.

use super::closure::{groups_are_closed, odd_edges, open_surface};
use super::coincident::merge;
use super::needles;
use super::shells::solids_of_shells;
use super::stitch::{Division, close, divide_alike};
use super::surface::Surface;
use crate::document::{largest_coordinate, tolerance};
use crate::words::unique_names;
use crate::{HealError, Repair, RepairKind};
use geom::edges::Edges;
use geom::tolerance::Tolerance;
use glam::DVec3;

/// A surface while it is mended, and what was done.
pub struct Mending {
    /// The surface.
    pub surface: Surface,
    /// Its edges.
    pub edges: Edges,
    /// Edges with an odd number of triangles.
    pub odd: Vec<usize>,
    /// What was repaired, a kind each.
    pub repairs: Vec<Repair>,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
    /// The same if there is no more of the numbers than what is printed of them.
    pub printed_precision: f64,
}

impl Mending {
    /// Nothing is mended yet. `precision` is the largest error of a coordinate relative to the largest one, and the same if there
    /// is no more of the numbers than what is printed of them.
    pub fn new(surface: Surface, [relative_precision, printed_precision]: [f64; 2]) -> Self {
        let edges = Edges::new(&surface.triangles);
        Self {
            odd: odd_edges(&edges),
            surface,
            edges,
            repairs: Vec::new(),
            relative_precision,
            printed_precision,
        }
    }

    fn update_edges(&mut self) {
        self.edges = Edges::new(&self.surface.triangles);
        self.odd = odd_edges(&self.edges);
    }

    /// Adds a repair that moves nothing to those of its kind.
    fn repaired(&mut self, kind: RepairKind, count: usize, place: DVec3) {
        match self.repairs.iter_mut().find(|r| r.kind == kind) {
            Some(known) => known.count += count,
            None => self.repairs.push(Repair::in_place(kind, count, place)),
        }
    }

    /// Drops triangles with two equal corners.
    ///
    /// # Errors
    /// There are no others.
    pub fn drop_collapsed(&mut self) -> Result<(), HealError> {
        if let Some((count, place)) = self.surface.drop_collapsed() {
            self.repaired(RepairKind::Collapsed, count, place);
            self.update_edges();
        }
        if self.surface.triangles.is_empty() {
            return Err(HealError::BadSurface(
                "all its triangles have two equal corners".to_owned(),
            ));
        }
        Ok(())
    }

    /// Merges triangles with the same corners, of one solid, or `across` solids.
    ///
    /// # Errors
    /// More than two solids at one triangle.
    pub fn merge(&mut self, across: bool) -> Result<(), HealError> {
        let merged = merge(&mut self.surface, &self.edges, across)?;
        if let Some(place) = merged.first {
            self.repaired(RepairKind::Repeated, merged.dropped, place);
        }
        if merged.dropped + merged.interfaces > 0 {
            self.update_edges();
        }
        Ok(())
    }

    /// Closes cracks of an open surface: of each group where that closes them all, or else of all groups together.
    ///
    /// # Errors
    /// The surface stays open, or would be closed wrongly.
    pub fn close(&mut self) -> Result<(), HealError> {
        if self.odd.is_empty() {
            return Ok(());
        }
        let tolerance = tolerance(&self.surface.points, self.relative_precision);
        let several = self.surface.groups.len() > 1;
        if several && self.close_groups(&tolerance) {
            return Ok(());
        }
        match close(&mut self.surface, &tolerance) {
            Ok(closed) => {
                self.repairs.extend(closed.repairs);
                self.update_edges();
                Ok(())
            }
            Err(reason) => {
                let open = open_surface(&self.surface, &self.edges, &self.odd);
                open.map_or(Ok(()), |error| Err(error.because(reason.as_deref())))
            }
        }
    }

    /// Closes each group by itself; whether that closes all of them.
    fn close_groups(&mut self, tolerance: &Tolerance) -> bool {
        let mut closed = Vec::new();
        for group in 0..self.surface.groups.len() as u32 {
            let mut part = self.surface.part(group);
            let edges = Edges::new(&part.triangles);
            if odd_edges(&edges).is_empty() {
                continue;
            }
            let Ok(done) = close(&mut part, tolerance) else {
                return false;
            };
            closed.push((group, part, done));
        }
        // Round by round, of all groups together.
        let mut divided: Vec<Vec<Division>> = Vec::new();
        for (group, part, done) in closed {
            self.surface.take_group(group, part);
            for (i, round) in done.divided.into_iter().enumerate() {
                match divided.get_mut(i) {
                    Some(all) => all.extend(round),
                    None => divided.push(round),
                }
            }
            for repair in done.repairs {
                match self.repairs.iter_mut().find(|r| r.kind == repair.kind) {
                    Some(known) => known.add(&repair),
                    None => self.repairs.push(repair),
                }
            }
        }
        for round in divided {
            divide_alike(&mut self.surface, &round);
        }
        self.update_edges();
        true
    }

    /// Removes triangles without area.
    pub fn remove_flat(&mut self) {
        let rounding = self.relative_precision * largest_coordinate(&self.surface.points);
        if let Some((removed, place)) = needles::remove(&mut self.surface, rounding) {
            if removed > 0 {
                self.repaired(RepairKind::Flat, removed, place);
            }
            self.update_edges();
        }
    }

    /// Makes each closed shell of a group a group of its own, if all groups are closed.
    pub fn divide_into_shells(&mut self) {
        let Some((solid, groups)) = solids_of_shells(&self.surface, &self.edges) else {
            return;
        };
        let names = groups
            .iter()
            .map(|&g| self.surface.groups[g as usize].as_str());
        let names = unique_names(names, "region");
        self.surface.group.clone_from(&solid);
        self.surface.solid = solid;
        self.surface.groups.clone_from(&names);
        self.surface.solids = names;
    }

    /// Groups are solids where each is closed; else all of them are one.
    pub fn tell_solids(&mut self) {
        let several = self.surface.groups.len() > 1;
        if !(self.odd.is_empty() && several && groups_are_closed(&self.surface, &self.edges)) {
            self.surface.make_one_solid();
        }
    }

    /// Makes all solids one. What they share then lies within it and is no defect.
    ///
    /// # Errors
    /// As those of [`Self::merge`].
    pub fn unite(&mut self) -> Result<(), HealError> {
        self.surface.make_one_solid();
        if merge(&mut self.surface, &self.edges, false)?.dropped > 0 {
            self.update_edges();
        }
        Ok(())
    }

    /// What is left is a closed surface.
    ///
    /// # Errors
    /// Nothing is left, or it is open.
    pub fn check_closed(&self) -> Result<(), HealError> {
        if self.surface.triangles.is_empty() {
            return Err(HealError::BadSurface(
                "all its triangles cancel each other in pairs".to_owned(),
            ));
        }
        open_surface(&self.surface, &self.edges, &self.odd).map_or(Ok(()), Err)
    }
}
