//! What the instances make of the templates, without placing a single copy.
//!
//! The instance algebra here is the referee's own: it shares nothing with the numbering by which
//! meshes are assembled, so that an error there cannot hide itself here.

use geom::sets::DisjointSets;
use rustc_hash::{FxHashMap, FxHashSet};
use serde::Serialize;
use serde::ser::{SerializeStruct, Serializer};
use std::collections::BTreeMap;
use tmesh::{Document, Group, Isometry, OUTSIDE, Outside, Template};

/// Counts over the instances of a document.
pub struct Copies {
    /// Number of instances of each template.
    pub of_template: Vec<u64>,
    /// Number of instances of each (template, region map).
    pub of_map: BTreeMap<(u32, u32), u64>,
}

impl Copies {
    /// Counts the instances.
    pub fn of(document: &Document) -> Self {
        let mut of_template = vec![0; document.templates.len()];
        let mut of_map = BTreeMap::new();
        for instance in &document.instances {
            of_template[instance.template as usize] += 1;
            *of_map
                .entry((instance.template, instance.region_map))
                .or_insert(0) += 1;
        }
        Self {
            of_template,
            of_map,
        }
    }
}

/// Whether the document is a wedge taken out of its context, each template placed at most once: its
/// walls are open faces.
pub fn is_sector(document: &Document) -> bool {
    let copies = Copies::of(document).of_template;
    copies.iter().all(|&n| n <= 1) && document.templates.iter().any(|t| !t.gluings.is_empty())
}

/// For each triangle of a template, whether it is on a wall, be it the template's own or another
/// template's hub wall.
pub fn wall_triangles(document: &Document) -> Vec<Vec<bool>> {
    let mut on: Vec<Vec<bool>> = document
        .templates
        .iter()
        .map(|t| vec![false; t.triangles.len()])
        .collect();
    for (index, template) in document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            for &[here, there] in &gluing.triangle_pairs {
                on[index][here as usize] = true;
                on[gluing.other as usize][there as usize] = true;
            }
        }
    }
    on
}

/// From a vertex of instance `g`: the same point as `vertex` of instance `g * step` of `template`.
#[derive(Clone, Copy)]
struct Link {
    step: Isometry,
    template: u32,
    vertex: u32,
}

/// A vertex of a placed template: template, placement, vertex.
pub type Place = (u32, Isometry, u32);

/// The links that walls make between vertices.
pub struct Links(Vec<FxHashMap<u32, Vec<Link>>>);

impl Links {
    /// Collects the links of a document.
    pub fn of(document: &Document) -> Self {
        Self(links(document))
    }

    /// The placed vertices that the walls make one with a placed vertex, across one wall each.
    pub fn from(&self, place: Place) -> impl Iterator<Item = Place> {
        neighbours(place, &self.0)
    }

    /// Whether the walls make two placed vertices one, given that all neighbours exist.
    pub fn join(&self, a: Place, b: Place) -> bool {
        let mut seen = FxHashSet::from_iter([a]);
        let mut stack = vec![a];
        while let Some(place) = stack.pop() {
            if place == b {
                return true;
            }
            stack.extend(neighbours(place, &self.0).filter(|next| seen.insert(*next)));
        }
        false
    }
}

fn neighbours(
    (t, isometry, v): Place,
    links: &[FxHashMap<u32, Vec<Link>>],
) -> impl Iterator<Item = Place> + use<'_> {
    let own = links[t as usize].get(&v).into_iter().flatten();
    own.map(move |l| (l.template, isometry.compose(l.step), l.vertex))
}

