//! Which solid each cell of the complex belongs to.

use super::faces::Complex;
use crate::contacts::Overlap;
use geom::cells::Cells;
use geom::edges::Edges;
use geom::measure::{tet_volume, triangle_area};
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, VecDeque};

/// No solid.
pub const NONE: u32 = u32::MAX;

/// Triangles with the solids on either side.
pub struct Settled {
    /// Corners, source, and the solids on the front and on the back or [`NONE`], which differ. Those of boundaries face
    /// outwards, the others towards the later solid.
    pub triangles: Vec<([u32; 3], u32, [u32; 2])>,
    /// Pairs of solids that claim the same space: the one that has it now, the other one, the volume, and the mean
    /// thickness.
    pub overlaps: Vec<Claim>,
    /// Solids that cross themselves, and the volume that they have more than once.
    pub doubled: Vec<(u32, f64)>,
}

/// Space that two solids claim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claim {
    /// The solid that has it.
    pub winner: u32,
    /// The other one.
    pub loser: u32,
    /// Its volume, model units cubed.
    pub volume: f64,
    /// Its volume by half of its surface, model units.
    pub thickness: f64,
    /// Whether the winner lies inside the loser.
    pub nested: bool,
}

/// How often each solid is around a cell, by solids in order; zeros are left out.
type Winding = Vec<(u32, i32)>;

/// A triangle of the complex, once, with the solids that have it.
struct Wall {
    corners: [u32; 3],
    /// Of each solid, how the winding number changes from front to back, and a source.
    steps: Vec<(u32, i32, u32)>,
}

/// Settles which solid each cell belongs to: a solid has what its surface winds around more often than not at all, or,
/// if it does not cross itself, an odd number of times, whatever its orientation. `None` where that cannot be told,
/// because the surface of a solid is not closed.
pub fn settle(
    complex: &Complex,
    solid: &[u32],
    crosses_itself: &[bool],
    rule: Overlap,
) -> Option<Settled> {
    let walls = walls(complex, solid, crosses_itself);
    let triangles: Vec<[u32; 3]> = walls.iter().map(|w| w.corners).collect();
    if triangles.is_empty() {
        return None;
    }
    let edges = Edges::new(&triangles);
    let cells = Cells::new(&complex.points, &triangles, &edges);
    let windings = windings(&walls, &cells, crosses_itself)?;
    let measures = Measures::of(complex, &triangles, &cells);
    let inside = inside(&windings, &measures, crosses_itself);
    let claims = claims(&inside, &measures, rule);
    let beats = |a: u32, b: u32| claims.get(&[a, b]).is_some_and(|c| c.winner == a);
    let content: Vec<u32> = inside
        .iter()
        .map(|s| {
            let best = s.iter().copied().reduce(|a, b| {
                if beats(a.min(b), a.max(b)) == (a < b) {
                    a
                } else {
                    b
                }
            });
            best.unwrap_or(NONE)
        })
        .collect();
    let mut settled = Settled {
        triangles: Vec::new(),
        overlaps: claims.into_values().collect(),
        doubled: doubled(&windings, &measures, crosses_itself),
    };
    for (t, wall) in walls.iter().enumerate() {
        let front = content[cells.front(t) as usize];
        let back = content[cells.back(t) as usize];
        if front == back {
            continue;
        }
        // NONE is the highest number.
        let turned = front < back;
        let [a, b, c] = wall.corners;
        let owner = wall.steps.iter().find(|s| s.0 == front.min(back));
        let source = owner.or(wall.steps.first())?.2;
        settled.triangles.push((
            if turned { [a, c, b] } else { [a, b, c] },
            source,
            [front.max(back), front.min(back)],
        ));
    }
    Some(settled)
}

/// Triangles with the same corners as one, without those of no solid.
fn walls(complex: &Complex, solid: &[u32], crosses_itself: &[bool]) -> Vec<Wall> {
    let mut index: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    let mut walls: Vec<Wall> = Vec::new();
    for (&corners, &source) in complex.triangles.iter().zip(&complex.source) {
        let mut key = corners;
        key.sort_unstable();
        let at = *index.entry(key).or_insert_with(|| {
            walls.push(Wall {
                corners,
                steps: Vec::new(),
            });
            walls.len() - 1
        });
        let wall = &mut walls[at];
        let start = wall.corners.iter().position(|&v| v == corners[0]);
        let alike = start.is_some_and(|i| wall.corners[(i + 1) % 3] == corners[1]);
        let step = if alike { 1 } else { -1 };
        let owner = solid[source as usize];
        match wall.steps.iter_mut().find(|s| s.0 == owner) {
            Some(known) => known.1 += step,
            None => wall.steps.push((owner, step, source)),
        }
    }
    for wall in &mut walls {
        wall.steps.retain(|s| match crosses_itself[s.0 as usize] {
            true => s.1 != 0,
            false => s.1 % 2 != 0,
        });
        wall.steps.sort_unstable_by_key(|s| s.0);
    }
    walls.retain(|w| !w.steps.is_empty());
    walls
}

