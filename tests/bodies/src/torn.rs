//! Bodies as exporters write them that make each face's triangles apart: corners of one place that differ, corners on
//! edges, curves divided differently on either side, facets left out or written twice.

use crate::facets::{Facet, Point};
use crate::{
    Body, Dice, Face, Gear, HelicalGear, Impeller, Placement, Prism, Screw, Tessellation,
    TwistedBar,
};
use glam::DVec3;

/// A torn export and what is known of it.
pub struct Torn {
    /// The triangles, as the file has them.
    pub facets: Vec<Facet>,
    /// The same before it was torn.
    pub whole: Vec<Facet>,
    /// Volume of the whole body.
    pub volume: f64,
    /// Its area.
    pub area: f64,
    /// Highest order of a rotation of it.
    pub order: u32,
    /// The farthest that a corner is from its place.
    pub moved: f64,
    /// Facets left out.
    pub dropped: usize,
    /// Facets written twice.
    pub doubled: usize,
    /// Corners put on edges of one side only.
    pub junctions: usize,
    /// What the body is, in a few words.
    pub name: String,
}

/// The torn export of a seed.
pub fn torn(seed: u64) -> Torn {
    let mut dice = Dice::new(seed ^ 0x746f_726e);
    let (name, mut body) = body(&mut dice);
    let mut drawn = dice.chance(0.15).then(|| drum(&mut dice));
    let placement = Placement {
        rotate: Some(dice.seed()),
        scale: dice.log_between(0.01, 100.0),
        jitter: 0.0,
    };
    let name = match &mut drawn {
        Some((whole, drawn)) => {
            placement.apply(drawn);
            body = whole.clone();
            "drum".to_owned()
        }
        None => name,
    };
    placement.apply(&mut body);
    let drawn = drawn.map_or_else(|| body.clone(), |(_, drawn)| drawn);
    let sagitta = sagitta(&body);
    let mut torn = Torn {
        facets: facets(&drawn),
        whole: facets(&body),
        volume: body.total_volume(),
        area: body.boundary_area(),
        order: body.order,
        // Twice the sagitta of the coarsest rim, of 16 sides.
        moved: if name == "drum" {
            0.04 * placement.scale
        } else {
            0.0
        },
        dropped: 0,
        doubled: 0,
        junctions: 0,
        name,
    };
    if dice.chance(0.4) {
        torn.put_on_edges(sagitta * dice.pick(&[0.0, 0.0, 0.5]), &mut dice);
    }
    if dice.chance(0.3) {
        torn.double(&mut dice);
    }
    match dice.below(10) {
        0..3 => torn.move_corners(1e-6 * size(&body), &mut dice),
        3..8 => torn.move_corners(sagitta * dice.between(0.0, 1.0), &mut dice),
        _ => {}
    }
    if dice.chance(0.15) {
        torn.drop(&mut dice);
    }
    torn
}

/// A body, mostly with facets that stand for smooth surfaces.
fn body(dice: &mut Dice) -> (String, Body) {
    let order = dice.integer(3, 9) as u32;
    let tessellation = dice.pick(&[Tessellation::Symmetric, Tessellation::Asymmetric]);
    let bore = dice.pick(&[0.0, 0.3]);
    match dice.below(8) {
        0 | 1 => {
            let order = dice.integer(16, 72) as u32;
            let prism = Prism {
                order,
                height: dice.between(0.2, 2.0),
                bore,
                tessellation,
                ..Prism::default()
            };
            (format!("prism of {order} sides"), prism.build())
        }
        2 => {
            let gear = Gear {
                order: 2 * order,
                bore,
                tessellation,
                ..Gear::default()
            };
            (format!("gear of {} teeth", 2 * order), gear.build())
        }
        3 => {
            let impeller = Impeller {
                order,
                bore,
                layers: dice.integer(3, 12) as u32,
                tessellation,
                ..Impeller::default()
            };
            (format!("impeller of {order}"), impeller.build())
        }
        4 => {
            let gear = HelicalGear {
                order: 2 * order,
                radius: 1.0,
                bore,
                height: 0.6,
                twist: 0.4,
                layers: dice.integer(3, 9) as u32,
            };
            (format!("helical gear of {}", 2 * order), gear.build())
        }
        5 => {
            let screw = Screw {
                order: dice.integer(1, 4) as u32,
                radius: 1.0,
                bore,
                coating: 0.0,
                height: 1.0,
                twist: 3.0,
                layers: dice.integer(10, 24) as u32,
                facets: dice.integer(24, 60) as u32,
                drawing: dice.seed(),
            };
            (format!("screw of {}", screw.order), screw.build())
        }
        6 => {
            let bar = TwistedBar {
                radius: 1.0,
                aspect: 0.7,
                bore: 0.0,
                height: 2.0,
                twist: 1.2,
                layers: dice.integer(6, 20) as u32,
            };
            ("twisted bar".to_owned(), bar.build())
        }
        _ => {
            let prism = Prism {
                order,
                bore,
                tessellation,
                ..Prism::default()
            };
            (format!("prism of {order} sides"), prism.build())
        }
    }
}

