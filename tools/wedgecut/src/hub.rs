//! The hub: the column around the axis as a template of its own.
//!
//! The wedge is divided by the hub's plane. What lies towards the axis is united with its images
//! until its angle is wide enough for good elements; between these images there is no wall left. The
//! united hub has a symmetry of its own, of a divisor of the wedge's order, and meets one copy of the
//! wedge on each side of its polygon. (The central core against small angles is F. Rudolf's, "Symmetry-
//! and similarity-aware volumetric meshing", TU Wien 2016.)

use crate::error::CutError;
use crate::finish::{LEVEL, LEVEL_WALL, Wedge, check_closed};
use crate::opening::Class;
use crate::plan::{HubPlan, Plan};
use crate::surface::Surface;
use geom::fan::{Fan, Joint, Lies};
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{Frame, Gluing, Isometry, RegionMap, Template, Triangle};

/// The part of the wedge in front of the hub's plane.
pub struct Inner<'a> {
    /// Points of wedge and hub.
    pub surface: &'a Surface,
    /// Faces of the body.
    pub faces: &'a [Triangle],
    /// Cap of side A.
    pub low: &'a [Triangle],
    /// Cap of side B of a mirror wedge.
    pub high: &'a [Triangle],
    /// Cap of the plane z = 0, if that is a wall.
    pub level: Option<&'a [Triangle]>,
    /// Points of the seam of a rotation wedge: low, high.
    pub pairs: &'a [[u32; 2]],
    /// Cap in the hub's plane, facing out of the wedge.
    pub hub: &'a [Triangle],
}

/// Unites the images of the inner part to the hub. `wedge` is the template of the outer part.
///
/// # Errors
/// [`CutError::NotClosed`].
pub fn unite(
    inner: &Inner<'_>,
    wedge: &Wedge,
    plan: &Plan,
    hub: &HubPlan,
    frame: &Frame,
) -> Result<Template, CutError> {
    let fan = Fan::new(plan.mirror, plan.order, hub.order);
    let mut maker = Maker {
        fan,
        order: plan.order,
        low_of: inner.pairs.iter().map(|p| (p[1], p[0])).collect(),
        inner,
        joint: Joint::default(),
        template: Template::default(),
    };
    let mut hub_walls = Vec::new();
    for j in 0..fan.images() {
        let wall = maker.add_image(j, wedge, plan.regions_of(fan.image(j)));
        hub_walls.push(wall);
    }
    maker.close(plan, hub);
    if let Some(level) = inner.level {
        let mut triangles = Vec::new();
        for j in 0..fan.images() {
            triangles.extend(maker.side(level, j, plan));
        }
        maker.mirror_wall(LEVEL_WALL, LEVEL, triangles);
    }
    let mut template = maker.template;
    template.gluings.extend(hub_walls);
    template.axis.sort_unstable();
    check_closed(&template.vertices, &template.triangles, frame)?;
    Ok(template)
}

