//! Measures the coefficients of [`CostModel`]: meshes bodies whole and cut in several ways with the real tools, and
//! fits what the estimate says to what came out.
//!
//! `calibrate FOLDER`: where the programs `body`, `symdetect`, `wedgecut` and `tetwedge` are. `make calibrate` builds
//! them and runs this. Printed are the measurements, beside what the present coefficients say of them, and the
//! fitted coefficients.

use estimate::harm::sliced;
use estimate::{CostModel, Cut, Estimate, Wedge, edge_of_volume};
use std::f64::consts::{PI, TAU};
use std::io::{Read, Write};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tmesh::Document;

/// Bodies, as arguments of `body`, with mirror planes that contain the axis or without; the orders to mesh at; the
/// radius of a hub, where the axis runs through material.
const BODIES: &[(&str, bool, &[u32], Option<f64>)] = &[
    ("prism --order 16", true, &[2, 4, 16], Some(0.5)),
    (
        "ring --order 16 --thickness 0.05",
        true,
        &[2, 4, 8, 16],
        None,
    ),
    (
        "ring --order 64 --thickness 0.02",
        true,
        &[16, 32, 64],
        None,
    ),
    (
        "tsv --order 16 --thickness 0.02",
        true,
        &[2, 4, 8, 16],
        Some(0.5),
    ),
    ("gear --order 12", true, &[2, 3, 6, 12], None),
    ("ratchet --order 12", false, &[2, 3, 4, 6], None),
    ("ratchet --order 12 --bore 0", false, &[2, 3, 4], None),
    ("ratchet --order 8 --coating 0.02", false, &[2, 4, 8], None),
    ("impeller --order 6", false, &[2, 3, 6], None),
    ("impeller --order 5 --twist 60", false, &[5], None),
];

/// Largest volumes of elements: some thousands and some ten thousands of elements.
const VOLUMES: [f64; 2] = [1e-3, 1e-4];

/// Runs of which the fastest counts.
const RUNS: usize = 2;

/// A mesh that was made, and what the estimate needs to know of it.
struct Sample {
    name: String,
    body: Document,
    probe: Document,
    volume: f64,
    cut: Cut,
    whole: bool,
    hub: Option<f64>,
    /// Tetrahedra of all copies; of one wedge; of one hub.
    tetrahedra: [f64; 3],
    seconds: f64,
}

struct Tools(PathBuf);

impl Tools {
    fn run(&self, tool: &str, arguments: &str, input: &[u8]) -> Result<Vec<u8>, String> {
        let mut child = Command::new(self.0.join(tool))
            .args(arguments.split_whitespace())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|e| format!("{tool}: {e}"))?;
        let mut stdin = child.stdin.take().ok_or("no standard input")?;
        let mut stdout = child.stdout.take().ok_or("no standard output")?;
        let mut output = Vec::new();
        std::thread::scope(|scope| {
            scope.spawn(move || stdin.write_all(input));
            stdout.read_to_end(&mut output)
        })
        .map_err(|e| format!("{tool}: {e}"))?;
        let status = child.wait().map_err(|e| format!("{tool}: {e}"))?;
        match status.success() {
            true => Ok(output),
            false => Err(format!("{tool} {arguments}: {status}")),
        }
    }

    /// The mesh of a wedge, and the seconds it took; seams get their surface mesh before.
    fn mesh(&self, wedge: &[u8], volume: f64, seam: bool) -> Result<(Document, f64), String> {
        let volume = format!("--max-volume {volume}");
        let options = format!("--threads 1 {volume}");
        let surface = match seam {
            true => self.run("periodic-surf", &volume, wedge)?,
            false => wedge.to_vec(),
        };
        let mut best = Duration::MAX;
        let mut mesh = Vec::new();
        for _ in 0..RUNS {
            let start = Instant::now();
            mesh = self.run("tetwedge", &options, &surface)?;
            best = best.min(start.elapsed());
        }
        Ok((document(&mesh)?, best.as_secs_f64()))
    }
}

fn document(bytes: &[u8]) -> Result<Document, String> {
    tmesh::read(&mut &bytes[..]).map_err(|e| e.to_string())
}

fn main() {
    let folder = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "target/release".into());
    let tools = Tools(folder.into());
    let mut samples = Vec::new();
    for body in BODIES {
        for volume in VOLUMES {
            if let Err(error) = measure(&tools, body, volume, &mut samples) {
                eprintln!("{} at {volume:e}: {error}", body.0);
            }
        }
    }
    fit(&samples);
}

