//! The walls and the axis of a filled template, and the exact places of new vertices on them.

use super::filled::{Filled, NONE};
use super::touching::{on_segments, touching_edges};
use glam::DVec3;
use mesher::{Place, Plc, face_key, settled};
use tmesh::{FixedSet, Gluing, Template};

/// What a new vertex belongs to.
#[derive(Clone, Copy)]
pub enum Plane {
    /// A mirror wall.
    Wall(FixedSet),
    /// A facet of the surface, by its unit normal and a point.
    Facet { normal: DVec3, origin: DVec3 },
}

impl Plane {
    fn nearest(self, p: DVec3) -> DVec3 {
        match self {
            Self::Wall(set) => set.nearest(p),
            Self::Facet { normal, origin } => p - normal * (p - origin).dot(normal),
        }
    }
}

/// New vertices on facets that were shifted for the mesher, with the planes to put them back onto.
pub fn on_shifted_facets(
    plc: &Plc,
    facets: &[usize],
    first_new: usize,
    template: &Template,
) -> Vec<(u32, Plane)> {
    let mut found: Vec<(u32, usize)> = Vec::new();
    for (t, &facet) in template.triangles.iter().zip(facets) {
        // Facets more uneven than the shift have no plane to be put back onto.
        if plc.shifted[facet] && plc.facets.facets[facet].deviation <= plc.shift {
            let new = t.vertices.iter().filter(|&&v| v as usize >= first_new);
            found.extend(new.map(|&v| (v, facet)));
        }
    }
    found.sort_unstable();
    found.dedup();
    let plane = |facet: usize| {
        let facet = &plc.facets.facets[facet];
        Plane::Facet {
            normal: facet.normal,
            origin: facet.origin,
        }
    };
    found.into_iter().map(|(v, f)| (v, plane(f))).collect()
}

/// What walls are restored from.
struct Restorer<'a> {
    input: &'a Template,
    plc: &'a Plc,
    /// Wall face of each new triangle.
    faces: &'a [u32],
    /// Number of the first vertex that the input does not have.
    first_new: usize,
    /// Of each new vertex, whether it is on the surface.
    on_surface: Vec<bool>,
    /// How far the mesher's points may be off what they belong to, model units.
    tolerance: f64,
}

/// Rebuilds gluings and axis, and puts new vertices on them exactly where they belong: `projections` has those that
/// belong on other planes.
pub fn restore_walls(
    input: &Template,
    (plc, faces, first_new): (&Plc, &[u32], usize),
    mut projections: Vec<(u32, Plane)>,
    filled: &mut Filled,
) -> Result<(), String> {
    let mut on_surface = vec![false; filled.template.vertices.len()];
    for &v in filled.template.triangles.iter().flat_map(|t| &t.vertices) {
        on_surface[v as usize] = true;
    }
    let restorer = Restorer {
        input,
        plc,
        faces,
        first_new,
        on_surface,
        tolerance: plc.rounding + 2.0 * plc.shift,
    };
    let mut gluings = Vec::with_capacity(input.gluings.len());
    for wall in 0..input.gluings.len() {
        let gluing = restorer.gluing(wall, filled)?;
        if gluing.is_mirror(plc.template) {
            let set = FixedSet::of(gluing.step);
            let new = gluing.vertices_here().filter(|&v| v as usize >= first_new);
            projections.extend(new.map(|v| (v, Plane::Wall(set))));
        }
        gluings.push(gluing);
    }
    let axis = restorer.axis(filled);
    let new_on_axis = || axis.iter().filter(|&&v| v as usize >= first_new);
    for gluing in &mut gluings {
        if gluing.joins_at_axis(plc.template) {
            gluing.vertex_pairs.extend(new_on_axis().map(|&v| [v, v]));
            gluing.vertex_pairs.sort_unstable();
        }
    }
    // Walls stay behind facets, so that points are exactly on them.
    projections.sort_by_key(|&(v, _)| v);
    for planes in projections.chunk_by(|a, b| a.0 == b.0) {
        let p = &mut filled.template.vertices[planes[0].0 as usize];
        *p = settled(*p, planes.len(), |i, p| {
            let plane = planes[i].1;
            let image = plane.nearest(p);
            let distance = (image - p).length();
            // Between vertices that were shifted out of their plane, a needle's own plane may be any; what that makes of
            // elements is checked.
            if distance > restorer.tolerance && matches!(plane, Plane::Wall(_)) {
                return Err(format!(
                    "a vertex is {distance:.3e} off the wall it belongs to near {}",
                    Place(p)
                ));
            }
            Ok(image)
        })?;
    }
    for &v in new_on_axis() {
        let p = &mut filled.template.vertices[v as usize];
        *p = FixedSet::Axis.nearest(*p);
    }
    filled.template.gluings = gluings;
    filled.template.axis = axis;
    Ok(())
}

