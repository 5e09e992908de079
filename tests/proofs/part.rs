//! A document as plain arrays, and a sound one: a polar grid between two walls.

use glam::DVec3;
use std::collections::BTreeMap;

/// Stands for no region.
pub const NOTHING: u32 = 4_294_967_295;

/// `R(k/n) M^mirrored H^flipped` of section 8.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Placement {
    pub k: u32,
    pub n: u32,
    pub mirrored: bool,
    pub flipped: bool,
}

impl Placement {
    pub fn new(k: u32, n: u32, mirrored: bool, flipped: bool) -> Self {
        let common = (1..=n)
            .rev()
            .find(|d| k.is_multiple_of(*d) && n.is_multiple_of(*d));
        let common = common.expect("one divides all");
        Self {
            k: k / common % (n / common),
            n: n / common,
            mirrored,
            flipped,
        }
    }

    /// First `other`, then this one.
    pub fn times(self, other: Self) -> Self {
        let n = self.n * other.n;
        let (a, b) = (self.k * other.n, other.k * self.n);
        let k = if self.mirrored { n + a - b } else { a + b };
        Self::new(
            k % n,
            n,
            self.mirrored != other.mirrored,
            self.flipped != other.flipped,
        )
    }

    pub fn place(self, p: DVec3) -> DVec3 {
        let (c, s) = self.cosine_and_sine();
        let y = if self.mirrored { -p.y } else { p.y };
        let z = if self.flipped { -p.z } else { p.z };
        DVec3::new(c * p.x - s * y, s * p.x + c * y, z)
    }

    fn cosine_and_sine(self) -> (f64, f64) {
        let (q, r, n) = (4 * self.k / self.n, 4 * self.k % self.n, self.n);
        let octant = |r: u32| {
            let angle = std::f64::consts::FRAC_PI_2 * (f64::from(r) / f64::from(n));
            match r {
                0 => (1.0, 0.0),
                r if 3 * r == n => (0.75_f64.sqrt(), 0.5),
                _ => (libm::cos(angle), libm::sin(angle)),
            }
        };
        let (c, s) = if 2 * r == n {
            (0.5_f64.sqrt(), 0.5_f64.sqrt())
        } else if 2 * r < n {
            octant(r)
        } else {
            let (s, c) = octant(n - r);
            (c, s)
        };
        match q {
            0 => (c, s),
            1 => (-s, c),
            2 => (-c, -s),
            _ => (s, -c),
        }
    }
}

/// A triangle: vertices, front region, back region.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    pub vertices: [u32; 3],
    pub front: u32,
    pub back: u32,
}

#[derive(Clone, Debug)]
pub struct Glue {
    pub name: &'static str,
    pub step: Placement,
    pub vertices: Vec<[u32; 2]>,
    pub triangles: Vec<[u32; 2]>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walls {
    /// Two mirror walls, half of the order's turn apart.
    Mirrors,
    /// A face and its rotated image.
    Seam,
}

/// A document of one template.
#[derive(Clone, Debug)]
pub struct Part {
    pub vertices: Vec<DVec3>,
    pub triangles: Vec<Face>,
    pub tets: Vec<([u32; 4], u32)>,
    pub axis: Vec<u32>,
    pub glues: Vec<Glue>,
    pub instances: Vec<Placement>,
    /// Volume and boundary area of the body.
    pub source: Option<[f64; 2]>,
}

/// Divisions along the turn and along the axis.
const STEPS: u32 = 2;
const LAYERS: u32 = 2;

impl Part {
    /// A prism over a regular polygon of `order * STEPS` corners, or twice that between mirrors, with a hole of
    /// radius `bore`, and `rounds` materials around each other.
    pub fn new(order: u32, walls: Walls, bore: f64, rounds: u32) -> Self {
        let turns = match walls {
            Walls::Mirrors => 2 * order,
            Walls::Seam => order,
        };
        let mut grid = Grid {
            bore,
            rounds,
            turns,
            numbers: BTreeMap::new(),
            vertices: Vec::new(),
        };
        let tets = grid.tets();
        let triangles = faces(&grid.vertices, &tets);
        let mut part = Self {
            axis: (0..grid.vertices.len() as u32)
                .filter(|&v| grid.vertices[v as usize].truncate().length() == 0.0)
                .collect(),
            vertices: grid.vertices.clone(),
            triangles,
            tets,
            glues: Vec::new(),
            instances: Vec::new(),
            source: None,
        };
        part.glue(&grid, walls);
        for k in 0..order {
            part.instances.push(Placement::new(k, order, false, false));
            if walls == Walls::Mirrors {
                part.instances.push(Placement::new(k, order, true, false));
            }
        }
        // Of one corner's triangle.
        let angle = std::f64::consts::TAU / f64::from(turns * STEPS);
        let corners = f64::from(turns * STEPS);
        let (outer, inner) = (1.0, bore * bore);
        let floor = corners * 0.5 * (outer - inner) * angle.sin();
        let side = corners * 2.0 * (0.5 * angle).sin() * (1.0 + bore);
        part.source = Some([floor, 2.0 * floor + side]);
        part
    }

