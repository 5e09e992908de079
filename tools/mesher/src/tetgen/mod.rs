//! TetGen, by the binding `tetgen-sys`, as a [`Mesher`].

mod chatter;
mod intersections;
mod switches;

use crate::{Elements, Failure, FailureKind, Limits, Log, Mesh, Mesher, Plc, Task};
use chatter::Chatter;
use intersections::pairs;
use std::time::Duration;
use switches::switches;
use tetgen_sys::{Complex, Error, News, RegionSeed, SizeNode, Sizes, tetrahedralize};
use tmesh::Size;

/// Time from one word of progress to the next. A choice: people see a line move, and reading the counts takes nothing.
const TOLD_EVERY: Duration = Duration::from_millis(200);

/// Processor time that a step other than refinement may take, and refinement from one sign of life to the next; and for each
/// point. The slowest was measured to take some ten microseconds for a point; a hundred times that, and what starting a process
/// may take, are for slower machines.
const SILENCE: Duration = Duration::from_secs(10);
const SILENCE_OF_POINT: Duration = Duration::from_millis(1);

/// The system's TetGen library, each run in a process of its own.
#[derive(Clone, Copy, Debug, Default)]
pub struct TetGen;

impl Mesher for TetGen {
    fn mesh(&self, plc: &Plc, task: &Task, limits: Limits, log: Log<'_>) -> Result<Mesh, Failure> {
        let told = switches(plc, task);
        log.detail(&format!(
            "template {}: {} points, {} triangles in {} facets, {} void(s); switches {told}",
            plc.template,
            plc.points.len(),
            plc.facets.of_triangle.len(),
            plc.facets.facets.len(),
            plc.holes.len(),
        ));
        let mut chatter = Chatter::new(log, plc.template);
        let (seeds, nodes) = (seeds(plc), nodes(plc));
        let limits = tetgen_sys::Limits {
            counted_every: log.has_progress().then_some(TOLD_EVERY),
            silence: Some(SILENCE + SILENCE_OF_POINT * plc.points.len() as u32),
            ..limits.into()
        };
        let made =
            tetrahedralize(
                &complex(plc, &seeds, &nodes),
                &told,
                limits,
                &mut |news| match news {
                    News::Printed(bytes) => chatter.take(bytes),
                    News::Counted(counts) => chatter.count(counts),
                },
            );
        match made {
            Ok(arrays) => Ok(Box::new(Tetrahedra { arrays, told })),
            Err(error) => Err(failure(&error, chatter.step)),
        }
    }

    fn intersections(&self, plc: &Plc, limits: Limits) -> Vec<[usize; 2]> {
        let mut text = Vec::new();
        let seeds = seeds(plc);
        // Only what it prints is of interest: at most a line for each pair that it looks at in the time given.
        let _ = tetrahedralize(
            &complex(plc, &seeds, &[]),
            "pd",
            limits.into(),
            &mut |news| {
                if let News::Printed(bytes) = news {
                    text.extend_from_slice(bytes);
                }
            },
        );
        pairs(String::from_utf8_lossy(&text).lines(), plc.triangles.len())
    }
}

impl From<Limits> for tetgen_sys::Limits {
    fn from(limits: Limits) -> Self {
        Self {
            timeout: limits.timeout,
            memory: limits.memory,
            silence: None,
            counted_every: None,
        }
    }
}

fn seeds(plc: &Plc) -> Vec<RegionSeed> {
    let seeds = plc.sizes.iter().map(|seed| RegionSeed {
        point: seed.point,
        attribute: f64::from(seed.number),
        max_volume: seed.max_volume.unwrap_or(-1.0),
    });
    seeds.collect()
}

fn nodes(plc: &Plc) -> Vec<SizeNode> {
    let nodes = plc.graded.iter().flat_map(|graded| &graded.nodes);
    let nodes = nodes.map(|node| SizeNode {
        size: node.size,
        first: node.first,
        padding: 0,
    });
    nodes.collect()
}

fn complex<'a>(plc: &'a Plc, seeds: &'a [RegionSeed], nodes: &'a [SizeNode]) -> Complex<'a> {
    Complex {
        points: &plc.points,
        triangles: &plc.triangles,
        markers: &plc.markers,
        holes: &plc.holes,
        regions: seeds,
        sizes: plc
            .graded
            .as_ref()
            .filter(|_| !nodes.is_empty())
            .map(|graded| Sizes {
                origin: graded.origin.to_array(),
                width: graded.width,
                volume: Size::OF_CUBE,
                nodes,
            }),
    }
}

fn failure(error: &Error, step: String) -> Failure {
    use tetgen_sys::Failure as Thrown;
    let kind = match error {
        Error::Crashed { .. } => FailureKind::Chance,
        Error::Failed(Thrown::OutOfMemory) => FailureKind::NoMemory,
        Error::Failed(Thrown::BadInput) => FailureKind::Final,
        Error::Failed(_) | Error::Silent(_) => FailureKind::Chance,
        Error::TimedOut(_) => FailureKind::TimedOut,
        Error::MemoryLimit(_) => FailureKind::MemoryLimit,
        Error::Killed => FailureKind::Killed,
        Error::BadSwitches(_) | Error::NotLinear(_) => FailureKind::Switches,
        Error::Stopped { .. } | Error::System { .. } => FailureKind::Outside,
        _ => FailureKind::Final,
    };
    let known = !matches!(error, Error::System { .. });
    Failure {
        kind,
        what: error.to_string(),
        step: if known { step } else { String::new() },
    }
}

/// TetGen's arrays, and its switches.
struct Tetrahedra {
    arrays: tetgen_sys::Mesh,
    told: String,
}

impl Elements for Tetrahedra {
    fn points(&self) -> &[[f64; 3]] {
        self.arrays.points()
    }

    fn tetrahedra(&self) -> &[[i32; 4]] {
        self.arrays.tetrahedra()
    }

    fn neighbors(&self) -> &[[i32; 4]] {
        self.arrays.neighbors()
    }

    fn triangles(&self) -> &[[i32; 3]] {
        self.arrays.triangles()
    }

    fn triangle_markers(&self) -> &[i32] {
        self.arrays.triangle_markers()
    }

    fn sides(&self, triangle: usize) -> [Option<usize>; 2] {
        self.arrays.sides(triangle)
    }

    fn told(&self) -> &str {
        &self.told
    }
}
