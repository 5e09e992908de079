//! Random bladed bodies: hubs with blades that are twisted, swept and leant, in axial, radial and mixed flow, with shrouds and
//! splitters.
//!
//! A body is made of cells of a grid along the radius, around the axis and along the flow, whose nodes are put where the
//! blades go: blades are columns of cells, so that every body is closed, and the same in each sector.

use crate::random_solid::{Facts, Solid, encoding, noise, place, tidy};
use crate::{Body, Dice, Face, Material};
use glam::DVec3;
use std::f64::consts::TAU;
use tmesh::{Group, Kind};

/// Twist from a level of nodes to the next, radians: what chords cut off of a ring is then far less than it is thick.
const TURN: f64 = 0.15;

/// Cells along radius, angle and flow.
struct Grid {
    order: usize,
    /// Cells along the radius, of which the first is the hub.
    rings: usize,
    /// Where columns begin, as shares of a sector; of these the first is a blade.
    columns: Vec<f64>,
    levels: usize,
    /// Whether the hub reaches to the axis.
    solid: bool,
    /// Cells that are filled beside the hub and the blades.
    shroud: Option<[usize; 2]>,
    splitter: Option<Splitter>,
}

/// A second blade between two blades, from a level on and up to a ring.
struct Splitter {
    column: usize,
    from: usize,
    rings: usize,
}

/// Where nodes are.
struct Flow {
    bore: f64,
    /// Radius of the hub where the flow enters, how it widens, and the lengths of blades at both ends.
    hub: f64,
    flare: f64,
    spans: [f64; 2],
    length: f64,
    /// How far blades are leant along the axis, relative to their length.
    rake: f64,
    /// Angles, radians: along the flow, along the flow squared, along the radius, and where both are.
    twist: [f64; 4],
}

impl Flow {
    /// The node of shares of the span (negative in the hub) and of the flow.
    fn at(&self, u: Option<f64>, v: f64, angle: f64) -> DVec3 {
        let hub = self.hub + self.flare * v * v;
        let span = self.spans[0] + (self.spans[1] - self.spans[0]) * v;
        let (radius, up) = match u {
            Some(u) => (hub + u * span, u),
            None => (self.bore, 0.0),
        };
        let [a, b, c, d] = self.twist;
        let angle = angle + a * v + b * v * v + c * up + d * up * v;
        let z = self.length * v + self.rake * up * span;
        DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), z)
    }

    /// The largest twist between the ends.
    fn turn(&self) -> f64 {
        self.twist.iter().map(|a| a.abs()).sum()
    }
}

/// The bladed body of a seed.
pub fn bladed(seed: u64) -> Solid {
    let mut dice = Dice::new(seed);
    let order = dice.integer(2, 24);
    let mut features = Vec::new();
    let flow = flow(&mut features, &mut dice);
    let grid = grid(order, &flow, &mut features, &mut dice);
    let mut body = body(&grid, &flow);
    tidy(&mut body);
    let distances = body.vertices.iter().map(|p| p.truncate().length());
    let radius = distances.fold(0.0, f64::max);
    let noise = noise(&body, &mut features, &mut dice);
    let scale = place(&mut body, noise, &mut features, &mut dice);
    let encoding = encoding(&body, noise, &mut dice);
    Solid {
        facts: Facts {
            group: body.group,
            order,
            radius: scale * radius,
            features,
        },
        body,
        encoding,
    }
}

fn flow(features: &mut Vec<String>, dice: &mut Dice) -> Flow {
    let hub = dice.between(0.15, 0.5);
    // Axial, mixed and radial flow.
    let flare = dice.pick(&[0.0, 0.0, 0.15, 0.4]) * dice.between(0.5, 1.0);
    let spans = [dice.between(0.2, 0.6), dice.between(0.1, 0.6)];
    let length = dice.log_between(0.15, 0.8);
    let mut some = |share: f64, name: &str, most: f64| match dice.chance(share) {
        true => {
            let value = most * dice.signed();
            features.push(format!("{name} {value:.2}"));
            value
        }
        false => 0.0,
    };
    let twist = [
        some(0.8, "twist", 1.5),
        some(0.3, "camber", 0.5),
        some(0.4, "sweep", 0.5),
        some(0.4, "washout", 0.6),
    ];
    // Nodes stay in order along the flow: the determinant of (u, v) to (r, z) is positive with this.
    let steepest = 2.0 * flare + (spans[1] - spans[0]).abs();
    let rake = some(0.3, "rake", (0.7 * length / steepest.max(length)).min(0.5));
    features.push(format!("flare {flare:.2}"));
    Flow {
        bore: 0.0,
        hub,
        flare,
        spans,
        length,
        rake,
        twist,
    }
    .bored(dice)
}

impl Flow {
    fn bored(mut self, dice: &mut Dice) -> Self {
        if dice.chance(0.7) {
            self.bore = dice.between(0.2, 0.7) * self.hub;
        }
        self
    }
}

