//! Files as they should not be: triangles of a sound file, spoilt at random in the ways that files are.

use bodies::Dice;
use glam::DVec3;
use interchange::parsed::{Faces, Parsed, Soup};
use interchange::{parse, sniff};
use std::collections::HashMap;
use std::fmt::Write as _;
use std::io;
use std::path::Path;

/// A triangle and the solid it belongs to.
#[derive(Clone, Copy)]
struct Facet {
    corners: [DVec3; 3],
    solid: usize,
}

/// The triangles of a file.
pub struct Spoilt {
    facets: Vec<Facet>,
    solids: Vec<String>,
    /// Diagonal of the box of all that is finite.
    size: f64,
    dice: Dice,
}

/// What it is called, and what it does.
type Way = (&'static str, fn(&mut Spoilt));

/// What may happen to a file.
const WAYS: [Way; 13] = [
    ("missing", Spoilt::missing),
    ("twice", Spoilt::twice),
    ("turned over", Spoilt::turned_over),
    ("stray", Spoilt::stray),
    ("a vertex off", Spoilt::vertex_off),
    ("noise", Spoilt::noise),
    ("torn", Spoilt::torn),
    ("flattened", Spoilt::flattened),
    ("one side divided", Spoilt::one_side_divided),
    ("rounded", Spoilt::rounded),
    ("a copy beside", Spoilt::copy_beside),
    ("a part cut off", Spoilt::part_cut_off),
    ("not finite", Spoilt::not_finite),
];

impl Spoilt {
    /// The triangles of a file that holds solids as triangles, in any format that does.
    ///
    /// # Errors
    /// Fails when the file cannot be read or holds something else.
    pub fn of(path: &Path, seed: u64) -> io::Result<Self> {
        let wrong = |what: &str| io::Error::other(format!("{}: {what}", path.display()));
        let bytes = std::fs::read(path)?;
        let format = sniff(&bytes, Some(path)).ok_or_else(|| wrong("an unknown format"))?;
        let parsed = parse(&bytes, format).map_err(|e| wrong(&e.to_string()))?;
        let Parsed::Soup(soup) = parsed else {
            return Err(wrong("no list of triangles"));
        };
        let Faces::Triangles(triangles) = &soup.faces else {
            return Err(wrong("polygons, not triangles"));
        };
        let facets = triangles.iter().enumerate().map(|(i, t)| Facet {
            corners: t.map(|v| soup.points[v as usize]),
            solid: soup.group_of.get(i).map_or(0, |&g| g as usize),
        });
        let facets: Vec<Facet> = facets.collect();
        let corners = || facets.iter().flat_map(|f| f.corners);
        let low = corners().fold(DVec3::INFINITY, DVec3::min);
        let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        Ok(Self {
            solids: names(&soup),
            size: low.distance(high),
            facets,
            dice: Dice::new(seed),
        })
    }

    /// Spoils the triangles in one or two ways, and says in which.
    pub fn spoil(&mut self) -> String {
        let count = self.dice.integer(1, 2);
        let mut said = Vec::new();
        for _ in 0..count {
            let (name, way) = self.dice.pick(&WAYS);
            if !self.facets.is_empty() {
                way(self);
                said.push(name);
            }
        }
        said.join(", ")
    }

    /// The triangles as ASCII STL, a solid per group.
    pub fn stl(&self) -> String {
        let mut text = String::new();
        for (solid, name) in self.solids.iter().enumerate() {
            let _ = writeln!(text, "solid {name}");
            for facet in self.facets.iter().filter(|f| f.solid == solid) {
                text.push_str("facet normal 0 0 0\nouter loop\n");
                for p in facet.corners {
                    let _ = writeln!(text, "vertex {:e} {:e} {:e}", p.x, p.y, p.z);
                }
                text.push_str("endloop\nendfacet\n");
            }
            let _ = writeln!(text, "endsolid {name}");
        }
        text
    }

    fn facet(&mut self) -> Facet {
        let i = self.any();
        self.facets[i]
    }

    fn any(&mut self) -> usize {
        self.dice.below(self.facets.len())
    }

    /// A length, from what rounding explains to what any eye sees.
    fn length(&mut self) -> f64 {
        self.size * self.dice.log_between(1e-9, 0.03)
    }

    fn step(&mut self) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| self.dice.signed()))
    }

    /// How many triangles one way concerns: mostly few.
    fn few(&mut self) -> usize {
        let most = (self.facets.len() as f64 / 30.0).max(3.0);
        self.dice.log_between(1.0, most) as usize
    }

    fn missing(&mut self) {
        for _ in 0..self.few().min(self.facets.len() - 1) {
            let gone = self.any();
            self.facets.swap_remove(gone);
        }
    }

    fn twice(&mut self) {
        for _ in 0..self.few() {
            let mut again = self.facet();
            if self.dice.chance(0.5) {
                again.corners.swap(0, 1);
            }
            self.facets.push(again);
        }
    }

    fn turned_over(&mut self) {
        for _ in 0..self.few() {
            let i = self.any();
            self.facets[i].corners.swap(0, 1);
        }
    }

    fn stray(&mut self) {
        for _ in 0..self.dice.integer(1, 4) {
            let Facet { corners, solid } = self.facet();
            let length = self.length();
            let corners = corners.map(|p| p + length * self.step());
            self.facets.push(Facet { corners, solid });
        }
    }

    /// Every corner at one point moves alike.
    fn vertex_off(&mut self) {
        let facet = self.any();
        let corner = self.dice.below(3);
        let from = self.facets[facet].corners[corner];
        let to = from + self.length() * self.step();
        for p in self.facets.iter_mut().flat_map(|f| &mut f.corners) {
            if *p == from {
                *p = to;
            }
        }
    }

    /// Every point moves, corners at one point alike.
    fn noise(&mut self) {
        let most = self.length();
        let mut moved: HashMap<[u64; 3], DVec3> = HashMap::new();
        for i in 0..self.facets.len() {
            for corner in 0..3 {
                let from = self.facets[i].corners[corner];
                let bits = from.to_array().map(f64::to_bits);
                let by = *moved.entry(bits).or_insert_with(|| self.step());
                self.facets[i].corners[corner] = from + most * by;
            }
        }
    }

    /// Corners move away from those they were at.
    fn torn(&mut self) {
        let most = self.length();
        for _ in 0..self.few() {
            let (facet, corner) = (self.any(), self.dice.below(3));
            let by = most * self.step();
            self.facets[facet].corners[corner] += by;
        }
    }

    fn flattened(&mut self) {
        for _ in 0..self.few() {
            let i = self.any();
            let [a, b, _] = self.facets[i].corners;
            let t = self.dice.between(0.0, 1.0);
            self.facets[i].corners[2] = a.lerp(b, t);
        }
    }

    /// A triangle is divided at its edge, its neighbour is not.
    fn one_side_divided(&mut self) {
        for _ in 0..self.few() {
            let i = self.any();
            let Facet { corners, solid } = self.facets[i];
            let [a, b, c] = corners;
            let middle = a.lerp(b, self.dice.between(0.0, 1.0));
            self.facets[i].corners = [a, middle, c];
            let corners = [middle, b, c];
            self.facets.push(Facet { corners, solid });
        }
    }

    fn rounded(&mut self) {
        let step = self.size * libm::pow(10.0, -(self.dice.integer(1, 7) as f64));
        for p in self.facets.iter_mut().flat_map(|f| &mut f.corners) {
            *p = (*p / step).round() * step;
        }
    }

    fn copy_beside(&mut self) {
        let by = self.length() * self.step();
        let count = self.few().max(self.facets.len() / 2);
        for i in 0..count.min(self.facets.len()) {
            let Facet { corners, solid } = self.facets[i];
            let corners = corners.map(|p| p + by);
            self.facets.push(Facet { corners, solid });
        }
    }

    /// What is beyond a plane is missing.
    fn part_cut_off(&mut self) {
        let through = self.facet().corners[0];
        let normal = self.step();
        let is_beyond = |f: &Facet| f.corners.iter().any(|p| (p - through).dot(normal) > 0.0);
        self.facets.retain(|f| !is_beyond(f));
    }

    fn not_finite(&mut self) {
        let facet = self.any();
        let (corner, axis) = (self.dice.below(3), self.dice.below(3));
        let value = self.dice.pick(&[f64::NAN, f64::INFINITY, -1e300, 1e-310]);
        self.facets[facet].corners[corner][axis] = value;
    }
}

