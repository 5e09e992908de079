use crate::{
    Child, Complex, Counts, Error, Failure, Limits, News, RegionSeed, SizeNode, Sizes,
    tetrahedralize,
};
use std::time::{Duration, Instant};

struct Body {
    points: Vec<[f64; 3]>,
    triangles: Vec<[i32; 3]>,
    markers: Vec<i32>,
}

impl Body {
    fn complex(&self) -> Complex<'_> {
        Complex {
            points: &self.points,
            triangles: &self.triangles,
            markers: &self.markers,
            holes: &[],
            regions: &[],
            sizes: None,
        }
    }

    fn add_cube(&mut self, low: f64, high: f64) {
        let base = self.points.len() as i32;
        for i in 0..8 {
            let at = |bit: i32| if i & bit != 0 { high } else { low };
            self.points.push([at(1), at(2), at(4)]);
        }
        let quads = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        for (i, q) in quads.iter().enumerate() {
            for t in [[q[0], q[1], q[2]], [q[0], q[2], q[3]]] {
                self.triangles.push(t.map(|v| v + base));
                self.markers.push(i as i32 + 1);
            }
        }
    }
}

fn cube() -> Body {
    let mut body = Body {
        points: Vec::new(),
        triangles: Vec::new(),
        markers: Vec::new(),
    };
    body.add_cube(0.0, 1.0);
    body
}

fn run(
    complex: &Complex<'_>,
    switches: &str,
    seconds: f64,
) -> (Result<crate::Mesh, Error>, String) {
    let mut text = Vec::new();
    let limits = Limits {
        timeout: Some(Duration::from_secs_f64(seconds)),
        ..Limits::default()
    };
    let result = tetrahedralize(complex, switches, limits, &mut |news| {
        if let News::Printed(bytes) = news {
            text.extend_from_slice(bytes);
        }
    });
    (result, String::from_utf8_lossy(&text).into_owned())
}

fn volume(p: &[[f64; 3]], t: [i32; 4]) -> f64 {
    let [a, b, c, d] = t.map(|v| p[v as usize]);
    let [u, v, w] = [b, c, d].map(|q| [q[0] - a[0], q[1] - a[1], q[2] - a[2]]);
    let n = [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ];
    (n[0] * w[0] + n[1] * w[1] + n[2] * w[2]) / 6.0
}

