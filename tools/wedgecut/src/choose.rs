//! Which order to mesh at, and whether to make a hub.
//!
//! Elements are as large as features nearby allow: the thickness of layers, the length of edges. A
//! wedge that is narrower than that makes them smaller, and where the axis runs through material
//! every wedge gets narrow. The number of elements is estimated by integrating the inverse cube of
//! their size over the section of the body, for the whole body and for wedges of every order with
//! hubs of several radii; the fastest to mesh wins among those that cost few more elements than the
//! whole body.

use crate::integral::{Classes, GROWTH, Integral, Part, RADII, Sample};
use crate::section::NO_MARKER;
use geom::edges::Edges;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use tmesh::{OUTSIDE, Template, Wall};

/// Size of elements over the width of a wedge that does not disturb them, between mirror planes, and
/// between the faces of a seam, whose triangles stay as they are.
const SPAN: f64 = 1.2;
const SEAM_SPAN: f64 = 0.7;
/// Elements of the assembled mesh over those of a mesh of the whole body that are accepted, of wedges
/// between mirror planes.
const ACCEPTED: f64 = 1.22;
/// The same of wedges with a seam: its triangles limit what can be done about bad elements.
const ACCEPTED_SEAM: f64 = 1.15;
/// The same where a hub or the plane across the axis is cut: their elements are estimated less well.
const ACCEPTED_MORE_CUTS: f64 = 1.09;
/// The same of hubs where the bound on the radius-edge ratio is 2 or more: with every looser bound the whole
/// body loses more elements than hub and narrow wedge do. Measured on vias of order 128.
const ACCEPTED_LOOSE_HUB: f64 = 1.03;
/// Radius-edge bound that the mesher will be given, where nothing else is said, and that up to which
/// [`ACCEPTED_MORE_CUTS`] holds for hubs.
pub const RADIUS_EDGE: f64 = 1.4;
const TIGHT: f64 = 1.7;
/// Elements beside a square of the boundary of their size, over those in a cube of it, where a size
/// that was asked for limits them: wedges have more boundary than their part of the body.
const SKIN: f64 = 0.25;
/// The same for the wall between wedge and hub, which gets the triangles of two meshes.
const HUB_SKIN: f64 = 0.6;
/// Elements, up to the same factor as everything here, that a seam costs per copy of the wedge for each
/// unit of the harm it does to faces it slices: a hundred tetrahedra, of which about 17 make one here.
const SLICED: f64 = 6.0;
/// Time for an element of the hub, which is meshed twice, over that for one of the wedge.
const HUB_COST: f64 = 2.0;
/// Elements, up to the same factor, that are meshed in the time that it takes to start the mesher: some 400. With
/// tiny meshes, nothing is won by a narrower wedge, nor by a hub.
const START: f64 = 25.0;
/// Ways within this factor of the fastest are as fast; the one of the lowest order has the fewest cuts.
const AS_FAST: f64 = 1.02;
/// Angle of a wedge, degrees, from which it needs no hub where the axis runs through material.
const WIDE: f64 = 44.0;
/// Cells of the grid on which samples are thinned out, per direction.
const CELLS: f64 = 256.0;
/// Most pairs of a sample and an edge that are looked at.
const PAIRS: usize = 20_000_000;

/// Body volume by radius and element size.
pub struct Estimate {
    classes: Classes,
    sums: Integral,
    /// The classes that have any volume.
    filled: Vec<Filled>,
    /// The body's boundary over the square of the size, where the size is one that was asked for.
    skin: f64,
    /// Whether there is material on the axis.
    solid: bool,
    /// Radii blocked by steep faces, increasing, disjoint.
    steep: Vec<[f64; 2]>,
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

/// A way to mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Order of the wedge.
    pub order: u32,
    /// Inscribed radius of the hub.
    pub hub: Option<f64>,
    /// Whether the mirror plane across the axis halves the wedge.
    pub level: bool,
    /// Estimated elements over those of the whole body.
    pub elements: f64,
    /// Time to mesh it, as estimated elements over those of the whole body.
    pub meshed: f64,
}

