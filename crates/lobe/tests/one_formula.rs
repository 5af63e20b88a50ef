//! One formula, many numbers: the same models in four lanes, in an interval type and in a recorder that prints the
//! formula.
//!
//! All three are as small as can be. They are here to keep `Real` honest: whoever adds a method that branches on a value,
//! needs a static constant or converts to a plain float breaks this file.

use lobe::illumination::BlinnTorrance;
use lobe::number::{Binary32, elementary};
use lobe::{BlinnPhong, Brdf, Frame, Lambert, Mask, Phong, Real, Rgb, Shininess, Vec3};
use lobe_verify::strategies::{pair_above, shininess};
use proptest::prelude::*;
use std::cell::RefCell;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

// -------------------------------------------------------------------------------------------------------- lanes

/// Four lanes of `f32`, without any SIMD: what counts is that they implement `Real` and give the bits of the scalar.
#[derive(Clone, Copy, Debug)]
struct Lanes([f32; 4]);

/// One answer per lane.
#[derive(Clone, Copy)]
struct LaneMask([bool; 4]);

impl Lanes {
    fn zip(self, o: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], o.0[i])))
    }
    fn test(self, o: Self, f: impl Fn(f32, f32) -> bool) -> LaneMask {
        LaneMask(std::array::from_fn(|i| f(self.0[i], o.0[i])))
    }
}

macro_rules! lane_operators {
    ($($trait:ident $method:ident),+) => {$(
        impl $trait for Lanes {
            type Output = Self;
            fn $method(self, o: Self) -> Self {
                self.zip(o, |a, b| a.$method(b))
            }
        }
    )+};
}
lane_operators!(Add add, Sub sub, Mul mul, Div div);
impl Neg for Lanes {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}
impl BitAnd for LaneMask {
    type Output = Self;
    fn bitand(self, o: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] & o.0[i]))
    }
}
impl BitOr for LaneMask {
    type Output = Self;
    fn bitor(self, o: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] | o.0[i]))
    }
}
impl Not for LaneMask {
    type Output = Self;
    fn not(self) -> Self {
        Self(self.0.map(|b| !b))
    }
}
impl Mask for LaneMask {}

impl Real for Lanes {
    type Mask = LaneMask;
    fn lift(self, c: f64) -> Self {
        Self([c as f32; 4])
    }
    fn lt(self, o: Self) -> LaneMask {
        self.test(o, |a, b| a < b)
    }
    fn le(self, o: Self) -> LaneMask {
        self.test(o, |a, b| a <= b)
    }
    fn eq(self, o: Self) -> LaneMask {
        self.test(o, |a, b| a == b)
    }
    fn select(mask: LaneMask, a: Self, b: Self) -> Self {
        Self(std::array::from_fn(|i| if mask.0[i] { a.0[i] } else { b.0[i] }))
    }
    fn abs(self) -> Self {
        Self(self.0.map(f32::abs))
    }
    fn sqrt(self) -> Self {
        Self(self.0.map(f32::sqrt))
    }
    fn copysign(self, sign: Self) -> Self {
        self.zip(sign, f32::copysign)
    }
    fn exp2(self) -> Self {
        elementary::exp2(self)
    }
    fn exp2_where(self, mask: LaneMask) -> Self {
        elementary::exp2_where(self, mask)
    }
    fn log2(self) -> Self {
        elementary::log2(self)
    }
    fn log2_1p(self) -> Self {
        elementary::log2_1p(self)
    }
    fn log2_1p_div(self, d: Self) -> Self {
        elementary::log2_1p_div(self, d)
    }
    fn pow(self, e: Self) -> Self {
        elementary::pow(self, e)
    }
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }
    fn atan2(self, x: Self) -> Self {
        elementary::atan2(self, x)
    }
    fn erfc(self) -> Self {
        elementary::erfc(self)
    }
}

