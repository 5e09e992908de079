//! Closing of a surface: proposed round by round, then measured.

use super::allowance::{Before, Bend, Gap, sagittas, too_wide, widest};
use super::join::{To, joins};
use super::rim::{Rim, Within};
use super::split::{Division, Stitch, split};
use crate::meeting::meetings;
use crate::repair::{Repair, RepairKind};
use crate::soup::closure::odd_edges;
use crate::soup::coincident::merge;
use crate::soup::surface::Surface;
use crate::words::{place, short};
use geom::edges::Edges;
use geom::tolerance::Tolerance;
use interchange::text::counted;
use rustc_hash::FxHashMap;

/// What was done to close a surface.
pub struct Closed {
    /// What was repaired.
    pub repairs: Vec<Repair>,
    /// Edges that were divided, round by round.
    pub divided: Vec<Vec<Division>>,
}

/// Closes a surface that has edges with an odd number of triangles.
///
/// # Errors
/// Why it cannot be closed, for the end of a sentence, or nothing where nothing lies beside the edges; the surface is as
/// it was.
pub fn close(surface: &mut Surface, tolerance: &Tolerance) -> Result<Closed, Option<String>> {
    let whole = surface.clone();
    let mut reason = None;
    // What is farther off than allowed is looked for as well: what is allowed may turn out to be more once cracks are
    // closed, and if it does not, it is the reason.
    for within in [Within::Allowed, Within::Any] {
        let mut work = Work::new(surface);
        let left = work.propose(tolerance, within);
        let gaps = work.gaps();
        let wrong = work.wrong(&gaps, &left, tolerance);
        if wrong.is_empty() && left.is_empty() {
            return Ok(Closed {
                repairs: work.repairs(&gaps),
                divided: work.divided(),
            });
        }
        reason = (!gaps.is_empty()).then(|| wrong.join(" and "));
        surface.clone_from(&whole);
    }
    Err(reason)
}

/// A surface while it is being closed.
struct Work<'a> {
    surface: &'a mut Surface,
    /// Corners of the triangles as they were.
    corners: Vec<[u32; 3]>,
    /// Edges with one triangle as they were: by that triangle and the corner that they begin at.
    open: Vec<(u32, u8)>,
    /// What each point has become.
    becomes: Vec<u32>,
    stitches: Vec<Stitch>,
    divided: Vec<Vec<Division>>,
    /// Triangles that turned out to be there twice.
    repeated: usize,
}

impl<'a> Work<'a> {
    fn new(surface: &'a mut Surface) -> Self {
        surface.source = (0..surface.triangles.len() as u32).collect();
        let edges = Edges::new(&surface.triangles);
        let open = (0..edges.len()).filter_map(|e| match edges.around(e) {
            [only] => Some((only.triangle, only.corner)),
            _ => None,
        });
        Self {
            open: open.collect(),
            corners: surface.triangles.clone(),
            becomes: (0..surface.points.len() as u32).collect(),
            stitches: Vec::new(),
            divided: Vec::new(),
            repeated: 0,
            surface,
        }
    }

    /// Joins and divides until the surface is closed; the ends of the edges that are left.
    ///
    /// What is nearest goes first: where gaps of any width are closed, the reach begins with what counts as equal and is
    /// doubled until nothing reaches farther.
    fn propose(&mut self, tolerance: &Tolerance, within: Within) -> Vec<[u32; 2]> {
        let equal = tolerance.equal();
        let mut most = match within {
            Within::Allowed => f64::INFINITY,
            Within::Any => equal,
        };
        let mut fewest = usize::MAX;
        loop {
            let edges = Edges::new(&self.surface.triangles);
            let odd = odd_edges(&edges);
            if odd.is_empty() {
                return Vec::new();
            }
            let allowed = self.allowed(&edges, tolerance);
            let rim = Rim::new(self.surface, &edges, &odd, (equal, allowed, within));
            if self.join(&rim, To::Rim, most) {
                continue;
            }
            // Each round of dividing leaves fewer open edges, or none will.
            if odd.len() < fewest {
                fewest = odd.len();
                if self.split(&rim, most) {
                    continue;
                }
            }
            if self.join(&rim, To::All, most) {
                continue;
            }
            if rim.is_within(most) {
                return odd.iter().map(|&e| edges.ends[e]).collect();
            }
            most *= 2.0;
            fewest = usize::MAX;
        }
    }