/// The names of the groups, one at least.
fn names(soup: &Soup) -> Vec<String> {
    let count = soup.group_of.iter().max().map_or(1, |&g| g as usize + 1);
    let name = |i: usize| match soup.groups.get(i) {
        Some(group) if !group.name.is_empty() => group.name.clone(),
        _ => format!("solid-{i}"),
    };
    (0..count.max(soup.groups.len())).map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use bodies::{Encoding, cube};

    #[test]
    fn every_way_spoils_a_cube() {
        let folder = std::env::temp_dir().join(format!("spoilt-{}", std::process::id()));
        let body = cube(1.0, bodies::Tessellation::Symmetric);
        let mut bytes = Vec::new();
        bodies::write(&body, Encoding::StlAscii { digits: None }, &mut bytes)
            .expect("a vector takes all");
        std::fs::write(&folder, bytes).expect("room on the disk");
        for (name, way) in WAYS {
            let sound = Spoilt::of(&folder, 1).expect("it is a cube");
            let mut spoilt = Spoilt::of(&folder, 1).expect("it is a cube");
            assert!(sound.facets.len() >= 12);
            way(&mut spoilt);
            assert_ne!(sound.stl(), spoilt.stl(), "{name}");
        }
        std::fs::remove_file(&folder).expect("it was there");
    }
}
