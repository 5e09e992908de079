//! Patches: connected triangles without a feature between them. A flat face is a patch of its own.

use super::beside::Beside;
use super::beyond::Beyond;
use super::facets::Facets;
use crate::input::{Rules, Surface};
use geom::edges::{EdgeUse, Edges, apex_of};
use geom::flat::{FOLD_COSINE, Flatness, Flats, Plane};
use geom::measure::{double_area_vector, triangle_area};
use geom::sets::DisjointSets;
use glam::DVec3;

/// The patches of a surface.
pub struct Patches {
    /// Edges of the surface.
    pub edges: Edges,
    /// Patch of each triangle.
    pub of: Vec<u32>,
    /// The plane of each patch that is a flat face.
    pub planes: Vec<Option<Plane>>,
    /// How far off that plane its triangles may be, model units.
    pub off: Vec<f64>,
    /// Largest coplanar group of each triangle.
    pub facet: Vec<u32>,
    /// Unit normal of each triangle.
    pub normals: Vec<DVec3>,
}

/// Least cosine of the angle between a triangle and the shape that it stands for: 45 degrees, half of what would fold it
/// over its neighbours if they are off as much.
pub const UPRIGHT: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Share of the border of a flat face, beside which other facets go on as in a smooth surface with facets like it, from
/// which on it is one of these facets: strips around a cylinder have it along both of their long sides, and what
/// is as long as wide, on a sphere, along all. A face in which roundings of its own width end would need half.
pub const ALIKE: f64 = 0.25;

impl Patches {
    /// Divides a surface. n log n.
    pub fn new(surface: &Surface, rules: &Rules<'_>) -> Self {
        let edges = Edges::new(&surface.triangles);
        let across = edges.across();
        let labels = &surface.labels;
        let alike = |s: u32, t: u32| labels[s as usize] == labels[t as usize];
        let (points, triangles) = (&surface.points, &surface.triangles);
        let even = Flatness {
            distance: rules.flat,
            cosine: rules.feature,
        };
        let folded = Flatness {
            distance: rules.folds,
            cosine: FOLD_COSINE,
        };
        let flats = Flats::new(points, triangles, &across, |_| [even, folded], alike);
        let mut patches = Self {
            edges,
            of: Vec::new(),
            planes: Vec::new(),
            off: Vec::new(),
            facet: flats.regions.of,
            normals: normals(surface),
        };
        let mut off = vec![rules.flat; flats.planes.len()];
        for (t, &facet) in (0..).zip(&patches.facet) {
            if flats.planes[facet as usize].off(surface.corners(t)) > rules.flat {
                off[facet as usize] = rules.folds;
            }
        }
        let mut planes = flats.planes;
        let mut is_face = patches.faces(surface, rules, &off);
        // Shallow folds are those of a flat face. Of what is curved, every facet counts: each of several that hardly turn hides
        // what they do, but not all of them together.
        let is_curved = |f: u32| off[f as usize] > rules.flat && !is_face[f as usize];
        if patches.facet.iter().any(|f| is_curved(*f)) {
            let flats = Flats::new(points, triangles, &across, |_| [even], alike);
            let first = planes.len() as u32;
            for (facet, of) in patches.facet.iter_mut().zip(flats.regions.of) {
                if is_curved(*facet) {
                    *facet = first + of;
                }
            }
            planes.extend(flats.planes);
            off.resize(planes.len(), rules.flat);
            is_face = patches.faces(surface, rules, &off);
        }
        let mut sets = DisjointSets::new(surface.triangles.len());
        for edge in 0..patches.edges.len() {
            if let Some([u, v]) = patches.smooth(surface, rules, edge) {
                let [f, g] = [u, v].map(|u| patches.facet[u.triangle as usize]);
                if f == g || !is_face[f as usize] && !is_face[g as usize] {
                    sets.join(u.triangle, v.triangle);
                }
            }
        }
        let mut number = vec![u32::MAX; surface.triangles.len()];
        for t in 0..surface.triangles.len() as u32 {
            let first = sets.find(t) as usize;
            if number[first] == u32::MAX {
                number[first] = patches.planes.len() as u32;
                let facet = patches.facet[t as usize] as usize;
                patches.planes.push(is_face[facet].then_some(planes[facet]));
                patches.off.push(off[facet]);
            }
            patches.of.push(number[first]);
        }
        patches.leave_strips(surface, rules);
        patches
    }

