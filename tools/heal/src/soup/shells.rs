//! The closed shells of a surface, where solids that touch were written as one.

use super::surface::Surface;
use geom::edges::{EdgeUse, Edges, apex_of};
use geom::measure::tet_volume;
use geom::sets::DisjointSets;
use geom::smooth::SMOOTH;
use geom::tree::{Direction, Met, Rays};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::f64::consts::TAU;

/// The solid of each triangle, where each closed shell of a group is one, numbered in order of appearance, and the groups that they are of; `None` where edges do
/// not tell, or each group has one shell. A shell that looks inwards is a cavity of the least solid around it. n log n.
pub fn solids_of_shells(surface: &Surface, edges: &Edges) -> Option<(Vec<u32>, Vec<u32>)> {
    let mut sets = DisjointSets::new(surface.triangles.len());
    let mut shared = Vec::new();
    for edge in 0..edges.len() {
        for (group, fan) in fans(surface, edges, edge) {
            match fan[..] {
                [a, b] if a.forward != b.forward => {
                    sets.join(a.triangle, b.triangle);
                }
                _ if 2 * fan.iter().filter(|u| u.forward).count() != fan.len() => return None,
                _ => shared.push((edge, group)),
            }
        }
    }
    // What hangs together elsewhere tells what does at an edge that shells share, first where that leaves no choice.
    loop {
        let before = shared.len();
        shared.retain(|&(edge, group)| {
            let open = open_at(surface, edges, (edge, group), &mut sets);
            if let [a, b] = open[..] {
                sets.join(a.triangle, b.triangle);
            }
            open.len() > 2
        });
        if shared.len() == before {
            break;
        }
    }
    for at in shared {
        let open = open_at(surface, edges, at, &mut sets);
        for [s, t] in pairs(surface, edges.ends[at.0], &open) {
            sets.join(s, t);
        }
    }
    let (shell, count) = sets.numbered();
    let mut shells: Vec<Shell> = vec![Shell::default(); count];
    for (t, &s) in (0..).zip(&shell) {
        let shell = &mut shells[s as usize];
        let [a, b, c] = surface.corners(t);
        shell.volume += tet_volume(DVec3::ZERO, a, b, c);
        shell.group = surface.group[t as usize];
        shell.place = (a + b + c) / 3.0;
    }
    // A file whose triangles all look inwards is turned over.
    let whole: f64 = shells.iter().map(|s| s.volume).sum();
    let is_solid = |s: usize| shells[s].volume * whole > 0.0;
    let rays = Rays::new(&surface.points, &surface.triangles);
    let of = |s: usize| match is_solid(s) {
        true => Some(s),
        false => around((surface, &rays), (&shell, &shells), s, is_solid),
    };
    let of: Vec<usize> = (0..count).map(of).collect::<Option<_>>()?;
    let mut number: FxHashMap<usize, u32> = FxHashMap::default();
    let mut groups = Vec::new();
    let solid = shell.iter().map(|&s| {
        let s = of[s as usize];
        *number.entry(s).or_insert_with(|| {
            groups.push(shells[s].group);
            groups.len() as u32 - 1
        })
    });
    let solid: Vec<u32> = solid.collect();
    (groups.len() > surface.groups.len()).then_some((solid, groups))
}

/// A single solid with its closed shells as solids; `None` where it has one, or edges do not tell. n log n.
pub fn parts(whole: &Surface, edges: &Edges) -> Option<Surface> {
    let mut parts = whole.clone();
    parts.group.fill(0);
    parts.groups.truncate(1);
    let (solid, of) = solids_of_shells(&parts, edges)?;
    parts.solids = (1..=of.len()).map(|n| format!("part {n}")).collect();
    parts.solid = solid;
    parts.group.clone_from(&whole.group);
    parts.groups.clone_from(&whole.groups);
    Some(parts)
}

/// A closed shell.
#[derive(Clone, Debug, Default)]
struct Shell {
    /// Volume inside, below zero where it looks inwards.
    volume: f64,
    group: u32,
    /// A place on it.
    place: DVec3,
}

