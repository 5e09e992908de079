//! Names and labels of the faces at which templates meet.

use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};
use tmesh::{Document, Gluing, Isometry};

/// Names of all walls, the two faces of a seam apart, and the wall of each triangle.
///
/// The faces of a seam are `wall-a` and `wall-b` as the two mirror walls of a wedge are. Walls of
/// several templates that have the same name and lead to the same place, as those of a wedge and its
/// hub, are one; other names that come again get the number of the template.
pub fn label_walls(document: &Document) -> (Vec<String>, Vec<Vec<u32>>) {
    let mut labels: Vec<Vec<u32>> = document
        .templates
        .iter()
        .map(|t| vec![0; t.triangles.len()])
        .collect();
    let mut names = WallNames::default();
    for (t, template) in document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            let [there, here] = names.of(t, gluing).map(|label| label + 1);
            // The face of another template as each of the two templates sees it.
            let other = gluing.other as usize;
            for &[i, j] in &gluing.triangle_pairs {
                labels[other][j as usize] = there;
                labels[t][i as usize] = here;
            }
        }
    }
    (names.names, labels)
}

/// Normals of the mirror planes among `count` walls, of templates placed as they are shown.
pub fn wall_normals(document: &Document, shown: &[Isometry], count: usize) -> Vec<Option<DVec3>> {
    let mut normals = vec![None; count];
    let mut names = WallNames::default();
    for (t, template) in document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            let [at, _] = names.of(t, gluing);
            if let Some(plane) = gluing.mirror_plane(t) {
                let placed = shown[t].matrix() * plane.normal;
                normals[at as usize] = Some((document.frame.rotation * placed).normalize());
            }
        }
    }
    normals
}

/// Gives walls their names.
#[derive(Default)]
pub struct WallNames {
    names: Vec<String>,
    known: BTreeMap<(String, Isometry, u32), u32>,
    seen: BTreeSet<String>,
}

impl WallNames {
    /// Positions among the names of the face there and the face here, which are the same for all but
    /// seams. To be asked for all gluings of all templates in order.
    pub fn of(&mut self, template: usize, gluing: &Gluing) -> [u32; 2] {
        // Faces of other templates that are listed by different ones are different faces.
        let owner = match gluing.other_than(template) {
            Some(_) => template as u32 + 1,
            None => 0,
        };
        let name = &gluing.name;
        let faces = match gluing.is_seam(template) {
            true => {
                let base = if name == "seam" { "wall" } else { name };
                [format!("{base}-a"), format!("{base}-b")]
            }
            false => [name.clone(), name.clone()],
        };
        faces.map(|name| {
            *self
                .known
                .entry((name.clone(), gluing.step, owner))
                .or_insert_with(|| {
                    let mut unique = name.clone();
                    let mut number = template + 1;
                    while !self.seen.insert(unique.clone()) {
                        unique = format!("{name}-{number}");
                        number += 1;
                    }
                    self.names.push(unique);
                    self.names.len() as u32 - 1
                })
        })
    }
}
