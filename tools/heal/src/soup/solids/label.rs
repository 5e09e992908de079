//! Which solid lies on either side of each triangle.
//!
//! The cells the surface divides space into are walked from the unbounded one; crossing a triangle
//! of a solid means entering or leaving it. So a cell belongs to a solid when an odd number of its
//! shells surround it, whatever the orientation of the triangles, and a cell in two solids is an
//! overlap.

use super::notices::{causes, explain_turned};
use crate::HealError;
use crate::meeting::{Met, meetings};
use crate::soup::surface::{NONE, Surface};
use crate::words::place;
use geom::cells::Cells;
use geom::contacts::{Contact, Search};
use geom::edges::Edges;
use geom::flat::{Flatness, Flats};
use geom::measure::tet_volume;
use geom::sets::DisjointSets;
use interchange::text::counted;
use rustc_hash::FxHashMap;
use std::cell::{Cell, RefCell};
use std::collections::VecDeque;

/// Which solid lies on either side of each triangle.
pub struct Labels {
    /// Solid on the front side, after turning, or [`NONE`].
    pub front: Vec<u32>,
    /// Solid on the back side, after turning, or [`NONE`].
    pub back: Vec<u32>,
    /// Triangles that must be turned over, so that boundaries face away from their solid.
    pub turned: Vec<bool>,
    /// What the user should know.
    pub notices: Vec<String>,
    /// Whether a solid crosses itself. Where pieces of a lone one do, its triangles are labelled by their orientation.
    pub crosses: bool,
    /// Whether it was made sure that no two triangles meet away from common corners and edges.
    pub is_apart: bool,
    /// What does, of different flat faces, where all of it was found.
    pub met: Option<Met>,
}

impl Labels {
    /// Number of triangles between two solids.
    pub fn interfaces(&self) -> usize {
        let sides = self.front.iter().zip(&self.back);
        sides.filter(|(a, b)| **a != NONE && **b != NONE).count()
    }
}

/// Finds the solid on either side of each triangle. What lies in one plane within a distance is taken for one face, which
/// does not meet itself.
///
/// # Errors
/// Solids that overlap, cross, or touch with different triangles; edges where it cannot be told.
pub fn label(surface: &Surface, edges: &Edges, flat: f64) -> Result<Labels, HealError> {
    let solids = surface.solids.len();
    let (shell, _) = shells(surface, edges);
    let mut notices = Vec::new();
    let face = faces(surface, edges, flat);
    let (parts, pairs) = check_contacts(surface, (&shell, &face), &mut notices)?;
    let met = pairs.map(|pairs| Met { pairs, group: face });
    if let Parts::Pieces(place) = &parts {
        notices.push(format!(
            "pieces of the surface {place}; it cannot be meshed as it is, and where it is an assembly, --solids shells makes each closed shell a solid"
        ));
        let oriented = as_oriented(surface, edges, notices)?;
        return Ok(Labels { met, ..oriented });
    }
    let cells = Cells::new(&surface.points, &surface.triangles, edges);
    let content = contents(surface, edges, &cells)?;
    let mut labels = Labels {
        front: Vec::with_capacity(shell.len()),
        back: Vec::with_capacity(shell.len()),
        turned: Vec::with_capacity(shell.len()),
        notices,
        crosses: matches!(parts, Parts::MeetWithin),
        is_apart: matches!(parts, Parts::AreApart),
        met,
    };
    for t in 0..shell.len() {
        let front = content[cells.front(t) as usize];
        let back = content[cells.back(t) as usize];
        // Boundaries face outwards; interfaces have the solid listed first behind them.
        let turned = match (front, back) {
            (NONE, _) => false,
            (_, NONE) => true,
            (front, _) => front == surface.solid[t],
        };
        let (front, back) = if turned { (back, front) } else { (front, back) };
        labels.front.push(front);
        labels.back.push(back);
        labels.turned.push(turned);
    }
    let turned = explain_turned(surface, &cells, &shell, solids, &labels.turned);
    labels.notices.extend(turned);
    Ok(labels)
}

