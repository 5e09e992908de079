//! Tetrahedra that are replaced and vertices that are moved while the mesh is improved.

use crate::near::are_near;
use crate::quality::{Goal, Grade};
use crate::stars::Stars;
use crate::surface::{Diagonal, Surface, sorted};
use geom::measure::double_area_vector;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::{Template, Tet, Triangle};

/// A tetrahedron, given by the places of its corners.
pub type Corners = [u32; 4];

/// Tetrahedra with their grades and the stars of their vertices, kept up to date.
pub struct Mesh<'a> {
    /// Positions, scaled to be near one.
    pub positions: Vec<DVec3>,
    /// Six times the largest volume in a region, scaled.
    limits: &'a FxHashMap<u32, f64>,
    goal: Goal,
    tets: Vec<Tet>,
    grades: Vec<Grade>,
    stars: Stars,
    /// Faces and edges inside of a region that are part of the surface.
    fixed_faces: FxHashSet<[u32; 3]>,
    fixed_edges: FxHashSet<[u32; 2]>,
    /// Triangles of the surface whose edges may be replaced.
    surface: Surface,
}

impl<'a> Mesh<'a> {
    /// Takes over tetrahedra between positions. Linear.
    pub fn new(
        positions: Vec<DVec3>,
        tets: Vec<Tet>,
        goal: Goal,
        limits: &'a FxHashMap<u32, f64>,
    ) -> Self {
        let grade = |t: &Tet| goal.grade(t.vertices.map(|v| positions[v as usize]));
        let (grades, stars) = rayon::join(
            || tets.iter().map(grade).collect(),
            || Stars::new(positions.len(), &tets),
        );
        Self {
            positions,
            limits,
            goal,
            tets,
            grades,
            stars,
            fixed_faces: FxHashSet::default(),
            fixed_edges: FxHashSet::default(),
            surface: Surface::default(),
        }
    }

    /// Edges of the surface may be replaced from now on.
    pub fn set_surface(&mut self, surface: Surface) {
        self.surface = surface;
    }

    /// Triangles of the surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Puts a vertex into triangles of the surface that are in one patch, or on an edge of them, between the ends of that.
    pub fn divide_surface(&mut self, faces: &[[u32; 3]], vertex: u32, edge: Option<[u32; 2]>) {
        let positions = &self.positions;
        let at = |v: u32| positions[v as usize];
        self.surface.divide(faces, vertex, edge, at);
    }

    /// Replaces an edge of the surface.
    pub fn replace_diagonal(&mut self, diagonal: Diagonal) {
        let Diagonal {
            old: [a, b],
            new: [c, d],
        } = diagonal;
        let both = self.surface.numbers_of(&[[a, b, c], [a, b, d]]);
        self.surface.replace(diagonal);
        self.share(&both);
    }

    /// The patch of a curved shape that the two triangles of the surface from an edge to each of two vertices stand for, if it is one and no
    /// feature is between them.
    pub fn patch_around(&self, [a, b]: [u32; 2], others: [u32; 2]) -> Option<u32> {
        let faces = others.map(|c| [a, b, c]);
        let [p, q] = faces.map(|face| self.surface.curved(face));
        let [m, n] = faces.map(|face| Some(self.normal(self.surface.triangle(face)?)));
        (p == q && m?.dot(n?) > self.surface.feature()).then_some(p?)
    }

    /// Unit normal of a triangle.
    fn normal(&self, face: [u32; 3]) -> DVec3 {
        let [a, b, c] = face.map(|v| self.positions[v as usize]);
        double_area_vector(a, b, c).normalize_or_zero()
    }

