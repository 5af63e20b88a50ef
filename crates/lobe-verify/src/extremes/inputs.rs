//! The inputs: a grid of directions and parameters, and random ones.

use lobe::Vec3;
use lobe_models::{Kind, Lobe, Model, TABLE, Value};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The smallest cosine that `eval` is promised for; `eval_cos` goes on to the smallest normal number.
pub(crate) const GRAZING: f32 = 1e-20;

/// A generator of random numbers that gives the same ones everywhere (splitmix64, Steele, Lea and Flood 2014).
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In `[0, 1)`.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }

    /// Below `n`, which is not 0.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.bits() % n.max(1) as u64) as usize
    }

    /// `10^x` for an even `x`, of either sign.
    pub(crate) fn step(&mut self, least: f64, most: f64) -> f64 {
        let size = 10_f64.powf(self.between(least, most));
        if self.bits() & 1 == 0 { size } else { -size }
    }

    pub(crate) fn pick<T: Copy>(&mut self, list: &[T], otherwise: T) -> T {
        list.get(self.below(list.len())).copied().unwrap_or(otherwise)
    }
}

/// A unit vector with this cosine and azimuth, rounded to `f32`; a small cosine keeps its digits.
pub(crate) fn unit(z: f64, phi: f64) -> Vec3 {
    let r = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    Vec3::new((r * phi.cos()) as f32, (r * phi.sin()) as f32, z as f32)
}

/// `l` for which `h` is halfway to `v`, lifted above the horizon.
pub(crate) fn across(v: Vec3, h: Vec3<f64>) -> Vec3 {
    let v = v.map(f64::from);
    let l = h * (2.0 * h.dot(v)) - v;
    let l = l * (1.0 / l.length());
    Vec3::new(l.x as f32, l.y as f32, (l.z.abs() as f32).max(f32::MIN_POSITIVE))
}

/// A direction of this tilt from the normal; the tilt may be too small for its cosine to show it.
pub(crate) fn tilted(tilt: f64, phi: f64) -> Vec3<f64> {
    Vec3::new(tilt.sin() * phi.cos(), tilt.sin() * phi.sin(), tilt.cos())
}

/// The grid of pairs: cosines from 1 to the smallest normal number, azimuths together, across and opposite, and half
/// vectors from 1e-8 away from the normal: the peak of every lobe that has one.
pub(crate) fn grid() -> Vec<(Vec3, Vec3)> {
    const COSINES: [f64; 13] = [1.0, 0.999_999_94, 0.9999, 0.98, 0.8, 0.5, 0.1, 1e-2, 1e-3, 1e-5, 1e-8, 1e-14, 1e-20];
    const LOWEST: [f64; 3] = [1e-26, 1e-32, f32::MIN_POSITIVE as f64];
    const BETWEEN: [f64; 9] = [0.0, 1e-6, 1e-3, 0.7, FRAC_PI_2, 2.5, PI - 1e-3, PI - 1e-7, PI];
    const ALONG: [f64; 3] = [0.0, 0.6, FRAC_PI_2];
    let mut pairs = Vec::new();
    let mut cross = |a: &[f64], b: &[f64]| {
        for (&zl, &zv) in a.iter().flat_map(|zl| b.iter().map(move |zv| (zl, zv))) {
            for (&phi, &turn) in ALONG.iter().flat_map(|phi| BETWEEN.iter().map(move |turn| (phi, turn))) {
                pairs.push((unit(zl, phi), unit(zv, phi + turn)));
            }
        }
    };
    cross(&COSINES, &COSINES);
    cross(&LOWEST, &[1.0, 0.5, 1e-3, 1e-20, f32::MIN_POSITIVE as f64]);
    cross(&[1.0, 0.5, 1e-3, 1e-20], &LOWEST);
    for z in [1.0, 0.8, 0.3, 1e-2, 1e-4] {
        for half_decade in -16..=0 {
            for turn in [0.0, 0.6, FRAC_PI_2, 2.0, PI] {
                let (v, tilt) = (unit(z, 0.3), 10_f64.powf(f64::from(half_decade) * 0.5));
                pairs.push((across(v, tilted(tilt, 0.3 + turn)), v));
            }
        }
    }
    pairs
}

