//! Cook's form: Fresnel's dielectric reflectance, for `η = (1 + √F0)/(1 − √F0)` of each channel.

use super::{Fresnel, Incidence, dielectric};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::parameter::F0;

/// Cook's way to a coloured Fresnel term: the exact dielectric reflectance, with the `η = (1 + √F0)/(1 − √F0)` that
/// belongs to the reflectance `F0` of the channel at normal incidence.
///
/// Cook and Torrance, "A Reflectance Model for Computer Graphics", SIGGRAPH 1981 (TOG 1(1), 1982), section 4: for
/// metals, too, the extinction is taken to be 0.
///
/// Domain: `F0 ∈ [0, 1]`, both ends included: `η`, which is infinite at 1, is never formed. Error against `f64` of the
/// same inputs: 24u = 1.5e-6, twelve roundings in the amplitude, which its square doubles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CookFresnel<R = f32> {
    f0: Rgb<R>,
}

carry!([] CookFresnel<f32> => CookFresnel<S> { f0 });

impl<R: Real> CookFresnel<R> {
    /// The interface that reflects `f0` at normal incidence.
    #[inline(always)]
    pub fn new(f0: Rgb<R>) -> Self {
        Self { f0 }
    }

    /// The grey one.
    #[inline(always)]
    pub fn grey(f0: F0<R>) -> Self {
        Self::new(Rgb::splat(f0.0))
    }

    /// The same interface in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> CookFresnel<S> {
        CookFresnel::new(self.f0.map(f))
    }
}

impl<R: Real> Fresnel<R> for CookFresnel<R> {
    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        self.f0.map(
            #[inline(always)]
            |f0| {
                // η = n/d with n = 1 + √F0, d = 1 − √F0 = (1 − F0)/n, n² − d² = 4 √F0.
                let root = f0.sqrt();
                let n = root.plus(1.0);
                let d = (f0.lift(1.0) - f0) / n;
                dielectric::reflectance(n, d, root.times(4.0), incidence)
            },
        )
    }
}
