use super::flip;
use super::freedom::Freedom;
use super::insert;
use super::mesh::Mesh;
use super::quality::Goal;
use super::smooth;
use super::support::Support;
use super::surface::{Diagonal, sorted};
use super::{Curved, Flats, Freedoms, Shape, Wish, improve};
use geom::measure::tet_volume;
use geom::tet::{FACES, TetMeasures};
use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use tmesh::{Gluing, Isometry, OUTSIDE, Template, Tet, Triangle};

/// Does what is found to replace a tetrahedron, if anything.
fn flip(mesh: &mut Mesh<'_>, tet: u32) -> bool {
    let found = flip::find(mesh, tet);
    found.iter().for_each(|f| f.apply(mesh));
    found.is_some()
}

/// Moves a vertex to the better place found, if any.
fn smooth(mesh: &mut Mesh<'_>, freedoms: &Freedoms, vertex: u32) -> bool {
    let found = smooth::find(mesh, freedoms, vertex);
    found.iter().for_each(|m| m.apply(mesh));
    found.is_some()
}

/// Tetrahedra around the edge from (0, 0, -h) to (0, 0, h), with `ring` vertices on a unit circle.
fn ring(ring: usize, h: f64) -> Template {
    let mut vertices = vec![DVec3::new(0.0, 0.0, -h), DVec3::new(0.0, 0.0, h)];
    for i in 0..ring {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / ring as f64).sin_cos();
        vertices.push(DVec3::new(cos, sin, 0.0));
    }
    let at = |i: usize| 2 + (i % ring) as u32;
    let tets = (0..ring)
        .map(|i| Tet {
            vertices: [0, at(i), at(i + 1), 1],
            region: 7,
        })
        .collect();
    Template {
        vertices,
        tets,
        ..Template::default()
    }
}

fn volume(template: &Template, tets: &[Tet]) -> f64 {
    let volume = |t: &Tet| {
        let [a, b, c, d] = t.vertices.map(|v| template.vertices[v as usize]);
        assert!(tet_volume(a, b, c, d) > 0.0);
        tet_volume(a, b, c, d)
    };
    tets.iter().map(volume).sum()
}

#[test]
fn long_edges_are_removed() {
    let goal = Goal::new(30.0, 1.4, 10.0);
    let limits = FxHashMap::default();
    for n in [3, 4, 5, 6, 7] {
        let template = ring(n, 4.0);
        let before = volume(&template, &template.tets);
        let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
        let worst = mesh.grade(0).quality;
        assert!(worst < 1.0);
        let removed = flip(&mut mesh, 0);
        assert!(removed, "{n}");
        let tets = mesh.into_tets();
        assert_eq!(tets.len(), 2 * (n - 2));
        assert!(tets.iter().all(|t| t.region == 7));
        assert!((volume(&template, &tets) - before).abs() < 1e-12);
        let again = Template { tets, ..template };
        let mesh = Mesh::of_template(&again, 1.0, goal, &limits);
        let grades = (0..mesh.len() as u32).map(|t| mesh.grade(t).quality);
        assert!(grades.fold(f64::INFINITY, f64::min) > worst);
    }
    // Nothing that could take its place is better.
    let flat = ring(6, 0.6);
    let mut mesh = Mesh::of_template(&flat, 1.0, goal, &limits);
    assert!(!flip(&mut mesh, 0));
    assert_eq!(mesh.into_tets(), flat.tets);
}

/// Where a shape is next to flat, rounding has tetrahedra with volume on both sides of what is there.
#[test]
fn edges_that_are_there_are_not_made_again() {
    let goal = Goal::new(30.0, 1.4, 10.0);
    let limits = FxHashMap::default();
    // Four around an edge, and two on the other side of a face.
    let around = ring(4, 4.0);
    let mut beside = ring(3, 0.5);
    beside.tets = [[2, 3, 4, 1], [4, 3, 2, 0]]
        .map(|vertices| Tet {
            vertices,
            region: 7,
        })
        .to_vec();
    let both = [(around, vec![[2, 4], [3, 5]]), (beside, vec![[0, 1]])];
    for (mut template, edges) in both {
        let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
        assert!(flip(&mut mesh, 0));
        let more = template.vertices.len() as u32;
        let away = [DVec3::new(9.0, 0.0, 0.0), DVec3::new(9.0, 1.0, 0.5)];
        template.vertices.extend(away);
        template.tets.extend(edges.into_iter().map(|[a, b]| Tet {
            vertices: [a, b, more, more + 1],
            region: 7,
        }));
        let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
        assert!(!flip(&mut mesh, 0));
    }
}

#[test]
fn faces_of_the_surface_and_sizes_are_respected() {
    let goal = Goal::new(30.0, 1.4, 10.0);
    let mut template = ring(4, 4.0);
    let none = FxHashMap::default();
    // Faces inside of a region that are part of the surface.
    for ends in [[2, 3], [3, 4], [4, 5], [5, 2]] {
        template.triangles.push(Triangle {
            vertices: [0, 1, ends[0]],
            marker: 1,
            front: 7,
            back: 7,
        });
    }
    let mut mesh = Mesh::of_template(&template, 1.0, goal, &none);
    assert!(!flip(&mut mesh, 0));
    template.triangles.clear();
    // Another region beyond.
    template.tets[2].region = 8;
    let mut mesh = Mesh::of_template(&template, 1.0, goal, &none);
    assert!(!flip(&mut mesh, 0));
    // Two that are larger than the three before.
    let template = ring(3, 4.0);
    let limits = FxHashMap::from_iter([(7, 1.0)]);
    let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
    assert!(!flip(&mut mesh, 0));
    let limits = FxHashMap::from_iter([(7, 12.0), (8, 1.0)]);
    let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
    assert!(flip(&mut mesh, 0));
}

