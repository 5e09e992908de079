//! Cutting the wedge of one group at one place.

use super::candidate::{Candidate, Place};
use super::copies::{Copies, regions_in};
use super::volumes::{Difference, Whole};
use crate::along::{divide, follow, restore};
use crate::body::Body;
use crate::cell::{Cell, Join, Part, Role, Shape, hub_order, of_group};
use crate::clean::{collapse_at_sides, collapse_short_edges};
use crate::clip::{clip, divide_at_hub};
use crate::error::CutError;
use crate::graph::Graph;
use crate::seam::{Matched, Matching, check_moved, match_sections};
use crate::section::{Known, Piece, Section};
use crate::surface::{Plane, Surface, slide, snap_heights_and_columns, snap_walls};
use crate::wedge::{Caps, Inner, Parts, assemble, unite, whole};
use geom::tolerance::Tolerance;
use glam::DVec3;
use tmesh::{Frame, Isometry, RegionMap, Template, Triangle};

/// What was cut.
#[derive(Clone, Debug)]
pub struct Cut {
    /// The candidate.
    pub candidate: Candidate,
    /// Where.
    pub place: Place,
    /// The wedge, and the hub.
    pub templates: Vec<Template>,
    /// Their copies.
    pub copies: Copies,
    /// How many of them are wedges.
    pub wedges: usize,
    /// Largest distance that a point of a seam was moved to make one side the image of the other, model units.
    pub moved: f64,
    /// What the copies differ from the body by.
    pub difference: Difference,
    /// Area of the body's boundary that was taken out as it enclosed no thickness, model units squared.
    pub closed: f64,
    /// What was done, in sentences.
    pub notes: Vec<String>,
}

/// Cuts a candidate at a place.
///
/// # Errors
/// Sections that are not clean or do not match, a hub that there can be none, copies that do not add up to the body.
pub fn cut(body: &Body<'_>, candidate: Candidate, place: Place) -> Result<Cut, CutError> {
    let Candidate { group, hub } = candidate;
    let tolerance = &body.tolerance;
    let mut surface = body.surface.clone();
    for p in &mut surface.vertices {
        *p = place.frame.to_canonical(*p);
    }
    let whole = Whole::new(&surface);
    let regions = |element| regions_in(body.symmetry, place.start, element);
    let copies = Copies::new(group, hub.is_some(), regions);
    let wedges = group.size() as usize;
    let cell = of_group(group, tolerance.on_plane(), tolerance.on_axis(), hub)
        .straightened(place.graph.clone());
    let equal = tolerance.equal();
    // The frame of a body that is not cut lies along its faces.
    let walls = match cell.faces.is_empty() {
        true => snap_walls(&mut surface.vertices, equal),
        false => 0.0,
    };
    let snapped = snap_heights_and_columns(&mut surface.vertices, equal).max(walls);
    let mut notes = vec![format!(
        "{} wedge of order {} ({wedges} copies), points within {:.1e} of a cut plane and {:.1e} of the axis moved onto \
         it, heights and columns within {:.1e} made equal (largest movement {snapped:.1e})",
        kind_of(&cell),
        group.order,
        tolerance.on_plane(),
        tolerance.on_axis(),
        tolerance.equal(),
    )];
    let cutter = Cutter {
        candidate,
        cell: &cell,
        tolerance,
        frame: &place.frame,
        regions: &regions,
    };
    cutter.slide(&mut surface, &mut notes);
    if let Some(graph) = &place.graph {
        notes.push(straighten(&mut surface, graph, &cell));
    }
    // Errors of a straightened body have their places there.
    let bent = |error: CutError| match &place.graph {
        Some(graph) => error.moved(|p| {
            let p = graph.bend(place.frame.to_canonical(p));
            place.frame.to_world(p)
        }),
        None => error,
    };
    let Pieces {
        mut templates,
        moved,
        closed,
    } = cutter.cut(surface, &mut notes).map_err(bent)?;
    if let Some(graph) = &place.graph {
        restore(&mut templates, graph, &place.frame)?;
    }
    check_moved(&templates, moved, (tolerance.equal(), &place.frame))?;
    if let Some(radius) = hub {
        notes.push(format!(
            "hub of inscribed radius {radius} and order {} ({} copies), a template of its own",
            hub_order(group),
            copies.instances.len() - wedges,
        ));
    }
    if templates[0].triangles.is_empty() {
        return Err(CutError::Empty);
    }
    let difference = whole.compare(body, &templates, &copies, wedges)?;
    notes.push(format!(
        "{wedges} copies of the wedge differ from the body's volume by {:.1e}",
        difference.relative
    ));
    Ok(Cut {
        candidate,
        place,
        templates,
        copies,
        wedges,
        moved,
        difference,
        closed: closed * wedges as f64,
        notes,
    })
}

