//! The seam that passes between the blades.

use super::gaps::Circles;
use super::seam::Graph;
use glam::DVec3;
use tmesh::Triangle;

/// Graphs with few and with more knots that slice little of a surface in the canonical frame, whose images are `opening` (radians) apart.
///
/// It minimizes, over the half plane of distance and height, what is sliced and how steep it is, both in elements as wide as the
/// arc `w` of the opening. At a distance `d` from the nearest surface, along the circle, an area `a` in material costs
/// the elements as small as that beyond the fewest possible, `a ((w / 2d)^2 - 1) / w^2`; outside of material, where there are
/// elements only at its ends, `a (w / 2d - 1) / w^2`. A slope `s`, which is that of the angle times the distance from the axis,
/// costs `a s^2 / w^2`. Each row and column of a grid is solved by dynamic programming, the others given, until
/// nothing changes. Graphs with a few knots begin at that and go downhill in the same measure.
///
/// `parts`: parts of the opening of which each has an angle to choose, and of the longer side of the body's section of which each
/// has a row or column. The seam may turn by as many openings altogether.
pub fn between(points: &[DVec3], triangles: &[Triangle], opening: f64, parts: usize) -> Vec<Graph> {
    let Some(grid) = grid(points, parts) else {
        return Vec::new();
    };
    let circles = Circles::new(points, triangles, opening, grid);
    let mut field = Field::new(&circles, opening, parts);
    field.solve();
    let even = field.smooth();
    let [radii, heights] = [&circles.radii, &circles.heights];
    let fine = Graph::new(radii.clone(), heights.clone(), even);
    let fits = |count: &[usize; 2]| count[0] <= radii.len() && count[1] <= heights.len();
    // From no bend to one along each direction.
    let counts = [1, 2, 3].map(|n| [[n, 1], [n, 2], [n, 3]]).concat();
    let counts = counts
        .into_iter()
        .filter(|count| count[0] * count[1] > 1 && fits(count));
    let graphs = counts.map(|count| {
        let knots = [knots(radii, count[0]), knots(heights, count[1])];
        let place = |&r: &f64| knots[1].iter().map(move |&z| (r, z));
        let places = knots[0].iter().flat_map(place);
        let start: Vec<f64> = places.map(|(r, z)| fine.angle(r, z)).collect();
        let [radii, heights] = &knots;
        let make = |angles: Vec<f64>| Graph::new(radii.clone(), heights.clone(), angles).rounded();
        let angles = field.downhill(&circles, start, &make);
        make(angles.into_iter().map(|a| a * opening).collect())
    });
    graphs.collect()
}

/// Knots as far apart as each other from one end of a body to the other, given the middles of cells; one is in the middle.
fn knots(values: &[f64], count: usize) -> Vec<f64> {
    let (first, last) = (values[0], values[values.len() - 1]);
    // A crease within the body is of no use, nor is one in its faces.
    let cell = (last - first) / (values.len() as f64 - 1.0).max(1.0);
    let (first, last) = (first - cell, last + cell);
    match count {
        1 => vec![0.5 * (first + last)],
        _ => (0..count)
            .map(|i| first + (last - first) * i as f64 / (count - 1) as f64)
            .collect(),
    }
}

/// Middles of square cells of the half plane of distance and height.
fn grid(points: &[DVec3], parts: usize) -> Option<[Vec<f64>; 2]> {
    let flat = points.iter().map(|p| [p.x.hypot(p.y), p.z]);
    let low = flat
        .clone()
        .reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1])])?;
    let high = flat.reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])])?;
    let size = [0, 1].map(|k| high[k] - low[k]);
    let longest = size[0].max(size[1]);
    let middles = |k: usize| {
        let count = (parts as f64 * size[k] / longest).ceil().max(1.0);
        let middle = |i: usize| low[k] + (i as f64 + 0.5) * size[k] / count;
        (0..count as usize).map(middle).collect::<Vec<f64>>()
    };
    (longest > 0.0).then(|| [middles(0), middles(1)])
}

/// Costs of angles at the points of a grid, and the angle of each.
struct Field {
    /// Number of distances and of heights.
    size: [usize; 2],
    /// For each distance those of all heights: the cost of each angle within the opening.
    costs: Vec<Vec<f64>>,
    /// Parts of the opening.
    parts: usize,
    /// Angles, in parts of the opening; from 0 to as many openings.
    labels: Vec<usize>,
    /// Cost of a step between neighbours, of one opening, along distances and along heights.
    steps: [f64; 2],
}