/// An octahedron, its middle off by `off`, with all outer faces as its surface.
fn octahedron(off: DVec3) -> Template {
    let mut vertices = vec![off];
    for d in [DVec3::X, DVec3::Y, DVec3::Z] {
        vertices.extend([d, -d]);
    }
    let mut tets = Vec::new();
    let mut triangles = Vec::new();
    for (x, y, z) in [(1, 3, 5), (3, 2, 5), (2, 4, 5), (4, 1, 5)] {
        tets.push([0, x, y, z]);
        tets.push([0, y, x, 6]);
        triangles.push([x, y, z]);
        triangles.push([y, x, 6]);
    }
    Template {
        vertices,
        tets: tets
            .into_iter()
            .map(|vertices| Tet {
                vertices,
                region: 1,
            })
            .collect(),
        triangles: triangles
            .into_iter()
            .map(|vertices| Triangle {
                vertices,
                marker: 1,
                front: OUTSIDE,
                back: 1,
            })
            .collect(),
        ..Template::default()
    }
}

fn facets(template: &Template) -> (Vec<u32>, Vec<DVec3>) {
    let normal = |t: &Triangle| {
        let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
        (b - a).cross(c - a).normalize()
    };
    let normals: Vec<DVec3> = template.triangles.iter().map(normal).collect();
    ((0..normals.len() as u32).collect(), normals)
}

/// The same with what is in one plane in one facet.
fn flat_facets(template: &Template) -> (Vec<u32>, Vec<DVec3>) {
    let (_, all) = facets(template);
    let mut normals: Vec<DVec3> = Vec::new();
    let facet = |normal: DVec3| {
        let known = normals.iter().position(|n| n.dot(normal) > 1.0 - 1e-12);
        known.unwrap_or_else(|| {
            normals.push(normal);
            normals.len() - 1
        }) as u32
    };
    (all.into_iter().map(facet).collect(), normals)
}

fn freedoms(template: &Template, of_triangle: &[u32], normals: &[DVec3]) -> Freedoms {
    Freedoms::new(
        (template, 0),
        &Flats {
            of_triangle,
            normals,
            slopes: &vec![0.0; normals.len()],
            fixed: &[],
            kept: &[],
            straight: 1e-12,
            curved: None,
        },
    )
}

#[test]
fn inner_vertices_go_to_the_middle() {
    let goal = Goal::new(54.0, 1.4, 10.0);
    let limits = FxHashMap::default();
    let template = octahedron(DVec3::new(0.5, 0.2, -0.2));
    let (of_triangle, normals) = facets(&template);
    let freedoms = freedoms(&template, &of_triangle, &normals);
    let kinds: Vec<_> = (0..7).map(|v| freedoms.of(v)).collect();
    assert_eq!(kinds[0], Freedom::Free);
    assert!(kinds[1..].iter().all(|&k| k == Freedom::Fixed));
    let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
    let least = |mesh: &Mesh<'_>| {
        (0..8)
            .map(|t| mesh.grade(t).quality)
            .fold(f64::INFINITY, f64::min)
    };
    let before = least(&mesh);
    for _ in 0..20 {
        smooth(&mut mesh, &freedoms, 0);
    }
    assert!(!smooth(&mut mesh, &freedoms, 1));
    assert!(least(&mesh) > 2.0 * before);
    assert!(mesh.positions[0].length() < 0.1, "{}", mesh.positions[0]);
}

/// A unit sphere, which holds what it is told to.
struct Sphere {
    holds: bool,
}

impl Shape for Sphere {
    fn nearest(&self, _: u32, p: DVec3) -> Option<(DVec3, DVec3)> {
        let normal = p.try_normalize()?;
        Some((normal, normal))
    }

    fn holds(&self, patch: u32, [a, b, c]: [DVec3; 3]) -> bool {
        // As the surface runs.
        assert!(patch == 3 && (b - a).cross(c - a).dot(a + b + c) > 0.0);
        self.holds
    }
}

/// What may be done to an octahedron that stands for a sphere, with features from an angle on whose cosine is given.
fn on_sphere(template: &Template, holds: bool, feature: f64) -> Freedoms {
    let (of_triangle, normals) = flat_facets(template);
    Freedoms::new(
        (template, 0),
        &Flats {
            of_triangle: &of_triangle,
            normals: &normals,
            slopes: &vec![0.0; normals.len()],
            fixed: &[],
            kept: &[],
            straight: 1e-12,
            curved: Some(Curved {
                shape: Arc::new(Sphere { holds }),
                patches: &vec![3; normals.len()],
                feature,
                points: &vec![Vec::new(); normals.len()],
                scale: 1.0,
            }),
        },
    )
}

