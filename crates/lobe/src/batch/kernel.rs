//! What is computed for each point of a batch.

use crate::number::Real;
use crate::{Brdf, Carry, Frame, Rgb, Vec3};

/// What a batch computes for each point: `O` from `I`, structures of numbers.
///
/// Write it over [`Real`], mark it `#[inline(always)]`, and it runs at every level and to every precision.
///
/// A batch copies it before its loop, so that what depends on nothing but its numbers is computed once: what is behind a
/// reference might, for all that a compiler knows, be changed by every result that is written.
pub trait Kernel<I, O> {
    /// The output of one point, or of one register full of them.
    fn apply(&self, input: I) -> O;
}

impl<K: Kernel<I, O> + ?Sized, I, O> Kernel<I, O> for &K {
    #[inline(always)]
    fn apply(&self, input: I) -> O {
        K::apply(self, input)
    }
}

/// [`eval`](Brdf::eval) of a lobe, for `(l, v)` in the local frame.
#[derive(Clone, Copy, Debug)]
pub struct Eval<B>(pub B);

/// [`eval_cos`](Brdf::eval_cos) of a lobe, for `(l, v)` in the local frame.
#[derive(Clone, Copy, Debug)]
pub struct EvalCos<B>(pub B);

/// `eval_cos(l, v) · E`, for `(v, (l, E))`: the radiance that a point sends to `v` for the irradiance `E` from `l`.
#[derive(Clone, Copy, Debug)]
pub struct Shade<B>(pub B);

/// A kernel of local directions, for directions in world space: `(n, l, v)` with the unit normal of each point, or
/// `((n, tangent), l, v)` where the lobe is not the same all around.
#[derive(Clone, Copy, Debug)]
pub struct InWorld<K>(pub K);

/// A kernel that gives one channel instead of three: the red one. For a lobe that is grey, at less than its cost in
/// colour.
#[derive(Clone, Copy, Debug)]
pub struct OneChannel<K>(pub K);

impl<B: Carry, R: Real> Kernel<(Vec3<R>, Vec3<R>), Rgb<R>> for Eval<B>
where
    B::In<R>: Brdf<R>,
{
    #[inline(always)]
    fn apply(&self, (l, v): (Vec3<R>, Vec3<R>)) -> Rgb<R> {
        self.0.carry(&lift(l.z)).eval(l, v)
    }
}

impl<B: Carry, R: Real> Kernel<(Vec3<R>, Vec3<R>), Rgb<R>> for EvalCos<B>
where
    B::In<R>: Brdf<R>,
{
    #[inline(always)]
    fn apply(&self, (l, v): (Vec3<R>, Vec3<R>)) -> Rgb<R> {
        self.0.carry(&lift(l.z)).eval_cos(l, v)
    }
}

impl<B: Carry, R: Real> Kernel<(Vec3<R>, (Vec3<R>, Rgb<R>)), Rgb<R>> for Shade<B>
where
    B::In<R>: Brdf<R>,
{
    #[inline(always)]
    fn apply(&self, (v, (l, irradiance)): (Vec3<R>, (Vec3<R>, Rgb<R>))) -> Rgb<R> {
        self.0.carry(&lift(l.z)).eval_cos(l, v) * irradiance
    }
}

impl<K, R: Real, O> Kernel<(Vec3<R>, Vec3<R>, Vec3<R>), O> for InWorld<K>
where
    K: Kernel<(Vec3<R>, Vec3<R>), O>,
{
    #[inline(always)]
    fn apply(&self, (n, l, v): (Vec3<R>, Vec3<R>, Vec3<R>)) -> O {
        let frame = Frame::from_normal(n);
        self.0.apply((frame.to_local(l), frame.to_local(v)))
    }
}

impl<K, R: Real, O> Kernel<((Vec3<R>, Vec3<R>), Vec3<R>, Vec3<R>), O> for InWorld<K>
where
    K: Kernel<(Vec3<R>, Vec3<R>), O>,
{
    #[inline(always)]
    fn apply(&self, ((n, tangent), l, v): ((Vec3<R>, Vec3<R>), Vec3<R>, Vec3<R>)) -> O {
        let frame = Frame::from_normal_tangent(n, tangent);
        self.0.apply((frame.to_local(l), frame.to_local(v)))
    }
}

impl<K, I, R> Kernel<I, R> for OneChannel<K>
where
    K: Kernel<I, Rgb<R>>,
{
    #[inline(always)]
    fn apply(&self, input: I) -> R {
        self.0.apply(input).r
    }
}

/// A number of the scalar in the shape of `x`; `f64` holds it exactly.
#[inline(always)]
fn lift<R: Real>(x: R) -> impl Fn(f32) -> R {
    move |c| x.lift(f64::from(c))
}
