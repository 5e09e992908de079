use super::*;
use crate::{Asks, Description, Elements, LADDER, Mesh, Task};
use glam::DVec3;
use std::sync::Mutex;
use tmesh::{Document, OUTSIDE, Region, Template, Triangle, Wishes};

/// A mesher that ends as it is told, one word for each run, and notes what it was asked for.
struct Scripted {
    endings: Vec<FailureKind>,
    /// The step in which it fails.
    step: &'static str,
    /// How far a point is from the first one that it adds, in the mesher's unit.
    adds: Option<f64>,
    asked: Mutex<Vec<(Task, Vec<u32>)>>,
}

impl Scripted {
    fn new(endings: &[FailureKind]) -> Self {
        Self {
            endings: endings.to_vec(),
            step: "Refining mesh",
            adds: None,
            asked: Mutex::default(),
        }
    }

    fn runs(&self) -> usize {
        self.asked.lock().unwrap().len()
    }
}

impl Mesher for Scripted {
    fn mesh(&self, plc: &Plc, task: &Task, _: Limits, _: Log<'_>) -> Result<Mesh, Failure> {
        let mut asked = self.asked.lock().unwrap();
        let run = asked.len();
        asked.push((task.clone(), plc.vertex_of_point.clone()));
        match self.endings.get(run) {
            Some(&kind) => Err(Failure {
                kind,
                what: format!("run {run} failed"),
                step: self.step.to_owned(),
            }),
            None => {
                let mut points = plc.points.clone();
                if let Some(near) = self.adds {
                    let [x, y, z] = points[0];
                    points.insert(1, [x + near, y, z]);
                }
                Ok(Box::new(One(points)))
            }
        }
    }

    fn intersections(&self, _: &Plc, _: Limits) -> Vec<[usize; 2]> {
        vec![[0, 1]]
    }
}

/// A single tetrahedron.
struct One(Vec<[f64; 3]>);

impl Elements for One {
    fn points(&self) -> &[[f64; 3]] {
        &self.0
    }
    fn tetrahedra(&self) -> &[[i32; 4]] {
        &[[0, 1, 2, 3]]
    }
    fn neighbors(&self) -> &[[i32; 4]] {
        &[[-1; 4]]
    }
    fn triangles(&self) -> &[[i32; 3]] {
        &[]
    }
    fn triangle_markers(&self) -> &[i32] {
        &[]
    }
    fn sides(&self, _: usize) -> [Option<usize>; 2] {
        [None; 2]
    }
    fn told(&self) -> &str {
        ""
    }
}

fn document() -> Document {
    let triangle = |vertices| Triangle {
        vertices,
        marker: 0,
        front: OUTSIDE,
        back: 1,
    };
    let mut document = Document::single(Template {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        triangles: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
            .map(triangle)
            .to_vec(),
        ..Template::default()
    });
    document.regions.push(Region {
        id: 1,
        name: "all".to_owned(),
        size: None,
        volume: None,
    });
    document
}

/// Climbs until a mesh is taken; gives the number of its run.
fn climb(mesher: &Scripted, rungs: &[Rung], timeout: Option<Duration>) -> Result<usize, Error> {
    take(mesher, rungs, timeout, |_| Ok(mesher.runs()))
}

fn take<T>(
    mesher: &Scripted,
    rungs: &[Rung],
    timeout: Option<Duration>,
    what: impl Fn(Answer) -> Result<T, Error>,
) -> Result<T, Error> {
    let document = document();
    let params = Params {
        timeout,
        ..Params::default()
    };
    let sizes = Sizes::of_regions(&document);
    let climb = Climb {
        piece: Piece::of(&document, 0),
        params: &params,
        sizes: &sizes,
        preserve: false,
        rungs,
        deadline: Deadline::start(timeout),
        mesher,
        log: Log::new(&|_| ()),
    };
    climb.climb(Attempt::new(Asks::Eased([1.1, 0.5])), what)
}

#[test]
fn the_first_mesh_as_asked_for_is_taken() {
    let mesher = Scripted::new(&[]);
    assert_eq!(climb(&mesher, &LADDER, None).unwrap(), 1);
    let asked = mesher.asked.lock().unwrap();
    let [radius_edge, angle] = asked[0].0.bounds.unwrap();
    assert!((radius_edge - 1.54).abs() < 1e-12 && angle == 5.0);
}

#[test]
fn points_that_come_as_near_as_the_mesher_can_tell_are_a_heap() {
    let bounds = |near: f64| -> Vec<[f64; 2]> {
        let mesher = Scripted {
            adds: Some(near),
            ..Scripted::new(&[])
        };
        climb(&mesher, &LADDER, None).unwrap();
        let asked = mesher.asked.into_inner().unwrap();
        asked.iter().map(|(task, _)| task.bounds.unwrap()).collect()
    };
    // Looser bounds, then a limit of points, then it is taken.
    let asked = bounds(1e-8);
    assert_eq!((asked.len(), &asked[1..]), (3, &[[2.0, 0.0]; 2][..]));
    assert_eq!(bounds(1e-6).len(), 1);
}