/// Number of vertices of the assembled mesh.
///
/// Each (instance, vertex) is one of `k` names of an assembled vertex, linked by the walls; it counts
/// 1/k. Links act on the right of an instance's isometry, so `k` is the same for all instances of a
/// template, unless a hub wall is involved, whose two templates may have different numbers of
/// instances: those vertices are followed from every instance.
pub fn assembled_vertices(document: &Document) -> u64 {
    let copies = Copies::of(document);
    let links = links(document);
    let placed: FxHashSet<(u32, Isometry)> = document
        .instances
        .iter()
        .map(|i| (i.template, i.isometry))
        .collect();
    // Places by number of names; each sum is a multiple of its key.
    let mut places: BTreeMap<u64, u64> = BTreeMap::new();
    let mut known: FxHashMap<Vec<Isometry>, u64> = FxHashMap::default();
    for (index, template) in document.templates.iter().enumerate() {
        let t = index as u32;
        let copies = copies.of_template[index];
        let linked = &links[index];
        *places.entry(1).or_insert(0) += (template.vertices.len() - linked.len()) as u64 * copies;
        let mut vertices: Vec<u32> = linked.keys().copied().collect();
        vertices.sort_unstable();
        let instances: Vec<Isometry> = document
            .instances
            .iter()
            .filter(|i| i.template == t)
            .map(|i| i.isometry)
            .collect();
        let Some(&first) = instances.first() else {
            continue;
        };
        for v in vertices {
            let own = &linked[&v];
            if own.iter().all(|l| (l.template, l.vertex) == (t, v)) {
                let steps: Vec<Isometry> = own.iter().map(|l| l.step).collect();
                let names = *known
                    .entry(steps)
                    .or_insert_with(|| names((t, first, v), &links, &placed).0);
                *places.entry(names).or_insert(0) += copies;
                continue;
            }
            let (count, one_template) = names((t, first, v), &links, &placed);
            if one_template && !touches_other(t, v, &links) {
                *places.entry(count).or_insert(0) += copies;
                continue;
            }
            for &isometry in &instances {
                let (count, _) = names((t, isometry, v), &links, &placed);
                *places.entry(count).or_insert(0) += 1;
            }
        }
    }
    places.iter().map(|(names, places)| places / names).sum()
}

fn links(document: &Document) -> Vec<FxHashMap<u32, Vec<Link>>> {
    let mut links: Vec<FxHashMap<u32, Vec<Link>>> =
        vec![FxHashMap::default(); document.templates.len()];
    let mut add = |from: (u32, u32), step: Isometry, to: (u32, u32)| {
        links[from.0 as usize]
            .entry(from.1)
            .or_default()
            .push(Link {
                step,
                template: to.0,
                vertex: to.1,
            });
    };
    for (index, template) in document.templates.iter().enumerate() {
        let t = index as u32;
        for gluing in &template.gluings {
            let (other, step) = (gluing.other, gluing.step);
            for &[here, there] in &gluing.vertex_pairs {
                add((t, here), step, (other, there));
                // A reflection is its own inverse, and a second link would say nothing new.
                if !gluing.is_mirror(index) {
                    add((other, there), step.inverse(), (t, here));
                }
            }
        }
    }
    links
}

/// Whether a vertex, or one it is linked to, is linked to another template.
fn touches_other(t: u32, v: u32, links: &[FxHashMap<u32, Vec<Link>>]) -> bool {
    let mut seen = FxHashSet::from_iter([v]);
    let mut stack = vec![v];
    while let Some(v) = stack.pop() {
        for link in links[t as usize].get(&v).into_iter().flatten() {
            if link.template != t {
                return true;
            }
            if seen.insert(link.vertex) {
                stack.push(link.vertex);
            }
        }
    }
    false
}

/// Number of names of the assembled vertex that `start` names, and whether they are all of one
/// template.
fn names(
    start: Place,
    links: &[FxHashMap<u32, Vec<Link>>],
    placed: &FxHashSet<(u32, Isometry)>,
) -> (u64, bool) {
    let mut seen = FxHashSet::from_iter([start]);
    let mut stack = vec![start];
    let mut one_template = true;
    while let Some(place) = stack.pop() {
        for next in neighbours(place, links) {
            if placed.contains(&(next.0, next.1)) && seen.insert(next) {
                one_template &= next.0 == start.0;
                stack.push(next);
            }
        }
    }
    (seen.len() as u64, one_template)
}

/// The symmetry that the instances give the whole, or that a plain mesh promises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Realized {
    /// The group about the axis.
    pub group: Group,
    /// The higher symmetry away from the axis, if there is one.
    pub outside: Option<Outside>,
}

