//! What goes into a batch and comes out: structures of slices.

use crate::{Rgb, Vec3};

/// How many slices a kernel may read, and how many it may write.
pub(super) const MAX_INPUTS: usize = 32;
pub(super) const MAX_OUTPUTS: usize = 8;

/// A structure of slices, one number of each slice for each point of a batch.
///
/// `&[f32]`, [`Uniform`], and [`Vec3`], [`Rgb`] and tuples of columns. There may be up to 32 slices in one.
pub trait Columns: Copy {
    /// What a point has: the structure with a number in place of each slice.
    type At<R>;
    /// How many slices there are.
    const COUNT: usize;
    /// Calls `f` for each slice, in order, until it fails.
    ///
    /// # Errors
    /// What `f` returns.
    fn visit<'a, E>(&'a self, f: &mut impl FnMut(&'a [f32]) -> Result<(), E>) -> Result<(), E>;
    /// The structure of what `next` gives for each slice, in order, and `uniform` for each [`Uniform`].
    fn load<R>(&self, next: &mut impl FnMut() -> R, uniform: &impl Fn(f32) -> R) -> Self::At<R>;
    /// The structure of `f` of each slice, and of `uniform` for each [`Uniform`].
    fn read<'a, R>(&'a self, f: &impl Fn(&'a [f32]) -> R, uniform: &impl Fn(f32) -> R) -> Self::At<R>;
    /// The structure of `f` of what stands for each slice, and of `uniform` for each [`Uniform`].
    fn map<A, R>(&self, from: &Self::At<A>, f: &impl Fn(&A) -> R, uniform: &impl Fn(f32) -> R) -> Self::At<R>;
}

/// A structure of slices to write to.
///
/// `&mut [f32]`, and [`Vec3`], [`Rgb`] and pairs of them. There may be up to 8 slices in one.
pub trait ColumnsMut {
    /// What is written to a point.
    type At<R>;
    /// How many slices there are.
    const COUNT: usize;
    /// Calls `f` for each slice, in order, until it fails.
    ///
    /// # Errors
    /// What `f` returns.
    fn visit<E>(&self, f: &mut impl FnMut(&[f32]) -> Result<(), E>) -> Result<(), E>;
    /// What comes before `at` and the rest of each slice; all of it and nothing if it is shorter.
    fn split(self, at: usize) -> (Self, Self)
    where
        Self: Sized;
    /// The structure of `f` of each slice, in order.
    fn each<'a, A>(self, f: &mut impl FnMut(&'a mut [f32]) -> A) -> Self::At<A>
    where
        Self: 'a;
    /// The structure of what `next` gives for each slice, in order.
    fn build<A>(next: &mut impl FnMut() -> A) -> Self::At<A>;
    /// Calls `f` with what stands for each slice and the number that goes there.
    fn store<A, R>(to: &mut Self::At<A>, value: Self::At<R>, f: &mut impl FnMut(&mut A, R));
}

/// The same number for every point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniform(pub f32);

impl Columns for &[f32] {
    type At<R> = R;
    const COUNT: usize = 1;
    #[inline(always)]
    fn visit<'a, E>(&'a self, f: &mut impl FnMut(&'a [f32]) -> Result<(), E>) -> Result<(), E> {
        f(self)
    }
    #[inline(always)]
    fn load<R>(&self, next: &mut impl FnMut() -> R, _: &impl Fn(f32) -> R) -> R {
        next()
    }
    #[inline(always)]
    fn read<'a, R>(&'a self, f: &impl Fn(&'a [f32]) -> R, _: &impl Fn(f32) -> R) -> R {
        f(self)
    }
    #[inline(always)]
    fn map<A, R>(&self, from: &A, f: &impl Fn(&A) -> R, _: &impl Fn(f32) -> R) -> R {
        f(from)
    }
}

impl Columns for Uniform {
    type At<R> = R;
    const COUNT: usize = 0;
    #[inline(always)]
    fn visit<'a, E>(&'a self, _: &mut impl FnMut(&'a [f32]) -> Result<(), E>) -> Result<(), E> {
        Ok(())
    }
    #[inline(always)]
    fn load<R>(&self, _: &mut impl FnMut() -> R, uniform: &impl Fn(f32) -> R) -> R {
        uniform(self.0)
    }
    #[inline(always)]
    fn read<'a, R>(&'a self, _: &impl Fn(&'a [f32]) -> R, uniform: &impl Fn(f32) -> R) -> R {
        uniform(self.0)
    }
    #[inline(always)]
    fn map<A, R>(&self, _: &A, _: &impl Fn(&A) -> R, uniform: &impl Fn(f32) -> R) -> R {
        uniform(self.0)
    }
}

impl ColumnsMut for &mut [f32] {
    type At<R> = R;
    const COUNT: usize = 1;
    #[inline(always)]
    fn visit<E>(&self, f: &mut impl FnMut(&[f32]) -> Result<(), E>) -> Result<(), E> {
        f(self)
    }
    #[inline(always)]
    fn split(self, at: usize) -> (Self, Self) {
        let at = at.min(self.len());
        self.split_at_mut_checked(at).unwrap_or_default()
    }
    #[inline(always)]
    fn each<'a, A>(self, f: &mut impl FnMut(&'a mut [f32]) -> A) -> A
    where
        Self: 'a,
    {
        f(self)
    }
    #[inline(always)]
    fn build<A>(next: &mut impl FnMut() -> A) -> A {
        next()
    }
    #[inline(always)]
    fn store<A, R>(to: &mut A, value: R, f: &mut impl FnMut(&mut A, R)) {
        f(to, value);
    }
}