impl Field {
    fn new(circles: &Circles, opening: f64, parts: usize) -> Self {
        let size = [circles.radii.len(), circles.heights.len()];
        let gap = |list: &[f64]| match list {
            [a, b, ..] => b - a,
            _ => 1.0,
        };
        let (across, up) = (gap(&circles.radii), gap(&circles.heights));
        let mut costs = Vec::with_capacity(size[0] * size[1]);
        for i in 0..size[0] {
            let arc = circles.radii[i] * opening;
            let area = across * up / (arc * arc);
            for j in 0..size[1] {
                let cost = |k: usize| {
                    let at = (k as f64 + 0.5) / parts as f64;
                    let Some((near, inside)) = circles.gap([i, j], at) else {
                        return 0.0;
                    };
                    let narrow = 0.5 / near.max(0.5 / parts as f64);
                    area * match inside {
                        true => narrow * narrow - 1.0,
                        false => narrow - 1.0,
                    }
                };
                costs.push((0..parts).map(cost).collect());
            }
        }
        Self {
            size,
            costs,
            parts,
            labels: Vec::new(),
            steps: [up / across, across / up],
        }
    }

    fn at(&self, [i, j]: [usize; 2]) -> usize {
        i * self.size[1] + j
    }

    /// The points of row or column `k`: along distances (0) or heights (1).
    fn line(&self, along: usize, k: usize) -> Vec<[usize; 2]> {
        (0..self.size[along])
            .map(|l| if along == 0 { [l, k] } else { [k, l] })
            .collect()
    }

    fn solve(&mut self) {
        const NONE: usize = usize::MAX;
        self.labels = vec![NONE; self.costs.len()];
        for pass in 0..self.parts {
            let along = pass % 2;
            let mut changed = false;
            for k in 0..self.size[1 - along] {
                let line = self.line(along, k);
                let found = self.best(along, &line);
                for (at, label) in line.into_iter().zip(found) {
                    let slot = self.at(at);
                    changed |= self.labels[slot] != label;
                    self.labels[slot] = label;
                }
            }
            if !changed {
                break;
            }
        }
    }

    /// The best angles of a line, all others given as far as they are known.
    fn best(&self, along: usize, line: &[[usize; 2]]) -> Vec<usize> {
        let count = self.parts * self.parts;
        let unit = 1.0 / self.parts as f64;
        let pull = self.steps[1 - along] * unit * unit;
        let is_first = self.labels.iter().all(|&l| l == usize::MAX);
        let own = |at: [usize; 2]| -> Vec<f64> {
            let costs = &self.costs[self.at(at)];
            let k = at[1 - along];
            let beside = [
                k.checked_sub(1),
                Some(k + 1).filter(|&k| k < self.size[1 - along]),
            ];
            let beside: Vec<usize> = (beside.into_iter().flatten())
                .map(|k| {
                    let mut other = at;
                    other[1 - along] = k;
                    self.labels[self.at(other)]
                })
                .filter(|&l| l != usize::MAX)
                .collect();
            (0..count)
                .map(|l| {
                    let apart = beside.iter().map(|&b| (b.abs_diff(l) as f64).powi(2));
                    costs[l % self.parts] + pull * apart.sum::<f64>()
                })
                .collect()
        };
        let push = self.steps[along] * unit * unit;
        let mut sums = vec![own(line[0])];
        if is_first {
            let middle = self.parts / 2 * self.parts..(self.parts / 2 + 1) * self.parts;
            (0..count)
                .filter(|l| !middle.contains(l))
                .for_each(|l| sums[0][l] = f64::INFINITY);
        }
        let mut from: Vec<Vec<u32>> = Vec::new();
        for &at in &line[1..] {
            let (mut sum, origin) = spread(&sums[sums.len() - 1], push);
            for (s, o) in sum.iter_mut().zip(own(at)) {
                *s += o;
            }
            sums.push(sum);
            from.push(origin);
        }
        let last = &sums[sums.len() - 1];
        let mut label = (0..count)
            .min_by(|&a, &b| last[a].total_cmp(&last[b]))
            .unwrap_or(0);
        let mut found = vec![label];
        for origin in from.iter().rev() {
            label = origin[label] as usize;
            found.push(label);
        }
        found.reverse();
        found
    }

