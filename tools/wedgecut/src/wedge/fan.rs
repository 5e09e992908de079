//! Images of a wedge side by side about the axis, and which of their vertices are the same.

use rustc_hash::FxHashMap;
use tmesh::Isometry;

/// Where a vertex of the wedge lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lies {
    /// On the axis.
    Axis,
    /// On the side at angle 0.
    Low,
    /// On the other side; in a fan of rotations given as its partner on the low side.
    High,
    /// On none of them.
    Between,
}

/// Consecutive images of a wedge of order `m` that together make a wedge of order `h`, a divisor:
/// alternately turned and reflected between mirror planes, else turned.
///
/// Line `l` is the image of the low side turned by `l` times the wedge's angle; image `j` reaches
/// from line `j` to line `j + 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fan {
    mirror: bool,
    order: u32,
    images: u32,
}

impl Fan {
    /// The fan of `order / united` images; `united` divides `order`.
    pub fn new(mirror: bool, order: u32, united: u32) -> Self {
        Self {
            mirror,
            order,
            images: order / united,
        }
    }

    /// Number of images.
    pub fn images(&self) -> u32 {
        self.images
    }

    /// Whether the images are alternately turned and reflected.
    pub fn is_mirror(&self) -> bool {
        self.mirror
    }

    /// Whether the last image meets the first: a full turn.
    pub fn is_closed(&self) -> bool {
        !self.mirror && self.images == self.order
    }

    /// Where image `j` is.
    pub fn image(&self, j: u32) -> Isometry {
        let (j, n) = (i64::from(j), self.order);
        match (self.mirror, j % 2) {
            (false, _) => Isometry::rotation(j, n),
            (true, 0) => Isometry::rotation(j / 2, n),
            (true, _) => Isometry::reflection(j / 2 + 1, n),
        }
    }

    /// Line of a side of image `j`.
    pub fn line_of(&self, lies: Lies, j: u32) -> u32 {
        let far = (lies == Lies::High) != (self.mirror && j % 2 == 1);
        let line = j + u32::from(far);
        if self.is_closed() {
            line % self.images
        } else {
            line
        }
    }
}

/// Numbers of the vertices of a fan.
#[derive(Clone, Debug, Default)]
pub struct Joint {
    ids: FxHashMap<(u32, u32), u32>,
}

impl Joint {
    /// Names the vertex `v` of image `j` as `id` if it has no name yet; gives its name, and whether
    /// it is the new one.
    pub fn name(&mut self, fan: &Fan, lies: Lies, [v, j]: [u32; 2], id: u32) -> (u32, bool) {
        let slot = match lies {
            Lies::Axis => 0,
            Lies::Between => j,
            side => fan.line_of(side, j),
        };
        let known = *self.ids.entry((v, slot)).or_insert(id);
        (known, known == id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn neighbouring_images_share_a_line() {
        for (mirror, order, united) in [
            (true, 12, 4),
            (true, 7, 1),
            (true, 6, 6),
            (false, 12, 3),
            (false, 5, 1),
            (false, 4, 4),
        ] {
            let fan = Fan::new(mirror, order, united);
            let angle = std::f64::consts::TAU / f64::from(order * if mirror { 2 } else { 1 });
            let (low, high) = (DVec3::X, DVec3::new(angle.cos(), angle.sin(), 0.0));
            let mut joint = Joint::default();
            let mut at: Vec<DVec3> = Vec::new();
            for j in 0..fan.images() {
                // In a mirror fan the two sides have vertices of their own.
                let high_name = u32::from(mirror);
                for (lies, v, p) in [(Lies::Low, 0, low), (Lies::High, high_name, high)] {
                    let image = fan.image(j).apply(p);
                    let (id, new) = joint.name(&fan, lies, [v, j], at.len() as u32);
                    if new {
                        at.push(image);
                    }
                    assert!((at[id as usize] - image).length() < 1e-14, "{fan:?} {j}");
                }
            }
            let lines = fan.images() + u32::from(!fan.is_closed());
            assert_eq!(at.len() as u32, lines, "{fan:?}");
        }
    }
}
