//! The solids with interfaces that are drawn once.

use super::faces::Faces;
use super::redivide::redivided;
use super::regions::{Matches, Regions};
use super::rims::Rims;
use super::skin::{Behind, Skin};
use super::touch::{Facets, Touches};
use crate::imprint::{Complex, Curves, Spot};
use crate::soup::Surface;
use geom::edges::Edges;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// Solids that have the same facets where curved faces of them touch.
pub struct Drawn {
    /// The solids.
    pub surface: Surface,
    /// How far facets are from those that took their place, and edges from vertices put on them, model units.
    pub largest: f64,
    /// The pairs of solids that have the same facets, the lower one first.
    pub pairs: FxHashSet<[u32; 2]>,
}

/// Makes the facets of curved faces that touch those of one solid, where the contact ends at sharp edges of either; `None` where
/// there are none. `complex` has the flat faces of the surface; a contact is what is within the gap or, without one, what
/// facets explain. Linear, but for the search for what is near.
pub fn draw_once(
    surface: &Surface,
    complex: &Complex,
    equal: f64,
    gap: Option<f64>,
) -> Option<Drawn> {
    let edges = Edges::new(&surface.triangles);
    let curves = Curves::new(complex, &edges, &surface.solid, gap);
    let faces = Faces::new(surface, &edges, &curves, equal);
    let facets = Facets {
        complex,
        edges: &edges,
        edge: &faces.edge,
        curves: &curves,
        shortest: &shortest(&edges, &surface.points),
        rims: &Rims::new(&edges, &curves, &surface.solid),
        solid: &surface.solid,
        is_curved: &faces.is_curved,
        equal,
    };
    let mut touches = facets.touches()?;
    // What is imprinted where nothing matches then is left out the next time.
    loop {
        let mut drawing = Drawing::new(surface, facets, &faces.stays, touches)?;
        let chains = drawing.divide_edges();
        drawing.insert();
        drawing.recover(&chains);
        let matches = Regions {
            facets,
            touches: &drawing.touches,
            skin: &drawing.skin,
        }
        .matches();
        if !drawing.touches.keep(&matches.pairs) {
            return drawing.end(matches);
        }
        touches = drawing.touches;
    }
}

/// The shortest edge at each vertex.
fn shortest(edges: &Edges, points: &[DVec3]) -> Vec<f64> {
    let mut shortest = vec![f64::INFINITY; points.len()];
    for ends in &edges.ends {
        let [a, b] = ends.map(|v| points[v as usize]);
        for v in ends {
            let known = &mut shortest[*v as usize];
            *known = known.min(a.distance(b));
        }
    }
    shortest
}

/// Vertices along sharp edges of solids: edge, solid, and all vertices from the lower end to the higher one.
type Chains = Vec<(u32, u32, Vec<u32>)>;

struct Drawing<'a> {
    surface: &'a Surface,
    facets: Facets<'a>,
    touches: Touches,
    skin: Skin,
    /// What each vertex has become.
    id: Vec<u32>,
    /// Vertices that were put into solids.
    added: Vec<[u32; 2]>,
    /// Flat faces whose border was moved.
    moved: FxHashSet<u32>,
    largest: f64,
}

impl<'a> Drawing<'a> {
    fn new(
        surface: &'a Surface,
        facets: Facets<'a>,
        stays: &[[bool; 3]],
        mut touches: Touches,
    ) -> Option<Self> {
        if touches.of.is_empty() {
            return None;
        }
        let id: Vec<u32> = (0..surface.points.len() as u32)
            .map(|v| touches.same.find(v))
            .collect();
        let corners: Vec<[u32; 3]> = surface
            .triangles
            .iter()
            .map(|t| t.map(|v| id[v as usize]))
            .collect();
        if corners.iter().any(|[a, b, c]| a == b || b == c || c == a) {
            return None;
        }
        touches.renumber(&id, &corners, &surface.solid);
        let skin = Skin::new(
            surface.points.clone(),
            corners,
            surface.solid.clone(),
            |t| {
                let patch = &facets.curves.patches[t as usize];
                Behind {
                    stays: stays[t as usize],
                    normals: patch.means,
                    sagitta: patch.sagitta,
                }
            },
        );
        Some(Self {
            surface,
            facets,
            touches,
            skin,
            id,
            added: Vec::new(),
            moved: FxHashSet::default(),
            largest: 0.0,
        })
    }

    /// Divides sharp edges at vertices of other solids on them and where sharp edges of both cross.
    fn divide_edges(&mut self) -> Chains {
        let facets = self.facets;
        let mut on: FxHashMap<[u32; 2], Vec<(f64, u32)>> = FxHashMap::default();
        for (&[v, solid], touch) in &self.touches.of {
            if let Spot::Edge(i, along) = touch.at
                && !self.skin.has(v, solid)
            {
                let t = touch.triangle as usize;
                let e = facets.edge[t][i];
                let start = facets.complex.triangles[t][i];
                let forward = facets.edges.ends[e as usize][0] == start;
                let along = if forward { along } else { 1.0 - along };
                on.entry([e, solid]).or_default().push((along, v));
            }
        }
        for crossed in &self.touches.crossed {
            let v = self.skin.points.len() as u32;
            self.skin.points.push(crossed.place);
            for k in 0..2 {
                let key = [crossed.edges[k], crossed.solids[k]];
                on.entry(key).or_default().push((crossed.along[k], v));
            }
        }
        let mut chains = Chains::new();
        for e in 0..facets.edges.len() as u32 {
            let mut solids: Vec<u32> = Vec::new();
            for u in facets.edges.around(e as usize) {
                let patch = &facets.curves.patches[u.triangle as usize];
                let solid = facets.solid[u.triangle as usize];
                if !patch.smooth[u.corner as usize] && !solids.contains(&solid) {
                    solids.push(solid);
                }
            }
            for solid in solids {
                let on = on.remove(&[e, solid]).unwrap_or_default();
                let chain = self.divide_edge(e, solid, on);
                chains.push((e, solid, chain));
            }
        }
        chains
    }