#[test]
fn failures_by_chance_get_other_descriptions_until_the_ladder_ends() {
    let mesher = Scripted::new(&[FailureKind::Chance; 2]);
    assert_eq!(climb(&mesher, &LADDER, None).unwrap(), 3);
    assert_eq!(mesher.asked.lock().unwrap()[1].1, [3, 2, 1, 0]);
    // Without an end of it, each rung for it is taken once.
    let mesher = Scripted::new(&[FailureKind::Chance; 100]);
    let error = climb(&mesher, &LADDER, None).unwrap_err();
    let descriptions = LADDER.iter().filter(|r| r.after == Ending::Chance).count();
    assert_eq!(mesher.runs(), 1 + descriptions);
    assert!(mesher.runs() <= 1 + LADDER.len());
    assert!(
        error.to_string().contains("intersect, the first near"),
        "{error}"
    );
    // At last without points on the surface, if they are what fails.
    let mesher = Scripted {
        step: "Constrained Delaunay",
        ..Scripted::new(&vec![FailureKind::Chance; 1 + descriptions])
    };
    let told = take(&mesher, &LADDER, None, |answer| Ok(answer.advice));
    let told = told.unwrap().unwrap();
    assert!(told.contains("added none"), "{told}");
    let asked = mesher.asked.into_inner().unwrap();
    let preserved: Vec<bool> = asked.iter().map(|(task, _)| task.preserve).collect();
    let (last, others) = preserved.split_last().unwrap();
    assert!(*last && others.iter().all(|p| !p), "{preserved:?}");
    // No rungs, no other attempt.
    let mesher = Scripted::new(&[FailureKind::Chance]);
    assert!(climb(&mesher, &[], None).is_err());
    assert_eq!(mesher.runs(), 1);
}

#[test]
fn what_copies_have_as_well_is_divided_otherwise_at_once() {
    let mesher = Scripted::new(&[]);
    let made = take(&mesher, &LADDER, None, |_| match mesher.runs() {
        run @ 1..3 => Err(Error::Doubled {
            template: 0,
            wall: format!("wall of run {run}"),
            place: Place(DVec3::ZERO),
        }),
        run => Ok(run),
    });
    assert_eq!(made.unwrap(), 3);
    // First in the same order, then as after any other failure.
    let asked = mesher.asked.into_inner().unwrap();
    let orders: Vec<&[u32]> = asked.iter().map(|(_, points)| &points[..]).collect();
    assert_eq!(orders, [[0, 1, 2, 3], [0, 1, 2, 3], [3, 2, 1, 0]]);
    let doubled = LADDER.iter().find(|r| r.after == Ending::Doubled);
    let apart = Description {
        apart: true,
        ..Description::PLAIN
    };
    assert_eq!(doubled.map(|r| r.change), Some(Change::Describe(apart)));
}

#[test]
fn failures_that_nothing_changes_end_it() {
    for kind in [
        FailureKind::Final,
        FailureKind::TimedOut,
        FailureKind::Killed,
        FailureKind::Outside,
        FailureKind::NoMemory,
    ] {
        let mesher = Scripted::new(&[kind; 100]);
        assert!(climb(&mesher, &LADDER, None).is_err());
        assert_eq!(mesher.runs(), 1, "{kind:?}");
    }
}

#[test]
fn no_rung_is_taken_when_the_time_is_over() {
    let mesher = Scripted::new(&[FailureKind::Chance; 100]);
    let none = Some(Duration::from_nanos(1));
    assert!(climb(&mesher, &LADDER, none).is_err());
    assert_eq!(mesher.runs(), 1);
}

#[test]
fn thin_layers_are_meshed_coarsely_unless_bounds_are_asked_for() {
    let mut document = document();
    let corners = (0..8).map(|c| {
        let thickness = 5e-4;
        DVec3::new(
            f64::from(c & 1),
            f64::from(c >> 1 & 1),
            thickness * f64::from(c >> 2),
        )
    });
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let plate = &mut document.templates[0];
    let first = plate.triangles[0];
    plate.vertices = corners.collect();
    plate.triangles = sides
        .into_iter()
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
        .map(|vertices| Triangle { vertices, ..first })
        .collect();
    let sizes = Sizes::of_regions(&document);
    let bounds = |radius_edge: Option<f64>| {
        let wishes = Wishes {
            radius_edge,
            ..Wishes::default()
        };
        let params = Params::new(&wishes);
        let mesher = Scripted::new(&[]);
        let climb = Climb {
            piece: Piece::of(&document, 0),
            params: &params,
            sizes: &sizes,
            preserve: false,
            rungs: &LADDER,
            deadline: Deadline::start(None),
            mesher: &mesher,
            log: Log::new(&|_| ()),
        };
        let advice = climb
            .climb(Attempt::new(Asks::AsWished), |answer| Ok(answer.advice))
            .unwrap();
        let asked = mesher.asked.lock().unwrap();
        (asked[0].0.bounds.unwrap(), advice)
    };
    let (loosened, advice) = bounds(None);
    assert_eq!(loosened, [2.0, 0.0]);
    assert!(advice.unwrap().contains("layers as thin as 0.0005"));
    let (wished, advice) = bounds(Some(1.5));
    assert_eq!((wished[0], advice), (1.5, None));
}
