//! Divides the feature edges, those that are images of each other alike.

use super::division::{merged, reversed, same, symmetric};
use super::maker::Maker;
use super::orbits::{Link, Orbit, links, orbits};
use glam::DVec3;
use tmesh::FixedSet;

impl Maker<'_> {
    /// Of each feature edge, whether a facet that stays has it.
    fn undivided(&self) -> Vec<bool> {
        let mut whole = vec![false; self.features.ends.len()];
        for (t, &facet) in self.guide.facets.of_triangle.iter().enumerate() {
            if self.frozen[facet as usize] {
                let [a, b, c] = self.input.triangles[t].vertices;
                for (p, q) in [(a, b), (b, c), (c, a)] {
                    if let Some((edge, _)) = self.features.find(p, q) {
                        whole[edge] = true;
                    }
                }
            }
        }
        whole
    }

    /// Divides all feature edges; the edges of an orbit get one division.
    pub fn divide_edges(&mut self) {
        let whole = self.undivided();
        let mut on_axis = vec![false; self.input.vertices.len()];
        self.input
            .axis
            .iter()
            .for_each(|&v| on_axis[v as usize] = true);
        let links = links(self.features, self.pairings);
        for orbit in orbits(self.features.ends.len(), &links) {
            let division = self.division(&orbit, &whole);
            self.divide(&orbit, &links, &division);
        }
        for link in &links {
            let from = self.chains[link.from].vertices.iter();
            let to = &self.chains[link.to].vertices;
            let pairs = &mut self.pairs[link.pairing];
            match link.reversed {
                true => pairs.extend(from.zip(to.iter().rev()).map(|(&a, &b)| [a, b])),
                false => pairs.extend(from.zip(to).map(|(&a, &b)| [a, b])),
            }
        }
        for ([a, b], chain) in self.features.ends.iter().zip(&self.chains) {
            if on_axis[*a as usize] && on_axis[*b as usize] {
                self.made.axis.extend(&chain.vertices);
                for (pairing, pairs) in self.pairings.iter().zip(&mut self.pairs) {
                    // The copies of a wedge that only touches the axis meet there.
                    if pairing.fixed() == FixedSet::Axis {
                        pairs.extend(chain.vertices.iter().map(|&v| [v, v]));
                    }
                }
            }
        }
        for (chain, points) in self.chains.iter().zip(&self.features.points) {
            if !chain.changed {
                for (&v, point) in chain.vertices.iter().zip(points) {
                    self.of_guide[point.vertex as usize] = v;
                }
            }
        }
    }

    /// The one division of the edges of an orbit, in the direction of the first: as dense as the densest everywhere.
    fn division(&mut self, orbit: &Orbit, whole: &[bool]) -> Vec<f64> {
        let own =
            |edge: usize| -> Vec<f64> { self.features.points[edge].iter().map(|p| p.t).collect() };
        let stays = orbit.members.iter().any(|m| whole[m.edge]);
        let mut division = Vec::new();
        for (i, member) in orbit.members.iter().enumerate().filter(|_| !stays) {
            let mut theirs = own(member.edge);
            if member.reversed {
                theirs = reversed(&theirs);
            }
            division = if i == 0 {
                theirs
            } else {
                merged(&division, &theirs)
            };
        }
        if orbit.folded {
            division = symmetric(&merged(&division, &reversed(&division)));
        }
        for member in &orbit.members {
            let here = match member.reversed {
                true => reversed(&division),
                false => division.clone(),
            };
            self.chains[member.edge].changed = !same(&here, &own(member.edge));
        }
        division
    }

    /// Puts vertices on the edges of an orbit: on the first by its division, on the others as images.
    fn divide(&mut self, orbit: &Orbit, links: &[Link], division: &[f64]) {
        let first = orbit.members[0].edge;
        let [p, q] = self.features.ends[first].map(|v| self.input.vertices[v as usize]);
        let onto = links.iter().filter(|l| l.from == first && l.to == first);
        let (mut fixed, mut folding) = (Vec::new(), None);
        for link in onto {
            match link.reversed {
                true => folding = Some(link.pairing),
                false => fixed.push(self.fixed(link.pairing)),
            }
        }
        let mut points: Vec<DVec3> = division
            .iter()
            .map(|&t| {
                let p = p + (q - p) * t;
                fixed.iter().fold(p, |p, set| set.nearest(p))
            })
            .collect();
        if let Some(pairing) = folding {
            // The second half is the image of the first.
            let count = points.len();
            for i in 0..count / 2 {
                points[count - 1 - i] = self.image(pairing, points[i], false);
            }
            if count % 2 == 1 {
                points[count / 2] = self.fixed(pairing).nearest(points[count / 2]);
            }
        }
        self.chains[first].vertices = points.into_iter().map(|p| self.add(p)).collect();
        for member in &orbit.members[1..] {
            let Some((link, back)) = member.by else {
                continue;
            };
            let link = links[link];
            let from = if back { link.to } else { link.from };
            let source = self.chains[from].vertices.clone();
            let mut images = Vec::with_capacity(source.len());
            for v in source {
                let p = self.image(link.pairing, self.made.vertices[v as usize], back);
                images.push(self.add(p));
            }
            if link.reversed {
                images.reverse();
            }
            self.chains[member.edge].vertices = images;
        }
    }
}
