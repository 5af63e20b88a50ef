//! The microfacet models of 1967 to 1981, as their papers have them.

use super::U;
use crate::families::{constructor, constructors};
use crate::parameter::TABLE;
use crate::{AnyTerms, Bound, Kind, Model, Number, Parameter, Reader};
use lobe::distribution::{Beckmann, Distribution, Gaussian, Ggx, Gtr, PhongPower, SmithTable, Tabulated};
use lobe::fresnel::{Dielectric, Schlick};
use lobe::masking::{SmithSeparable, VCavity};
use lobe::{Alpha, AshikhminPremozeShirley, Blinn1977, CookTorrance, Ior, Microfacet, TorranceSparrow, Vec3};

const KS: Parameter = Parameter::reflectance("ks", "the coefficient of the lobe");
const F0: Parameter = Parameter::reflectance("f0", "the reflectance at normal incidence, in Schlick's form");

/// `D` is `exp(−t)` times what is exact to a few ulps, and `t` has at most sixteen roundings: four in each component of
/// `h/α`, doubled by the square, those of `(n·h)²`, a sum and a quotient. Two more are those of `t log₂ e`. `t` exceeds
/// `|ln(D/D_max)|` by at most `2 ln(1 + t)`, so it is the depth down the lobe that counts.
const BECKMANN: Bound = Bound::Derived { formula: "u (60 + 18 t), t = (tan θ_h/m)²", at: beckmann };

fn beckmann(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let (s, m) = (l + v, p.number("m"));
    let t = (s.x * s.x + s.y * s.y) / (s.z * s.z * m * m);
    // Beyond, the exponential is below 2⁻¹²⁶.
    if t > 87.0 { f64::INFINITY } else { (60.0 + 18.0 * t) * U }
}

/// The Gaussian's own bound, with the four ulps that each component of `h` is off by.
const GAUSSIAN: Bound = Bound::Derived { formula: "2e-5 + 52u L of D", at: gaussian };

fn gaussian(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let d = Gaussian::new(Alpha(p.number("c")));
    depth(&d, l, v).map_or(f64::INFINITY, |depth| Bound::WORST + 52.0 * depth * U)
}

/// `|ln(D/D_max)|`, as far as `D` is not 0 in `f32`.
fn depth(d: &dyn Distribution<f64>, l: Vec3<f64>, v: Vec3<f64>) -> Option<f64> {
    let (peak, value) = (d.d(Vec3::new(0.0, 0.0, 1.0)), d.d((l + v).normalize()));
    let depth = (peak / value).ln();
    (depth < 126.0 * std::f64::consts::LN_2 && value > f64::from(f32::MIN_POSITIVE)).then_some(depth)
}

/// What the exponential or the power of a distribution multiplies the error of `h` with; nothing for GGX.
const GENERATED: Bound = Bound::Derived { formula: "2e-5, beckmann and blinn: and 52u L of D", at: generated };

fn generated(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let alpha = Alpha(p.number("width"));
    let depth = match p.choice("distribution") {
        "beckmann" => depth(&Beckmann::new(alpha), l, v),
        "blinn" => depth(&PhongPower::new(alpha), l, v),
        // Far from a sharp peak with a large γ `D` is subnormal, which a large visibility then shows.
        "gtr" => depth(&Gtr::new(alpha, p.number("gamma")), l, v).map(|_| 0.0),
        _ => Some(0.0),
    };
    depth.map_or(f64::INFINITY, |depth| Bound::WORST + 52.0 * depth * U)
}