#[test]
fn vertices_move_along_a_curved_shape() {
    let goal = Goal::new(54.0, 1.4, 10.0);
    let limits = FxHashMap::default();
    let mut template = octahedron(DVec3::ZERO);
    template.vertices[1] = DVec3::new(1.0, 0.5, -0.4).normalize();
    let moved = |template: &Template, holds: bool, feature: f64| {
        let freedoms = on_sphere(template, holds, feature);
        let mut mesh = Mesh::of_template(template, 1.0, goal, &limits);
        mesh.set_surface(freedoms.clone().take_surface());
        let least = |mesh: &Mesh<'_>| {
            let qualities = (0..8).map(|t| mesh.grade(t).quality);
            qualities.fold(f64::INFINITY, f64::min)
        };
        let before = least(&mesh);
        let mut count = 0;
        for v in (0..20).flat_map(|_| 1..7) {
            count += usize::from(smooth(&mut mesh, &freedoms, v));
        }
        for p in &mesh.positions[1..] {
            assert!((p.length() - 1.0).abs() < 1e-14, "{p}");
        }
        (count > 0).then(|| least(&mesh) / before)
    };
    let gain = moved(&template, true, -1.0);
    assert!(gain.is_some_and(|gain| gain > 1.3), "{gain:?}");
    assert_eq!(moved(&template, false, -1.0), None);
    // Its edges fold by 70 degrees.
    assert_eq!(moved(&template, true, 0.9), None);
    // What is shared with another template stays, with all around it.
    template.gluings = vec![Gluing::seam("hub", 1, Isometry::IDENTITY, [[5, 5]], [])];
    let freedoms = on_sphere(&template, true, -1.0);
    let kinds: Vec<bool> = (1..7).map(|v| freedoms.of(v) == Freedom::Fixed).collect();
    assert_eq!(kinds, [true, true, true, true, true, false]);
    // Where it touches a wall in a point alone, that one stays.
    template.gluings = vec![Gluing::seam("wall", 0, Isometry::FLIP, [[2, 2]], [])];
    let freedoms = on_sphere(&template, true, -1.0);
    let kinds: Vec<bool> = (1..7).map(|v| freedoms.of(v) == Freedom::Fixed).collect();
    assert_eq!(kinds, [false, true, false, false, false, false]);
}

/// Beside a feature of a curved shape edges become others, and what was straight is so no more: along the feature a vertex goes where the shape
/// holds the triangles beside it.
#[test]
fn vertices_on_features_of_a_curved_shape_move_where_that_holds_what_is_beside_them() {
    let goal = Goal::new(54.0, 1.4, 10.0);
    let limits = FxHashMap::default();
    let mut template = octahedron(DVec3::ZERO);
    let middle = template.vertices.len() as u32;
    template.vertices.push(DVec3::new(0.9, 0.1, 0.0));
    // The edge from 1 to 3 is divided there, with all that is at it.
    let with = |old: u32| move |v: u32| if v == old { middle } else { v };
    for i in 0..8 {
        let (tet, triangle) = (template.tets[i], template.triangles[i]);
        if triangle.vertices.contains(&1) && triangle.vertices.contains(&3) {
            template.tets[i].vertices = tet.vertices.map(with(1));
            template.triangles[i].vertices = triangle.vertices.map(with(1));
            template.tets.push(Tet {
                vertices: tet.vertices.map(with(3)),
                ..tet
            });
            template.triangles.push(Triangle {
                vertices: triangle.vertices.map(with(3)),
                ..triangle
            });
        }
    }
    let moved = |holds: bool| {
        let freedoms = on_sphere(&template, holds, 0.9);
        assert!(matches!(freedoms.of(middle), Freedom::Line(_)));
        let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
        mesh.set_surface(freedoms.clone().take_surface());
        let is_moved = smooth(&mut mesh, &freedoms, middle);
        let p = mesh.positions[middle as usize];
        assert!((p.x + p.y - 1.0).abs() < 1e-14 && p.z == 0.0, "{p}");
        is_moved.then_some(p.x)
    };
    let there = moved(true).expect("a better place");
    assert!((0.4..0.6).contains(&there), "{there}");
    assert_eq!(moved(false), None);
}

#[test]
fn vertices_that_move_along_a_shape_pass_no_mirror_plane() {
    let mut template = octahedron(DVec3::ZERO);
    let mirror = Isometry::reflection(0, 1);
    template.gluings = vec![Gluing::mirror("wall-a", 0, mirror, [], [])];
    let freedoms = on_sphere(&template, true, -1.0);
    let [here, there] = [0.1, -0.1].map(|y| DVec3::new(0.0, y, 1.0).normalize());
    let may_go = |from: DVec3, to: DVec3| freedoms.holds(5, [from, to], std::iter::empty());
    assert!(may_go(here, here) && !may_go(here, there));
    assert!(may_go(there, there) && !may_go(there, here));
}

