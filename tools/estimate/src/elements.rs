//! The number of elements of a body and of the ways to cut it.

use crate::features::{Outline, edge_samples};
use crate::model::CostModel;
use crate::steep::steep;
use crate::sum::classes::{Classes, RESOLUTION};
use crate::sum::integral::{Integral, Part};
use crate::sum::samples::thinned;
use crate::sum::section::{SectionTriangle, sections};
use crate::way::{Cut, Way};
use crate::wedge::{Wedge, edge_of_volume};
use glam::DVec2;
use std::f64::consts::TAU;
use tmesh::OUTSIDE;

/// Body volume by radius and element size.
#[derive(Clone)]
pub struct Estimate {
    /// The coefficients.
    pub model: CostModel,
    classes: Classes,
    /// Largest distance of the body from the axis.
    radius: f64,
    sums: Integral,
    /// The classes that have any volume.
    filled: Vec<Filled>,
    /// The body's boundary over the square of the size, where the size is one that was asked for.
    skin: f64,
    /// Whether there is material on the axis.
    solid: bool,
    /// Radii blocked by steep faces, increasing, disjoint.
    steep: Vec<[f64; 2]>,
    /// The least size that layers are counted down to, of what there will be and what is drawn, model units.
    thinnest: f64,
    /// What thin triangles cost, see [`crate::needles::needles`].
    needles: f64,
}

/// Body volume of a class of radius and size.
#[derive(Clone, Copy)]
struct Filled {
    /// The class of radius, and its middle.
    class: usize,
    radius: f64,
    /// Middle of the class of size.
    size: f64,
    volume: f64,
}

/// What a part of a mesh has, each to be multiplied by a coefficient.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Terms {
    /// Volume over the cube of the size of elements.
    pub inside: f64,
    /// Boundary over the square of the size, where that was asked for.
    pub skin: f64,
    /// The same of the wall between wedge and hub.
    pub hub_skin: f64,
}

impl Terms {
    /// Elements.
    pub fn elements(&self, model: &CostModel) -> f64 {
        self.inside + model.skin * self.skin + model.hub_skin * self.hub_skin
    }
}

impl Estimate {
    /// Looks at the section and the edges of a wedge without a hub. `max_volume` is the largest volume of an
    /// element in a region, model units cubed, where one will be asked for. The body's thin triangles cost
    /// `needles`. The result does not depend on the number of `threads`.
    pub fn new(
        model: CostModel,
        wedge: &Wedge<'_>,
        needles: f64,
        max_volume: impl Fn(u32) -> Option<f64>,
        threads: usize,
    ) -> Self {
        let sections = sections(wedge);
        let vertices = &wedge.template.vertices;
        let radius = vertices.iter().map(|p| p.x.hypot(p.y));
        let radius = radius.fold(0.0, f64::max);
        let extent = vertices.iter().fold(radius, |most, p| most.max(p.z.abs()));
        let (mut samples, drawn) = edge_samples(wedge);
        let edges = samples.len();
        for section in &sections {
            Outline::new(section).thickness(extent, wedge.has_open_corners(), &mut samples);
        }
        for across in &mut samples[edges..] {
            across.size /= wedge.layers;
        }
        let samples = thinned(samples, extent, RESOLUTION as f64);
        let caps = sections.iter().flatten();
        let caps = caps.filter_map(|(_, region)| max_volume(*region).map(edge_of_volume));
        let sizes = samples.iter().map(|s| s.size).chain(caps);
        let classes = Classes::new(extent, sizes.fold(extent, f64::min));
        let weight = 1.0 / sections.len().max(1) as f64;
        let part = |(corners, region): &SectionTriangle| Part {
            corners: *corners,
            cap: max_volume(*region).map_or(f64::INFINITY, edge_of_volume),
            weight,
        };
        let parts: Vec<Part> = sections.iter().flatten().map(part).collect();
        let sums = Integral::over(&parts, &samples, model.growth, classes, threads);
        let mut estimate = Self {
            model,
            classes,
            radius,
            filled: filled(&sums, classes),
            sums,
            skin: 0.0,
            solid: sections.iter().flatten().any(|(t, _)| on_axis(t)),
            steep: steep(wedge),
            thinnest: classes.least.min(drawn),
            needles,
        };
        estimate.skin = estimate.boundary(wedge);
        estimate
    }

