//! Sectors of all kinds of group: a few tetrahedra, with every kind of wall that there is.

use super::prisms::skin;
use super::tets::is_inverted;
use glam::DVec3;
use tmesh::{
    Axis, Document, Frame, Gluing, Group, Instance, Isometry, Kind, Promise, Region, Symmetry,
    Template, Tet, Triangle,
};

/// The turn from the first wall of a group's sector to the second one.
fn opening(group: Group) -> Isometry {
    let parts = match group.kind {
        Kind::C | Kind::Ch => 1,
        Kind::Cv | Kind::S | Kind::D | Kind::Dh => 2,
        Kind::Dd => 4,
    };
    Isometry::rotation(1, parts * group.order)
}

/// A sector of a prism of radius 2 with a tooth, and all its instances, with the promise of the group.
///
/// It is as high as the whole prism, from -1 to 1, but for groups with a horizontal mirror: there it
/// begins at 0. The tooth (region 2) has no symmetry of its own. The opening of the sector has to be
/// less than half a turn.
pub fn sector(group: Group) -> Document {
    let mut template = Template::default();
    let levels: &[f64] = match group.has_horizontal_mirror() {
        true => &[0.0, 1.0],
        false => &[-1.0, 0.0, 1.0],
    };
    let open = opening(group);
    for &z in levels {
        let low = DVec3::new(2.0, 0.0, z);
        let axis = DVec3::new(0.0, 0.0, z);
        template.vertices.extend([axis, low, open.apply(low)]);
    }
    let turned_over = matches!(group.kind, Kind::D | Kind::Dd);
    if turned_over {
        // The lower half of the second wall is the image of its upper half, to the bit.
        let step = open
            .compose(Isometry::half_turn(0, 1))
            .compose(open.inverse());
        template.vertices[2] = step.apply(template.vertices[8]);
    }
    let top = levels.len() as u32 - 2;
    // Diagonals rise and fall from the axis at z = 0, and lie alike on all walls.
    let mut add = |level: u32, end: u32, region: u32| {
        let [a, b, c] = [0, 1, 2].map(|i| 3 * level + i);
        let [d, e, f] = [0, 1, 2].map(|i| 3 * end + i);
        for vertices in [[a, b, c, f], [a, b, e, f], [a, d, e, f]] {
            template.tets.push(Tet { vertices, region });
        }
    };
    add(top, top + 1, 1);
    if top > 0 {
        add(top, top - 1, 1);
    }
    let [p, q, r] = [3 * top + 1, 3 * top + 2, 3 * top + 5];
    let corners = [p, q, r].map(|v| template.vertices[v as usize]);
    let centre = corners.iter().sum::<DVec3>() / 3.0;
    let tooth = template.vertices.len() as u32;
    let outwards = DVec3::new(1.2, 1.2, 1.0);
    template.vertices.push(centre * outwards);
    template.tets.push(Tet {
        vertices: [p, q, r, tooth],
        region: 2,
    });
    for tet in &mut template.tets {
        let [a, b, c, d] = tet.vertices.map(|v| template.vertices[v as usize]);
        if is_inverted([a, b, c, d]) {
            tet.vertices.swap(0, 1);
        }
    }
    template.triangles = skin(&template.tets);
    template.axis = (0..levels.len() as u32).map(|k| 3 * k).collect();
    template.gluings = gluings(group, &template);
    placed(group, template)
}