#[test]
fn edges_on_a_curved_shape_are_replaced_where_that_allows_it() {
    let goal = Goal::new(54.0, 1.4, 10.0);
    let limits = FxHashMap::default();
    let mut template = octahedron(DVec3::ZERO);
    template.vertices[5] = DVec3::new(0.5, 0.5, 1.0).normalize();
    template.vertices[6] = DVec3::new(0.5, 0.5, -1.0).normalize();
    let may = |holds: bool, feature: f64, old: [u32; 2]| {
        let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
        mesh.set_surface(on_sphere(&template, holds, feature).take_surface());
        mesh.may_replace(Diagonal { old, new: [5, 6] })
    };
    // Either way along the edge.
    assert!(may(true, -1.0, [1, 3]) && may(true, -1.0, [3, 1]));
    assert!(!may(false, -1.0, [1, 3]) && !may(true, 0.999, [1, 3]) && !may(true, -1.0, [1, 2]));
}

/// Steps that are small against what is next to the vertex would never make a good tetrahedron.
#[test]
fn a_vertex_next_to_another_one_goes_to_the_middle() {
    let goal = Goal::new(25.0, 1.4, 10.0);
    let limits = FxHashMap::default();
    for distance in [1e-3, 1e-6, 1e-9] {
        let template = octahedron(DVec3::X * (1.0 - distance));
        let (of_triangle, normals) = facets(&template);
        let freedoms = freedoms(&template, &of_triangle, &normals);
        let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
        assert!(smooth(&mut mesh, &freedoms, 0), "{distance}");
        assert!(mesh.positions[0].length() < 0.3, "{}", mesh.positions[0]);
    }
}

#[test]
fn new_vertices_come_where_nothing_else_helps() {
    // A long edge in the middle makes long radii.
    let goal = Goal::new(25.0, 1.4, 10.0);
    let limits = FxHashMap::default();
    let template = ring(4, 2.0);
    let before = volume(&template, &template.tets);
    let mut freedoms = freedoms(&template, &[], &[]);
    let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
    let worst = mesh.grade(0).quality;
    assert!(worst < 1.0);
    let found = insert::find(&mesh, &freedoms, 0, None).expect("a place");
    found.apply(&mut mesh, &mut freedoms);
    assert!((0..mesh.len() as u32).all(|t| mesh.grade(t).quality >= 1.0));
    assert!(mesh.positions[6].length() < 0.2, "{}", mesh.positions[6]);
    let grown = Template {
        vertices: mesh.positions.clone(),
        ..Template::default()
    };
    let tets = mesh.into_tets();
    assert_eq!(tets.len(), 8);
    assert!(tets.iter().all(|t| t.region == 7));
    assert!((volume(&grown, &tets) - before).abs() < 1e-12);
    // Not across faces that are part of the surface, nor into another region.
    let face = |corner| Triangle {
        vertices: [0, 1, corner],
        marker: 1,
        front: 7,
        back: 7,
    };
    let mut divided = template.clone();
    divided.triangles = [2, 4].map(face).to_vec();
    let mut regions = template;
    regions.tets[2..].iter_mut().for_each(|t| t.region = 8);
    for (other, most) in [(divided, 2), (regions, 2)] {
        let mesh = Mesh::of_template(&other, 1.0, goal, &limits);
        for tet in 0..4 {
            let found = insert::find(&mesh, &freedoms, tet, None);
            assert!(found.is_none_or(|f| f.replaces_at_most(most)), "{tet}");
        }
    }
}

/// Good elements that are larger than asked for get vertices, as long as what comes of that is good enough; within what is asked for nothing
/// changes.
#[test]
fn elements_larger_than_asked_for_get_vertices() {
    for (part, is_divided) in [(1.1, false), (0.9, true), (0.7, true)] {
        let mut template = octahedron(DVec3::ZERO);
        let (of_triangle, normals) = facets(&template);
        let before = freedoms(&template, &of_triangle, &normals);
        let whole = volume(&template, &template.tets);
        let count = template.tets.len();
        let limit = part * whole / count as f64;
        let wish = Wish {
            angle: 25.0,
            radius_edge: 1.4,
            min_dihedral: 10.0,
            max_volume: &[(template.tets[0].region, limit)].into_iter().collect(),
            scale: 1.0,
            stop: &|| false,
        };
        let (done, _) = improve(&mut template, &before, &wish);
        assert_eq!(done.inserted > 0, is_divided, "{part}: {done:?}");
        assert!((volume(&template, &template.tets) - whole).abs() < 1e-12);
        let volumes = template.tets.iter().map(|&tet| volume(&template, &[tet]));
        let largest = volumes.fold(0.0, f64::max);
        assert!(largest <= limit, "{part}: {}", largest / limit);
        let angles = template.tets.iter().map(|tet| {
            let corners = tet.vertices.map(|v| template.vertices[v as usize]);
            TetMeasures::of(corners).min_dihedral().to_degrees()
        });
        let least = angles.fold(180.0, f64::min);
        assert!(least > 20.0 && done.past == 0, "{part}: {least} {done:?}");
    }
}

