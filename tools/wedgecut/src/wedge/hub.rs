//! The hub: the column around the axis as a template of its own.
//!
//! The wedge is divided by the hub's plane. What lies towards the axis is united with its images
//! until its angle is wide enough for good elements; between these images there is no wall left. The
//! united hub has a symmetry of its own, of a divisor of the wedge's order, and meets one copy of the
//! wedge on each side of its polygon. (The central core against small angles is F. Rudolf's, "Symmetry-
//! and similarity-aware volumetric meshing", TU Wien 2016.)

use super::assemble::{Caps, Wedge, image};
use super::closed::check_closed;
use super::fan::{Fan, Joint, Lies};
use crate::cell::{Cell, LEVEL_WALL, hub_order};
use crate::error::CutError;
use crate::seam::Matched;
use crate::surface::Surface;
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{Frame, Gluing, Group, Isometry, RegionMap, Template, Triangle};

/// The part of the wedge in front of the hub's plane.
pub struct Inner<'a> {
    /// The group whose wedge it is part of.
    pub group: Group,
    /// Its faces.
    pub cell: &'a Cell,
    /// Points of wedge and hub.
    pub surface: &'a Surface,
    /// Faces of the body.
    pub faces: &'a [Triangle],
    /// Caps, in the order of the cell's joins.
    pub caps: &'a Caps,
    /// Pairs of points of each join; none for mirror walls.
    pub matched: &'a [Option<Matched>],
    /// Cap in the hub's plane, facing out of the wedge.
    pub hub: &'a [Triangle],
    /// How the images of the wedge rename regions.
    pub regions: &'a dyn Fn(Isometry) -> RegionMap,
}

/// Unites the images of the inner part to the hub. `wedge` is the template of the outer part.
///
/// # Errors
/// [`CutError::NotClosed`].
pub fn unite(inner: &Inner<'_>, wedge: &Wedge, frame: &Frame) -> Result<Template, CutError> {
    let mirror = inner.group.has_vertical_mirrors();
    let fan = Fan::new(mirror, inner.group.order, hub_order(inner.group));
    let seam = inner.matched.first().and_then(Option::as_ref);
    let pairs = seam.map_or(&[][..], |m| &m.pairs);
    let mut maker = Maker {
        fan,
        low_of: pairs.iter().map(|p| (p[1], p[0])).collect(),
        inner,
        joint: Joint::default(),
        template: Template::default(),
    };
    let walls: Vec<Gluing> = (0..fan.images())
        .map(|j| maker.add_image(j, wedge))
        .collect();
    maker.close(seam);
    let levels = inner.cell.joins.iter().zip(inner.caps);
    for (join, cap) in levels.filter(|(join, _)| join.name == LEVEL_WALL) {
        let mut triangles = Vec::new();
        for j in 0..fan.images() {
            triangles.extend(maker.side(cap, j));
        }
        maker.mirror_wall(join.name, join.step, triangles);
    }
    let mut template = maker.template;
    template.gluings.extend(walls);
    template.axis.sort_unstable();
    check_closed(&template.vertices, &template.triangles, frame)?;
    Ok(template)
}

struct Maker<'a> {
    fan: Fan,
    inner: &'a Inner<'a>,
    /// Low partner of the seam's high points.
    low_of: FxHashMap<u32, u32>,
    joint: Joint,
    template: Template,
}