    /// Whether the shape allows for another diagonal between two triangles of the surface: anywhere in a flat facet; where they stand for a
    /// patch of a curved shape, if that holds both new triangles, and no feature is between them, then as before.
    pub fn may_replace(
        &self,
        Diagonal {
            old: [a, b],
            new: [c, d],
        }: Diagonal,
    ) -> bool {
        let Some(first) = self.surface.triangle([a, b, c]) else {
            return false;
        };
        if self.surface.curved(first).is_none() {
            return true;
        }
        let Some((patch, shape)) = self.patch_around([a, b], [c, d]).zip(self.surface.shape())
        else {
            return false;
        };
        // The triangle runs from one end of the edge to the other, and then to c.
        let [a, b] = match first {
            [x, y, _] | [_, x, y] | [y, _, x] if [x, y] == [a, b] => [a, b],
            _ => [b, a],
        };
        let after = [[d, c, a], [c, d, b]];
        let [m, n] = after.map(|face| self.normal(face));
        let after = after.map(|face| face.map(|v| self.positions[v as usize]));
        m.dot(n) > self.surface.feature()
            && after.iter().all(|&corners| shape.holds(patch, corners))
            && are_near(
                &self.surface.points(&[[a, b, c], [a, b, d]]),
                after.into_iter(),
            )
    }

    /// Gives the points of the shape that some triangles are near to, to those of them that they are nearest to now.
    fn share(&mut self, triangles: &[u32]) {
        let positions = &self.positions;
        let at = |v: u32| positions[v as usize];
        self.surface.share(triangles, triangles, at);
    }

    /// The same for faces.
    pub fn share_points(&mut self, faces: &[[u32; 3]]) {
        let numbers = self.surface.numbers_of(faces);
        self.share(&numbers);
    }

    /// Takes over the tetrahedra of a template, and keeps its surface inside of regions. Linear.
    pub fn of_template(
        template: &Template,
        scale: f64,
        goal: Goal,
        limits: &'a FxHashMap<u32, f64>,
    ) -> Self {
        let positions = template.vertices.iter().map(|&p| p * scale).collect();
        let mut mesh = Self::new(positions, template.tets.clone(), goal, limits);
        let inner = template.triangles.iter().filter(|t| t.front == t.back);
        mesh.fixed_faces = inner.map(|t: &Triangle| sorted(t.vertices)).collect();
        let fixed = mesh.fixed_faces.iter();
        mesh.fixed_edges = fixed
            .flat_map(|&[a, b, c]| [[a, b], [a, c], [b, c]])
            .collect();
        mesh
    }

    /// Grades all tetrahedra by another goal.
    pub fn change_goal(&mut self, goal: Goal) {
        self.goal = goal;
        self.stars.renew();
        for tet in 0..self.len() as u32 {
            self.grades[tet as usize] = self.of_corners(self.corners(tet));
        }
    }

    /// What every tetrahedron should reach.
    pub fn goal(&self) -> &Goal {
        &self.goal
    }

    /// Number of places for tetrahedra; all are taken.
    pub fn len(&self) -> usize {
        self.tets.len()
    }

    /// The tetrahedra.
    pub fn into_tets(self) -> Vec<Tet> {
        self.tets
    }

    /// Corners of a tetrahedron.
    pub fn corners(&self, tet: u32) -> Corners {
        self.tets[tet as usize].vertices
    }

    /// Region of a tetrahedron.
    pub fn region(&self, tet: u32) -> u32 {
        self.tets[tet as usize].region
    }

    /// Grade of a tetrahedron.
    pub fn grade(&self, tet: u32) -> Grade {
        self.grades[tet as usize]
    }

    /// Tetrahedra at a vertex.
    pub fn star(&self, v: u32) -> &[u32] {
        self.stars.of(v)
    }

    /// Begins a new time, for [`Self::is_touched`]: before every change.
    pub fn renew(&mut self) {
        self.stars.renew();
    }

    /// The time that it is.
    pub fn now(&self) -> u32 {
        self.stars.now()
    }

    /// Whether anything about the tetrahedra at a vertex changed after that time: which ones they are,
    /// their numbers, their corners or where these are.
    pub fn is_touched(&self, v: u32, time: u32) -> bool {
        self.stars.is_touched(v, time)
    }

    /// Grades four points as a tetrahedron.
    pub fn of_points(&self, points: [DVec3; 4]) -> Grade {
        self.goal.grade(points)
    }

    /// Grades four vertices as a tetrahedron.
    pub fn of_corners(&self, corners: Corners) -> Grade {
        let at = |v: u32| self.positions[v as usize];
        let [a, b, c, d] = corners;
        self.goal.grade([at(a), at(b), at(c), at(d)])
    }

