//! A surface that was remeshed, and what was done to it.

use crate::input::Surface;
use crate::mesh::{Mesh, NONE, Sample};
use crate::shape::Ground;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// A surface that was remeshed.
#[derive(Clone, Default)]
pub struct Remeshed {
    /// The surface.
    pub surface: Surface,
    /// New vertex of each vertex of the input, or `u32::MAX`.
    pub vertices: Vec<u32>,
    /// New triangle of each triangle of the input that stayed as it was, or `u32::MAX`.
    pub triangles: Vec<u32>,
    /// The planes and lines that each new vertex is on.
    pub bound: Vec<u32>,
    /// Of each link, the new vertices with their images.
    pub links: Vec<Vec<[u32; 2]>>,
    /// Patch of each triangle, `u32::MAX` for those of flat faces.
    pub patches: Vec<u32>,
    /// Points of the input that each of these triangles is near to; none for those of flat faces.
    pub samples: Vec<Vec<Sample>>,
    /// What these are patches of.
    pub ground: Option<Arc<Ground>>,
    /// What was done.
    pub told: Told,
}

impl Remeshed {
    /// What is left of a surface, numbered anew.
    pub fn taken(surface: &Surface, mesh: Mesh<'_>, told: Told) -> Self {
        let mut vertices = vec![NONE; mesh.points.len()];
        let mut remeshed = Self {
            told,
            triangles: vec![NONE; surface.triangles.len()],
            ..Self::default()
        };
        for (v, new) in vertices.iter_mut().enumerate() {
            if !mesh.around(v as u32).is_empty() {
                *new = remeshed.surface.points.len() as u32;
                remeshed.surface.points.push(mesh.points[v]);
                remeshed.bound.push(mesh.bound[v]);
            }
        }
        // All triangles of a patch have one label.
        let mut label_of: FxHashMap<u32, u32> = FxHashMap::default();
        for (t, label) in surface.labels.iter().enumerate() {
            label_of.insert(mesh.patch[t], *label);
        }
        for t in 0..mesh.triangles.len() {
            if mesh.is_there(t as u32) {
                if let Some(new) = remeshed.triangles.get_mut(t) {
                    *new = remeshed.surface.triangles.len() as u32;
                }
                let corners = mesh.triangles[t].map(|v| vertices[v as usize]);
                remeshed.surface.triangles.push(corners);
                remeshed.surface.labels.push(label_of[&mesh.patch[t]]);
                let is_flat = mesh.planes[mesh.patch[t] as usize].is_some();
                let (patch, samples) = match is_flat {
                    true => (NONE, Vec::new()),
                    false => (mesh.patch[t], mesh.samples(t as u32).to_vec()),
                };
                remeshed.patches.push(patch);
                remeshed.samples.push(samples);
            }
        }
        remeshed.links = (0..mesh.rules.links.len())
            .map(|link| {
                let pairs = mesh.images.pairs(link).into_iter();
                pairs.map(|p| p.map(|v| vertices[v as usize])).collect()
            })
            .collect();
        vertices.truncate(surface.points.len());
        remeshed.vertices = vertices;
        remeshed
    }
}

/// What was done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Told {
    /// Edges collapsed.
    pub collapsed: usize,
    /// Edges split.
    pub split: usize,
    /// Edges flipped.
    pub flipped: usize,
    /// Vertices moved.
    pub moved: usize,
    /// Of all these, how many joined features that are detail.
    pub joined: usize,
}

impl Told {
    /// Whether anything was done.
    pub fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}
