//! Bodies with regular polygons for sections: the prisms, coated rings and through-silicon vias
//! that symmetry-aware meshing is usually measured with.

use super::Tessellation;
use super::sweep::{Ring, Sweep};
use crate::Body;
use glam::DVec3;
use tmesh::{Group, Isometry, Kind};

/// Corners of a regular polygon of the given circumradius, first one on the x axis.
fn polygon(order: u32, radius: f64, z: f64) -> Vec<DVec3> {
    (0..order)
        .map(|k| {
            let (c, s) = Isometry::rotation(i64::from(k), order).cos_sin();
            DVec3::new(radius * c, radius * s, z)
        })
        .collect()
}

/// Circumradius step that moves the sides of a regular polygon by `distance`.
fn step(order: u32, distance: f64) -> f64 {
    distance / Isometry::rotation(1, 2 * order).cos_sin().0
}

/// Rings at the bottom and the top of one regular polygon.
fn ends(sweep: &mut Sweep, order: u32, radius: f64, height: f64) -> [Ring; 2] {
    [0.0, height].map(|z| sweep.ring(polygon(order, radius, z)))
}

/// Closes a full-height tube of material between two pairs of rings with caps.
fn caps(sweep: &mut Sweep, inner: [Ring; 2], outer: [Ring; 2], material: usize) {
    sweep.strip(inner[0], outer[0], Some(material), None);
    sweep.strip(outer[1], inner[1], Some(material), None);
}

/// A right prism over a regular polygon, with or without a bore: one material (category A).
#[derive(Clone, Debug)]
pub struct Prism {
    /// Corners of the section.
    pub order: u32,
    /// Circumradius.
    pub radius: f64,
    /// Height.
    pub height: f64,
    /// Circumradius of a bore with the same corners; 0 for none.
    pub bore: f64,
    /// How flat parts are split.
    pub tessellation: Tessellation,
}

impl Prism {
    /// The body.
    pub fn build(&self) -> Body {
        let mut sweep = Sweep::new(["body"]);
        let outer = ends(&mut sweep, self.order, self.radius, self.height);
        let inner = if self.bore > 0.0 {
            let inner = ends(&mut sweep, self.order, self.bore, self.height);
            sweep.strip(inner[0], inner[1], None, Some(0));
            inner
        } else {
            [0.0, self.height].map(|z| sweep.axis(z))
        };
        sweep.strip(outer[0], outer[1], Some(0), None);
        caps(&mut sweep, inner, outer, 0);
        sweep.upright(self.order, self.tessellation)
    }
}

/// A prism with a hole whose wall carries a thin coating: two materials (category B).
#[derive(Clone, Debug)]
pub struct Coating {
    /// Corners of the sections.
    pub order: u32,
    /// Outer circumradius.
    pub radius: f64,
    /// Circumradius of the hole left open.
    pub bore: f64,
    /// Thickness of the coating, from face to face.
    pub thickness: f64,
    /// Height.
    pub height: f64,
    /// How flat parts are split.
    pub tessellation: Tessellation,
}

impl Coating {
    /// The body; materials `body` and `coating`.
    pub fn build(&self) -> Body {
        let n = self.order;
        let mut sweep = Sweep::new(["body", "coating"]);
        let outer = ends(&mut sweep, n, self.radius, self.height);
        let middle = ends(
            &mut sweep,
            n,
            self.bore + step(n, self.thickness),
            self.height,
        );
        let inner = ends(&mut sweep, n, self.bore, self.height);
        sweep.strip(outer[0], outer[1], Some(0), None);
        sweep.strip(middle[0], middle[1], Some(1), Some(0));
        sweep.strip(inner[0], inner[1], None, Some(1));
        caps(&mut sweep, middle, outer, 0);
        caps(&mut sweep, inner, middle, 1);
        sweep.upright(n, self.tessellation)
    }
}

/// A filled through-silicon via: core, thin liner, surroundings: three materials (category C).
#[derive(Clone, Debug)]
pub struct Tsv {
    /// Corners of the sections.
    pub order: u32,
    /// Outer circumradius.
    pub radius: f64,
    /// Circumradius of the core.
    pub core: f64,
    /// Thickness of the liner, from face to face.
    pub thickness: f64,
    /// Height.
    pub height: f64,
    /// How flat parts are split.
    pub tessellation: Tessellation,
}

