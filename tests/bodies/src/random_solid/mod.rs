//! Random solids whose symmetry, regions and volumes are known.
//!
//! A solid is made of cells of a grid around an axis ([`grid`]), on which its group ([`group`]) acts by
//! permutation: nodes are displaced ([`form`]) and cells filled ([`filling`]) the same way throughout an
//! orbit. Its cells stay star-shaped, so its surface is a valid piecewise linear complex. Polyhedra within
//! cells ([`inclusions`]) and other triangles for the same shape ([`tessellation`]) keep it one.

mod filling;
mod form;
mod grid;
mod group;
mod inclusions;
mod tessellation;

pub(crate) use tessellation::slender;

use crate::Dice;
use crate::{Body, Encoding, Face, Material, Placement};
use form::Form;
use glam::DVec3;
use grid::Grid;
use group::{KINDS, Motion};
use tmesh::{Group, Kind};

/// A random body, where it is, and what is known of it.
pub struct Solid {
    /// The body, placed.
    pub body: Body,
    /// File format it is to be read from.
    pub encoding: Encoding,
    /// What is known of it.
    pub facts: Facts,
}

impl Solid {
    /// A body with what it has of features; `radius` is the largest distance from its axis as it is placed.
    pub(crate) fn new(body: Body, encoding: Encoding, radius: f64, features: Vec<String>) -> Self {
        Self {
            facts: Facts {
                group: body.group,
                order: body.order as usize,
                radius,
                features,
            },
            body,
            encoding,
        }
    }
}

/// What is known of a solid.
#[derive(Clone, Debug)]
pub struct Facts {
    /// The group it was made for; it may have more symmetry by chance.
    pub group: Group,
    /// Highest order of a rotation that maps it onto itself.
    pub order: usize,
    /// Largest distance from the axis, in the units of the placed body.
    pub radius: f64,
    /// Features, in a few words.
    pub features: Vec<String>,
}

/// The solid of a seed.
pub fn solid(seed: u64) -> Solid {
    let mut dice = Dice::new(seed);
    let Drawn {
        mut body,
        mut features,
        ..
    } = draw(&mut dice);
    if dice.chance(0.3) {
        let few = body.faces.len().min(200);
        let (splits, flips) = (dice.below(few), dice.below(4 * few));
        tessellation::change(&mut body, splits, flips, &mut dice);
        features.push(format!("{splits} splits, {flips} flips"));
    }
    let distances = body.vertices.iter().map(|p| p.truncate().length());
    let radius = distances.fold(0.0, f64::max);
    let noise = noise(&body, &mut features, &mut dice);
    let scale = place(&mut body, noise, &mut features, &mut dice);
    let encoding = encoding(&body, noise, &mut dice);
    features.push(format!("{encoding:?}"));
    Solid::new(body, encoding, scale * radius, features)
}

/// A body before it is changed and placed.
struct Drawn {
    body: Body,
    /// Sectors of the grid that it is made of.
    sectors: usize,
    features: Vec<String>,
}

/// A body about the z axis as it is drawn, with the sectors of its grid, and what it is.
pub(crate) fn drawn(dice: &mut Dice) -> (Body, u32, String) {
    let Drawn {
        body,
        sectors,
        features,
    } = draw(dice);
    let kind = [vec![body.group.symbol()], features].concat().join(", ");
    (body, sectors as u32, kind)
}

fn draw(dice: &mut Dice) -> Drawn {
    let kind = dice.pick(&KINDS);
    let order = match dice.below(100) {
        0..4 => 1,
        4..64 => dice.integer(2, 8),
        64..86 => dice.integer(9, 16),
        _ => dice.integer(17, 64),
    };
    let pitch = pitch(kind, order, dice);
    // Fewer cells along the others where there are many around.
    let most = if order * pitch > 36 { 2 } else { 4 };
    let grid = Grid {
        rings: dice.integer(1, most),
        sectors: order * pitch,
        levels: dice.integer(1, most),
        bored: dice.chance(0.4),
    };
    let motions = group::motions(kind, order, pitch, dice);
    let middles = dice.pick(&[0.0, 0.0, 0.2, 1.0]);
    let faces = grid.faces(&motions, middles, dice);
    let mut features = Vec::new();
    let form = random_form(kind, &grid, &mut features, dice);
    let (places, share) = form.places(&grid, &faces, &motions, dice);
    if share < 1.0 {
        features.push(format!("deformation x {share}"));
    }
    let materials = dice.pick(&[1, 1, 1, 2, 2, 3, 4]);
    let filling = filling::fill(&grid, &motions, materials, dice);
    let mut body = assemble(&grid, &faces, &places, &filling, materials);
    let mut origins = vec![None; filling.len()];
    if dice.chance(0.2) {
        let middles = grid.middles(&places);
        let clear = grid.clearances(&faces, &places);
        origins = inclusions::include(&mut body, &grid, &motions, &filling, &middles, &clear, dice);
        if origins.iter().any(Option::is_some) {
            features.push("inclusions".to_owned());
        }
    }
    // Inclusions may have fewer symmetries than the cells that they are in.
    let turns = match origins.iter().any(Option::is_some) {
        true => order,
        false => turns(&grid, &faces, &places, &filling),
    };
    let group = Group::new(kind, order as u32);
    // Half turns across the axis are rotations of order 2.
    let highest = order.max(if group.has_half_turns() { 2 } else { 1 });
    body.order = turns.max(highest) as u32;
    body.group = group;
    tidy(&mut body);
    if tessellation::touches(&body) {
        features.push("touching edges".to_owned());
    }
    Drawn {
        body,
        sectors: grid.sectors,
        features,
    }
}

