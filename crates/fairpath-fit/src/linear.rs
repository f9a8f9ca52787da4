//! Small dense linear algebra: symmetric positive definite systems of a few unknowns.

/// Cholesky factor of the leading `n × n` block of a symmetric matrix, in place in the lower triangle; false if a pivot is not
/// above `floor` times its diagonal entry. The diagonal has the reciprocals of the factor's, which is what solving needs.
#[inline(always)]
pub(crate) fn cholesky<const N: usize>(a: &mut [[f64; N]; N], n: usize, floor: f64) -> bool {
    for j in 0..n {
        let mut d = a[j][j];
        let limit = floor * d;
        for k in 0..j {
            d -= a[j][k] * a[j][k];
        }
        // Written so that a NaN fails too.
        if !(d > limit && d > 0.0) {
            return false;
        }
        let inverse = 1.0 / d.sqrt();
        a[j][j] = inverse;
        for i in j + 1..n {
            let mut v = a[i][j];
            for k in 0..j {
                v -= a[i][k] * a[j][k];
            }
            a[i][j] = v * inverse;
        }
    }
    true
}

/// Solves with the lower triangle of a factor from [`cholesky`], in place: the inner product of two such solutions is that of the
/// inverse matrix.
#[inline(always)]
pub(crate) fn solve_lower<const N: usize>(l: &[[f64; N]; N], n: usize, b: &mut [f64; N]) {
    for i in 0..n {
        let mut v = b[i];
        for k in 0..i {
            v -= l[i][k] * b[k];
        }
        b[i] = v * l[i][i];
    }
}

/// Solves with a factor from [`cholesky`], in place.
#[inline(always)]
pub(crate) fn solve<const N: usize>(l: &[[f64; N]; N], n: usize, b: &mut [f64; N]) {
    solve_lower(l, n, b);
    solve_upper(l, n, b);
}

/// What remains to be solved after [`solve_lower`], in place.
#[inline(always)]
pub(crate) fn solve_upper<const N: usize>(l: &[[f64; N]; N], n: usize, b: &mut [f64; N]) {
    for i in (0..n).rev() {
        let mut v = b[i];
        for k in i + 1..n {
            v -= l[k][i] * b[k];
        }
        b[i] = v * l[i][i];
    }
}
