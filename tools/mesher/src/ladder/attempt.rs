//! One attempt: how the surface is described, what is asked for, and what came of it.

use super::layers::Layers;
use super::room::Room;
use super::rungs::Change;
use crate::complex::Description;
use crate::{Mesh, Params, Plc, Task};
use std::time::Instant;

/// What the bounds are multiplied by where elements are improved afterwards, which brings back what the mesher left past
/// them: the radius-edge ratio, and the smallest dihedral angle. Measured with `tetwedge` on the prisms, coated rings and vias
/// of `body`, orders 4 to 128: next to 1, a ratio of 1.05 saves 2 to 15 % of the elements; 1.12 saves 5 % more, for a first
/// percentile of the angles that is up to 0.6 degrees lower. Of the angle, two thirds save a quarter of the elements where
/// 15 degrees are asked for, a tenth with 10 and next to nothing with 5. A second mesh without easing is of no use: on wedges with and
/// without sharp edges, with ratios from 1.1 to 1.4 and angles from 10 to 25 degrees asked for, improvement left about as many of its
/// elements past the bounds.
pub const EASING: [f64; 2] = [1.05, 2.0 / 3.0];

/// The bounds that the mesher is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asks {
    /// Those of the user, times these: the radius-edge ratio, and the smallest dihedral angle. Improvement makes up
    /// for them.
    Eased([f64; 2]),
    /// Those of the user.
    AsWished,
    /// For which refinement ends: a radius-edge ratio of two; see [`super::LADDER`].
    Loosened,
}

/// Why the mesher may add no points to the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// It has the edges that are asked for.
    Enough,
    /// The mesher fails where it adds some.
    Last,
}

/// What is done in an attempt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attempt {
    /// How the surface is described.
    pub description: Description,
    /// The bounds that are asked for.
    pub asks: Asks,
    /// Points that may be added, once the surface is known and if there is a limit.
    pub room: Option<Room>,
    /// Whether the limit is the last one, after which the mesh is taken as it is.
    pub stop: bool,
    /// Layers too thin for the bounds.
    pub layers: Option<Layers>,
    /// Whether the mesher may add no points to the surface, and why.
    pub keeps_surface: Option<Kept>,
}

impl Attempt {
    /// The plain surface.
    pub fn new(asks: Asks) -> Self {
        Self {
            description: Description::PLAIN,
            asks,
            room: None,
            stop: false,
            layers: None,
            keeps_surface: None,
        }
    }

    /// The next attempt.
    pub fn changed(self, change: Change) -> Self {
        match change {
            Change::AllowMore => Self {
                room: self.room.map(Room::more),
                ..self
            },
            Change::Loosen => Self {
                asks: Asks::Loosened,
                ..self
            },
            Change::Stop => Self { stop: true, ..self },
            Change::Describe(description) => Self {
                description,
                ..self
            },
            Change::KeepSurface => Self {
                description: Description::PLAIN,
                keeps_surface: Some(Kept::Last),
                ..self
            },
        }
    }

    /// The bounds in numbers: largest radius-edge ratio, smallest dihedral angle in degrees.
    pub fn bounds(&self, params: &Params) -> [f64; 2] {
        let [radius_edge, angle] = [params.radius_edge, params.min_dihedral];
        match self.asks {
            Asks::Eased([r, a]) => [radius_edge * r, angle * a],
            Asks::AsWished => [radius_edge, angle],
            Asks::Loosened => [radius_edge.max(2.0), 0.0],
        }
    }

    /// Decides how many points may be added, now that the surface is known. Where its layers take too many elements, the
    /// mesh is taken as it is after some points for each of the surface.
    pub fn limit(
        &mut self,
        first: impl FnOnce() -> Room,
        layers: impl FnOnce() -> Option<Layers>,
        plc: &Plc,
    ) {
        if self.room.is_none() {
            let first = first();
            self.room = Some(first);
            self.layers = layers().filter(|l| l.elements > first.more().most());
            if self.layers.is_some() {
                self.asks = Asks::Loosened;
                self.stop = true;
            }
        }
        if self.stop {
            self.room = Some(Room::last(plc));
        }
    }

    /// What the mesher is to do.
    pub fn task(&self, params: &Params, preserve: bool) -> Task {
        Task {
            bounds: params.quality.then(|| self.bounds(params)),
            preserve: preserve || self.keeps_surface.is_some(),
            most_points: self.room.map(Room::most),
            rounds_from: self.description.rounds_from,
            switches: params.switches.clone(),
        }
    }

    /// What became of the bounds, if they are not what was asked for.
    pub fn advice(&self, params: &Params) -> Option<String> {
        let [radius_edge, _] = self.bounds(params);
        let stopped = match self.room.filter(|_| self.stop) {
            Some(room) => format!(", and it was stopped after {:.0} points", room.most()),
            None => String::new(),
        };
        let why = match self.layers {
            Some(layers) => layers.to_string(),
            None => "refinement did not come to an end at sharp angles of the surface".to_owned(),
        };
        let loosened = (self.asks == Asks::Loosened).then(|| match params.quality {
            true => format!(
                "{why}: radius-edge bound eased to {radius_edge}, that of the smallest dihedral angle left out{stopped}",
            ),
            false => format!("{why}{stopped}"),
        });
        let kept = (self.keeps_surface == Some(Kept::Last)).then(|| {
            "TetGen fails where it adds points to the surface, so that it added none: elements there are as large as its triangles"
                .to_owned()
        });
        let all: Vec<String> = kept.into_iter().chain(loosened).collect();
        (!all.is_empty()).then(|| all.join("; "))
    }
}

/// The mesh of one attempt.
pub struct Answer {
    /// The surface as it was described.
    pub plc: Plc,
    /// Its tetrahedra.
    pub mesh: Mesh,
    /// What became of the bounds, if they could not be met.
    pub advice: Option<String>,
    /// When the mesher was done.
    pub meshed: Instant,
    /// Attempts that failed before.
    pub failed: usize,
}

impl Answer {
    /// Whether the points of the complex came back first and where they were.
    pub fn keeps_points(&self) -> bool {
        let (given, found) = (&self.plc.points, self.mesh.points());
        found.len() >= given.len() && found[..given.len()] == **given
    }
}