    /// What gaps may be wide at each vertex, as far as is known while there are cracks: nothing is known of triangles
    /// without neighbours.
    fn allowed(&self, edges: &Edges, tolerance: &Tolerance) -> Vec<f64> {
        let mut allowed = sagittas(self.surface, &self.before());
        allowed.iter_mut().for_each(|s| *s = widest(*s, tolerance));
        let mut open = vec![0; self.surface.triangles.len()];
        for e in 0..edges.len() {
            if let [only] = edges.around(e) {
                open[only.triangle as usize] += 1;
            }
        }
        for (t, corners) in self.surface.triangles.iter().enumerate() {
            if open[t] == corners.len() {
                corners
                    .iter()
                    .for_each(|&v| allowed[v as usize] = f64::INFINITY);
            }
        }
        allowed
    }

    /// What is wrong with the surface as it is now: edges left open, gaps that are too wide, crossings.
    fn wrong(&self, gaps: &[Gap], left: &[[u32; 2]], tolerance: &Tolerance) -> Vec<String> {
        let at = |v: u32| place(self.surface.points[v as usize]);
        let mut wrong = Vec::new();
        if let Some(&[a, b]) = left.first() {
            let what = counted(left.len(), "edge has", "edges have");
            wrong.push(format!(
                "{what} no other one beside it, the first from {} to {}",
                at(a),
                at(b)
            ));
        }
        let before = self.before();
        let sagitta = sagittas(self.surface, &before);
        let allowed = |v: u32| widest(sagitta[v as usize], tolerance);
        if let Some(found) = too_wide(gaps, allowed) {
            let (gap, allowed) = found.worst;
            wrong.push(format!(
                "{} wider than the facets there explain, {} at {}, where that is {}",
                counted(found.count, "gap is", "gaps are"),
                short(gap.width),
                at(gap.vertex),
                short(allowed)
            ));
        }
        if !wrong.is_empty() {
            return wrong;
        }
        let surface = &*self.surface;
        let changed = |t: u32| before.moved[surface.source[t as usize] as usize] > 0.0;
        let met = meetings(
            &surface.points,
            &surface.triangles,
            |t| t,
            |contact| contact.triangles.iter().any(|&t| changed(t)),
        );
        if let Some(first) = met.lowest {
            wrong.push(format!(
                "closing its cracks would make it cross itself at {}, {} in all",
                place(first.point),
                counted(met.count, "pair of triangles", "pairs of triangles")
            ));
        }
        wrong
    }

    /// Joins corners; whether there were any to join.
    fn join(&mut self, rim: &Rim, to: To, most: f64) -> bool {
        let pairs = joins(self.surface, rim, to, most).unwrap_or_default();
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
    fn split(&mut self, rim: &Rim, most: f64) -> bool {
        let (stitches, divided) = split(self.surface, rim, most).unwrap_or_default();
        if stitches.is_empty() {
            return false;
        }
        self.stitches.extend(stitches);
        self.divided.push(divided);
        true
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

    /// The edges that were divided, with the corners as they are now.
    fn divided(mut self) -> Vec<Vec<Division>> {
        for corner in (self.divided.iter_mut().flatten()).flat_map(|d| &mut d.corners) {
            *corner = self.becomes[*corner as usize];
        }
        self.divided
    }

    fn before(&self) -> Before {
        let place = |v: u32| self.surface.points[v as usize];
        let moved = |v: u32| place(v).distance(place(self.becomes[v as usize]));
        let mut before = Before {
            corners: self.corners.iter().map(|t| t.map(place)).collect(),
            moved: (self.corners.iter())
                .map(|t| t.map(moved).into_iter().fold(0.0, f64::max))
                .collect(),
            rims: self.rims(),
        };
        for stitch in &self.stitches {
            let moved = &mut before.moved[stitch.source as usize];
            *moved = moved.max(stitch.gap);
        }
        before
    }

    /// Each open edge with the next one where its end has just one, as they were.
    fn rims(&self) -> Vec<Bend> {
        let ends = |(t, corner): (u32, u8)| {
            let corners = self.corners[t as usize];
            [0, 1].map(|i| corners[(corner as usize + i) % 3])
        };
        let place = |v: u32| self.surface.points[v as usize];
        let mut next: FxHashMap<u32, Option<(u32, u8)>> = FxHashMap::default();
        for &edge in &self.open {
            let known = next.entry(ends(edge)[0]);
            known.and_modify(|e| *e = None).or_insert(Some(edge));
        }
        let bends = self.open.iter().filter_map(|&edge| {
            let [a, b] = ends(edge);
            let other = (*next.get(&b)?)?;
            Some(Bend {
                sources: [edge.0, other.0],
                points: [place(a), place(b), place(ends(other)[1])],
            })
        });
        bends.collect()
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
