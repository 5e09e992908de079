//! Which copies have to be compared with which.

use crate::check::walls::Mesh;
use crate::instances::representatives;
use geom::tolerance::PROMISE;
use glam::DVec3;

/// Numbers of the instances to compare, increasing: one of each kind, and all that may meet one of those. What two
/// instances have in common, symmetries of the instances take to one of these and another.
pub fn instances(mesh: &Mesh<'_>) -> Vec<usize> {
    let document = mesh.document;
    let reach = PROMISE * mesh.size;
    let boxes: Vec<[DVec3; 2]> = (document.instances.iter())
        .map(|instance| {
            let t = instance.template as usize;
            let (template, placed) = (&document.templates[t], instance.isometry.placed());
            let corners = mesh.skins[t].faces.iter().flatten();
            let points = corners.map(|&v| placed.apply(template.vertices[v as usize]));
            points.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| {
                [low.min(p - reach), high.max(p + reach)]
            })
        })
        .collect();
    let firsts = representatives(document);
    let meets = |[low, high]: [DVec3; 2]| {
        let mut firsts = firsts.iter().map(|&i| boxes[i]);
        firsts.any(|[l, h]| low.cmple(h).all() && high.cmpge(l).all())
    };
    (0..boxes.len()).filter(|&i| meets(boxes[i])).collect()
}
