//! What the command line asks for, checked and made.

use crate::cli::{Cli, Kind};
use bodies::{
    AlternatingWheel, Antiprism, Body, Coating, Gear, HelicalGear, Impeller, PracticalTsv, Prism,
    Ratchet, SawWheel, Screw, Tessellation, Tsv, TwistedBar,
};

type Made = Result<Body, String>;

/// Outer radius of all bodies.
const RADIUS: f64 = 1.0;

/// Angle below which flat faces may be bent, degrees.
const LARGEST_BEND: f64 = 20.0;

/// The body, before it is placed.
pub fn body(cli: &Cli) -> Made {
    let order = checked_order(cli)?;
    let positive = [
        cli.height,
        cli.scale,
        cli.thickness.unwrap_or(1.0),
        cli.aspect,
    ];
    if !positive.iter().all(|x| x.is_finite() && *x > 0.0) {
        return Err("--height, --scale, --thickness and --aspect must be positive".to_owned());
    }
    if cli.layers == 0 {
        return Err("--layers must be positive".to_owned());
    }
    let tessellation = match (cli.redraw, cli.asymmetric_tessellation) {
        (Some(seed), _) => Tessellation::Redrawn(seed),
        (None, true) => Tessellation::Asymmetric,
        (None, false) => Tessellation::Symmetric,
    };
    let mut body = drawn(cli, order, tessellation)?;
    if let Some(angle) = cli.bend {
        let angle = within("--bend", angle, 0.0, LARGEST_BEND)?;
        bodies::folded::bend(&mut body, angle, cli.bend_seed);
    }
    Ok(body)
}

fn drawn(cli: &Cli, order: u32, tessellation: Tessellation) -> Made {
    match cli.kind {
        Kind::Prism => prism(cli, order, tessellation),
        Kind::Ring => ring(cli, order, tessellation),
        Kind::Tsv => tsv(cli, order, tessellation),
        Kind::PracticalTsv => practical_tsv(cli, order, tessellation),
        Kind::Gear => gear(cli, order, tessellation),
        Kind::Ratchet => ratchet(cli, order, tessellation),
        Kind::Impeller => impeller(cli, order, tessellation),
        Kind::Screw => screw(cli, order),
        Kind::Cube => Ok(bodies::cube(cli.height, tessellation)),
        Kind::TwistedBar => twisted_bar(cli),
        Kind::HelicalGear => helical_gear(cli, order),
        Kind::Antiprism | Kind::Alternating | Kind::SawWheel => turned_over(cli, order),
    }
}

fn checked_order(cli: &Cli) -> Result<u32, String> {
    let order = cli.order.unwrap_or(match cli.kind {
        Kind::PracticalTsv => 24,
        Kind::Gear | Kind::Ratchet | Kind::SawWheel => 12,
        Kind::Impeller | Kind::Antiprism => 7,
        Kind::Screw => 5,
        Kind::Alternating => 4,
        _ => 16,
    });
    let least = match cli.kind {
        Kind::Gear
        | Kind::Ratchet
        | Kind::Screw
        | Kind::HelicalGear
        | Kind::Alternating
        | Kind::SawWheel => 2,
        _ => 3,
    };
    match (least..=1000).contains(&order) {
        true => Ok(order),
        false => Err(format!("--order {order} is not between {least} and 1000")),
    }
}

fn within(name: &str, value: f64, low: f64, high: f64) -> Result<f64, String> {
    if low <= value && value < high {
        Ok(value)
    } else {
        Err(format!("{name} {value} is not in [{low}, {high})"))
    }
}

/// Distance of the sides of a regular polygon from its centre, relative to that of the corners.
fn flat(order: u32) -> f64 {
    (std::f64::consts::PI / f64::from(order)).cos()
}

fn bore(cli: &Cli, default: f64, room: f64) -> Result<f64, String> {
    within("--bore", cli.bore.unwrap_or(default), 0.0, room)
}

fn coating(cli: &Cli, bore: f64, least: f64) -> Result<f64, String> {
    match cli.coating {
        0.0 => Ok(0.0),
        t if bore > 0.0 => within("--coating", t, 0.0, least - bore),
        _ => Err("--coating needs a --bore".to_owned()),
    }
}

/// Facets of one level must not turn past their neighbours.
fn checked_twist(cli: &Cli, corners: u32) -> Result<f64, String> {
    let level = (cli.twist / f64::from(cli.layers)).abs();
    let most = 0.5 * 360.0 / f64::from(corners);
    within("the twist per level, in degrees,", level, 0.0, most)?;
    Ok(cli.twist.to_radians())
}

fn prism(cli: &Cli, order: u32, tessellation: Tessellation) -> Made {
    Ok(Prism {
        order,
        radius: RADIUS,
        height: cli.height,
        bore: bore(cli, 0.0, RADIUS)?,
        tessellation,
    }
    .build())
}

fn ring(cli: &Cli, order: u32, tessellation: Tessellation) -> Made {
    let thickness = cli.thickness.unwrap_or(5e-3);
    let bore = cli.bore.unwrap_or(0.5);
    let outside = bore + thickness / flat(order);
    within("--bore plus --thickness", outside, thickness, RADIUS)?;
    Ok(Coating {
        order,
        radius: RADIUS,
        bore,
        thickness,
        height: cli.height,
        tessellation,
    }
    .build())
}

