//! A table: `D = Σ pᵢ hat(θ/step − i)/∫`, any distribution of the angle.

use super::Distribution;
use crate::carry::carry;
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::FRAC_PI_2;

/// Any isotropic distribution, from a table: linear between values at equal steps of the angle of `h`, from the normal
/// to the horizon, and normalised.
///
/// Ashikhmin, Premože and Shirley, "A Microfacet-based BRDF Generator", SIGGRAPH 2000: the distribution `p(h)` may be
/// whatever the surface wants, measured or drawn. The integral of the interpolant is known in closed form,
/// `π Σ pᵢ wᵢ` with `wᵢ = sin²s/s · sin 2θᵢ` for the step `s`, and `1/2 − sin 2s/4s` at both ends.
///
/// Domain: at least two values, none negative, not all 0. An evaluation adds up all `N` hats: nothing is indexed by a
/// value. For Smith's `Λ` see [`SmithTable`](super::SmithTable).
///
/// ```
/// use lobe::Vec3;
/// use lobe::distribution::{Distribution, Tabulated};
/// // A constant has the value 1/π.
/// let flat = Tabulated::new([3.0_f32; 5]);
/// assert!((flat.d(Vec3::new(0.6, 0.0, 0.8)) - core::f32::consts::FRAC_1_PI).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tabulated<R = f32, const N: usize = 91> {
    /// Normalised.
    values: [R; N],
}

carry!([const N: usize] Tabulated<f32, N> => Tabulated<S, N> { values });

impl<R: Real, const N: usize> Tabulated<R, N> {
    /// The distribution in proportion to these values, at the angles `i · 90°/(N − 1)`.
    #[inline(always)]
    pub fn new(values: [R; N]) -> Self {
        const { assert!(N >= 2, "two values are needed, at the normal and at the horizon") };
        let step = FRAC_PI_2 / (N - 1) as f64;
        let (sin, end) = (libm::sin(step), 0.5 - libm::sin(2.0 * step) / (4.0 * step));
        let integral = values.iter().enumerate().fold(None, |sum: Option<R>, (i, &p)| {
            let inner = sin * sin / step * libm::sin(2.0 * step * i as f64);
            let term = p.times(core::f64::consts::PI * if i == 0 || i == N - 1 { end } else { inner });
            Some(sum.map_or(
                term,
                #[inline(always)]
                |sum| sum + term,
            ))
        });
        Self {
            values: values.map(
                #[inline(always)]
                |p| {
                    integral.map_or(
                        p,
                        #[inline(always)]
                        |integral| p / integral,
                    )
                },
            ),
        }
    }

    /// The normalised values.
    #[inline(always)]
    pub fn values(&self) -> &[R; N] {
        &self.values
    }

    /// The same distribution in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Tabulated<S, N> {
        Tabulated::new(self.values.map(f))
    }
}

impl<R: Real, const N: usize> Distribution<R> for Tabulated<R, N> {
    #[inline(always)]
    fn d(&self, h: Vec3<R>) -> R {
        let angle = (h.x.squared() + h.y.squared()).sqrt().atan2(h.z);
        interpolate(angle.times((N - 1) as f64 / FRAC_PI_2), &self.values)
    }
    #[inline(always)]
    fn pieces(&self) -> usize {
        N - 1
    }
}

/// `Σ vᵢ max(0, 1 − |x − i|)`.
#[inline(always)]
fn interpolate<R: Real, const N: usize>(x: R, values: &[R; N]) -> R {
    let (zero, one) = (x.lift(0.0), x.lift(1.0));
    let mut sum = zero;
    for (i, &value) in values.iter().enumerate() {
        sum = sum + value * (one - x.plus(-(i as f64)).abs()).max(zero);
    }
    sum
}
