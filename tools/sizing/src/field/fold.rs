//! The elements of a size field at their images in one template.

use super::Limited;
use glam::{DVec2, DVec3, Vec3};
use std::f64::consts::{PI, TAU};
use tmesh::{Document, Placed};

/// A tetrahedron, in units of the cube about the template.
#[derive(Clone, Copy, Debug)]
pub struct Tet {
    /// By which of the instances it is here.
    pub image: u32,
    /// The first corner.
    pub corner: Vec3,
    /// Gradients of the barycentric coordinates of the other corners.
    pub gradients: [Vec3; 3],
    /// Lengths wanted at all corners.
    pub sizes: [f32; 4],
}

/// A triangle of the border, in the same units.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// By which of the instances it is here.
    pub image: u32,
    /// Corners.
    pub corners: [Vec3; 3],
    /// Lengths wanted there.
    pub sizes: [f32; 3],
}

/// A size field as one template sees it: elements of the field where they are after the inverse of each instance of the template, as far as
/// they may matter in it. Of border triangles those that are as near as the next copies: what is on the other side of the
/// axis has an image that is nearer.
#[derive(Clone, Debug, Default)]
pub struct Folded {
    /// Instances of the template.
    pub images: usize,
    /// Least and largest coordinates of the template.
    ends: [DVec3; 2],
    /// Planes through the axis on both sides of the template, by a normal that points to it and the distance of the origin.
    planes: Vec<(DVec2, f64)>,
    /// Tetrahedra that meet the cube.
    pub tets: Vec<Tet>,
    /// The box about each of them.
    pub boxes: Vec<[Vec3; 2]>,
    /// Triangles of the border.
    pub faces: Vec<Face>,
}

/// Images of elements, at most. A choice: they take a gigabyte. An isotropic field of a million points folded eight hundred times has a
/// tenth of that; many more come of elements that are wide beside the copies, which have few points.
const MOST: usize = 1 << 24;

/// Sizes in the tree over lengths wanted. Where the mesher is given a size for each place, edges come out 1.05 to 1.06 times as long as
/// where it is given one for all (1.13 and 1.07 of a length of 0.05 on prisms, gears and ratchets of `body`); so that both mean the same.
pub const SHARE: f64 = 0.95;

/// Flat tetrahedra: least volume over that of the cube of the longest edge. What computing leaves of nothing is smaller.
const FLAT: f64 = 1e-12;

/// The template is larger than it is by this part of the cube on all sides: its surface may be moved while it is remeshed, and nothing
/// beyond is asked for.
const AROUND: f64 = 0.02;

/// Elements are taken that are beside the template by this part of half of its angle, so that what rounding puts there is in some.
const BESIDE: f64 = 0.01;

/// By how much angles are wider than computed, radians: far more than rounding, far less than a copy.
const MARGIN: f64 = 1e-9;

impl Folded {
    /// Folds a field onto a template of a document, into units of the cube of this origin and width; `None` where there would be too many
    /// images. Linear in the field and in its images that are here, but for a factor of the logarithm of the number of instances.
    pub fn new(
        limited: &Limited,
        (document, index): (&Document, usize),
        (origin, width): (DVec3, f64),
    ) -> Option<Self> {
        let sectors = Sectors::new(document, index);
        let unit = |p: DVec3| (p - origin) / width;
        let vertices = document.templates[index].vertices.iter();
        let vertices = vertices.map(|&p| unit(p));
        let from_axis = origin.truncate() / width;
        let mut folded = Self {
            images: sectors.places.len(),
            ends: [
                vertices.clone().fold(DVec3::INFINITY, DVec3::min) - AROUND,
                vertices.fold(DVec3::NEG_INFINITY, DVec3::max) + AROUND,
            ],
            planes: sectors
                .sides()
                .into_iter()
                .map(|normal| (normal, normal.dot(from_axis)))
                .collect(),
            ..Self::default()
        };
        let at = |v: u32| limited.points[v as usize];
        let size = |v: u32| (SHARE * limited.sizes[v as usize] / width) as f32;
        let mut images = Vec::new();
        for tet in &limited.tets {
            let corners = tet.map(at);
            if is_flat(corners) {
                continue;
            }
            sectors.meeting(&corners, BESIDE * sectors.half, &mut images);
            for &image in &images {
                let here = corners.map(|p| unit(sectors.places[image as usize].apply(p)));
                if let Some(ends) = folded.meeting(&here) {
                    folded.boxes.push(ends);
                    folded.tets.push(Tet::new(image, here, tet.map(size)));
                }
            }
            if folded.tets.len() > MOST {
                return None;
            }
        }
        for face in &limited.border {
            let corners = face.map(at);
            sectors.meeting(&corners, 2.0 * sectors.half, &mut images);
            let here = |&image: &u32| Face {
                image,
                corners: corners.map(|p| unit(sectors.places[image as usize].apply(p)).as_vec3()),
                sizes: face.map(size),
            };
            folded.faces.extend(images.iter().map(here));
            if folded.faces.len() > MOST {
                return None;
            }
        }
        Some(folded)
    }