/// A random direction above the horizon: even, grazing or next to the normal.
fn direction(random: &mut Random) -> Vec3 {
    let z = match random.below(8) {
        0..4 => random.between(1e-4, 1.0),
        4 => random.step(-20.0, 0.0).abs(),
        5 => random.step(-4.0, 0.0).abs(),
        6 => (1.0 - 0.5 * random.step(-14.0, 0.0).abs()).sqrt(),
        _ => random.step(-37.9, -20.0).abs(),
    };
    let phi = if random.below(4) == 0 { random.below(8) as f64 * TAU / 8.0 } else { random.between(0.0, TAU) };
    unit(z, phi)
}

/// A random pair: half of them independent, the others with a half vector at a tilt of any size.
pub(crate) fn pair(random: &mut Random) -> (Vec3, Vec3) {
    let v = direction(random);
    let l = match random.below(16) {
        0..7 => direction(random),
        7 => v,
        _ => {
            let h = tilted(random.step(-8.0, 0.19).abs(), random.between(0.0, TAU));
            across(v, h)
        }
    };
    if random.bits() & 1 == 0 { (l, v) } else { (v, l) }
}

/// The `f32` next to `x` that is inside the domain: rounding may leave it by half a step.
pub(crate) fn rounded(x: f64, min: f64, max: f64) -> f64 {
    let near = x.clamp(min, max) as f32;
    let near = if f64::from(near) > max { near.next_down() } else { near };
    f64::from(if f64::from(near) < min { near.next_up() } else { near })
}

const WIDTH: (f64, f64) = (1e-4, 1.0);

fn widths(x: f64, y: f64) -> Value {
    Value::Widths([rounded(x, WIDTH.0, WIDTH.1), rounded(y, WIDTH.0, WIDTH.1)])
}

/// Whether a number runs over orders of magnitude from 0, as an exponent does.
pub(crate) fn is_logarithmic(min: f64, max: f64) -> bool {
    (0.0..=1.0).contains(&min) && max >= 1e3
}

/// The values of the grid for a parameter.
pub(crate) fn grid_values(kind: Kind) -> Vec<Value> {
    match kind {
        // Three channels are three values at once.
        Kind::Colour { max } => [[0.0, 1e-6, 1.0], [0.04, 0.5, 0.97]]
            .map(|c| Value::Colour(c.map(|x: f64| rounded(x * max, 0.0, max))))
            .to_vec(),
        Kind::Number { min, max } if is_logarithmic(min, max) => {
            let inside = [0.0, 1.0, 10.0, 100.0, 1e4, 1e6].into_iter().filter(|x| (min..=max).contains(x));
            inside.map(|x| Value::Number(rounded(x, min, max))).collect()
        }
        Kind::Number { min, max } => [0.0, 1e-6, 1e-3, 0.1, 0.5, 0.9, 1.0]
            .map(|part| Value::Number(rounded(min + (max - min) * part, min, max)))
            .to_vec(),
        Kind::Widths => {
            let mut all = Vec::new();
            for alpha in [1e-4, 1e-3, 0.01, 0.1, 0.3, 1.0] {
                all.push(widths(alpha, alpha));
                for aspect in [4.0, 16.0] {
                    // The narrowest distributions only grow wider.
                    let other = if alpha / aspect < WIDTH.0 { alpha * aspect } else { alpha / aspect };
                    all.extend([widths(alpha, other), widths(other, alpha)]);
                }
            }
            all
        }
        Kind::Table => {
            const LAST: usize = TABLE - 1;
            // A constant, a peak, a ring, a rim.
            let shapes: [fn(usize) -> f64; 4] = [
                |_| 1.0,
                |i| [1e6, 1.0].get(i).copied().unwrap_or(1e-3),
                |i| if i == LAST / 2 { 1.0 } else { 0.0 },
                |i| if i == LAST { 1e-2 } else { 1e-6 * i as f64 },
            ];
            shapes.map(|shape| Value::Table(std::array::from_fn(|i| rounded(shape(i), 0.0, 1e6)))).to_vec()
        }
        Kind::Choice(words) => words.iter().map(|word| Value::Choice(word)).collect(),
    }
}

