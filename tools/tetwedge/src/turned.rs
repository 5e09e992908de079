//! Wedges whose walls are glued by half turns and rotary reflections, made in code, and their whole way to a mesh.

use crate::{surfaces, tetrahedralize};
use bodies::wedges::{Grid, name_regions};
use geom::measure::tet_volume;
use glam::DVec3;
use mesher::{Log, Params};

use tmesh::{Document, Gluing, Instance, Isometry, Size, Template, Triangle, Wishes, validate};

/// How a wall of a wedge is glued.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Wall {
    Mirror,
    HalfTurn,
}

/// The wedge of a body of several regions between the angles 0 and half a turn over `parts`, without walls.
fn sector(parts: u32, radii: &[f64]) -> Document {
    let mut document = Grid {
        order: parts,
        mirror: true,
        radii,
        turns: if parts == 1 { 4 } else { 2 },
        heights: &[-0.5, -0.4, 0.0, 0.4, 0.5],
        // The same above as below.
        region: &|i, _, k| 1 + (i as u32 % 2) + 2 * u32::from(k == 0 || k == 3),
    }
    .document();
    name_regions(&mut document);
    document
}

/// The number of the vertex at a place, but for rounding.
fn at(template: &Template, p: DVec3) -> u32 {
    let near = |q: &DVec3| (*q - p).length() < 1e-12;
    template
        .vertices
        .iter()
        .position(near)
        .expect("a vertex there") as u32
}

/// Replaces the triangles `images` by the images of `masters` under a step, and glues them.
fn glue(template: &mut Template, step: Isometry, masters: &[u32], images: &[u32]) -> Gluing {
    assert_eq!(masters.len(), images.len());
    let mut vertex_pairs = Vec::new();
    for (&master, &image) in masters.iter().zip(images) {
        let Triangle {
            vertices,
            marker,
            front,
            back,
        } = template.triangles[master as usize];
        let turned = vertices.map(|v| {
            let p = step.apply(template.vertices[v as usize]);
            let w = at(template, p);
            if w != v {
                template.vertices[w as usize] = p;
            }
            vertex_pairs.push([v, w]);
            w
        });
        let [a, b, c] = turned;
        template.triangles[image as usize] = Triangle {
            vertices: if step.reverses_orientation() {
                [a, b, c]
            } else {
                [a, c, b]
            },
            marker,
            front,
            back,
        };
    }
    // What lies on the axis of a rotary reflection is there and here.
    if !step.mirrored() {
        for &v in &template.axis {
            let w = at(template, step.apply(template.vertices[v as usize]));
            vertex_pairs.push([v, w]);
        }
    }
    vertex_pairs.sort_unstable();
    vertex_pairs.dedup();
    let pairs = masters.iter().zip(images).map(|(&a, &b)| [a, b]);
    Gluing::seam("wall", 0, step, vertex_pairs, pairs)
}

/// A body with walls glued like this at the angles 0 and half a turn over `parts`, and all its copies.
fn walled(parts: u32, walls: [Wall; 2], radii: &[f64]) -> Document {
    let mut document = sector(parts, radii);
    let template = &mut document.templates[0];
    let mirrors = std::mem::take(&mut template.gluings);
    for ((wall, mirror), k) in walls.into_iter().zip(mirrors).zip(0..) {
        if wall == Wall::Mirror {
            template.gluings.push(mirror);
            continue;
        }
        let above = |&t: &u32| {
            let corners = template.triangles[t as usize].vertices;
            corners
                .iter()
                .all(|&v| template.vertices[v as usize].z >= 0.0)
        };
        let (masters, images): (Vec<u32>, Vec<u32>) = mirror.triangles_here().partition(above);
        let step = Isometry::new(k, parts, true, true);
        let mut gluing = glue(template, step, &masters, &images);
        gluing.name = mirror.name;
        template.gluings.push(gluing);
    }
    let both_turn = walls == [Wall::HalfTurn; 2];
    let elements = (0..parts).flat_map(|k| {
        [false, true].map(|mirrored| {
            let flipped = if both_turn { mirrored } else { k % 2 == 1 };
            Isometry::new(i64::from(k), parts, mirrored, flipped)
        })
    });
    place(&mut document, elements);
    document
}