/// What there is to choose from.
pub struct Options<'a> {
    /// Orders.
    pub orders: &'a [u32],
    /// Whether wedges end at mirror planes.
    pub mirror: bool,
    /// Order of the hub for an order of the wedge.
    pub hub_order: &'a dyn Fn(u32) -> u32,
    /// Radius asked for; `None` chooses, or none if `no_hub`.
    pub radius: Option<f64>,
    /// No hub.
    pub no_hub: bool,
    /// Whether there is a mirror plane across the axis to halve wedges at.
    pub level: bool,
    /// How much a seam harms the faces it slices, see [`crate::sliced::Harm`].
    pub harm: f64,
    /// Bound on the radius-edge ratio that the mesher will be given.
    pub radius_edge: f64,
}

impl Estimate {
    /// Looks at the section and the edges of a wedge of the order found. `max_volume` is the largest
    /// volume of an element in a region, model units cubed, where one will be asked for.
    /// `copies` of the wedge make the body, whose thin triangles cost `needles`. The result does not depend on
    /// the number of `threads`.
    pub fn new(
        wedge: &Template,
        copies: usize,
        needles: f64,
        max_volume: impl Fn(u32) -> Option<f64>,
        threads: usize,
    ) -> Self {
        let sections = sections(wedge);
        let mut extent = 0.0_f64;
        for p in &wedge.vertices {
            extent = extent.max(p.x.hypot(p.y)).max(p.z.abs());
        }
        let mut samples = edge_samples(wedge);
        // A seam slices corners of the body at any angle: sharp ones of its section tell nothing.
        let sliced = wedge.walls.iter().any(|w| matches!(w, Wall::Seam(_)));
        for section in &sections {
            let outline = Outline::new(section);
            outline.thickness(extent, sliced, &mut samples);
        }
        let samples = thinned(samples, extent);
        let caps = sections.iter().flatten();
        let caps = caps.filter_map(|(_, region)| max_volume(*region).map(edge_of_volume));
        let sizes = samples.iter().map(|s| s.size).chain(caps);
        let least = sizes.fold(extent, f64::min).max(extent * 1e-6);
        let classes = Classes { extent, least };
        let weight = 1.0 / sections.len().max(1) as f64;
        let part = |(corners, region): &([DVec2; 3], u32)| Part {
            corners: *corners,
            cap: max_volume(*region).map_or(f64::INFINITY, edge_of_volume),
            weight,
        };
        let parts: Vec<Part> = sections.iter().flatten().map(part).collect();
        let sums = Integral::over(&parts, &samples, classes, threads);
        let mut estimate = Self {
            classes,
            filled: filled(&sums, classes),
            sums,
            skin: 0.0,
            solid: sections.iter().flatten().any(|(t, _)| on_axis(t)),
            steep: steep(wedge),
            needles,
        };
        estimate.skin = estimate.boundary(wedge, copies);
        estimate
    }

    /// Area of the body's boundary over the square of the size of elements, as far as their size is one
    /// that was asked for.
    fn boundary(&self, wedge: &Template, copies: usize) -> f64 {
        let squares: f64 = self.sums.walls.iter().sum();
        let area = |f: &Filled| f.volume / (std::f64::consts::TAU * f.radius);
        let section: f64 = self.filled.iter().map(area).sum();
        let outer = wedge
            .triangles
            .iter()
            .filter(|t| t.marker != NO_MARKER && (t.front == OUTSIDE || t.back == OUTSIDE));
        let area: f64 = outer
            .map(|t| {
                let [a, b, c] = geom::measure::corners(&wedge.vertices, t);
                geom::measure::triangle_area(a, b, c)
            })
            .sum();
        if section > 0.0 {
            area * copies as f64 * squares / section
        } else {
            0.0
        }
    }

    /// Elements of the body meshed as a whole, up to a factor.
    fn whole(&self) -> f64 {
        let elements = |f: &Filled| f.volume / f.size.powi(3);
        let inside: f64 = self.filled.iter().map(elements).sum();
        inside + SKIN * self.skin + self.needles
    }

