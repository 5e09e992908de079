//! Second-order elements: a point in the middle of every edge.
//!
//! Edge points are made on the template, from its edges, and join the walls that their edges lie on.
//! Edges of paired triangles are paired, so their points are, and what welds or couples vertices
//! welds and couples them without further ado: nothing is matched by distance.

use rustc_hash::FxHashMap;
use tmesh::{Document, Gluing, Template};

/// The points in the middle of edges, by template.
#[derive(Clone, Debug, Default)]
pub struct Middles {
    /// Of each tetrahedron, in the order of [`crate::TetBlock::middles`].
    pub tets: Vec<Vec<[u32; 6]>>,
    /// Of each triangle, in the order of [`crate::TriangleBlock::middles`].
    pub triangles: Vec<Vec<[u32; 3]>>,
}

impl Middles {
    /// Edges of a tetrahedron in the order of [`crate::TetBlock::middles`].
    pub const TET_EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];
    /// Edges of a triangle in the order of [`crate::TriangleBlock::middles`].
    pub const TRIANGLE_EDGES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

    /// Middles of a tetrahedron whose vertices come in the order 0 1 3 2.
    pub fn reversed([ab, bc, ac, ad, bd, cd]: [u32; 6]) -> [u32; 6] {
        [ab, bd, ad, ac, bc, cd]
    }

    /// Middles of a triangle whose vertices come in the order 0 2 1.
    pub fn turned([ab, bc, ca]: [u32; 3]) -> [u32; 3] {
        [ca, bc, ab]
    }
}

/// Why a document cannot get points on its edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "with a point on every edge a template has more than {} points",
    u32::MAX
)]
pub struct TooManyPoints;

type Edges = FxHashMap<[u32; 2], u32>;

/// Adds a vertex in the middle of every edge of the tetrahedra and triangles, after the other
/// vertices of each template, and makes it part of the walls and the axis that its edge is on.
///
/// Edges stay straight. Linear in the templates.
///
/// # Errors
/// More vertices than ids.
pub fn second_order(mut document: Document) -> Result<(Document, Middles), TooManyPoints> {
    let mut middles = Middles::default();
    let mut edges = Vec::with_capacity(document.templates.len());
    for template in &mut document.templates {
        let mut of_edge = Edges::default();
        let mut tets = Vec::with_capacity(template.tets.len());
        for i in 0..template.tets.len() {
            let v = template.tets[i].vertices;
            let mut ids = [0; 6];
            for (id, [a, b]) in ids.iter_mut().zip(Middles::TET_EDGES) {
                *id = middle(template, &mut of_edge, v[a], v[b])?;
            }
            tets.push(ids);
        }
        let mut triangles = Vec::with_capacity(template.triangles.len());
        for i in 0..template.triangles.len() {
            let v = template.triangles[i].vertices;
            let mut ids = [0; 3];
            for (id, [a, b]) in ids.iter_mut().zip(Middles::TRIANGLE_EDGES) {
                *id = middle(template, &mut of_edge, v[a], v[b])?;
            }
            triangles.push(ids);
        }
        let on_axis = |v: u32| template.axis.binary_search(&v).is_ok();
        let mut axis: Vec<u32> = of_edge
            .iter()
            .filter(|([a, b], _)| on_axis(*a) && on_axis(*b))
            .map(|(_, &id)| id)
            .collect();
        axis.sort_unstable();
        template.axis.extend(axis);
        middles.tets.push(tets);
        middles.triangles.push(triangles);
        edges.push(of_edge);
    }
    for t in 0..document.templates.len() {
        let mut gluings = std::mem::take(&mut document.templates[t].gluings);
        for gluing in &mut gluings {
            extend(gluing, t, &mut document.templates, &middles, &edges);
        }
        document.templates[t].gluings = gluings;
    }
    Ok((document, middles))
}

fn middle(
    template: &mut Template,
    edges: &mut Edges,
    a: u32,
    b: u32,
) -> Result<u32, TooManyPoints> {
    let key = [a.min(b), a.max(b)];
    if let Some(&id) = edges.get(&key) {
        return Ok(id);
    }
    let id = u32::try_from(template.vertices.len()).map_err(|_| TooManyPoints)?;
    if id == u32::MAX {
        return Err(TooManyPoints);
    }
    let [p, q] = key.map(|v| template.vertices[v as usize]);
    template.vertices.push(0.5 * (p + q));
    edges.insert(key, id);
    Ok(id)
}

/// Makes the middles of a glued face's edges part of it.
fn extend(
    gluing: &mut Gluing,
    t: usize,
    templates: &mut [Template],
    middles: &Middles,
    edges: &[Edges],
) {
    let pairs = edge_pairs(gluing, t, templates, middles, edges);
    if gluing.is_seam(t) {
        let step = gluing.step.placed();
        let vertices = &mut templates[t].vertices;
        for &[here, there] in pairs.iter().filter(|p| p[0] != p[1]) {
            vertices[here as usize] = step.apply(vertices[there as usize]);
        }
    }
    gluing.vertex_pairs.extend(pairs);
}

/// Pairs of the middles of the edges of paired triangles, increasing in the first.
fn edge_pairs(
    gluing: &Gluing,
    from: usize,
    templates: &[Template],
    middles: &Middles,
    edges: &[Edges],
) -> Vec<[u32; 2]> {
    let to = gluing.other as usize;
    let image = |v: u32| {
        let found = gluing.vertex_pairs.binary_search_by_key(&v, |p| p[0]);
        found.ok().map(|i| gluing.vertex_pairs[i][1])
    };
    let mut pairs = Vec::new();
    for i in gluing.triangles_here() {
        let corners = templates[from].triangles[i as usize].vertices;
        for ([a, b], id) in Middles::TRIANGLE_EDGES
            .iter()
            .zip(middles.triangles[from][i as usize])
        {
            // A valid document pairs every corner.
            let (Some(p), Some(q)) = (image(corners[*a]), image(corners[*b])) else {
                continue;
            };
            if let Some(&beyond) = edges[to].get(&[p.min(q), p.max(q)]) {
                pairs.push([id, beyond]);
            }
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