    /// Whether a size is within the limit of a region, or below what there was before.
    pub fn fits(&self, region: u32, six_volume: f64, before: f64) -> bool {
        six_volume <= before
            || self
                .limits
                .get(&region)
                .is_none_or(|&most| six_volume <= most)
    }

    /// The quality that tetrahedra in the place of `old` must exceed, at least `least` and by the part
    /// `gain` more than the worst of them; and the largest of them, six volumes.
    pub fn bounds(&self, old: &[u32], gain: f64, least: f64) -> (f64, f64) {
        let grades = old.iter().map(|&t| self.grade(t));
        let (worst, most) = grades.fold((f64::INFINITY, 0.0_f64), |(q, v), g| {
            (q.min(g.quality), v.max(g.six_volume))
        });
        ((worst + gain * worst.abs()).max(least), most)
    }

    /// The tetrahedron on the other side of a face of one.
    pub fn beyond(&self, face: [u32; 3], inside: u32) -> Option<u32> {
        let stars = face.map(|v| self.star(v));
        let fewest = stars.into_iter().min_by_key(|star| star.len())?;
        fewest.iter().copied().find(|&t| {
            let corners = self.corners(t);
            t != inside && face.iter().all(|v| corners.contains(v))
        })
    }

    /// The number of a tetrahedron.
    pub fn number(&self, corners: Corners) -> Option<u32> {
        let at = self.star(corners[0]).iter().copied();
        at.into_iter().find(|&t| self.corners(t) == corners)
    }

    /// Whether three vertices are a surface triangle inside of a region.
    pub fn is_fixed_face(&self, face: [u32; 3]) -> bool {
        !self.fixed_faces.is_empty() && self.fixed_faces.contains(&sorted(face))
    }

    /// Whether two vertices are an edge of such a triangle.
    pub fn is_fixed_edge(&self, a: u32, b: u32) -> bool {
        !self.fixed_edges.is_empty() && self.fixed_edges.contains(&[a.min(b), a.max(b)])
    }

    /// Adds a vertex that is at no tetrahedron yet; returns its number.
    pub fn add(&mut self, p: DVec3) -> u32 {
        self.positions.push(p);
        self.stars.add();
        self.positions.len() as u32 - 1
    }

    /// Moves a vertex; the tetrahedra at it need their new grades.
    pub fn put(&mut self, v: u32, p: DVec3) {
        self.positions[v as usize] = p;
    }

    /// Gives a tetrahedron with a moved corner its new grade.
    pub fn regrade(&mut self, tet: u32, grade: Grade) {
        self.grades[tet as usize] = grade;
        let corners = self.corners(tet);
        corners.into_iter().for_each(|v| self.stars.touch(v));
    }

    /// Puts other tetrahedra in the place of some of the same region, with their grades.
    pub fn replace(&mut self, old: &[u32], new: &[(Corners, Grade)]) {
        let Some(&first) = old.first() else {
            return;
        };
        let region = self.region(first);
        for &tet in old {
            for v in self.corners(tet) {
                self.stars.remove(v, tet);
            }
        }
        // Places that are left over are filled from the end.
        let mut gone: Vec<u32> = old.to_vec();
        gone.sort_unstable();
        for (i, &(vertices, grade)) in new.iter().enumerate() {
            let tet = Tet { vertices, region };
            let place = match gone.get(i) {
                Some(&place) => {
                    self.tets[place as usize] = tet;
                    self.grades[place as usize] = grade;
                    place
                }
                None => {
                    self.tets.push(tet);
                    self.grades.push(grade);
                    self.tets.len() as u32 - 1
                }
            };
            for v in vertices {
                self.stars.push(v, place);
            }
        }
        for &hole in gone.iter().skip(new.len()).rev() {
            let last = self.tets.len() as u32 - 1;
            if hole != last {
                for v in self.corners(last) {
                    self.stars.rename(v, last, hole);
                }
            }
            self.tets.swap_remove(hole as usize);
            self.grades.swap_remove(hole as usize);
        }
    }
}
