//! Sheen over a base: `f = f_sheen + f_base · min(1 − m E(n·v), 1 − m E(n·l))`.

use super::{Brdf, Charlie, above_horizon};
use crate::Alpha;
use crate::Carry;
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;

/// [`Charlie`]'s sheen over a base: `f = f_sheen + f_base · min(1 − m E(n·v), 1 − m E(n·l))`, where `E` is the albedo of a
/// white sheen and `m` the largest channel of its colour.
///
/// Khronos, *KHR_materials_sheen*, "albedo-scaling technique"; Estevez and Kulla 2017, section 5. The smaller of the
/// two factors makes it reciprocal, to the last bit if the base is.
///
/// `E` is interpolated linearly in a table of twelve roughnesses and sixteen cosines, which
/// `cargo run --example sheen_table -p lobe-energy` prints; for a roughness from 0.25 on it is within 0.01 of the
/// integral, below within 0.15 (a test of `lobe-models` holds it to that). A sheen of a roughness below 0.17 gains
/// energy by itself towards the horizon, up to twice the light that arrives: there nothing is left for the base.
///
/// Domain: colour in `[0, 1]`, `α ∈ [0.01, 1]`, the square of `sheenRoughness`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheenLayer<B, R = f32> {
    base: B,
    sheen: Charlie<R>,
    /// `m E` at `√cos θ = i/15`.
    albedo: [R; 16],
}

carry!([B: Carry] SheenLayer<B, f32> => SheenLayer<B::In<S>, S> { base, sheen, albedo });

impl<B, R: Real> SheenLayer<B, R> {
    /// The sheen of this colour and width on a base.
    #[inline]
    pub fn new(base: B, color: Rgb<R>, alpha: Alpha<R>) -> Self {
        let row = (alpha.0.sqrt().plus(-0.1)).times(11.0 / 0.9);
        let largest = color.r.max(color.g).max(color.b);
        let mut albedo = [row.lift(0.0); 16];
        for (i, values) in TABLE.iter().enumerate() {
            let weight = hat(row, i) * largest;
            for (sum, value) in albedo.iter_mut().zip(values) {
                *sum = *sum + weight.times(*value);
            }
        }
        Self { base, sheen: Charlie::new(color, alpha), albedo }
    }

    /// The lobe under the sheen.
    #[inline(always)]
    pub fn base(&self) -> &B {
        &self.base
    }

    /// The sheen.
    #[inline(always)]
    pub fn sheen(&self) -> &Charlie<R> {
        &self.sheen
    }

    /// The colour of the sheen.
    #[inline(always)]
    pub fn sheen_color(&self) -> Rgb<R> {
        self.sheen.color
    }

    /// What the sheen leaves of the base: `min(1 − m E(n·v), 1 − m E(n·l))`, 0 below the horizon.
    #[inline(always)]
    pub fn transmitted(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        // Selected: below the horizon the root is not a number, and the base is 0.
        above_horizon(l, v, self.scale(l.z).min(self.scale(v.z)))
    }

    /// `1 − m E(cos θ)`, not below 0.
    #[inline(always)]
    fn scale(&self, cos: R) -> R {
        let (at, zero) = (cos.sqrt().times(15.0), cos.lift(0.0));
        let mut sum = zero;
        for (i, value) in self.albedo.iter().enumerate() {
            sum = sum + hat(at, i) * *value;
        }
        (cos.lift(1.0) - sum).max(zero)
    }

    #[inline(always)]
    fn layered(&self, sheen: Rgb<R>, base: Rgb<R>, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        sheen + base * self.transmitted(l, v)
    }
}

/// `max(0, 1 − |x − i|)`, what node `i` has of the linear interpolation at `x`.
#[inline(always)]
fn hat<R: Real>(x: R, i: usize) -> R {
    let one = x.lift(1.0);
    (one - x.plus(-(i as f64)).abs()).max(x.lift(0.0))
}

impl<R: Real, B: Brdf<R>> Brdf<R> for SheenLayer<B, R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.layered(self.sheen.eval(l, v), self.base.eval(l, v), l, v)
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.layered(self.sheen.eval_cos(l, v), self.base.eval_cos(l, v), l, v)
    }
}

/// `E` of a white sheen: a row for each roughness from 0.1 to 1, a column for each `√cos θ` from 0 to 1.
#[rustfmt::skip]
const TABLE: [[f64; 16]; 12] = [
    [1.9656, 2.0920, 1.6858, 1.1940, 0.7697, 0.4502, 0.2347, 0.1059, 0.0398, 0.0117, 0.0025, 0.0003, 0.0000, 0.0000, 0.0000, 0.0000],
    [1.1471, 1.2825, 1.1393, 0.9217, 0.7069, 0.5176, 0.3606, 0.2369, 0.1449, 0.0809, 0.0402, 0.0170, 0.0058, 0.0014, 0.0002, 0.0000],
    [0.8669, 0.9906, 0.9178, 0.7844, 0.6444, 0.5136, 0.3973, 0.2970, 0.2130, 0.1450, 0.0923, 0.0539, 0.0280, 0.0120, 0.0035, 0.0002],
    [0.7469, 0.8630, 0.8193, 0.7218, 0.6155, 0.5134, 0.4195, 0.3349, 0.2601, 0.1950, 0.1397, 0.0945, 0.0595, 0.0334, 0.0148, 0.0032],
    [0.6996, 0.8109, 0.7823, 0.7024, 0.6129, 0.5256, 0.4440, 0.3688, 0.3002, 0.2382, 0.1827, 0.1344, 0.0943, 0.0611, 0.0339, 0.0125],
    [0.6945, 0.8015, 0.7814, 0.7104, 0.6293, 0.5495, 0.4743, 0.4042, 0.3392, 0.2789, 0.2235, 0.1732, 0.1300, 0.0922, 0.0587, 0.0291],
    [0.7180, 0.8184, 0.8034, 0.7363, 0.6587, 0.5821, 0.5096, 0.4418, 0.3782, 0.3186, 0.2627, 0.2109, 0.1654, 0.1244, 0.0866, 0.0513],
    [0.7610, 0.8512, 0.8388, 0.7725, 0.6954, 0.6193, 0.5475, 0.4800, 0.4166, 0.3566, 0.2998, 0.2466, 0.1993, 0.1561, 0.1154, 0.0766],
    [0.8146, 0.8902, 0.8787, 0.8114, 0.7332, 0.6563, 0.5838, 0.5159, 0.4519, 0.3912, 0.3334, 0.2788, 0.2302, 0.1856, 0.1431, 0.1023],
    [0.8663, 0.9250, 0.9132, 0.8445, 0.7649, 0.6870, 0.6137, 0.5453, 0.4808, 0.4196, 0.3612, 0.3059, 0.2566, 0.2112, 0.1680, 0.1264],
    [0.8996, 0.9434, 0.9315, 0.8622, 0.7823, 0.7044, 0.6315, 0.5635, 0.4995, 0.4387, 0.3807, 0.3257, 0.2766, 0.2315, 0.1886, 0.1473],
    [0.8957, 0.9329, 0.9218, 0.8545, 0.7770, 0.7016, 0.6312, 0.5655, 0.5038, 0.4452, 0.3891, 0.3359, 0.2886, 0.2451, 0.2036, 0.1638],
];
