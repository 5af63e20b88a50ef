//! What is lost is given back: albedos of compensated lobes by quadrature, and the tables behind them.

use lobe::distribution::Ggx;
use lobe::fresnel::{Conductor, Dielectric, Fresnel, Incidence, Schlick};
use lobe::masking::SmithCorrelated;
use lobe::number::{Approximate, Coarse, Fast, Precision};
use lobe::{Alpha, Brdf, Carry, Ior, Microfacet, Real, Rgb, Vec3};
use lobe_energy::engines::{Brightened, Compensation, KarisMobile, MaterialX, SplitSum, Tabulated};
use lobe_energy::{
    AlbedoCoat, CoupledDiffuse, Even, FdezAguera, GgxAlbedo, GgxFit, GgxTable, KullaConty, Least, Turquin,
    average_fresnel, microfacet_albedo_to,
};

/// Between the nodes of the tables and on them, to the ends of the domain.
const WIDTHS: [f64; 8] = [1e-4, 1e-3, 0.01, 0.04, 0.2, 0.4, 0.7, 1.0];
const COSINES: [f64; 9] = [1e-4, 3e-4, 3e-3, 0.03, 0.15, 0.4, 0.7, 0.95, 1.0];

fn at(mu: f64) -> Vec3<f64> {
    Vec3::new(((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu)
}

fn albedo(lobe: &dyn Brdf<f64>, alpha: f64, mu: f64) -> Rgb<f64> {
    let found = microfacet_albedo_to(1e-5, lobe, (Alpha(alpha), Alpha(alpha)), at(mu));
    assert!(found.error < 1e-4, "{found:?} {alpha} {mu}");
    found.value
}

fn cases() -> impl Iterator<Item = (f64, f64)> {
    WIDTHS.into_iter().flat_map(|alpha| COSINES.map(|mu| (alpha, mu)))
}

fn single(alpha: f64, f0: Rgb<f64>) -> Microfacet<Ggx<f64>, SmithCorrelated, Schlick<f64>> {
    Microfacet::new(Ggx::new(Alpha(alpha)), SmithCorrelated, Schlick::new(f0))
}

#[test]
fn the_table_and_the_fit_are_near() {
    let (mut table, mut fit, mut weight) = ((0.0, (0.0, 0.0)), (0.0, (0.0, 0.0)), (0.0, (0.0, 0.0)));
    for (alpha, mu) in cases() {
        let exact = albedo(&single(alpha, Rgb::new(1.0, 0.0, 0.5)), alpha, mu);
        let (by_table, by_fit) = (GgxTable::new(Alpha(alpha)), GgxFit::new(Alpha(alpha)));
        let worse = |worst: &mut (f64, (f64, f64)), error: f64| {
            if error.abs() > worst.0 {
                *worst = (error.abs(), (alpha, mu));
            }
        };
        worse(&mut table, 1.0 - by_table.loss(mu) - exact.r);
        worse(&mut fit, 1.0 - by_fit.loss(mu) - exact.r);
        worse(&mut weight, by_table.fresnel_weight(mu) - exact.g / exact.r);
    }
    println!("table {table:?}, fit {fit:?}, weight {weight:?}");
    assert!(table.0 < 1.5e-3 && fit.0 < 5e-4 && weight.0 < 7e-3, "table {table:?}, fit {fit:?}, weight {weight:?}");
}

#[test]
fn a_white_metal_is_white() {
    let white = Schlick::new(Rgb::splat(1.0));
    let (mut kulla, mut table, mut turquin) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (alpha, mu) in cases() {
        let error = |lobe: &dyn Brdf<f64>| (albedo(lobe, alpha, mu).g - 1.0).abs();
        kulla = kulla.max(error(&KullaConty::<_, f64>::new(Alpha(alpha), white)));
        // Some dozen times the points of a second: the table is slow.
        if mu < 1e-3 {
            table = table.max(error(&KullaConty::<_, f64, GgxTable<f64>>::new(Alpha(alpha), white)));
        }
        turquin = turquin.max(error(&Turquin::<_, f64>::new(Alpha(alpha), white)));
    }
    println!("Kulla-Conty {kulla:e}, by the table {table:e}; Turquin {turquin:e}");
    assert!(kulla < 6e-4 && table < 1.5e-3 && turquin < 1.2e-3, "{kulla:e} {table:e} {turquin:e}");
    // Without it half of the light is gone.
    assert!(albedo(&single(1.0, Rgb::splat(1.0)), 1.0, 1.0).g < 0.31);
}

/// Coloured metals and dielectrics gain nothing that was not lost: between the single reflection and white.
#[test]
fn colours_stay_between_one_reflection_and_white() {
    let gold = Schlick::new(Rgb::new(1.0, 0.77, 0.34));
    let glass = Dielectric::new(Ior(1.5));
    for (alpha, mu) in cases().filter(|(alpha, mu)| *alpha > 0.05 && *mu > 0.1) {
        let metal = albedo(&KullaConty::<_, f64>::new(Alpha(alpha), gold), alpha, mu);
        let lost = albedo(&single(alpha, Rgb::new(1.0, 0.77, 0.34)), alpha, mu);
        assert!(metal.r < 1.001 && metal.r > metal.g && metal.g > metal.b);
        assert!(metal.b >= lost.b - 1e-9 && metal.g >= lost.g - 1e-9);
        let once = Microfacet::new(Ggx::new(Alpha(alpha)), SmithCorrelated, glass);
        let [once, more] =
            [albedo(&once, alpha, mu).g, albedo(&KullaConty::<_, f64>::new(Alpha(alpha), glass), alpha, mu).g];
        // Of what glass reflects once it reflects little again.
        assert!(once <= more && more < once + 0.01, "{alpha} {mu}: {once} {more}");
    }
}

#[test]
fn the_mean_of_fresnel() {
    fn exact(fresnel: &impl Fresnel<f64>) -> f64 {
        // By Simpson's rule in the root of the cosine.
        let steps = 20_000;
        let f = |i: i32| {
            let t = f64::from(i) / f64::from(steps);
            fresnel.fresnel(Incidence::from_cos(t * t)).g * 4.0 * t * t * t
        };
        (0..steps / 2).map(|i| f(2 * i) + 4.0 * f(2 * i + 1) + f(2 * i + 2)).sum::<f64>() / f64::from(3 * steps)
    }
    for f0 in [0.0_f64, 0.04, 0.5, 1.0] {
        let schlick = Schlick::new(Rgb::splat(f0));
        let closed = f0 + (1.0 - f0) / 21.0;
        assert!((average_fresnel(&schlick, 1.0).g - closed).abs() < 1e-5, "{f0}");
        assert!((exact(&schlick) - closed).abs() < 1e-9);
    }
    for eta in [1.1, 1.5, 2.0, 3.0] {
        let glass = Dielectric::new(Ior(eta));
        let error = average_fresnel(&glass, 1.0).g - exact(&glass);
        assert!(error.abs() < 1e-4, "{eta}: {error:e}");
    }
    // Glass under an even sky, as textbooks have it.
    assert!((average_fresnel(&Dielectric::new(Ior(1.5)), 1.0_f64).g - 0.0918).abs() < 2e-4);
    for (eta, k) in [(0.2, 3.0), (1.5, 7.0), (2.9, 3.1)] {
        let metal = Conductor::new(Rgb::splat(eta), Rgb::splat(k));
        let error = average_fresnel(&metal, 1.0).g - exact(&metal);
        assert!(error.abs() < 1e-4, "{eta} {k}: {error:e}");
    }
}

#[test]
fn a_white_base_makes_a_white_whole() {
    let (mut coupled, mut fdez) = (0.0_f64, 0.0_f64);
    // The tables are the slowest lobes there are: the ends and the middle, each channel another F0.
    let widths = [1e-4, 1e-3, 0.04, 0.4, 1.0];
    for (alpha, mu) in widths.into_iter().flat_map(|alpha| [3e-3, 0.03, 0.4, 1.0].map(|mu| (alpha, mu))) {
        let error = |lobe: &dyn Brdf<f64>| {
            let albedo = albedo(lobe, alpha, mu);
            (albedo.r - 1.0).abs().max((albedo.g - 1.0).abs())
        };
        let f0 = if mu < 0.1 { 0.04 } else { 0.17 };
        coupled = coupled.max(error(&CoupledDiffuse::new(Alpha(alpha), f0, Rgb::splat(1.0))));
        fdez = fdez.max(error(&FdezAguera::new(Alpha(alpha), Rgb::new(0.04, 0.17, 1.0), Rgb::splat(1.0))));
    }
    println!("coupled {coupled:e}, Fdez-Agüera {fdez:e}");
    assert!(coupled < 7e-3 && fdez < 7e-3, "{coupled:e} {fdez:e}");
    // The usual sum of both gains what the specular lobe reflects.
    let plain = lobe::Lambert::new(Rgb::splat(1.0)) + single(0.3, Rgb::splat(0.04));
    assert!(albedo(&plain, 0.3, 0.1).g > 1.1);
}

/// The table in the documentation of `AlbedoCoat`: the least and the largest albedo of a coat over a white base.
#[test]
fn coats_over_white_bases() {
    let white = Rgb::splat(1.0_f64);
    let metal: KullaConty<_, f64> = KullaConty::new(Alpha(0.3), Schlick::new(white));
    let matte = lobe::Lambert::new(white);
    let mut rows = [(f64::INFINITY, 0.0_f64); 6];
    for (alpha, f0) in [(0.01, 0.17), (0.1, 0.04), (0.3, 0.17), (1.0, 0.04), (1.0, 0.17)] {
        for mu in [0.03, 0.6, 1.0] {
            let (width, term) = (Alpha(alpha), Schlick::new(Rgb::splat(f0)));
            let top = Microfacet::new(Ggx::new(width), SmithCorrelated, term);
            let lobes: [&dyn Brdf<f64>; 6] = [
                &AlbedoCoat::<_, Even, f64>::new(width, f0, matte),
                &AlbedoCoat::<_, Least, f64>::new(width, f0, matte),
                &lobe::Coat::new(top, term, matte),
                &AlbedoCoat::<_, Even, f64>::new(width, f0, metal),
                &AlbedoCoat::<_, Least, f64>::new(width, f0, metal),
                &lobe::Coat::new(top, term, metal),
            ];
            for (row, lobe) in rows.iter_mut().zip(lobes) {
                let albedo = albedo(lobe, alpha, mu).g;
                *row = (row.0.min(albedo), row.1.max(albedo));
            }
        }
    }
    println!("Lambert: even, least, coat; metal: the same: {rows:.3?}");
    let [even, least, coat, even_metal, least_metal, coat_metal] = rows;
    // One is CoupledDiffuse.
    let (l, v) = (at(0.3), at(0.8));
    let same = CoupledDiffuse::new(Alpha(0.3), 0.04, white).eval(l, v).g;
    let one = AlbedoCoat::<_, Even, f64>::new(Alpha(0.3), 0.04, matte).eval(l, v).g;
    assert!((one / same - 1.0).abs() < 1e-12);
    let within = |(low, high): (f64, f64), least: f64, most: f64| low > least && high < most;
    assert!(within(even, 0.997, 1.004) && within(even_metal, 0.97, 1.025), "{even:?} {even_metal:?}");
    assert!(within(least, 0.95, 1.004) && within(least_metal, 0.95, 1.004), "{least:?} {least_metal:?}");
    assert!(within(coat, 0.19, 0.95) && within(coat_metal, 0.18, 0.95), "{coat:?} {coat_metal:?}");
}

/// In `f32` as in `f64`, the same both ways to the last bit, black below the horizon, NaN for NaN.
#[test]
fn the_lobes_keep_what_lobes_promise() {
    let directions = [at(1.0), at(0.7), at(0.2), at(1e-3), Vec3::new(0.0, 0.6, 0.8), Vec3::new(-0.6, 0.0, 0.8)];
    let single = |v: Vec3<f64>| Vec3::new(v.x as f32, v.y as f32, v.z as f32);
    for alpha in [1e-4_f32, 0.01, 0.3, 1.0] {
        let gold = Schlick::new(Rgb::new(1.0, 0.77, 0.34_f32));
        let metal: KullaConty<_> = KullaConty::new(Alpha(alpha), gold);
        let wide = metal.carry(&f64::from);
        let bright: Turquin<_> = Turquin::new(Alpha(alpha), gold);
        let both = FdezAguera::new(Alpha(alpha), Rgb::splat(0.04), Rgb::splat(0.5_f32));
        let base = CoupledDiffuse::new(Alpha(alpha), 0.04, Rgb::splat(0.5_f32));
        let coat: AlbedoCoat<_> = AlbedoCoat::new(Alpha(alpha), 0.04, metal);
        let even: AlbedoCoat<_, Even> = AlbedoCoat::new(Alpha(alpha), 0.04, metal);
        for l in directions.map(single) {
            for v in directions.map(single) {
                assert_eq!(metal.eval(l, v), metal.eval(v, l));
                assert_eq!(base.eval(l, v), base.eval(v, l));
                assert_eq!(coat.eval(l, v), coat.eval(v, l));
                assert_eq!(even.eval(l, v), even.eval(v, l));
                let exact = wide.eval_cos(l.map(f64::from), v.map(f64::from)).g;
                let found = f64::from(metal.eval_cos(l, v).g);
                assert!((found - exact).abs() <= 2e-5 * exact + 1e-30, "{alpha} {l:?} {v:?}: {found} {exact}");
                for lobe in [&metal as &dyn Brdf<f32>, &bright, &both, &base, &coat, &even] {
                    let f = lobe.eval(l, v);
                    assert!(f.g >= 0.0 && f.g.is_finite(), "{alpha} {l:?} {v:?} {f:?}");
                    let below = Vec3::new(l.x, l.y, -l.z);
                    assert_eq!(lobe.eval(below, v), Rgb::splat(0.0));
                    assert_eq!(lobe.eval(v, below), Rgb::splat(0.0));
                    let broken = Vec3::new(f32::NAN, l.y, l.z);
                    assert!(lobe.eval(broken, v).b.is_nan() && lobe.eval(v, broken).b.is_nan());
                }
            }
        }
    }
}

/// In `f32` as in `f64`, to the last cosine: the table to all digits, the polynomial to those of its terms.
#[test]
fn losses_keep_their_digits_at_the_horizon() {
    for alpha in WIDTHS.map(|alpha| alpha as f32) {
        let (table, fit): (GgxTable, GgxFit) = (GgxTable::new(Alpha(alpha)), GgxFit::new(Alpha(alpha)));
        let (exact, polynomial) = (GgxTable::new(Alpha(f64::from(alpha))), GgxFit::new(Alpha(f64::from(alpha))));
        for mu in [f32::MIN_POSITIVE, 1e-30, 1e-20, 1e-8, 1e-4, 0.01, 0.3, 1.0] {
            let wide = f64::from(mu);
            let (found, loss) = (f64::from(table.loss(mu)), exact.loss(wide));
            assert!((found - loss).abs() <= 1e-5 * loss, "{alpha} {mu}: {found:e} {loss:e}");
            let (found, through) = (f64::from(table.through_weight(mu)), exact.through_weight(wide));
            // At 1 the weight of rough facets is 0.05 and that of sharp ones 0.
            assert!((found - through).abs() <= 1e-5 * through, "{alpha} {mu}: {found:e} {through:e}");
            let corner = lobe_energy::Corner::new(f64::from(alpha), wide);
            let error = (f64::from(fit.loss(mu)) - polynomial.loss(wide)).abs();
            assert!(error <= 5e-7 * corner.x * corner.scale, "{alpha} {mu}: {error:e}");
            assert!(fit.loss(mu) >= 0.0);
        }
    }
}

/// In numbers with fewer digits too: their quotients and roots as scalars are exact, so the losses are the same.
#[test]
fn losses_of_rough_numbers_are_near() {
    fn worst<P: Precision>() -> f64
    where
        Approximate<f32, P>: Real,
    {
        let rough = |x: f32| Approximate::<f32, P>::new(x);
        let mut worst = 0.0_f64;
        for (alpha, mu) in cases().map(|(alpha, mu)| (alpha as f32, mu as f32)).filter(|(_, mu)| *mu > 0.01) {
            let (table, fit): (GgxTable, GgxFit) = (GgxTable::new(Alpha(alpha)), GgxFit::new(Alpha(alpha)));
            let found = [table.carry(&rough).loss(rough(mu)), fit.carry(&rough).loss(rough(mu))];
            for (found, exact) in found.into_iter().zip([table.loss(mu), fit.loss(mu)]) {
                worst = worst.max(f64::from((found.value() - exact).abs() / exact));
            }
        }
        worst
    }
    let (fast, coarse) = (worst::<Fast>(), worst::<Coarse>());
    println!("fast {fast:.1e}, coarse {coarse:.1e}");
    assert!(fast < 1e-6 && coarse < 1e-6, "{fast:e} {coarse:e}");
}

/// What the polynomial's bound and the sum for the base are for: without the one this is negative, without the other
/// noise.
#[test]
fn little_is_not_lost() {
    let at = |mu: f32| Vec3::new((1.0 - mu * mu).sqrt(), 0.0, mu);
    // Of a term that is 0 along the half vector nothing but further reflections is left.
    let black = Schlick::with_f90(Rgb::splat(0.0), Rgb::splat(1.0_f32));
    for alpha in (1..1000).map(|i| i as f32 / 1000.0) {
        let metal: KullaConty<_> = KullaConty::new(Alpha(alpha), black);
        for mu in [1e-12, 1e-8, 1e-4, 0.1] {
            let f = metal.eval(at(0.08), at(mu)).g;
            assert!(f >= 0.0, "{alpha} {mu}: {f:e}");
        }
    }
    // A base under a mirror, far from the mirror direction.
    for alpha in (100..400).map(|i| i as f32 * 1e-6) {
        let mirror = FdezAguera::new(Alpha(alpha), Rgb::splat(1.0), Rgb::splat(1.0));
        for mu in [0.2, 0.3, 0.5, 0.7] {
            let f = f64::from(mirror.eval(at(mu), at(mu)).g);
            let exact = mirror.carry(&f64::from).eval(at(mu).map(f64::from), at(mu).map(f64::from)).g;
            assert!((f - exact).abs() <= 2e-5 * exact, "{alpha} {mu}: {f:e} {exact:e}");
        }
    }
}

/// How far what engines use is from the integral: the figures of the documentation.
#[test]
fn the_splits_of_engines_are_off_by_a_known_part() {
    let worst = |split: &dyn Fn(Alpha<f64>, f64) -> (f64, f64)| {
        let mut worst = (0.0_f64, 0.0_f64);
        for alpha in [0.01, 0.05, 0.1, 0.25, 0.5, 0.8, 1.0] {
            for mu in [0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0] {
                let exact = albedo(&single(alpha, Rgb::new(1.0, 0.0, 0.5)), alpha, mu);
                let (scale, bias) = split(Alpha(alpha), mu);
                worst.0 = worst.0.max((scale + bias - exact.r).abs());
                worst.1 = worst.1.max((bias - exact.g).abs());
            }
        }
        worst
    };
    macro_rules! of {
        ($split:expr) => {
            worst(&|alpha, mu| {
                let split = $split.split(alpha, mu);
                (split.scale, split.bias)
            })
        };
    }
    let (table, karis, material_x) = (of!(Tabulated), of!(KarisMobile), of!(MaterialX));
    println!("sum and bias: table {table:?}, Karis {karis:?}, MaterialX {material_x:?}");
    assert!(table.0 < 1.5e-3 && table.1 < 7e-3, "{table:?}");
    assert!(karis.0 > 0.05 && karis.0 < 0.5, "{karis:?}");
    assert!(material_x.0 < 0.1, "{material_x:?}");
    // Compensated with it, a white metal is far from white; with the table it is white.
    let with = |compensation| {
        let lobe = Brightened::new(Alpha(1.0), Rgb::splat(1.0), Tabulated, compensation);
        albedo(&lobe, 1.0, 0.5).g
    };
    assert!((with(Compensation::Sum) - 1.0).abs() < 1e-3);
    assert!(with(Compensation::Without) < 0.5 && with(Compensation::Scale) > 1.0);
}