impl Serialize for Realized {
    /// The group by its symbol, and what it has: `order`, `mirror` for planes that contain the axis,
    /// `horizontal_mirror` for the one across it.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Beyond {
            group: Group,
            order: u32,
            mirror: bool,
            radius: f64,
        }
        let mut map = serializer.serialize_struct("symmetry", 5)?;
        map.serialize_field("group", &self.group)?;
        map.serialize_field("order", &self.group.order)?;
        map.serialize_field("mirror", &self.group.has_vertical_mirrors())?;
        map.serialize_field("horizontal_mirror", &self.group.has_horizontal_mirror())?;
        if let Some(Outside { group, radius }) = self.outside {
            let beyond = Beyond {
                group,
                order: group.order,
                mirror: group.has_vertical_mirrors(),
                radius,
            };
            map.serialize_field("outside", &beyond)?;
        }
        map.end()
    }
}

/// The symmetry of the instances, with their region maps: each operation has to permute the regions.
pub fn realized(document: &Document) -> Realized {
    let placements = Placements::of(document);
    let placed = placements.placed();
    let group = placements.group(&placed).0;
    let outside = placements.outside(&placed);
    Realized {
        group,
        outside: outside.filter(|o| o.group != group),
    }
}

/// An instance of each kind: symmetries of the instances take it onto all the others of its kind.
pub fn representatives(document: &Document) -> Vec<usize> {
    let placements = Placements::of(document);
    let placed = placements.placed();
    let (group, mirror) = placements.group(&placed);
    let numbers: FxHashMap<(u32, Isometry), u32> = (document.instances.iter().zip(0..))
        .map(|(i, number)| ((i.template, i.isometry), number))
        .collect();
    let mut kinds = DisjointSets::new(document.instances.len());
    for generator in generators(group, mirror) {
        for (instance, number) in document.instances.iter().zip(0..) {
            let image = generator.checked_compose(instance.isometry);
            let image = image.and_then(|image| numbers.get(&(instance.template, image)));
            image.map(|&image| kinds.join(number, image));
        }
    }
    let mut seen = FxHashSet::default();
    (0..document.instances.len())
        .filter(|&i| seen.insert(kinds.find(i as u32)))
        .collect()
}

/// The generators of a group, with the mirror that contains the axis where it is.
fn generators(group: Group, mirror: Option<Isometry>) -> impl Iterator<Item = Isometry> {
    let generators = group.generators().into_iter();
    generators.map(move |g| match g == Isometry::MIRROR {
        true => mirror.unwrap_or(g),
        false => g,
    })
}

/// The instances of a document, to be compared with their images.
struct Placements<'a> {
    document: &'a Document,
    /// Region map of each placed template.
    by_place: FxHashMap<(u32, Isometry), u32>,
    /// Regions of each template.
    used: Vec<Vec<u32>>,
    /// Number of instances of each template.
    copies: Vec<u64>,
    /// Common denominator of all turns of the instances.
    turns: u64,
}

impl<'a> Placements<'a> {
    fn of(document: &'a Document) -> Self {
        let places = document.instances.iter();
        Self {
            document,
            by_place: places
                .map(|i| ((i.template, i.isometry), i.region_map))
                .collect(),
            used: document.templates.iter().map(used_regions).collect(),
            copies: Copies::of(document).of_template,
            turns: document.instances.iter().fold(1, |common, i| {
                let n = u64::from(i.isometry.n());
                common / gcd(common, n) * n
            }),
        }
    }

    /// The templates that are placed.
    fn placed(&self) -> Vec<u32> {
        (0..self.copies.len() as u32)
            .filter(|&t| self.copies[t as usize] > 0)
            .collect()
    }

    /// The group of the operations that keep the instances of some templates, and the mirror that
    /// contains the axis which stands for all of them.
    fn group(&self, templates: &[u32]) -> (Group, Option<Isometry>) {
        let copies = templates.iter().map(|&t| self.copies[t as usize]);
        let shared = copies
            .fold(0, gcd)
            .min(u64::from(tmesh::MAX_TURN_DENOMINATOR));
        let order = (1..=shared as u32)
            .rev()
            .find(|&n| {
                // A rotation that keeps the instances is a product of their placements.
                [shared, self.turns]
                    .iter()
                    .all(|m| m.is_multiple_of(u64::from(n)))
                    && self.keep(templates, Isometry::rotation(1, n))
            })
            .unwrap_or(1);
        // All mirrors that contain the axis differ by rotations: those with the smallest turns will do.
        let of_template = |t: u32| {
            let instances = self.document.instances.iter();
            instances.filter(move |i| i.template == t)
        };
        let first = templates.first().and_then(|&t| of_template(t).next());
        let mirror = first.and_then(|first| {
            of_template(first.template)
                .map(|i| i.isometry.compose(first.isometry.inverse()))
                .filter(|m| m.mirrored() && !m.flipped())
                .filter(|m| u64::from(m.k()) * u64::from(order) < u64::from(m.n()))
                .find(|&m| self.keep(templates, m))
        });
        let group = Group::of(order, |g| match g == Isometry::MIRROR {
            true => mirror.is_some(),
            false => self.keep(templates, g),
        });
        (group, mirror)
    }