/// Pieces of each solid that are connected through edges: piece of each triangle, and their number.
fn shells(surface: &Surface, edges: &Edges) -> (Vec<u32>, usize) {
    let mut sets = DisjointSets::new(surface.triangles.len());
    let mut first_of: Vec<(u32, u32)> = Vec::new();
    for e in 0..edges.len() {
        let fan = edges.around(e);
        if let [a, b] = fan
            && surface.solid[a.triangle as usize] == surface.solid[b.triangle as usize]
        {
            sets.join(a.triangle, b.triangle);
            continue;
        }
        first_of.clear();
        for u in fan {
            let solid = surface.solid[u.triangle as usize];
            match first_of.iter().find(|f| f.0 == solid) {
                Some(&(_, first)) => {
                    sets.join(first, u.triangle);
                }
                None => first_of.push((solid, u.triangle)),
            }
        }
    }
    sets.numbered()
}

/// The flat faces of a surface: of each triangle, the number of its face. Fans of many triangles around one corner, all of
/// which would have to be compared, are one.
fn faces(surface: &Surface, edges: &Edges, flat: f64) -> Vec<u32> {
    let flatness = |_| {
        [Flatness {
            distance: flat,
            // What the distance leaves of folds.
            cosine: 0.5,
        }]
    };
    let Surface {
        points, triangles, ..
    } = surface;
    let flats = Flats::new(points, triangles, &edges.across(), flatness, |_, _| true);
    flats.regions.of
}

/// Pairs of triangles.
type Pairs = Vec<[u32; 2]>;

/// Whether parts of a surface meet that should not.
enum Parts {
    AreApart,
    /// Faces that hang together do.
    MeetWithin,
    /// Pieces of a lone solid: where and how often, for the end of a sentence.
    Pieces(String),
    Unknown,
}

/// Looks for faces that cross or touch other than in common triangles, edges and vertices. Within a shell and within a
/// lone solid that is allowed, and described in the result; besides, all pairs of triangles that do, if the search came to
/// an end.
fn check_contacts(
    surface: &Surface,
    (shell, face): (&[u32], &[u32]),
    notices: &mut Vec<String>,
) -> Result<(Parts, Option<Pairs>), HealError> {
    let of = |t: u32| (surface.solid[t as usize], surface.partner[t as usize]);
    let within = Cell::new(false);
    let pairs = RefCell::new(Vec::new());
    let met = meetings(
        &surface.points,
        &surface.triangles,
        |t| face[t as usize],
        |contact| {
            pairs.borrow_mut().push(contact.triangles);
            let [s, t] = contact.triangles.map(|t| shell[t as usize]);
            if s == t {
                within.set(true);
                return false;
            }
            let [(a, b), (c, d)] = contact.triangles.map(of);
            // An interface's own solids meet at it.
            let related = a == c || a == d || b == c || (b == d && b != NONE);
            !(related && (b != NONE || d != NONE))
        },
    );
    let pairs = (met.search == Search::Done).then(|| pairs.into_inner());
    let Some(Contact { triangles, point }) = met.lowest else {
        if within.get() {
            return Ok((Parts::MeetWithin, pairs));
        }
        if met.search == Search::Done {
            return Ok((Parts::AreApart, pairs));
        }
        notices.push(
            "too many triangles lie close to each other to tell whether all pieces are apart"
                .to_owned(),
        );
        return Ok((Parts::Unknown, pairs));
    };
    let [a, b] = triangles.map(|t| surface.solid[t as usize]);
    let (one, many) = ("pair of triangles meets", "pairs of triangles meet");
    let at = place(point);
    let count = counted(met.count, one, many);
    if a != b {
        return Err(HealError::BadSurface(format!(
            "{} and {} cross or touch at {at} with different triangles ({count}); where solids \
             meet, both must have the same triangles",
            surface.solid_name(a),
            surface.solid_name(b)
        )));
    }
    if surface.solids.len() > 1 {
        return Err(HealError::BadSurface(format!(
            "{} crosses or touches itself at {at}: {count}",
            surface.solid_name(a)
        )));
    }
    let place = format!("cross or touch at {at} ({count})");
    Ok((Parts::Pieces(place), pairs))
}