/// Sectors of a pitch: at least three around the axis, an even number where the group halves it.
fn pitch(kind: Kind, order: usize, dice: &mut Dice) -> usize {
    let most = match order {
        0..=8 => 5,
        9..=16 => 3,
        _ => 2,
    };
    loop {
        let pitch = dice.integer(1, most.max(3_usize.div_ceil(order)));
        if pitch * order >= 3 && (!group::halves_pitch(kind) || pitch.is_multiple_of(2)) {
            return pitch;
        }
    }
}

/// Values from `low` to `high`, one of the intervals thin in some cases.
fn steps(
    low: f64,
    high: f64,
    count: usize,
    even: bool,
    dice: &mut Dice,
) -> (Vec<f64>, Option<f64>) {
    let mut widths: Vec<f64> = (0..count).map(|_| dice.between(0.3, 1.0)).collect();
    let mut thin = None;
    if count > 1 && dice.chance(0.25) {
        let place = dice.below(count);
        let sum: f64 = widths.iter().sum();
        let share = dice.log_between(0.02, 0.3);
        widths[place] = share * sum;
        thin = Some(share);
    }
    if even {
        for i in 0..count / 2 {
            widths[count - 1 - i] = widths[i];
        }
    }
    let sum: f64 = widths.iter().sum();
    let mut values = vec![low];
    let mut part = 0.0;
    for width in &widths {
        part += width;
        values.push(low + (high - low) * part / sum);
    }
    if even {
        // Exactly opposite.
        for i in 0..values.len() / 2 {
            values[count - i] = -values[i];
        }
        if count.is_multiple_of(2) {
            values[count / 2] = 0.0;
        }
    }
    (values, thin)
}

fn random_form(kind: Kind, grid: &Grid, features: &mut Vec<String>, dice: &mut Dice) -> Form {
    let bore = if grid.bored {
        dice.between(0.1, 0.8)
    } else {
        0.0
    };
    let (radii, thin_ring) = steps(bore, 1.0, grid.rings, false, dice);
    let height = dice.log_between(0.1, 4.0);
    let turned = Group::new(kind, 1).turning_over().is_some();
    let (heights, thin_level) = steps(-0.5 * height, 0.5 * height, grid.levels, turned, dice);
    if let Some(thin) = thin_ring {
        features.push(format!("ring of {thin:.3}"));
    }
    if let Some(thin) = thin_level {
        features.push(format!("layer of {thin:.3}"));
    }
    let mut deformation = |share: f64, name: &str, low: f64, high: f64| {
        if !dice.chance(share) {
            return 0.0;
        }
        features.push(name.to_owned());
        dice.between(low, high)
    };
    let chiral = matches!(kind, Kind::C | Kind::D | Kind::Ch | Kind::S);
    Form {
        radii,
        heights,
        profile: deformation(0.35, "profile", 0.05, 0.5),
        twist: deformation(if chiral { 0.4 } else { 0.0 }, "twist", 0.05, 0.8),
        dish: deformation(0.2, "dish", 0.02, 0.3),
        roughness: deformation(0.25, "rough", 0.02, 0.3),
        unevenness: deformation(0.4, "uneven", 0.05, 0.4),
    }
}

fn assemble(
    grid: &Grid,
    faces: &[grid::Face],
    places: &[DVec3],
    filling: &[Option<usize>],
    materials: usize,
) -> Body {
    let mut vertices = places.to_vec();
    let mut out = Vec::new();
    for face in faces {
        let side = |cell: Option<usize>| cell.and_then(|c| filling[c]);
        let (front, back) = (side(face.front), side(face.back));
        if front == back {
            continue;
        }
        let triangles = grid.triangles(face, || {
            vertices.push(face.corners.iter().map(|&n| places[n]).sum::<DVec3>() / 4.0);
            vertices.len() - 1
        });
        out.extend(triangles.into_iter().map(|t| Face {
            vertices: t.map(|v| v as u32),
            front,
            back,
        }));
    }
    Body {
        vertices,
        faces: out,
        materials: (0..materials)
            .map(|m| Material {
                name: format!("material{m}"),
            })
            .collect(),
        order: 1,
        group: Group::TRIVIAL,
    }
}

