//! What a new surface must have in common with the old one, and what it must not have that the old one had not.

use geom::measure::{corners, triangle_area, volume_of_region};
use glam::DVec3;
use mesher::RESOLUTION;
use tmesh::{OUTSIDE, Template};

/// Every region closed, with its volume unchanged but for what comes of a surface that is off by `rounding` (model
/// units). `slack`: volume that uneven facets may account for, model units cubed.
pub fn same_body(before: &Template, after: &Template, allowed: (f64, f64)) -> Result<(), String> {
    same_regions(before, after, allowed, |_| true)
}

/// The same, where the surface is off at the triangles of the old one that `moves` accepts.
fn same_regions(
    before: &Template,
    after: &Template,
    (rounding, slack): (f64, f64),
    moves: impl Fn(usize) -> bool,
) -> Result<(), String> {
    let mut sides: Vec<(u32, [u32; 2], i32)> = Vec::with_capacity(6 * after.triangles.len());
    for t in &after.triangles {
        for i in 0..3 {
            let [a, b] = [t.vertices[i], t.vertices[(i + 1) % 3]];
            let (edge, sign) = if a < b { ([a, b], 1) } else { ([b, a], -1) };
            for (region, sign) in [(t.back, sign), (t.front, -sign)] {
                if region != OUTSIDE {
                    sides.push((region, edge, sign));
                }
            }
        }
    }
    sides.sort_unstable();
    for same in sides.chunk_by(|a, b| a.0 == b.0 && a.1 == b.1) {
        if same.iter().map(|s| s.2).sum::<i32>() != 0 {
            let p = after.vertices[same[0].1[0] as usize];
            return Err(format!(
                "region {} is open near ({}, {}, {})",
                same[0].0, p.x, p.y, p.z
            ));
        }
    }
    let mut regions: Vec<u32> = before
        .triangles
        .iter()
        .flat_map(|t| [t.front, t.back])
        .collect();
    regions.sort_unstable();
    regions.dedup();
    for region in regions.into_iter().filter(|&r| r != OUTSIDE) {
        let [old, new] = [before, after].map(|t| volume_of_region(&t.vertices, t.faces(), region));
        let around = (before.triangles.iter().enumerate())
            .filter(|(i, t)| (t.front == region || t.back == region) && moves(*i));
        let area: f64 = around
            .map(|(_, t)| corners(&before.vertices, t))
            .map(|[a, b, c]| triangle_area(a, b, c))
            .sum();
        let allowed = area * rounding + slack;
        // False for NaN, too.
        let unchanged = (new - old).abs() <= allowed;
        if !unchanged {
            return Err(format!(
                "region {region} has the volume {new:.12e}, it had {old:.12e}"
            ));
        }
    }
    for t in &after.triangles {
        let [a, b, c] = corners(&after.vertices, t);
        if (b - a).cross(c - a) == DVec3::ZERO {
            return Err(format!(
                "a triangle has no area near ({}, {}, {})",
                a.x, a.y, a.z
            ));
        }
    }
    Ok(())
}

/// No two vertices at an edge so near to each other that the mesher takes them for one, unless there were such before: points heap up where
/// refinement did not come to an end.
pub fn apart(before: &Template, after: &Template) -> Result<(), String> {
    let used = before.triangles.iter().flat_map(|t| t.vertices);
    let used = used.map(|v| before.vertices[v as usize]);
    let (low, high) = used.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
        (low.min(p), high.max(p))
    });
    let least = RESOLUTION * (high - low).length();
    let (old, _) = shortest(before);
    let (new, place) = shortest(after);
    if new > least || new >= old {
        return Ok(());
    }
    Err(format!(
        "two vertices are {new:e} apart near ({}, {}, {}), which the mesher takes for one",
        place.x, place.y, place.z
    ))
}