/// Meshes a body whole and cut.
fn measure(
    tools: &Tools,
    &(arguments, mirror, orders, hub): &(&str, bool, &[u32], Option<f64>),
    volume: f64,
    samples: &mut Vec<Sample>,
) -> Result<(), String> {
    let stl = tools.run("body", &format!("{arguments} --to ascii"), &[])?;
    let body = tools.run("symdetect", "", &stl)?;
    let plain = format!("--horizontal-mirror off --max-volume {volume}");
    let domain = if mirror { "mirror" } else { "rotation" };
    let last = orders.last().copied().unwrap_or(1);
    let cut = |order: u32, domain: &str, hub: &str| {
        let options = format!("{plain} --domain {domain} --order {order} --hub {hub}");
        tools.run("wedgecut", &options, &body)
    };
    let probe = document(&cut(last, domain, "none")?)?;
    let mut ways: Vec<(u32, bool, Option<f64>)> = vec![(1, true, None)];
    ways.extend(orders.iter().map(|&n| (n, false, None)));
    ways.extend(hub.map(|_| (last, false, hub)));
    for (order, whole, hub) in ways {
        let domain = if whole { "rotation" } else { domain };
        let radius = hub.map_or("none".to_owned(), |r| r.to_string());
        let wedge = cut(order, domain, &radius)?;
        let (mesh, seconds) = tools.mesh(&wedge, volume, !mirror && !whole)?;
        let of = |i: usize| mesh.templates.get(i).map_or(0, |t| t.tets.len()) as f64;
        let all = mesh.instances.iter().map(|i| of(i.template as usize)).sum();
        let copies = |t: u32| mesh.instances.iter().filter(|i| i.template == t).count() as f64;
        let angle = if mirror { PI } else { TAU } / f64::from(order);
        let body = document(&body)?;
        samples.push(Sample {
            name: format!("{arguments}, {volume:e}, order {order}, hub {radius}"),
            cut: Cut {
                order,
                angle,
                copies: copies(0),
                hub_copies: copies(1).max(1.0),
                reach: 1.0
                    / if mirror {
                        angle.cos()
                    } else {
                        (0.5 * angle).cos()
                    },
                free: mirror,
                across: false,
                harm: match mirror || whole {
                    true => 0.0,
                    false => f64::from(order) * harm(&body, &mesh, volume),
                },
                hub: hub.is_some(),
            },
            body,
            probe: probe.clone(),
            volume,
            whole,
            hub,
            tetrahedra: [all, of(0), of(1)],
            seconds,
        });
        eprintln!("{}: {all}", samples[samples.len() - 1].name);
    }
    Ok(())
}

/// What the seam of a wedge slices.
fn harm(body: &Document, wedge: &Document, volume: f64) -> f64 {
    let surface = &body.templates[0];
    let points = surface.vertices.iter();
    let points: Vec<_> = points.map(|&p| wedge.frame.to_canonical(p)).collect();
    let size = edge_of_volume(volume);
    let size = |_: &_| size;
    sliced::harm(&points, &surface.triangles, 0.0, 1e-6, (size, |_| true)).sliced
}

impl Sample {
    fn estimate(&self, model: CostModel) -> Estimate {
        let size = edge_of_volume(self.volume);
        let needles = estimate::needles(&self.body.templates[0], |_| size, None);
        let wedge = Wedge::new(&self.probe.templates[0], 0, self.probe.instances.len());
        Estimate::new(model, &wedge, needles, |_| Some(self.volume), 1)
    }

    /// Elements of wedges and of hubs.
    fn elements(&self, estimate: &Estimate) -> [f64; 2] {
        let model = &estimate.model;
        if self.whole {
            return [estimate.whole().elements(model), 0.0];
        }
        let [outer, inner] = estimate
            .parts(&self.cut, self.hub)
            .map(|t| t.elements(model));
        [outer + estimate.seams(&self.cut), inner]
    }
}

/// A sample, its estimate, and those of the same body meshed as a whole.
struct Compared<'a> {
    sample: &'a Sample,
    estimate: Estimate,
    whole: &'a Sample,
}

impl Compared<'_> {
    /// Tetrahedra over those of the whole body, over what the coefficients say of that.
    fn ratio(&self, model: CostModel) -> f64 {
        let estimate = self.estimate.with_model(model);
        let elements = |s: &Sample| s.elements(&estimate).iter().sum::<f64>();
        let measured = self.sample.tetrahedra[0] / self.whole.tetrahedra[0];
        measured / (elements(self.sample) / elements(self.whole))
    }
}

