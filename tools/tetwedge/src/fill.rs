//! From TetGen's mesh back to a template.

use crate::check;
use crate::walls::{on_segments, touching_edges};
use geom::edges::orientation;
use glam::DVec3;
use improve::{Flats, Freedoms, Improved, Wish, improve};
use mesher::{
    Answer, Cells, Climb, Elements, Error, NO_FACE, PROJECTIONS, Place, Plc, ROUNDING, Surface,
    face_key, label,
};
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use tmesh::{Document, FixedSet, Template, Tet, Triangle, Wall};

/// Part of the tetrahedra that is improved, at most: where more are bad, the shape is.
const SHARE: f64 = 0.1;

/// No counterpart.
pub const NONE: u32 = u32::MAX;

/// A filled template.
pub struct Filled {
    /// The template; vertex and triangle pairs of its hub walls still have the old numbers of the
    /// other template.
    pub template: Template,
    /// New id of each old vertex, or [`NONE`].
    pub vertices: Vec<u32>,
    /// New index of each old triangle that had to be preserved, else [`NONE`].
    pub triangles: Vec<u32>,
    /// Triangles on faces that other templates list as hub walls, increasing.
    pub shared: Vec<u32>,
    /// Tetrahedra in cells that are to be empty, left out.
    pub dropped: usize,
    /// What was improved, unless elements are to stay as the mesher left them.
    pub improved: Option<Improved>,
}

impl Filled {
    /// What templates need that share faces with this one: what [`finish`] leaves as it is.
    pub fn shared_surface(&self) -> Self {
        let template = Template {
            vertices: self.template.vertices.clone(),
            triangles: self.template.triangles.clone(),
            ..Template::default()
        };
        Self {
            template,
            vertices: self.vertices.clone(),
            triangles: Vec::new(),
            shared: self.shared.clone(),
            dropped: 0,
            improved: None,
        }
    }
}