    /// Every flat facet on its own, whatever it is a part of.
    pub fn of_facets(surface: &Surface, rules: &Rules<'_>) -> Self {
        let edges = Edges::new(&surface.triangles);
        let labels = &surface.labels;
        let alike = |s: u32, t: u32| labels[s as usize] == labels[t as usize];
        let (points, triangles) = (&surface.points, &surface.triangles);
        let even = Flatness {
            distance: rules.flat,
            cosine: FOLD_COSINE,
        };
        let flats = Flats::new(points, triangles, &edges.across(), |_| [even], alike);
        let count = flats.planes.len();
        Self {
            edges,
            of: flats.regions.of.clone(),
            facet: flats.regions.of,
            planes: flats.planes.into_iter().map(Some).collect(),
            off: vec![rules.flat; count],
            normals: normals(surface),
        }
    }

    /// The parts of a surface that go on smoothly, flat faces and curved ones as one.
    pub fn of_labels(surface: &Surface, rules: &Rules<'_>) -> Self {
        let mut patches = Self {
            edges: Edges::new(&surface.triangles),
            of: Vec::new(),
            planes: Vec::new(),
            off: Vec::new(),
            facet: Vec::new(),
            normals: normals(surface),
        };
        let mut sets = DisjointSets::new(surface.triangles.len());
        for edge in 0..patches.edges.len() {
            if let Some([u, v]) = patches.smooth(surface, rules, edge) {
                sets.join(u.triangle, v.triangle);
            }
        }
        let (of, count) = sets.numbered();
        patches.facet = of.clone();
        patches.of = of;
        patches.planes = vec![None; count];
        patches.off = vec![rules.flat; count];
        patches
    }

    /// The width of each patch, model units: that of a square with the same area to its border, twice that of a long
    /// strip. NaN or infinite for what has no border.
    pub fn widths(&self, surface: &Surface) -> Vec<f64> {
        self.widths_of(surface, &self.of)
    }

    /// The same of other sets of triangles.
    pub(super) fn widths_of(&self, surface: &Surface, sets: &[u32]) -> Vec<f64> {
        let count = sets.iter().max().map_or(0, |most| *most as usize + 1);
        let (mut area, mut border) = (vec![0.0; count], vec![0.0; count]);
        for (t, &set) in sets.iter().enumerate() {
            let [a, b, c] = surface.corners(t as u32);
            area[set as usize] += triangle_area(a, b, c);
        }
        for (edge, ends) in self.edges.ends.iter().enumerate() {
            let [a, b] = ends.map(|v| surface.points[v as usize]);
            let around = self.edges.around(edge);
            let of = |u: &EdgeUse| sets[u.triangle as usize] as usize;
            if !matches!(around, [u, v] if of(u) == of(v)) {
                around.iter().for_each(|u| border[of(u)] += a.distance(b));
            }
        }
        let each = area.into_iter().zip(border);
        each.map(|(area, border): (f64, f64)| 4.0 * area / border)
            .collect()
    }

    /// The two triangles at an edge of a smooth surface.
    pub fn smooth(
        &self,
        surface: &Surface,
        rules: &Rules<'_>,
        edge: usize,
    ) -> Option<[EdgeUse; 2]> {
        let [u, v] = self.pair(surface, edge)?;
        let [m, n] = [u, v].map(|u| self.normals[u.triangle as usize]);
        (m.dot(n) >= rules.feature).then_some([u, v])
    }

    /// The two triangles at an edge, if there are no others, they have one label and face the same side.
    fn pair(&self, surface: &Surface, edge: usize) -> Option<[EdgeUse; 2]> {
        let &[u, v] = self.edges.around(edge) else {
            return None;
        };
        let [s, t] = [u, v].map(|u| surface.labels[u.triangle as usize]);
        (u.forward != v.forward && s == t).then_some([u, v])
    }

    /// Whether an edge is inside of a patch, and no feature. Triangles of a flat face fold by more than features do only where they
    /// are lower than what may be off its plane.
    pub fn is_inner(&self, surface: &Surface, rules: &Rules<'_>, edge: usize) -> bool {
        let of = |[u, v]: [EdgeUse; 2]| {
            let [p, q] = [u, v].map(|u| self.of[u.triangle as usize]);
            (p == q).then_some(p)
        };
        let Some(patch) = self.pair(surface, edge).and_then(of) else {
            return false;
        };
        self.planes[patch as usize].is_some() || self.smooth(surface, rules, edge).is_some()
    }