/// A pyramid over a regular pentagon in a mirror plane: without a vertex in the middle of that, elements have small angles.
#[test]
fn vertices_come_on_mirror_planes() {
    let corner = |i: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 5.0).sin_cos();
        DVec3::new(cos, 0.0, sin)
    };
    let mut vertices: Vec<DVec3> = (0..5).map(corner).collect();
    vertices.push(DVec3::Y);
    let t = |a, b, c| Triangle {
        vertices: [a, b, c],
        marker: 0,
        front: OUTSIDE,
        back: 7,
    };
    let wall = (1..4).map(|i| t(0, i, i + 1));
    let sides = (0..5).map(|i| t(5, (i + 1) % 5, i));
    let mut template = Template {
        vertices,
        triangles: wall.chain(sides).collect(),
        tets: (1..4)
            .map(|i| Tet {
                vertices: [0, i + 1, i, 5],
                region: 7,
            })
            .collect(),
        ..Template::default()
    };
    let mirror = Isometry::reflection(0, 1);
    template.gluings = vec![Gluing::mirror("wall-a", 0, mirror, 0..5, 0..3)];
    let whole = volume(&template, &template.tets);
    assert!(whole > 0.0);
    let (_, normals) = facets(&template);
    let of_triangle = [0, 0, 0, 3, 4, 5, 6, 7];
    let before = freedoms(&template, &of_triangle, &normals);
    // In no patch, triangles stay but for what a vertex on their edges divides.
    let mut same = template.clone();
    let wish = Wish {
        angle: 45.0,
        radius_edge: 1.4,
        min_dihedral: 42.0,
        max_volume: &FxHashMap::default(),
        scale: 1.0,
        stop: &|| false,
    };
    let kept = freedoms(&template, &of_triangle, &[DVec3::ZERO; 8]);
    let (done, parents) = improve(&mut same, &kept, &wish);
    assert!(done.inserted == 0 || same.triangles == template.triangles);
    assert!(parents.is_empty());

    let (done, parents) = improve(&mut template, &before, &wish);
    assert!(done.inserted > 0 && !parents.is_empty(), "{done:?}");
    assert_eq!(template.triangles.len(), 8 + parents.len());
    assert!((volume(&template, &template.tets) - whole).abs() < 1e-12);
    assert!(template.tets.iter().all(|t| volume(&template, &[*t]) > 0.0));
    let wall = &template.gluings[0];
    let area = |t: u32| {
        let [a, b, c] = template.triangles[t as usize]
            .vertices
            .map(|v| template.vertices[v as usize]);
        0.5 * (b - a).cross(c - a).length()
    };
    // All of the wall and nothing else is glued to itself, and is in the plane.
    assert!(wall.triangle_pairs.len() > 1 && wall.triangle_pairs.is_sorted());
    let all: f64 = wall.triangle_pairs.iter().map(|p| area(p[0])).sum();
    let pentagon = 2.5 * (0.4 * std::f64::consts::PI).sin();
    assert!((all - pentagon).abs() < 1e-12, "{all}");
    let mut corners: Vec<u32> = wall
        .triangle_pairs
        .iter()
        .flat_map(|p| template.triangles[p[0] as usize].vertices)
        .collect();
    corners.sort_unstable();
    corners.dedup();
    assert!(wall.vertices_here().eq(corners.iter().copied()));
    assert!(
        corners
            .iter()
            .all(|&v| template.vertices[v as usize].y == 0.0)
    );
}

/// Two regions of two tetrahedra each around an edge of length 8, which are a sector of 150 degrees with a radius of 1, and their surface.
fn sector() -> Template {
    let mut template = ring(5, 4.0);
    for (p, angle) in template.vertices[2..]
        .iter_mut()
        .zip([0.0_f64, 40.0, 80.0, 115.0, 150.0])
    {
        let (sin, cos) = angle.to_radians().sin_cos();
        *p = DVec3::new(cos, sin, 0.0);
    }
    template.tets.truncate(4);
    template.tets[2..].iter_mut().for_each(|t| t.region = 8);
    let mut triangles: Vec<Triangle> = Vec::new();
    for (vertices, region) in faces_of(&template) {
        let known = triangles
            .iter_mut()
            .find(|t| sorted(t.vertices) == sorted(vertices));
        match known {
            Some(triangle) => triangle.front = region,
            None => triangles.push(Triangle {
                vertices,
                marker: 0,
                front: OUTSIDE,
                back: region,
            }),
        }
    }
    triangles.retain(|t| t.front != t.back);
    template.triangles = triangles;
    template
}

/// All faces of tetrahedra, which run counter-clockwise seen from outside of them, with their regions.
fn faces_of(template: &Template) -> Vec<([u32; 3], u32)> {
    let faces = |t: &Tet| FACES.map(|f| (f.map(|i| t.vertices[i]), t.region));
    template.tets.iter().flat_map(faces).collect()
}

/// Area of the triangles of each facet.
fn areas(template: &Template, parents: &[u32], facets: usize) -> Vec<f64> {
    let mut areas = vec![0.0; facets];
    for (i, t) in template.triangles.iter().enumerate() {
        let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
        let facet = i.checked_sub(facets).map_or(i, |new| parents[new] as usize);
        areas[facet] += 0.5 * (b - a).cross(c - a).length();
    }
    areas
}

