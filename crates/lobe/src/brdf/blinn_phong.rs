//! Blinn-Phong: `f_r = ks N(q) · (n·h)^q`.

use super::{Brdf, Shininess, power};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::PI;
use core::marker::PhantomData;

/// The half-vector lobe in the form of a BRDF: `f_r = ks N(q) · (n·h)^q` sr⁻¹, with `h` halfway between `l` and `v`.
///
/// Blinn, "Models of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977. `N(q)` is a
/// [`Normalization`], chosen by type:
///
/// | `N` | factor | albedo at normal incidence |
/// |---|---|---|
/// | [`NormalIncidence`] (default) | `(q+2)(q+4) / (8π (2^(−q/2) + q))` | exactly `ks` |
/// | [`CommonNormalization`] | `(q+8) / 8π` | up to 1.0752 `ks`: it gains energy |
///
/// Reciprocal to the last bit. Domain: `ks ∈ [0, 1]`, `q ∈ [0, 10⁶]`.
///
/// Error against `f64` of the same inputs, `u = 2⁻²⁴`, `L = |ln(f/f_max)|`: `|δf/f| ≤ u (14 + 14 L)`. It grows with
/// how far down the lobe the value is, and not with `q`. Derivation and test: `docs/numerics.md`.
///
/// Values below 2⁻¹²⁶ of the peak are 0.
///
/// ```
/// use lobe::{BlinnPhong, Brdf, Rgb, Shininess, Vec3};
/// let lobe = BlinnPhong::new(Rgb::splat(0.5_f32), Shininess(50.0));
/// let up = Vec3::new(0.0, 0.0, 1.0);
/// let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.0, 1.0));
/// assert!(lobe.eval(up, up).g > lobe.eval(l, v).g);
/// assert_eq!(lobe.eval(l, v), lobe.eval(v, l));
/// ```
pub struct BlinnPhong<R = f32, N = NormalIncidence> {
    ks: Rgb<R>,
    q: Shininess<R>,
    /// `ks N(q)`.
    peak: Rgb<R>,
    normalization: PhantomData<N>,
}

carry!([N] BlinnPhong<f32, N> => BlinnPhong<S, N> { ks, q, peak, normalization });

/// A published factor `N(q)` for the half-vector lobe, in sr⁻¹.
pub trait Normalization {
    /// `N(q)`.
    fn factor<R: Real>(q: R) -> R;
}

/// `(q+2)(q+4) / (8π (2^(−q/2) + q))`: the albedo at normal incidence is exactly `ks`.
///
/// It never gains: for `q ≥ 0` the directional albedo stays within `ks` at every angle. Away from the normal it loses, for
/// a sharp lobe as `cos² θ` (`docs/numerics.md` has the measured table). The closed form of `∫ (n·h)^q (n·l) dω` at
/// normal incidence; it can be found in Giesen, "Phong and Blinn-Phong normalization factors", 2009.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NormalIncidence {}

/// `(q+8) / 8π`: what most engines of the forward-shading years used.
///
/// An approximation of the former that gains energy: with `ks = 1` the albedo at normal incidence is 1.0750 at `q = 8`,
/// at most 1.0752 (`q = 8.76`), and above 1 for every `q > 0`. Akenine-Möller, Haines, Hoffman, *Real-Time Rendering*, 3rd edition, 2008,
/// section 7.6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CommonNormalization {}

impl Normalization for NormalIncidence {
    #[inline(always)]
    fn factor<R: Real>(q: R) -> R {
        // The quotient first, which is near 1: the product of both sums leaves the range of binary16 from q = 253 on.
        q.plus(2.0) * (q.plus(4.0) / (q.times(-0.5).exp2() + q)).times(1.0 / (8.0 * PI))
    }
}

impl Normalization for CommonNormalization {
    #[inline(always)]
    fn factor<R: Real>(q: R) -> R {
        q.plus(8.0).times(1.0 / (8.0 * PI))
    }
}

impl<R: Real> BlinnPhong<R> {
    /// A half-vector lobe of reflectance `ks` and exponent `q` that conserves energy at normal incidence.
    #[inline(always)]
    pub fn new(ks: Rgb<R>, q: Shininess<R>) -> Self {
        Self::with_normalization(ks, q)
    }
}

impl<R: Real, N: Normalization> BlinnPhong<R, N> {
    /// The lobe with the normalisation `N`: `BlinnPhong::<f32, CommonNormalization>::with_normalization(ks, q)`.
    #[inline(always)]
    pub fn with_normalization(ks: Rgb<R>, q: Shininess<R>) -> Self {
        Self { ks, q, peak: ks * N::factor(q.0), normalization: PhantomData }
    }

    /// The reflectance `ks`.
    #[inline(always)]
    pub fn ks(&self) -> Rgb<R> {
        self.ks
    }

    /// The exponent `q`.
    #[inline(always)]
    pub fn shininess(&self) -> Shininess<R> {
        self.q
    }

    /// The same lobe in another number type, its factor computed anew there.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> BlinnPhong<S, N> {
        BlinnPhong::with_normalization(self.ks.map(&f), self.q.map(&f))
    }
}

impl<R: Real, N: Normalization> Brdf<R> for BlinnPhong<R, N> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.peak * power::half_vector_lobe(l, v, self.q.0)
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.peak * (power::half_vector_lobe(l, v, self.q.0) * l.z.max(l.z.lift(0.0)))
    }
}

// Written out, because `derive` would ask the same of the marker `N`, which is never a value.
impl<R: Copy, N> Clone for BlinnPhong<R, N> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: Copy, N> Copy for BlinnPhong<R, N> {}
impl<R: PartialEq, N> PartialEq for BlinnPhong<R, N> {
    fn eq(&self, other: &Self) -> bool {
        self.ks == other.ks && self.q == other.q
    }
}
impl<R: core::fmt::Debug, N> core::fmt::Debug for BlinnPhong<R, N> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("BlinnPhong").field("ks", &self.ks).field("q", &self.q).finish_non_exhaustive()
    }
}