    /// Elements of wedges and hubs, up to the same factor; `copies` of each.
    fn parts(&self, way: &Choice, mirror: bool, copies: [f64; 2]) -> (f64, f64) {
        let Choice { order, hub, .. } = *way;
        let angle = opening(order, mirror);
        // Wide wedges have room for elements of any size, at the axis too.
        let tangent = if angle.to_degrees() < WIDE {
            (0.5 * angle).tan()
        } else {
            f64::INFINITY
        };
        let span = if mirror { SPAN } else { SEAM_SPAN };
        let width = |r: f64| span * 2.0 * tangent * r;
        let radius = hub.unwrap_or(0.0);
        let (mut outer, mut inner, mut height) = (0.0, 0.0, 0.0);
        let at_wall = self.classes.of_radius(radius);
        for f in &self.filled {
            let (r, size, v) = (f.radius, f.size, f.volume);
            // Between the plane that halves the wedge and what is above there is half as much room.
            let room = SPAN * self.sums.heights[f.class];
            let size = if way.level { size.min(room) } else { size };
            if r >= radius {
                outer += v / size.min(width(r)).powi(3);
            } else {
                let from_wall = width(radius) + GROWTH * (radius - r);
                inner += v / size.min(from_wall).powi(3);
            }
            if f.class == at_wall {
                height += v / (std::f64::consts::TAU * r * self.classes.extent / RADII as f64);
            }
        }
        outer += SKIN * self.skin + self.needles;
        for (i, squares) in self.sums.walls.iter().enumerate() {
            // The plane that halves wedge and hub: as wide as its circle is long, for all copies.
            let circle = std::f64::consts::TAU * self.classes.radius(i);
            let across = match way.level && self.sums.heights[i] > 0.0 {
                true => SKIN * circle / self.sums.heights[i] * squares,
                false => 0.0,
            };
            if i >= at_wall {
                outer += SKIN * 2.0 * copies[0] * squares + across;
            } else {
                inner += SKIN * 2.0 * copies[1] * squares + across;
            }
        }
        if let Some(hub) = hub {
            let squares = self.sums.walls[at_wall] / (self.classes.extent / RADII as f64);
            outer += HUB_SKIN * std::f64::consts::TAU * hub * squares;
            inner += HUB_SKIN * std::f64::consts::TAU * hub * squares;
            // Layers between the hub's wall and steep faces.
            let corner = hub / (0.5 * angle).cos();
            let corner = if mirror { hub / angle.cos() } else { corner };
            let wanted = width(hub);
            for &[low, high] in &self.steep {
                let gap = if low > corner {
                    low - corner
                } else if high < hub {
                    hub - high
                } else {
                    0.0
                };
                if gap < wanted {
                    let gap = gap.max(0.01 * wanted);
                    let wall = std::f64::consts::TAU * hub * height;
                    let extra = wall / (2.0 * GROWTH) * (gap.powi(-2) - wanted.powi(-2));
                    outer += extra;
                    inner += extra;
                }
            }
        }
        (outer, inner)
    }

    /// Radii that a hub may have.
    fn radii(&self) -> Vec<f64> {
        let mut free = Vec::new();
        let mut from = 0.0;
        for &[low, high] in &self.steep {
            free.push([from, low]);
            from = high;
        }
        let most = self.classes.extent;
        free.push([from, most]);
        let mut radii = Vec::new();
        for [low, high] in free.into_iter().filter(|f| f[1] - f[0] > 1e-3 * most) {
            for part in [0.2, 0.35, 0.5, 0.6, 0.7, 0.8, 0.88] {
                radii.push(low + part * (high - low));
            }
        }
        radii
    }

    /// The ways to mesh, each order with its best hub.
    pub fn ways(&self, options: &Options<'_>) -> Vec<Choice> {
        let whole = self.whole();
        if whole.is_nan() || whole <= 0.0 {
            return Vec::new();
        }
        let radii = match options.radius {
            Some(radius) => vec![radius],
            None if options.no_hub || !self.solid => Vec::new(),
            None => self.radii(),
        };
        let levels: &[bool] = if options.level {
            &[false, true]
        } else {
            &[false]
        };
        let mut ways = Vec::new();
        for &order in options.orders {
            let angle = opening(order, options.mirror);
            let narrow = angle.to_degrees() < WIDE && self.solid;
            let mut hubs: Vec<Option<f64>> = Vec::new();
            if options.radius.is_none() && (!narrow || radii.is_empty()) {
                hubs.push(None);
            }
            if narrow || options.radius.is_some() {
                hubs.extend(radii.iter().map(|&r| Some(r)));
            }
            let mut found: Vec<Choice> = Vec::new();
            // Halves have half of the seam each.
            let seam = SLICED * options.harm * f64::from(order);
            // Half a turn between the faces of a seam is left whole: three walls in two planes.
            let half = order == 2 && !options.mirror;
            for &level in levels.iter().filter(|&&level| !(level && half)) {
                let doubled = |on: bool| if on { 2.0 } else { 1.0 };
                let images = doubled(options.mirror) * doubled(level);
                let copies = images * f64::from(order);
                let hub_copies = images * f64::from((options.hub_order)(order));
                for &hub in &hubs {
                    let mut way = Choice {
                        order,
                        hub,
                        level,
                        elements: 0.0,
                        meshed: 0.0,
                    };
                    let both = [copies, if hub.is_some() { hub_copies } else { 0.0 }];
                    let (mut outer, inner) = self.parts(&way, options.mirror, both);
                    outer += seam;
                    way.elements = (outer + inner) / whole;
                    let starts = if hub.is_some() { 1.0 + HUB_COST } else { 1.0 };
                    let meshed = outer / copies + HUB_COST * inner / hub_copies;
                    way.meshed = (meshed + START * starts) / whole;
                    found.push(way);
                }
            }
            // No other plane changes what the seam costs.
            ways.extend(options.best(&found, 1.0 + seam / whole));
        }
        ways
    }
}

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