impl Binary32 for Lanes {
    fn add_exponent(self, shifter: Self) -> Self {
        self.zip(shifter, Binary32::add_exponent)
    }
    fn exponent_over(self, o: Self) -> Self {
        self.zip(o, Binary32::exponent_over)
    }
    fn high_part(self) -> Self {
        Self(self.0.map(Binary32::high_part))
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    /// The same operations in the same order: the same bits, in every lane.
    #[test]
    fn lanes_give_the_bits_of_the_scalar(
        pairs in proptest::array::uniform4(pair_above()), qs in proptest::array::uniform4(shininess()),
    ) {
        let lane = |f: &dyn Fn(usize) -> f32| Lanes(std::array::from_fn(f));
        let vector = |f: &dyn Fn(usize) -> Vec3| {
            Vec3::new(lane(&|i| f(i).x), lane(&|i| f(i).y), lane(&|i| f(i).z))
        };
        let (l, v) = (vector(&|i| pairs[i].0), vector(&|i| pairs[i].1));
        let (k, q) = (Rgb::splat(lane(&|_| 0.7)), Shininess(Lanes(qs)));
        let wide = (Lambert::new(k) + Phong::new(k, q) + BlinnPhong::new(k, q)).eval_cos(l, v);
        let h = lobe::halfway(l, v);
        let (sin, cos) = l.x.times(100.0).sin_cos();
        let (angle, tail) = (l.x.atan2(v.z - l.z), v.x.times(9.0).erfc());
        for i in 0..4 {
            let ((l, v), k, q) = (pairs[i], Rgb::splat(0.7), Shininess(qs[i]));
            let one = (Lambert::new(k) + Phong::new(k, q) + BlinnPhong::new(k, q)).eval_cos(l, v);
            prop_assert_eq!(wide.g.0[i].to_bits(), one.g.to_bits());
            prop_assert_eq!(h.y.0[i].to_bits(), lobe::halfway(l, v).y.to_bits());
            let turned = Real::sin_cos(l.x.times(100.0));
            prop_assert_eq!((sin.0[i].to_bits(), cos.0[i].to_bits()), (turned.0.to_bits(), turned.1.to_bits()));
            prop_assert_eq!(angle.0[i].to_bits(), Real::atan2(l.x, v.z - l.z).to_bits());
            prop_assert_eq!(tail.0[i].to_bits(), Real::erfc(v.x.times(9.0)).to_bits());
        }
    }
}

// ---------------------------------------------------------------------------------------------------- intervals

/// All numbers from `lo` to `hi`, rounded outward.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Interval {
    lo: f64,
    hi: f64,
}

/// What a comparison of intervals may be.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Maybe {
    can_be_true: bool,
    can_be_false: bool,
}

impl BitAnd for Maybe {
    type Output = Self;
    fn bitand(self, o: Self) -> Self {
        Self { can_be_true: self.can_be_true && o.can_be_true, can_be_false: self.can_be_false || o.can_be_false }
    }
}
impl BitOr for Maybe {
    type Output = Self;
    fn bitor(self, o: Self) -> Self {
        !(!self & !o)
    }
}
impl Not for Maybe {
    type Output = Self;
    fn not(self) -> Self {
        Self { can_be_true: self.can_be_false, can_be_false: self.can_be_true }
    }
}
impl Mask for Maybe {}

impl Interval {
    fn new(lo: f64, hi: f64) -> Self {
        Self { lo, hi }
    }
    /// A few ulps outward: more than the rounding of `libm`.
    fn outward(lo: f64, hi: f64) -> Self {
        let step = |x: f64, up: f64| if x.is_finite() { x + up * (x.abs() * 1e-15 + 1e-300) } else { x };
        Self { lo: step(lo, -1.0), hi: step(hi, 1.0) }
    }
    fn hull(self, o: Self) -> Self {
        Self { lo: f64::min(self.lo, o.lo), hi: f64::max(self.hi, o.hi) }
    }
    fn of_products(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let all = [f(self.lo, o.lo), f(self.lo, o.hi), f(self.hi, o.lo), f(self.hi, o.hi)];
        Self::outward(all.into_iter().fold(f64::INFINITY, f64::min), all.into_iter().fold(f64::NEG_INFINITY, f64::max))
    }
    fn increasing(self, f: impl Fn(f64) -> f64) -> Self {
        Self::outward(f(self.lo), f(self.hi))
    }
    fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::outward(self.lo + o.lo, self.hi + o.hi)
    }
}
impl Sub for Interval {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::outward(self.lo - o.hi, self.hi - o.lo)
    }
}
impl Mul for Interval {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        self.of_products(o, |a, b| a * b)
    }
}
impl Div for Interval {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        if o.contains(0.0) {
            return Self::new(f64::NEG_INFINITY, f64::INFINITY);
        }
        self.of_products(o, |a, b| a / b)
    }
}
impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.hi, -self.lo)
    }
}

