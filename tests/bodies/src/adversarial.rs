//! Sound bodies of the kinds that make meshing programs slow: work that is quadratic somewhere shows on them.

/// Points and triangles, outward.
pub type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Makes a shape of about so many points or triangles.
pub type Maker = fn(usize) -> Mesh;

/// Every shape with its name and what it is.
pub const SHAPES: [(&str, &str, Maker); 4] = [
    (
        "coplanar",
        "a flat box, its top and bottom in N triangles in all",
        coplanar,
    ),
    ("shells", "N small octahedra apart from each other", shells),
    (
        "circle",
        "a disc: N points on one circle, and above them N more",
        circle,
    ),
    (
        "spindle",
        "a double cone: two vertices of N triangles each",
        spindle,
    ),
];

/// A box of 1 x 1 x 1/16 with top and bottom divided into squares, about `n` triangles in all.
pub fn coplanar(n: usize) -> Mesh {
    let k = ((n as f64 / 4.0).sqrt().round() as usize).max(1);
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    let id = |level: usize, i: usize, j: usize| ((level * (k + 1) + i) * (k + 1) + j) as u32;
    for level in 0..2 {
        for i in 0..=k {
            for j in 0..=k {
                // Exact for powers of two, and symmetric for all others.
                let [x, y] = [i, j].map(|a| (2 * a) as f64 / k as f64 - 1.0);
                points.push([x, y, level as f64 / 16.0]);
            }
        }
    }
    let mut quad = |[a, b, c, d]: [u32; 4]| triangles.extend([[a, b, c], [a, c, d]]);
    for i in 0..k {
        for j in 0..k {
            quad([
                id(1, i, j),
                id(1, i + 1, j),
                id(1, i + 1, j + 1),
                id(1, i, j + 1),
            ]);
            quad([
                id(0, i, j),
                id(0, i, j + 1),
                id(0, i + 1, j + 1),
                id(0, i + 1, j),
            ]);
        }
    }
    for i in 0..k {
        quad([id(0, i, 0), id(0, i + 1, 0), id(1, i + 1, 0), id(1, i, 0)]);
        quad([id(0, i + 1, k), id(0, i, k), id(1, i, k), id(1, i + 1, k)]);
        quad([id(0, 0, i + 1), id(0, 0, i), id(1, 0, i), id(1, 0, i + 1)]);
        quad([id(0, k, i), id(0, k, i + 1), id(1, k, i + 1), id(1, k, i)]);
    }
    (points, triangles)
}

/// Octahedra on a cubic grid, as many as fit into a cube of at least `n`.
pub fn shells(n: usize) -> Mesh {
    let k = (n as f64).cbrt().round().max(1.0) as usize;
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for i in 0..k * k * k {
        let first = points.len() as u32;
        let centre = [i % k, i / k % k, i / (k * k)].map(|a| (2 * a) as f64 - (k - 1) as f64);
        for axis in 0..3 {
            for step in [0.5, -0.5] {
                let mut corner = centre;
                corner[axis] += step;
                points.push(corner);
            }
        }
        for octant in 0..8_u32 {
            let [x, y, z] = [0, 1, 2].map(|axis| first + 2 * axis + (octant >> axis & 1));
            let inside_out = octant.count_ones() % 2 == 1;
            triangles.push(if inside_out { [x, z, y] } else { [x, y, z] });
        }
    }
    (points, triangles)
}

/// The point of a regular polygon of `n` corners.
fn on_circle(i: usize, n: usize, z: f64) -> [f64; 3] {
    let (sin, cos) = (std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
    [cos, sin, z]
}

/// A disc between two regular polygons, each triangulated as a zigzag: long thin triangles.
pub fn circle(n: usize) -> Mesh {
    let n = n.max(3);
    let points = [0.0, 0.25]
        .into_iter()
        .flat_map(|z| (0..n).map(move |i| on_circle(i, n, z)));
    let mut triangles = Vec::new();
    let top = |i: usize| (n + i % n) as u32;
    let bottom = |i: usize| (i % n) as u32;
    for i in 0..n {
        triangles.push([bottom(i), bottom(i + 1), top(i + 1)]);
        triangles.push([bottom(i), top(i + 1), top(i)]);
    }
    let (mut low, mut high) = (0, n - 1);
    while low + 1 < high {
        for [a, b, c] in [[low, low + 1, high], [low + 1, high - 1, high]] {
            if b < c && a < b && b != c && a != c && c < n {
                triangles.push([top(a), top(b), top(c)]);
                triangles.push([bottom(a), bottom(c), bottom(b)]);
            }
        }
        low += 1;
        high -= 1;
    }
    (points.collect(), triangles)
}

/// Two cones on one regular polygon.
pub fn spindle(n: usize) -> Mesh {
    let n = n.max(3);
    let mut points: Vec<_> = (0..n).map(|i| on_circle(i, n, 0.0)).collect();
    points.extend([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]);
    let mut triangles = Vec::new();
    for i in 0..n {
        let [a, b] = [i, (i + 1) % n].map(|v| v as u32);
        triangles.push([a, b, n as u32]);
        triangles.push([b, a, n as u32 + 1]);
    }
    (points, triangles)
}

/// The mesh as a file in Object File Format, every coordinate to its last digit.
pub fn off((points, triangles): &Mesh) -> String {
    use std::fmt::Write;
    let mut text = format!("OFF\n{} {} 0\n", points.len(), triangles.len());
    for [x, y, z] in points {
        writeln!(text, "{x:?} {y:?} {z:?}").expect("a string takes all");
    }
    for [a, b, c] in triangles {
        writeln!(text, "3 {a} {b} {c}").expect("a string takes all");
    }
    text
}