    /// Whether a cube may have something in common with the template, in units of the whole one.
    pub fn meets(&self, corner: DVec3, width: f64) -> bool {
        let [low, high] = self.ends;
        if (low - corner - width).max(corner - high).max_element() > 0.0 {
            return false;
        }
        self.planes.iter().all(|&(normal, off)| {
            // The corner that is farthest in the direction of the normal.
            let far = corner.truncate()
                + width * DVec2::select(normal.cmpgt(DVec2::ZERO), DVec2::ONE, DVec2::ZERO);
            normal.dot(far) + off >= -AROUND
        })
    }

    /// The box of points, if it meets that of the template.
    fn meeting(&self, points: &[DVec3]) -> Option<[Vec3; 2]> {
        let all = points.iter().copied();
        let low = all.clone().reduce(DVec3::min)?;
        let high = all.reduce(DVec3::max)?;
        let meets = (low - self.ends[1]).max(self.ends[0] - high).max_element() <= 0.0;
        meets.then(|| [low.as_vec3(), high.as_vec3()])
    }
}

impl Tet {
    fn new(image: u32, [a, b, c, d]: [DVec3; 4], sizes: [f32; 4]) -> Self {
        let [u, v, w] = [b - a, c - a, d - a];
        let determinant = u.dot(v.cross(w));
        let gradients = [v.cross(w), w.cross(u), u.cross(v)];
        Self {
            image,
            corner: a.as_vec3(),
            gradients: gradients.map(|g| (g / determinant).as_vec3()),
            sizes,
        }
    }
}

impl Face {
    /// The least length at a corner.
    pub fn least(&self) -> f32 {
        let [a, b, c] = self.sizes;
        a.min(b).min(c)
    }

    /// The largest length at a corner.
    pub fn most(&self) -> f32 {
        let [a, b, c] = self.sizes;
        a.max(b).max(c)
    }
}

fn is_flat([a, b, c, d]: [DVec3; 4]) -> bool {
    let edges = [b - a, c - a, d - a, c - b, d - b, d - c];
    let longest = edges.iter().map(|e| e.length()).fold(0.0, f64::max);
    let volume = edges[0].dot(edges[1].cross(edges[2])).abs();
    let least = FLAT * longest * longest * longest;
    // Also where the product is no number.
    volume.is_nan() || volume <= least
}

/// The copies of a template around the axis.
pub struct Sectors {
    /// For each instance, the isometry that takes what is there to the template.
    pub places: Vec<Placed>,
    /// Angle of the middle of each copy, radians, increasing, with the number of its instance.
    middles: Vec<(f64, u32)>,
    /// Direction of the middle of the template.
    middle: DVec2,
    /// Half of the angle that the template takes, radians.
    half: f64,
}

impl Sectors {
    /// Of a template of a document. n log n with the vertices and instances.
    pub fn new(document: &Document, index: usize) -> Self {
        let (middle, half) = sector(&document.templates[index].vertices);
        let instances = document.instances.iter();
        let instances: Vec<_> = instances
            .filter(|instance| instance.template as usize == index)
            .map(|instance| instance.isometry)
            .collect();
        let angle = |(i, isometry): (u32, &tmesh::Isometry)| {
            let there = isometry.apply(DVec3::new(middle.x, middle.y, 0.0));
            (libm::atan2(there.y, there.x), i)
        };
        let mut middles: Vec<(f64, u32)> = (0..).zip(&instances).map(angle).collect();
        middles.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Self {
            places: instances.iter().map(|i| i.inverse().placed()).collect(),
            middles,
            middle,
            half,
        }
    }

    /// Normals, towards the template, of the planes through the axis beside it; none where it takes half of a turn or more.
    fn sides(&self) -> Vec<DVec2> {
        if self.half >= 0.5 * PI {
            return Vec::new();
        }
        let along = |angle: f64| turned(self.middle, angle);
        vec![along(-self.half).perp(), -along(self.half).perp()]
    }

    /// The instances whose copies may meet points within an angle, radians.
    pub fn meeting(&self, points: &[DVec3], margin: f64, images: &mut Vec<u32>) {
        images.clear();
        let centre = points.iter().map(|p| p.truncate()).sum::<DVec2>() / points.len() as f64;
        let reach = points.iter().map(|p| p.truncate().distance(centre));
        let reach = reach.fold(0.0, f64::max) * (1.0 + MARGIN);
        let distance = centre.length();
        let half = self.half
            + margin
            + match reach < distance {
                true => libm::asin(reach / distance),
                false => PI,
            };
        // Also where it is no number.
        if half.is_nan() || half >= PI {
            images.extend(0..self.places.len() as u32);
            return;
        }
        let angle = libm::atan2(centre.y, centre.x);
        for turn in [-TAU, 0.0, TAU] {
            let [low, high] = [angle - half, angle + half].map(|a| a + turn);
            let first = self.middles.partition_point(|m| m.0 < low);
            let there = self.middles[first..].iter().take_while(|m| m.0 <= high);
            images.extend(there.map(|m| m.1));
        }
    }
}

