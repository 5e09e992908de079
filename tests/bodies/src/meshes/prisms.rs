//! Meshes for tests: structured prisms as wedges, and assembled by welding placed copies.

use super::tets::{FACES, is_inverted};
use glam::DVec3;
use std::collections::BTreeMap;
use tmesh::{
    Axis, Document, Frame, Gluing, Group, Instance, Isometry, Kind, OUTSIDE, Promise, Region,
    Source, Symmetry, Template, Tet, Triangle,
};

/// Radial, angular and axial cells of a wedge.
const RINGS: usize = 3;
const SECTORS: usize = 2;
const LAYERS: usize = 2;

/// An n-gonal prism of radius 3 and height 2 about z, core (region 1) within radius 1, shell (region
/// 2) around it, as one wedge with mirror walls or with a seam, and all its instances.
pub fn wedge(n: u32, mirror: bool) -> Document {
    let turn = Isometry::rotation(1, if mirror { 2 * n } else { n });
    // The middle of a half turn's chord is the axis: a corner instead.
    let half_turn = n == 2 && !mirror;
    let turn_of = |n: u32| Isometry::rotation(1, n);
    let mut vertices = Vec::new();
    let per_layer = 1 + RINGS * (SECTORS + 1);
    for k in 0..=LAYERS {
        let z = k as f64 - 0.25;
        vertices.push(DVec3::new(0.0, 0.0, z));
        for i in 1..=RINGS {
            let low = DVec3::new(i as f64, 0.0, z);
            let high = turn.apply(low);
            vertices.push(low);
            vertices.push(match half_turn {
                true => turn_of(4).apply(low),
                false => low.midpoint(high),
            });
            vertices.push(high);
        }
    }
    let at = |i: usize, j: usize| {
        if i == 0 {
            0
        } else {
            1 + (i - 1) * (SECTORS + 1) + j
        }
    };
    let mut tets = Vec::new();
    for k in 0..LAYERS {
        for j in 0..SECTORS {
            prism(
                &mut tets,
                [at(0, 0), at(1, j), at(1, j + 1)],
                k,
                per_layer,
                1,
            );
            for i in 1..RINGS {
                prism(
                    &mut tets,
                    [at(i, j), at(i + 1, j), at(i + 1, j + 1)],
                    k,
                    per_layer,
                    2,
                );
                prism(
                    &mut tets,
                    [at(i, j), at(i + 1, j + 1), at(i, j + 1)],
                    k,
                    per_layer,
                    2,
                );
            }
        }
    }
    for t in &mut tets {
        orient(t, &vertices);
    }
    let triangles = skin(&tets);
    let on = |j: usize| -> Vec<u32> {
        let ids = (0..=LAYERS).flat_map(|k| (0..=RINGS).map(move |i| (k * per_layer, i)));
        ids.map(|(base, i)| (base + at(i, j)) as u32).collect()
    };
    let (low, high) = (on(0), on(SECTORS));
    let faces = |on: &[u32]| -> Vec<u32> {
        let inside = |t: &Triangle| t.vertices.iter().all(|v| on.contains(v));
        (0..triangles.len() as u32)
            .filter(|&t| inside(&triangles[t as usize]))
            .collect()
    };
    let (low_faces, high_faces) = (faces(&low), faces(&high));
    let gluings = if mirror {
        let wall = |name: &str, reflection, vertices: &[u32], triangles: &[u32]| {
            let [vertices, triangles] = [vertices, triangles].map(|ids| {
                let mut ids = ids.to_vec();
                ids.sort_unstable();
                ids
            });
            Gluing::mirror(name, 0, reflection, vertices, triangles)
        };
        vec![
            wall("wall-a", Isometry::reflection(0, 1), &low, &low_faces),
            wall("wall-b", Isometry::reflection(1, n), &high, &high_faces),
        ]
    } else {
        let partner = |v: u32| high[low.iter().position(|&l| l == v).unwrap()];
        let image = |t: u32| {
            let mut ids = triangles[t as usize].vertices.map(partner);
            ids.sort();
            *high_faces
                .iter()
                .find(|&&h| {
                    let mut other = triangles[h as usize].vertices;
                    other.sort();
                    other == ids
                })
                .unwrap()
        };
        vec![Gluing::seam(
            "seam",
            0,
            turn,
            low.iter().map(|&v| [v, partner(v)]),
            low_faces.iter().map(|&t| [t, image(t)]),
        )]
    };
    let axis = (0..=LAYERS).map(|k| (k * per_layer) as u32).collect();
    let mut document = Document::single(Template {
        vertices,
        triangles,
        tets,
        gluings,
        axis,
    });
    document.instances = (0..i64::from(n))
        .flat_map(|k| [false, true].map(|m| Isometry::new(k, n, m, false)))
        .filter(|g| mirror || !g.mirrored())
        .map(|isometry| Instance {
            template: 0,
            isometry,
            region_map: 0,
        })
        .collect();
    document.frame = Frame::from_axis(
        DVec3::new(0.4, -7.0, 2.5),
        DVec3::new(1.0, 2.0, -0.7),
        DVec3::new(0.3, 1.0, 0.2),
    )
    .unwrap();
    document.symmetry = Some(Symmetry {
        group: Group::new(if mirror { Kind::Cv } else { Kind::C }, n),
        axis: Axis {
            point: document.frame.origin.to_array(),
            direction: document.frame.rotation.z_axis.to_array(),
        },
        reference: document.frame.rotation.x_axis.to_array(),
        residual: 0.0,
        tolerance: 1e-3,
        axisymmetric: false,
        radius: 3.0,
        regions: Vec::new(),
    });
    // Area of a regular polygon with 2n corners for mirror wedges (the far corners of two halves are
    // at the same distance), n corners for seams.
    let (corners, far) = match (mirror, half_turn) {
        (true, _) => (2 * n, SECTORS),
        (_, true) => (4, 1),
        _ => (n, SECTORS),
    };
    let (_, s) = turn_of(corners).cos_sin();
    let polygon = |r: f64| f64::from(corners) * 0.5 * r * r * s;
    let height = LAYERS as f64;
    let side = vertices_distance(&document, at(RINGS, 0), at(RINGS, far));
    document.regions = vec![
        region(1, "core", polygon(1.0) * height),
        region(2, "shell", (polygon(3.0) - polygon(1.0)) * height),
    ];
    document.source = Some(Source {
        sector_of: None,
        format: "code".to_owned(),
        triangles: 0,
        volume: polygon(3.0) * height,
        boundary_area: 2.0 * polygon(3.0) + f64::from(corners) * side * height,
        precision: 0.0,
    });
    document
}