struct Maker<'a> {
    fan: Fan,
    /// Order of the wedge.
    order: u32,
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
            Class { a: 0, .. } => (Lies::Low, v, p),
            Class { b: 0, .. } => match self.low_of.get(&v) {
                Some(&low) => (Lies::High, low, self.inner.surface.points[low as usize]),
                None => (Lies::High, v, p),
            },
            _ => (Lies::Between, v, p),
        };
        let next = self.template.vertices.len() as u32;
        let (id, new) = self.joint.name(&self.fan, lies, v, j, next);
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
        let fan = &self.fan;
        match lies {
            Lies::Axis => p,
            Lies::Low | Lies::High if !fan.is_mirror() => {
                // `p` is the low point of the pair.
                let line = fan.line_of(lies, j);
                Isometry::rotation(i64::from(line), self.order).apply(p)
            }
            Lies::Low | Lies::High if fan.line_of(lies, j) == fan.images() => {
                let across = DVec3::new(p.x.hypot(p.y), 0.0, p.z);
                let turn = Isometry::rotation(i64::from(fan.images()), 2 * self.order);
                turn.apply(across)
            }
            _ => fan.image(j).apply(p),
        }
    }

    fn triangle(&mut self, t: &Triangle, j: u32, regions: Option<&RegionMap>) -> u32 {
        let [a, b, c] = t.vertices.map(|v| self.vertex(v, j));
        let vertices = if self.fan.image(j).reverses_orientation() {
            [a, c, b]
        } else {
            [a, b, c]
        };
        let region = |r: u32| regions.map_or(r, |m| m.get(r));
        self.template.triangles.push(Triangle {
            vertices,
            front: region(t.front),
            back: region(t.back),
            ..*t
        });
        self.template.triangles.len() as u32 - 1
    }

    /// Adds image `j` without the sides; returns its wall towards the wedge.
    fn add_image(&mut self, j: u32, wedge: &Wedge, regions: Option<&RegionMap>) -> Gluing {
        let inner = self.inner;
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
    fn close(&mut self, plan: &Plan, hub: &HubPlan) {
        if self.fan.is_closed() {
            return;
        }
        let inner = self.inner;
        let last = self.fan.images() - 1;
        let low: Vec<u32> = self.side(inner.low, 0, plan);
        if !plan.mirror {
            let partner: FxHashMap<u32, u32> = inner.pairs.iter().map(|p| (p[0], p[1])).collect();
            let image = inner.low.iter().map(|t| {
                let [a, b, c] = t.vertices.map(|v| partner.get(&v).copied().unwrap_or(v));
                Triangle {
                    vertices: [a, c, b],
                    ..*t
                }
            });
            let image: Vec<Triangle> = image.collect();
            let high = self.side(&image, last, plan);
            let mut vertex_pairs: Vec<[u32; 2]> = inner
                .low
                .iter()
                .flat_map(|t| t.vertices)
                .map(|v| {
                    let other = partner.get(&v).copied().unwrap_or(v);
                    [self.vertex(v, 0), self.vertex(other, last)]
                })
                .collect();
            // A surface may touch the axis without reaching the sides there.
            vertex_pairs.extend(self.template.axis.iter().map(|&v| [v, v]));
            vertex_pairs.sort_unstable();
            vertex_pairs.dedup();
            self.template.gluings.push(Gluing::seam(
                "seam",
                1,
                Isometry::rotation(1, hub.order),
                vertex_pairs,
                low.into_iter().zip(high).map(|(a, b)| [a, b]),
            ));
            return;
        }
        // The last image is turned or reflected: which of the wedge's sides is at its end?
        let far = if last.is_multiple_of(2) {
            inner.high
        } else {
            inner.low
        };
        let high = self.side(far, last, plan);
        if hub.order == 1 {
            let both = [low, high].concat();
            self.mirror_wall("wall-a", Isometry::reflection(0, 1), both);
        } else {
            self.mirror_wall("wall-a", Isometry::reflection(0, 1), low);
            self.mirror_wall("wall-b", Isometry::reflection(1, hub.order), high);
        }
    }

    fn side(&mut self, cap: &[Triangle], j: u32, plan: &Plan) -> Vec<u32> {
        let regions = plan.regions_of(self.fan.image(j));
        cap.iter().map(|t| self.triangle(t, j, regions)).collect()
    }

    fn mirror_wall(&mut self, name: &str, reflection: Isometry, mut triangles: Vec<u32>) {
        let template = &self.template;
        let corners = |&t: &u32| template.triangles[t as usize].vertices;
        let mut vertices: Vec<u32> = triangles.iter().flat_map(corners).collect();
        if reflection != LEVEL {
            vertices.extend(&template.axis);
        }
        vertices.sort_unstable();
        vertices.dedup();
        triangles.sort_unstable();
        let gluing = Gluing::mirror(name, 1, reflection, vertices, triangles);
        self.template.gluings.push(gluing);
    }
}