impl Restorer<'_> {
    /// A gluing with new numbers; a mirror wall with everything that was added to it. The numbers of another template
    /// are as they were.
    fn gluing(&self, wall: usize, filled: &Filled) -> Result<Gluing, String> {
        let mut gluing = self.input.gluings[wall].clone();
        if gluing.is_mirror(self.plc.template) {
            let vertices = self.on_mirror(wall, filled);
            let triangles = self.triangles_of(wall);
            gluing.vertex_pairs = vertices.into_iter().map(|v| [v, v]).collect();
            gluing.triangle_pairs = triangles.map(|t| [t, t]).collect();
            return Ok(gluing);
        }
        let own = gluing.is_seam(self.plc.template);
        let there = |numbers| if own { numbers } else { &[][..] };
        let (vertices, triangles) = (&filled.vertices, &filled.triangles);
        pairs(&mut gluing.vertex_pairs, vertices, there(vertices))?;
        pairs(&mut gluing.triangle_pairs, triangles, there(triangles))?;
        Ok(gluing)
    }

    /// New triangles of a mirror wall.
    fn triangles_of(&self, wall: usize) -> impl Iterator<Item = u32> {
        let key = face_key(wall, false);
        (0..self.faces.len() as u32).filter(move |&t| self.faces[t as usize] == key)
    }

    /// Vertices on a mirror wall, where the body only touches it, too.
    fn on_mirror(&self, wall: usize, filled: &Filled) -> Vec<u32> {
        let gluing = &self.input.gluings[wall];
        let on: Vec<u32> = gluing.vertices_here().collect();
        let of: Vec<u32> = gluing.triangles_here().collect();
        let touching = segments(self.input, &touching_edges(self.input, &on, &of));
        let kept = on.iter().map(|&v| filled.vertices[v as usize]);
        let mut vertices: Vec<u32> = kept.filter(|&v| v != NONE).collect();
        for t in self.triangles_of(wall) {
            vertices.extend(filled.template.triangles[t as usize].vertices);
        }
        if let Some(plane) = gluing.mirror_plane(self.plc.template)
            && !touching.is_empty()
        {
            let new = self.first_new..self.on_surface.len();
            vertices.extend(new.map(|v| v as u32).filter(|&v| {
                let p = filled.template.vertices[v as usize];
                let near = plane.distance(p).abs() <= self.tolerance;
                self.on_surface[v as usize] && near && on_segments(p, &touching, self.tolerance)
            }));
        }
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    }

    /// Vertices on the axis, increasing.
    fn axis(&self, filled: &Filled) -> Vec<u32> {
        let kept = self.input.axis.iter().map(|&v| filled.vertices[v as usize]);
        let mut axis: Vec<u32> = kept.filter(|&v| v != NONE).collect();
        let along_axis = axis_intervals(self.input);
        if !along_axis.is_empty() {
            let all = filled.template.vertices.iter().enumerate();
            for (v, p) in all.skip(self.first_new) {
                let near = p.x.hypot(p.y) <= self.tolerance;
                if self.on_surface[v] && near && within(&along_axis, p.z) {
                    axis.push(v as u32);
                }
            }
        }
        axis.sort_unstable();
        axis.dedup();
        axis
    }
}

/// Renumbers pairs; an empty second list leaves second members as they are.
fn pairs(pairs: &mut [[u32; 2]], first: &[u32], second: &[u32]) -> Result<(), String> {
    for pair in pairs.iter_mut() {
        let old = *pair;
        pair[0] = first[pair[0] as usize];
        if !second.is_empty() {
            pair[1] = second[pair[1] as usize];
        }
        if pair.contains(&NONE) {
            return Err(format!("a pair of a wall, {old:?}, lost a member"));
        }
    }
    pairs.sort_unstable();
    Ok(())
}

fn segments(input: &Template, edges: &[[u32; 2]]) -> Vec<[DVec3; 2]> {
    edges
        .iter()
        .map(|e| e.map(|v| input.vertices[v as usize]))
        .collect()
}

/// Stretches of the axis that are edges of the surface, increasing, merged.
fn axis_intervals(input: &Template) -> Vec<[f64; 2]> {
    let mut stretches: Vec<[f64; 2]> = segments(input, &touching_edges(input, &input.axis, &[]))
        .iter()
        .map(|[a, b]| [a.z.min(b.z), a.z.max(b.z)])
        .collect();
    stretches.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut merged: Vec<[f64; 2]> = Vec::new();
    for s in stretches {
        match merged.last_mut() {
            Some(last) if s[0] <= last[1] => last[1] = last[1].max(s[1]),
            _ => merged.push(s),
        }
    }
    merged
}

fn within(intervals: &[[f64; 2]], z: f64) -> bool {
    let after = intervals.partition_point(|i| i[0] <= z);
    after > 0 && z <= intervals[after - 1][1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_are_found_in_intervals() {
        let intervals = [[0.0, 1.0], [2.0, 3.0]];
        for (z, inside) in [
            (-0.1, false),
            (0.0, true),
            (0.5, true),
            (1.5, false),
            (3.0, true),
            (3.1, false),
        ] {
            assert_eq!(within(&intervals, z), inside, "{z}");
        }
    }
}
