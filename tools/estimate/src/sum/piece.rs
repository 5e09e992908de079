//! Pieces of the section, as they are halved.

use glam::DVec2;

/// A piece of the section, by radius and height.
#[derive(Clone, Copy, Debug)]
pub enum Piece {
    /// A triangle.
    Triangle([DVec2; 3]),
    /// A narrow quadrilateral or triangle, from its first side to the opposite one, which may be a point. Halves of
    /// its long sides, one at a time, would be ever narrower triangles.
    Band([DVec2; 4]),
}

impl Piece {
    /// A point in the middle.
    pub fn middle(&self) -> DVec2 {
        match self {
            Self::Triangle(t) => centre(t),
            Self::Band([a, b, c, d]) => {
                let halves = [[*a, *b, *c], [*a, *c, *d]];
                let [first, second] = halves.map(|t| doubled(&t));
                let all = first + second;
                let part = if all > 0.0 { first / all } else { 0.5 };
                centre(&halves[0]) * part + centre(&halves[1]) * (1.0 - part)
            }
        }
    }

    /// Its area.
    pub fn area(&self) -> f64 {
        match self {
            Self::Triangle(t) => 0.5 * doubled(t),
            Self::Band([a, b, c, d]) => 0.5 * (doubled(&[*a, *b, *c]) + doubled(&[*a, *c, *d])),
        }
    }

    /// Its corners.
    pub fn corners(&self) -> &[DVec2] {
        match self {
            Self::Triangle(t) => t,
            Self::Band(q) => q,
        }
    }

    /// Square of the largest distance between two of its points.
    pub fn longest(&self) -> f64 {
        match self {
            Self::Triangle(t) => sides(t).into_iter().fold(0.0, f64::max),
            Self::Band([a, b, c, d]) => {
                let pairs = [(a, b), (b, c), (c, d), (d, a), (a, c), (b, d)];
                let squares = pairs.map(|(p, q)| p.distance_squared(*q));
                squares.into_iter().fold(0.0, f64::max)
            }
        }
    }

    /// Two pieces that make it.
    pub fn halves(&self) -> [Self; 2] {
        match *self {
            Self::Triangle(t) => {
                let sides = sides(&t);
                let longest = (0..3).max_by(|&i, &j| sides[i].total_cmp(&sides[j]));
                let longest = longest.unwrap_or(0);
                let (next, last) = ((longest + 1) % 3, (longest + 2) % 3);
                let (shortest, second) = match sides[next] < sides[last] {
                    true => (next, last),
                    false => (last, next),
                };
                if is_narrow(sides[second], sides[shortest]) {
                    let tip = t[(shortest + 2) % 3];
                    return halves_of_band([t[shortest], t[(shortest + 1) % 3], tip, tip]);
                }
                let (a, b, c) = (t[longest], t[next], t[last]);
                let half = 0.5 * (a + b);
                [Self::Triangle([a, half, c]), Self::Triangle([half, b, c])]
            }
            Self::Band([a, b, c, d]) => {
                let long = a.distance_squared(d).min(b.distance_squared(c));
                let wide = a.distance_squared(b).max(c.distance_squared(d));
                if is_narrow(long, wide) {
                    return halves_of_band([a, b, c, d]);
                }
                [Self::Triangle([a, b, c]), Self::Triangle([a, c, d])]
            }
        }
    }
}

/// Whether halves across what has these squares of length and width are no wider than long: it is twice as long as wide.
fn is_narrow(length: f64, width: f64) -> bool {
    length > 4.0 * width
}

fn halves_of_band([a, b, c, d]: [DVec2; 4]) -> [Piece; 2] {
    let (left, right) = (0.5 * (a + d), 0.5 * (b + c));
    [
        Piece::Band([a, b, right, left]),
        Piece::Band([left, right, c, d]),
    ]
}

fn centre(t: &[DVec2; 3]) -> DVec2 {
    (t[0] + t[1] + t[2]) / 3.0
}

fn doubled(t: &[DVec2; 3]) -> f64 {
    (t[1] - t[0]).perp_dot(t[2] - t[0]).abs()
}

/// Squares of the lengths of the sides, from each corner to the next.
fn sides(t: &[DVec2; 3]) -> [f64; 3] {
    [(0, 1), (1, 2), (2, 0)].map(|(i, j)| t[i].distance_squared(t[j]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Area and first moments of all pieces up to a size, and how many there are.
    fn sums(piece: Piece, size: f64) -> (f64, DVec2, usize) {
        let (mut area, mut moment, mut count) = (0.0, DVec2::ZERO, 0);
        let mut stack = vec![piece];
        while let Some(piece) = stack.pop() {
            if piece.longest() <= size * size {
                area += piece.area();
                moment += piece.area() * piece.middle();
                count += 1;
            } else {
                stack.extend(piece.halves());
            }
        }
        (area, moment, count)
    }

    #[test]
    fn pieces_make_the_whole() {
        for height in [1.0, 0.2, 0.01] {
            let whole = [
                DVec2::ZERO,
                DVec2::new(1.0, height),
                DVec2::new(0.0, height),
            ];
            let (area, moment, count) = sums(Piece::Triangle(whole), 0.02);
            assert!((area - 0.5 * height).abs() < 1e-12);
            let exact = area * DVec2::new(1.0, 2.0 * height) / 3.0;
            assert!(moment.distance(exact) < 1e-12);
            // Few of them are much smaller than asked for.
            let wanted = area / (0.02 * height.min(0.02));
            assert!((count as f64) < 20.0 * wanted, "{height}: {count} {wanted}");
        }
    }

    #[test]
    fn a_layer_is_cut_across() {
        let thin = [DVec2::ZERO, DVec2::new(1.0, 0.0), DVec2::new(0.0, 1e-3)];
        assert!(sums(Piece::Triangle(thin), 0.01).2 <= 128);
    }
}
