//! The envelope of a surface: what is near enough to it.

use super::{Allowance, Curves, Patches};
use crate::input::{Rules, Surface};
use geom::measure::double_area_vector;
use geom::tree::{Nearest, Tree, closest_point};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// The surface and its feature curves, with how far one may be from each part of them.
pub struct Envelope {
    faces: Part,
    edges: Part,
    /// How far each triangle may be from the surface.
    reach: Vec<f64>,
    /// Unit normals of the shape at the corners of triangles, averaged over their patches.
    normals: Vec<[DVec3; 3]>,
    size: Vec<[f64; 3]>,
}

/// Triangles or edges.
struct Part {
    /// Of each group, a patch or curve: others may be nearer, and then one tree of all is looked at for nothing.
    groups: Vec<Group>,
    corners: Vec<[DVec3; 3]>,
    reach: Vec<f64>,
    /// Largest reach of a group.
    most: Vec<f64>,
}

/// The triangles or edges of a patch or curve.
struct Group {
    tree: Tree,
    members: Vec<u32>,
}

impl Group {
    fn nearest(&self, p: DVec3, within: f64) -> Option<Nearest> {
        let found = self.tree.nearest(p, within)?;
        Some(Nearest {
            triangle: self.members[found.triangle as usize],
            ..found
        })
    }
}

/// What is near.
#[derive(Clone, Copy)]
pub enum Near {
    /// Triangles of this patch.
    Patch(u32),
    /// Edges of this curve.
    Curve(u32),
}

/// Halvings of an edge that passes from the reach of one triangle to that of the next: the half that does gets as short as
/// rounding of what it started with.
const HALVINGS: u32 = f64::MANTISSA_DIGITS / 2;

impl Envelope {
    /// The envelope of a surface. n log n.
    pub fn new(
        (surface, rules): (&Surface, &Rules<'_>),
        patches: &Patches,
        curves: &Curves,
        allowance: &Allowance,
    ) -> Self {
        let corners: Vec<[DVec3; 3]> = (0..surface.triangles.len() as u32)
            .map(|t| surface.corners(t))
            .collect();
        let chords = curves.ends.iter().map(|&[a, b]| {
            let [a, b] = [a, b].map(|v| surface.points[v as usize]);
            [a, b, b]
        });
        Self {
            reach: allowance.reach.clone(),
            normals: normals(surface, patches),
            size: (surface.triangles.iter())
                .map(|t| t.map(|v| allowance.size[v as usize]))
                .collect(),
            faces: Part::new(
                corners,
                &patches.of,
                &reaches(surface, rules, patches, allowance),
                patches.planes.len(),
            ),
            edges: Part::new(chords.collect(), &curves.of, &curves.reach, curves.count),
        }
    }

    fn part(&self, near: Near) -> (&Part, u32) {
        match near {
            Near::Patch(patch) => (&self.faces, patch),
            Near::Curve(curve) => (&self.edges, curve),
        }
    }

    /// Whether a segment is inside, all of it: where both ends are in the reach of one triangle, which is convex,
    /// everything between them is. `least`: how far it may be in any case, model units.
    pub fn holds(&self, near: Near, ends: [DVec3; 2], least: f64) -> bool {
        let (part, group) = self.part(near);
        part.holds((group, least), ends, HALVINGS)
    }

    /// The nearest point of a patch or curve, wherever it is.
    pub fn nearest(&self, near: Near, p: DVec3) -> Option<DVec3> {
        let (part, group) = self.part(near);
        Some(part.groups[group as usize].nearest(p, f64::INFINITY)?.point)
    }

    /// The unit normal of the shape near a point of a patch, and the length of edges wanted there.
    pub fn at(&self, patch: u32, p: DVec3) -> Option<(DVec3, f64)> {
        let part = &self.faces;
        let found = part.groups[patch as usize].nearest(p, f64::INFINITY)?;
        let t = found.triangle as usize;
        let weights = barycentric(part.corners[t], found.point);
        let normal: DVec3 = (0..3).map(|i| self.normals[t][i] * weights[i]).sum();
        let size = (0..3).map(|i| self.size[t][i] * weights[i]).sum();
        Some((normal.normalize_or_zero(), size))
    }

    /// How far a triangle of the input may be from the surface.
    pub fn reach(&self, triangle: u32) -> f64 {
        self.reach[triangle as usize]
    }

    /// How far a curve may be from a feature edge of the input.
    pub fn reach_of_edge(&self, edge: u32) -> f64 {
        self.edges.reach[edge as usize]
    }
}

impl Part {
    fn new(corners: Vec<[DVec3; 3]>, group: &[u32], reach: &[f64], count: usize) -> Self {
        let mut most = vec![0.0_f64; count];
        for (&group, &reach) in group.iter().zip(reach) {
            most[group as usize] = most[group as usize].max(reach);
        }
        let mut members = vec![Vec::new(); count];
        for (t, &group) in (0..).zip(group) {
            members[group as usize].push(t);
        }
        let of_members = |members: Vec<u32>| Group {
            tree: Tree::new(members.iter().map(|&t: &u32| corners[t as usize])),
            members,
        };
        Self {
            groups: members.into_iter().map(of_members).collect(),
            corners,
            reach: reach.to_vec(),
            most,
        }
    }