/// A direction turned by an angle, radians.
fn turned(direction: DVec2, angle: f64) -> DVec2 {
    direction.rotate(DVec2::new(libm::cos(angle), libm::sin(angle)))
}

/// The direction of the middle of the angle about the axis that points take, and half of that angle, radians.
fn sector(points: &[DVec3]) -> (DVec2, f64) {
    let reach = points.iter().map(|p| p.truncate().length());
    let least = reach.fold(0.0, f64::max) * MARGIN;
    let far = points.iter().filter(|p| p.truncate().length() > least);
    let mut angles: Vec<f64> = far.map(|p| libm::atan2(p.y, p.x)).collect();
    angles.sort_by(f64::total_cmp);
    let (Some(&first), Some(&last)) = (angles.first(), angles.last()) else {
        return (DVec2::X, PI);
    };
    // The widest gap is beside the template.
    let mut gap = (first + TAU - last, first);
    for pair in angles.windows(2) {
        if pair[1] - pair[0] > gap.0 {
            gap = (pair[1] - pair[0], pair[1]);
        }
    }
    let half = 0.5 * (TAU - gap.0);
    let middle = gap.1 + half;
    (DVec2::new(libm::cos(middle), libm::sin(middle)), half)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{Instance, Isometry, Template};

    /// A wedge of a cylinder of 840 copies, 420 of them turned over.
    fn document() -> Document {
        let angle = TAU / 420.0;
        let at = |a: f64, z: f64| DVec3::new(a.cos(), a.sin(), z);
        let mut document = Document::single(Template {
            vertices: vec![
                DVec3::ZERO,
                DVec3::Z,
                at(0.0, 0.0),
                at(0.0, 1.0),
                at(angle, 0.0),
                at(angle, 1.0),
            ],
            ..Template::default()
        });
        document.instances = (0..420)
            .flat_map(|k| [false, true].map(|flipped| Isometry::new(k, 420, false, flipped)))
            .map(|isometry| Instance {
                template: 0,
                isometry,
                region_map: 0,
            })
            .collect();
        document
    }

    #[test]
    fn elements_are_brought_by_the_instances_that_they_meet() {
        let document = document();
        let sectors = Sectors::new(&document, 0);
        assert!((sectors.half - PI / 420.0).abs() < 1e-12);
        let mut images = Vec::new();
        for angle in [0.1, 2.0, 3.13, -3.13, -0.7] {
            let at = |r: f64, a: f64, z: f64| DVec3::new(r * f64::cos(a), r * f64::sin(a), z);
            let tet = [
                at(0.9, angle, 0.2),
                at(0.91, angle, 0.2),
                at(0.9, angle + 0.01, 0.2),
                at(0.9, angle, 0.21),
            ];
            sectors.meeting(&tet, MARGIN, &mut images);
            assert!(images.len() >= 4 && images.len() <= 10, "{}", images.len());
            // A point of it has an image in the wedge by one of them.
            let inside = |i: &u32| {
                let p = sectors.places[*i as usize].apply(tet[0]);
                let angle = p.y.atan2(p.x);
                angle > -1e-9 && angle < TAU / 420.0 + 1e-9
            };
            assert_eq!(images.iter().filter(|i| inside(i)).count(), 2);
        }
        // At the axis all of them.
        let tet = [DVec3::X, -DVec3::X, DVec3::Y, DVec3::Z].map(|p| 0.01 * p);
        sectors.meeting(&tet, MARGIN, &mut images);
        assert_eq!(images.len(), 840);
    }

    #[test]
    fn the_middle_of_a_template_is_in_it_wherever_that_is() {
        for turn in [0.0, 1.0, 3.0, PI, -2.0] {
            let at = |a: f64| DVec3::new((a + turn).cos(), (a + turn).sin(), 0.0);
            let (middle, half) = sector(&[DVec3::ZERO, at(-0.3), at(0.5)]);
            assert!((half - 0.4).abs() < 1e-12, "{turn}: {half}");
            let expected = at(0.1).truncate();
            assert!(middle.distance(expected) < 1e-12);
        }
        let round = [DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y];
        assert!(sector(&round).1 > 0.7 * PI);
        assert_eq!(sector(&[DVec3::Z]).1, PI);
    }
}