/// The solid in each cell.
fn contents(surface: &Surface, edges: &Edges, cells: &Cells<'_>) -> Result<Vec<u32>, HealError> {
    // Each different pair of neighbouring cells once, with a triangle between them.
    let mut neighbours: Vec<Vec<(u32, u32)>> = vec![Vec::new(); cells.count()];
    let mut known: FxHashMap<[u32; 4], ()> = FxHashMap::default();
    let mut last = [NONE; 4];
    let mut ambiguous = None;
    let mut ambiguities = 0;
    for t in 0..surface.triangles.len() {
        let (front, back) = (cells.front(t), cells.back(t));
        if front == back {
            ambiguous.get_or_insert(t);
            ambiguities += 1;
            continue;
        }
        let key = [front, back, surface.solid[t], surface.partner[t]];
        if key != last && known.insert(key, ()).is_none() {
            neighbours[front as usize].push((back, t as u32));
            neighbours[back as usize].push((front, t as u32));
        }
        last = key;
    }
    if let Some(t) = ambiguous {
        let [a, b, c] = surface.corners(t as u32);
        return Err(HealError::BadSurface(format!(
            "inside and outside cannot be told apart: {}{} the same space on both sides, the first \
             at {}",
            causes(surface, edges),
            counted(ambiguities, "triangle has", "triangles have"),
            place((a + b + c) / 3.0)
        )));
    }
    let mut content = vec![NONE; cells.count()];
    let mut reached = vec![false; cells.count()];
    reached[Cells::UNBOUNDED as usize] = true;
    let mut queue = VecDeque::from([Cells::UNBOUNDED]);
    while let Some(cell) = queue.pop_front() {
        for &(next, t) in &neighbours[cell as usize] {
            let here = content[cell as usize];
            let there = cross(surface, here, t)?;
            if !reached[next as usize] {
                reached[next as usize] = true;
                content[next as usize] = there;
                queue.push_back(next);
            } else if content[next as usize] != there {
                let [a, b, c] = surface.corners(t);
                return Err(HealError::BadSurface(format!(
                    "inside and outside cannot be told apart: {}what lies behind the triangle at {} \
                     is told in two ways",
                    causes(surface, edges),
                    place((a + b + c) / 3.0)
                )));
            }
        }
    }
    Ok(content)
}

/// What lies beyond a triangle, coming from a cell in the solid `here`.
fn cross(surface: &Surface, here: u32, t: u32) -> Result<u32, HealError> {
    let mut there = here;
    for solid in [surface.solid[t as usize], surface.partner[t as usize]] {
        there = match there {
            _ if solid == NONE => there,
            NONE => solid,
            inside if inside == solid => NONE,
            // Leaving the solid `here` by the partner's turn.
            inside if surface.partner[t as usize] == inside => {
                // (solid, partner) with partner == here: what remains is the solid.
                return Ok(solid);
            }
            inside => {
                let [a, b, c] = surface.corners(t);
                return Err(HealError::BadSurface(format!(
                    "{} and {} overlap: the surface of the second lies inside the first at {}; cut \
                     a cavity of the same shape into the first",
                    surface.solid_name(inside),
                    surface.solid_name(solid),
                    place((a + b + c) / 3.0)
                )));
            }
        };
    }
    Ok(there)
}

/// Labels for a surface whose pieces cross: the back of each triangle is the solid.
fn as_oriented(
    surface: &Surface,
    edges: &Edges,
    mut notices: Vec<String>,
) -> Result<Labels, HealError> {
    let inconsistent = (0..edges.len()).find(|&e| {
        let fan = edges.around(e);
        2 * fan.iter().filter(|u| u.forward).count() != fan.len()
    });
    if let Some(e) = inconsistent {
        let [a, b] = edges.ends[e].map(|v| place(surface.points[v as usize]));
        return Err(HealError::BadSurface(format!(
            "the surface crosses itself and its triangles are not oriented alike at the edge from \
             {a} to {b}"
        )));
    }
    let origin = surface.corners(0)[0];
    let volume: f64 = (0..surface.triangles.len() as u32)
        .map(|t| {
            let [a, b, c] = surface.corners(t);
            tet_volume(origin, a, b, c)
        })
        .sum();
    let turned = volume < 0.0;
    if turned {
        notices.push("the surface is oriented inwards: turned over".to_owned());
    }
    let n = surface.triangles.len();
    Ok(Labels {
        front: vec![NONE; n],
        back: vec![0; n],
        turned: vec![turned; n],
        notices,
        crosses: true,
        is_apart: false,
        met: None,
    })
}
