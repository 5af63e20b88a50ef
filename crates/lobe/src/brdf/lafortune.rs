//! Lafortune: `f_r = ks N max(0, Cx l.x v.x + Cy l.y v.y + Cz l.z v.z)^q`.

use super::power::mirror_power;
use super::{Brdf, Shininess, both_above, zero_or_nan};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::TAU;

/// One generalised cosine lobe: `f_r = ks N max(0, Cx l.x v.x + Cy l.y v.y + Cz l.z v.z)^q` sr⁻¹.
///
/// Lafortune, Foo, Torrance and Greenberg, "Non-Linear Approximation of Reflectance Functions", SIGGRAPH 1997.
/// With `Cx = Cy = −Cz` it is Phong's lobe; `|Cz|` below `|Cx|` moves the peak towards the horizon (off-specular
/// reflection), `Cx = Cy > 0` turns it back to the light, `Cx ≠ Cy` makes it anisotropic.
///
/// - [`normalized`](Self::normalized): `N = (q + 2)/(2π max(|Cx|, |Cy|, |Cz|)^q)`, the form of the fits of Ngan, Durand
///   and Matusik 2005; only the ratios of the coefficients matter.
/// - [`raw`](Self::raw): `N = 1`, the equation as the paper has it.
///
/// The paper's models are sums of several lobes, written `a + b`. Where its fits have other coefficients for each
/// channel, each channel is a lobe whose `ks` is 0 in the others.
///
/// Reciprocal to the last bit. Domain: `ks ≥ 0`, `C ∈ [−2, 2]`, `q ∈ [0, 10⁶]`. At normal incidence the albedo of the
/// normalised form is exactly `ks (Cz/max|C|)^q` for `Cz ≥ 0`; towards the horizon it may exceed `ks`, which is in the
/// model.
///
/// **Digits.** The dot product rounds, and `q` times that is lost, so it is not formed. With `m = max |C|` and unit
/// vectors, `1 = Σ (l_i² + v_i²)/2`, so
///
/// `1 − x/m = Σ [(1 − |C_i|/m)(l_i² + v_i²) + (|C_i|/m)(l_i − sgn(C_i) v_i)²]/2`:
///
/// the distance from the largest value as a sum of squares, in which nothing cancels. Error against `f64` of the same
/// inputs, `u = 2⁻²⁴`, `L = |ln(x/m)^q|`, `c = x/m ≥ 2⁻¹²`: `|δf/f| ≤ u (8 + 6 L + 11 q (1/c − 1))`, where
/// `q (1/c − 1) ≤ 1.72 L` for `q ≥ L`. As for [`Phong`](super::Phong) it grows with `L` alone wherever a sharp lobe can be
/// seen. *Derivation.* The ratios are off by `u`, their complements by `2u`; the squares by `3u`; a product by `6u`, three
/// sums and the sum of the two squares by `4u`: `1 − c` is off by at most `10u`. From there on as for
/// Phong, whose `6.5 L` the spare `u q (1/c − 1) ≥ u L` brings down to `6 L`.
///
/// A lobe whose coefficients are all 0 is black for `q > 0`.
///
/// ```
/// use lobe::{Brdf, Lafortune, Phong, Rgb, Shininess, Vec3};
/// let (ks, q) = (Rgb::splat(0.5_f32), Shininess(20.0));
/// let lobe = Lafortune::normalized(ks, Vec3::new(-0.577, -0.577, 0.577), q);
/// let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.28, 0.0, 0.96));
/// assert!((lobe.eval(l, v).g / Phong::new(ks, q).eval(l, v).g - 1.0).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lafortune<R = f32> {
    ks: Rgb<R>,
    c: Vec3<R>,
    q: Shininess<R>,
    /// `|C_i|/m`.
    share: Vec3<R>,
    /// `1 − |C_i|/m`.
    rest: Vec3<R>,
    /// `ks N m^q`.
    peak: Rgb<R>,
    normalized: bool,
}

carry!([] Lafortune<f32> => Lafortune<S> { ks, c, q, share, rest, peak, normalized });

impl<R: Real> Lafortune<R> {
    /// `f_r = ks (q + 2)/(2π m^q) max(0, C·(l v))^q`, `m = max(|Cx|, |Cy|, |Cz|)`.
    #[inline(always)]
    pub fn normalized(ks: Rgb<R>, c: Vec3<R>, q: Shininess<R>) -> Self {
        Self::with_peak(ks, c, q, true)
    }

    /// `f_r = ks max(0, C·(l v))^q`.
    ///
    /// `ks m^q` must be in the range of the number type.
    #[inline(always)]
    pub fn raw(ks: Rgb<R>, c: Vec3<R>, q: Shininess<R>) -> Self {
        Self::with_peak(ks, c, q, false)
    }

    #[inline(always)]
    fn with_peak(ks: Rgb<R>, c: Vec3<R>, q: Shininess<R>, normalized: bool) -> Self {
        let size = Vec3::new(c.x.abs(), c.y.abs(), c.z.abs());
        // All coefficients 0: shares of 0, not 0/0.
        let m = size.x.max(size.y).max(size.z).max(c.x.lift(R::MIN_POSITIVE));
        let part = |size: R| (size / m, (m - size) / m);
        let ((ax, bx), (ay, by), (az, bz)) = (part(size.x), part(size.y), part(size.z));
        let factor = if normalized { q.0.plus(2.0).times(1.0 / TAU) } else { m.pow(q.0) };
        Self { ks, c, q, share: Vec3::new(ax, ay, az), rest: Vec3::new(bx, by, bz), peak: ks * factor, normalized }
    }

    /// The reflectance or factor `ks`.
    #[inline(always)]
    pub fn ks(&self) -> Rgb<R> {
        self.ks
    }

    /// The coefficients `(Cx, Cy, Cz)`.
    #[inline(always)]
    pub fn coefficients(&self) -> Vec3<R> {
        self.c
    }

    /// The exponent.
    #[inline(always)]
    pub fn shininess(&self) -> Shininess<R> {
        self.q
    }

    /// `ks N m^q`, `m = max |C|`: the largest value that the lobe can have.
    #[inline(always)]
    pub fn peak(&self) -> Rgb<R> {
        self.peak
    }

    /// The same lobe in another number type, its factors computed anew there.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Lafortune<S> {
        Lafortune::with_peak(self.ks.map(&f), self.c.map(&f), self.q.map(&f), self.normalized)
    }
}

impl<R: Real> Brdf<R> for Lafortune<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        let one = l.z.lift(1.0);
        // Exchanging l and v turns the difference around, whose square is the same.
        let term = |l: R, v: R, c: R, share: R, rest: R| {
            rest * (l.squared() + v.squared()) + share * (l - one.copysign(c) * v).squared()
        };
        let (c, a, b) = (self.c, self.share, self.rest);
        let distance = (term(l.x, v.x, c.x, a.x, b.x) + term(l.y, v.y, c.y, a.y, b.y)) + term(l.z, v.z, c.z, a.z, b.z);
        let power = mirror_power(distance.times(0.5), self.q.0, both_above(l, v));
        self.peak * (power + zero_or_nan(l, v))
    }
}
