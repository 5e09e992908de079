//! Triangles of the surface that a copy would have as well.

use mesher::{Error, NO_FACE, Place};
use std::collections::BTreeSet;
use tmesh::Template;

/// No triangle beside the walls of the template `index` is the image of one, so that copies on either side have it: between three vertices of a
/// mirror wall, or of both faces of a seam. A surface is drawn so where its outline on a wall bends by less than
/// what counts as flat, and the mesher divides the facet there in another way. `faces`: wall face of each triangle.
///
/// # Errors
/// [`Error::Doubled`] with the first one.
pub fn doubled(template: &Template, index: usize, faces: &[u32]) -> Result<(), Error> {
    for gluing in &template.gluings {
        // What is shared with another template is in the mesh of either as one of them settled it.
        if gluing.other_than(index).is_some() {
            continue;
        }
        let mut image = vec![None; template.vertices.len()];
        for &[here, there] in &gluing.vertex_pairs {
            image[here as usize] = Some(there);
        }
        let beside = || {
            let all = template.triangles.iter().zip(faces);
            all.filter(|(_, face)| **face == NO_FACE).map(|(t, _)| t)
        };
        let images: Vec<([u32; 3], [u32; 3])> = beside()
            .filter_map(|t| {
                let [a, b, c] = t.vertices.map(|v| image[v as usize]);
                Some((sorted(t.vertices), sorted([a?, b?, c?])))
            })
            .collect();
        if images.is_empty() {
            continue;
        }
        let wanted: BTreeSet<[u32; 3]> = images.iter().map(|pair| pair.1).collect();
        let there: BTreeSet<[u32; 3]> = beside()
            .map(|t| sorted(t.vertices))
            .filter(|t| wanted.contains(t))
            .collect();
        let met = images.iter().find(|(_, image)| there.contains(image));
        if let Some(&([a, b, c], _)) = met {
            let [a, b, c] = [a, b, c].map(|v| template.vertices[v as usize]);
            return Err(Error::Doubled {
                template: index,
                wall: gluing.name.clone(),
                place: Place((a + b + c) / 3.0),
            });
        }
    }
    Ok(())
}

fn sorted(mut triangle: [u32; 3]) -> [u32; 3] {
    triangle.sort_unstable();
    triangle
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use mesher::face_key;
    use tmesh::{Gluing, Isometry, OUTSIDE, Triangle};

    /// Four vertices of a wall and one above it; the first triangle is the wall's.
    fn over(gluing: Gluing) -> Template {
        let triangle = |vertices| Triangle {
            vertices,
            marker: 1,
            front: OUTSIDE,
            back: 1,
        };
        Template {
            vertices: vec![
                DVec3::ZERO,
                DVec3::X,
                DVec3::Y,
                DVec3::new(1.0, 1.0, 0.0),
                DVec3::Z,
            ],
            triangles: vec![
                triangle([0, 1, 2]),
                triangle([0, 1, 4]),
                triangle([1, 2, 3]),
            ],
            gluings: vec![gluing],
            ..Template::default()
        }
    }

    #[test]
    fn what_copies_have_as_well_is_refused() {
        let mirror = |on: &[u32]| {
            let gluing = Gluing::mirror("level", 0, Isometry::FLIP, on.iter().copied(), []);
            doubled(&over(gluing), 0, &[face_key(0, false), NO_FACE, NO_FACE])
        };
        assert!(mirror(&[0, 1, 2]).is_ok());
        let told = mirror(&[0, 1, 2, 3]).unwrap_err().to_string();
        assert!(told.contains("'level' lies on it near (6.6"), "{told}");
        // A seam from the second triangle to the third one, and to nothing.
        let seam = |there: u32| {
            let mut gluing = Gluing::mirror("cut", 0, Isometry::FLIP, [], []);
            gluing.step = Isometry::rotation(1, 4);
            gluing.vertex_pairs = vec![[0, 1], [1, 2], [4, there]];
            doubled(&over(gluing), 0, &[face_key(0, false), NO_FACE, NO_FACE])
        };
        assert!(seam(3).is_err());
        assert!(seam(0).is_ok(), "no triangle has these corners");
    }
}