/// Highest order of the rotations by whole sectors that map the filled grid onto itself.
fn turns(grid: &Grid, faces: &[grid::Face], places: &[DVec3], filling: &[Option<usize>]) -> usize {
    let holds = |shift: usize| {
        if !grid.split_alike(faces, shift) {
            return false;
        }
        let motion = Motion {
            shift,
            mirror: false,
            flip: false,
        };
        let turn = tmesh::Isometry::rotation(shift as i64, grid.sectors as u32);
        let (c, s) = turn.cos_sin();
        let same = (0..filling.len()).all(|cell| {
            let image = grid.cell_image(cell, motion);
            filling[cell] == filling[image]
        });
        same && (0..places.len()).all(|node| {
            let (p, q) = (places[node], places[grid.node_image(node, motion)]);
            let turned = DVec3::new(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
            let idle = node != grid.node(grid.node_place(node));
            idle || turned.distance(q) < 1e-9
        })
    };
    (1..=grid.sectors)
        .filter(|n| grid.sectors.is_multiple_of(*n))
        .rev()
        .find(|n| holds(grid.sectors / n))
        .unwrap_or(1)
}

/// Drops vertices without faces and materials without volume.
pub(crate) fn tidy(body: &mut Body) {
    let mut ids = vec![u32::MAX; body.vertices.len()];
    let mut vertices = Vec::new();
    for v in body.faces.iter_mut().flat_map(|f| &mut f.vertices) {
        let old = *v as usize;
        if ids[old] == u32::MAX {
            ids[old] = vertices.len() as u32;
            vertices.push(body.vertices[old]);
        }
        *v = ids[old];
    }
    body.vertices = vertices;
    let used = |m: usize| {
        body.faces
            .iter()
            .any(|f| f.front == Some(m) || f.back == Some(m))
    };
    let kept: Vec<usize> = (0..body.materials.len()).filter(|&m| used(m)).collect();
    let new = |m: Option<usize>| m.map(|m| kept.iter().position(|&k| k == m).expect("kept"));
    for face in &mut body.faces {
        face.front = new(face.front);
        face.back = new(face.back);
    }
    body.materials = kept.iter().map(|&m| body.materials[m].clone()).collect();
}

/// The largest noise, and the largest over the radius about the axis: a fifth of the tolerance, as images differ by twice as much in
/// each of three directions.
const LARGEST_NOISE: f64 = 2e-4;

/// How far vertices are displaced at random, before the body is scaled.
pub(crate) fn noise(body: &Body, features: &mut Vec<String>, dice: &mut Dice) -> f64 {
    if !dice.chance(0.15) {
        return 0.0;
    }
    // The tolerance of a symmetry is relative to the radius about its axis, which is small of a long body.
    let radii = body.vertices.iter().map(|p| p.truncate().length());
    let radius = radii.fold(0.0, f64::max);
    let noise = dice
        .log_between(1e-8, LARGEST_NOISE)
        .min(LARGEST_NOISE * radius)
        .min(0.02 * tessellation::least_height(body));
    features.push(format!("noise {noise:.1e}"));
    noise
}

/// Displaces vertices at random by up to `noise`, turns, shifts and scales a body; returns the scale.
pub(crate) fn place(
    body: &mut Body,
    noise: f64,
    features: &mut Vec<String>,
    dice: &mut Dice,
) -> f64 {
    let rotate = dice.chance(0.8).then(|| dice.seed());
    let scale = if dice.chance(0.3) {
        dice.log_between(1e-4, 1e4)
    } else {
        1.0
    };
    Placement {
        rotate,
        scale,
        jitter: noise,
    }
    .apply(body);
    features.push(match rotate {
        Some(_) => format!("placed, scale {scale:.1e}"),
        None => format!("scale {scale:.1e}"),
    });
    scale
}

pub(crate) fn encoding(body: &Body, noise: f64, dice: &mut Dice) -> Encoding {
    let single = body.materials.len() == 1;
    match dice.below(10) {
        0..3 if single => Encoding::StlBinary,
        3..5 => Encoding::Obj,
        5 => Encoding::Tmesh,
        6 if noise == 0.0 => Encoding::StlAscii { digits: Some(9) },
        _ => Encoding::StlAscii { digits: None },
    }
}