    /// The angle between the triangles at a smooth edge, radians, positive where the edge is convex seen from the front.
    pub fn turn(&self, surface: &Surface, [u, v]: [EdgeUse; 2]) -> f64 {
        let [m, n] = [u, v].map(|u| self.normals[u.triangle as usize]);
        let angle = libm::atan2(m.cross(n).length(), m.dot(n));
        let apex = apex_of(&surface.triangles[v.triangle as usize], v.corner);
        let base = surface.triangles[u.triangle as usize][0];
        let [apex, base] = [apex, base].map(|v| surface.points[v as usize]);
        if m.dot(apex - base) <= 0.0 {
            angle
        } else {
            -angle
        }
    }

    /// Of each coplanar group, whether it is a flat face and not a facet of something curved: it is where hardly anything
    /// beside it goes on smoothly with facets of at least half its width. A group that is off its plane, as far as `off` says of
    /// each, may be one of those that hardly turn: it is a face where hardly anything goes on smoothly at all.
    fn faces(&self, surface: &Surface, rules: &Rules<'_>, off: &[f64]) -> Vec<bool> {
        let mate = |edge: usize, u: &EdgeUse| {
            let [a, b] = self.smooth(surface, rules, edge)?;
            Some(if a == *u { b } else { a })
        };
        let facets = Facets {
            points: &surface.points,
            triangles: &surface.triangles,
            normals: &self.normals,
            edges: &self.edges,
            of: &self.facet,
            rise: rules.noise,
        };
        let beyond = Beyond::new((surface, rules), (&self.edges, &self.normals), &self.facet);
        let mut beside = facets.beside(off.len(), mate, &beyond);
        let same = beyond.join(&mut beside);
        // A single triangle is one of the facets of whatever goes on smoothly beside it.
        let is_face = |(beside, off): (&Beside, &f64)| match beside.triangles {
            1 => beside.smooth == 0.0,
            _ if *off > rules.flat => beside.smooth <= ALIKE * beside.border,
            _ => beside.like <= ALIKE * beside.border,
        };
        let one: Vec<bool> = beside.iter().zip(off).map(is_face).collect();
        same.into_iter().map(|first| one[first as usize]).collect()
    }
}