/// Structures of columns are columns, field by field.
macro_rules! structures {
    ($($name:ident { $($field:ident),+ };)+) => {$(
        impl<C: Columns> Columns for $name<C> {
            type At<R> = $name<C::At<R>>;
            const COUNT: usize = 3 * C::COUNT;
            #[inline(always)]
            fn visit<'a, E>(&'a self, f: &mut impl FnMut(&'a [f32]) -> Result<(), E>) -> Result<(), E> {
                $(self.$field.visit(f)?;)+
                Ok(())
            }
            #[inline(always)]
            fn load<R>(&self, next: &mut impl FnMut() -> R, uniform: &impl Fn(f32) -> R) -> Self::At<R> {
                $name { $($field: self.$field.load(next, uniform)),+ }
            }
            #[inline(always)]
            fn read<'a, R>(&'a self, f: &impl Fn(&'a [f32]) -> R, uniform: &impl Fn(f32) -> R) -> Self::At<R> {
                $name { $($field: self.$field.read(f, uniform)),+ }
            }
            #[inline(always)]
            fn map<A, R>(&self, from: &Self::At<A>, f: &impl Fn(&A) -> R, uniform: &impl Fn(f32) -> R) -> Self::At<R> {
                $name { $($field: self.$field.map(&from.$field, f, uniform)),+ }
            }
        }

        impl<C: ColumnsMut> ColumnsMut for $name<C> {
            type At<R> = $name<C::At<R>>;
            const COUNT: usize = 3 * C::COUNT;
            #[inline(always)]
            fn visit<E>(&self, f: &mut impl FnMut(&[f32]) -> Result<(), E>) -> Result<(), E> {
                $(self.$field.visit(f)?;)+
                Ok(())
            }
            #[inline(always)]
            fn split(self, at: usize) -> (Self, Self) {
                $(let $field = self.$field.split(at);)+
                ($name { $($field: $field.0),+ }, $name { $($field: $field.1),+ })
            }
            #[inline(always)]
            fn each<'a, A>(self, f: &mut impl FnMut(&'a mut [f32]) -> A) -> Self::At<A>
            where
                Self: 'a,
            {
                $name { $($field: self.$field.each(f)),+ }
            }
            #[inline(always)]
            fn build<A>(next: &mut impl FnMut() -> A) -> Self::At<A> {
                $name { $($field: C::build(next)),+ }
            }
            #[inline(always)]
            fn store<A, R>(to: &mut Self::At<A>, value: Self::At<R>, f: &mut impl FnMut(&mut A, R)) {
                $(C::store(&mut to.$field, value.$field, f);)+
            }
        }
    )+};
}
structures! {
    Vec3 { x, y, z };
    Rgb { r, g, b };
}

/// Tuples of columns are columns.
macro_rules! tuples {
    ($(($($name:ident $index:tt),+);)+) => {$(
        impl<$($name: Columns),+> Columns for ($($name,)+) {
            type At<R> = ($($name::At<R>,)+);
            const COUNT: usize = 0 $(+ $name::COUNT)+;
            #[inline(always)]
            fn visit<'a, E>(&'a self, f: &mut impl FnMut(&'a [f32]) -> Result<(), E>) -> Result<(), E> {
                $(self.$index.visit(f)?;)+
                Ok(())
            }
            #[inline(always)]
            fn load<R>(&self, next: &mut impl FnMut() -> R, uniform: &impl Fn(f32) -> R) -> Self::At<R> {
                ($(self.$index.load(next, uniform),)+)
            }
            #[inline(always)]
            fn read<'a, R>(&'a self, f: &impl Fn(&'a [f32]) -> R, uniform: &impl Fn(f32) -> R) -> Self::At<R> {
                ($(self.$index.read(f, uniform),)+)
            }
            #[inline(always)]
            fn map<From, R>(&self, from: &Self::At<From>, f: &impl Fn(&From) -> R, uniform: &impl Fn(f32) -> R) -> Self::At<R> {
                ($(self.$index.map(&from.$index, f, uniform),)+)
            }
        }

        impl<$($name: ColumnsMut),+> ColumnsMut for ($($name,)+) {
            type At<R> = ($($name::At<R>,)+);
            const COUNT: usize = 0 $(+ $name::COUNT)+;
            #[inline(always)]
            fn visit<Error>(&self, f: &mut impl FnMut(&[f32]) -> Result<(), Error>) -> Result<(), Error> {
                $(self.$index.visit(f)?;)+
                Ok(())
            }
            #[inline(always)]
            fn split(self, at: usize) -> (Self, Self) {
                let parts = ($(self.$index.split(at),)+);
                (($(parts.$index.0,)+), ($(parts.$index.1,)+))
            }
            #[inline(always)]
            fn each<'a, To>(self, f: &mut impl FnMut(&'a mut [f32]) -> To) -> Self::At<To>
            where
                Self: 'a,
            {
                ($(self.$index.each(f),)+)
            }
            #[inline(always)]
            fn build<To>(next: &mut impl FnMut() -> To) -> Self::At<To> {
                ($($name::build(next),)+)
            }
            #[inline(always)]
            fn store<To, R>(to: &mut Self::At<To>, value: Self::At<R>, f: &mut impl FnMut(&mut To, R)) {
                $($name::store(&mut to.$index, value.$index, f);)+
            }
        }
    )+};
}
tuples! {
    (A 0);
    (A 0, B 1);
    (A 0, B 1, C 2);
    (A 0, B 1, C 2, D 3);
    (A 0, B 1, C 2, D 3, F 4);
    (A 0, B 1, C 2, D 3, F 4, G 5);
    (A 0, B 1, C 2, D 3, F 4, G 5, H 6);
    (A 0, B 1, C 2, D 3, F 4, G 5, H 6, I 7);
}