pub(super) static MODELS: &[Model] = &[
    Model {
        name: "torrance-sparrow",
        summary: "a Gaussian of the facets' angles, V-cavities and exact Fresnel (Torrance and Sparrow 1967)",
        parameters: &[
            Parameter::number("c", 1e-4, 1.0, "the width of the Gaussian in radians"),
            Parameter::number("ior", 1.0, 4.0, "the index of refraction"),
        ],
        reciprocal: true,
        finite: true,
        bound: GAUSSIAN,
        build: constructors!(facets: torrance_sparrow),
    },
    Model {
        name: "ashikhmin-premoze-shirley",
        summary: "any distribution, with the shadowing that follows from it (Ashikhmin, Premože and Shirley 2000)",
        parameters: &[
            Parameter::choice("distribution", &["ggx", "beckmann", "blinn", "gtr"], "the distribution p(h)"),
            Parameter::number("width", 1e-4, 1.0, "its width α"),
            Parameter::number("gamma", 0.5, 5.0, "the exponent γ of gtr").or(crate::Value::Number(1.5)),
            F0,
        ],
        reciprocal: true,
        finite: true,
        bound: GENERATED,
        build: constructors!(facets: generator),
    },
    Model {
        name: "tabulated-facets",
        summary: "facets of any distribution of the angle, given as a table (Ashikhmin, Premože and Shirley 2000)",
        parameters: &[
            Parameter {
                name: "table",
                kind: Kind::Table,
                default: None,
                doc: "p(h) in any unit, linear in between; it is normalised",
            },
            F0,
        ],
        reciprocal: true,
        finite: true,
        bound: Bound::Derived { formula: "2e-5 + 160u × steepest step of the table over D", at: tabulated },
        build: constructors!(facets: generator_of_table),
    },
    Model {
        name: "cook-torrance",
        summary: "Beckmann, V-cavities and the factor 1/π (Cook and Torrance 1981)",
        parameters: &[KS, Parameter::number("m", 1e-4, 1.0, "the root mean square slope"), F0],
        reciprocal: true,
        finite: true,
        bound: BECKMANN,
        build: constructors!(cook_torrance, terms: cook_torrance_terms),
    },
    Model {
        name: "blinn-1977",
        summary: "Trowbridge-Reitz with a peak of 1, and V-cavities (Blinn 1977): gains energy",
        parameters: &[KS, Parameter::number("c", 1e-4, 1.0, "the width c₃ of the distribution"), F0],
        reciprocal: true,
        finite: true,
        bound: Bound::Constant,
        build: constructors!(blinn, terms: blinn_terms),
    },
];

constructor! { facets: torrance_sparrow |p, finish, table| {
    let terms: TorranceSparrow<Dielectric<R>, R> =
        Microfacet::new(Gaussian::new(Alpha(p.number("c"))), VCavity, Dielectric::new(Ior(p.number("ior"))));
    finish(terms)
} }

constructor! { cook_torrance |p, finish| finish(cook_torrance_lobe(p)) }

fn cook_torrance_terms(p: &Reader<'_, f64>) -> AnyTerms {
    Box::new(cook_torrance_lobe(p).modern())
}

fn cook_torrance_lobe<R: Number>(p: &Reader<'_, R>) -> CookTorrance<Schlick<R>, R> {
    CookTorrance::new(p.rgb("ks"), Alpha(p.number("m")), Schlick::new(p.rgb("f0")))
}

constructor! { blinn |p, finish| finish(blinn_lobe(p)) }

fn blinn_terms(p: &Reader<'_, f64>) -> AnyTerms {
    Box::new(blinn_lobe(p).modern())
}

fn blinn_lobe<R: Number>(p: &Reader<'_, R>) -> Blinn1977<Ggx<R>, Schlick<R>, R> {
    Blinn1977::new(p.rgb("ks"), Ggx::new(Alpha(p.number("c"))), Schlick::new(p.rgb("f0")))
}

/// The type of the lobe: any distribution is one of tables.
type Table<R> = SmithTable<Tabulated<R, TABLE>, R>;

/// The angle of `h` is off by `8u` of a right angle at most, which is `18 · 8u` steps of the table: so much of the difference of two
/// neighbours `D` is off by. Next to a 0 of the table that is more than `D` itself.
fn tabulated(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let d = Tabulated::new(p.table("table"));
    let steepest = d.values().windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    let value = d.d((l + v).normalize());
    if value <= f64::from(f32::MIN_POSITIVE) {
        return f64::INFINITY;
    }
    Bound::WORST + 160.0 * steepest / value * U
}

constructor! { facets: generator_of_table |p, finish, table| {
    // Where the nodes of Λ are dense: slopes from a tenth of this to ten times it.
    let width = Alpha(R::from_f64(0.5));
    let facets: Table<R> = SmithTable::new(Tabulated::new(p.table("table")), width);
    let lobe: AshikhminPremozeShirley<Table<R>, Schlick<R>> =
        Microfacet::new(facets, SmithSeparable, Schlick::new(p.rgb("f0")));
    table(lobe)
} }

/// One type for all: they differ in the distribution alone.
fn generate<D, F>(distribution: D, fresnel: F) -> AshikhminPremozeShirley<D, F> {
    Microfacet::new(distribution, SmithSeparable, fresnel)
}

constructor! { facets: generator |p, finish, table| {
    let (alpha, schlick) = (Alpha(p.number("width")), Schlick::new(p.rgb("f0")));
    match p.choice("distribution") {
        "beckmann" => finish(generate(Beckmann::new(alpha), schlick)),
        "blinn" => table(generate(SmithTable::<_, R>::new(PhongPower::new(alpha), alpha), schlick)),
        "gtr" => {
            let d = Gtr::new(alpha, p.number("gamma"));
            table(generate(SmithTable::<_, R>::new(d, alpha), schlick))
        }
        _ => finish(generate(Ggx::new(alpha), schlick)),
    }
} }