/// Straightens a surface by the graph of the seam; says so.
fn straighten(surface: &mut Template, graph: &Graph, cell: &Cell) -> String {
    let added = divide(surface, graph, cell);
    for p in &mut surface.vertices {
        *p = graph.straighten(*p);
    }
    let [least, largest] = graph.range().map(f64::to_degrees);
    format!(
        "the seam follows angles of {least:.1} to {largest:.1} degrees at {} knots; {added} points where edges bend",
        graph.knots()
    )
}

/// What the sides of a wedge are, in a word.
fn kind_of(cell: &Cell) -> &'static str {
    let sides = cell
        .joins
        .iter()
        .filter(|j| !j.step.flipped() || !j.is_mirror());
    let mirrors = sides.clone().filter(|j| j.is_mirror()).count();
    let flipped = sides.clone().any(|j| j.step.flipped());
    match (mirrors, sides.count() - mirrors, flipped) {
        (0, _, false) => "rotation",
        (0, _, true) if cell.which(|f| f.role == Role::Fold).next().is_some() => "half-turn",
        (0, _, true) => "rotary reflection",
        (_, 0, _) => "mirror",
        _ => "mirror and half-turn",
    }
}

/// Templates that were cut.
struct Pieces {
    templates: Vec<Template>,
    /// Largest distance that a point of a seam was moved, model units.
    moved: f64,
    /// Area of the boundary of one wedge that was taken out, model units squared.
    closed: f64,
}

/// What is needed to cut the templates.
struct Cutter<'a> {
    candidate: Candidate,
    cell: &'a Cell,
    tolerance: &'a Tolerance,
    frame: &'a Frame,
    regions: &'a dyn Fn(Isometry) -> RegionMap,
}

