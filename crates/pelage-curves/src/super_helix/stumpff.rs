//! The functions that the exponential of a rotation and its integrals are made of.
//!
//! Source: K. Stumpff's functions c_k(u) = Σ (-u)^n / (2n + k)!, which are cos x and
//! sin x / x for k = 0 and 1 with u = x², and obey c_k = 1/k! - u c_(k+2). A derivative is
//! again made of them: 2 c_k' = k c_(k+2) - c_(k+1). So five of them give the turn of an
//! element, its shift and the derivatives of both, even and smooth in the angle: there is
//! no case for a straight element.

/// c_0 to c_5 at one u = x² that is not negative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stumpff(pub [f64; 6]);

/// Below this u the series is taken: it needs no sine, and the recursion upwards, which
/// the closed form has to take, would lose digits to differences.
const SMALL: f64 = 4.0;

/// Terms of the series: the next is below rounding at [`SMALL`].
const TERMS: usize = 11;

impl Stumpff {
    /// At the square of an angle.
    #[inline(always)]
    pub fn at(square: f64) -> Self {
        match square < SMALL {
            true => Self::near(square),
            false => Self::far(square),
        }
    }

    /// From c_4 and c_5 down, which takes no difference of like numbers.
    #[inline(always)]
    fn near(u: f64) -> Self {
        let (mut c4, mut c5) = (0.0, 0.0);
        for [four, five] in COEFFICIENTS.iter().rev() {
            c4 = four - u * c4;
            c5 = five - u * c5;
        }
        let (c2, c3) = (0.5 - u * c4, 1.0 / 6.0 - u * c5);
        Self([1.0 - u * c2, 1.0 - u * c3, c2, c3, c4, c5])
    }

    fn far(u: f64) -> Self {
        let x = u.sqrt();
        let (sine, cosine) = (libm::sin(x), libm::cos(x));
        let c1 = sine / x;
        let (c2, c3) = ((1.0 - cosine) / u, (1.0 - c1) / u);
        Self([cosine, c1, c2, c3, (0.5 - c2) / u, (1.0 / 6.0 - c3) / u])
    }

    /// Twice the derivative of c_k, k of 1 to 3, with respect to u.
    #[inline(always)]
    pub fn slope(&self, k: usize) -> f64 {
        k as f64 * self.0[k + 2] - self.0[k + 1]
    }
}

/// 1 / (2n + 4)! and 1 / (2n + 5)!.
const COEFFICIENTS: [[f64; 2]; TERMS] = {
    let mut table = [[0.0; 2]; TERMS];
    let (mut n, mut factorial) = (0, 6.0);
    while n < TERMS {
        factorial *= (2 * n + 4) as f64;
        table[n][0] = 1.0 / factorial;
        factorial *= (2 * n + 5) as f64;
        table[n][1] = 1.0 / factorial;
        n += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_closed_form_are_one_function() {
        for i in 0..200 {
            let u = 3.0 + 0.005 * i as f64;
            let (near, far) = (Stumpff::near(u).0, Stumpff::far(u).0);
            for k in 0..6 {
                assert!((near[k] - far[k]).abs() < 1e-15, "c_{k}({u})");
            }
        }
    }

    #[test]
    fn at_any_angle_the_recursion_and_the_circle_hold() {
        for i in 0..2000 {
            let x = 1e-9 * libm::exp(0.02 * i as f64);
            let (u, Stumpff(c)) = (x * x, Stumpff::at(x * x));
            for (k, factorial) in [1.0, 1.0, 2.0, 6.0].into_iter().enumerate() {
                let back = 1.0 / factorial - u * c[k + 2];
                assert!((back - c[k]).abs() < 1e-15, "c_{k} at {x}");
            }
            let circle = c[0] * c[0] + u * c[1] * c[1];
            assert!((circle - 1.0).abs() < 1e-14, "{circle} at {x}");
        }
    }
}