impl Real for Interval {
    type Mask = Maybe;
    fn lift(self, c: f64) -> Self {
        Self::new(c, c)
    }
    fn lt(self, o: Self) -> Maybe {
        Maybe { can_be_true: self.lo < o.hi, can_be_false: self.hi >= o.lo }
    }
    fn le(self, o: Self) -> Maybe {
        Maybe { can_be_true: self.lo <= o.hi, can_be_false: self.hi > o.lo }
    }
    fn eq(self, o: Self) -> Maybe {
        self.le(o) & o.le(self)
    }
    fn select(mask: Maybe, a: Self, b: Self) -> Self {
        match (mask.can_be_true, mask.can_be_false) {
            (true, false) => a,
            (false, true) => b,
            _ => a.hull(b),
        }
    }
    fn abs(self) -> Self {
        let far = f64::max(self.lo.abs(), self.hi.abs());
        let near = if self.contains(0.0) { 0.0 } else { f64::min(self.lo.abs(), self.hi.abs()) };
        Self::new(near, far)
    }
    fn sqrt(self) -> Self {
        Self::new(f64::max(self.lo, 0.0), self.hi).increasing(f64::sqrt)
    }
    fn copysign(self, sign: Self) -> Self {
        let magnitude = self.abs();
        match (sign.lo >= 0.0, sign.hi < 0.0) {
            (true, _) => magnitude,
            (_, true) => -magnitude,
            _ => magnitude.hull(-magnitude),
        }
    }
    fn exp2(self) -> Self {
        self.increasing(f64::exp2)
    }
    fn log2(self) -> Self {
        self.increasing(f64::log2)
    }
    fn log2_1p(self) -> Self {
        self.increasing(|x| x.ln_1p() * std::f64::consts::LOG2_E)
    }
    fn log2_1p_div(self, d: Self) -> Self {
        (self / d).log2_1p()
    }
    fn pow(self, e: Self) -> Self {
        (self.log2() * e).exp2()
    }
    fn sin_cos(self) -> (Self, Self) {
        (Self::new(-1.0, 1.0), Self::new(-1.0, 1.0))
    }
    fn atan2(self, x: Self) -> Self {
        use std::f64::consts::PI;
        // Along each axis the angle is monotonic, but for the cut behind the origin.
        if x.lo <= 0.0 && self.contains(0.0) { Self::new(-PI, PI) } else { self.of_products(x, f64::atan2) }
    }
    fn erfc(self) -> Self {
        Self::outward(Real::erfc(self.hi), Real::erfc(self.lo))
    }
}

fn thin(v: Vec3<f64>, width: f64) -> Vec3<Interval> {
    v.map(|c| Interval::new(c - width, c + width))
}

/// A box of directions gives bounds that hold for every direction in it, and are not much wider than they must be.
#[test]
fn a_box_of_directions_gives_bounds() {
    let point = |x: f64| Interval::new(x, x);
    let (l, v) = (Vec3::new(0.48, 0.36, 0.8), Vec3::new(-0.6, 0.0, 0.8));
    let material = Lambert::new(Rgb::splat(0.4)) + BlinnPhong::new(Rgb::splat(0.5), Shininess(30.0));
    let boxed = Lambert::new(Rgb::splat(point(0.4))) + BlinnPhong::new(Rgb::splat(point(0.5)), Shininess(point(30.0)));
    let width = 1e-3;
    let bounds = boxed.eval(thin(l, width), thin(v, width)).g;
    for i in -1..=1 {
        for j in -1..=1 {
            let (dx, dz) = (f64::from(i) * width, f64::from(j) * width);
            let inside = material.eval(Vec3::new(l.x + dx, l.y, l.z + dz), Vec3::new(v.x, v.y + dz, v.z + dx)).g;
            assert!(bounds.contains(inside), "{inside} in {bounds:?}");
        }
    }
    let value = material.eval(l, v).g;
    assert!(bounds.hi - bounds.lo < 0.2 * value, "{bounds:?} around {value}");
    // Across the horizon the answer is both.
    let across = boxed.eval(thin(Vec3::new(1.0, 0.0, 0.0), width), thin(v, width)).g;
    assert!(across.contains(0.0) && across.hi > 0.1);
}

// ------------------------------------------------------------------------------------------- recorded expressions

/// A node of a recorded formula: it knows its arena, so a constant needs a witness.
#[derive(Clone, Copy)]
struct Expr<'a> {
    arena: &'a RefCell<Vec<String>>,
    id: usize,
}

impl<'a> Expr<'a> {
    fn variable(arena: &'a RefCell<Vec<String>>, name: &str) -> Self {
        Self::push(arena, name.to_owned())
    }
    /// The node, or the one that is already there.
    fn push(arena: &'a RefCell<Vec<String>>, text: String) -> Self {
        let mut nodes = arena.borrow_mut();
        let id = nodes.iter().position(|n| *n == text).unwrap_or_else(|| {
            nodes.push(text);
            nodes.len() - 1
        });
        Self { arena, id }
    }
    fn call(self, name: &str, rest: &[Self]) -> Self {
        let arguments: Vec<_> = std::iter::once(&self).chain(rest).map(|e| format!("t{}", e.id)).collect();
        Self::push(self.arena, format!("{name}({})", arguments.join(", ")))
    }
    fn infix(self, operator: &str, other: Self) -> Self {
        Self::push(self.arena, format!("t{} {operator} t{}", self.id, other.id))
    }
}

