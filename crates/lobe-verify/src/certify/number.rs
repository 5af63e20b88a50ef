//! `Number`: the number types that a statement is evaluated in.

use super::Slopes;
use crate::interval::Interval;
use lobe::{Real, Vec3};

/// A [`Real`] that knows the sine and cosine of `π` times a number without a rounded `π`: a direction made of them is on
/// the unit sphere, and its cosine at a quarter turn is 0.
pub trait Number: Real {
    /// `(sin πu, cos πu)`.
    fn half_turns(self) -> (Self, Self);
}

impl Number for f64 {
    fn half_turns(self) -> (Self, Self) {
        use std::f64::consts::PI;
        ((self * PI).sin_cos().0, ((0.5 - self) * PI).sin_cos().0)
    }
}

impl Number for Interval {
    fn half_turns(self) -> (Self, Self) {
        Interval::half_turns(self)
    }
}

impl<const N: usize> Number for Slopes<N> {
    fn half_turns(self) -> (Self, Self) {
        Slopes::half_turns(self)
    }
}

/// The direction at the angle `πθ` from the normal, towards the tangent.
pub(super) fn in_plane<R: Number>(theta: R) -> Vec3<R> {
    let (sin, cos) = theta.half_turns();
    Vec3::new(sin, sin.lift(0.0), cos)
}