/// Unit normals of the triangles.
fn normals(surface: &Surface) -> Vec<DVec3> {
    let vector = |t| {
        let [a, b, c] = surface.corners(t);
        double_area_vector(a, b, c).normalize_or_zero()
    };
    (0..surface.triangles.len() as u32).map(vector).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Drawn, Link, Sizes};

    /// A cube whose upper side has a point in it, raised by this much.
    fn cube(raised: f64) -> Surface {
        let corner =
            |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
        let mut points: Vec<DVec3> = (0..8).map(corner).collect();
        points.push(DVec3::new(0.4, 0.4, 1.0 + raised));
        let quads = [
            [0, 2, 3, 1],
            [0, 1, 5, 4],
            [1, 3, 7, 5],
            [3, 2, 6, 7],
            [2, 0, 4, 6],
        ];
        let halves = quads
            .into_iter()
            .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        let upper = [[4, 5, 8], [5, 7, 8], [7, 6, 8], [6, 4, 8]];
        let triangles: Vec<[u32; 3]> = halves.chain(upper).collect();
        Surface {
            labels: vec![0; triangles.len()],
            points,
            triangles,
        }
    }

    /// The number of flat faces, and of patches that are none, where faces may be so uneven.
    fn faces(surface: &Surface, folds: f64) -> [usize; 2] {
        faces_between(surface, folds, &vec![0; surface.points.len()])
    }

    /// The same of a surface of which each vertex is on some of the planes x = 0 (bit 0) and x = y (bit 1).
    fn faces_between(surface: &Surface, folds: f64, bound: &[u32]) -> [usize; 2] {
        faces_glued(surface, folds, bound, &[])
    }

    /// The same where some of its faces are glued to each other.
    fn faces_glued(surface: &Surface, folds: f64, bound: &[u32], links: &[Link]) -> [usize; 2] {
        let onto = |bit: u32, p: DVec3| match bit {
            0 => DVec3::new(0.0, p.y, p.z),
            _ => DVec3::new(0.5 * (p.x + p.y), 0.5 * (p.x + p.y), p.z),
        };
        faces_cut((surface, folds), (bound, &onto), links)
    }

    /// The same where planes are given.
    fn faces_cut(
        (surface, folds): (&Surface, f64),
        (bound, onto): (&[u32], &(dyn Fn(u32, DVec3) -> DVec3 + Sync)),
        links: &[Link],
    ) -> [usize; 2] {
        let rules = Rules {
            sharp: 0.0,
            drawn: Drawn::Roughly,
            held: &vec![false; surface.points.len()],
            bound,
            links,
            spaces: &[],
            onto,
            deviation: 1e-3,
            nearer: &[],
            noise: 1e-3,
            flat: 1e-10,
            folds,
            feature: 0.75_f64.sqrt(),
            sizes: Sizes {
                turn: 0.5,
                turn_is_asked: false,
                lengths: &[],
                local: None,
                growth: 0.5,
            },
        };
        let patches = Patches::new(surface, &rules);
        let flat = patches.planes.iter().flatten().count();
        [flat, patches.planes.len() - flat]
    }

    /// Strips that turn in turn by such angles, degrees, each as wide as an arc of radius 1 over some angle of its own.
    fn strips(all: &[(f64, f64)]) -> Surface {
        let mut surface = Surface::default();
        let (mut place, mut angle) = (DVec3::ZERO, 0.0_f64);
        for i in 0..=all.len() {
            surface.points.push(place);
            surface.points.push(place + 5.0 * DVec3::Z);
            if let Some(&(turn, width)) = all.get(i) {
                angle += turn.to_radians();
                let width = 2.0 * libm::sin(0.5 * width.to_radians());
                place += width * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
            }
        }
        for i in 0..all.len() as u32 {
            let [a, b, c, d] = [0, 2, 3, 1].map(|k| 2 * i + k);
            surface.triangles.extend([[a, b, c], [a, c, d]]);
        }
        surface.labels = vec![0; surface.triangles.len()];
        surface
    }

    #[test]
    fn wide_strips_of_an_arc_are_no_faces_but_those_between_arcs_are() {
        // Twelve and four degrees of one circle by turns.
        let uneven = [(8.0, 12.0), (8.0, 4.0)].repeat(5);
        assert_eq!(faces(&strips(&uneven), 0.0), [0, 1]);
        // A face as wide as twelve degrees between roundings of four: the circle goes on only up to its sides.
        let rounding = [(4.0, 4.0)].repeat(6);
        let face = [(2.0, 12.0), (2.0, 4.0)];
        let between = [&rounding[..], &face, &rounding].concat();
        assert_eq!(faces(&strips(&between), 0.0), [1, 2]);
    }

    /// Two rows of facets of an arc that meet at a strip so wide, or two flat faces in place of the arcs.
    fn blade(width: f64, is_curved: bool) -> Surface {
        let mut surface = Surface::default();
        for i in 0..4 {
            let x = f64::from(i);
            let y = x - if is_curved { 0.1 * x * x } else { 0.0 };
            for z in [0.0, 5.0] {
                surface.points.push(DVec3::new(x, y, z));
                surface.points.push(DVec3::new(x, -y - width, z));
            }
        }
        let quad = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
        for i in 0..3 {
            let first = 4 * i;
            let upper = quad([0, 2, 6, 4].map(|v| first + v));
            let lower = quad([1, 5, 7, 3].map(|v| first + v));
            surface.triangles.extend(upper.into_iter().chain(lower));
        }
        surface.triangles.extend(quad([0, 1, 3, 2]));
        surface.labels = vec![0; surface.triangles.len()];
        surface
    }

    /// Strips of a quarter turn along y, of radius one half, that begin at y = 1 at a level face, whose corners there are given.
    fn rounding(corners: [DVec3; 2], strips: u32) -> Surface {
        let mut surface = Surface::default();
        for i in 0..=strips {
            let angle = std::f64::consts::FRAC_PI_2 * f64::from(i) / f64::from(strips);
            let off = DVec3::new(0.0, 0.5 * angle.sin(), 0.5 * (angle.cos() - 1.0));
            surface.points.extend(corners.map(|p| p + off));
        }
        for i in 0..strips {
            let [a, b, c, d] = [0, 1, 3, 2].map(|v| 2 * i + v);
            surface.triangles.extend([[a, c, b], [a, d, c]]);
        }
        surface
    }

    #[test]
    fn a_face_beside_a_fine_rounding_is_flat() {
        // Half of its border is along the rounding, of which the first facet turns by less than a degree. The finest are so fine that a facet of something
        // curved as wide as the face, which turns by as much, would not rise above noise either.
        let corners = [DVec3::new(0.0, 1.0, 1.0), DVec3::new(4.0, 1.0, 1.0)];
        for strips in [4, 64, 128, 256, 1024] {
            let mut surface = rounding(corners, strips);
            let first = surface.points.len() as u32;
            let back = corners.map(|p| p - DVec3::Y);
            surface.points.extend(back);
            surface
                .triangles
                .extend([[first, 0, 1], [first, 1, first + 1]]);
            surface.labels = vec![0; surface.triangles.len()];
            assert_eq!(faces(&surface, 0.0), [1, 1], "{strips}");
        }
    }

    #[test]
    fn one_triangle_between_mirror_planes_is_a_face() {
        // What x = 0 and x = y leave of a level square.
        let corners = [DVec3::new(0.0, 1.0, 1.0), DVec3::new(1.0, 1.0, 1.0)];
        let mut surface = rounding(corners, 4);
        let centre = surface.points.len() as u32;
        surface.points.push(DVec3::Z);
        surface.triangles.push([centre, 0, 1]);
        surface.labels = vec![0; surface.triangles.len()];
        let mut bound = vec![0; surface.points.len()];
        (bound[0], bound[1], bound[centre as usize]) = (1, 2, 3);
        assert_eq!(faces_between(&surface, 0.0, &bound), [1, 1]);
        // It may be any facet of what is curved where it ends there.
        assert_eq!(faces(&surface, 0.0), [0, 1]);
    }

    #[test]
    fn a_facet_that_mirror_planes_cut_is_one_with_its_images() {
        // What x = 0 and x = y leave of the level facet on top of a dome, beside half of which the dome goes on. The other half ends at
        // an upright facet, which turns to its image by less than features do.
        let at = |polar: f64, around: f64| {
            let (z, r) = (polar.to_radians().cos(), polar.to_radians().sin());
            let around = around.to_radians();
            DVec3::new(r * around.cos(), r * around.sin(), z)
        };
        let mut surface = Surface::default();
        let mut bound = Vec::new();
        surface.points.push(DVec3::Z);
        bound.push(3);
        for polar in [5.0, 10.0, 15.0, 20.0] {
            surface.points.extend([at(polar, 45.0), at(polar, 67.5)]);
            bound.extend([2, 0]);
        }
        let end = DVec3::new(0.0, at(5.0, 90.0).y, at(5.0, 90.0).z);
        surface
            .points
            .extend([end, end - DVec3::Z, surface.points[2] - DVec3::Z]);
        bound.extend([1, 1, 0]);
        surface
            .triangles
            .extend([[0, 1, 2], [0, 2, 9], [2, 11, 10], [2, 10, 9]]);
        for ring in 0..3 {
            let [a, b, c, d] = [1, 3, 4, 2].map(|v| v + 2 * ring);
            surface.triangles.extend([[a, b, c], [a, c, d]]);
        }
        surface.labels = vec![0; surface.triangles.len()];
        assert_eq!(faces_between(&surface, 0.0, &bound), [0, 2]);
        // Without planes, most of both ends there.
        assert_eq!(faces(&surface, 0.0), [2, 1]);
    }

    /// Ten degrees of a cylinder that is drawn with facets of eight and two degrees by turns, cut in the middles of two of the narrow ones.
    fn cut_cylinder() -> Surface {
        let middle = libm::cos(1.0_f64.to_radians());
        let mut surface = Surface::default();
        for (angle, radius) in [(0.0, middle), (1.0, 1.0), (9.0, 1.0), (10.0, middle)] {
            let (sine, cosine) = f64::to_radians(angle).sin_cos();
            let p = DVec3::new(cosine, sine, 0.0) * radius;
            surface.points.extend([p, p + 5.0 * DVec3::Z]);
        }
        for first in [0, 2, 4] {
            let [a, b, c, d] = [0, 2, 3, 1].map(|v| first + v);
            surface.triangles.extend([[a, b, c], [a, c, d]]);
        }
        surface.labels = vec![0; surface.triangles.len()];
        surface
    }

    /// Ten degrees, radians.
    const TEN: f64 = std::f64::consts::PI / 18.0;

    fn turned(p: DVec3, angle: f64) -> DVec3 {
        glam::DQuat::from_rotation_z(angle) * p
    }

    /// Faces that a turn by ten degrees takes onto each other.
    fn link(pairs: &[[u32; 2]], labels: &[u32]) -> Link {
        Link {
            pairs: pairs.to_vec(),
            labels: labels.to_vec(),
            image: std::sync::Arc::new(|p| turned(p, TEN)),
            back: std::sync::Arc::new(|p| turned(p, -TEN)),
        }
    }

    #[test]
    fn a_facet_is_told_from_a_face_by_all_of_what_was_cut_beside_it() {
        let cylinder = cut_cylinder();
        let free = vec![0; cylinder.points.len()];
        // Cut by mirror planes.
        let onto = |bit: u32, p: DVec3| {
            let angle = f64::from(bit) * TEN;
            let p = turned(p, -angle);
            turned(DVec3::new(p.x, 0.0, p.z), angle)
        };
        let bound = [1, 1, 0, 0, 0, 0, 2, 2];
        assert_eq!(faces_cut((&cylinder, 0.0), (&bound, &onto), &[]), [0, 1]);
        // Cut by planes that a rotation takes onto each other.
        let seam = link(&[[0, 6], [1, 7]], &[]);
        assert_eq!(faces_glued(&cylinder, 0.0, &free, &[seam]), [0, 1]);
        // Without what is beyond, the wide one could be a face.
        assert_eq!(faces(&cylinder, 0.0), [1, 2]);
    }

    #[test]
    fn a_glued_face_is_flat_however_it_goes_on_beyond_a_seam() {
        // The wall of a hub, which turns to its image beyond the seam by ten degrees.
        let [p, q] = [DVec3::X, turned(DVec3::X, TEN)];
        let wall = Surface {
            points: vec![p, p + DVec3::Z, q, q + DVec3::Z],
            triangles: vec![[0, 2, 3], [0, 3, 1]],
            labels: vec![0; 2],
        };
        let seam = || link(&[[0, 2], [1, 3]], &[]);
        let free = [0; 4];
        assert_eq!(faces_glued(&wall, 0.0, &free, &[seam()]), [0, 1]);
        let hub = link(&[], &[0]);
        assert_eq!(faces_glued(&wall, 0.0, &free, &[seam(), hub]), [1, 0]);
    }

    #[test]
    fn a_glued_face_is_flat_however_its_images_lie() {
        // What x = 0 and x = y leave of an upright face, as of the wall of a hub, which turns to its image beyond x = 0 by 23 degrees; and the face of
        // the hub that it is glued to.
        let upright = |x: f64| {
            let at = |x, y, z| DVec3::new(x, y, z);
            [
                at(x + 0.5, 0.5, 0.0),
                at(x, 0.6, 0.0),
                at(x, 0.6, 5.0),
                at(x + 0.5, 0.5, 5.0),
            ]
        };
        let surface = Surface {
            points: [0.0, 3.0].into_iter().flat_map(upright).collect(),
            triangles: vec![[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]],
            labels: vec![1, 1, 2, 2],
        };
        let bound = [2, 1, 1, 2, 0, 0, 0, 0];
        assert_eq!(faces_between(&surface, 0.0, &bound), [1, 1]);
        let link = Link {
            pairs: (0..4).map(|v| [v, v + 4]).collect(),
            labels: vec![1, 2],
            image: std::sync::Arc::new(|p| p + DVec3::new(3.0, 0.0, 0.0)),
            back: std::sync::Arc::new(|p| p - DVec3::new(3.0, 0.0, 0.0)),
        };
        assert_eq!(faces_glued(&surface, 0.0, &bound, &[link]), [2, 0]);
    }

    #[test]
    fn a_strip_within_the_deviation_is_no_face_beside_what_is_curved() {
        // The deviation is a thousandth, and the width of a strip twice its own.
        assert_eq!(faces(&blade(8e-4, true), 0.0), [0, 3]);
        assert_eq!(faces(&blade(12e-4, true), 0.0), [1, 2]);
        assert_eq!(faces(&blade(8e-4, false), 0.0), [3, 0]);
    }

    #[test]
    fn a_face_with_shallow_folds_is_a_flat_face() {
        assert_eq!(faces(&cube(0.0), 0.0), [6, 0]);
        // Its largest triangle leans by 0.02 degrees, and the one opposite to it is 0.05 degrees off that.
        assert_eq!(faces(&cube(2e-4), 1e-3), [6, 0]);
        // Folds that are not allowed for, too high or too steep ones make it a curved one.
        for (raised, folds) in [(2e-4, 0.0), (2e-4, 1e-5), (1e-2, 0.1)] {
            assert_eq!(faces(&cube(raised), folds), [5, 1], "{raised} {folds}");
        }
    }
}
