//! The shape of the whole body, from the facets of its wedge.

use crate::numbering::{Numbering, NumberingError};
use glam::DVec3;
use remesh::{Drawing, Reading, Redrawn, Sheets, SmoothShape};
use rustc_hash::FxHashMap;
use tmesh::{Document, Instance, Isometry};

/// The surface of a template: its boundary and the interfaces between regions, without what is glued.
struct Skin {
    /// Indices of triangles.
    triangles: Vec<u32>,
    /// Their vertices.
    corners: Vec<[u32; 3]>,
}

/// Where the surface of a template is on that of the body.
pub struct Placed {
    /// Facets of the body that a triangle of the template is on, by its index; nothing for triangles of glued faces.
    facets: FxHashMap<u32, u32>,
    /// These sets of facets.
    sets: Vec<Vec<u32>>,
    isometry: Isometry,
}

/// The surface of all copies, as facets between their corners, and the shape behind it.
pub struct Body {
    shape: SmoothShape,
    placed: Vec<Placed>,
}

/// What holds for a point of the surface.
pub enum Place {
    /// It is on a curved face, this far from the shape.
    Curved(DVec3),
    /// It is on flat faces with these unit normals.
    Flat(Vec<DVec3>),
}

impl Body {
    /// Of a document with these copies; `None` where the shape is that of the facets. Memory and time n log n in the facets
    /// of the body, and in the surface of the wedge, whatever that was divided into.
    ///
    /// # Errors
    /// See [`Numbering::new`].
    pub fn new(
        document: &Document,
        whole: &Document,
        reading: Reading,
    ) -> Result<Option<Self>, NumberingError> {
        let skins = skins(document);
        let sheets: Vec<Sheets<'_>> = (document.templates.iter().zip(&skins))
            .map(|(t, skin)| Sheets::new(&t.vertices, &skin.corners, reading))
            .collect();
        let mut drawings: Vec<Drawing> = sheets.iter().map(|s| Drawing::new(s, reading)).collect();
        let redrawn = loop {
            agree(document, &mut drawings);
            let redrawn: Vec<Redrawn> = (drawings.iter_mut().zip(&sheets))
                .map(|(drawing, sheets)| drawing.redraw(sheets))
                .collect();
            if !agree(document, &mut drawings) {
                break redrawn;
            }
        };
        let Copied {
            points,
            triangles,
            first,
        } = copied(document, whole, &redrawn)?;
        let shape = SmoothShape::new(&points, &triangles, reading);
        if shape.is_drawn() {
            return Ok(None);
        }
        let placed = (0..document.templates.len()).map(|t| {
            let (start, isometry) = first[t];
            let mut sets = vec![Vec::new(); drawings[t].planes.len()];
            for (i, &facet) in (start..).zip(&redrawn[t].facet) {
                sets[facet as usize].push(shape.facet(i));
            }
            for set in &mut sets {
                set.sort_unstable();
                set.dedup();
            }
            let facets = skins[t].triangles.iter().zip(&drawings[t].facet);
            Placed {
                facets: facets.map(|(&t, &facet)| (t, facet)).collect(),
                sets,
                isometry,
            }
        });
        Ok(Some(Self {
            placed: placed.collect(),
            shape,
        }))
    }

    /// Where a point of some triangles of a template is; `None` where none of them is on the surface.
    pub fn place(&self, template: usize, triangles: &[u32], point: DVec3) -> Option<Place> {
        let placed = &self.placed[template];
        let mut sets: Vec<u32> = (triangles.iter())
            .filter_map(|t| placed.facets.get(t).copied())
            .collect();
        sets.sort_unstable();
        sets.dedup();
        let back = placed.isometry.inverse().placed();
        let mut normals: Vec<DVec3> = Vec::new();
        let mut curved = None;
        for set in sets.iter().map(|s| &placed.sets[*s as usize]) {
            match set.iter().find_map(|&f| self.shape.flat(f)) {
                Some(normal) => normals.push(back.apply(normal)),
                None => curved = curved.or(Some(set)),
            }
        }
        match curved {
            Some(set) => {
                let above = self.shape.above(set, placed.isometry.apply(point));
                // In the planes that the curve is in already, but for rounding.
                let level = |p: DVec3, n: &DVec3| p - *n * p.dot(*n);
                Some(Place::Curved(normals.iter().fold(back.apply(above), level)))
            }
            None if normals.is_empty() => None,
            None => Some(Place::Flat(normals)),
        }
    }
}

/// The surfaces of all templates.
fn skins(document: &Document) -> Vec<Skin> {
    let templates = document.templates.iter();
    let mut glued: Vec<Vec<bool>> = templates.map(|t| vec![false; t.triangles.len()]).collect();
    for (t, template) in document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            for &[here, there] in &gluing.triangle_pairs {
                glued[t][here as usize] = true;
                glued[gluing.other as usize][there as usize] = true;
            }
        }
    }
    let skin = |(t, glued): (&tmesh::Template, Vec<bool>)| {
        let all = 0..t.triangles.len() as u32;
        let triangles: Vec<u32> = all.filter(|t| !glued[*t as usize]).collect();
        let corners = triangles.iter().map(|&i| t.triangles[i as usize].vertices);
        Skin {
            corners: corners.collect(),
            triangles,
        }
    };
    document.templates.iter().zip(glued).map(skin).collect()
}

/// Makes what is a corner in one template one in all; returns whether that made any.
fn agree(document: &Document, drawings: &mut [Drawing]) -> bool {
    let mut changed = false;
    loop {
        let mut more = false;
        for (t, template) in document.templates.iter().enumerate() {
            for gluing in &template.gluings {
                let other = gluing.other as usize;
                for &[here, there] in &gluing.vertex_pairs {
                    let (here, there) = (here as usize, there as usize);
                    if drawings[t].is_corner[here] != drawings[other].is_corner[there] {
                        drawings[t].is_corner[here] = true;
                        drawings[other].is_corner[there] = true;
                        more = true;
                    }
                }
            }
        }
        if !more {
            return changed;
        }
        changed = true;
    }
}

/// The surface of all copies.
struct Copied {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Of each template, where the triangles of its first copy begin, and where that is placed.
    first: Vec<(u32, Isometry)>,
}

fn copied(
    document: &Document,
    whole: &Document,
    redrawn: &[Redrawn],
) -> Result<Copied, NumberingError> {
    let numbering = Numbering::new(whole)?;
    let mut first = vec![None; document.templates.len()];
    let mut copied = Copied {
        points: Vec::new(),
        triangles: Vec::new(),
        first: Vec::new(),
    };
    let mut number: FxHashMap<u32, u32> = FxHashMap::default();
    for (i, instance) in whole.instances.iter().enumerate() {
        let Instance {
            template, isometry, ..
        } = *instance;
        let template = template as usize;
        first[template].get_or_insert((copied.triangles.len() as u32, isometry));
        let placed = isometry.placed();
        let vertices = &document.templates[template].vertices;
        for corners in &redrawn[template].triangles {
            let corners = corners.map(|v| {
                *number.entry(numbering.id(i, v)).or_insert_with(|| {
                    copied.points.push(placed.apply(vertices[v as usize]));
                    copied.points.len() as u32 - 1
                })
            });
            copied.triangles.push(corners);
        }
    }
    let unplaced = (0, Isometry::IDENTITY);
    copied.first = first.into_iter().map(|f| f.unwrap_or(unplaced)).collect();
    Ok(copied)
}