#[test]
fn vertices_come_on_edges_of_the_surface() {
    let wish = Wish {
        angle: 30.0,
        radius_edge: 1.4,
        min_dihedral: 10.0,
        max_volume: &FxHashMap::default(),
        scale: 1.0,
        stop: &|| false,
    };
    let before = sector();
    let (of_triangle, normals) = facets(&before);
    let count = before.triangles.len();
    let is_at_edge = |t: &Triangle| t.vertices.contains(&0) && t.vertices.contains(&1);
    assert_eq!(before.triangles.iter().filter(|t| is_at_edge(t)).count(), 3);
    let run = |template: &mut Template, slope: f64, kept: &[u32]| {
        let flats = Flats {
            of_triangle: &of_triangle,
            normals: &normals,
            slopes: &vec![slope; count],
            fixed: &[],
            kept,
            straight: 1e-12,
            curved: None,
        };
        let freedoms = Freedoms::new((&*template, 0), &flats);
        improve(template, &freedoms, &wish)
    };
    // In flat facets, and where it is only the edges that may be divided.
    for slope in [0.0, 0.1] {
        let mut template = before.clone();
        let (done, parents) = run(&mut template, slope, &[]);
        assert!(done.inserted > 0, "{done:?}");
        assert!(!template.triangles.iter().any(is_at_edge));
        assert!(
            template.vertices[7..]
                .iter()
                .any(|p| p.truncate() == DVec2::ZERO)
        );
        for region in [7, 8] {
            let of = |t: &Template| -> Vec<Tet> {
                t.tets
                    .iter()
                    .copied()
                    .filter(|t| t.region == region)
                    .collect()
            };
            let volumes = [&before, &template].map(|t| volume(t, &of(t)));
            assert!((volumes[0] - volumes[1]).abs() < 1e-12, "{volumes:?}");
        }
        let areas = [
            areas(&before, &[], count),
            areas(&template, &parents, count),
        ];
        assert!(
            areas[0]
                .iter()
                .zip(&areas[1])
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        // Triangles are the faces between regions, all of them, and the right way around.
        let mut faces = faces_of(&template);
        let mut take = |vertices: [u32; 3], region: u32| {
            let is_it = |f: &([u32; 3], u32)| sorted(f.0) == sorted(vertices) && f.1 == region;
            let place = faces.iter().position(is_it).expect("a face");
            faces.remove(place).0
        };
        for t in &template.triangles {
            let mut run = take(t.vertices, t.back);
            while run[0] != t.vertices[0] {
                run.rotate_left(1);
            }
            assert_eq!(run, t.vertices);
            if t.front != OUTSIDE {
                take(t.vertices, t.front);
            }
        }
        let inside = faces.iter().map(|f| sorted(f.0)).collect::<FxHashSet<_>>();
        assert_eq!(faces.len(), 2 * inside.len());
    }
    // Not where one of the triangles is to stay, and not on the axis.
    let at_edge = before.triangles.iter().position(is_at_edge);
    let mut kept = before.clone();
    run(&mut kept, 0.0, &[at_edge.expect("a triangle") as u32]);
    let mut axis = before.clone();
    axis.axis = vec![0, 1];
    run(&mut axis, 0.0, &[]);
    for same in [kept, axis] {
        assert_eq!(same.triangles.iter().filter(|t| is_at_edge(t)).count(), 3);
    }
}

/// A triangular prism from z = 0 to 1 with a vertex in the middle of its bottom and one on an upright edge.
#[test]
fn vertices_stay_on_edges_and_facets() {
    let corner = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let mut vertices: Vec<DVec3> = corner.to_vec();
    vertices.extend(corner.map(|p| p + DVec3::Z));
    vertices.push(DVec3::new(0.05, 0.05, 0.0));
    vertices.push(DVec3::new(0.0, 0.0, 0.9));
    let t = |a, b, c, marker| Triangle {
        vertices: [a, b, c],
        marker,
        front: OUTSIDE,
        back: 1,
    };
    // Bottom fan about 6, top, sides; 7 divides the edge from 0 to 3.
    let triangles = vec![
        t(0, 6, 1, 0),
        t(1, 6, 2, 0),
        t(2, 6, 0, 0),
        t(3, 4, 5, 1),
        t(0, 1, 7, 2),
        t(1, 4, 7, 2),
        t(4, 3, 7, 2),
        t(1, 2, 5, 3),
        t(1, 5, 4, 3),
        t(2, 0, 7, 4),
        t(2, 7, 5, 4),
        t(5, 7, 3, 4),
    ];
    let of_triangle: Vec<u32> = triangles.iter().map(|t| t.marker).collect();
    let slope = DVec3::new(1.0, 1.0, 0.0).normalize();
    let normals = [-DVec3::Z, DVec3::Z, -DVec3::Y, slope, -DVec3::X];
    let template = Template {
        vertices,
        triangles,
        ..Template::default()
    };
    let freedoms = freedoms(&template, &of_triangle, &normals);
    for v in 0..6 {
        assert_eq!(freedoms.of(v), Freedom::Fixed, "{v}");
    }
    let Freedom::Plane(a, b) = freedoms.of(6) else {
        panic!("{:?}", freedoms.of(6));
    };
    assert!(a.z == 0.0 && b.z == 0.0 && a.dot(b).abs() < 1e-15);
    let Freedom::Line(d) = freedoms.of(7) else {
        panic!("{:?}", freedoms.of(7));
    };
    assert!(d.x == 0.0 && d.y == 0.0 && d.z.abs() == 1.0);
}

#[test]
fn partners_on_a_seam_move_as_one() {
    // A quarter of an octahedron-like body about z: low face in y = 0, high face in x = 0, both with a
    // vertex inside that is too near to one side.
    let low = DVec3::new(0.2, 0.0, 0.1);
    let rotation = Isometry::rotation(1, 4);
    let vertices = vec![
        DVec3::NEG_Z,
        DVec3::Z,
        DVec3::X,
        DVec3::Y,
        low,
        rotation.apply(low),
    ];
    let tet = |vertices| Tet {
        vertices,
        region: 1,
    };
    let mut template = Template {
        vertices,
        tets: vec![
            tet([0, 4, 5, 1]),
            tet([0, 2, 5, 4]),
            tet([1, 2, 4, 5]),
            tet([0, 2, 3, 5]),
            tet([1, 2, 5, 3]),
        ],
        ..Template::default()
    };
    let whole = 1.0 / 3.0;
    assert!((volume(&template, &template.tets) - whole).abs() < 1e-15);
    let face = |a, b, c| Triangle {
        vertices: [a, b, c],
        marker: 0,
        front: OUTSIDE,
        back: 1,
    };
    template.triangles = vec![
        face(0, 2, 4),
        face(0, 4, 1),
        face(1, 4, 2),
        face(0, 5, 3),
        face(0, 1, 5),
        face(1, 3, 5),
        face(0, 3, 2),
        face(1, 2, 3),
    ];
    template.gluings = vec![Gluing::seam(
        "seam",
        0,
        rotation,
        [[0, 0], [1, 1], [2, 3], [4, 5]],
        [[0, 3], [1, 4], [2, 5]],
    )];
    template.axis = vec![0, 1];
    let outer = |d: DVec3| d.normalize();
    let normals = [
        -DVec3::Y,
        -DVec3::X,
        outer(DVec3::new(1.0, 1.0, -1.0)),
        outer(DVec3::ONE),
    ];
    let freedoms = freedoms(&template, &[0, 0, 0, 1, 1, 1, 2, 3], &normals);
    assert_eq!(freedoms.mover(5), 4);
    assert!(matches!(freedoms.of(4), Freedom::Plane(..)));
    assert_eq!(freedoms.of(2), Freedom::Fixed);
    let (done, _) = improve(
        &mut template,
        &freedoms,
        &Wish {
            angle: 40.0,
            radius_edge: 1.4,
            min_dihedral: 10.0,
            max_volume: &FxHashMap::default(),
            scale: 1.0,
            stop: &|| false,
        },
    );
    assert!(done.moved > 0 && done.bad > 0, "{done:?}");
    let moved = template.vertices[4];
    assert_ne!(moved, low);
    assert_eq!(moved.y, 0.0);
    assert_eq!(template.vertices[5], rotation.apply(moved));
    assert!((volume(&template, &template.tets) - whole).abs() < 1e-12);
    for t in &template.tets {
        let m = TetMeasures::of(t.vertices.map(|v| template.vertices[v as usize]));
        assert!(m.min_dihedral().to_degrees() > 5.0);
    }
}

/// Cubes of six tetrahedra each, `n` along an edge, their inner corners somewhere else.
fn shaken_cubes(n: u32) -> Template {
    let mut state = 1_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let inner = |i: u32| i > 0 && i < n;
    let number = |[x, y, z]: [u32; 3]| x + (n + 1) * (y + (n + 1) * z);
    let mut template = Template::default();
    for z in 0..=n {
        for y in 0..=n {
            for x in 0..=n {
                let p = [x, y, z];
                let moved = p.into_iter().all(inner);
                template.vertices.push(DVec3::from_array(
                    p.map(|i| f64::from(i) + if moved { 0.6 * random() } else { 0.0 }),
                ));
                for [a, b, c] in [
                    [0, 1, 2],
                    [1, 2, 0],
                    [2, 0, 1],
                    [0, 2, 1],
                    [2, 1, 0],
                    [1, 0, 2],
                ] {
                    if p.into_iter().any(|i| i == n) {
                        continue;
                    }
                    // From one corner of the cube to the opposite one, axis by axis.
                    let mut corner = p;
                    let mut vertices = [number(corner); 4];
                    for (vertex, axis) in vertices[1..].iter_mut().zip([a, b, c]) {
                        corner[axis] += 1;
                        *vertex = number(corner);
                    }
                    if (b + 3 - a) % 3 == 2 {
                        vertices.swap(1, 2);
                    }
                    let region = 1;
                    template.tets.push(Tet { vertices, region });
                }
            }
        }
    }
    template
}

/// Does something with so many threads at hand.
fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().unwrap().install(work)
}