/// A drum, and the same whose rims are divided otherwise by its ends than by its wall: each has corners on the circle.
fn drum(dice: &mut Dice) -> (Body, Body) {
    let [whole, ends] = [0, 1].map(|_| {
        let order = dice.integer(16, 60) as u32;
        Prism {
            order,
            ..Prism::default()
        }
        .build()
    });
    let is_end = |body: &Body, t: [u32; 3]| {
        let z = t.map(|v| body.vertices[v as usize].z);
        z[0] == z[1] && z[1] == z[2]
    };
    let mut drawn = whole.clone();
    drawn.faces.retain(|f| !is_end(&whole, f.vertices));
    let shift = drawn.vertices.len() as u32;
    drawn.vertices.extend(&ends.vertices);
    for face in ends.faces.iter().filter(|f| is_end(&ends, f.vertices)) {
        let vertices = face.vertices.map(|v| v + shift);
        drawn.faces.push(Face { vertices, ..*face });
    }
    (whole, drawn)
}

fn facets(body: &Body) -> Vec<Facet> {
    let corners = body.solid(0);
    corners
        .map(|t| t.map(|v| body.vertices[v as usize].to_array()))
        .collect()
}

fn size(body: &Body) -> f64 {
    let (low, high) = body
        .vertices
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| {
            (low.min(p), high.max(p))
        });
    (high - low).length()
}

/// The largest sagitta of the facets that turn by less than 30 degrees against each other, or what digits are lost
/// where there are none.
fn sagitta(body: &Body) -> f64 {
    let triangles: Vec<[u32; 3]> = body.solid(0).collect();
    let point = |v: u32| body.vertices[v as usize];
    let normal = |t: [u32; 3]| {
        let [a, b, c] = t.map(point);
        (b - a).cross(c - a)
    };
    let mut beyond = std::collections::BTreeMap::new();
    for &t in &triangles {
        for i in 0..3 {
            beyond.insert((t[i], t[(i + 1) % 3]), t);
        }
    }
    let mut largest = 1e-6 * size(body);
    for (&(a, b), &t) in &beyond {
        let Some(&s) = beyond.get(&(b, a)) else {
            continue;
        };
        let angle = normal(t).angle_between(normal(s));
        if angle <= 30.0_f64.to_radians() {
            let base = point(a).distance(point(b));
            let width = normal(t).length().min(normal(s).length()) / base;
            largest = largest.max(0.125 * angle * width);
        }
    }
    largest
}

impl Torn {
    /// Moves corners of triangles on one side of a plane through the body, or of a share of all, each by itself.
    fn move_corners(&mut self, by: f64, dice: &mut Dice) {
        let some = self.facets[dice.below(self.facets.len())][0];
        let normal = direction(dice);
        let one_side = dice.chance(0.5);
        let share = dice.pick(&[0.02, 0.2, 1.0]);
        for facet in &mut self.facets {
            for corner in facet {
                let beyond = (DVec3::from(*corner) - DVec3::from(some)).dot(normal) > 0.0;
                if (one_side && !beyond) || !dice.chance(share) {
                    continue;
                }
                let by = by * dice.between(0.0, 1.0);
                self.moved = self.moved.max(by);
                *corner = (DVec3::from(*corner) + by * direction(dice)).to_array();
            }
        }
    }

    /// Divides triangles at a point of one edge, off it by some length, and not what is beyond that edge. A point
    /// that is not on a flat face is off it already.
    fn put_on_edges(&mut self, off: f64, dice: &mut Dice) {
        let count = dice.integer(1, 12);
        for _ in 0..count {
            let i = dice.below(self.facets.len());
            let [a, b, c]: [Point; 3] = self.facets[i];
            let along = dice.between(0.2, 0.8);
            let on = DVec3::from(a).lerp(DVec3::from(b), along);
            let by = off * dice.between(0.0, 1.0);
            let middle = (on + by * direction(dice)).to_array();
            self.moved = self.moved.max(by);
            self.facets[i] = [a, middle, c];
            self.facets.push([middle, b, c]);
            self.junctions += 1;
        }
    }

    /// Writes some facets twice, some of them from the other side as well.
    fn double(&mut self, dice: &mut Dice) {
        for _ in 0..dice.integer(1, 6) {
            let [a, b, c] = self.facets[dice.below(self.facets.len())];
            self.facets.push([a, b, c]);
            self.doubled += 1;
            if dice.chance(0.3) {
                self.facets.push([a, b, c]);
                self.facets.push([a, c, b]);
            }
        }
    }

    /// Leaves out some facets.
    fn drop(&mut self, dice: &mut Dice) {
        for _ in 0..dice.integer(1, 3) {
            let i = dice.below(self.facets.len());
            self.facets.swap_remove(i);
            self.dropped += 1;
        }
    }
}

fn direction(dice: &mut Dice) -> DVec3 {
    loop {
        let v = DVec3::new(dice.signed(), dice.signed(), dice.signed());
        if (0.1..=1.0).contains(&v.length()) {
            return v.normalize();
        }
    }
}
