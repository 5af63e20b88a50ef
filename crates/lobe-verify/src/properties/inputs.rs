//! The places that are tried: a crossed grid and random ones, both leaning on the extremes, the same every time.

use super::place::{Place, Tilt, Toward};

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Pairs of directions of the grid, at most.
    pub grid: usize,
    /// Random pairs.
    pub random: usize,
    /// Views at which the albedo is taken.
    pub views: usize,
    /// To what two quadratures of it have to agree; see [`lobe_energy::directional_albedo_to`].
    pub agreement: f64,
    /// Points on each path along which the continuity is looked at, before any is looked at more closely.
    pub steps: usize,
}

impl Effort {
    /// For tests, and for programs that are slow.
    pub const QUICK: Self = Self { grid: 700, random: 700, views: 4, agreement: 1e-3, steps: 64 };
    /// All there is.
    pub const FULL: Self = Self { grid: usize::MAX, random: 20_000, views: 12, agreement: 1e-6, steps: 1024 };
}

/// A generator of random numbers that gives the same ones everywhere (splitmix64, Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    fn below(&mut self, n: u64) -> u64 {
        self.bits() % n.max(1)
    }

    /// `10^x` for an even `x`.
    fn power(&mut self, least: f64, most: f64) -> f64 {
        libm::pow(10.0, self.between(least, most))
    }

    /// The same with either sign.
    fn step(&mut self, least: f64, most: f64) -> f64 {
        let size = self.power(least, most);
        if self.below(2) == 0 { size } else { -size }
    }

    /// In degrees, in steps of 2⁻³² of one: adding a multiple of 45 is exact.
    fn azimuth(&mut self) -> f64 {
        if self.below(4) == 0 {
            return self.below(8) as f64 * 45.0;
        }
        self.below(360 << 32) as f64 / (1_u64 << 32) as f64
    }

    fn tilt(&mut self, grazing: f64) -> Tilt {
        match self.below(8) {
            0..4 => Tilt::Cos(self.between(1e-3, 1.0)),
            4 => Tilt::Cos(self.power(-4.0, 0.0).max(grazing)),
            5 => Tilt::Cos(self.power(grazing.log10(), 0.0).max(grazing)),
            6 => Tilt::Sin(self.power(-9.0, -0.5)),
            _ => Tilt::Cos(1.0),
        }
    }

    /// Half of them independent, the others `l = v` or near the mirror direction of each other, where the lobes are.
    fn place(&mut self, grazing: f64) -> Place {
        let v = Toward::new(self.tilt(grazing), self.azimuth());
        let l = match self.below(16) {
            0..7 => Toward::new(self.tilt(grazing), self.azimuth()),
            7 => v,
            8 => Toward::new(v.tilt, v.azimuth + 180.0),
            _ => {
                let (factor, turn) = (1.0 + self.step(-9.0, -0.2), self.step(-9.0, 1.5));
                let tilt = match v.tilt {
                    Tilt::Cos(cos) => Tilt::Cos((cos * factor).clamp(grazing, 1.0)),
                    Tilt::Sin(sin) => Tilt::Sin((sin * factor).min(1.0)),
                };
                Toward::new(tilt, v.azimuth + 180.0 + turn)
            }
        };
        if self.below(2) == 0 { Place { l, v } } else { Place { l: v, v: l } }
    }
}

/// The grid: tilts from the normal to the smallest cosine, azimuths together, across and opposite.
fn grid(grazing: f64) -> Vec<Place> {
    const NEAR: [f64; 2] = [1e-8, 1e-4];
    const COSINES: [f64; 11] = [1.0, 0.98, 0.8, 0.5, 0.1, 1e-2, 1e-3, 1e-5, 1e-8, 1e-14, 1e-20];
    const BETWEEN: [f64; 9] = [0.0, 1e-6, 0.1, 40.0, 90.0, 143.0, 179.9, 180.0 - 1e-6, 180.0];
    const ALONG: [f64; 3] = [0.0, 37.0, 90.0];
    let cosines = COSINES.into_iter().filter(|cos| *cos > grazing).chain([grazing]).map(Tilt::Cos);
    let tilts: Vec<Tilt> = cosines.chain(NEAR.map(Tilt::Sin)).collect();
    let mut places = Vec::new();
    for &along in &ALONG {
        for &between in &BETWEEN {
            for &l in &tilts {
                places.extend(
                    tilts.iter().map(|&v| Place { l: Toward::new(l, along), v: Toward::new(v, along + between) }),
                );
            }
        }
    }
    places
}

/// The places of an effort, cosines not below `grazing`.
pub(crate) fn places(effort: Effort, grazing: f64) -> Vec<Place> {
    // Any seed would do: nothing was chosen for it.
    let mut random = Random(2026);
    let grid = grid(grazing);
    // A step that shares no factor with the length (a multiple of 27) strews the places evenly.
    let step = (grid.len() / effort.grid.clamp(1, grid.len())).max(1);
    let step = if step.is_multiple_of(3) { step + 1 } else { step };
    let chosen = grid.into_iter().step_by(step).take(effort.grid);
    chosen.chain((0..effort.random).map(|_| random.place(grazing))).collect()
}

/// The same with one or both directions on or below the horizon.
pub(crate) fn below(effort: Effort, grazing: f64) -> Vec<Place> {
    let sunk = |d: Toward, cos: f64| Toward::new(Tilt::Cos(cos), d.azimuth);
    let mut places = places(effort, grazing);
    for (index, place) in places.iter_mut().enumerate() {
        let (l, v) = (-place.l.cos(), -place.v.cos());
        *place = match index % 5 {
            0 => Place { l: sunk(place.l, l), v: place.v },
            1 => Place { l: place.l, v: sunk(place.v, v) },
            2 => Place { l: sunk(place.l, l), v: sunk(place.v, v) },
            3 => Place { l: sunk(place.l, 0.0), v: place.v },
            _ => Place { l: place.l, v: sunk(place.v, 0.0) },
        };
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subject::Precision;

    #[test]
    fn all_directions_are_unit_vectors_above_the_horizon() {
        for precision in [Precision::Single, Precision::Double] {
            for place in places(Effort::FULL, 1e-20) {
                let pair = place.pair(precision);
                for d in [[pair[0], pair[1], pair[2]], [pair[3], pair[4], pair[5]]] {
                    let length2: f64 = d.iter().map(|x| x * x).sum();
                    assert!((length2 - 1.0).abs() < 3e-7 && d[2] >= 0.9e-20, "{d:?}");
                }
            }
        }
    }

    #[test]
    fn below_the_horizon_one_of_them_is() {
        for place in below(Effort::QUICK, 1e-20) {
            assert!(place.l.cos() <= 0.0 || place.v.cos() <= 0.0, "{place:?}");
        }
    }

    #[test]
    fn a_quick_effort_meets_every_tilt_of_the_grid() {
        let few = places(Effort { random: 0, ..Effort::QUICK }, 1e-20);
        assert!((600..=700).contains(&few.len()), "{}", few.len());
        for tilt in [Tilt::Cos(1.0), Tilt::Cos(1e-20), Tilt::Sin(1e-8)] {
            assert!(few.iter().any(|p| p.l.tilt == tilt) && few.iter().any(|p| p.v.tilt == tilt), "{tilt:?}");
        }
    }
}