fn tsv(cli: &Cli, order: u32, tessellation: Tessellation) -> Made {
    let thickness = cli.thickness.unwrap_or(5e-3);
    let core = cli.core.unwrap_or(0.2);
    let outside = core + thickness / flat(order);
    within("--core plus --thickness", outside, thickness, RADIUS)?;
    Ok(Tsv {
        order,
        radius: RADIUS,
        core,
        thickness,
        height: cli.height,
        tessellation,
    }
    .build())
}

fn practical_tsv(cli: &Cli, order: u32, tessellation: Tessellation) -> Made {
    let thickness = cli.thickness.unwrap_or(7e-4);
    let core = cli.core.unwrap_or((10.0 * thickness).clamp(0.05, 0.5));
    let hole = within("--core", core, 0.0, RADIUS)?;
    let films = thickness * f64::from(cli.layers);
    let room = cli.height.min(hole * flat(order));
    within("the films' thickness", films, 0.0, room)?;
    Ok(PracticalTsv {
        order,
        radius: RADIUS,
        hole,
        thickness,
        layers: cli.layers,
        height: cli.height,
        tessellation,
    }
    .build())
}

fn gear(cli: &Cli, order: u32, tessellation: Tessellation) -> Made {
    Ok(Gear {
        order,
        radius: RADIUS,
        bore: bore(cli, 0.3, Gear::ROOT)?,
        height: cli.height,
        tessellation,
    }
    .build())
}

fn ratchet(cli: &Cli, order: u32, tessellation: Tessellation) -> Made {
    let bore = bore(cli, 0.3, Ratchet::ROOT)?;
    Ok(Ratchet {
        order,
        radius: RADIUS,
        bore,
        coating: coating(cli, bore, Ratchet::ROOT)?,
        height: cli.height,
        tessellation,
    }
    .build())
}

fn impeller(cli: &Cli, order: u32, tessellation: Tessellation) -> Made {
    Ok(Impeller {
        order,
        radius: RADIUS,
        bore: bore(cli, 0.0, Impeller::HUB * Impeller::TOP)?,
        height: cli.height,
        twist: checked_twist(cli, order)?,
        layers: cli.layers,
        tessellation,
    }
    .build())
}

fn screw(cli: &Cli, order: u32) -> Made {
    let bore = bore(cli, 0.3, Screw::LEAST)?;
    // A level's facets must not be taken for those of the next thread.
    let least = f64::from(4 * order);
    let facets = within("--facets", f64::from(cli.facets), least, 1e6)?;
    Ok(Screw {
        order,
        radius: RADIUS,
        bore,
        coating: coating(cli, bore, Screw::LEAST)?,
        height: cli.height,
        twist: cli.twist.to_radians(),
        layers: cli.layers,
        facets: facets as u32,
        drawing: cli.redraw.unwrap_or(0),
    }
    .build())
}

fn twisted_bar(cli: &Cli) -> Made {
    // The sides of the section are nearer to the axis than its corners, and turn.
    let narrow = cli.aspect.min(1.0) / cli.aspect.hypot(1.0);
    Ok(TwistedBar {
        radius: RADIUS,
        aspect: cli.aspect,
        bore: bore(cli, 0.0, RADIUS * narrow)?,
        height: cli.height,
        twist: checked_twist(cli, 4)?,
        layers: cli.layers,
    }
    .build())
}

fn helical_gear(cli: &Cli, order: u32) -> Made {
    Ok(HelicalGear {
        order,
        radius: RADIUS,
        bore: bore(cli, 0.3, Gear::ROOT)?,
        height: cli.height,
        twist: checked_twist(cli, order)?,
        layers: cli.layers,
    }
    .build())
}

/// Bodies whose lower half is the image of the upper one.
fn turned_over(cli: &Cli, order: u32) -> Made {
    let (radius, height) = (RADIUS, cli.height);
    Ok(match cli.kind {
        Kind::Antiprism => Antiprism {
            order,
            radius,
            bore: bore(cli, 0.0, RADIUS)?,
            height,
        }
        .build(),
        Kind::Alternating => AlternatingWheel {
            order,
            radius,
            bore: bore(cli, 0.3, RADIUS)?,
            height,
        }
        .build(),
        _ => SawWheel {
            order,
            radius,
            bore: bore(cli, 0.3, SawWheel::ROOT)?,
            height,
        }
        .build(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[test]
    fn bends_that_no_facet_can_have_are_refused() {
        let made = |bend: &str| {
            let bend = format!("--bend={bend}");
            let words = ["body", "prism", "--order", "6", bend.as_str()];
            body(&Cli::parse_from(words)).map(|body| body.vertices.len())
        };
        assert!(made("0.01").is_ok());
        for bend in ["-1", "NaN", "inf", "20"] {
            let error = made(bend).expect_err(bend);
            assert!(error.starts_with("--bend"), "{error}");
        }
    }
}
