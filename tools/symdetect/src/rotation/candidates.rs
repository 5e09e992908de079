//! Directions in which symmetry axes and normals of mirror planes can lie.

use crate::shape::Shape;
use geom::eigen;
use glam::DVec3;

/// Principal moments closer than this share of their sum may belong to one eigenspace: where the body is symmetric
/// within a thousandth only, or is drawn with facets, they are equal to within several thousandths. With more, further
/// directions are tried in vain.
const NEAR: f64 = 0.03;

/// What the second moments say about axes.
pub struct Principal {
    /// Principal directions of volume and surface, most promising first.
    pub directions: Vec<DVec3>,
    /// Whether two principal moments nearly agree, so that other directions are possible as well.
    pub degenerate: bool,
    /// Whether all three nearly agree: even axes of order three and higher may lie elsewhere.
    pub isotropic: bool,
}

impl Principal {
    /// The direction of the odd moment, where the two others nearly agree: all operations take it to itself.
    pub fn odd(&self) -> Option<DVec3> {
        let first = self.directions.first().copied();
        first.filter(|_| self.degenerate && !self.isotropic)
    }
}

/// Principal directions: if a body has an axis of order three or more and is not isotropic, that axis
/// is the eigenvector of the odd eigenvalue; half-turn axes and mirror normals are eigenvectors too.
pub fn principal(shape: &Shape, parallel: f64) -> Principal {
    let (mut directions, mut degenerate, mut isotropic) = (Vec::new(), true, true);
    for tensor in shape.moments.tensors() {
        let e = eigen::symmetric(tensor.to_cols_array_2d());
        let trace: f64 = e.values.iter().sum();
        let gaps = [e.values[1] - e.values[0], e.values[2] - e.values[1]].map(|g| g / trace);
        degenerate &= gaps.iter().any(|g| *g < NEAR);
        isotropic &= gaps.iter().sum::<f64>() < NEAR;
        let v = e.vectors.map(DVec3::from_array);
        // The odd one first.
        let order = if gaps[0] < gaps[1] {
            [2, 0, 1]
        } else {
            [0, 1, 2]
        };
        directions.extend(order.map(|i| v[i]));
    }
    Principal {
        directions: distinct(directions, parallel),
        degenerate,
        isotropic,
    }
}

/// Drops directions that are parallel to an earlier one up to the sine of an angle.
pub fn distinct(directions: Vec<DVec3>, parallel: f64) -> Vec<DVec3> {
    let mut kept: Vec<DVec3> = Vec::new();
    for d in directions {
        if kept.iter().all(|k| k.cross(d).length() > parallel) {
            kept.push(d);
        }
    }
    kept
}
