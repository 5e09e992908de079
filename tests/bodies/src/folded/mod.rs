//! Bodies whose flat facets are bent a little: what exporters, single precision and edited drawings make of planes.
//!
//! A body of known symmetry is bent alike everywhere: whatever is done to a triangle, an edge or a vertex is done to all of
//! its images, so that the body keeps its group ([`images`]), its regions, and a surface that does not cross itself ([`bend`]).

mod base;
mod bend;
mod images;

use crate::random_solid::{Solid, place, tidy};
use crate::{Body, Dice, Encoding};
use bend::Bent;

/// Largest angle by which facets are turned, degrees; the smallest is [`LEAST`].
const MOST: f64 = 2.0;
/// Smallest angle, degrees.
const LEAST: f64 = 1e-6;

/// A bent body, and by how much it was bent.
pub struct Folded {
    /// The body, placed.
    pub solid: Solid,
    /// Largest angle that a facet was turned by, degrees.
    pub angle: f64,
}

/// The bent body of a seed.
pub fn folded(seed: u64) -> Folded {
    of_seed(seed, true)
}

/// The same body with the same triangles, but flat.
pub fn unfolded(seed: u64) -> Folded {
    of_seed(seed, false)
}

/// Bends the flat faces of a body drawn about the z axis, with triangles as symmetric as it is, by up to `angle` degrees. Returns
/// how many vertices were moved.
pub fn bend(body: &mut Body, angle: f64, seed: u64) -> usize {
    let sectors = body.order;
    let mut dice = Dice::new(seed);
    about_middle(body, |body| {
        bend::bend(body, sectors, angle.to_radians(), &mut dice).vertices
    })
}

/// Does something to a body that is moved so that its middle is on the plane of the coordinates meanwhile.
fn about_middle<T>(body: &mut Body, mut what: impl FnMut(&mut Body) -> T) -> T {
    let heights = || body.vertices.iter().map(|p| p.z);
    let low = heights().fold(f64::INFINITY, f64::min);
    let high = heights().fold(f64::NEG_INFINITY, f64::max);
    let middle = 0.5 * (low + high);
    body.vertices.iter_mut().for_each(|p| p.z -= middle);
    let done = what(body);
    body.vertices.iter_mut().for_each(|p| p.z += middle);
    done
}

fn of_seed(seed: u64, bends: bool) -> Folded {
    let mut dice = Dice::new(seed ^ 0x666f_6c64_6564);
    loop {
        let (body, sectors, name) = base::base(&mut dice);
        let angle = dice.log_between(LEAST, MOST);
        if let Some(folded) = bent(body, sectors, &name, bends.then_some(angle), &mut dice) {
            return folded;
        }
    }
}

/// A body of the z axis bent by up to `angle` degrees, and placed; `None` where nothing of it could be bent. Without an angle, it
/// stays as it is, with the same triangles.
fn bent(
    mut body: Body,
    sectors: u32,
    name: &str,
    angle: Option<f64>,
    dice: &mut Dice,
) -> Option<Folded> {
    tidy(&mut body);
    let angle = angle.map_or(0.0, f64::to_radians);
    // Many bodies stand on the plane of the coordinates. Bent alike on both sides of that, and not of their middle, they keep what
    // leaves their axis its direction, and the rest only nearly.
    let Bent { vertices, angle } = match dice.chance(0.5) {
        true => about_middle(&mut body, |body| bend::bend(body, sectors, angle, dice)),
        false => bend::bend(&mut body, sectors, angle, dice),
    };
    if vertices == 0 {
        return None;
    }
    let angle = angle.to_degrees();
    let mut features = vec![
        name.to_owned(),
        format!("{vertices} vertices bent by up to {angle:.1e} degrees"),
    ];
    let distances = body.vertices.iter().map(|p| p.truncate().length());
    let radius = distances.fold(0.0, f64::max);
    // Without noise, which has no symmetry.
    let scale = place(&mut body, 0.0, &mut features, dice);
    let encoding = match dice.below(4) {
        0 if body.materials.len() == 1 => Encoding::StlBinary,
        1 => Encoding::Obj,
        2 => Encoding::Poly,
        _ => Encoding::StlAscii { digits: None },
    };
    features.push(format!("{encoding:?}"));
    let solid = Solid::new(body, encoding, scale * radius, features);
    Some(Folded { solid, angle })
}
