//! The copies that instances make of templates: their points, and where they meet.

use crate::numbering::{Numbering, NumberingError};
use glam::DVec3;
use interchange::Middles;
use tmesh::{Document, Gluing, Isometry, OUTSIDE, Triangle};

/// Points and elements per block that is given to a writer: some hundred KiB, which a processor's cache
/// holds.
pub const BLOCK: usize = 8192;

/// Which ids the elements of a copy name their points by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ids {
    /// Those of the whole mesh.
    Whole,
    /// Those of the template.
    Template,
}

/// The copies of a document's templates, with the ids of their points.
pub struct Copies<'a> {
    /// The document.
    pub document: &'a Document,
    /// The ids of the whole mesh.
    pub numbering: Numbering,
    /// Points in the middle of edges, of second-order meshes.
    pub middles: Option<&'a Middles>,
}

impl<'a> Copies<'a> {
    /// The copies of a valid document.
    ///
    /// # Errors
    /// See [`Numbering::new`].
    pub fn new(
        document: &'a Document,
        middles: Option<&'a Middles>,
    ) -> Result<Self, NumberingError> {
        Ok(Self {
            document,
            numbering: Numbering::new(document)?,
            middles,
        })
    }

    /// Fills `list` with the id of each vertex of an instance.
    pub fn point_ids(&self, instance: usize, ids: Ids, list: &mut Vec<u32>) {
        match ids {
            Ids::Whole => self.numbering.ids(instance, list),
            Ids::Template => {
                let template = self.document.instances[instance].template as usize;
                list.clear();
                list.extend(0..self.document.templates[template].vertices.len() as u32);
            }
        }
    }

    /// The map from a template's points to those of a copy in the world.
    pub fn world(&self, isometry: Isometry) -> impl Fn(DVec3) -> DVec3 + use<> {
        let placed = isometry.placed();
        let frame = self.document.frame;
        move |p| frame.to_world(placed.apply(p))
    }

    /// World position of a vertex of an instance, the same for all copies of the point; `own` is the
    /// instance's own map.
    pub fn position(&self, instance: usize, vertex: u32, own: &impl Fn(DVec3) -> DVec3) -> DVec3 {
        let (owner, vertex) = self.numbering.owner(instance, vertex);
        let place = &self.document.instances[owner];
        let p = self.document.templates[place.template as usize].vertices[vertex as usize];
        if owner == instance {
            own(p)
        } else {
            self.world(place.isometry)(p)
        }
    }

    /// Triangles of each template that are on no closed wall, increasing.
    pub fn triangles_off_walls(&self) -> Vec<Vec<u32>> {
        let templates = &self.document.templates;
        let mut on_wall: Vec<Vec<bool>> = templates
            .iter()
            .map(|t| vec![false; t.triangles.len()])
            .collect();
        for (t, template) in templates.iter().enumerate() {
            for (w, gluing) in template.gluings.iter().enumerate() {
                if !self.numbering.is_closed(t, w) {
                    continue;
                }
                for &[here, there] in &gluing.triangle_pairs {
                    on_wall[t][here as usize] = true;
                    on_wall[gluing.other as usize][there as usize] = true;
                }
            }
        }
        let off = |flags: &Vec<bool>| (0..).zip(flags).filter(|f| !*f.1).map(|f| f.0).collect();
        on_wall.iter().map(off).collect()
    }

    /// Calls `each` for the triangles on the instance's closed walls that separate two regions:
    /// triangle index, region within the instance, region beyond. Each pair of instances that meet
    /// at a wall is looked at from one side only.
    pub fn interfaces(&self, instance: usize, each: &mut impl FnMut(u32, u32, u32)) {
        let document = self.document;
        let here = document.instances[instance];
        let template = &document.templates[here.template as usize];
        for (w, gluing) in template.gluings.iter().enumerate() {
            let Some(beyond) = self.numbering.neighbour(instance, w) else {
                continue;
            };
            let there = document.instances[beyond];
            let other = &document.templates[there.template as usize];
            // A face that two gluings state is looked at by the one of the lower template, and a mirror
            // wall by the lower of the instances that meet there.
            let back = |g: &Gluing| g.other == here.template && g.step == gluing.step.inverse();
            let stated_twice = gluing.other != here.template && other.gluings.iter().any(back);
            let skipped = match gluing.is_mirror(here.template as usize) {
                true => beyond < instance || here.region_map == there.region_map,
                false => stated_twice && gluing.other < here.template,
            };
            if skipped {
                continue;
            }
            for &[a, b] in &gluing.triangle_pairs {
                let inner = inner_region(&template.triangles[a as usize]);
                let outer = inner_region(&other.triangles[b as usize]);
                let inner = document.placed_region(&here, inner);
                let outer = document.placed_region(&there, outer);
                if inner != outer {
                    each(a, inner, outer);
                }
            }
        }
    }
}

/// The region on the inner side of a wall triangle, whichever way it is wound.
fn inner_region(triangle: &Triangle) -> u32 {
    if triangle.back == OUTSIDE {
        triangle.front
    } else {
        triangle.back
    }
}