impl Cutter<'_> {
    /// Moves what is beside mirror walls of a nearly symmetric body onto them.
    fn slide(&self, surface: &mut Template, notes: &mut Vec<String>) {
        let planes: Vec<Plane> = (self.cell.joins.iter())
            .filter(|join| join.is_mirror())
            .flat_map(|join| self.planes(join))
            .collect();
        // Seams are made images of each other by matching; a plane across the axis is not beside them.
        let beside = |j: &Join| j.is_mirror() && !j.step.flipped();
        let reach = self.tolerance.slide();
        if reach <= 0.0 || !self.cell.joins.iter().any(beside) {
            return;
        }
        let drift = self.tolerance.drift();
        let slid = slide(
            &mut surface.vertices,
            &surface.triangles,
            &planes,
            reach,
            drift,
        );
        notes.push(format!(
            "{slid} points within {reach:.1e} of a cut plane moved onto it along the surface"
        ));
    }

    /// The half planes of a mirror wall, or the plane across the axis.
    fn planes(&self, join: &Join) -> Vec<Plane> {
        let face = &self.cell.faces[join.here.face];
        let outward = match face.shape {
            Shape::Radial { .. } => face.directions()[0],
            _ => DVec3::ZERO,
        };
        let half = |outward: DVec3| Plane {
            normal: match face.is_radial() {
                true => DVec3::Z.cross(outward),
                false => face.inward,
            },
            outward,
        };
        // Half of space ends at both half planes.
        let is_single = self.cell.which(crate::cell::Face::is_radial).count() == 1;
        match face.is_radial() && is_single {
            true => vec![half(outward), half(-outward)],
            false => vec![half(outward)],
        }
    }

    fn cut(&self, body: Template, notes: &mut Vec<String>) -> Result<Pieces, CutError> {
        let (cell, tolerance) = (self.cell, self.tolerance);
        let is_whole = cell.faces.is_empty();
        let faced = (!is_whole).then_some(cell);
        let mut surface = Surface::new(body.vertices, body.triangles, faced, tolerance.flat());
        clip(&mut surface, cell);
        let closed = self.clean(&mut surface, notes);
        let pieces = |templates, moved| Pieces {
            templates,
            moved,
            closed,
        };
        if is_whole {
            return Ok(pieces(vec![whole(&surface, self.frame)?], 0.0));
        }
        divide_at_hub(&mut surface, cell);
        surface.add_corners(cell);
        let mut matched = self.match_sections(&mut surface, notes)?;
        if cell.is_straightened() {
            self.follow(&mut surface, &mut matched, notes)?;
        }
        let moved = matched
            .iter()
            .flatten()
            .map(|m| m.moved)
            .fold(0.0, f64::max);
        let faces = std::mem::take(&mut surface.faces);
        let hub = cell.hub();
        let (outer, inner): (Vec<Triangle>, Vec<Triangle>) = faces.into_iter().partition(|f| {
            let is_outer = |v: &u32| hub.is_none_or(|h| surface.classes[*v as usize].of(h) >= 0);
            f.vertices.iter().all(is_outer)
        });
        let outer = self.piece(&surface, &outer, false);
        let inner = self.piece(&surface, &inner, true);
        let hub_cap = match (hub, self.candidate.hub) {
            (Some(face), Some(radius)) => self.hub_cap(face, radius, &outer, &inner)?,
            _ => Vec::new(),
        };
        let caps = self.caps(&outer, false)?;
        let parts = Parts {
            faces: outer.faces.to_vec(),
            caps: &caps,
            matched: &matched,
            hub: &hub_cap,
        };
        let wedge = assemble(&surface, cell, parts, self.frame)?;
        if hub.is_none() {
            return Ok(pieces(vec![wedge.template], moved));
        }
        let caps = self.caps(&inner, true)?;
        let inner = Inner {
            group: self.candidate.group,
            cell,
            surface: &surface,
            faces: inner.faces,
            caps: &caps,
            matched: &matched,
            hub: &hub_cap,
            regions: self.regions,
        };
        let united = unite(&inner, &wedge, self.frame)?;
        Ok(pieces(vec![wedge.template, united], moved))
    }

    /// Collapses detail; the area of the body's boundary that went with it.
    fn clean(&self, surface: &mut Surface, notes: &mut Vec<String>) -> f64 {
        let detail = self.tolerance.detail();
        let mut closed = 0.0;
        if detail > 0.0 {
            let collapsed = collapse_short_edges(surface, detail);
            notes.push(format!(
                "edges below {detail:.1e} collapsed: {} points and {} faces fewer",
                collapsed.points, collapsed.faces
            ));
            closed = collapsed.boundary;
            if closed > 0.0 {
                notes.push(format!(
                    "{closed:.3e} of the boundary's area enclosed nothing thicker than that and is gone"
                ));
            }
        }
        // Edges longer than what is moved along the surface are no detail: they are those of narrow facets.
        let near = match (self.tolerance.detail_at_planes(), self.tolerance.slide()) {
            (near, 0.0) => near,
            (near, slide) => near.min(slide),
        };
        if near > 0.0 && !self.cell.faces.is_empty() {
            let joined = collapse_at_sides(surface, near);
            notes.push(format!(
                "{joined} points within {near:.1e} of others on a cut plane joined to them"
            ));
        }
        closed
    }

    /// Makes the parts of each join that is no mirror wall images of each other.
    fn match_sections(
        &self,
        surface: &mut Surface,
        notes: &mut Vec<String>,
    ) -> Result<Vec<Option<Matched>>, CutError> {
        let mut all = Vec::new();
        for join in &self.cell.joins {
            if join.is_mirror() {
                all.push(None);
                continue;
            }
            let matching = Matching {
                cell: self.cell,
                join,
                regions: &(self.regions)(join.step),
                tolerance: self.tolerance.partner(),
                along: self.tolerance.partner_along(),
                frame: self.frame,
            };
            let matched = match_sections(surface, &matching)?;
            notes.push(format!(
                "{} point pairs on the {}, moved by {:.1e} at most; {} points that only one side had",
                matched.pairs.len(),
                join.name,
                matched.moved,
                matched.inserted,
            ));
            all.push(Some(matched));
        }
        Ok(all)
    }

    /// Gives sections points so that what closes them follows the seam.
    fn follow(
        &self,
        surface: &mut Surface,
        matched: &mut [Option<Matched>],
        notes: &mut Vec<String>,
    ) -> Result<(), CutError> {
        let mut added = 0;
        let hub = self.cell.hub();
        for (join, matched) in self.cell.joins.iter().zip(matched) {
            let Some(matched) = matched else { continue };
            let of_hub = hub.map(|_| join.there.of_hub());
            for part in [Some(join.there), of_hub].into_iter().flatten() {
                let points = follow(surface, self.cell, part, self.frame)?;
                added += points.len();
                matched.add(surface, join, &points);
            }
        }
        if let Some(face) = hub {
            added += follow(surface, self.cell, Part::whole(face), self.frame)?.len();
        }
        notes.push(format!(
            "{added} points within the cut faces, which follow the seam"
        ));
        Ok(())
    }

    /// The faces on one side of the hub's plane, with the corners there.
    fn piece<'a>(&self, surface: &'a Surface, faces: &'a [Triangle], of_hub: bool) -> Piece<'a> {
        let hub = |v: u32| {
            let class = surface.classes[v as usize];
            self.cell.hub().map_or(1, |h| class.of(h))
        };
        let own = |v: &u32| if of_hub { hub(*v) <= 0 } else { hub(*v) >= 0 };
        Piece {
            surface,
            faces,
            corners: surface.corners.iter().copied().filter(own).collect(),
        }
    }

    /// Caps that close a piece of the surface, in the order of the joins.
    fn caps(&self, piece: &Piece<'_>, of_hub: bool) -> Result<Caps, CutError> {
        let mut known = Known::default();
        let mut caps = Vec::new();
        for join in &self.cell.joins {
            let part = if of_hub {
                join.there.of_hub()
            } else {
                join.there
            };
            // Only a plane across the axis may meet no edge of the body's surface.
            let is_across = self.cell.faces[part.face].shape == Shape::Across;
            let section = Section::new(piece, self.cell, part);
            let none = Known::default();
            let known_here = if is_across { &known } else { &none };
            let cap = section.cap(piece, self.cell, self.frame, known_here)?;
            known.add(&cap);
            caps.push(cap);
        }
        Ok(caps)
    }

    /// The cap between wedge and hub, facing out of the wedge.
    fn hub_cap(
        &self,
        face: usize,
        radius: f64,
        outer: &Piece<'_>,
        inner: &Piece<'_>,
    ) -> Result<Vec<Triangle>, CutError> {
        let bad = |reason: &str| CutError::BadHub {
            radius,
            reason: reason.to_owned(),
        };
        if inner.faces.is_empty() {
            return Err(bad("nothing of the body is that near to the axis"));
        }
        if outer.faces.is_empty() {
            return Err(bad("nothing of the body is farther from the axis"));
        }
        let part = Part::whole(face);
        let from_outside = Section::new(outer, self.cell, part);
        let from_inside = Section::new(inner, self.cell, part.of_hub());
        let regions = |s: &Section| -> Vec<_> {
            s.edges
                .iter()
                .filter(|e| e.left != e.right)
                .map(|e| (e.ends, e.left, e.right))
                .collect()
        };
        if regions(&from_outside) != regions(&from_inside) {
            return Err(bad(
                "a face of the body lies in the hub's wall; choose another radius",
            ));
        }
        let cap = from_outside.cap(outer, self.cell, self.frame, &Known::default())?;
        if cap.is_empty() {
            return Err(bad("there is no material at its wall"));
        }
        Ok(cap)
    }
}