    /// The same with other coefficients, but for the growth of sizes.
    pub fn with_model(&self, model: CostModel) -> Self {
        Self {
            model: CostModel {
                growth: self.model.growth,
                ..model
            },
            ..self.clone()
        }
    }

    /// Area of the body's boundary over the square of the size of elements, as far as their size is one
    /// that was asked for.
    fn boundary(&self, wedge: &Wedge<'_>) -> f64 {
        let squares: f64 = self.sums.walls.iter().sum();
        let area = |f: &Filled| f.volume / (TAU * f.radius);
        let section: f64 = self.filled.iter().map(area).sum();
        let outer = wedge.body().filter(|&t| {
            let t = &wedge.template.triangles[t as usize];
            t.front == OUTSIDE || t.back == OUTSIDE
        });
        let area: f64 = outer
            .map(|t| {
                let [a, b, c] = wedge.corners(t);
                geom::measure::triangle_area(a, b, c)
            })
            .sum();
        if section > 0.0 {
            area * wedge.copies as f64 * squares / section
        } else {
            0.0
        }
    }

    /// Volume that the sections tell the body to have: exact where it is round, model units cubed.
    pub fn volume(&self) -> f64 {
        self.filled.iter().map(|f| f.volume).sum()
    }

    /// What the body meshed as a whole has.
    pub fn whole(&self) -> Terms {
        let elements = |f: &Filled| f.volume / f.size.powi(3);
        let inside: f64 = self.filled.iter().map(elements).sum();
        Terms {
            inside: inside + self.needles,
            skin: self.skin,
            hub_skin: 0.0,
        }
    }

    /// What all copies of wedge and hub have, without what the cut faces slice.
    pub fn parts(&self, cut: &Cut, hub: Option<f64>) -> [Terms; 2] {
        let span = match cut.free {
            true => self.model.span,
            false => self.model.seam_span,
        };
        // Wide wedges have room for elements of any size, at the axis too.
        let tangent = match cut.angle < self.model.wide {
            true => (0.5 * cut.angle).tan(),
            false => f64::INFINITY,
        };
        let width = |r: f64| span * 2.0 * tangent * r;
        let radius = hub.unwrap_or(0.0);
        let [mut outer, mut inner] = [Terms::default(); 2];
        let mut height = 0.0;
        let at_wall = self.classes.of_radius(radius);
        for f in &self.filled {
            let (r, size, v) = (f.radius, f.size, f.volume);
            // Between the plane that halves the wedge and what is above there is half as much room.
            let room = self.model.span * self.sums.heights[f.class];
            let size = if cut.across { size.min(room) } else { size };
            if r >= radius {
                outer.inside += v / size.min(width(r)).powi(3);
            } else {
                let from_wall = width(radius) + self.model.growth * (radius - r);
                inner.inside += v / size.min(from_wall).powi(3);
            }
            if f.class == at_wall {
                height += v / (TAU * r * self.classes.width());
            }
        }
        outer.inside += self.needles;
        outer.skin += self.skin;
        for (i, squares) in self.sums.walls.iter().enumerate() {
            // The plane that halves wedge and hub: as wide as its circle is long, for all copies.
            let across = match cut.across && self.sums.heights[i] > 0.0 {
                true => TAU * self.classes.radius(i) / self.sums.heights[i] * squares,
                false => 0.0,
            };
            if i >= at_wall {
                outer.skin += 2.0 * cut.copies * squares + across;
            } else {
                let copies = if hub.is_some() { cut.hub_copies } else { 0.0 };
                inner.skin += 2.0 * copies * squares + across;
            }
        }
        if let Some(hub) = hub {
            let squares = self.sums.walls[at_wall] / self.classes.width();
            let layers = self.layers(cut, hub, TAU * hub * height, width(hub));
            for terms in [&mut outer, &mut inner] {
                terms.hub_skin += TAU * hub * squares;
                terms.inside += layers;
            }
        }
        [outer, inner]
    }