/// Cubes that are shaken, and what keeps their sides.
fn kept_cubes(n: u32) -> (Template, Freedoms) {
    let cubes = shaken_cubes(n);
    let fixed: Vec<u32> = (0..cubes.vertices.len() as u32)
        .filter(|&v| {
            let p = cubes.vertices[v as usize];
            p.to_array().iter().any(|&x| x == 0.0 || x == f64::from(n))
        })
        .collect();
    let freedoms = Freedoms::new(
        (&cubes, 0),
        &Flats {
            of_triangle: &[],
            normals: &[],
            slopes: &[],
            fixed: &fixed,
            kept: &[],
            straight: 0.0,
            curved: None,
        },
    );
    (cubes, freedoms)
}

#[test]
fn threads_make_no_difference() {
    let (cubes, freedoms) = kept_cubes(26);
    let wish = Wish {
        angle: 40.0,
        radius_edge: 1.2,
        min_dihedral: 25.0,
        max_volume: &FxHashMap::default(),
        scale: 1.0,
        stop: &|| false,
    };
    let mut one = cubes.clone();
    let (done, _) = on_threads(1, || improve(&mut one, &freedoms, &wish));
    assert!(
        done.moved > 1000 && done.flipped > 1000 && done.inserted > 0,
        "{done:?}"
    );
    assert!((volume(&one, &one.tets) - 26_f64.powi(3)).abs() < 1e-6);
    for threads in [2, 3] {
        let mut several = cubes.clone();
        let (again, _) = on_threads(threads, || improve(&mut several, &freedoms, &wish));
        assert_eq!(again, done);
        assert!(several.vertices == one.vertices && several.tets == one.tets);
    }
}