fn grid(order: usize, flow: &Flow, features: &mut Vec<String>, dice: &mut Dice) -> Grid {
    let thickness = dice.between(0.06, 0.3);
    // Chords of a ring cut off little of it.
    let gaps = dice.integer(2, 3).max(28_usize.div_ceil(order));
    let has_splitter = gaps >= 3 && dice.chance(0.3);
    let mut columns = vec![0.0, thickness];
    let middle = gaps / 2;
    let wide = match has_splitter {
        true => (1.0 - 2.0 * thickness) / (gaps as f64 - 1.0),
        false => (1.0 - thickness) / gaps as f64,
    };
    for gap in 0..gaps {
        let is_splitter = has_splitter && gap == middle;
        let width = if is_splitter { thickness } else { wide };
        columns.push(columns[columns.len() - 1] + width);
    }
    columns.pop();
    let levels = dice.integer(2, 4).max((flow.turn() / TURN) as usize);
    let rings = 1 + dice
        .integer(2, 4)
        .max(((flow.twist[2].abs() + flow.twist[3].abs()) / TURN) as usize);
    let splitter = has_splitter.then(|| Splitter {
        column: 1 + middle,
        from: dice.below(levels),
        rings: dice.integer(2, rings - 1),
    });
    let shroud = dice.chance(0.25).then(|| {
        let from = dice.below(levels);
        [from, dice.integer(from + 1, levels)]
    });
    if let Some(splitter) = &splitter {
        features.push(format!("splitters from level {}", splitter.from));
    }
    if shroud.is_some() {
        features.push("shroud".to_owned());
    }
    features.push(format!("blades of {thickness:.2} of a sector"));
    Grid {
        order,
        rings,
        columns,
        levels,
        solid: flow.bore == 0.0,
        shroud,
        splitter,
    }
}

impl Grid {
    fn around(&self) -> usize {
        self.order * self.columns.len()
    }

    /// Whether a cell is filled.
    fn has(&self, [i, j, k]: [usize; 3]) -> bool {
        let column = j % self.columns.len();
        let is_shroud = self
            .shroud
            .is_some_and(|[from, to]| i == self.rings - 1 && (from..to).contains(&k));
        // Below a shroud, so that edges do not touch.
        let is_splitter = (self.splitter.as_ref())
            .is_some_and(|s| column == s.column && k >= s.from && i < s.rings);
        i == 0 || column == 0 || is_shroud || is_splitter
    }

    fn node(&self, [i, j, k]: [usize; 3]) -> u32 {
        let j = if i == 0 && self.solid {
            0
        } else {
            j % self.around()
        };
        ((i * self.around() + j) * (self.levels + 1) + k) as u32
    }
}

fn body(grid: &Grid, flow: &Flow) -> Body {
    let size = [grid.rings, grid.around(), grid.levels];
    let mut vertices = Vec::new();
    for i in 0..=size[0] {
        for j in 0..size[1] {
            let count = grid.columns.len();
            let sector = (j / count) as f64 + grid.columns[j % count];
            let angle = TAU * sector / grid.order as f64;
            let u = i.checked_sub(1).map(|i| i as f64 / (grid.rings - 1) as f64);
            let places = (0..=size[2]).map(|k| k as f64 / grid.levels as f64);
            vertices.extend(places.map(|v| flow.at(u, v, angle)));
        }
    }
    let mut faces = Vec::new();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut ends = size.map(|n| 0..n);
        ends[axis] = if axis == 1 {
            0..size[1]
        } else {
            0..size[axis] + 1
        };
        for i in ends[0].clone() {
            for j in ends[1].clone() {
                for k in ends[2].clone() {
                    let at = [i, j, k];
                    let mut before = at;
                    before[axis] = match (axis, at[axis]) {
                        (1, 0) => size[1] - 1,
                        (_, 0) => usize::MAX,
                        (_, n) => n - 1,
                    };
                    let inside =
                        |cell: [usize; 3]| (cell[axis] < size[axis] && grid.has(cell)).then_some(0);
                    let (front, back) = (inside(at), inside(before));
                    if front == back {
                        continue;
                    }
                    let corner = |du: usize, dv: usize| {
                        let mut node = at;
                        node[u] += du;
                        node[v] += dv;
                        grid.node(node)
                    };
                    let [p, q, r, s] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                    for t in [[p, q, r], [p, r, s]] {
                        if t[0] != t[1] && t[1] != t[2] && t[2] != t[0] {
                            faces.push(Face {
                                vertices: t,
                                front,
                                back,
                            });
                        }
                    }
                }
            }
        }
    }
    Body {
        vertices,
        faces,
        materials: vec![Material {
            name: "rotor".to_owned(),
        }],
        order: grid.order as u32,
        group: Group::new(Kind::C, grid.order as u32),
    }
}
