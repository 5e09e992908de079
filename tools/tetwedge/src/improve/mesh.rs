//! Tetrahedra that are replaced and vertices that are moved while the mesh is improved.

use super::quality::{Goal, Grade};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::{Template, Tet, Triangle};

/// A tetrahedron, given by the places of its corners.
pub type Corners = [u32; 4];

/// The tetrahedra around each vertex, kept up to date.
pub struct Mesh<'a> {
    /// Positions, scaled to be near one.
    pub positions: Vec<DVec3>,
    /// Six times the largest volume in a region, scaled.
    limits: &'a FxHashMap<u32, f64>,
    goal: Goal,
    tets: Vec<Tet>,
    grades: Vec<Grade>,
    /// Prefix offsets into `around`, one more than there are vertices.
    offsets: Vec<u32>,
    around: Vec<u32>,
    /// What has come instead of a part of `around`.
    changed: FxHashMap<u32, Vec<u32>>,
    /// Faces and edges inside of a region that are part of the surface.
    fixed_faces: FxHashSet<[u32; 3]>,
    fixed_edges: FxHashSet<[u32; 2]>,
}

impl<'a> Mesh<'a> {
    /// Takes over the tetrahedra of a template. Linear.
    pub fn new(
        template: &Template,
        scale: f64,
        goal: Goal,
        limits: &'a FxHashMap<u32, f64>,
    ) -> Self {
        let positions: Vec<DVec3> = template.vertices.iter().map(|&p| p * scale).collect();
        let tets = template.tets.clone();
        let mut offsets = vec![0_u32; positions.len() + 1];
        for &v in tets.iter().flat_map(|t| &t.vertices) {
            offsets[v as usize + 1] += 1;
        }
        for i in 1..offsets.len() {
            offsets[i] += offsets[i - 1];
        }
        let mut next = offsets.clone();
        let mut around = vec![0; 4 * tets.len()];
        for (i, t) in tets.iter().enumerate() {
            for &v in &t.vertices {
                around[next[v as usize] as usize] = i as u32;
                next[v as usize] += 1;
            }
        }
        let grades = tets
            .iter()
            .map(|t| goal.grade(t.vertices.map(|v| positions[v as usize])))
            .collect();
        let inner = template.triangles.iter().filter(|t| t.front == t.back);
        let fixed_faces: FxHashSet<_> = inner.map(|t: &Triangle| sorted(t.vertices)).collect();
        let fixed_edges = fixed_faces
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [a, c], [b, c]])
            .collect();
        Self {
            positions,
            limits,
            goal,
            tets,
            grades,
            offsets,
            around,
            changed: FxHashMap::default(),
            fixed_faces,
            fixed_edges,
        }
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
        match self.changed.get(&v) {
            Some(list) => list,
            None => {
                let [from, to] = [0, 1].map(|i| self.offsets[v as usize + i] as usize);
                &self.around[from..to]
            }
        }
    }

    /// Grades four points as a tetrahedron.
    pub fn of_points(&self, points: [DVec3; 4]) -> Grade {
        self.goal.grade(points)
    }

    /// Grades four vertices as a tetrahedron.
    pub fn of_corners(&self, corners: Corners) -> Grade {
        self.goal.grade(corners.map(|v| self.positions[v as usize]))
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

    /// Whether three vertices are a surface triangle inside of a region.
    pub fn is_fixed_face(&self, face: [u32; 3]) -> bool {
        !self.fixed_faces.is_empty() && self.fixed_faces.contains(&sorted(face))
    }

    /// Whether two vertices are an edge of such a triangle.
    pub fn is_fixed_edge(&self, a: u32, b: u32) -> bool {
        !self.fixed_edges.is_empty() && self.fixed_edges.contains(&[a.min(b), a.max(b)])
    }

    /// Moves a vertex; the tetrahedra at it have to be graded anew.
    pub fn put(&mut self, v: u32, p: DVec3) {
        self.positions[v as usize] = p;
    }

    /// Grades a tetrahedron anew.
    pub fn regrade(&mut self, tet: u32) {
        self.grades[tet as usize] = self.of_corners(self.corners(tet));
    }

    /// Puts other tetrahedra in the place of some of the same region.
    pub fn replace(&mut self, old: &[u32], new: &[Corners]) {
        let Some(&first) = old.first() else {
            return;
        };
        let region = self.region(first);
        for &tet in old {
            for v in self.corners(tet) {
                self.list(v).retain(|&t| t != tet);
            }
        }
        // Places that are left over are filled from the end.
        let mut gone: Vec<u32> = old.to_vec();
        gone.sort_unstable();
        for (i, &vertices) in new.iter().enumerate() {
            let place = match gone.get(i) {
                Some(&place) => place,
                None => {
                    self.tets.push(Tet { vertices, region });
                    self.grades.push(self.of_corners(vertices));
                    self.tets.len() as u32 - 1
                }
            };
            self.tets[place as usize] = Tet { vertices, region };
            self.regrade(place);
            for v in vertices {
                self.list(v).push(place);
            }
        }
        for &hole in gone.iter().skip(new.len()).rev() {
            let last = self.tets.len() as u32 - 1;
            if hole != last {
                for v in self.corners(last) {
                    for t in self.list(v).iter_mut().filter(|t| **t == last) {
                        *t = hole;
                    }
                }
            }
            self.tets.swap_remove(hole as usize);
            self.grades.swap_remove(hole as usize);
        }
    }

    fn list(&mut self, v: u32) -> &mut Vec<u32> {
        let [from, to] = [0, 1].map(|i| self.offsets[v as usize + i] as usize);
        let around = &self.around[from..to];
        self.changed.entry(v).or_insert_with(|| around.to_vec())
    }
}

fn sorted(mut t: [u32; 3]) -> [u32; 3] {
    t.sort_unstable();
    t
}
