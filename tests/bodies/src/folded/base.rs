//! The bodies that are bent.

use crate::random_solid::drawn;
use crate::{
    AlternatingWheel, Antiprism, Body, Coating, Dice, Gear, HelicalGear, Prism, Ratchet, SawWheel,
    Tessellation, Tsv,
};

/// A body about the z axis, drawn as symmetric as it is, in how many sectors, and its name. Layers are not as thin as elsewhere:
/// they take elements, and bends are the same.
pub fn base(dice: &mut Dice) -> (Body, u32, String) {
    if dice.chance(0.5) {
        let (body, sectors, kind) = drawn(dice);
        return (body, sectors, format!("solid, {kind}"));
    }
    let tessellation = Tessellation::Symmetric;
    let radius = 1.0;
    let order = dice.integer(3, 24) as u32;
    let height = dice.log_between(0.2, 3.0);
    let thickness = dice.log_between(0.02, 0.2);
    let bore = dice.between(0.1, 0.35);
    let maybe_bore = if dice.chance(0.5) { bore } else { 0.0 };
    let (body, name) = match dice.below(9) {
        0 => {
            let prism = Prism {
                order,
                radius,
                height,
                bore: maybe_bore,
                tessellation,
            };
            (prism.build(), "prism")
        }
        1 => {
            let ring = Coating {
                order,
                radius,
                bore,
                thickness,
                height,
                tessellation,
            };
            (ring.build(), "ring")
        }
        2 => {
            let via = Tsv {
                order,
                radius,
                core: bore,
                thickness: 0.5 * thickness,
                height,
                tessellation,
            };
            (via.build(), "via")
        }
        3 => {
            let gear = Gear {
                order,
                radius,
                bore,
                height,
                tessellation,
            };
            (gear.build(), "gear")
        }
        4 => {
            let ratchet = Ratchet {
                order,
                radius,
                bore,
                coating: 0.0,
                height,
                tessellation,
            };
            (ratchet.build(), "ratchet")
        }
        5 => {
            let gear = HelicalGear {
                order,
                radius,
                bore,
                height,
                twist: 0.2 / f64::from(order),
                layers: 2,
            };
            (gear.build(), "helical gear")
        }
        6 => {
            let antiprism = Antiprism {
                order,
                radius,
                bore: maybe_bore,
                height,
            };
            (antiprism.build(), "antiprism")
        }
        7 => {
            let wheel = AlternatingWheel {
                order: order.min(12),
                radius,
                bore,
                height,
            };
            (wheel.build(), "alternating wheel")
        }
        _ => {
            let wheel = SawWheel {
                order,
                radius,
                bore,
                height,
            };
            (wheel.build(), "saw wheel")
        }
    };
    let sectors = body.order;
    (body, sectors, format!("{name} of order {sectors}"))
}