/// What a new vertex belongs to.
#[derive(Clone, Copy)]
enum Plane {
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

/// What is known of a filled template that is not finished.
pub struct Origin {
    /// Facet of each triangle.
    facets: Vec<usize>,
    /// Wall face of each triangle.
    faces: Vec<u32>,
    /// Number of the first vertex that the input does not have.
    first_new: usize,
}

/// Makes the filled template `index` from TetGen's mesh of `plc`. What it shares with others is settled then, the
/// rest is for [`finish`].
///
/// # Errors
/// [`Error::Unusable`] when anything that must hold does not.
pub fn fill(document: &Document, index: usize, answer: &Answer) -> Result<(Filled, Origin), Error> {
    let (plc, mesh) = (&answer.plc, &*answer.mesh);
    let input = &document.templates[index];
    let unusable = |what: String| Error::Unusable {
        template: index,
        what,
    };
    if mesh.tetrahedra().is_empty() {
        return Err(unusable("it is empty".to_owned()));
    }
    if !answer.keeps_points() {
        return Err(unusable("input points were moved or left out".to_owned()));
    }
    let Cells { region, surface } = label(plc, mesh).map_err(|c| {
        let place = Place(plc.to_model(c.place));
        unusable(format!("there are {} near {place}", c.what))
    })?;

    let numbering = Numbering::new(mesh, &region, &surface, &plc.vertex_of_point);
    let mut vertices = vec![DVec3::ZERO; numbering.count];
    for (i, p) in mesh.points().iter().enumerate() {
        if numbering.new_id[i] != NONE {
            vertices[numbering.new_id[i] as usize] = match plc.vertex_of_point.get(i) {
                Some(&v) => input.vertices[v as usize],
                None => plc.to_model(*p),
            };
        }
    }
    let renumber = |v: u32| numbering.new_id[v as usize];
    let triangles: Vec<Triangle> = surface
        .iter()
        .map(|s| Triangle {
            vertices: s.triangle.vertices.map(renumber),
            ..s.triangle
        })
        .collect();
    let facets: Vec<usize> = surface.iter().map(|s| s.facet).collect();
    let faces: Vec<u32> = facets
        .iter()
        .map(|&f| plc.facets.facets[f].attributes.face)
        .collect();
    let tets: Vec<Tet> = mesh
        .tetrahedra()
        .iter()
        .zip(&region)
        .filter(|&(_, &region)| region != tmesh::OUTSIDE)
        .map(|(t, &region)| Tet {
            vertices: t.map(|v| renumber(v as u32)),
            region,
        })
        .collect();
    let mut of_vertex = vec![NONE; input.vertices.len()];
    for (point, &v) in plc.vertex_of_point.iter().enumerate() {
        of_vertex[v as usize] = numbering.new_id[point];
    }
    let dropped = mesh.tetrahedra().len() - tets.len();
    let mut filled = Filled {
        template: Template {
            vertices,
            triangles,
            tets,
            walls: Vec::new(),
            axis: Vec::new(),
        },
        vertices: of_vertex,
        triangles: vec![NONE; input.triangles.len()],
        shared: {
            let others = face_key(input.walls.len(), false);
            let all = 0..faces.len() as u32;
            all.filter(|&t| faces[t as usize] >= others).collect()
        },
        dropped,
        improved: None,
    };
    // Old vertices come first, in their order.
    let first_new = filled.vertices.iter().filter(|&&v| v != NONE).count();
    restore_preserved(input, plc, &faces, &mut filled).map_err(&unusable)?;
    let shifted = on_shifted_facets(plc, &facets, first_new, &filled.template);
    restore_walls(input, plc, &faces, first_new, shifted, &mut filled).map_err(&unusable)?;
    let origin = Origin {
        facets,
        faces,
        first_new,
    };
    Ok((filled, origin))
}

/// Improves the tetrahedra of a filled template, and checks all of it.
///
/// # Errors
/// [`Error::Unusable`] when anything that must hold does not.
pub fn finish(
    climb: &Climb<'_>,
    plc: &Plc,
    filled: &mut Filled,
    origin: &Origin,
) -> Result<(), Error> {
    let Climb {
        document,
        template: index,
        ..
    } = *climb;
    let unusable = |what: String| Error::Unusable {
        template: index,
        what,
    };
    filled.improved = refine(climb, plc, &origin.facets, filled);
    let reach = document.frame.origin.length() + plc.extent;
    let template = &filled.template;
    orientations(template, origin.first_new, reach).map_err(unusable)?;
    check::measures(document, plc, &origin.faces, template).map_err(unusable)
}

/// Improves the tetrahedra, as far as elements are to be optimized: the smallest angle to reach is what
/// remains of a straight angle, halved, and the one asked for at least.
fn refine(climb: &Climb<'_>, plc: &Plc, facets: &[usize], filled: &mut Filled) -> Option<Improved> {
    let Climb {
        document,
        params,
        sizes,
        ..
    } = *climb;
    let largest = params.optimize.filter(|_| params.quality)?;
    let of_triangle: Vec<u32> = facets.iter().map(|&f| f as u32).collect();
    let normals: Vec<DVec3> = plc.facets.facets.iter().map(|f| f.normal).collect();
    // Templates that share a face take it over as it is.
    let shared = filled.shared.iter();
    let fixed: Vec<u32> = shared
        .flat_map(|&t| filled.template.triangles[t as usize].vertices)
        .collect();
    let freedoms = Freedoms::new(
        &filled.template,
        &Flats {
            of_triangle: &of_triangle,
            normals: &normals,
            fixed: &fixed,
            straight: ROUNDING * plc.extent + 2.0 * plc.shift,
        },
    );
    let regions = document.regions.iter().zip(&sizes.of_region);
    let wish = Wish {
        // The mesher was asked for less than `min_dihedral`.
        angle: (0.5 * (180.0 - largest)).max(params.min_dihedral),
        radius_edge: params.radius_edge,
        min_dihedral: params.min_dihedral,
        max_volume: &regions.filter_map(|(r, v)| Some((r.id, (*v)?))).collect(),
        scale: plc.scale,
        share: SHARE,
    };
    Some(improve(&mut filled.template, &freedoms, &wish))
}

/// Numbers for the points that the mesh uses: the template's own in their order there, then new ones.
struct Numbering {
    new_id: Vec<u32>,
    count: usize,
}

impl Numbering {
    fn new(
        mesh: &dyn Elements,
        region: &[u32],
        surface: &[Surface],
        vertex_of_point: &[u32],
    ) -> Self {
        let mut new_id = vec![NONE; mesh.points().len()];
        for (t, &region) in mesh.tetrahedra().iter().zip(region) {
            if region != tmesh::OUTSIDE {
                t.iter().for_each(|&v| new_id[v as usize] = 0);
            }
        }
        for s in surface {
            s.triangle
                .vertices
                .iter()
                .for_each(|&v| new_id[v as usize] = 0);
        }
        let mut order: Vec<usize> = (0..new_id.len()).collect();
        order[..vertex_of_point.len()].sort_unstable_by_key(|&i| vertex_of_point[i]);
        let mut count = 0;
        for i in order {
            if new_id[i] == 0 {
                new_id[i] = count as u32;
                count += 1;
            }
        }
        Self { new_id, count }
    }
}

fn sorted(mut t: [u32; 3]) -> [u32; 3] {
    t.sort_unstable();
    t
}

/// Finds every triangle that had to be preserved, by its vertices.
fn restore_preserved(
    input: &Template,
    plc: &Plc,
    faces: &[u32],
    filled: &mut Filled,
) -> Result<(), String> {
    if !plc.faces.preserve() {
        return Ok(());
    }
    let mut new_index: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    for (i, t) in filled.template.triangles.iter().enumerate() {
        if faces[i] != NO_FACE {
            new_index.insert(sorted(t.vertices), i as u32);
        }
    }
    for (old, t) in input.triangles.iter().enumerate() {
        if !plc.faces.preserved[old] {
            continue;
        }
        let vertices = t.vertices.map(|v| filled.vertices[v as usize]);
        match new_index.get(&sorted(vertices)) {
            Some(&new) if vertices.iter().all(|&v| v != NONE) => filled.triangles[old] = new,
            _ => {
                let place = Place(t.vertices.map(|v| input.vertices[v as usize])[0]);
                return Err(format!(
                    "a triangle of a face that must be preserved is gone near {place}"
                ));
            }
        }
    }
    Ok(())
}

/// New vertices on facets that were shifted for the mesher, with the planes to put them back onto.
fn on_shifted_facets(
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

/// Rebuilds walls and axis, and puts new vertices on them exactly where they belong.
fn restore_walls(
    input: &Template,
    plc: &Plc,
    faces: &[u32],
    first_new: usize,
    mut projections: Vec<(u32, Plane)>,
    filled: &mut Filled,
) -> Result<(), String> {
    // A single projection meets a single plane; where planes of facets meet that of a wall, each
    // leaves the other a little, and a few rounds meet all.
    let rounds = if projections.is_empty() {
        1
    } else {
        PROJECTIONS
    };
    let tolerance = ROUNDING * plc.extent + 2.0 * plc.shift;
    let on_surface = {
        let mut on = vec![false; filled.template.vertices.len()];
        for &v in filled.template.triangles.iter().flat_map(|t| &t.vertices) {
            on[v as usize] = true;
        }
        on
    };
    let mut walls = Vec::with_capacity(input.walls.len());
    for (w, wall) in input.walls.iter().enumerate() {
        let mut wall = wall.clone();
        match &mut wall {
            Wall::Mirror(mirror) => {
                let projection = FixedSet::of(mirror.reflection);
                let touching = segments(
                    input,
                    &touching_edges(input, &mirror.vertices, &mirror.triangles),
                );
                let key = face_key(w, false);
                let triangles: Vec<u32> = (0..faces.len() as u32)
                    .filter(|&t| faces[t as usize] == key)
                    .collect();
                let mut vertices: Vec<u32> = mirror
                    .vertices
                    .iter()
                    .map(|&v| filled.vertices[v as usize])
                    .filter(|&v| v != NONE)
                    .collect();
                for &t in &triangles {
                    vertices.extend(filled.template.triangles[t as usize].vertices);
                }
                if !touching.is_empty() {
                    vertices.extend((first_new..on_surface.len()).filter_map(|v| {
                        let p = filled.template.vertices[v];
                        let near = mirror.plane.distance(p).abs() <= tolerance;
                        (on_surface[v] && near && on_segments(p, &touching, tolerance))
                            .then_some(v as u32)
                    }));
                }
                vertices.sort_unstable();
                vertices.dedup();
                let new = vertices.iter().filter(|&&v| v as usize >= first_new);
                projections.extend(new.map(|&v| (v, Plane::Wall(projection))));
                mirror.vertices = vertices;
                mirror.triangles = triangles;
            }
            Wall::Seam(seam) => {
                pairs(&mut seam.vertex_pairs, &filled.vertices, &filled.vertices)?;
                pairs(
                    &mut seam.triangle_pairs,
                    &filled.triangles,
                    &filled.triangles,
                )?;
            }
            // The other template's numbers are not known here.
            Wall::Hub(hub) => {
                let same: Vec<u32> = Vec::new();
                pairs(&mut hub.vertex_pairs, &filled.vertices, &same)?;
                pairs(&mut hub.triangle_pairs, &filled.triangles, &same)?;
            }
        }
        walls.push(wall);
    }

    let mut axis: Vec<u32> = input
        .axis
        .iter()
        .map(|&v| filled.vertices[v as usize])
        .filter(|&v| v != NONE)
        .collect();
    let along_axis = axis_intervals(input);
    if !along_axis.is_empty() {
        let all = filled.template.vertices.iter().enumerate();
        for (v, p) in all.skip(first_new) {
            if on_surface[v] && p.x.hypot(p.y) <= tolerance && within(&along_axis, p.z) {
                axis.push(v as u32);
            }
        }
    }
    axis.sort_unstable();
    axis.dedup();
    let new_on_axis = || axis.iter().filter(|&&v| v as usize >= first_new);
    for wall in &mut walls {
        if let Wall::Seam(seam) = wall {
            // The copies of a wedge that only touches the axis meet there.
            seam.vertex_pairs.extend(new_on_axis().map(|&v| [v, v]));
            seam.vertex_pairs.sort_unstable();
        }
    }

    for _ in 0..rounds {
        for &(v, projection) in &projections {
            let p = &mut filled.template.vertices[v as usize];
            let image = projection.nearest(*p);
            let distance = (image - *p).length();
            if distance > tolerance {
                return Err(format!(
                    "a vertex is {distance:.3e} off the wall or facet it belongs to near {}",
                    Place(*p)
                ));
            }
            *p = image;
        }
    }
    for &v in new_on_axis() {
        let p = &mut filled.template.vertices[v as usize];
        *p = DVec3::new(0.0, 0.0, p.z);
    }
    filled.template.walls = walls;
    filled.template.axis = axis;
    Ok(())
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

/// Change of a volume by the rounding of placed coordinates, in roundings of the largest coordinate times the
/// largest face.
const TURNED: f64 = 16.0;

/// All tetrahedra positive, exactly, and still so where their copies are placed: coordinates there are up to
/// `reach` (model units), and rounded.
fn orientations(template: &Template, first_new: usize, reach: f64) -> Result<(), String> {
    let bad = |t: &&Tet| {
        let [a, b, c, d] = t.vertices.map(|v| template.vertices[v as usize]);
        let (u, v, w) = (b - a, c - a, d - a);
        let (uv, vw, wu) = (u.cross(v), v.cross(w), w.cross(u));
        let faces = [uv, vw, wu, uv + vw + wu].map(DVec3::length_squared);
        let largest = faces.into_iter().fold(0.0, f64::max).sqrt();
        let safe = uv.dot(w) > TURNED * f64::EPSILON * reach * largest;
        !safe || orientation(a, b, c, d) <= 0.0
    };
    let count = template.tets.par_iter().filter(bad).count();
    if count == 0 {
        return Ok(());
    }
    match template.tets.iter().find(bad) {
        None => Ok(()),
        Some(t) => {
            let corners = t.vertices.map(|v| template.vertices[v as usize]);
            Err(format!(
                "{count} of {} tetrahedra are inverted or flat ({} new vertices), the first near {}",
                template.tets.len(),
                template.vertices.len() - first_new,
                Place(corners.iter().sum::<DVec3>() * 0.25)
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_that_placing_could_turn_over_are_refused() {
        let flat = |height: f64| Template {
            vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z * height],
            tets: vec![Tet {
                vertices: [0, 1, 2, 3],
                region: 1,
            }],
            ..Template::default()
        };
        assert_eq!(orientations(&flat(1e-9), 4, 1.0), Ok(()));
        // Positive, but not for coordinates of a million.
        let told = orientations(&flat(1e-9), 4, 1e6).unwrap_err();
        assert!(
            told.contains("1 of 1 tetrahedra are inverted or flat"),
            "{told}"
        );
        assert!(orientations(&flat(0.0), 4, 1.0).is_err());
        assert!(orientations(&flat(-1.0), 4, 1.0).is_err());
    }

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