/// A random value, with a lean towards the ends of the domain.
pub(crate) fn random_value(kind: Kind, random: &mut Random) -> Value {
    match kind {
        Kind::Colour { max } => Value::Colour([(); 3].map(|()| {
            let x = match random.below(6) {
                0 => 0.0,
                1 => 1.0,
                2 => random.step(-6.0, 0.0).abs(),
                _ => random.unit(),
            };
            rounded(x * max, 0.0, max)
        })),
        Kind::Number { min, max } => {
            let x = match random.below(8) {
                0 => min,
                1 => max,
                2 | 3 if is_logarithmic(min, max) => random.step(-6.0, max.log10()).abs(),
                2 | 3 => min + (max - min) * random.step(-7.0, 0.0).abs(),
                4 => max - (max - min) * random.step(-7.0, 0.0).abs(),
                _ if is_logarithmic(min, max) => random.step(-1.0, max.log10()).abs(),
                _ => random.between(min, max),
            };
            Value::Number(rounded(x, min, max))
        }
        Kind::Widths => {
            let x = random.step(-4.0, 0.0).abs();
            let y = if random.below(2) == 0 { x } else { x * 16_f64.powf(random.between(-1.0, 1.0)) };
            widths(x, y)
        }
        Kind::Table => {
            let falling = random.step(-2.0, 0.0).abs();
            Value::Table(std::array::from_fn(|i| {
                let x = if random.below(8) == 0 { 0.0 } else { random.unit() * (-falling * i as f64).exp() };
                // Not all 0.
                rounded(if i == 0 { x.max(0.01) } else { x }, 0.0, 1e6)
            }))
        }
        Kind::Choice(words) => Value::Choice(random.pick(words, "")),
    }
}

/// A value a little beside this one.
fn nudged_value(kind: Kind, value: Value, random: &mut Random) -> Value {
    let scale = random.step(-7.0, -0.3).exp();
    match (kind, value) {
        (Kind::Colour { max }, Value::Colour(c)) => Value::Colour(c.map(|x| rounded(x * scale, 0.0, max))),
        (Kind::Number { min, max }, Value::Number(x)) => {
            // Next to the smallest value what counts is the distance from it.
            let x = if random.below(2) == 0 { x * scale } else { min + (x - min) * scale };
            Value::Number(rounded(x, min, max))
        }
        (Kind::Widths, Value::Widths([x, y])) => match random.below(3) {
            0 => widths(x * scale, y),
            1 => widths(x, y * scale),
            _ => widths(x * scale, y * scale),
        },
        (kind, _) => random_value(kind, random),
    }
}

/// The lobe with these values, in the order of the model's parameters.
pub(crate) fn lobe(model: &'static Model, values: impl IntoIterator<Item = Value>) -> Option<Lobe> {
    let given: Vec<_> = model.parameters.iter().map(|p| p.name).zip(values).collect();
    // Values outside a domain would be a mistake above; the test asks for all of them.
    Lobe::new(model, &given).ok()
}