#[test]
fn a_cube_is_filled_and_described() {
    let body = cube();
    let (mesh, text) = run(&body.complex(), "pq1.4a0.01nnJ", 60.0);
    let mesh = mesh.unwrap();
    assert!(text.contains("Delaunizing"), "{text}");
    assert_eq!(mesh.points()[..8], body.points);
    assert_eq!(mesh.neighbors().len(), mesh.tetrahedra().len());
    let volumes: Vec<f64> = mesh
        .tetrahedra()
        .iter()
        .map(|&t| volume(mesh.points(), t))
        .collect();
    assert!(volumes.iter().all(|&v| v > 0.0));
    assert!((volumes.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    assert!(volumes.len() > 100);
    for (i, n) in mesh.neighbors().iter().enumerate() {
        let t = mesh.tetrahedra()[i];
        for corner in (0..4).filter(|&c| n[c] >= 0) {
            let other = mesh.tetrahedra()[n[corner] as usize];
            assert!(!other.contains(&t[corner]));
            assert!((0..4).all(|c| c == corner || other.contains(&t[c])));
        }
    }
    for (i, t) in mesh.triangles().iter().enumerate() {
        // A cube face's plane: all its triangles agree in one coordinate.
        let axis = [2, 2, 1, 1, 0, 0][mesh.triangle_markers()[i] as usize - 1];
        let value = mesh.points()[t[0] as usize][axis];
        assert!(t.iter().all(|&v| mesh.points()[v as usize][axis] == value));
        let sides = mesh.sides(i);
        assert_eq!(sides.iter().flatten().count(), 1);
    }
}

#[test]
fn holes_stay_empty_and_seeds_bound_volumes() {
    let mut body = cube();
    body.add_cube(0.25, 0.75);
    let complex = Complex {
        holes: &[[0.5, 0.5, 0.5]],
        ..body.complex()
    };
    let (mesh, _) = run(&complex, "pq", 60.0);
    let mesh = mesh.unwrap();
    let total: f64 = mesh
        .tetrahedra()
        .iter()
        .map(|&t| volume(mesh.points(), t))
        .sum();
    assert!((total - 0.875).abs() < 1e-12);

    let seeds = [
        RegionSeed {
            point: [0.5, 0.5, 0.5],
            attribute: 7.0,
            max_volume: 1e-4,
        },
        RegionSeed {
            point: [0.1, 0.1, 0.1],
            attribute: 8.0,
            max_volume: 0.0,
        },
    ];
    let complex = Complex {
        regions: &seeds,
        ..body.complex()
    };
    let (mesh, _) = run(&complex, "pqAa", 60.0);
    let mesh = mesh.unwrap();
    let inner = mesh.attributes().iter().filter(|&&a| a == 7.0).count();
    assert!(inner > 1250, "{inner}");
    for (&t, &a) in mesh.tetrahedra().iter().zip(mesh.attributes()) {
        assert!(a == 8.0 || volume(mesh.points(), t) < 1e-4);
    }
}

#[test]
fn sizes_may_change_from_place_to_place() {
    let body = cube();
    let leaf = |size: f64| SizeNode {
        size,
        first: 0,
        padding: 0,
    };
    let root = SizeNode {
        first: 1,
        ..leaf(0.0)
    };
    let mut nodes = vec![root];
    // Fine where x is below a half.
    nodes.extend((0..8).map(|child| leaf(if child % 2 == 0 { 0.1 } else { 0.5 })));
    let sizes = |nodes: &[SizeNode]| {
        let complex = Complex {
            sizes: Some(Sizes {
                origin: [0.0; 3],
                width: 1.0,
                volume: 0.25,
                nodes,
            }),
            ..body.complex()
        };
        run(&complex, "pq", 60.0).0
    };
    let mesh = sizes(&nodes).unwrap();
    let points = mesh.points();
    let mut most = [0.0_f64; 2];
    for &t in mesh.tetrahedra() {
        let middle = t.iter().map(|&v| 0.25 * points[v as usize][0]).sum::<f64>();
        let side = usize::from(middle >= 0.5);
        most[side] = most[side].max(volume(points, t));
    }
    // Optimization moves vertices after the sizes were met, and may exceed them.
    assert!(most[0] <= 1.5 * 0.25e-3, "{most:?}");
    assert!(most[1] > 1e-3 && most[1] <= 1.5 * 0.25 * 0.125, "{most:?}");
    // What leads back would never end.
    nodes[8].first = 8;
    assert!(matches!(sizes(&nodes), Err(Error::Unfit(_))));
    nodes[8].first = 2;
    assert!(matches!(sizes(&nodes), Err(Error::Unfit(_))));
    assert!(matches!(sizes(&[]), Err(Error::Unfit(_))));
}

#[test]
fn what_tetgen_throws_is_an_error() {
    let mut body = cube();
    // A second cube that pierces the first.
    body.add_cube(0.5, 1.5);
    let (result, _) = run(&body.complex(), "pq", 60.0);
    assert!(
        matches!(result, Err(Error::Failed(Failure::SelfIntersection))),
        "{result:?}"
    );
}

#[test]
fn bad_switches_are_an_error() {
    let body = cube();
    let (result, _) = run(&body.complex(), "po2", 60.0);
    assert!(matches!(result, Err(Error::NotLinear(_))), "{result:?}");
    let (result, _) = run(&body.complex(), "p\0q", 60.0);
    assert!(matches!(result, Err(Error::BadSwitches(_))), "{result:?}");
}

#[test]
fn the_mesher_may_exit_by_itself() {
    // TetGen prints its help and ends the process.
    let (result, text) = run(&cube().complex(), "h", 60.0);
    assert!(matches!(result, Err(Error::Exited { .. })), "{result:?}");
    assert!(text.contains("TetGen"));
}

#[test]
fn a_time_limit_is_kept() {
    let begun = Instant::now();
    let (result, _) = run(&cube().complex(), "pq1.1a1e-8", 0.3);
    assert!(matches!(result, Err(Error::TimedOut(_))), "{result:?}");
    assert!(begun.elapsed() < Duration::from_secs(5));
}

#[test]
fn a_step_that_comes_to_no_end_is_stopped() {
    // The points inside take some tenths of a second before refinement.
    let mut body = cube();
    let turns = [0.381_966, 0.271_845, 0.618_034];
    let inside = (1..200_000).map(|i| turns.map(|turn| (f64::from(i) * turn).fract()));
    body.points.extend(inside);
    let run = |silence| {
        let limits = Limits {
            silence,
            ..Limits::default()
        };
        tetrahedralize(&body.complex(), "p", limits, &mut |_| {})
    };
    let result = run(Some(Duration::ZERO));
    assert!(matches!(result, Err(Error::Silent(_))), "{result:?}");
    assert!(run(Some(Duration::from_secs(3600))).is_ok());
}

#[test]
fn crashes_and_kills_are_told_apart() {
    let body = cube();
    let crashes = [libc::SIGSEGV, libc::SIGABRT];
    // Interrupts and hangups may be ignored, in the child if in this process.
    let from_outside = [libc::SIGKILL, libc::SIGALRM, libc::SIGUSR1];
    for signal in crashes.into_iter().chain(from_outside) {
        let limits = Limits {
            timeout: Some(Duration::from_secs(20)),
            ..Limits::default()
        };
        let child = Child::start(&body.complex(), "pq1.1a1e-9", limits).unwrap();
        let id = child.id() as libc::pid_t;
        // Once it prints, it is past the beginning, where our own signal handlers still apply.
        let result = child.finish(&mut |_| {
            // SAFETY: a signal to a child that is not yet collected.
            unsafe {
                libc::kill(id, signal);
            }
        });
        match result {
            Err(Error::Killed) => assert_eq!(signal, libc::SIGKILL),
            Err(Error::Crashed { signal: found }) => {
                assert_eq!(found, signal);
                assert!(crashes.contains(&signal));
            }
            Err(Error::Stopped { signal: found }) => {
                assert_eq!(found, signal);
                assert!(!crashes.contains(&signal));
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn memory_is_limited() {
    let body = cube();
    let meshed = |megabytes: u64| {
        let limits = Limits {
            timeout: Some(Duration::from_secs(60)),
            memory: Some(megabytes << 20),
            ..Limits::default()
        };
        tetrahedralize(&body.complex(), "pqa1e-5", limits, &mut |_| {})
    };
    // Whichever of its allocations fails.
    for megabytes in [1, 2, 5, 8, 13, 16, 24, 32] {
        match meshed(megabytes) {
            Err(error @ Error::MemoryLimit(_)) => assert_eq!(
                error.to_string(),
                format!("TetGen needs more than {megabytes} MiB of memory, the limit")
            ),
            other => panic!("{megabytes}: {other:?}"),
        }
    }
    assert!(meshed(2048).unwrap().tetrahedra().len() > 100_000);
}

#[test]
fn a_dropped_child_is_gone() {
    let child = Child::start(&cube().complex(), "pq1.1a1e-9", Limits::default()).unwrap();
    let id = child.id();
    drop(child);
    assert!(!std::path::Path::new(&format!("/proc/{id}")).exists());
}

#[test]
fn several_at_once() {
    let body = cube();
    std::thread::scope(|scope| {
        let jobs: Vec<_> = (0..4)
            .map(|_| scope.spawn(|| run(&body.complex(), "pq1.2a0.001", 60.0).0.unwrap()))
            .collect();
        let counts: Vec<_> = jobs
            .into_iter()
            .map(|j| j.join().unwrap().tetrahedra().len())
            .collect();
        assert!(counts.iter().all(|&n| n == counts[0]), "{counts:?}");
    });
}

#[test]
fn unfit_input_is_refused() {
    let mut body = cube();
    body.triangles[3][1] = 99;
    assert!(matches!(
        run(&body.complex(), "p", 9.0).0,
        Err(Error::Unfit(_))
    ));
    body = cube();
    body.points[2][1] = f64::NAN;
    assert!(matches!(
        run(&body.complex(), "p", 9.0).0,
        Err(Error::Unfit(_))
    ));
}

#[test]
fn counts_grow_and_change_nothing() {
    let body = cube();
    for switches in [
        "pq1.2a1e-4nn",
        "pq1.4/15nn",
        "pq1.2a1e-4S500",
        "pYq1.4a1e-3",
    ] {
        let (plain, said) = run(&body.complex(), switches, 60.0);
        let limits = Limits {
            counted_every: Some(Duration::from_millis(1)),
            ..Limits::default()
        };
        let mut counts = Vec::new();
        let mut printed = Vec::new();
        let counted = tetrahedralize(&body.complex(), switches, limits, &mut |news| match news {
            News::Counted(now) => counts.push(now),
            News::Printed(bytes) => printed.extend_from_slice(bytes),
        });
        let (plain, counted) = (plain.unwrap(), counted.unwrap());
        assert_eq!(plain.points(), counted.points());
        assert_eq!(plain.tetrahedra(), counted.tetrahedra());
        assert_eq!(plain.triangles(), counted.triangles());
        assert_eq!(
            said.lines().count(),
            String::from_utf8_lossy(&printed).lines().count()
        );
        let later = |pair: &[Counts]| {
            pair[0].checked <= pair[1].checked && pair[0].points <= pair[1].points
        };
        assert!(counts.windows(2).all(later));
        let last = counts.last().unwrap();
        let share = |count: u64, of: usize| count as f64 / of as f64;
        if plain.tetrahedra().len() > 1000 {
            assert!(counts.len() > 2);
            let checked = share(last.checked, plain.tetrahedra().len());
            assert!((1.0..2.0).contains(&checked), "{switches}: {checked}");
            // One point of 64 stands for all: five standard deviations.
            let points = share(last.points, plain.points().len());
            let deviation = (64.0 / plain.points().len() as f64).sqrt();
            assert!(
                (points - 1.0).abs() < 5.0 * deviation,
                "{switches}: {points}"
            );
        }
    }
}
