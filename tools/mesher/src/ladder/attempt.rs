//! One attempt: how the surface is described, what is asked for, and what came of it.

use super::room::Room;
use super::rungs::Change;
use crate::complex::Description;
use crate::{Mesh, Params, Plc, Task};
use geom::tet::TetMeasures;
use glam::DVec3;
use std::time::Instant;

/// Radius-edge ratio for which refinement is sure to end where no angle of the input is acute; see [`super::LADDER`].
const ENDING: f64 = 2.0;

/// The bounds that the mesher is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asks {
    /// Those of the user, times these: the radius-edge ratio, and the smallest dihedral angle. Improvement makes up
    /// for them.
    Eased([f64; 2]),
    /// Those of the user.
    AsWished,
    /// For which refinement ends.
    Loosened,
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
    /// The last limit, after which the mesh is taken as it is: points for each of the surface.
    pub stop: Option<f64>,
}

impl Attempt {
    /// The plain surface.
    pub fn new(asks: Asks) -> Self {
        Self {
            description: Description::PLAIN,
            asks,
            room: None,
            stop: None,
        }
    }

    /// The next attempt.
    pub fn changed(self, change: Change) -> Self {
        match change {
            Change::AskAsWished => Self {
                asks: Asks::AsWished,
                ..self
            },
            Change::AllowMore(times) => Self {
                room: self.room.map(|room| room.more(times)),
                ..self
            },
            Change::Loosen => Self {
                asks: Asks::Loosened,
                ..self
            },
            Change::Stop(points) => Self {
                stop: Some(points),
                ..self
            },
            Change::Describe(description) => Self {
                description,
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
            Asks::Loosened => [radius_edge.max(ENDING), 0.0],
        }
    }

    /// Decides how many points may be added, now that the surface is known.
    pub fn limit(&mut self, first: impl FnOnce() -> Room, plc: &Plc) {
        self.room = match self.stop {
            Some(points) => Some(Room::per_point(plc, points)),
            None => self.room.or_else(|| Some(first())),
        };
    }

    /// What the mesher is to do.
    pub fn task(&self, params: &Params, preserve: bool) -> Task {
        Task {
            bounds: params.quality.then(|| self.bounds(params)),
            preserve,
            most_points: self.room.map(Room::most),
            rounds_from: self.description.rounds_from,
            switches: params.switches.clone(),
        }
    }

    /// What became of the bounds, if they are not what was asked for.
    pub fn advice(&self, params: &Params) -> Option<String> {
        let [radius_edge, _] = self.bounds(params);
        let stopped = match self.room.filter(|_| self.stop.is_some()) {
            Some(room) => format!(", and it was stopped after {:.0} points", room.most()),
            None => String::new(),
        };
        (self.asks == Asks::Loosened).then(|| {
            format!(
                "refinement did not come to an end at sharp angles of the surface: radius-edge bound eased to {radius_edge}, \
                 that of the smallest dihedral angle left out{stopped}",
            )
        })
    }
}

/// The mesh of one attempt.
pub struct Answer {
    /// The surface as it was described.
    pub plc: Plc,
    /// Its tetrahedra.
    pub mesh: Mesh,
    /// The bounds that the mesher was given: largest radius-edge ratio, smallest dihedral angle in degrees.
    pub bounds: [f64; 2],
    /// What became of the bounds, if they could not be met.
    pub advice: Option<String>,
    /// When the mesher was done.
    pub meshed: Instant,
    /// Attempts that failed before.
    pub failed: usize,
    /// Whether there is a mesh already, and this one is to be better.
    pub again: bool,
}

impl Answer {
    /// The parts of the mesh that are past the bounds that the mesher was given: of the radius-edge ratio, and of the
    /// smallest dihedral angle.
    pub fn outside(&self) -> [f64; 2] {
        let [radius_edge, angle] = self.bounds;
        let least = angle.to_radians();
        let mut found = [0_usize; 2];
        let (points, tets) = (self.mesh.points(), self.mesh.tetrahedra());
        for t in tets {
            let measures = TetMeasures::of(t.map(|v| DVec3::from_array(points[v as usize])));
            found[0] += usize::from(measures.radius_edge_ratio > radius_edge);
            found[1] += usize::from(measures.min_dihedral < least);
        }
        found.map(|n| n as f64 / tets.len().max(1) as f64)
    }

    /// Whether the points of the complex came back first and where they were.
    pub fn keeps_points(&self) -> bool {
        let (given, found) = (&self.plc.points, self.mesh.points());
        found.len() >= given.len() && found[..given.len()] == **given
    }
}