/// At most `most` lobes of the crossed grid of the model's parameters, evenly strewn over it.
pub(crate) fn grid_lobes(model: &'static Model, most: usize) -> Vec<Lobe> {
    let axes: Vec<_> = model.parameters.iter().map(|p| grid_values(p.kind)).collect();
    let total: usize = axes.iter().map(Vec::len).product();
    // A step next to total/φ that shares no factor with the total meets every point once, and no axis in step.
    let mut step = (total as f64 * 0.618_033_988_749_895) as usize + 1;
    while gcd(step, total) != 1 {
        step += 1;
    }
    let point = |i: usize| {
        let mut index = if total <= most { i } else { (i as u128 * step as u128 % total as u128) as usize };
        let values: Vec<_> = axes
            .iter()
            .filter_map(|axis| {
                let digit = index % axis.len();
                index /= axis.len();
                axis.get(digit).copied()
            })
            .collect();
        lobe(model, values)
    };
    (0..total.min(most)).filter_map(point).collect()
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// A lobe of random parameters.
pub(crate) fn random_lobe(model: &'static Model, random: &mut Random) -> Option<Lobe> {
    let values: Vec<_> = model.parameters.iter().map(|p| random_value(p.kind, random)).collect();
    lobe(model, values)
}

/// The lobe with one parameter changed, a little or altogether.
pub(crate) fn nudged_lobe(of: &Lobe, random: &mut Random) -> Option<Lobe> {
    let which = random.below(of.model().parameters.len());
    let values: Vec<_> = of
        .values()
        .enumerate()
        .map(|(i, (parameter, value))| match (i == which, random.below(8)) {
            (false, _) => value,
            (true, 0) => random_value(parameter.kind, random),
            (true, _) => nudged_value(parameter.kind, value, random),
        })
        .collect();
    lobe(of.model(), values)
}

/// The pair moved a little: by ulps, by angles, or by the tilt of its half vector. `None` where it would not be two
/// unit vectors above the horizon.
pub(crate) fn nudged_pair((l, v): (Vec3, Vec3), random: &mut Random) -> Option<(Vec3, Vec3)> {
    let moved = match random.below(8) {
        0..2 => (by_ulps(l, random), by_ulps(v, random)),
        2 => (by_ulps(l, random), v),
        3 => (l, by_ulps(v, random)),
        4 => (by_angles(l, random), v),
        5 => (l, by_angles(v, random)),
        6 => {
            // The half vector closer to the normal or further from it, or turned around it.
            let s = l.map(f64::from) + v.map(f64::from);
            let (tilt, phi) = (s.x.hypot(s.y).atan2(s.z), s.y.atan2(s.x));
            let (tilt, phi) = match random.below(2) {
                0 => (tilt * (1.0 + random.step(-7.0, -0.2)), phi),
                _ => (tilt, phi + random.step(-7.0, 0.0)),
            };
            (across(v, tilted(tilt, phi)), v)
        }
        _ => {
            // Both directions around the normal.
            let turn = random.step(-7.0, 0.5);
            let around = |d: Vec3| unit(f64::from(d.z), f64::from(d.y).atan2(f64::from(d.x)) + turn);
            (around(l), around(v))
        }
    };
    let good = |d: Vec3| {
        let length2 = d.map(f64::from).length_squared();
        d.z >= f32::MIN_POSITIVE && d.z <= 1.0 && (length2 - 1.0).abs() <= 2.5e-7
    };
    (good(moved.0) && good(moved.1)).then_some(moved)
}

fn by_ulps(d: Vec3, random: &mut Random) -> Vec3 {
    let mut moved = |x: f32| {
        let steps = random.below(7) as i32 - 3;
        // An exact 0 stays: its neighbours are subnormal.
        if x == 0.0 { x } else { f32::from_bits(x.to_bits().wrapping_add_signed(steps)) }
    };
    Vec3::new(moved(d.x), moved(d.y), moved(d.z))
}

fn by_angles(d: Vec3, random: &mut Random) -> Vec3 {
    let (z, phi) = (f64::from(d.z), f64::from(d.y).atan2(f64::from(d.x)));
    match random.below(3) {
        0 => unit((z * (1.0 + random.step(-7.0, -0.1))).min(1.0), phi),
        // Next to the normal the tilt is what counts.
        1 => {
            let tilt = f64::from(d.x).hypot(f64::from(d.y)) * (1.0 + random.step(-7.0, -0.1));
            unit((1.0 - tilt * tilt).max(0.0).sqrt(), phi)
        }
        _ => unit(z, phi + random.step(-8.0, 0.5)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobe_models::models;

    fn is_unit(d: Vec3) -> bool {
        (d.map(f64::from).length_squared() - 1.0).abs() < 2.5e-7 && d.z >= f32::MIN_POSITIVE
    }

    #[test]
    fn all_directions_are_unit_vectors_above_the_horizon() {
        let mut random = Random::new(1);
        let pairs = grid().into_iter().chain((0..20_000).map(|_| pair(&mut random)));
        for (l, v) in pairs {
            assert!(is_unit(l) && is_unit(v), "{l:?} {v:?}");
        }
    }

    #[test]
    fn the_grid_meets_what_it_says() {
        let pairs = grid();
        let some = |test: &dyn Fn(Vec3, Vec3) -> bool| pairs.iter().any(|(l, v)| test(*l, *v));
        assert!(some(&|l, v| l == v));
        assert!(some(&|l, v| l.x == -v.x && l.z == v.z && l.z < 0.9 && l.z > 0.1), "mirror");
        assert!(some(&|l, v| (l + v).length_squared() < 1e-30), "opposite");
        assert!(some(&|l, _| l.z == f32::MIN_POSITIVE) && some(&|_, v| v.z == f32::MIN_POSITIVE));
    }

    #[test]
    fn the_lobes_of_the_grid_are_all_inside_their_domains_and_all_different() {
        for model in models() {
            let total: usize = model.parameters.iter().map(|p| grid_values(p.kind).len()).product();
            for most in [total.min(2000), 100] {
                let lobes = grid_lobes(model, most);
                assert_eq!(lobes.len(), total.min(most), "{}", model.name);
                for (i, lobe) in lobes.iter().enumerate().take(300) {
                    assert!(!lobes[..i].contains(lobe), "{lobe}");
                }
            }
            let mut random = Random::new(2);
            for _ in 0..500 {
                let lobe = random_lobe(model, &mut random).expect("inside its domain");
                assert!(nudged_lobe(&lobe, &mut random).is_some(), "{lobe}");
            }
        }
    }
}
