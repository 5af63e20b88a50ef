//! The albedo of GGX at run time: from a table, or from a polynomial.

use crate::Corner;
use crate::baked::{LOSS, LOSS_FIT, MEANS, WEIGHT};
use lobe::{Alpha, Carry, Real};

/// The albedo of a white GGX with Smith's correlated masking, as something that is quick to ask.
///
/// `E(μ)` is the part of the light from the cosine `μ = n·v` that is reflected once; what is missing is reflected more than
/// once between the facets, and lost in the model.
pub trait GgxAlbedo<R: Real> {
    /// For facets of this width, from 1e-4 to 1.
    fn new(alpha: Alpha<R>) -> Self;

    /// `1 − E(μ)`, for `μ` from 0 to 1.
    fn loss(&self, mu: R) -> R;

    /// `2 ∫ μ (1 − E(μ)) dμ`: the mean of [`loss`](Self::loss) itself, not of the exact one, so that a lobe in proportion to
    /// the loss holds exactly as much light as is to be given back.
    fn mean_loss(&self) -> R;
}

/// [`GgxAlbedo`] from a table of 32 × 32, interpolated linearly: the row of the width when it is made, between columns at
/// each call.
///
/// `E` is within 1.5e-3 of the integral for `α` from 1e-4 to 1 and all cosines (test `the_table_and_the_fit_are_near`). The
/// table is `src/baked.rs`; `cargo run --release -p lobe-energy --example bake` computes it. Nothing is indexed by a value: a
/// sum goes over all nodes of a row, of which two count. So it works in lanes; [`GgxFit`] is several times faster.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GgxTable<R = f32> {
    alpha: R,
    loss: [R; NODES],
    through: [R; NODES],
    mean: R,
}

/// [`GgxAlbedo`] from [`Corner::x`] times a polynomial of degree 10 in it, whose coefficients are polynomials of degree
/// 9 in `√α`.
///
/// `E` is within 5e-4 of the integral for `α` from 1e-4 to 1 and all cosines (test `the_table_and_the_fit_are_near`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GgxFit<R = f32> {
    alpha: R,
    coefficients: [R; DEGREES],
    mean: R,
}

const NODES: usize = LOSS.len();
const DEGREES: usize = LOSS_FIT.len();

/// `max(0, 1 − |x − i|)`, what node `i` has of the linear interpolation at `x`: the lesser distance to its neighbours,
/// which next to the first node is `x` to all digits.
#[inline(always)]
fn hat<R: Real>(x: R, i: usize) -> R {
    let i = i as f64;
    x.plus(1.0 - i).min(x.lift(1.0 + i) - x).max(x.lift(0.0))
}

/// The row of a table at a place from 0 to 1, of `value` of each of its numbers.
#[inline(always)]
fn row<R: Real>(table: &[[f64; NODES]; NODES], at: R, value: impl Fn(f64) -> f64) -> [R; NODES] {
    let x = at.times((NODES - 1) as f64);
    let mut sum = [x.lift(0.0); NODES];
    for (i, row) in table.iter().enumerate() {
        let part = hat(x, i);
        for (sum, node) in sum.iter_mut().zip(row) {
            *sum = *sum + part.times(value(*node));
        }
    }
    sum
}

/// The value of a row at a place from 0 to 1.
#[inline(always)]
fn between<R: Real>(row: &[R; NODES], at: R) -> R {
    let x = at.times((NODES - 1) as f64);
    let mut sum = x.lift(0.0);
    for (i, value) in row.iter().enumerate() {
        sum = sum + hat(x, i) * *value;
    }
    sum
}

/// A sum of Chebyshev polynomials at `x` from 0 to 1 (Clenshaw).
#[inline(always)]
fn chebyshev<R: Real, const N: usize>(coefficients: &[R; N], x: R) -> R {
    let twice = x.times(4.0).plus(-2.0);
    let zero = x.lift(0.0);
    let (mut last, mut before) = (zero, zero);
    for c in coefficients.iter().rev() {
        (last, before) = (twice * last - before + *c, last);
    }
    // The first polynomial after the constant has half of that argument.
    last - twice.times(0.5) * before
}

