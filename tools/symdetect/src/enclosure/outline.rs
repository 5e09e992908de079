//! Which outer boundary: its place and its size.

use glam::DVec3;
use thiserror::Error;
use tmesh::{Document, Frame, Group, Symmetry};

/// The outer boundary asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enclosure {
    /// Its shape.
    pub kind: Kind,
    /// Its size, relative to that of the body; greater than 1.
    pub factor: f64,
    /// What is kept of it all.
    pub content: Content,
}

/// What is kept of a body and the space around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// The body, and the space around it as one more region.
    Both,
    /// The space around it alone, which flows past the body: the passages between blades.
    Fluid,
}

/// Shapes of outer boundaries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A prism around the axis.
    Cylinder,
    /// A box.
    Box,
}

impl Enclosure {
    /// From `cylinder:FACTOR` or `box:FACTOR`.
    ///
    /// # Errors
    /// Says what is wanted.
    pub fn parse(text: &str) -> Result<Self, String> {
        let wanted = "cylinder:FACTOR or box:FACTOR is wanted";
        let (kind, factor) = text.split_once(':').ok_or(wanted)?;
        let kind = match kind {
            "cylinder" => Kind::Cylinder,
            "box" => Kind::Box,
            _ => return Err(wanted.to_owned()),
        };
        match factor.parse::<f64>() {
            Ok(factor) if factor > 1.0 && factor.is_finite() => Ok(Self {
                kind,
                factor,
                content: Content::Both,
            }),
            Ok(_) => Err("the factor must be greater than 1".to_owned()),
            Err(e) => Err(format!("'{factor}': {e}")),
        }
    }
}

/// Why a body cannot be enclosed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Impossible {
    /// A box has right angles only.
    #[error(
        "a box cannot have the symmetry {group} of the body; use --enclosure cylinder:FACTOR{}",
        match subgroup {
            1 => String::new(),
            n => format!(", or --order {n}"),
        }
    )]
    NoBox {
        /// The body's group.
        group: Group,
        /// The highest order of the rotation that a box can have.
        subgroup: u32,
    },
    /// The region's name is taken.
    #[error(
        "the body has a region 'air' already: with --enclosure that is the name of what is around it"
    )]
    Taken,
    /// Too far away.
    #[error("an outer boundary at {0} is too far away to compute with; use a smaller factor")]
    TooLarge(String),
}

/// An outer boundary around a body, in a frame of its own: a prism or a box about the origin, with the axis along z.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Where it is.
    pub frame: Frame,
    /// Its cross-section.
    pub section: Section,
    /// Half of its height.
    pub half_height: f64,
}

/// The cross-section of an outer boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Section {
    /// A regular polygon with a corner on the x axis.
    Polygon {
        /// Number of sides.
        sides: u32,
        /// Radius of the circle within.
        inner: f64,
    },
    /// A rectangle: half of its sides along x and y.
    Rectangle([f64; 2]),
}

/// Sides of a prism that stands for a cylinder, at least: they bend by 15 degrees, half of the angle from which the stages after
/// this one take edges for features, so that the outer boundary is one smooth surface to them. A choice: with more,
/// the outer boundary, where nothing happens, is drawn more finely than elements there are wanted; with 12 or less,
/// its edges are features.
const SIDES: u32 = 24;

impl Outline {
    /// The outer boundary that an enclosure is for a body with this symmetry.
    ///
    /// # Errors
    /// The enclosure cannot have the symmetry, or is too large.
    pub fn new(
        document: &Document,
        symmetry: &Symmetry,
        enclosure: Enclosure,
    ) -> Result<Self, Impossible> {
        let Enclosure { kind, factor, .. } = enclosure;
        let group = symmetry.group;
        let in_place = match (kind, group.is_trivial()) {
            // Nothing asks for other directions than those of the coordinates.
            (Kind::Box, true) => Frame::IDENTITY,
            _ => symmetry.frame().unwrap_or(Frame::IDENTITY),
        };
        let vertices = document.templates.iter().flat_map(|t| &t.vertices);
        let points: Vec<DVec3> = vertices.map(|&p| in_place.to_canonical(p)).collect();
        let centre = centre(group, &points);
        let frame = Frame {
            origin: in_place.to_world(centre),
            ..in_place
        };
        let farthest = |size: &dyn Fn(DVec3) -> f64| {
            let sizes = points.iter().map(|&p| size(p - centre));
            factor * sizes.fold(0.0, f64::max)
        };
        let half_height = farthest(&|p| p.z.abs());
        let section = match kind {
            Kind::Cylinder => Section::Polygon {
                sides: sides(group),
                inner: farthest(&|p| p.truncate().length()),
            },
            Kind::Box => {
                let [x, y] = [farthest(&|p| p.x.abs()), farthest(&|p| p.y.abs())];
                match has_quarter_turns(group)? {
                    true => Section::Rectangle([x.max(y); 2]),
                    false => Section::Rectangle([x, y]),
                }
            }
        };
        Ok(Self {
            frame,
            section,
            half_height,
        })
    }
}

