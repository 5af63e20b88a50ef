//! `Carry`: the numbers of a lobe, taken over into another number type as they are.

use crate::number::Real;
use core::marker::PhantomData;

/// A lobe of `f32`, or a part of one, whose numbers can be carried into another number type one by one.
///
/// Unlike the `map` of each lobe it computes nothing anew: what a constructor has derived from its parameters is carried
/// too. So a batch costs no constructor, and its lanes have the very numbers of the scalar.
///
/// Everything in this crate that is made of numbers has it; for a lobe of your own, carry each field:
///
/// ```
/// use lobe::{Carry, Lambert, Real};
/// struct Dusty<R, B> {
///     dust: Lambert<R>,
///     depth: R,
///     base: B,
/// }
/// impl<B: Carry> Carry for Dusty<f32, B> {
///     type In<S: Real> = Dusty<S, B::In<S>>;
///     fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> Self::In<S> {
///         Dusty { dust: self.dust.carry(lift), depth: self.depth.carry(lift), base: self.base.carry(lift) }
///     }
/// }
/// let dusty = Dusty { dust: Lambert::new(lobe::Rgb::splat(0.5_f32)), depth: 0.25, base: lobe::Black };
/// assert_eq!(dusty.carry(&f64::from).depth, 0.25_f64);
/// ```
pub trait Carry {
    /// The same in the number type `S`.
    type In<S: Real>;
    /// `lift` of each number.
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> Self::In<S>;
}

impl Carry for f32 {
    type In<S: Real> = S;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> S {
        lift(*self)
    }
}

impl<T: Carry> Carry for &T {
    type In<S: Real> = T::In<S>;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> Self::In<S> {
        T::carry(self, lift)
    }
}

impl<T: Carry, const N: usize> Carry for [T; N] {
    type In<S: Real> = [T::In<S>; N];
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> Self::In<S> {
        self.each_ref().map(
            #[inline(always)]
            |x| x.carry(lift),
        )
    }
}

impl<A: Carry, B: Carry> Carry for (A, B) {
    type In<S: Real> = (A::In<S>, B::In<S>);
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> Self::In<S> {
        (self.0.carry(lift), self.1.carry(lift))
    }
}

/// Types that hold no number stay as they are.
macro_rules! unchanged {
    ($([$($generics:tt)*] $type:ty;)+) => {$(
        impl<$($generics)*> Carry for $type {
            type In<S: Real> = Self;
            #[inline(always)]
            fn carry<S: Real>(&self, _: &impl Fn(f32) -> S) -> Self {
                *self
            }
        }
    )+};
}
unchanged! {
    [] bool;
    [T] PhantomData<T>;
    [] crate::Black;
    [] crate::masking::Implicit;
    [] crate::masking::Kelemen;
    [] crate::masking::Neumann;
    [] crate::masking::SmithCorrelated;
    [] crate::masking::SmithSeparable;
    [] crate::masking::VCavity;
}

/// [`Carry`] field by field: `carry!([B: Carry] Layer<B, f32> => Layer<B::In<S>, S> { base, weight })`.
macro_rules! carry {
    ([$($generics:tt)*] $from:ty => $name:ident<$($to:ty),*> { $($field:tt),* $(,)? }) => {
        impl<$($generics)*> $crate::Carry for $from {
            type In<S: $crate::Real> = $name<$($to),*>;
            #[inline(always)]
            fn carry<S: $crate::Real>(&self, lift: &impl Fn(f32) -> S) -> Self::In<S> {
                $name { $($field: $crate::Carry::carry(&self.$field, lift)),* }
            }
        }
    };
}
pub(crate) use carry;
