//! Metals: `η` and `k` of ten pure metals for red, green and blue light.
//!
//! Each value is the measured spectrum at one wavelength: red at 650 nm, green at 550 nm, blue at 450 nm, linearly
//! interpolated between the wavelengths of the published table and rounded to four digits. Indices at three
//! wavelengths are no colour in the strict sense: the reflectances stand for linear sRGB because they are near those of
//! an integration over the whole spectrum with the CIE 1931 observer under D65, within 0.01 per channel at normal
//! incidence, copper within 0.02, gold within 0.11 in red (its colour is outside sRGB: the integral is 1.06).
//!
//! The tables are those of the refractiveindex.info database (Polyanskiy, Scientific Data 11, 94, 2024; public domain,
//! CC0), which holds the published measurements:
//!
//! - Johnson and Christy, "Optical Constants of the Noble Metals", Phys. Rev. B 6, 4370, 1972: gold, silver, copper;
//! - Johnson and Christy, "Optical Constants of Transition Metals: Ti, V, Cr, Mn, Fe, Co, Ni, and Pd", Phys. Rev. B 9,
//!   5056, 1974: iron, titanium, chromium, nickel;
//! - McPeak et al., "Plasmonic Films Can Easily Be Better: Rules and Recipes", ACS Photonics 2, 326, 2015: aluminium;
//! - Rakić et al., "Optical Properties of Metallic Films for Vertical-Cavity Optoelectronic Devices", Appl. Opt. 37,
//!   5271, 1998, their Brendel-Bormann fit: platinum, tungsten.

use super::Conductor;
use crate::color::Rgb;
use crate::number::Real;

/// A metal by its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    /// Its English name, in lower case.
    pub name: &'static str,
    /// The index of refraction at 650, 550 and 450 nm.
    pub eta: Rgb<f64>,
    /// The extinction coefficient at 650, 550 and 450 nm.
    pub k: Rgb<f64>,
    /// Who measured it.
    pub source: &'static str,
}

impl Metal {
    /// The Fresnel term of the metal, in the number type of the witness.
    ///
    /// ```
    /// use lobe::fresnel::{Fresnel, Incidence, metals::GOLD};
    /// let f0 = GOLD.conductor(1.0_f32).fresnel(Incidence::from_cos(1.0));
    /// assert!(f0.r > 0.95 && (f0.g - 0.79).abs() < 0.01 && (f0.b - 0.41).abs() < 0.01);
    /// ```
    #[inline(always)]
    pub fn conductor<R: Real>(&self, witness: R) -> Conductor<R> {
        let lift = |c: f64| witness.lift(c);
        Conductor::new(self.eta.map(lift), self.k.map(lift))
    }
}

const NOBLE: &str = "Johnson and Christy 1972";
const TRANSITION: &str = "Johnson and Christy 1974";
const RAKIC: &str = "Rakić et al. 1998";

macro_rules! metals {
    ($($constant:ident $name:literal [$nr:literal, $ng:literal, $nb:literal] [$kr:literal, $kg:literal, $kb:literal]
        $source:expr;)+) => {
        $(
            #[doc = concat!("Pure ", $name, ".")]
            pub const $constant: Metal = Metal {
                name: $name, eta: Rgb::new($nr, $ng, $nb), k: Rgb::new($kr, $kg, $kb), source: $source,
            };
        )+
        /// All metals.
        pub const METALS: &[Metal] = &[$($constant),+];
    };
}

metals! {
    GOLD "gold" [0.1556, 0.4241, 1.383] [3.602, 2.472, 1.915] NOBLE;
    SILVER "silver" [0.05222, 0.05958, 0.04] [4.409, 3.597, 2.648] NOBLE;
    COPPER "copper" [0.2378, 1.007, 1.24] [3.626, 2.582, 2.393] NOBLE;
    ALUMINIUM "aluminium" [1.246, 0.7894, 0.4892] [6.852, 5.852, 4.778] "McPeak et al. 2015";
    IRON "iron" [2.911, 2.95, 2.584] [3.089, 2.932, 2.767] TRANSITION;
    TITANIUM "titanium" [2.741, 2.542, 2.267] [3.814, 3.435, 3.038] TRANSITION;
    CHROMIUM "chromium" [3.107, 3.181, 2.323] [3.331, 3.329, 3.135] TRANSITION;
    NICKEL "nickel" [1.99, 1.921, 1.729] [4.209, 3.616, 2.944] TRANSITION;
    PLATINUM "platinum" [2.376, 2.085, 1.845] [4.265, 3.715, 3.136] RAKIC;
    TUNGSTEN "tungsten" [3.652, 3.506, 3.313] [2.795, 2.758, 2.605] RAKIC;
}
