//! A document that tests of writers write.

use tmesh::Document;

/// A tetrahedron with its surface, in a frame that is not the identity.
pub fn test_document() -> Document {
    use glam::DVec3;
    use tmesh::{Gluing, Isometry, Marker, OUTSIDE, Region, Template, Tet, Triangle};
    let triangle = |vertices, marker| Triangle {
        vertices,
        marker,
        front: OUTSIDE,
        back: 7,
    };
    let mut document = Document::single(Template {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        triangles: vec![
            triangle([0, 2, 1], 0),
            triangle([0, 1, 3], 2),
            triangle([1, 2, 3], 2),
            triangle([0, 3, 2], 2),
        ],
        tets: vec![Tet {
            vertices: [0, 1, 2, 3],
            region: 7,
        }],
        gluings: vec![Gluing::mirror("floor", 0, Isometry::FLIP, [0, 1, 2], [0])],
        axis: vec![0, 3],
    });
    document.frame.origin = DVec3::X;
    document.regions.push(Region {
        id: 7,
        name: "copper".to_owned(),
        size: None,
        volume: None,
    });
    document.markers.push(Marker {
        id: 2,
        name: "top".to_owned(),
        area: None,
    });
    document
}