impl Options<'_> {
    /// The fastest way within the accepted number of elements, else the one with the fewest. `base`: the
    /// elements that cannot be avoided, over those of the whole body.
    pub fn best(&self, ways: &[Choice], base: f64) -> Option<Choice> {
        let loose = ((self.radius_edge - TIGHT) / (2.0 - TIGHT)).clamp(0.0, 1.0);
        let limit = |w: &Choice| match (w.hub, w.level, self.mirror) {
            (Some(_), ..) => ACCEPTED_MORE_CUTS + (ACCEPTED_LOOSE_HUB - ACCEPTED_MORE_CUTS) * loose,
            (None, true, _) => ACCEPTED_MORE_CUTS,
            (None, false, true) => ACCEPTED,
            (None, false, false) => ACCEPTED_SEAM,
        };
        let accepted = || ways.iter().filter(|w| w.elements <= base * limit(w));
        let least = accepted().map(|w| w.meshed).fold(f64::INFINITY, f64::min);
        let as_fast = accepted().filter(|w| w.meshed <= AS_FAST * least);
        let chosen =
            as_fast.min_by(|a, b| a.order.cmp(&b.order).then(a.meshed.total_cmp(&b.meshed)));
        let fewest = || ways.iter().min_by(|a, b| a.elements.total_cmp(&b.elements));
        chosen.or_else(fewest).copied()
    }
}

fn opening(order: u32, mirror: bool) -> f64 {
    let full = if mirror { 1.0 } else { 2.0 };
    full * std::f64::consts::PI / f64::from(order)
}

/// Edge of the regular tetrahedron of a volume, model units.
pub fn edge_of_volume(volume: f64) -> f64 {
    (volume * 6.0 * std::f64::consts::SQRT_2).cbrt()
}

/// Triangles of the body's section with each side of the wedge, by radius and height.
fn sections(wedge: &Template) -> Vec<Vec<([DVec2; 3], u32)>> {
    let triangles = |list: Vec<u32>| -> Vec<([DVec2; 3], u32)> {
        list.into_iter()
            .map(|t| {
                let t = &wedge.triangles[t as usize];
                let at = |v: u32| flat(wedge.vertices[v as usize]);
                (t.vertices.map(at), t.back)
            })
            .collect()
    };
    wedge
        .walls
        .iter()
        .filter_map(|wall| match wall {
            Wall::Mirror(mirror) => Some(triangles(mirror.triangles.clone())),
            Wall::Seam(seam) => Some(triangles(
                seam.triangle_pairs.iter().map(|p| p[0]).collect(),
            )),
            Wall::Hub(_) => None,
        })
        .collect()
}

/// Whether a side of a triangle lies on the axis.
fn on_axis(t: &[DVec2; 3]) -> bool {
    t.iter().filter(|p| p.x == 0.0).count() > 1
}

fn flat(p: DVec3) -> DVec2 {
    DVec2::new(p.x.hypot(p.y), p.z)
}