/// The whole mesh of a wedge document, in world coordinates, with the promise of its symmetry.
pub fn assembled(wedge: &Document) -> Document {
    let template = &wedge.templates[0];
    let mut ids: BTreeMap<[i64; 3], u32> = BTreeMap::new();
    let mut whole = Template::default();
    let on_wall: Vec<u32> = template
        .gluings
        .iter()
        .flat_map(|g| g.triangles_of(0))
        .collect();
    for instance in &wedge.instances {
        let placed = instance.isometry.placed();
        let names: Vec<u32> = template
            .vertices
            .iter()
            .map(|&p| {
                let q = placed.apply(p);
                let key = q.to_array().map(|x| (x * 1e9).round() as i64);
                *ids.entry(key).or_insert_with(|| {
                    whole.vertices.push(wedge.frame.to_world(q));
                    whole.vertices.len() as u32 - 1
                })
            })
            .collect();
        let reversed = instance.isometry.reverses_orientation();
        for t in &template.tets {
            let mut vertices = t.vertices.map(|v| names[v as usize]);
            if reversed {
                vertices.swap(0, 1);
            }
            whole.tets.push(Tet {
                vertices,
                region: t.region,
            });
        }
        for (i, t) in template.triangles.iter().enumerate() {
            if on_wall.contains(&(i as u32)) {
                continue;
            }
            let mut vertices = t.vertices.map(|v| names[v as usize]);
            if reversed {
                vertices.swap(0, 1);
            }
            whole.triangles.push(Triangle { vertices, ..*t });
        }
    }
    let mut document = Document::single(whole);
    document.regions = wedge.regions.clone();
    document.source = wedge.source.clone();
    document.symmetry = wedge.symmetry.clone();
    document.promise = wedge.symmetry.as_ref().map(|symmetry| Promise {
        group: symmetry.group,
        rotation: wedge.frame.rotation.transpose().to_cols_array_2d(),
        origin: wedge.frame.origin.to_array(),
        outside: None,
    });
    document
}

fn vertices_distance(document: &Document, a: usize, b: usize) -> f64 {
    let v = &document.templates[0].vertices;
    v[a].distance(v[b])
}

fn region(id: u32, name: &str, volume: f64) -> Region {
    Region {
        id,
        name: name.to_owned(),
        size: None,
        volume: Some(volume),
    }
}

/// A triangle times layer `k` as three tetrahedra; the diagonals rise from the lower id.
fn prism(tets: &mut Vec<Tet>, mut base: [usize; 3], k: usize, per_layer: usize, region: u32) {
    base.sort();
    let [a, b, c] = base.map(|v| (v + k * per_layer) as u32);
    let [d, e, f] = base.map(|v| (v + (k + 1) * per_layer) as u32);
    for vertices in [[a, b, c, f], [a, b, e, f], [a, d, e, f]] {
        tets.push(Tet { vertices, region });
    }
}

fn orient(tet: &mut Tet, points: &[DVec3]) {
    let [a, b, c, d] = tet.vertices.map(|v| points[v as usize]);
    if is_inverted([a, b, c, d]) {
        tet.vertices.swap(0, 1);
    }
}

/// Boundary and interface triangles of tetrahedra, outward from the higher region.
pub fn skin(tets: &[Tet]) -> Vec<Triangle> {
    let mut faces: BTreeMap<[u32; 3], Vec<([u32; 3], u32)>> = BTreeMap::new();
    for t in tets {
        for f in FACES {
            let face = f.map(|i| t.vertices[i]);
            let mut key = face;
            key.sort();
            faces.entry(key).or_default().push((face, t.region));
        }
    }
    let mut triangles = Vec::new();
    for sides in faces.into_values() {
        let (vertices, back) = sides[0];
        let front = sides.get(1).map_or(OUTSIDE, |s| s.1);
        if front != back {
            triangles.push(Triangle {
                vertices,
                marker: 0,
                front,
                back,
            });
        }
    }
    triangles
}