/// The length of the shortest edge, and where it is.
fn shortest(template: &Template) -> (f64, DVec3) {
    let triangles = template.triangles.iter();
    let edges = triangles.flat_map(|t| {
        let [a, b, c] = corners(&template.vertices, t);
        [[a, b], [b, c], [c, a]]
    });
    let lengths = edges.map(|[a, b]| (a.distance(b), a));
    let first = (f64::INFINITY, DVec3::ZERO);
    lengths.fold(
        first,
        |least, edge| if edge.0 < least.0 { edge } else { least },
    )
}

/// Volumes and the area of the boundary unchanged but for what comes of a surface that is off by `drift`, model units: each region's by what that is
/// around it.
pub fn same_size(
    (before, index): (&Template, usize),
    after: &Template,
    drift: f64,
) -> Result<(), String> {
    let [(old, _), (new, around)] = [before, after].map(|t| boundary(t, index));
    let allowed = drift * around;
    if (new - old).abs() > allowed {
        return Err(format!(
            "the boundary has the area {new:.12e}, it had {old:.12e}"
        ));
    }
    let glued = glued(before, index);
    same_regions(before, after, (drift, 0.0), |t| !glued[t])
}

/// Of each triangle, whether it is in a face that is glued to another.
fn glued(template: &Template, index: usize) -> Vec<bool> {
    let mut glued = vec![false; template.triangles.len()];
    for gluing in &template.gluings {
        let here = gluing.triangles_of(index);
        here.for_each(|t| glued[t as usize] = true);
    }
    glued
}

/// Area of the boundary, and half the perimeters of its triangles; without faces that are glued to others.
fn boundary(template: &Template, index: usize) -> (f64, f64) {
    let all = template.triangles.iter().zip(glued(template, index));
    let free = all.filter(|(t, glued)| !glued && (t.front == OUTSIDE) != (t.back == OUTSIDE));
    free.fold((0.0, 0.0), |(area, half), (t, _)| {
        let [a, b, c] = corners(&template.vertices, t);
        let perimeter = a.distance(b) + b.distance(c) + c.distance(a);
        (area + triangle_area(a, b, c), half + 0.5 * perimeter)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::Triangle;

    /// Adds a regular tetrahedron about the origin in a cube with half sides of a length, of which one region is outside and another inside.
    fn add_tetrahedron(template: &mut Template, half: f64, [front, back]: [u32; 2]) {
        let first = template.vertices.len() as u32;
        let corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
        let corners = corners.map(|c| DVec3::from(c.map(f64::from)) * half);
        template.vertices.extend(corners);
        for corners in [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]] {
            template.triangles.push(Triangle {
                vertices: corners.map(|v: u32| v + first),
                marker: 0,
                front,
                back,
            });
        }
    }

    fn nested(inner: f64) -> Template {
        let mut template = Template::default();
        add_tetrahedron(&mut template, 5.0, [OUTSIDE, 1]);
        add_tetrahedron(&mut template, inner, [1, 2]);
        template
    }

    #[test]
    fn vertices_that_the_mesher_takes_for_one_are_found() {
        let before = nested(0.1);
        let heaped = |distance: f64| {
            let mut after = before.clone();
            let [a, b, _] = after.triangles[0].vertices.map(|v| v as usize);
            after.vertices[b] = after.vertices[a] + DVec3::X * distance;
            after
        };
        assert_eq!(apart(&before, &heaped(1e-6)), Ok(()));
        let told = apart(&before, &heaped(1e-9)).unwrap_err();
        assert!(told.contains("which the mesher takes for one"), "{told}");
        // The input is as it is.
        assert_eq!(apart(&heaped(1e-9), &heaped(1e-9)), Ok(()));
    }

    #[test]
    fn a_small_region_may_change_by_what_is_around_it() {
        let (before, drift) = (nested(0.5), 1e-3);
        let moved = |by: f64| same_size((&before, 0), &nested(0.5 + by), drift);
        // Faces of a tetrahedron are nearer to its middle than those of the cube around it.
        assert_eq!(moved(drift), Ok(()));
        let error = moved(50.0 * drift).expect_err("a region that grew");
        assert!(error.contains("region 2 has the volume"), "{error}");
    }
}
