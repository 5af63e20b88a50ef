//! The statistics in one line of a user's tests.

/// Tests of all properties of a sampler, one `#[test]` each, in a module of this name.
///
/// The second argument is an expression for anything that [`verify`](crate::sampling::verify) takes; it is asked once
/// for all tests. Seeds come from the path of the module. Claims other than those of its kind follow as fields of
/// [`Claims`](crate::sampling::Claims).
///
/// ```
/// use lobe::{Lambert, Rgb};
///
/// lobe_verify::sampling_suite!(paper, Lambert::new(Rgb::splat(0.8_f32)));
/// lobe_verify::sampling_suite!(card, Lambert::new(Rgb::splat(0.5_f64)), weight: Some(1e-12), grazing: 1e-3);
/// # fn main() {}
/// ```
#[macro_export]
macro_rules! sampling_suite {
    ($name:ident, $sampler:expr $(, $claim:ident: $value:expr)* $(,)?) => {
        #[cfg(test)]
        mod $name {
            #[allow(unused_imports, reason = "the expression may need none of them")]
            use super::*;

            fn holds(properties: &[$crate::sampling::Property]) {
                static REPORT: ::std::sync::OnceLock<$crate::sampling::Report> = ::std::sync::OnceLock::new();
                let report = REPORT.get_or_init(|| {
                    let sampler = $sampler;
                    let sampler = $crate::sampling::AsSampler::as_sampler(&sampler);
                    #[allow(clippy::needless_update, reason = "all claims may be given")]
                    let claims = $crate::sampling::Claims {
                        $($claim: $value,)*
                        ..$crate::sampling::Sampler::claims(&*sampler)
                    };
                    let views = $crate::sampling::views();
                    let effort = $crate::sampling::Effort::QUICK;
                    $crate::sampling::verify_with(module_path!(), &&*sampler, &claims, &views, effort)
                });
                for view in &report.views {
                    for verdict in &view.verdicts {
                        let broken = matches!(verdict.outcome, $crate::sampling::Outcome::Broken(_));
                        let asked = properties.contains(&verdict.property) || broken;
                        assert!(verdict.holds() || !asked, "{verdict}");
                    }
                }
            }

            #[test]
            fn finite() {
                holds(&[$crate::sampling::Property::Finite]);
            }
            #[test]
            fn rejected_below_the_horizon() {
                holds(&[$crate::sampling::Property::BelowHorizon]);
            }
            #[test]
            fn nan_stays_nan() {
                holds(&[$crate::sampling::Property::Nan]);
            }
            #[test]
            fn comes_with_its_density() {
                holds(&[$crate::sampling::Property::Density]);
            }
            #[test]
            fn weight_is_value_over_density() {
                holds(&[$crate::sampling::Property::Weight]);
            }
            #[test]
            fn density_is_normalised() {
                holds(&[$crate::sampling::Property::Normalised, $crate::sampling::Property::Rejection]);
            }
            #[test]
            fn samples_are_distributed_as_the_density() {
                holds(&[
                    $crate::sampling::Property::Fit,
                    $crate::sampling::Property::Polar,
                    $crate::sampling::Property::Azimuth,
                ]);
            }
            #[test]
            fn mean_weight_is_the_albedo() {
                holds(&[$crate::sampling::Property::MeanWeight, $crate::sampling::Property::Albedo]);
            }
        }
    };
}