    /// What a graph costs, whose angles are in openings.
    fn cost(&self, circles: &Circles, graph: &Graph) -> f64 {
        let mut sum = 0.0;
        let mut last: Vec<f64> = Vec::new();
        for (i, &radius) in circles.radii.iter().enumerate() {
            let now: Vec<f64> = (circles.heights.iter())
                .map(|&z| graph.angle(radius, z))
                .collect();
            for (j, &a) in now.iter().enumerate() {
                // Between the middles of two parts.
                let at = (a - a.floor()) * self.parts as f64 - 0.5;
                let part = at.floor();
                let costs = &self.costs[self.at([i, j])];
                let of = |k: f64| costs[(k as isize).rem_euclid(self.parts as isize) as usize];
                sum += of(part) + (of(part + 1.0) - of(part)) * (at - part);
                if let Some(b) = last.get(j) {
                    sum += self.steps[0] * (a - b).powi(2);
                }
                if j > 0 {
                    sum += self.steps[1] * (a - now[j - 1]).powi(2);
                }
            }
            last = now;
        }
        sum
    }

    /// Moves angles at knots, in openings, as long as the graph made of them costs less, by less and less.
    fn downhill(
        &self,
        circles: &Circles,
        mut angles: Vec<f64>,
        make: &impl Fn(Vec<f64>) -> Graph,
    ) -> Vec<f64> {
        let mut least = self.cost(circles, &make(angles.clone()));
        let mut step = 0.5;
        while step > 0.5 / self.parts as f64 {
            let before = least;
            for k in 0..angles.len() {
                for by in [step, -step] {
                    let was = angles[k];
                    angles[k] += by;
                    let cost = self.cost(circles, &make(angles.clone()));
                    if cost < least {
                        least = cost;
                        break;
                    }
                    angles[k] = was;
                }
            }
            if least == before {
                step *= 0.5;
            }
        }
        angles
    }

    /// The angles in openings, moved within their parts so that the graph is as even as they allow.
    fn smooth(&self) -> Vec<f64> {
        let unit = 1.0 / self.parts as f64;
        let middle = |label: usize| (label as f64 + 0.5) * unit - (self.parts / 2) as f64;
        let given: Vec<f64> = self.labels.iter().map(|&l| middle(l)).collect();
        let mut now = given.clone();
        for _ in 0..2 * self.parts {
            for i in 0..self.size[0] {
                for j in 0..self.size[1] {
                    let mut sum = (0.0, 0.0);
                    let mut add = |at: [usize; 2], weight: f64| {
                        sum.0 += weight * now[self.at(at)];
                        sum.1 += weight;
                    };
                    if i > 0 {
                        add([i - 1, j], self.steps[0]);
                    }
                    if i + 1 < self.size[0] {
                        add([i + 1, j], self.steps[0]);
                    }
                    if j > 0 {
                        add([i, j - 1], self.steps[1]);
                    }
                    if j + 1 < self.size[1] {
                        add([i, j + 1], self.steps[1]);
                    }
                    let at = self.at([i, j]);
                    if sum.1 > 0.0 {
                        let reach = 0.5 * unit;
                        now[at] = (sum.0 / sum.1).clamp(given[at] - reach, given[at] + reach);
                    }
                }
            }
        }
        now
    }
}

/// For each place the least of all values and `weight` times the square of the distance to their place, and where that is
/// (P. Felzenszwalb, D. Huttenlocher, "Distance transforms of sampled functions", 2012). Linear.
fn spread(values: &[f64], weight: f64) -> (Vec<f64>, Vec<u32>) {
    let mut lowest: Vec<usize> = Vec::new();
    let mut starts: Vec<f64> = Vec::new();
    for q in (0..values.len()).filter(|&q| values[q].is_finite()) {
        let start = loop {
            let Some(&p) = lowest.last() else {
                break f64::NEG_INFINITY;
            };
            let (x, y) = (p as f64, q as f64);
            let meet =
                ((values[q] / weight + y * y) - (values[p] / weight + x * x)) / (2.0 * (y - x));
            if meet > starts[starts.len() - 1] {
                break meet;
            }
            lowest.pop();
            starts.pop();
        };
        lowest.push(q);
        starts.push(start);
    }
    let mut k = 0;
    let of = |l: usize| {
        while starts.get(k + 1).is_some_and(|s| *s < l as f64) {
            k += 1;
        }
        let p = lowest[k];
        (
            values[p] + weight * (p.abs_diff(l) as f64).powi(2),
            p as u32,
        )
    };
    (0..values.len()).map(of).unzip()
}