/// The middle of a body in the canonical frame, as far as its group leaves that open: along an axis that some operation
/// turns, it is at the origin.
fn centre(group: Group, points: &[DVec3]) -> DVec3 {
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let generators = group.generators();
    let free = DVec3::AXES.map(|e| generators.iter().all(|g| g.apply(e) == e));
    let middle = 0.5 * (low + high);
    let along = |i: usize| if free[i] { middle[i] } else { 0.0 };
    DVec3::new(along(0), along(1), along(2))
}

/// The least number of sides, [`SIDES`] or more, of a prism that all elements of a group map to itself.
fn sides(group: Group) -> u32 {
    let halves = group.generators().iter().any(|g| g.n() > group.order);
    let unit = if halves { 2 * group.order } else { group.order };
    SIDES.div_ceil(unit) * unit
}

/// Whether some element of a group that a box can have exchanges x and y.
fn has_quarter_turns(group: Group) -> Result<bool, Impossible> {
    let turns = || group.elements().map(|g| g.n());
    if turns().any(|n| 4 % n != 0) {
        let subgroup = [4, 2].into_iter().find(|n| group.order.is_multiple_of(*n));
        return Err(Impossible::NoBox {
            group,
            subgroup: subgroup.unwrap_or(1),
        });
    }
    Ok(turns().any(|n| n == 4))
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::Kind as GroupKind;

    /// Corners of the section, which the group has to map to corners.
    fn corners(sides: u32) -> Vec<DVec3> {
        let corner = |k: u32| {
            let (cos, sin) = tmesh::Isometry::rotation(i64::from(k), sides).cos_sin();
            DVec3::new(cos, sin, 1.0)
        };
        let above = (0..sides).map(corner);
        above
            .flat_map(|p| [p, DVec3::new(p.x, p.y, -1.0)])
            .collect()
    }

    #[test]
    fn prisms_have_the_symmetry_of_every_group() {
        for kind in GroupKind::ALL {
            for order in [1, 2, 3, 5, 7, 8, 12, 25, 100] {
                let group = Group::new(kind, order);
                let sides = sides(group);
                assert!(
                    (SIDES..SIDES + 2 * order).contains(&sides),
                    "{group} {sides}"
                );
                let corners = corners(sides);
                for g in group.generators() {
                    for &p in &corners {
                        let image = g.apply(p);
                        let nearest = corners.iter().map(|q| q.distance(image));
                        let off = nearest.fold(f64::INFINITY, f64::min);
                        assert!(off < 1e-12, "{group}: {p} goes {off} beside a corner");
                    }
                }
            }
        }
    }

    #[test]
    fn boxes_have_right_angles_only() {
        for kind in GroupKind::ALL {
            for order in [1, 2, 3, 4, 5, 6, 8, 12] {
                let group = Group::new(kind, order);
                // Eight corners of a square box, and of one that is longer one way.
                let has = |x: f64, y: f64| {
                    let corner = |i: u32| {
                        let sign = |bit: u32| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
                        DVec3::new(x * sign(0), y * sign(1), sign(2))
                    };
                    let all: Vec<DVec3> = (0..8).map(corner).collect();
                    let lands = |p: DVec3| all.iter().any(|q| q.distance(p) < 1e-12);
                    (group.elements()).all(|g| all.iter().all(|&p| lands(g.apply(p))))
                };
                let found = has_quarter_turns(group);
                assert_eq!(found.is_ok(), has(1.0, 1.0), "{group}");
                assert_eq!(found == Ok(false), has(1.0, 2.0), "{group}");
            }
        }
    }

    #[test]
    fn enclosures_are_read() {
        let found = Enclosure::parse("box:2.5").unwrap();
        assert_eq!((found.kind, found.factor), (Kind::Box, 2.5));
        for bad in [
            "",
            "box",
            "ball:2",
            "cylinder:",
            "cylinder:1",
            "cylinder:-3",
            "box:inf",
            "box:NaN",
            "box:x",
        ] {
            assert!(Enclosure::parse(bad).is_err(), "{bad}");
        }
    }
}