    fn divide_edge(&mut self, e: u32, solid: u32, mut on: Vec<(f64, u32)>) -> Vec<u32> {
        let facets = self.facets;
        let ends = facets.edges.ends[e as usize];
        let [from, to] = ends.map(|v| self.skin.points[v as usize]);
        let [a, b] = ends.map(|v| self.id[v as usize]);
        on.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
        let mut chain = vec![a];
        for (_, v) in on {
            let last = chain[chain.len() - 1];
            if !self.skin.divide_edge(last, b, solid, v) {
                continue;
            }
            chain.push(v);
            self.added.push([v, solid]);
            if let Some(touch) = self.touches.of.get(&[v, solid])
                && !facets.rims.has(v, touch.of)
            {
                self.skin.points[v as usize] -= touch.sideways;
                self.largest = self.largest.max(touch.sideways.length());
            }
            let off = (self.skin.points[v as usize] - from)
                .reject_from(to - from)
                .length();
            if off > facets.equal {
                self.largest = self.largest.max(off);
                for u in facets.edges.around(e as usize) {
                    if facets.solid[u.triangle as usize] == solid
                        && !facets.is_curved[u.triangle as usize]
                    {
                        self.moved.insert(facets.complex.face[u.triangle as usize]);
                    }
                }
            }
        }
        chain.push(b);
        chain
    }

    /// Puts vertices of sharp edges into the smooth faces that they touch.
    fn insert(&mut self) {
        let mut all: Vec<[u32; 2]> = self.touches.of.keys().copied().collect();
        all.sort_unstable();
        for key in all {
            let [v, solid] = key;
            let touch = self.touches.of[&key];
            let is_feature = self.facets.rims.has(v, touch.of);
            if touch.at != Spot::Inside || !is_feature || self.skin.has(v, solid) {
                continue;
            }
            if self.skin.insert(v, touch.triangle, self.facets.equal) {
                self.added.push(key);
                self.largest = self.largest.max(touch.height);
            }
        }
    }

    /// Makes parts of sharp edges edges of the other solids that have both ends.
    fn recover(&mut self, chains: &Chains) {
        let mut solids: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for (corners, &solid) in self.skin.corners.iter().zip(&self.skin.solid) {
            for &v in corners {
                let of = solids.entry(v).or_default();
                if !of.contains(&solid) {
                    of.push(solid);
                }
            }
        }
        for (_, solid, chain) in chains {
            for pair in chain.windows(2) {
                let [a, b] = [pair[0], pair[1]];
                let (Some(of_a), Some(of_b)) = (solids.get(&a), solids.get(&b)) else {
                    continue;
                };
                let mut others: Vec<u32> =
                    of_a.iter().filter(|s| of_b.contains(s)).copied().collect();
                others.retain(|s| s != solid);
                others.sort_unstable();
                for other in others {
                    self.skin.recover(a, b, other);
                }
            }
        }
        self.skin.settle(&self.added, self.facets.equal);
    }

    /// The solids with what was matched.
    fn end(self, matches: Matches) -> Option<Drawn> {
        let surface = self.surface;
        let group = |t: u32| surface.group[self.skin.origin[t as usize] as usize];
        let mut is_dropped = vec![false; self.skin.corners.len()];
        let mut added = Vec::new();
        let mut largest = self.largest;
        for found in &matches.all {
            let like = found.dropped[0];
            if found.dropped.iter().any(|&t| group(t) != group(like)) {
                continue;
            }
            found
                .dropped
                .iter()
                .for_each(|&t| is_dropped[t as usize] = true);
            for &t in &found.kept {
                let [a, b, c] = self.skin.corners[t as usize];
                added.push(([a, c, b], self.skin.origin[like as usize]));
            }
            for (facets, other) in [(&found.kept, like), (&found.dropped, found.kept[0])] {
                let other = self.skin.solid[other as usize];
                let ids = facets.iter().flat_map(|&t| self.skin.corners[t as usize]);
                let touch = ids.filter_map(|v| self.touches.of.get(&[v, other]));
                largest = touch.map(|t| t.height).fold(largest, f64::max);
            }
        }
        if added.is_empty() {
            return None;
        }
        let face = &self.facets.complex.face;
        let divided = redivided(&self.skin, face, &self.moved)?;
        let mut triangles: Vec<([u32; 3], u32)> = Vec::new();
        let mut done: FxHashSet<u32> = FxHashSet::default();
        for (t, corners) in self.skin.corners.iter().enumerate() {
            let origin = self.skin.origin[t];
            match divided.get(&face[origin as usize]) {
                _ if is_dropped[t] => {}
                None => triangles.push((*corners, origin)),
                Some(new) => {
                    if done.insert(face[origin as usize]) {
                        triangles.extend(new.iter().map(|c| (*c, origin)));
                    }
                }
            }
        }
        triangles.append(&mut added);
        let of =
            |list: &[u32]| -> Vec<u32> { triangles.iter().map(|t| list[t.1 as usize]).collect() };
        let made = Surface {
            points: self.skin.points,
            group: of(&surface.group),
            solid: of(&surface.solid),
            partner: of(&surface.partner),
            source: of(&surface.source),
            triangles: triangles.iter().map(|t| t.0).collect(),
            groups: surface.groups.clone(),
            solids: surface.solids.clone(),
            group_word: surface.group_word,
        };
        Some(Drawn {
            surface: made,
            largest,
            pairs: matches.pairs,
        })
    }
}
