//! From an input that fails to the simplest that still does.
//!
//! Simple is what a person would write down: the normal before a cosine of ½ before one of 0.5273, azimuth 0 before 180
//! before 37. Each round tries all places that are one step simpler, takes the simplest that fails, and goes on from
//! there; the cost falls with each, so it ends.

use super::place::{Place, Tilt, Toward};

/// More rounds than a place has digits to lose.
const ROUNDS: usize = 64;

/// The simplest place that was found to fail, from one that does. `fails` tells it of many at once.
pub(crate) fn shrink(start: Place, fails: &dyn Fn(&[Place]) -> Vec<bool>) -> Place {
    let mut place = start;
    for _ in 0..ROUNDS {
        let mut simpler: Vec<(u32, Place)> = Vec::new();
        for candidate in candidates(place) {
            let cost = cost(candidate);
            if cost < self::cost(place) && !simpler.iter().any(|(_, other)| *other == candidate) {
                simpler.push((cost, candidate));
            }
        }
        simpler.sort_by_key(|(cost, _)| *cost);
        let list: Vec<Place> = simpler.into_iter().map(|(_, place)| place).collect();
        let failing = fails(&list).into_iter().position(|fails| fails);
        match failing.and_then(|index| list.get(index)) {
            Some(found) => place = *found,
            None => break,
        }
    }
    place
}

/// Places that may be simpler.
fn candidates(place: Place) -> Vec<Place> {
    let Place { l, v } = place;
    let (tilts_l, tilts_v) = (tilts(l.tilt), tilts(v.tilt));
    let mut all = Vec::new();
    // Both at once first: a lobe is met only where they belong together.
    for &tilt in tilts_l.iter().chain(&tilts_v) {
        let (l, v) = (Toward::new(tilt, l.azimuth), Toward::new(tilt, v.azimuth));
        all.push(Place { l, v });
        all.push(Place { l: Toward::new(tilt, 0.0), v: Toward::new(tilt, 180.0) });
    }
    for &tilt in &tilts_l {
        all.push(Place { l: Toward::new(tilt, l.azimuth), v });
    }
    for &tilt in &tilts_v {
        all.push(Place { l, v: Toward::new(tilt, v.azimuth) });
    }
    let between = (v.azimuth - l.azimuth).rem_euclid(360.0);
    for azimuth in azimuths(l.azimuth) {
        all.push(Place { l: Toward::new(l.tilt, azimuth), v: Toward::new(v.tilt, azimuth + between) });
        all.push(Place { l: Toward::new(l.tilt, azimuth), v });
        for other in azimuths(between) {
            all.push(Place { l: Toward::new(l.tilt, azimuth), v: Toward::new(v.tilt, azimuth + other) });
        }
    }
    for azimuth in azimuths(v.azimuth) {
        all.push(Place { l, v: Toward::new(v.tilt, azimuth) });
    }
    all
}

/// Tilts that may be simpler; from above the horizon none below.
fn tilts(tilt: Tilt) -> Vec<Tilt> {
    const COSINES: [f64; 8] = [1.0, 0.5, 0.6, 0.8, 0.2, 0.1, 0.01, 0.001];
    let (x, make): (f64, fn(f64) -> Tilt) = match tilt {
        Tilt::Cos(cos) => (cos, Tilt::Cos),
        Tilt::Sin(sin) => (sin, Tilt::Sin),
    };
    let sign = if x.is_sign_negative() { -1.0 } else { 1.0 };
    let mut all: Vec<Tilt> = COSINES.map(|cos| Tilt::Cos(sign * cos)).to_vec();
    if sign < 0.0 {
        all.push(Tilt::Cos(1.0));
    }
    all.extend(rounded(x).into_iter().filter(|x| x.abs() <= 1.0).map(make));
    all
}

/// Azimuths in degrees that may be simpler.
fn azimuths(degrees: f64) -> Vec<f64> {
    let mut all = vec![0.0, 180.0, 90.0, 45.0, 60.0, 120.0];
    all.extend(rounded(degrees));
    all.extend([libm::round(degrees), libm::round(degrees / 10.0) * 10.0]);
    all
}

