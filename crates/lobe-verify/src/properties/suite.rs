//! The whole suite in one line of a user's tests.

/// Tests of all properties of a BRDF, one `#[test]` each, in a module of this name.
///
/// The second argument is an expression for anything that [`verify`](crate::properties::verify) takes. Claims other
/// than those of its kind follow as fields of [`Claims`](crate::properties::Claims).
///
/// ```
/// use lobe::{CommonNormalization, BlinnPhong, Lambert, Rgb, Shininess};
///
/// lobe_verify::suite!(paper, Lambert::new(Rgb::splat(0.8_f32)), isotropic: Some(64.0));
/// // Known to gain energy.
/// lobe_verify::suite!(
///     common_blinn_phong,
///     BlinnPhong::<f64, CommonNormalization>::with_normalization(Rgb::splat(1.0), Shininess(8.0)),
///     energy: false
/// );
/// # fn main() {}
/// ```
#[macro_export]
macro_rules! suite {
    ($name:ident, $subject:expr $(, $claim:ident: $value:expr)* $(,)?) => {
        #[cfg(test)]
        mod $name {
            #[allow(unused_imports, reason = "the expression may need none of them")]
            use super::*;

            fn holds(property: $crate::properties::Property) {
                let subject = $subject;
                let subject = $crate::subject::AsSubject::as_subject(&subject);
                #[allow(clippy::needless_update, reason = "all claims may be given")]
                let claims = $crate::properties::Claims {
                    $($claim: $value,)*
                    ..$crate::subject::Subject::claims(&*subject)
                };
                let verdict =
                    $crate::properties::check(&*subject, property, &claims, $crate::properties::Effort::QUICK);
                assert!(verdict.holds(), "{verdict}");
            }

            #[test]
            fn finite() {
                holds($crate::properties::Property::Finite);
            }
            #[test]
            fn not_negative() {
                holds($crate::properties::Property::NonNegative);
            }
            #[test]
            fn black_below_the_horizon() {
                holds($crate::properties::Property::BelowHorizon);
            }
            #[test]
            fn reciprocal() {
                holds($crate::properties::Property::Reciprocal);
            }
            #[test]
            fn isotropic() {
                holds($crate::properties::Property::Isotropic);
            }
            #[test]
            fn cosine() {
                holds($crate::properties::Property::Cosine);
            }
            #[test]
            fn continuous() {
                holds($crate::properties::Property::Continuous);
            }
            #[test]
            fn energy() {
                holds($crate::properties::Property::Energy);
            }
            #[test]
            fn nan_stays_nan() {
                holds($crate::properties::Property::Nan);
            }
        }
    };
}
