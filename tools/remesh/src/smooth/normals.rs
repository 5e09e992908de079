//! Normals of the shape at the corners of facets.

use super::bent::Bent;
use super::curves::Tangents;
use super::sheets::Reading;
use geom::measure::double_area_vector;
use glam::{DMat2, DVec2, DVec3};

/// Weight of the mean of a fan that ends, against what each of its surroundings tells, of the weight one. A choice: of both the
/// squared error counts, and the mean, which leans by half an angle between facets, is some ten times as wrong as what differs between
/// an angle and its like beyond one more facet. With much less, surroundings in one direction decide about the other one.
const WEAK: f64 = 1e-2;

/// Of each corner of each triangle the unit normal of the shape, on the side of the triangle's; none on flat faces, and where
/// the shape has none.
pub type Normals = Vec<[Option<DVec3>; 3]>;

/// All fans of a surface.
struct Fans {
    all: Vec<Fan>,
    /// Of each corner of each triangle, the fan that it is in, and whether it is wound as the first triangle of that.
    of: Vec<[Option<(u32, bool)>; 3]>,
}

/// The triangles around a vertex that go on smoothly beside each other.
struct Fan {
    /// Triangle, its corner at the vertex, and whether it is wound as the first one.
    members: Vec<(u32, usize, bool)>,
    /// Whether it ends.
    is_open: bool,
    /// The normal, on the side of that of the first one.
    normal: Option<DVec3>,
}