/// The constants of a row of a table, in the shape of `witness`.
#[inline(always)]
fn lifted<R: Real, const N: usize>(row: &[f64; N], witness: R) -> [R; N] {
    row.map(
        #[inline(always)]
        |c| witness.lift(c),
    )
}

/// Where a width is in the tables: `√α` from 0.01 to 1 as 0 to 1.
#[inline(always)]
fn place<R: Real>(alpha: R) -> R {
    alpha.sqrt().plus(-0.01).times(1.0 / 0.99)
}

/// The mean loss from its polynomial in units of `α² (1 − ln α)`.
#[inline(always)]
fn mean<R: Real>(polynomial: &[f64; MEANS[0].len()], alpha: R) -> R {
    let units = alpha.squared() * (alpha.lift(1.0) - alpha.ln());
    chebyshev(&lifted(polynomial, alpha), place(alpha)) * units
}

impl<R: Real> GgxTable<R> {
    /// The mean of `(1 − v·h)⁵` over what is reflected to `μ`: of Schlick's term, `F0 + (1 − F0) w` is the mean.
    ///
    /// So `E` of any such term is `(1 − loss) (F0 (1 − w) + F90 w)`, what engines call the scale and the bias of the split sum. It
    /// is within 7e-3 of the integral.
    #[inline(always)]
    pub fn fresnel_weight(&self, mu: R) -> R {
        mu.lift(1.0) - self.through_weight(mu)
    }

    /// `1 − w` of [`fresnel_weight`](Self::fresnel_weight), to all digits where it is small: at grazing light.
    #[inline(always)]
    pub fn through_weight(&self, mu: R) -> R {
        between(&self.through, mu.sqrt())
    }
}

impl<R: Real> GgxAlbedo<R> for GgxTable<R> {
    #[inline]
    fn new(alpha: Alpha<R>) -> Self {
        let place = place(alpha.0);
        let loss = row(
            &LOSS,
            place,
            #[inline(always)]
            |loss| loss,
        );
        let through = row(
            &WEIGHT,
            place,
            #[inline(always)]
            |weight| 1.0 - weight,
        );
        Self { alpha: alpha.0, loss, through, mean: mean(&MEANS[0], alpha.0) }
    }

    #[inline(always)]
    fn loss(&self, mu: R) -> R {
        let corner = Corner::new(self.alpha, mu);
        between(&self.loss, corner.x) * corner.scale
    }

    #[inline(always)]
    fn mean_loss(&self) -> R {
        self.mean
    }
}

impl<R: Real> GgxAlbedo<R> for GgxFit<R> {
    #[inline]
    fn new(alpha: Alpha<R>) -> Self {
        let place = place(alpha.0);
        let coefficients = LOSS_FIT.map(
            #[inline(always)]
            |row| chebyshev(&lifted(&row, place), place),
        );
        Self { alpha: alpha.0, coefficients, mean: mean(&MEANS[1], alpha.0) }
    }

    #[inline(always)]
    fn loss(&self, mu: R) -> R {
        let corner = Corner::new(self.alpha, mu);
        // With the factor `x` nothing is lost at the horizon, and near it the loss keeps its digits. There the
        // polynomial ends a little below 0 for some widths, and without the bound a lobe of black facets would be
        // negative.
        chebyshev(&self.coefficients, corner.x).max(mu.lift(0.0)) * corner.x * corner.scale
    }

    #[inline(always)]
    fn mean_loss(&self) -> R {
        self.mean
    }
}

impl Carry for GgxTable<f32> {
    type In<S: Real> = GgxTable<S>;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> GgxTable<S> {
        GgxTable {
            alpha: self.alpha.carry(lift),
            loss: self.loss.carry(lift),
            through: self.through.carry(lift),
            mean: self.mean.carry(lift),
        }
    }
}

impl Carry for GgxFit<f32> {
    type In<S: Real> = GgxFit<S>;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> GgxFit<S> {
        GgxFit {
            alpha: self.alpha.carry(lift),
            coefficients: self.coefficients.carry(lift),
            mean: self.mean.carry(lift),
        }
    }
}