/// The winding numbers of each cell; `None` where ways around an edge disagree.
fn windings(walls: &[Wall], cells: &Cells<'_>, crosses_itself: &[bool]) -> Option<Vec<Winding>> {
    let mut around: Vec<Vec<(u32, bool)>> = vec![Vec::new(); cells.count()];
    for t in 0..walls.len() {
        around[cells.front(t) as usize].push((t as u32, true));
        around[cells.back(t) as usize].push((t as u32, false));
    }
    let mut windings: Vec<Option<Winding>> = vec![None; cells.count()];
    windings[Cells::UNBOUNDED as usize] = Some(Winding::new());
    let mut queue = VecDeque::from([Cells::UNBOUNDED]);
    while let Some(cell) = queue.pop_front() {
        for &(t, in_front) in &around[cell as usize] {
            let wall = &walls[t as usize];
            let next = match in_front {
                true => cells.back(t as usize),
                false => cells.front(t as usize),
            };
            let here = windings[cell as usize].as_ref()?;
            let there = stepped(here, wall, in_front, crosses_itself);
            match &windings[next as usize] {
                Some(known) if *known == there => {}
                Some(_) => return None,
                None => {
                    windings[next as usize] = Some(there);
                    queue.push_back(next);
                }
            }
        }
    }
    windings.into_iter().collect()
}

fn stepped(here: &Winding, wall: &Wall, in_front: bool, crosses_itself: &[bool]) -> Winding {
    let mut there: BTreeMap<u32, i32> = here.iter().copied().collect();
    for &(solid, step, _) in &wall.steps {
        let number = there.entry(solid).or_default();
        match crosses_itself[solid as usize] {
            true => *number += if in_front { step } else { -step },
            false => *number ^= 1,
        }
    }
    there.into_iter().filter(|s| s.1 != 0).collect()
}

/// Volumes and surfaces of cells.
struct Measures {
    volume: Vec<f64>,
    area: Vec<f64>,
}

impl Measures {
    fn of(complex: &Complex, triangles: &[[u32; 3]], cells: &Cells<'_>) -> Self {
        let mut volume = vec![0.0; cells.count()];
        let mut area = vec![0.0; cells.count()];
        let origin = complex.points[triangles[0][0] as usize];
        for (t, corners) in triangles.iter().enumerate() {
            let [a, b, c] = corners.map(|v| complex.points[v as usize]);
            let part = tet_volume(origin, a, b, c);
            let size = triangle_area(a, b, c);
            let [front, back] = [cells.front(t), cells.back(t)].map(|c| c as usize);
            volume[front] -= part;
            volume[back] += part;
            area[front] += size;
            area[back] += size;
        }
        Self { volume, area }
    }
}

/// The solids that each cell is inside of, in order. A solid that crosses itself and is turned inside out is turned
/// over.
fn inside(windings: &[Winding], measures: &Measures, crosses_itself: &[bool]) -> Vec<Vec<u32>> {
    let mut total = vec![0.0; crosses_itself.len()];
    for (winding, volume) in windings.iter().zip(&measures.volume) {
        for &(solid, number) in winding {
            total[solid as usize] += f64::from(number) * volume;
        }
    }
    let is_inside = |&(solid, number): &(u32, i32)| {
        !crosses_itself[solid as usize] || (number > 0) == (total[solid as usize] > 0.0)
    };
    let of = |w: &Winding| w.iter().filter(|s| is_inside(s)).map(|s| s.0).collect();
    windings.iter().map(of).collect()
}

/// Pairs of solids that claim cells in common, the lower one first. The one that lies inside the other wins, or else
/// the one that the rule says.
fn claims(inside: &[Vec<u32>], measures: &Measures, rule: Overlap) -> BTreeMap<[u32; 2], Claim> {
    let mut common: BTreeMap<[u32; 2], (f64, f64, usize)> = BTreeMap::new();
    let mut cells: BTreeMap<u32, usize> = BTreeMap::new();
    for (c, solids) in inside.iter().enumerate() {
        for (i, &a) in solids.iter().enumerate() {
            *cells.entry(a).or_default() += 1;
            for &b in &solids[i + 1..] {
                let sum = common.entry([a, b]).or_default();
                sum.0 += measures.volume[c];
                sum.1 += measures.area[c];
                sum.2 += 1;
            }
        }
    }
    let claim = |([a, b], (volume, area, count)): ([u32; 2], (f64, f64, usize))| {
        let [first, second] = [a, b].map(|s| cells[&s] == count);
        let winner = match (first, second) {
            (true, false) => a,
            (false, true) => b,
            _ if rule == Overlap::Earlier => a,
            _ => b,
        };
        let claim = Claim {
            winner,
            loser: if winner == a { b } else { a },
            volume,
            thickness: 2.0 * volume / area.max(f64::MIN_POSITIVE),
            nested: first != second,
        };
        ([a, b], claim)
    };
    common.into_iter().map(claim).collect()
}

/// Of each solid that crosses itself: what it has more than once.
fn doubled(windings: &[Winding], measures: &Measures, crosses_itself: &[bool]) -> Vec<(u32, f64)> {
    let mut of: BTreeMap<u32, f64> = (0..)
        .zip(crosses_itself)
        .filter(|s| *s.1)
        .map(|s| (s.0, 0.0))
        .collect();
    for (winding, volume) in windings.iter().zip(&measures.volume) {
        for &(solid, number) in winding {
            if let Some(sum) = of.get_mut(&solid) {
                *sum += f64::from(number.abs() - 1) * volume;
            }
        }
    }
    of.into_iter().collect()
}