/// A body with the group S_2n: the wall at half a turn over n is the image of the one at 0, turned and reflected.
fn rotary(n: u32, radii: &[f64]) -> Document {
    let mut document = sector(n, radii);
    let template = &mut document.templates[0];
    let mirrors = std::mem::take(&mut template.gluings);
    let [low, high] = [0, 1].map(|i: usize| mirrors[i].triangles_here().collect::<Vec<u32>>());
    let step = Isometry::new(1, 2 * n, false, true);
    let gluing = glue(template, step, &low, &high);
    template.gluings.push(gluing);
    place(
        &mut document,
        (0..2 * n).map(|k| Isometry::new(i64::from(k), 2 * n, false, k % 2 == 1)),
    );
    document
}

fn place(document: &mut Document, elements: impl Iterator<Item = Isometry>) {
    document.instances = elements
        .map(|isometry| Instance {
            template: 0,
            isometry,
            region_map: 0,
        })
        .collect();
}

fn volume(template: &Template) -> f64 {
    let volume = |t: &tmesh::Tet| {
        let [a, b, c, d] = t.vertices.map(|v| template.vertices[v as usize]);
        tet_volume(a, b, c, d)
    };
    template.tets.iter().map(volume).sum()
}

/// Takes a body through both tools, and looks at what they promise.
fn through(mut document: Document, volume_of_wedge: f64) {
    document.wishes = Wishes {
        size: Some(Size::MaxVolume(2e-3)),
        timeout: Some(120.0),
        ..Wishes::default()
    };
    assert_eq!(validate(&document), []);
    let seams = |d: &Document| {
        let gluings = d.templates[0].gluings.iter().filter(|g| g.is_seam(0));
        gluings.map(|g| g.triangle_pairs.len()).collect::<Vec<_>>()
    };
    let before = seams(&document);
    let params = Params::new(&document.wishes);
    let made = surfaces(document, &params, Log::new(&|_| ())).unwrap();
    let settled = made.document;
    let of_seams = made.facts.iter().filter(|fact| fact.contains("seam of"));
    assert_eq!(of_seams.count(), 1, "{:?}", made.facts);
    assert_eq!(validate(&settled), []);
    let after = seams(&settled);
    assert!(
        after.iter().zip(&before).all(|(a, b)| a > b),
        "{after:?} {before:?}"
    );
    let template = &settled.templates[0];
    for gluing in &template.gluings {
        for &[here, there] in &gluing.vertex_pairs {
            let [p, q] = [here, there].map(|v| template.vertices[v as usize]);
            let image = gluing.step.apply(q);
            match here == there {
                // What a step leaves where it is, is there to the last bit but for the wall's direction.
                true => assert!((image - p).length() < 1e-15, "{p} {image}"),
                false => assert_eq!(image, p),
            }
            if here == there && gluing.step.flipped() && gluing.is_seam(0) {
                assert_eq!(p.z, 0.0);
            }
        }
    }
    let done = tetrahedralize(settled, &params, Log::new(&|_| ())).unwrap();
    assert!(done.advice.is_empty(), "{:?}", done.advice);
    assert_eq!(validate(&done.document), []);
    assert_eq!(seams(&done.document), after, "preserved");
    let found = volume(&done.document.templates[0]);
    assert!(
        (found - volume_of_wedge).abs() < 1e-9,
        "{found} {volume_of_wedge}"
    );
}

/// Area of the triangles that make the section of a sector.
fn section(parts: u32, radii: &[f64]) -> f64 {
    let turns = if parts == 1 { 4.0 } else { 2.0 };
    let step = std::f64::consts::PI / f64::from(parts) / turns;
    let of = |r: f64| turns * 0.5 * r * r * step.sin();
    of(radii[radii.len() - 1]) - of(radii[0])
}

const WITH_AXIS: &[f64] = &[0.0, 0.4, 1.0];
const WITH_BORE: &[f64] = &[0.3, 0.6, 1.0];

#[test]
fn half_turns_at_both_walls() {
    for (n, radii) in [
        (2, WITH_AXIS),
        (3, WITH_AXIS),
        (7, WITH_BORE),
        (16, WITH_AXIS),
    ] {
        let document = walled(n, [Wall::HalfTurn; 2], radii);
        assert_eq!(document.templates[0].gluings.len(), 2);
        through(document, section(n, radii));
    }
}

#[test]
fn a_half_turn_beside_a_mirror() {
    for (n, radii) in [(2, WITH_AXIS), (3, WITH_BORE), (7, WITH_AXIS)] {
        let document = walled(2 * n, [Wall::Mirror, Wall::HalfTurn], radii);
        through(document, section(2 * n, radii));
    }
}

#[test]
fn rotary_reflections() {
    for (n, radii) in [
        (1, WITH_BORE),
        (2, WITH_AXIS),
        (4, WITH_AXIS),
        (5, WITH_BORE),
    ] {
        through(rotary(n, radii), section(n, radii));
    }
}