/// Lengths of the edges of the body, at their ends. Edges in the walls are cuts; those that end at a
/// mirror plane go on behind it, and those that end at a seam go on from its other face.
fn edge_samples(wedge: &Template) -> Vec<Sample> {
    let mut on = vec![0_u8; wedge.vertices.len()];
    let mut partner: FxHashMap<u32, u32> = FxHashMap::default();
    for (i, wall) in wedge.walls.iter().enumerate() {
        match wall {
            Wall::Mirror(m) => m
                .vertices
                .iter()
                .for_each(|&v| on[v as usize] |= 1 << (i % 8)),
            Wall::Seam(s) => {
                for &[low, high] in &s.vertex_pairs {
                    on[low as usize] |= 1;
                    on[high as usize] |= 2;
                    partner.insert(low, high);
                    partner.insert(high, low);
                }
            }
            Wall::Hub(_) => {}
        }
    }
    let corners: Vec<[u32; 3]> = wedge.triangles.iter().map(|t| t.vertices).collect();
    let edges = Edges::new(&corners);
    let normal = |t: u32| {
        let [a, b, c] = geom::measure::corners(&wedge.vertices, &wedge.triangles[t as usize]);
        geom::measure::double_area_vector(a, b, c).normalize_or_zero()
    };
    let mut pieces: Vec<([u32; 2], f64)> = Vec::new();
    // Longest piece of an edge that ends at a vertex of the seam.
    let mut longest: FxHashMap<u32, f64> = FxHashMap::default();
    for e in 0..edges.len() {
        let [a, b] = edges.ends[e];
        if on[a as usize] & on[b as usize] != 0 {
            continue;
        }
        let around = edges.around(e);
        let is_flat = matches!(around, [u, v]
            if normal(u.triangle).dot(normal(v.triangle)) > 1.0 - 1e-9);
        if is_flat {
            continue;
        }
        let length = wedge.vertices[a as usize].distance(wedge.vertices[b as usize]);
        for v in [a, b].into_iter().filter(|v| partner.contains_key(v)) {
            let known = longest.entry(v).or_default();
            *known = known.max(length);
        }
        pieces.push(([a, b], length));
    }
    let mut samples = Vec::with_capacity(2 * pieces.len());
    for (ends, length) in pieces {
        let behind = |v: u32| match partner.get(&v) {
            Some(other) => longest.get(other).copied().unwrap_or(0.0),
            None if on[v as usize] != 0 => length,
            None => 0.0,
        };
        let size = length + behind(ends[0]).max(behind(ends[1]));
        samples.extend(ends.map(|v| Sample {
            at: flat(wedge.vertices[v as usize]),
            size,
        }));
    }
    samples
}

/// Keeps the smallest size per cell of a grid.
fn thinned(samples: Vec<Sample>, extent: f64) -> Vec<Sample> {
    let mut best: FxHashMap<[i64; 2], Sample> = FxHashMap::default();
    for s in samples {
        let cell = (s.at / extent * CELLS).floor().to_array().map(|x| x as i64);
        let entry = best.entry(cell).or_insert(s);
        if s.size < entry.size {
            *entry = s;
        }
    }
    let mut kept: Vec<_> = best.into_iter().collect();
    kept.sort_unstable_by_key(|(cell, _)| *cell);
    kept.into_iter().map(|(_, s)| s).collect()
}

/// An edge of the section's outline or between two regions; material on either side.
struct OutlineEdge {
    a: DVec2,
    b: DVec2,
    /// Whether there is material to the left, and to the right.
    material: [bool; 2],
}

impl OutlineEdge {
    /// Whether two edges have an end in common.
    fn touches(&self, other: &Self) -> bool {
        [self.a, self.b]
            .iter()
            .any(|p| *p == other.a || *p == other.b)
    }
}

struct Outline {
    edges: Vec<OutlineEdge>,
}

