//! Eigenvalues of small symmetric matrices.

/// Eigenvalues, increasing, and unit eigenvectors (`vectors[i]` belongs to `values[i]`).
pub struct Eigen<const N: usize> {
    /// Eigenvalues, increasing.
    pub values: [f64; N],
    /// Unit eigenvectors.
    pub vectors: [[f64; N]; N],
}

/// Eigen decomposition of a symmetric matrix by cyclic Jacobi rotations (Golub and Van Loan, "Matrix
/// Computations", 8.5). Accurate to rounding for the sizes used here.
pub fn symmetric<const N: usize>(mut a: [[f64; N]; N]) -> Eigen<N> {
    let mut v = [[0.0; N]; N];
    for (i, row) in v.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    let mut least = f64::INFINITY;
    loop {
        let mut off = 0.0;
        for (i, row) in a.iter().enumerate() {
            for (j, x) in row.iter().enumerate() {
                if i != j {
                    off += x * x;
                }
            }
        }
        // Convergence is quadratic until only rounding is left, which does not get less. Nothing compares with NaN.
        if off >= least || off.is_nan() || off == 0.0 {
            break;
        }
        least = off;
        for p in 0..N {
            for q in p + 1..N {
                rotate(&mut a, &mut v, p, q);
            }
        }
    }
    let mut order: [usize; N] = std::array::from_fn(|i| i);
    order.sort_by(|&i, &j| a[i][i].total_cmp(&a[j][j]));
    Eigen {
        values: order.map(|i| a[i][i]),
        vectors: order.map(|i| std::array::from_fn(|k| v[k][i])),
    }
}

/// Annihilates `a[p][q]`.
fn rotate<const N: usize>(a: &mut [[f64; N]; N], v: &mut [[f64; N]; N], p: usize, q: usize) {
    if a[p][q] == 0.0 {
        return;
    }
    let tau = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let t = tau.signum() / (tau.abs() + tau.hypot(1.0));
    let c = 1.0 / t.hypot(1.0);
    let s = t * c;
    for row in a.iter_mut() {
        let (x, y) = (row[p], row[q]);
        row[p] = c * x - s * y;
        row[q] = s * x + c * y;
    }
    let (rp, rq) = (a[p], a[q]);
    a[p] = std::array::from_fn(|k| c * rp[k] - s * rq[k]);
    a[q] = std::array::from_fn(|k| s * rp[k] + c * rq[k]);
    // Zero but for rounding.
    (a[p][q], a[q][p]) = (0.0, 0.0);
    for row in v.iter_mut() {
        let (x, y) = (row[p], row[q]);
        row[p] = c * x - s * y;
        row[q] = s * x + c * y;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_and_values_give_the_matrix_back() {
        let mut a = [[0.0; 6]; 6];
        for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
            a[i][j] = 1.0 / (1.0 + (i + j) as f64) + if i == j { 0.1 * i as f64 } else { 0.0 };
        }
        let e = symmetric(a);
        assert!(e.values.windows(2).all(|w| w[0] <= w[1]));
        for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
            let sum: f64 = (0..6)
                .map(|k| e.values[k] * e.vectors[k][i] * e.vectors[k][j])
                .sum();
            assert!((sum - a[i][j]).abs() < 1e-14);
        }
    }
}