/// All instances of a sector.
fn placed(group: Group, template: Template) -> Document {
    let mut document = Document::single(template);
    let instance = |isometry| Instance {
        template: 0,
        isometry,
        region_map: 0,
    };
    document.instances = group.elements().map(instance).collect();
    let origin = DVec3::new(0.4, -7.0, 2.5);
    let (axis, hint) = (DVec3::new(1.0, 2.0, -0.7), DVec3::new(0.3, 1.0, 0.2));
    document.frame = Frame::from_axis(origin, axis, hint).unwrap();
    document.regions = [(1, "prism"), (2, "teeth")]
        .map(|(id, name)| Region {
            id,
            name: name.to_owned(),
            size: None,
            volume: None,
        })
        .to_vec();
    document.symmetry = Some(Symmetry {
        group,
        axis: Axis {
            point: origin.to_array(),
            direction: document.frame.rotation.z_axis.to_array(),
        },
        reference: document.frame.rotation.x_axis.to_array(),
        residual: 0.0,
        tolerance: 1e-3,
        axisymmetric: false,
        radius: 2.0,
        regions: Vec::new(),
    });
    document.promise = Some(Promise {
        group,
        rotation: document.frame.rotation.transpose().to_cols_array_2d(),
        origin: origin.to_array(),
        outside: None,
    });
    document
}

/// The walls of a sector.
fn gluings(group: Group, template: &Template) -> Vec<Gluing> {
    let n = group.order;
    let on = |wall: u32, levels: std::ops::Range<u32>| -> Vec<u32> {
        levels.flat_map(|k| [3 * k, 3 * k + wall]).collect()
    };
    let levels = template.axis.len() as u32;
    let [a, b] = [1, 2].map(|wall| on(wall, 0..levels));
    let glued = |name: &str, step: Isometry, there: &[u32], here: &[u32]| {
        let pairs = Pairs {
            template,
            step,
            there,
            here,
        };
        pairs.gluing(name)
    };
    let mirror = |name: &str, step: Isometry, wall: &[u32]| glued(name, step, wall, wall);
    let half_turn =
        |name: &str, step: Isometry, wall: u32| glued(name, step, &on(wall, 1..3), &on(wall, 0..2));
    let seam = |step: Isometry| glued("seam", step, &a, &b);
    let floor = || mirror("floor", Isometry::FLIP, &[0, 1, 2]);
    let near = |k, n| Isometry::reflection(k, n);
    let over = |k, n| Isometry::half_turn(k, n);
    match group.kind {
        Kind::C => vec![seam(Isometry::rotation(1, n))],
        Kind::S => vec![seam(Isometry::new(1, 2 * n, false, true))],
        Kind::Ch => vec![seam(Isometry::rotation(1, n)), floor()],
        Kind::Cv => vec![mirror("a", near(0, 1), &a), mirror("b", near(1, n), &b)],
        Kind::Dh => vec![
            mirror("a", near(0, 1), &a),
            mirror("b", near(1, n), &b),
            floor(),
        ],
        Kind::D => vec![half_turn("a", over(0, 1), 1), half_turn("b", over(1, n), 2)],
        Kind::Dd => vec![
            mirror("a", near(0, 1), &a),
            half_turn("b", over(1, 2 * n), 2),
        ],
    }
}

/// The vertices of two faces of a template of which a step takes one onto the other.
struct Pairs<'a> {
    template: &'a Template,
    step: Isometry,
    there: &'a [u32],
    here: &'a [u32],
}

impl Pairs<'_> {
    fn gluing(&self, name: &str) -> Gluing {
        let vertices = &self.template.vertices;
        let partner = |v: u32| {
            let image = self.step.apply(vertices[v as usize]);
            let near = |w: &&u32| vertices[**w as usize].distance(image) < 1e-9;
            *self.here.iter().find(near).expect("a partner")
        };
        let triangles = || (0..).zip(&self.template.triangles);
        let sorted = |mut ids: [u32; 3]| {
            ids.sort();
            ids
        };
        let within = |t: &Triangle| t.vertices.iter().all(|v| self.there.contains(v));
        let there = triangles().filter(|t| within(t.1));
        let triangle_pairs = there.map(|(i, t)| {
            let image = sorted(t.vertices.map(partner));
            let here = triangles().find(|h| sorted(h.1.vertices) == image);
            [here.expect("an image").0, i]
        });
        let mut gluing = Gluing {
            name: name.to_owned(),
            other: 0,
            step: self.step,
            vertex_pairs: self.there.iter().map(|&v| [partner(v), v]).collect(),
            triangle_pairs: triangle_pairs.collect(),
        };
        gluing.sort();
        gluing
    }
}