    fn glue(&mut self, grid: &Grid, walls: Walls) {
        let side = |j: u32| -> BTreeMap<[u32; 2], u32> {
            let on = grid
                .numbers
                .iter()
                .filter(|(p, _)| p[1] == j || grid.is_axis(p[0]));
            on.map(|(&[i, _, k], &v)| ([i, k], v)).collect()
        };
        let (low, high) = (side(0), side(STEPS));
        let on = |side: &BTreeMap<[u32; 2], u32>| -> Vec<u32> {
            let within = |f: &Face| f.vertices.iter().all(|v| side.values().any(|w| w == v));
            let all = (0..)
                .zip(&self.triangles)
                .filter(|(_, f)| f.front == NOTHING && within(f));
            all.map(|(t, _)| t).collect()
        };
        let itself = |step, name, side: &BTreeMap<[u32; 2], u32>| {
            let mut vertices: Vec<[u32; 2]> = side.values().map(|&v| [v, v]).collect();
            vertices.sort_unstable();
            Glue {
                name,
                step,
                vertices,
                triangles: on(side).into_iter().map(|t| [t, t]).collect(),
            }
        };
        self.glues = match walls {
            Walls::Mirrors => vec![
                itself(Placement::new(0, 1, true, false), "wall-a", &low),
                itself(Placement::new(2, grid.turns, true, false), "wall-b", &high),
            ],
            Walls::Seam => {
                let mut vertices: Vec<[u32; 2]> = high.iter().map(|(p, &v)| [v, low[p]]).collect();
                vertices.sort_unstable();
                let image = |v: u32| vertices.iter().find(|p| p[0] == v).expect("on the face")[1];
                let there = on(&low);
                let corners = |t: u32| {
                    let mut v = self.triangles[t as usize].vertices;
                    v.sort_unstable();
                    v
                };
                let partner = |t: u32| {
                    let mut images = self.triangles[t as usize].vertices.map(image);
                    images.sort_unstable();
                    let found = there.iter().copied().find(|&u| corners(u) == images);
                    found.expect("both faces are divided alike")
                };
                vec![Glue {
                    name: "seam",
                    step: Placement::new(1, grid.turns, false, false),
                    triangles: on(&high).into_iter().map(|t| [t, partner(t)]).collect(),
                    vertices,
                }]
            }
        };
    }
}

/// Points by their places along the radius, the turn and the axis.
struct Grid {
    bore: f64,
    rounds: u32,
    turns: u32,
    numbers: BTreeMap<[u32; 3], u32>,
    vertices: Vec<DVec3>,
}

impl Grid {
    fn is_axis(&self, i: u32) -> bool {
        i == 0 && self.bore == 0.0
    }

    fn vertex(&mut self, [i, j, k]: [u32; 3]) -> u32 {
        let key = [i, if self.is_axis(i) { 0 } else { j }, k];
        if let Some(&v) = self.numbers.get(&key) {
            return v;
        }
        let share = f64::from(i) / f64::from(self.rounds);
        let radius = self.bore * (1.0 - share) + share;
        let low = DVec3::new(radius, 0.0, f64::from(k) / f64::from(LAYERS));
        let step = Placement::new(j, self.turns * STEPS, false, false);
        let p = if self.is_axis(i) {
            low
        } else {
            step.place(low)
        };
        self.vertices.push(p);
        self.numbers.insert(key, self.vertices.len() as u32 - 1);
        self.vertices.len() as u32 - 1
    }

    /// Six tetrahedra per cell along the ways from its first corner to its last; the same in every cell, so that
    /// they fit. A material each round.
    fn tets(&mut self) -> Vec<([u32; 4], u32)> {
        let mut tets = Vec::new();
        for i in 0..self.rounds {
            for j in 0..STEPS {
                for k in 0..LAYERS {
                    for way in [
                        [0, 1, 2],
                        [0, 2, 1],
                        [1, 0, 2],
                        [1, 2, 0],
                        [2, 0, 1],
                        [2, 1, 0],
                    ] {
                        let mut at = [i, j, k];
                        let mut tet = [self.vertex(at); 4];
                        for (corner, axis) in tet[1..].iter_mut().zip(way) {
                            at[axis] += 1;
                            *corner = self.vertex(at);
                        }
                        let [a, b, c, d] = tet.map(|v| self.vertices[v as usize]);
                        if (b - a).cross(c - a).dot(d - a) < 0.0 {
                            tet.swap(2, 3);
                        }
                        // About the axis some have a corner twice.
                        if (0..4).all(|x| (0..x).all(|y| tet[x] != tet[y])) {
                            tets.push((tet, i + 1));
                        }
                    }
                }
            }
        }
        tets
    }
}

/// Faces of a tetrahedron, counter-clockwise from outside.
pub fn faces_of([a, b, c, d]: [u32; 4]) -> [[u32; 3]; 4] {
    [[a, c, b], [a, b, d], [a, d, c], [b, c, d]]
}

/// The boundary and the interfaces of tetrahedra.
fn faces(vertices: &[DVec3], tets: &[([u32; 4], u32)]) -> Vec<Face> {
    assert!(vertices.iter().all(|p| p.is_finite()));
    let mut sides: BTreeMap<[u32; 3], Vec<([u32; 3], u32)>> = BTreeMap::new();
    for (tet, region) in tets {
        for face in faces_of(*tet) {
            let mut key = face;
            key.sort_unstable();
            sides.entry(key).or_default().push((face, *region));
        }
    }
    let mut faces = Vec::new();
    for side in sides.values() {
        match side[..] {
            [(vertices, back)] => faces.push(Face {
                vertices,
                front: NOTHING,
                back,
            }),
            [(vertices, back), (_, front)] if front != back => faces.push(Face {
                vertices,
                front,
                back,
            }),
            [_, _] => {}
            _ => panic!("a face of more than two tetrahedra"),
        }
    }
    faces
}