impl Outline {
    fn new(section: &[([DVec2; 3], u32)]) -> Self {
        let key = |p: DVec2| p.to_array().map(|x| (x + 0.0).to_bits());
        type Ends = ([u64; 2], [u64; 2]);
        let mut seen: FxHashMap<Ends, u32> = FxHashMap::default();
        for (t, region) in section {
            for k in 0..3 {
                seen.insert((key(t[k]), key(t[(k + 1) % 3])), *region);
            }
        }
        let mut edges = Vec::new();
        for (t, region) in section {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                let other = seen.get(&(key(b), key(a))).copied().unwrap_or(OUTSIDE);
                let on_axis = a.x == 0.0 && b.x == 0.0;
                // An edge between two regions comes twice.
                let twice = other != OUTSIDE && key(a) > key(b);
                if other != *region && !on_axis && !twice {
                    let ccw = (t[1] - t[0]).perp_dot(t[2] - t[0]) > 0.0;
                    let outside = other != OUTSIDE;
                    let material = if ccw {
                        [true, outside]
                    } else {
                        [outside, true]
                    };
                    edges.push(OutlineEdge { a, b, material });
                }
            }
        }
        Self { edges }
    }

    /// Thickness of what lies on either side of each edge; `sliced` for that up to edges next to it not
    /// to count.
    fn thickness(&self, extent: f64, sliced: bool, samples: &mut Vec<Sample>) {
        let count = self.edges.len().max(1);
        let most = (PAIRS / count).max(1);
        let length: f64 = self.edges.iter().map(|e| e.a.distance(e.b)).sum();
        let step = (length / most as f64).max(extent / 64.0);
        let stride = count.div_ceil(most);
        for edge in self.edges.iter().step_by(stride) {
            let along = edge.b - edge.a;
            let parts = (along.length() / step).ceil().clamp(1.0, 64.0) as usize;
            let normal = along.perp().normalize_or_zero();
            for i in 0..parts {
                let from = edge.a + along * ((i as f64 + 0.5) / parts as f64);
                for (side, direction) in [normal, -normal].into_iter().enumerate() {
                    if edge.material[side]
                        && let Some((size, hit)) = self.nearest(from, direction, 1e-9 * extent)
                        && !(sliced && edge.touches(hit))
                    {
                        samples.push(Sample { at: from, size });
                        samples.push(Sample {
                            at: from + direction * size,
                            size,
                        });
                    }
                }
            }
        }
    }

    /// Distance to the next edge along a ray, and that edge.
    fn nearest(&self, from: DVec2, direction: DVec2, least: f64) -> Option<(f64, &OutlineEdge)> {
        let mut best = f64::INFINITY;
        let mut hit = None;
        for e in &self.edges {
            let (u, v) = (e.a - from, e.b - from);
            let (p, q) = (direction.perp_dot(u), direction.perp_dot(v));
            if p * q > 0.0 || p == q {
                continue;
            }
            let t = direction.dot(u + (v - u) * (p / (p - q)));
            if t > least && t < best {
                best = t;
                hit = Some(e);
            }
        }
        hit.map(|e| (best, e))
    }
}

/// Radii that faces nearer to the axis' direction than to the radial one cover.
fn steep(wedge: &Template) -> Vec<[f64; 2]> {
    let mut covered = Vec::new();
    for t in wedge.triangles.iter().filter(|t| t.marker != NO_MARKER) {
        let corners = geom::measure::corners(&wedge.vertices, t);
        let [a, b, c] = corners;
        let normal = geom::measure::double_area_vector(a, b, c);
        if normal.z.abs() < normal.truncate().length() {
            let flat = corners.map(DVec3::truncate);
            let near = (0..3).map(|k| from_origin(flat[k], flat[(k + 1) % 3]));
            let far = flat.iter().fold(0.0_f64, |m, p| m.max(p.length()));
            covered.push([near.fold(f64::INFINITY, f64::min), far]);
        }
    }
    merged(covered)
}

/// Distance of a segment from the origin.
fn from_origin(a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let t = (-a.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    if t.is_nan() {
        a.length()
    } else {
        (a + along * t).length()
    }
}

fn merged(mut intervals: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    intervals.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut merged: Vec<[f64; 2]> = Vec::new();
    for i in intervals {
        match merged.last_mut() {
            Some(last) if i[0] <= last[1] => last[1] = last[1].max(i[1]),
            _ => merged.push(i),
        }
    }
    merged
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loose_bounds_accept_less_of_a_hub() {
        let way = |order, hub, elements, meshed| Choice {
            order,
            hub,
            level: false,
            elements,
            meshed,
        };
        let chosen = |radius_edge: f64, hub: Option<f64>| {
            let options = Options {
                orders: &[4, 8],
                mirror: true,
                hub_order: &|n| n,
                radius: None,
                no_hub: false,
                level: false,
                harm: 0.0,
                radius_edge,
            };
            let ways = [way(4, hub, 1.0, 0.2), way(8, hub, 1.06, 0.1)];
            options.best(&ways, 1.0).unwrap().order
        };
        let hub = Some(0.1);
        assert_eq!([1.4, 1.7, 1.95, 3.0].map(|r| chosen(r, hub)), [8, 8, 4, 4]);
        assert_eq!([1.4, 3.0].map(|r| chosen(r, None)), [8, 8]);
    }
}
