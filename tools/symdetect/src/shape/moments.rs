//! Moments of a body and of its surface, as exact integrals of polynomials over triangles, so that
//! they depend on the shape and not on its tessellation.

use crate::tolerance::VANISHING;
use geom::measure::triangle_area;
use glam::{DMat3, DVec3};

/// Volume moments of the material and area moments of all triangles (boundary and interfaces).
pub struct Moments {
    /// Volume of the material, units cubed.
    pub volume: f64,
    /// Centre of the volume.
    pub volume_centre: DVec3,
    /// Second moments of the volume about its centre, divided by the volume.
    pub volume_tensor: DMat3,
    /// Area of all triangles, units squared.
    pub area: f64,
    /// Centre of the area.
    pub area_centre: DVec3,
    /// Second moments of the area about its centre, divided by the area.
    pub area_tensor: DMat3,
}

impl Moments {
    /// Integrates over triangles given by their corners and the sign with which each bounds material:
    /// 1 with material behind it, -1 with material in front, 0 between two materials.
    pub fn new(triangles: impl Iterator<Item = ([DVec3; 3], f64)>) -> Self {
        let (mut solid, mut surface) = (Sums::ZERO, Sums::ZERO);
        for ([a, b, c], sign) in triangles {
            let volume = sign * a.dot(b.cross(c)) / 6.0;
            solid.add([DVec3::ZERO, a, b, c], volume);
            surface.add([a, b, c], triangle_area(a, b, c));
        }
        let (volume_centre, volume_tensor) = solid.about_centre();
        let (area_centre, area_tensor) = surface.about_centre();
        Self {
            volume: solid.mass,
            volume_centre,
            volume_tensor,
            area: surface.mass,
            area_centre,
            area_tensor,
        }
    }
}

impl Moments {
    /// Whether second moments allow for a rotation of an order above two about an axis, up to a share of their trace: it
    /// leaves those across the axis equal, and those with the axis zero.
    pub fn allow_high_order(&self, axis: DVec3, share: f64) -> bool {
        let (x, y) = axis.any_orthonormal_pair();
        let allows = |tensor: DMat3| {
            let (u, v) = (tensor * x, tensor * y);
            let across = 2.0 * DVec3::new(0.5 * (u.dot(x) - v.dot(y)), u.dot(y), 0.0).length();
            let with_axis = DVec3::new(u.dot(axis), v.dot(axis), 0.0).length();
            let trace = tensor.x_axis.x + tensor.y_axis.y + tensor.z_axis.z;
            across.max(with_axis) <= share * trace
        };
        self.tensors().into_iter().all(allows)
    }

    /// The second moments: of the volume, if there is any, and of the surface.
    pub fn tensors(&self) -> impl IntoIterator<Item = DMat3> {
        let volume = self.has_volume().then_some(self.volume_tensor);
        volume.into_iter().chain([self.area_tensor])
    }
}

/// Sums over simplices of their measure (area or volume) and its first and second moments.
struct Sums {
    mass: f64,
    first: DVec3,
    second: DMat3,
}

impl Sums {
    /// Of no simplex.
    const ZERO: Self = Self {
        mass: 0.0,
        first: DVec3::ZERO,
        second: DMat3::ZERO,
    };

    /// Adds a simplex of `N` corners. Barycentric coordinates have the mean `1 / N`; the mean of the product of two
    /// different ones is `1 / (N (N + 1))`, that of a square is twice that.
    fn add<const N: usize>(&mut self, corners: [DVec3; N], mass: f64) {
        let count = N as f64;
        let sum: DVec3 = corners.iter().sum();
        let squares = corners.iter().fold(outer(sum), |all, p| all + outer(*p));
        self.mass += mass;
        self.first += sum * (mass / count);
        self.second += squares * (mass / (count * (count + 1.0)));
    }

    /// The centre, and the second moments about it divided by the measure.
    fn about_centre(&self) -> (DVec3, DMat3) {
        if self.mass > 0.0 {
            let centre = self.first / self.mass;
            (centre, self.second * (1.0 / self.mass) - outer(centre))
        } else {
            (DVec3::ZERO, DMat3::ZERO)
        }
    }
}

impl Moments {
    /// Whether the surface encloses more than rounding.
    pub fn has_volume(&self) -> bool {
        self.volume > VANISHING * self.area
    }

    /// Centre of the volume, or of the surface when it encloses hardly any.
    pub fn centre(&self) -> DVec3 {
        if self.has_volume() {
            self.volume_centre
        } else {
            self.area_centre
        }
    }
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies;

    fn cube() -> Vec<([DVec3; 3], f64)> {
        let body = bodies::prism(4, 1.0, std::f64::consts::SQRT_2);
        let t = &body.templates[0];
        t.triangles
            .iter()
            .map(|x| (x.vertices.map(|v| t.vertices[v as usize]), 1.0))
            .collect()
    }

    #[test]
    fn moments_of_a_cube() {
        let m = Moments::new(cube().into_iter());
        let side = std::f64::consts::SQRT_2;
        assert!((m.volume - side.powi(3)).abs() < 1e-12);
        assert!((m.area - 6.0 * side * side).abs() < 1e-12);
        let expected = DMat3::from_diagonal(DVec3::splat(side * side / 12.0));
        assert!(m.volume_tensor.abs_diff_eq(expected, 1e-12));
    }
}