#[test]
fn good_elements_get_better_where_bad_ones_are_gone() {
    let (mut cubes, freedoms) = kept_cubes(12);
    let wish = Wish {
        angle: 20.0,
        radius_edge: 2.0,
        min_dihedral: 5.0,
        max_volume: &FxHashMap::default(),
        scale: 1.0,
        stop: &|| false,
    };
    let (done, _) = improve(&mut cubes, &freedoms, &wish);
    // What is told is about the angle asked for.
    assert!(done.bad > 100 && done.left == 0, "{done:?}");
    let angles = cubes.tets.iter().map(|t| {
        let corners = t.vertices.map(|v| cubes.vertices[v as usize]);
        TetMeasures::of(corners).min_dihedral().to_degrees()
    });
    let mut angles: Vec<f64> = angles.collect();
    angles.sort_unstable_by(f64::total_cmp);
    // Where it ends with those, a hundredth is below 21 degrees.
    let percentile = angles[angles.len() / 100];
    assert!(percentile > 23.0 && angles[0] >= 20.0, "{percentile}");
}

#[test]
fn improvement_stops_when_it_is_told_to() {
    let (cubes, freedoms) = kept_cubes(26);
    let run = |stop: &(dyn Fn() -> bool + Sync)| {
        let wish = Wish {
            angle: 40.0,
            radius_edge: 1.2,
            min_dihedral: 25.0,
            max_volume: &FxHashMap::default(),
            scale: 1.0,
            stop,
        };
        let mut made = cubes.clone();
        let (done, _) = improve(&mut made, &freedoms, &wish);
        let corners = (made.tets.iter()).map(|t| t.vertices.map(|v| made.vertices[v as usize]));
        let whole: f64 = corners.map(|[a, b, c, d]| tet_volume(a, b, c, d)).sum();
        assert!((whole - 26_f64.powi(3)).abs() < 1e-6);
        (done, made)
    };
    let (whole, _) = run(&|| false);
    assert!(!whole.stopped, "{whole:?}");
    let (none, same) = run(&|| true);
    assert!(none.stopped && none.left == none.bad, "{none:?}");
    assert_eq!(none.moved + none.flipped + none.inserted, 0);
    assert_eq!(same.vertices, cubes.vertices);
    // In the middle of the first round.
    let asked = AtomicUsize::new(0);
    let (some, _) = run(&|| asked.fetch_add(1, Ordering::Relaxed) > 2000);
    assert!(some.stopped && some.moved > 0, "{some:?}");
    assert!(whole.left < some.left, "{some:?}");
}

#[test]
fn places_beside_narrow_triangles_are_in_the_plane_of_their_facet() {
    // A narrow triangle that leans from its facet by as much as that is uneven; its circumscribed circle has a radius of 125.
    let uneven = 1e-5;
    let template = Template {
        vertices: vec![
            DVec3::ZERO,
            DVec3::new(0.5, 1e-3, uneven),
            DVec3::X,
            DVec3::new(0.5, 0.3, 1.0),
        ],
        triangles: vec![Triangle {
            vertices: [0, 1, 2],
            marker: 0,
            front: OUTSIDE,
            back: 7,
        }],
        tets: vec![Tet {
            vertices: [0, 1, 2, 3],
            region: 7,
        }],
        ..Template::default()
    };
    let mut freedoms = freedoms(&template, &[0], &[DVec3::Z]);
    let goal = Goal::new(20.0, 1.4, 10.0);
    let limits = FxHashMap::default();
    let mut mesh = Mesh::of_template(&template, 1.0, goal, &limits);
    mesh.set_surface(freedoms.take_surface());
    let support = Support::triangle(&mesh, &freedoms, ([0, 1, 2], 0)).unwrap();
    let places: Vec<DVec3> = support.places(&mesh).collect();
    assert!(places.iter().any(|p| p.y < -100.0), "{places:?}");
    assert!(places.iter().all(|p| p.z.abs() <= uneven), "{places:?}");
}