    /// The symmetry of the template that reaches farthest from the axis, and the radius beyond which
    /// there are only templates that share it.
    fn outside(&self, placed: &[u32]) -> Option<Outside> {
        if placed.len() < 2 {
            return None;
        }
        let templates = self.document.templates.iter();
        let reach: Vec<f64> = templates.map(Template::reach).collect();
        let far = |&a: &u32, &b: &u32| reach[a as usize].total_cmp(&reach[b as usize]);
        let farthest = placed.iter().copied().max_by(far)?;
        let (group, mirror) = self.group(&[farthest]);
        let shared_by =
            |templates: &[u32]| generators(group, mirror).all(|g| self.keep(templates, g));
        let (outer, inner): (Vec<u32>, Vec<u32>) = placed.iter().partition(|&&t| shared_by(&[t]));
        let radius = inner.iter().map(|&t| reach[t as usize]).fold(0.0, f64::max);
        (radius < reach[farthest as usize] && shared_by(&outer))
            .then_some(Outside { group, radius })
    }

    /// Whether an operation maps the instances of some templates onto such, and permutes their regions.
    fn keep(&self, templates: &[u32], operation: Isometry) -> bool {
        let mut forward: FxHashMap<u32, u32> = FxHashMap::default();
        let mut backward: FxHashMap<u32, u32> = FxHashMap::default();
        // Every pair of region maps is compared once.
        let mut compared = FxHashSet::default();
        let instances = self.document.instances.iter();
        for instance in instances.filter(|i| templates.contains(&i.template)) {
            let image = operation.checked_compose(instance.isometry);
            let map = image.and_then(|image| self.by_place.get(&(instance.template, image)));
            let Some(&map) = map else {
                return false;
            };
            if !compared.insert((instance.template, instance.region_map, map)) {
                continue;
            }
            let mapped = tmesh::Instance {
                region_map: map,
                ..*instance
            };
            for &region in &self.used[instance.template as usize] {
                let from = self.document.placed_region(instance, region);
                let to = self.document.placed_region(&mapped, region);
                if *forward.entry(from).or_insert(to) != to
                    || *backward.entry(to).or_insert(from) != from
                {
                    return false;
                }
            }
        }
        true
    }
}

/// Regions of a template's tetrahedra, or of its triangles when it has none, increasing.
fn used_regions(template: &Template) -> Vec<u32> {
    let mut used: Vec<u32> = if template.tets.is_empty() {
        let sides = template.triangles.iter().flat_map(|t| [t.front, t.back]);
        sides.filter(|&r| r != OUTSIDE).collect()
    } else {
        template.tets.iter().map(|t| t.region).collect()
    };
    used.sort_unstable();
    used.dedup();
    used
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use tmesh::{Instance, Region, Tet};

    #[test]
    fn rotations_finer_than_isometries_can_be_are_not_tried() {
        let mut document = Document::single(Template {
            vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            tets: vec![Tet {
                vertices: [0, 1, 2, 3],
                region: 1,
            }],
            ..Template::default()
        });
        document.regions.push(Region {
            id: 1,
            name: "a".to_owned(),
            size: None,
            volume: None,
        });
        // Three copies, but a third of a turn cannot be multiplied with their placements.
        let place = |k: i64| Instance {
            template: 0,
            isometry: Isometry::rotation(k, 32_768),
            region_map: 0,
        };
        document.instances = (0..3).map(place).collect();
        assert_eq!(tmesh::validate(&document), []);
        assert_eq!(realized(&document).group, Group::TRIVIAL);
    }
}