/// The least solid of the same group around a shell that is a cavity.
fn around(
    (surface, rays): (&Surface, &Rays<'_>),
    (shell, shells): (&[u32], &[Shell]),
    cavity: usize,
    is_solid: impl Fn(usize) -> bool,
) -> Option<usize> {
    let Shell { place, group, .. } = shells[cavity];
    let along = Direction::ALL[0];
    let of = |t: u32| shell[t as usize] as usize;
    let is_wanted = |t: u32| surface.group[t as usize] == group && is_solid(of(t));
    let mut hits: FxHashMap<usize, usize> = FxHashMap::default();
    for hit in rays.all(place, along, is_wanted) {
        *hits.entry(of(hit.triangle)).or_default() += 1;
    }
    // What fills a cavity has its triangles, too.
    let size = |s: usize| shells[s].volume.abs();
    let is_around = |other: usize| {
        let met = rays.nearest(place, along, |t| of(t) == other);
        size(other) > size(cavity) && !matches!(met, Met::Touches(_))
    };
    let odd = hits.into_iter().filter(|(_, count)| count % 2 == 1);
    let around = odd.map(|(other, _)| other).filter(|&s| is_around(s));
    around.min_by(|&a, &b| size(a).total_cmp(&size(b)).then(a.cmp(&b)))
}

/// The triangles around an edge, by groups.
fn fans(surface: &Surface, edges: &Edges, edge: usize) -> Vec<(u32, Vec<EdgeUse>)> {
    let mut fans: Vec<(u32, Vec<EdgeUse>)> = Vec::new();
    for u in edges.around(edge) {
        let group = surface.group[u.triangle as usize];
        match fans.iter_mut().find(|fan| fan.0 == group) {
            Some(fan) => fan.1.push(*u),
            None => fans.push((group, vec![*u])),
        }
    }
    fans
}

/// The triangles of a group around an edge that are of shells which are not closed there, as far as is known.
fn open_at(
    surface: &Surface,
    edges: &Edges,
    (edge, group): (usize, u32),
    sets: &mut DisjointSets,
) -> Vec<EdgeUse> {
    let of_group = |u: &&EdgeUse| surface.group[u.triangle as usize] == group;
    let mut open: Vec<(u32, EdgeUse)> = Vec::new();
    for u in edges.around(edge).iter().filter(of_group) {
        let shell = sets.find(u.triangle);
        // What looks the other way closes what is open.
        match open
            .iter()
            .position(|o| o.0 == shell && o.1.forward != u.forward)
        {
            Some(closed) => {
                open.remove(closed);
            }
            None => open.push((shell, *u)),
        }
    }
    open.into_iter().map(|o| o.1).collect()
}

/// The pairs of triangles around an edge that bound the same space there, as many of which look one way as the other. Turning right-handed, what is behind one
/// that runs backward begins there, and what is behind another one ends. What begins first ends first: where solids touch, facets of one may reach a
/// little into the other.
fn pairs(surface: &Surface, ends: [u32; 2], fan: &[EdgeUse]) -> Vec<[u32; 2]> {
    let [a, b] = ends.map(|v| surface.points[v as usize]);
    let (x, y) = (b - a).normalize_or_zero().any_orthonormal_pair();
    let angle = |u: &EdgeUse| {
        let apex = apex_of(&surface.triangles[u.triangle as usize], u.corner);
        let off = surface.points[apex as usize] - a;
        libm::atan2(off.dot(y), off.dot(x))
    };
    let sorted = |forward: bool| {
        let some = fan.iter().filter(|u| u.forward == forward);
        let mut some: Vec<(f64, u32)> = some.map(|u| (angle(u), u.triangle)).collect();
        some.sort_by(|u, v| u.0.total_cmp(&v.0).then(u.1.cmp(&v.1)));
        some
    };
    let [begins, ends] = &[sorted(false), sorted(true)];
    let paired = |shift: usize| {
        let each = begins.iter().enumerate();
        each.map(move |(i, begin)| (begin, &ends[(i + shift) % ends.len()]))
    };
    let wedges = |shift: usize| {
        let wedge = |(begin, end): (&(f64, u32), &(f64, u32))| (end.0 - begin.0).rem_euclid(TAU);
        let each: Vec<f64> = paired(shift).map(wedge).collect();
        let least = each.iter().copied().fold(f64::INFINITY, f64::min);
        (each.iter().sum::<f64>(), least)
    };
    // Solids fill no more than all of the space around the edge, and none of them is a sliver if others will do.
    let fits = |shift: &usize| wedges(*shift).0 <= TAU + SMOOTH;
    let best = (0..ends.len())
        .filter(fits)
        .max_by(|&i, &j| wedges(i).1.total_cmp(&wedges(j).1));
    paired(best.unwrap_or(0))
        .map(|(begin, end)| [begin.1, end.1])
        .collect()
}