/// How far ratios are from one: the root of the mean square of their logarithms.
fn spread(all: &[&[Compared<'_>]], model: CostModel) -> f64 {
    let all = || all.iter().copied().flatten();
    let squares = all().map(|c| c.ratio(model).ln().powi(2));
    (squares.sum::<f64>() / all().count().max(1) as f64).sqrt()
}

/// The value of a coefficient, of those between two bounds, that makes the spread least.
fn best(
    all: &[&[Compared<'_>]],
    model: CostModel,
    [low, high]: [f64; 2],
    set: &dyn Fn(&mut CostModel, f64),
) -> CostModel {
    const STEPS: u32 = 50;
    let values = (0..=STEPS).map(|i| low + (high - low) * f64::from(i) / f64::from(STEPS));
    let models = values.map(|x| {
        let mut model = model;
        set(&mut model, x);
        (spread(all, model), model)
    });
    let least = models.min_by(|a, b| a.0.total_cmp(&b.0));
    least.map_or(model, |(_, model)| model)
}

fn fit(samples: &[Sample]) {
    let present = CostModel::CALIBRATED;
    let mut compared = Vec::new();
    let mut whole = &samples[0];
    for sample in samples {
        if sample.whole {
            whole = sample;
            continue;
        }
        let estimate = sample.estimate(present);
        // Wedges that are narrow at the axis are never cut without a hub.
        if sample.hub.is_some() || !estimate.is_narrow(sample.cut.angle) {
            compared.push(Compared {
                sample,
                estimate,
                whole,
            });
        }
    }
    println!("tetrahedra  over those of the whole body  over the estimate  seconds  mesh");
    for c in &compared {
        let all = c.sample.tetrahedra[0];
        let share = all / c.whole.tetrahedra[0];
        let (ratio, seconds) = (c.ratio(present), c.sample.seconds);
        println!(
            "{all:10} {share:6.2} {ratio:6.2} {seconds:8.3}  {}",
            c.sample.name
        );
    }
    let (hubs, plain): (Vec<_>, Vec<_>) =
        compared.into_iter().partition(|c| c.sample.hub.is_some());
    let (mirror, seam): (Vec<_>, Vec<_>) = plain.into_iter().partition(|c| c.sample.cut.free);
    let mut model = present;
    // Each is felt beside the others: twice around is enough for what the spread tells. A coefficient is fitted to all
    // meshes that feel it.
    let free: &[&[Compared<'_>]] = &[&mirror, &hubs];
    for _ in 0..2 {
        model = best(free, model, [0.0, 0.5], &|m, x| m.skin = x);
        model = best(free, model, [0.6, 2.6], &|m, x| m.span = x);
        model = best(&[&seam], model, [0.3, 1.8], &|m, x| m.seam_span = x);
        model = best(&[&seam], model, [0.0, 20.0], &|m, x| m.sliced = x);
        model = best(&[&hubs], model, [0.0, 2.0], &|m, x| m.hub_skin = x);
    }
    let factors = samples.iter().filter(|s| s.whole).map(|s| {
        let elements: f64 = s.elements(&s.estimate(model)).iter().sum();
        (s.tetrahedra[0] / elements).ln()
    });
    let count = samples.iter().filter(|s| s.whole).count().max(1);
    model.tetrahedra = (factors.sum::<f64>() / count as f64).exp();
    for (name, all) in [
        ("mirror wedges", &mirror[..]),
        ("seams", &seam[..]),
        ("hubs", &hubs[..]),
    ] {
        let (before, after) = (spread(&[all], present), spread(&[all], model));
        println!("{name}: spread {before:.3} with the present coefficients, {after:.3} fitted");
    }
    times(samples, &mut model);
    println!("\n{model:#?}");
}

/// Seconds of a mesh without a hub: a start, and some for each tetrahedron; with a hub so many times that of the hub
/// as well.
fn times(samples: &[Sample], model: &mut CostModel) {
    let plain = samples.iter().filter(|s| s.hub.is_none());
    let points: Vec<[f64; 2]> = plain.map(|s| [s.tetrahedra[1], s.seconds]).collect();
    // Relative errors: otherwise the largest mesh alone would tell.
    let weights = points.iter().map(|p| 1.0 / (p[1] * p[1]));
    let mut sums = [0.0; 5];
    for ([x, y], w) in points.iter().zip(weights) {
        for (sum, term) in sums.iter_mut().zip([w, w * x, w * x * x, w * y, w * x * y]) {
            *sum += term;
        }
    }
    let [n, x, xx, y, xy] = sums;
    let each = (n * xy - x * y) / (n * xx - x * x);
    let start = (y - each * x) / n;
    model.start = start / each / model.tetrahedra;
    model.seconds = each;
    let hubs = samples.iter().filter(|s| s.hub.is_some());
    let factors: Vec<f64> = hubs
        .map(|s| (s.seconds - start - each * s.tetrahedra[1]) / (start + each * s.tetrahedra[2]))
        .collect();
    model.hub_time = factors.iter().sum::<f64>() / factors.len().max(1) as f64;
    println!(
        "time: start {start:.4} s, {:.2e} s per tetrahedron: start {:.0}, hub_time {:.1}",
        each, model.start, model.hub_time
    );
}