impl Bent<'_> {
    /// The normals. Where a fan has all its triangles around it, they are the means of theirs; where it ends, such means lean to
    /// one side, and what is right are the normals nearby: a surface of constant curvature leaves from both ends of a chord at the
    /// same angle. Linear.
    pub fn normals(&self, reading: Reading, tangents: &Tangents) -> Normals {
        let mut fans = self.fans();
        for fan in &mut fans.all {
            fan.normal = self.mean(fan, reading);
        }
        let settled: Vec<Option<DVec3>> = (fans.all.iter())
            .map(|fan| match fan.is_open {
                true => (self.settled(fan, &fans, tangents))
                    .filter(|n| self.is_near(fan, *n, reading))
                    .or(fan.normal),
                false => fan.normal,
            })
            .collect();
        let mut normals = vec![[None; 3]; self.sheets.triangles.len()];
        for (fan, normal) in fans.all.iter().zip(settled) {
            for &(t, c, alike) in &fan.members {
                normals[t as usize][c] = normal.map(|n| if alike { n } else { -n });
            }
        }
        normals
    }

    /// The fans of curved triangles.
    fn fans(&self) -> Fans {
        let count = self.sheets.triangles.len();
        let mut fan_of = vec![[None; 3]; count];
        let mut fans: Vec<Fan> = Vec::new();
        for t in (0..count as u32).filter(|t| !self.is_flat[*t as usize]) {
            for c in 0..3 {
                if fan_of[t as usize][c].is_some() {
                    continue;
                }
                let number = fans.len() as u32;
                let mut fan = Fan {
                    members: vec![(t, c, true)],
                    is_open: false,
                    normal: None,
                };
                fan_of[t as usize][c] = Some((number, true));
                let mut next = 0;
                while let Some(&(t, c, alike)) = fan.members.get(next) {
                    next += 1;
                    for edge in [c, (c + 2) % 3] {
                        let Some(mate) = self.beyond(t, edge) else {
                            fan.is_open = true;
                            continue;
                        };
                        // The edge begins here or ends here, and there the other way round if wound alike.
                        let starts = (edge == c) != mate.alike;
                        let there = (mate.corner + usize::from(!starts)) % 3;
                        let slot = &mut fan_of[mate.triangle as usize][there];
                        if slot.is_none() {
                            let alike = alike == mate.alike;
                            *slot = Some((number, alike));
                            fan.members.push((mate.triangle, there, alike));
                        }
                    }
                }
                fans.push(fan);
            }
        }
        Fans {
            all: fans,
            of: fan_of,
        }
    }

    /// The mean of the normals of a fan; `None` where one of its triangles has another direction by the feature angle, as at the
    /// tip of a cone.
    fn mean(&self, fan: &Fan, reading: Reading) -> Option<DVec3> {
        let part = |&(t, c, alike): &(u32, usize, bool)| {
            let corners = self.sheets.corners(t);
            let [a, b, c] = [0, 1, 2].map(|i| corners[(c + i) % 3]);
            let weight = a.distance_squared(b) * a.distance_squared(c);
            let vector = double_area_vector(a, b, c) / weight;
            if alike { vector } else { -vector }
        };
        let mean: DVec3 = fan.members.iter().map(part).sum();
        let mean = mean.normalize_or_zero();
        self.is_near(fan, mean, reading).then_some(mean)
    }

    /// Whether a direction is within the feature angle of all triangles of a fan.
    fn is_near(&self, fan: &Fan, direction: DVec3, reading: Reading) -> bool {
        fan.members.iter().all(|&(t, _, alike)| {
            let cosine = self.sheets.normals[t as usize].dot(direction);
            (if alike { cosine } else { -cosine }) > reading.feature
        })
    }

    /// The normal, on the side of that of a fan, of what goes on smoothly beside one of its triangles and is straight there: a flat
    /// face, or the wider facet at a step.
    fn beside(&self, (t, c, alike): (u32, usize, bool), fans: &Fans) -> Option<DVec3> {
        let sheets = self.sheets;
        [c, (c + 2) % 3].into_iter().find_map(|edge| {
            let mate = sheets.mate(t, edge)?;
            let same = mate.alike == alike;
            let there = mate.triangle as usize;
            let on_side = |n: DVec3, same: bool| if same { n } else { -n };
            if self.is_flat[there] {
                return Some(on_side(sheets.normals[there], same));
            }
            let vertex = sheets.triangles[t as usize][c];
            let at = sheets.triangles[there].iter().position(|v| *v == vertex)?;
            let wider = sheets.height(there as u32, mate.corner) > sheets.height(t, edge);
            let (fan, other) =
                fans.of[there][at].filter(|_| self.is_step[t as usize][edge] && wider)?;
            let normal = fans.all[fan as usize].normal?;
            Some(on_side(normal, same == other))
        })
    }

    /// The normal where a fan ends, by least squares.
    fn settled(&self, fan: &Fan, fans: &Fans, tangents: &Tangents) -> Option<DVec3> {
        let beside = (fan.members.iter()).find_map(|m| self.beside(*m, fans));
        let mean = beside.or(fan.normal)?;
        let (u, w) = mean.any_orthonormal_pair();
        let (mut matrix, mut right) = (DMat2::from_diagonal(DVec2::splat(WEAK)), DVec2::ZERO);
        let mut ask = |direction: DVec3, product: f64| {
            let row = DVec2::new(direction.dot(u), direction.dot(w));
            matrix += DMat2::from_cols(row * row.x, row * row.y);
            right += row * (product - direction.dot(mean));
        };
        for &(t, c, alike) in &fan.members {
            let corners = self.sheets.corners(t);
            for far in [(c + 1) % 3, (c + 2) % 3] {
                let direction = (corners[far] - corners[c]).normalize_or_zero();
                let there = fans.of[t as usize][far].map(|(f, far)| (&fans.all[f as usize], far));
                if let Some((other, far)) = there
                    && let (Some(normal), false) = (other.normal, other.is_open)
                {
                    let same = far == alike;
                    let normal = if same { normal } else { -normal };
                    ask(direction, -direction.dot(normal));
                }
            }
            let vertices = self.sheets.triangles[t as usize];
            for far in [(c + 1) % 3, (c + 2) % 3] {
                if let Some(tangent) = tangents.at(vertices[c], vertices[far]) {
                    ask(tangent, 0.0);
                }
            }
        }
        let off = matrix.inverse() * right;
        Some((mean + u * off.x + w * off.y).normalize_or_zero())
    }
}
