//! Bodies for tests.

use glam::DVec3;
use std::f64::consts::TAU;
use tmesh::{Document, OUTSIDE, Region, Template, Triangle};

/// A prism over a regular polygon of `n` sides and the given radius, from z = 0 to `height`.
pub fn prism(n: usize, radius: f64, height: f64) -> Document {
    profile(n, &[(radius, 0.0), (radius, height)], |_, r, z| (r, z))
}

/// A document from closed surface triangles with region 1 behind them.
pub fn document(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Document {
    let triangles = triangles
        .into_iter()
        .map(|vertices| Triangle {
            vertices,
            marker: 0,
            front: OUTSIDE,
            back: 1,
        })
        .collect();
    let mut document = Document::single(Template {
        vertices,
        triangles,
        ..Template::default()
    });
    document.regions = vec![region(1)];
    document
}

/// A region with a name.
pub fn region(id: u32) -> Region {
    Region {
        id,
        name: format!("r{id}"),
        max_volume: None,
        volume: None,
    }
}

/// The solid swept by an open profile (r, z) around the z axis, closed by fans over the polygons at
/// its two ends; `shape` moves each point, given its angle.
pub fn profile(
    n: usize,
    points: &[(f64, f64)],
    shape: impl Fn(f64, f64, f64) -> (f64, f64),
) -> Document {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for &(r, z) in points {
        for i in 0..n {
            let a = TAU * i as f64 / n as f64;
            let (r, z) = shape(a, r, z);
            vertices.push(DVec3::new(r * a.cos(), r * a.sin(), z));
        }
    }
    let id = |row: usize, i: usize| (row * n + i % n) as u32;
    for row in 0..points.len() - 1 {
        for i in 0..n {
            let (a, b, c, d) = (
                id(row, i),
                id(row, i + 1),
                id(row + 1, i + 1),
                id(row + 1, i),
            );
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let last = points.len() - 1;
    for i in 1..n - 1 {
        triangles.push([id(0, 0), id(0, i + 1), id(0, i)]);
        triangles.push([id(last, 0), id(last, i), id(last, i + 1)]);
    }
    document(vertices, triangles)
}
