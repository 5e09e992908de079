//! Closing of a surface: proposed round by round, then measured.

use super::allowance::{Before, Gap, TooWide, sagittas, too_wide};
use super::join::{To, joins};
use super::rim::Rim;
use super::split::{Stitch, split};
use crate::meeting::{Meetings, meetings};
use crate::repair::{Repair, RepairKind};
use crate::soup::closure::odd_edges;
use crate::soup::coincident::merge;
use crate::soup::surface::Surface;
use crate::words::{place, short};
use geom::edges::Edges;
use geom::tolerance::Tolerance;
use interchange::text::counted;

/// How the closing of a surface ended.
pub enum Closing {
    /// It is closed.
    Closed(Vec<Repair>),
    /// It is open still: no corners near each other are left.
    Open,
    /// It was closed, but across gaps that are wider than allowed.
    TooWide(TooWide),
    /// It was closed, but crosses itself there now.
    Crossing(Meetings),
}

/// Closes a surface that has edges with an odd number of triangles, or leaves it as far as it came.
pub fn close(surface: &mut Surface, tolerance: &Tolerance) -> Closing {
    let mut work = Work::new(surface);
    if !work.propose(tolerance.equal()) {
        return Closing::Open;
    }
    let gaps = work.gaps();
    let before = work.before();
    // Points are moved as far as this onto planes, too: it does not bend flat faces.
    let flat = tolerance.on_plane();
    let sagitta = sagittas(work.surface, &before);
    if let Some(found) = too_wide(&gaps, &sagitta, flat) {
        return Closing::TooWide(found);
    }
    let changed = |t: u32| before.moved[work.surface.source[t as usize] as usize] > 0.0;
    let met = meetings(
        &work.surface.points,
        &work.surface.triangles,
        |t| t,
        |contact| contact.triangles.iter().any(|&t| changed(t)),
    );
    if met.count > 0 {
        return Closing::Crossing(met);
    }
    Closing::Closed(work.repairs(&gaps))
}

impl Closing {
    /// Why the surface is not closed that way, for the end of a sentence.
    pub fn reason(&self, surface: &Surface) -> String {
        match self {
            Self::Closed(_) | Self::Open => String::new(),
            Self::TooWide(TooWide { count, worst }) => {
                let (gap, allowed) = *worst;
                format!(
                    "to close it {} wider than the facets beside it explain, {} at {}, where that is {}",
                    counted(*count, "gap is", "gaps are"),
                    short(gap.width),
                    place(surface.points[gap.vertex as usize]),
                    short(allowed)
                )
            }
            Self::Crossing(met) => format!(
                "closing its cracks would make it cross itself: {}{}",
                counted(met.count, "pair of triangles", "pairs of triangles"),
                met.lowest.map_or(String::new(), |c| format!(
                    ", the first at {}",
                    place(c.point)
                ))
            ),
        }
    }
}

/// A surface while it is being closed.
struct Work<'a> {
    surface: &'a mut Surface,
    /// Corners of the triangles as they were.
    corners: Vec<[u32; 3]>,
    /// What each point has become.
    becomes: Vec<u32>,
    stitches: Vec<Stitch>,
    /// Triangles that turned out to be there twice.
    repeated: usize,
}

impl<'a> Work<'a> {
    fn new(surface: &'a mut Surface) -> Self {
        surface.source = (0..surface.triangles.len() as u32).collect();
        Self {
            corners: surface.triangles.clone(),
            becomes: (0..surface.points.len() as u32).collect(),
            stitches: Vec::new(),
            repeated: 0,
            surface,
        }
    }

    /// Joins and divides until the surface is closed; whether it is.
    fn propose(&mut self, equal: f64) -> bool {
        let mut fewest = usize::MAX;
        loop {
            let edges = Edges::new(&self.surface.triangles);
            let odd = odd_edges(&edges);
            if odd.is_empty() {
                return true;
            }
            let rim = Rim::new(self.surface, &edges, &odd, equal);
            if self.join(&rim, To::Rim) {
                continue;
            }
            // Each round of dividing leaves fewer open edges, or none will.
            if odd.len() < fewest {
                fewest = odd.len();
                if self.split(&rim, equal) {
                    continue;
                }
            }
            if !self.join(&rim, To::All) {
                return false;
            }
        }
    }

    /// Joins corners; whether there were any to join.
    fn join(&mut self, rim: &Rim, to: To) -> bool {
        let pairs = joins(self.surface, rim, to).unwrap_or_default();
        if pairs.is_empty() {
            return false;
        }
        let mut new_id: Vec<u32> = (0..self.surface.points.len() as u32).collect();
        for (from, to) in pairs {
            new_id[from as usize] = to;
        }
        for t in &mut self.surface.triangles {
            *t = t.map(|v| new_id[v as usize]);
        }
        for v in &mut self.becomes {
            *v = new_id[*v as usize];
        }
        self.surface.drop_collapsed();
        let edges = Edges::new(&self.surface.triangles);
        if let Ok(merged) = merge(self.surface, &edges, false) {
            self.repeated += merged.dropped;
        }
        true
    }

    /// Divides edges; whether there were any to divide.
    fn split(&mut self, rim: &Rim, equal: f64) -> bool {
        let stitches = split(self.surface, rim, equal).unwrap_or_default();
        self.stitches.extend(&stitches);
        !stitches.is_empty()
    }

    /// By how much corners, and edges at corners, were moved.
    fn gaps(&self) -> Vec<Gap> {
        let place = |v: u32| self.surface.points[v as usize];
        let joined = (0..).zip(&self.becomes).filter(|(from, to)| from != *to);
        let joined = joined.map(|(from, &to)| Gap {
            vertex: to,
            width: place(from).distance(place(to)),
        });
        let stitched = self.stitches.iter().map(|s| Gap {
            vertex: self.becomes[s.vertex as usize],
            width: s.gap,
        });
        joined.chain(stitched).collect()
    }

    fn before(&self) -> Before {
        let place = |v: u32| self.surface.points[v as usize];
        let moved = |v: u32| place(v).distance(place(self.becomes[v as usize]));
        let mut before = Before {
            corners: self.corners.iter().map(|t| t.map(place)).collect(),
            moved: (self.corners.iter())
                .map(|t| t.map(moved).into_iter().fold(0.0, f64::max))
                .collect(),
        };
        for stitch in &self.stitches {
            let moved = &mut before.moved[stitch.source as usize];
            *moved = moved.max(stitch.gap);
        }
        before
    }

    fn repairs(&self, gaps: &[Gap]) -> Vec<Repair> {
        let (joined, stitched) = gaps.split_at(gaps.len() - self.stitches.len());
        let kinds = [
            (RepairKind::Joined, joined),
            (RepairKind::Stitched, stitched),
        ];
        let repairs = kinds.into_iter().filter_map(|(kind, gaps)| {
            let widest = gaps
                .iter()
                .reduce(|a, b| if b.width > a.width { b } else { a })?;
            Some(Repair {
                kind,
                count: gaps.len(),
                largest: widest.width,
                place: self.surface.points[widest.vertex as usize],
            })
        });
        let mut repairs: Vec<Repair> = repairs.collect();
        if self.repeated > 0 {
            let first = gaps.first().map_or(0, |gap| gap.vertex);
            let place = self.surface.points[first as usize];
            repairs.push(Repair::in_place(RepairKind::Repeated, self.repeated, place));
        }
        repairs
    }
}