    fn near(&self, (group, least): (u32, f64), p: DVec3) -> Option<(u32, f64)> {
        // Just above the largest reach, so that what is at it counts.
        let within = self.most[group as usize].max(least) * (1.0 + f64::EPSILON.sqrt());
        let found = self.groups[group as usize].nearest(p, within)?;
        Some((found.triangle, found.distance))
    }

    fn inside(&self, group: (u32, f64), p: DVec3) -> bool {
        let near = self.near(group, p);
        near.is_some_and(|(t, distance)| distance <= self.reach[t as usize].max(group.1))
    }

    fn holds(&self, group: (u32, f64), [p, q]: [DVec3; 2], halvings: u32) -> bool {
        let middle = 0.5 * (p + q);
        let Some((t, distance)) = self.near(group, middle) else {
            return false;
        };
        let corners = &self.corners[t as usize];
        let reach = self.reach[t as usize].max(group.1);
        if distance > reach {
            return false;
        }
        let outside = |p: DVec3| closest_point(p, corners).distance(p) > reach;
        let half = |end: DVec3| {
            if !outside(end) {
                return true;
            }
            match halvings.checked_sub(1) {
                Some(left) => self.holds(group, [middle, end], left),
                None => self.inside(group, end),
            }
        };
        half(p) && half(q)
    }
}

/// How far the surface may be from each triangle so that the triangles, too, are no farther from the surface than the deviation. What is farthest
/// from it are folds that it cuts off, and from an edge below a fold it is farther to the fold than to the triangles beside it: over the cosine of half
/// of the angle between these. Fold and edge pass each other there, and in between the distance is that of flat faces.
fn reaches(
    surface: &Surface,
    rules: &Rules<'_>,
    patches: &Patches,
    allowance: &Allowance,
) -> Vec<f64> {
    let mut reach = allowance.reach.clone();
    for edge in 0..patches.edges.len() {
        let Some(both) = patches.smooth(surface, rules, edge) else {
            continue;
        };
        let most = rules.deviation * libm::cos(0.5 * patches.turn(surface, both));
        for used in both {
            let reach = &mut reach[used.triangle as usize];
            *reach = reach.min(most);
        }
    }
    reach
}

fn barycentric([a, b, c]: [DVec3; 3], p: DVec3) -> [f64; 3] {
    let area = double_area_vector(a, b, c);
    let squared = area.length_squared();
    if squared == 0.0 {
        return [1.0 / 3.0; 3];
    }
    let part = |x: DVec3, y: DVec3| double_area_vector(p, x, y).dot(area) / squared;
    [part(b, c), part(c, a), part(a, b)]
}

/// Normals at corners: averages over the patch around the vertex, weighted by area, so that needles do not count.
fn normals(surface: &Surface, patches: &Patches) -> Vec<[DVec3; 3]> {
    let mut sums: FxHashMap<(u32, u32), DVec3> = FxHashMap::default();
    for (t, corners) in surface.triangles.iter().enumerate() {
        let [a, b, c] = surface.corners(t as u32);
        let vector = double_area_vector(a, b, c);
        for &v in corners {
            *sums.entry((patches.of[t], v)).or_default() += vector;
        }
    }
    (surface.triangles.iter().enumerate())
        .map(|(t, corners)| {
            corners.map(|v| {
                let sum = sums.get(&(patches.of[t], v));
                sum.copied().unwrap_or_default().normalize_or_zero()
            })
        })
        .collect()
}