impl Maker<'_> {
    /// The hub's vertex for a point of image `j`.
    fn vertex(&mut self, v: u32, j: u32) -> u32 {
        let (p, class) = self.inner.surface.at(v);
        let (lies, v, p) = match class {
            _ if class.is_axis() => (Lies::Axis, v, p),
            _ if class.of(0) == 0 => (Lies::Low, v, p),
            _ if class.of(1) == 0 => match self.low_of.get(&v) {
                Some(&low) => (Lies::High, low, self.inner.surface.points[low as usize]),
                None => (Lies::High, v, p),
            },
            _ => (Lies::Between, v, p),
        };
        let next = self.template.vertices.len() as u32;
        let (id, new) = self.joint.name(&self.fan, lies, [v, j], next);
        if new {
            let image = self.position(p, lies, j);
            if lies == Lies::Axis {
                self.template.axis.push(id);
            }
            // Adding zero folds negative zeros.
            self.template.vertices.push(image + DVec3::ZERO);
        }
        id
    }

    /// Where image `j` has a point: the same bits for both images that share it, and exact images
    /// or exactly on the plane at the hub's own sides.
    fn position(&self, p: DVec3, lies: Lies, j: u32) -> DVec3 {
        let (fan, order) = (&self.fan, self.inner.group.order);
        match lies {
            Lies::Axis => p,
            Lies::Low | Lies::High if !fan.is_mirror() => {
                // `p` is the low point of the pair.
                let line = fan.line_of(lies, j);
                Isometry::rotation(i64::from(line), order).apply(p)
            }
            Lies::Low | Lies::High if fan.line_of(lies, j) == fan.images() => {
                let across = DVec3::new(p.x.hypot(p.y), 0.0, p.z);
                let turn = Isometry::rotation(i64::from(fan.images()), 2 * order);
                turn.apply(across)
            }
            _ => fan.image(j).apply(p),
        }
    }

    fn triangle(&mut self, t: &Triangle, j: u32, regions: &RegionMap) -> u32 {
        let [a, b, c] = t.vertices.map(|v| self.vertex(v, j));
        let vertices = if self.fan.image(j).reverses_orientation() {
            [a, c, b]
        } else {
            [a, b, c]
        };
        self.template.triangles.push(Triangle {
            vertices,
            front: regions.get(t.front),
            back: regions.get(t.back),
            ..*t
        });
        self.template.triangles.len() as u32 - 1
    }

    /// Adds image `j` without the sides; returns its wall towards the wedge.
    fn add_image(&mut self, j: u32, wedge: &Wedge) -> Gluing {
        let inner = self.inner;
        let regions = &(inner.regions)(self.fan.image(j));
        for t in inner.faces {
            self.triangle(t, j, regions);
        }
        let mut vertex_pairs: Vec<[u32; 2]> = Vec::new();
        let mut triangle_pairs = Vec::with_capacity(inner.hub.len());
        for (t, there) in inner.hub.iter().zip(wedge.hub.clone()) {
            let [a, b, c] = t.vertices;
            let facing = Triangle {
                vertices: [a, c, b],
                ..*t
            };
            triangle_pairs.push([self.triangle(&facing, j, regions), there]);
            for v in t.vertices {
                vertex_pairs.push([self.vertex(v, j), wedge.renumbered[v as usize]]);
            }
        }
        vertex_pairs.sort_unstable();
        vertex_pairs.dedup();
        Gluing {
            name: format!("hub-{j}"),
            other: 0,
            step: self.fan.image(j),
            vertex_pairs,
            triangle_pairs,
        }
    }

    /// Closes the united hub at its own sides.
    fn close(&mut self, seam: Option<&Matched>) {
        if self.fan.is_closed() {
            return;
        }
        let inner = self.inner;
        let last = self.fan.images() - 1;
        let order = hub_order(inner.group);
        let low: Vec<u32> = self.side(&inner.caps[0], 0);
        if let Some(seam) = seam {
            let cap = &inner.caps[0];
            let high = self.side(&image(cap, &inner.cell.joins[0], seam), last);
            let corners = cap.iter().flat_map(|t| t.vertices);
            let mut pairs: Vec<[u32; 2]> = corners
                .map(|v| {
                    let other = seam.partner(v).unwrap_or(v);
                    [self.vertex(v, 0), self.vertex(other, last)]
                })
                .collect();
            // A surface may touch the axis without reaching the sides there.
            pairs.extend(self.template.axis.iter().map(|&v| [v, v]));
            pairs.sort_unstable();
            pairs.dedup();
            let triangles = low.into_iter().zip(high).map(|(a, b)| [a, b]);
            let step = Isometry::rotation(1, order);
            let gluing = Gluing::seam(inner.cell.joins[0].name, 1, step, pairs, triangles);
            self.template.gluings.push(gluing);
            return;
        }
        // The last image is turned or reflected: which of the wedge's sides is at its end?
        let far = &inner.caps[usize::from(last.is_multiple_of(2))];
        let high = self.side(far, last);
        let first = Isometry::reflection(0, 1);
        if order == 1 {
            let both = [low, high].concat();
            self.mirror_wall("wall-a", first, both);
        } else {
            self.mirror_wall("wall-a", first, low);
            self.mirror_wall("wall-b", Isometry::reflection(1, order), high);
        }
    }

    fn side(&mut self, cap: &[Triangle], j: u32) -> Vec<u32> {
        let regions = (self.inner.regions)(self.fan.image(j));
        cap.iter().map(|t| self.triangle(t, j, &regions)).collect()
    }

    fn mirror_wall(&mut self, name: &str, reflection: Isometry, triangles: Vec<u32>) {
        let template = &self.template;
        let corners = |&t: &u32| template.triangles[t as usize].vertices;
        let mut vertices: Vec<u32> = triangles.iter().flat_map(corners).collect();
        if !reflection.flipped() {
            vertices.extend(&template.axis);
        }
        vertices.sort_unstable();
        vertices.dedup();
        let gluing = Gluing::mirror(name, 1, reflection, vertices, triangles);
        self.template.gluings.push(gluing);
    }
}