macro_rules! record_operators {
    ($($trait:ident $method:ident $operator:literal),+) => {$(
        impl $trait for Expr<'_> {
            type Output = Self;
            fn $method(self, o: Self) -> Self {
                self.infix($operator, o)
            }
        }
    )+};
}
record_operators!(Add add "+", Sub sub "-", Mul mul "*", Div div "/", BitAnd bitand "&&", BitOr bitor "||");

impl Neg for Expr<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        self.call("-", &[])
    }
}
impl Not for Expr<'_> {
    type Output = Self;
    fn not(self) -> Self {
        self.call("!", &[])
    }
}
impl Mask for Expr<'_> {}

impl Real for Expr<'_> {
    type Mask = Self;
    fn lift(self, c: f64) -> Self {
        Self::push(self.arena, format!("{c:?}"))
    }
    fn lt(self, o: Self) -> Self {
        self.infix("<", o)
    }
    fn le(self, o: Self) -> Self {
        self.infix("<=", o)
    }
    fn eq(self, o: Self) -> Self {
        self.infix("==", o)
    }
    fn select(mask: Self, a: Self, b: Self) -> Self {
        mask.call("select", &[a, b])
    }
    fn abs(self) -> Self {
        self.call("abs", &[])
    }
    fn sqrt(self) -> Self {
        self.call("sqrt", &[])
    }
    fn copysign(self, sign: Self) -> Self {
        self.call("copysign", &[sign])
    }
    fn exp2(self) -> Self {
        self.call("exp2", &[])
    }
    fn log2(self) -> Self {
        self.call("log2", &[])
    }
    fn log2_1p(self) -> Self {
        self.plus(1.0).log2()
    }
    fn log2_1p_div(self, d: Self) -> Self {
        (self / d).log2_1p()
    }
    fn pow(self, e: Self) -> Self {
        self.call("pow", &[e])
    }
    fn sin_cos(self) -> (Self, Self) {
        (self.call("sin", &[]), self.call("cos", &[]))
    }
    fn atan2(self, x: Self) -> Self {
        self.call("atan2", &[x])
    }
    fn erfc(self) -> Self {
        self.call("erfc", &[])
    }
}

fn variables<'a>(arena: &'a RefCell<Vec<String>>, name: &str) -> Vec3<Expr<'a>> {
    Vec3::new("x", "y", "z").map(|axis| Expr::variable(arena, &format!("{name}.{axis}")))
}

/// The recorded source of Lambert, node by node.
#[test]
fn a_recorder_prints_the_formula() {
    let arena = RefCell::new(Vec::new());
    let (l, v) = (variables(&arena, "l"), variables(&arena, "v"));
    let albedo = Rgb::splat(Expr::variable(&arena, "albedo"));
    let f = Lambert::new(albedo).eval(l, v);
    let source: Vec<_> = arena.borrow().iter().enumerate().map(|(i, n)| format!("t{i} = {n}")).collect();
    let expected = "t0 = l.x; t1 = l.y; t2 = l.z; t3 = v.x; t4 = v.y; t5 = v.z; t6 = albedo; \
        t7 = 0.3183098861837907; t8 = t5 < t2; t9 = select(t8, t5, t2); t10 = 0.0; t11 = t10 < t9; \
        t12 = select(t11, t7, t10); t13 = t0 + t3; t14 = t1 + t4; t15 = t2 + t5; t16 = t13 + t14; t17 = t16 + t15; \
        t18 = t17 * t10; t19 = t18 + t12; t20 = t6 * t19";
    assert_eq!(source.join("; "), expected);
    assert_eq!((f.r.id, f.g.id, f.b.id), (20, 20, 20));
}

/// Everything else records too, in a size that a shader could have.
#[test]
fn every_model_can_be_recorded() {
    let arena = RefCell::new(Vec::new());
    let (l, v, n) = (variables(&arena, "l"), variables(&arena, "v"), variables(&arena, "n"));
    let k = Rgb::splat(Expr::variable(&arena, "k"));
    let q = Shininess(Expr::variable(&arena, "q"));
    let before = arena.borrow().len();
    let material = Lambert::new(k) + Phong::new(k, q) + BlinnPhong::new(k, q);
    let f = material.eval_cos(l, v);
    let nodes = arena.borrow().len() - before;
    assert!((50..120).contains(&nodes), "{nodes} nodes");
    assert!(arena.borrow()[f.r.id].contains('+'));
    // World-space functions as well.
    let lecture = BlinnTorrance { ka: k, kd: k, ks: k, q };
    let radiance = lecture.radiance(n, l, v, k);
    let frame = Frame::from_normal(n);
    let h = lobe::halfway(frame.to_local(l), frame.to_local(v));
    assert!(radiance.r.id != h.x.id);
    let printed = arena.borrow().join("\n");
    for word in ["exp2", "log2", "select", "sqrt", "copysign"] {
        assert!(printed.contains(word), "no {word}");
    }
}
