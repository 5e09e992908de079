//! The vertices of outer faces, placed by all instances, and which of them gluings make one.

use crate::check::faces::Skin;
use crate::check::walls::Mesh;
use crate::instances::Links;
use geom::grid::coincident;
use geom::sets::DisjointSets;
use geom::tolerance::PROMISE;
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{Document, Isometry, Placed};

/// A vertex of a template's outer faces.
#[derive(Clone, Copy)]
struct Member {
    template: u32,
    vertex: u32,
    /// Distance from the axis and from the plane across it: no isometry changes them.
    orbit: [f64; 2],
}

/// Two placed vertices in one place that no gluing makes one.
#[derive(Clone, Copy)]
pub struct Meeting {
    /// Instance and vertex of each.
    pub vertices: [(usize, u32); 2],
    /// Where, in the frame of the document.
    pub point: DVec3,
    /// How far apart, model units.
    pub distance: f64,
}

/// The assembled vertices of outer faces.
pub struct Rim {
    /// Positions, in the frame of the document.
    pub points: Vec<DVec3>,
    /// First number in `ids` of each vertex of each template that is on an outer face.
    first: Vec<Vec<u32>>,
    /// Per vertex and instance of its template, the assembled vertex.
    ids: Vec<u32>,
    /// Place of each instance among those of its template that are compared.
    rank: FxHashMap<usize, u32>,
}

/// The instances that are compared, by template.
struct Instances<'a> {
    document: &'a Document,
    links: Links,
    /// Numbers of each template's instances.
    of_template: Vec<Vec<usize>>,
    /// Place of a placed template among the instances of the template.
    rank: FxHashMap<(u32, Isometry), u32>,
    placed: Vec<Placed>,
}

impl<'a> Instances<'a> {
    fn of(document: &'a Document, compared: &[usize]) -> Self {
        let mut of_template = vec![Vec::new(); document.templates.len()];
        let mut rank = FxHashMap::default();
        for &number in compared {
            let i = &document.instances[number];
            let own: &mut Vec<usize> = &mut of_template[i.template as usize];
            rank.insert((i.template, i.isometry), own.len() as u32);
            own.push(number);
        }
        let placed = document.instances.iter().map(|i| i.isometry.placed());
        Self {
            document,
            links: Links::of(document),
            of_template,
            rank,
            placed: placed.collect(),
        }
    }
}

impl Rim {
    /// Places the vertices of outer faces by the instances to be compared, and calls `found` for those that coincide and
    /// are not joined. Vertices that may coincide are as far from the axis, and from the plane across it, so
    /// that few are placed at a time. O(n log n) in the placed vertices.
    pub fn new(mesh: &Mesh<'_>, compared: &[usize], mut found: impl FnMut(Meeting)) -> Self {
        let instances = Instances::of(mesh.document, compared);
        let reach = PROMISE * mesh.size;
        let mut members = members(mesh.document, mesh.skins);
        let mut rim = Self {
            points: Vec::new(),
            first: (mesh.document.templates.iter())
                .map(|t| vec![u32::MAX; t.vertices.len()])
                .collect(),
            ids: Vec::new(),
            rank: FxHashMap::default(),
        };
        for class in classes(&mut members, reach) {
            rim.place(&instances, class, reach, &mut found);
        }
        for own in instances.of_template {
            rim.rank.extend(own.into_iter().zip(0..));
        }
        rim
    }

    /// The assembled vertex that a vertex of an instance is.
    pub fn id(&self, template: usize, instance: usize, vertex: u32) -> u32 {
        self.ids[(self.first[template][vertex as usize] + self.rank[&instance]) as usize]
    }

    /// Numbers the vertices of a class.
    fn place(
        &mut self,
        instances: &Instances<'_>,
        class: &mut [Member],
        reach: f64,
        found: &mut impl FnMut(Meeting),
    ) {
        class.sort_unstable_by_key(|m| (m.template, m.vertex));
        let mut starts = Vec::with_capacity(class.len());
        let mut places: Vec<(usize, u32)> = Vec::new();
        for m in &*class {
            starts.push(places.len() as u32);
            let own = &instances.of_template[m.template as usize];
            places.extend(own.iter().map(|&i| (i, m.vertex)));
        }
        let point = |&(instance, vertex): &(usize, u32)| {
            let template = instances.document.instances[instance].template as usize;
            let p = instances.document.templates[template].vertices[vertex as usize];
            instances.placed[instance].apply(p)
        };
        let points: Vec<DVec3> = places.iter().map(point).collect();
        let mut sets = joined(instances, class, &starts, &places);
        coincident(points.iter().copied(), reach, |a, b| {
            if sets.find(a) != sets.find(b) {
                let [p, q] = [a, b].map(|i| points[i as usize]);
                found(Meeting {
                    vertices: [b, a].map(|i| places[i as usize]),
                    point: p,
                    distance: p.distance(q),
                });
            }
        });
        let offset = self.ids.len() as u32;
        for (m, start) in class.iter().zip(starts) {
            self.first[m.template as usize][m.vertex as usize] = offset + start;
        }
        let base = self.points.len() as u32;
        let (numbers, count) = sets.numbered();
        self.points.resize(base as usize + count, DVec3::ZERO);
        for (number, p) in numbers.iter().zip(&points) {
            self.points[(base + number) as usize] = *p;
        }
        self.ids.extend(numbers.iter().map(|n| base + n));
    }
}

/// The placed vertices of a class, those that gluings make one in one set.
fn joined(
    instances: &Instances<'_>,
    class: &[Member],
    starts: &[u32],
    places: &[(usize, u32)],
) -> DisjointSets {
    let mut sets = DisjointSets::new(places.len());
    for (m, &start) in class.iter().zip(starts) {
        let own = &instances.of_template[m.template as usize];
        for (at, &number) in (start..).zip(own) {
            let isometry = instances.document.instances[number].isometry;
            for (t, isometry, v) in instances.links.from((m.template, isometry, m.vertex)) {
                let rank = instances.rank.get(&(t, isometry));
                let member = class.binary_search_by_key(&(t, v), |m| (m.template, m.vertex));
                if let (Some(rank), Ok(member)) = (rank, member) {
                    sets.join(at, starts[member] + rank);
                }
            }
        }
    }
    sets
}

/// The vertices of the outer faces of templates that are placed.
fn members(document: &Document, skins: &[Skin]) -> Vec<Member> {
    let mut members = Vec::new();
    for (index, skin) in skins.iter().enumerate() {
        let template = &document.templates[index];
        let mut on_skin = vec![false; template.vertices.len()];
        for &v in skin.faces.iter().flatten() {
            on_skin[v as usize] = true;
        }
        let vertices = template.vertices.iter().enumerate();
        members.extend(vertices.filter(|v| on_skin[v.0]).map(|(v, p)| Member {
            template: index as u32,
            vertex: v as u32,
            orbit: [p.truncate().length(), p.z.abs()],
        }));
    }
    members
}

/// Groups of vertices of which others are farther than `reach` in the distance from the axis, or in that from the
/// plane across it.
fn classes(members: &mut [Member], reach: f64) -> impl Iterator<Item = &mut [Member]> {
    let near = move |k: usize| move |a: &Member, b: &Member| b.orbit[k] - a.orbit[k] <= reach;
    let by = |k: usize| move |a: &Member, b: &Member| a.orbit[k].total_cmp(&b.orbit[k]);
    members.sort_unstable_by(by(0));
    members.chunk_by_mut(near(0)).flat_map(move |ring| {
        ring.sort_unstable_by(by(1));
        ring.chunk_by_mut(near(1))
    })
}
