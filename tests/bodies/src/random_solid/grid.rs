//! A grid of cells around an axis: rings by sectors by levels, a complex on which groups act by
//! permutation, so that what is made of its cells has a known group.

use super::group::Motion;
use crate::Dice;
use glam::DVec3;
use std::collections::HashMap;

/// Numbers of cells, and what the cells meet in.
pub struct Grid {
    /// Cells from the axis, or the bore, outwards.
    pub rings: usize,
    /// Cells around the axis, at least 3.
    pub sectors: usize,
    /// Cells along the axis.
    pub levels: usize,
    /// Whether the innermost nodes form a ring of their own rather than lie on the axis.
    pub bored: bool,
}

/// A node: ring, sector, level.
pub type Node = [usize; 3];

/// How a face between cells is split into triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    /// Along the diagonal from the first to the third corner.
    First,
    /// Along the other one.
    Second,
    /// At its middle, into four.
    Middle,
}

/// A face between two cells, or of one.
pub struct Face {
    /// Node ids, counter-clockwise seen from the front; the second is the third at the axis, where
    /// faces are triangles.
    pub corners: [usize; 4],
    pub front: Option<usize>,
    pub back: Option<usize>,
    pub split: Split,
}

impl Grid {
    pub fn node_count(&self) -> usize {
        (self.rings + 1) * self.sectors * (self.levels + 1)
    }

    pub fn cell_count(&self) -> usize {
        self.rings * self.sectors * self.levels
    }

    /// Id of a node; one for all sectors on the axis.
    pub fn node(&self, [i, k, j]: Node) -> usize {
        let k = if i == 0 && !self.bored {
            0
        } else {
            k % self.sectors
        };
        (j * (self.rings + 1) + i) * self.sectors + k
    }

    /// Ring, sector and level of a node's id.
    pub fn node_place(&self, id: usize) -> Node {
        let (row, k) = (id / self.sectors, id % self.sectors);
        [row % (self.rings + 1), k, row / (self.rings + 1)]
    }

    /// Id of a cell.
    pub fn cell(&self, [i, k, j]: Node) -> usize {
        (j * self.rings + i) * self.sectors + k % self.sectors
    }

    /// Ring, sector and level of a cell's id.
    pub fn cell_place(&self, id: usize) -> Node {
        let (row, k) = (id / self.sectors, id % self.sectors);
        [row % self.rings, k, row / self.rings]
    }

    pub fn node_image(&self, id: usize, motion: Motion) -> usize {
        let [i, k, j] = self.node_place(id);
        self.node([
            i,
            motion.node_sector(k, self.sectors),
            motion.level(j, self.levels + 1),
        ])
    }

    pub fn cell_image(&self, id: usize, motion: Motion) -> usize {
        let [i, k, j] = self.cell_place(id);
        self.cell([
            i,
            motion.cell_sector(k, self.sectors),
            motion.level(j, self.levels),
        ])
    }

    /// All faces, split the same way within each orbit of the group.
    pub fn faces(&self, motions: &[Motion], middles: f64, dice: &mut Dice) -> Vec<Face> {
        let mut faces = self.unsplit();
        let key = |corners: [usize; 4]| {
            let mut key = corners;
            key.sort_unstable();
            key
        };
        let index: HashMap<[usize; 4], usize> = faces
            .iter()
            .enumerate()
            .map(|(f, face)| (key(face.corners), f))
            .collect();
        let mut done = vec![false; faces.len()];
        for f in 0..faces.len() {
            if done[f] {
                continue;
            }
            let first = dice.chance(0.5);
            let corners = faces[f].corners;
            let mut images = Vec::with_capacity(motions.len());
            for &motion in motions {
                let image = corners.map(|n| self.node_image(n, motion));
                let g = index[&key(image)];
                let place = faces[g].corners.iter().position(|&n| n == image[0]);
                let odd = place.is_some_and(|p| p % 2 == 1);
                let split = if first != odd {
                    Split::First
                } else {
                    Split::Second
                };
                images.push((g, split));
            }
            // A mirror through the face takes its diagonals to each other.
            let torn = images
                .iter()
                .any(|&(g, split)| g == f && split != images[0].1);
            let middle = torn || dice.chance(middles);
            for (g, split) in images {
                done[g] = true;
                faces[g].split = if middle { Split::Middle } else { split };
            }
        }
        faces
    }