impl Tsv {
    /// The body; materials `silicon`, `liner` and `copper`.
    pub fn build(&self) -> Body {
        let n = self.order;
        let mut sweep = Sweep::new(["silicon", "liner", "copper"]);
        let outer = ends(&mut sweep, n, self.radius, self.height);
        let middle = ends(
            &mut sweep,
            n,
            self.core + step(n, self.thickness),
            self.height,
        );
        let core = ends(&mut sweep, n, self.core, self.height);
        let axis = [0.0, self.height].map(|z| sweep.axis(z));
        sweep.strip(outer[0], outer[1], Some(0), None);
        sweep.strip(middle[0], middle[1], Some(1), Some(0));
        sweep.strip(core[0], core[1], Some(2), Some(1));
        caps(&mut sweep, middle, outer, 0);
        caps(&mut sweep, core, middle, 1);
        caps(&mut sweep, axis, core, 2);
        sweep.upright(n, self.tessellation)
    }
}

/// An open through-silicon via: a hole through a substrate, closed at the bottom, with thin films
/// on wall and floor, one inside the other like cups.
#[derive(Clone, Debug)]
pub struct PracticalTsv {
    /// Corners of the sections.
    pub order: u32,
    /// Outer circumradius.
    pub radius: f64,
    /// Circumradius of the hole in the substrate.
    pub hole: f64,
    /// Thickness of each film, from face to face.
    pub thickness: f64,
    /// Number of films.
    pub layers: u32,
    /// Height.
    pub height: f64,
    /// How flat parts are split.
    pub tessellation: Tessellation,
}

/// Films of an open through-silicon via from the substrate inwards.
const FILMS: [&str; 6] = [
    "oxide",
    "titanium",
    "tungsten",
    "aluminium",
    "glass",
    "nitride",
];

impl PracticalTsv {
    /// The body; materials `silicon` and one per film.
    pub fn build(&self) -> Body {
        let n = self.order;
        let names = (0..self.layers as usize).map(|k| match FILMS.get(k) {
            Some(name) => (*name).to_owned(),
            None => format!("film-{}", k + 1),
        });
        let mut sweep = Sweep::new(std::iter::once("silicon".to_owned()).chain(names));
        let outer = ends(&mut sweep, n, self.radius, self.height);
        sweep.strip(outer[0], outer[1], Some(0), None);
        let mut upper = outer[1];
        for k in 0..=self.layers {
            let radius = self.hole - step(n, self.thickness * f64::from(k));
            let floor = self.thickness * f64::from(k);
            let foot = sweep.ring(polygon(n, radius, floor));
            let rim = sweep.ring(polygon(n, radius, self.height));
            let centre = sweep.axis(floor);
            // Film k lies between surfaces k - 1 and k; film 0 is the substrate, or outside below.
            let behind = k as usize;
            let inside = (k < self.layers).then_some(behind + 1);
            sweep.strip(foot, rim, inside, Some(behind));
            sweep.strip(centre, foot, inside, (k > 0).then_some(behind));
            sweep.strip(upper, rim, Some(behind), None);
            if k == 0 {
                sweep.strip(foot, outer[0], Some(0), None);
            }
            upper = rim;
        }
        sweep.build(Group::new(Kind::Cv, n), true, self.tessellation)
    }
}

/// A cube of the given edge, centred on the axis.
pub fn cube(edge: f64, tessellation: Tessellation) -> Body {
    let mut sweep = Sweep::new(["cube"]);
    let h = 0.5 * edge;
    let square = |z| [(h, -h), (h, h), (-h, h), (-h, -h)].map(|(x, y)| DVec3::new(x, y, z));
    let [bottom, top] = [0.0, edge].map(|z| sweep.ring(square(z).to_vec()));
    let axis = [0.0, edge].map(|z| sweep.axis(z));
    sweep.strip(bottom, top, Some(0), None);
    caps(&mut sweep, axis, [bottom, top], 0);
    sweep.upright(4, tessellation)
}