    /// Elements, on either side of the hub's wall of the given area, in layers between it and steep faces nearer
    /// than the size wanted at the wall, down to the thinnest there are.
    fn layers(&self, cut: &Cut, hub: f64, wall: f64, wanted: f64) -> f64 {
        let mut sum = 0.0;
        for &[low, high] in &self.steep {
            let gap = if low > cut.reach * hub {
                low - cut.reach * hub
            } else if high < hub {
                hub - high
            } else {
                0.0
            };
            if gap < wanted {
                let gap = gap.max(self.thinnest.min(wanted));
                sum += wall / (2.0 * self.model.growth) * (gap.powi(-2) - wanted.powi(-2));
            }
        }
        sum
    }

    /// Whether a wedge of an angle (radians) is too narrow where the axis runs through material.
    pub fn is_narrow(&self, angle: f64) -> bool {
        self.solid && angle < self.model.wide
    }

    /// Radii for hubs: some of each interval between steep faces that is wider than a class of radius.
    pub fn radii(&self) -> Vec<f64> {
        if !self.solid {
            return Vec::new();
        }
        let mut free = Vec::new();
        let mut from = 0.0;
        for &[low, high] in &self.steep {
            free.push([from, low]);
            from = high;
        }
        free.push([from, self.radius]);
        let mut radii = Vec::new();
        let wide = |f: &[f64; 2]| f[1] - f[0] > self.classes.width();
        for [low, high] in free.into_iter().filter(wide) {
            radii.extend(HUB_PLACES.map(|part| low + part * (high - low)));
        }
        radii
    }

    /// The elements and the time of a way, over those of the whole body.
    pub fn way(&self, cut: usize, of: &Cut, hub: Option<f64>) -> Way {
        let model = &self.model;
        let whole = self.whole().elements(model);
        let [outer, inner] = self.parts(of, hub).map(|terms| terms.elements(model));
        let outer = outer + self.seams(of);
        let starts = if hub.is_some() {
            1.0 + model.hub_time
        } else {
            1.0
        };
        let meshed = outer / of.copies + model.hub_time * inner / of.hub_copies;
        Way {
            cut,
            hub,
            elements: (outer + inner) / whole,
            meshed: (meshed + model.start * starts) / whole,
        }
    }

    /// Elements that the cut faces cost by what they slice.
    pub fn seams(&self, cut: &Cut) -> f64 {
        self.model.sliced * cut.harm
    }
}

/// Places tried for the wall of a hub between two steep faces, as shares of the way from the inner one: closer to
/// each other towards the outer one, since the room for elements grows with the radius there, and never nearer to a
/// face than an eighth of the interval. A choice: with eighths, twelfths or sixteenths instead, the vias of the
/// benchmark get up to 13 % more or fewer elements, without any trend.
const HUB_PLACES: [f64; 7] = [0.2, 0.35, 0.5, 0.6, 0.7, 0.8, 0.88];

/// The classes that have any volume, by radius and size.
fn filled(sums: &Integral, classes: Classes) -> Vec<Filled> {
    let mut filled = Vec::new();
    for (class, row) in sums.volume.iter().enumerate() {
        let sizes = row.iter().enumerate().filter(|(_, v)| **v > 0.0);
        filled.extend(sizes.map(|(j, &volume)| Filled {
            class,
            radius: classes.radius(class),
            size: classes.size(j),
            volume,
        }));
    }
    filled
}

/// Whether a side of a triangle lies on the axis.
fn on_axis(t: &[DVec2; 3]) -> bool {
    t.iter().filter(|p| p.x == 0.0).count() > 1
}
