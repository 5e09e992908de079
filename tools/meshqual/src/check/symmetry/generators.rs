//! What a promise of symmetry asks to be checked.

use geom::tolerance::PROMISE;
use glam::{DMat3, DVec3};
use kit::number;
use tmesh::{Frame, Group, Isometry, Promise};

/// The frame of a promise; `None` for promises that make no sense.
pub fn frame(promise: &Promise) -> Option<Frame> {
    let [a, b, c] = promise.rotation.map(DVec3::from_array);
    let rotation = DMat3::from_cols(a, b, c).transpose();
    let origin = DVec3::from_array(promise.origin);
    let off = rotation.transpose() * rotation - DMat3::IDENTITY;
    let off = off
        .to_cols_array()
        .iter()
        .fold(0.0_f64, |m, x| m.max(x.abs()));
    let proper = off <= PROMISE && rotation.determinant() > 0.0 && origin.is_finite();
    let turns = |group: Group| (1..=group.kind.max_order()).contains(&group.order);
    let fits = turns(promise.group)
        && promise.outside.is_none_or(|o| {
            turns(o.group)
                && o.group.order.is_multiple_of(promise.group.order)
                && (0.0..f64::INFINITY).contains(&o.radius)
        });
    (proper && fits).then_some(Frame { rotation, origin })
}

/// An operation that has to map the mesh, or a part of it, onto itself.
pub struct Generator {
    /// What messages call it.
    pub name: String,
    /// The operation.
    pub isometry: Isometry,
    /// Holds only for what reaches farther from the axis than this.
    pub beyond: Option<f64>,
}

/// The generators of what is promised: a mesh that each maps onto itself is mapped onto itself by
/// their products, so no other element has to be looked at.
pub fn generators(promise: &Promise) -> Vec<Generator> {
    let of = |group: Group| {
        group
            .generators()
            .into_iter()
            .map(move |g| (named(group, g), g))
    };
    let whole = of(promise.group).map(|(name, isometry)| Generator {
        name,
        isometry,
        beyond: None,
    });
    let outside = promise.outside.iter().flat_map(|outside| {
        let new = of(outside.group).filter(|(_, g)| !promise.group.contains(*g));
        new.map(|(name, isometry)| Generator {
            name: format!("{name} outside of the radius {}", number(outside.radius)),
            isometry,
            beyond: Some(outside.radius),
        })
    });
    whole.chain(outside).collect()
}

fn named(group: Group, generator: Isometry) -> String {
    match (generator.mirrored(), generator.flipped()) {
        (false, false) => format!("the rotation of order {}", group.order),
        (true, false) => "the mirror".to_owned(),
        (true, true) => "the half turn across the axis".to_owned(),
        (false, true) if generator == Isometry::FLIP => "the horizontal mirror".to_owned(),
        (false, true) => format!("the rotary reflection of order {}", 2 * group.order),
    }
}