    /// Whether a turn by `shift` sectors maps the splits of the faces onto themselves.
    pub fn split_alike(&self, faces: &[Face], shift: usize) -> bool {
        // Within a row of sectors, faces follow each other in the order in which they were made.
        let (sides, ends) = (2 * self.rings + usize::from(self.bored), self.rings);
        let first_end = self.levels * self.sectors * sides;
        (0..faces.len()).all(|f| {
            let (start, row) = if f < first_end {
                (0, sides)
            } else {
                (first_end, ends)
            };
            let (line, place) = ((f - start) / row, (f - start) % row);
            let (level, k) = (line / self.sectors, line % self.sectors);
            let turned = start + (level * self.sectors + (k + shift) % self.sectors) * row + place;
            faces[f].split == faces[turned].split
        })
    }

    fn unsplit(&self) -> Vec<Face> {
        let mut faces = Vec::new();
        let mut add = |corners: [Node; 4], back: Option<Node>, front: Option<Node>| {
            faces.push(Face {
                corners: corners.map(|n| self.node(n)),
                front: front.map(|c| self.cell(c)),
                back: back.map(|c| self.cell(c)),
                split: Split::First,
            });
        };
        for j in 0..self.levels {
            for k in 0..self.sectors {
                for i in 0..=self.rings {
                    if i > 0 || self.bored {
                        add(
                            [[i, k, j], [i, k + 1, j], [i, k + 1, j + 1], [i, k, j + 1]],
                            (i > 0).then(|| [i - 1, k, j]),
                            (i < self.rings).then_some([i, k, j]),
                        );
                    }
                }
                for i in 0..self.rings {
                    add(
                        [[i, k, j], [i, k, j + 1], [i + 1, k, j + 1], [i + 1, k, j]],
                        Some([i, k + self.sectors - 1, j]),
                        Some([i, k, j]),
                    );
                }
            }
        }
        for j in 0..=self.levels {
            for k in 0..self.sectors {
                for i in 0..self.rings {
                    // On the axis the first and the last corner are one.
                    add(
                        [[i, k, j], [i + 1, k, j], [i + 1, k + 1, j], [i, k + 1, j]],
                        (j > 0).then(|| [i, k, j - 1]),
                        (j < self.levels).then_some([i, k, j]),
                    );
                }
            }
        }
        faces
    }

    /// The triangles of a face, counter-clockwise from the front. `middle` gives the id of the point in
    /// the middle of its corners.
    pub fn triangles(&self, face: &Face, middle: impl FnOnce() -> usize) -> Vec<[usize; 3]> {
        let [a, b, c, d] = face.corners;
        if a == d {
            return vec![[a, b, c]];
        }
        match face.split {
            Split::First => vec![[a, b, c], [a, c, d]],
            Split::Second => vec![[a, b, d], [b, c, d]],
            Split::Middle => {
                let m = middle();
                vec![[a, b, m], [b, c, m], [c, d, m], [d, a, m]]
            }
        }
    }

    /// Middles of the cells: means of their corners.
    pub fn middles(&self, places: &[DVec3]) -> Vec<DVec3> {
        (0..self.cell_count())
            .map(|cell| {
                let [i, k, j] = self.cell_place(cell);
                let mut sum = DVec3::ZERO;
                for corner in 0..8 {
                    let [x, y, z] = [corner & 1, corner >> 1 & 1, corner >> 2];
                    sum += places[self.node([i + x, k + y, j + z])];
                }
                sum / 8.0
            })
            .collect()
    }

    /// Least distance of the middle of each cell from the planes of its triangles, negative where
    /// the middle does not see a triangle from inside. With all of them positive, the cells are star-shaped and
    /// their faces do not cross.
    pub fn clearances(&self, faces: &[Face], places: &[DVec3]) -> Vec<f64> {
        let middles = self.middles(places);
        let mut clearances = vec![f64::INFINITY; self.cell_count()];
        for face in faces {
            let corners = face.corners.map(|n| places[n]);
            let middle = corners.iter().sum::<DVec3>() / 4.0;
            let at = |n: usize| if n == usize::MAX { middle } else { places[n] };
            for triangle in self.triangles(face, || usize::MAX) {
                let [a, b, c] = triangle.map(at);
                let normal = (b - a).cross(c - a).normalize_or_zero();
                let sides = [(face.back, 1.0), (face.front, -1.0)];
                for (cell, sign) in sides {
                    if let Some(cell) = cell {
                        let clearance = sign * normal.dot(a - middles[cell]);
                        clearances[cell] = clearances[cell].min(clearance);
                    }
                }
            }
        }
        clearances
    }
}