/// `x` to fewer digits, and the powers of ten around it.
fn rounded(x: f64) -> Vec<f64> {
    if x == 0.0 || !x.is_finite() {
        return Vec::new();
    }
    let mut all = Vec::new();
    for digits in [1, 2, 3, 4, 6, 8, 11] {
        // Decimal rounding as it is printed; the text of a finite number reads back.
        all.extend(format!("{x:.*e}", digits - 1).parse::<f64>().ok());
    }
    let exponent = libm::floor(libm::log10(x.abs())) as i32;
    for power in [exponent, exponent + 1] {
        all.extend(format!("{}1e{power}", if x < 0.0 { "-" } else { "" }).parse::<f64>().ok());
    }
    // Larger steps towards 1, where a failure that is not bound to a size still is.
    all.extend(format!("{}1e{}", if x < 0.0 { "-" } else { "" }, exponent / 2).parse::<f64>().ok());
    all
}

fn cost(Place { l, v }: Place) -> u32 {
    cost_of_tilt(l.tilt) + cost_of_tilt(v.tilt) + cost_of_azimuth(l.azimuth) + cost_of_azimuth(v.azimuth)
}

fn cost_of_tilt(tilt: Tilt) -> u32 {
    match tilt {
        Tilt::Cos(cos) if cos < 0.0 => 1 + cost_of_tilt(Tilt::Cos(-cos)),
        Tilt::Cos(1.0) => 0,
        Tilt::Cos(0.5) => 2,
        Tilt::Cos(cos) => 1 + cost_of_number(cos),
        Tilt::Sin(sin) => 4 + cost_of_number(sin),
    }
}

fn cost_of_azimuth(degrees: f64) -> u32 {
    match degrees {
        0.0 => 0,
        180.0 => 1,
        90.0 => 2,
        45.0 | 270.0 => 3,
        _ => 3 + cost_of_number(degrees),
    }
}

/// Two for each digit, one for each place that the point is moved.
fn cost_of_number(x: f64) -> u32 {
    let text = format!("{:e}", x.abs());
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = digits.chars().filter(char::is_ascii_digit).count() as u32;
    2 * digits + exponent.parse::<i32>().unwrap_or(0).unsigned_abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(zl: f64, phi_l: f64, zv: f64, phi_v: f64) -> Place {
        Place { l: Toward::new(Tilt::Cos(zl), phi_l), v: Toward::new(Tilt::Cos(zv), phi_v) }
    }

    fn shrunk(start: Place, fails: impl Fn(Place) -> bool) -> Place {
        assert!(fails(start));
        let end = shrink(start, &|list| list.iter().map(|place| fails(*place)).collect());
        assert!(fails(end));
        end
    }

    #[test]
    fn what_fails_everywhere_ends_at_the_normal() {
        let start = place(0.123_456, 17.123, 0.987, 301.5);
        assert_eq!(shrunk(start, |_| true), place(1.0, 0.0, 1.0, 0.0));
    }

    #[test]
    fn a_bound_is_met_with_few_digits() {
        let start = place(0.012_345_6, 17.123, 0.987, 301.5);
        assert_eq!(shrunk(start, |p| p.l.cos() < 0.02), place(0.01, 0.0, 1.0, 0.0));
        let end = shrunk(start, |p| (p.v.azimuth - p.l.azimuth).rem_euclid(360.0) > 180.0);
        assert_eq!((end.l.tilt, end.v.tilt, end.l.azimuth), (Tilt::Cos(1.0), Tilt::Cos(1.0), 0.0));
        assert!(end.v.azimuth == 300.0 || end.v.azimuth == 270.0, "{end:?}");
    }

    #[test]
    fn the_side_of_the_horizon_is_kept() {
        assert_eq!(shrunk(place(-1.3e-9, 5.0, 0.3, 0.0), |p| p.l.cos() < 0.0), place(-1.0, 0.0, 1.0, 0.0));
    }

    #[test]
    fn mirror_pairs_stay_mirrored() {
        let mirrored = |p: Place| {
            (p.l.cos() - p.v.cos()).abs() < 1e-6
                && p.l.cos() < 0.9
                && ((p.v.azimuth - p.l.azimuth).rem_euclid(360.0) - 180.0).abs() < 1e-3
        };
        let end = shrunk(place(0.312_345, 17.123, 0.312_345_1, 197.123_04), mirrored);
        assert_eq!(end, place(0.5, 0.0, 0.5, 180.0));
    }
}
