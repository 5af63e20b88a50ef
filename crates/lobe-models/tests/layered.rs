//! glTF and coats against the specification's own formulas, written down a second time, and against their energy.

mod common;

use common::directions;
use lobe::distribution::Ggx;
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Brdf, Charlie, Clearcoat, Coat, Lambert, MetallicRoughness, Microfacet, Rgb, SheenLayer, Vec3};
use lobe_energy::directional_albedo;

type V = Vec3<f64>;

/// Appendix B.2 and B.3 with the extensions, in cosines, as a shader has them.
struct Specification {
    base: [f64; 3],
    metallic: f64,
    alpha: f64,
    ior: f64,
    weight: f64,
    color: [f64; 3],
    anisotropy: f64,
}

impl Specification {
    fn eval(&self, l: V, v: V) -> [f64; 3] {
        let h = (l + v).normalize();
        let w = (1.0 - v.dot(h)).powi(5);
        let (at, ab) = (self.alpha + (1.0 - self.alpha) * self.anisotropy.powi(2), self.alpha);
        let d = {
            let f = [ab * h.x, at * h.y, at * ab * h.z];
            let w2 = at * ab / (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
            at * ab * w2 * w2 / core::f64::consts::PI
        };
        let visibility = if self.anisotropy == 0.0 {
            let a2 = self.alpha * self.alpha;
            let part = |c: f64| 1.0 / (c + (a2 + (1.0 - a2) * c * c).sqrt());
            part(l.z) * part(v.z)
        } else {
            let length = |u: V| ((at * u.x).powi(2) + (ab * u.y).powi(2) + u.z * u.z).sqrt();
            0.5 / (l.z * length(v) + v.z * length(l))
        };
        let f0 = self.color.map(|c| (((self.ior - 1.0) / (self.ior + 1.0)).powi(2) * c).min(1.0));
        let fresnel = f0.map(|f| f + (1.0 - f) * w);
        let largest = fresnel.into_iter().fold(0.0, f64::max);
        std::array::from_fn(|i| {
            let diffuse = self.base[i] / core::f64::consts::PI;
            let dielectric = (1.0 - self.weight * largest) * diffuse + self.weight * fresnel[i] * visibility * d;
            let metal = (self.base[i] + (1.0 - self.base[i]) * w) * visibility * d;
            (1.0 - self.metallic) * dielectric + self.metallic * metal
        })
    }
}

fn assert_near(ours: Rgb<f64>, theirs: [f64; 3], place: &str) {
    for (a, b) in <[f64; 3]>::from(ours).into_iter().zip(theirs) {
        assert!((a / b - 1.0).abs() < 1e-11, "{a} {b} {place}");
    }
}

#[test]
fn gltf_is_the_specification() {
    let (base, color) = ([0.8, 0.5, 0.2], [1.0, 0.6, 8.0]);
    let rgb = |c: [f64; 3]| Rgb::new(c[0], c[1], c[2]);
    for metallic in [0.0, 0.3, 1.0] {
        for roughness in [0.1_f64, 0.5, 1.0] {
            let alpha = roughness * roughness;
            for anisotropy in [0.0, 0.7] {
                let written = Specification { base, metallic, alpha, ior: 1.7, weight: 0.6, color, anisotropy };
                let plain =
                    MetallicRoughness::new(rgb(base), metallic, Alpha(alpha)).with_specular(1.7, 0.6, rgb(color));
                for l in directions() {
                    for v in directions() {
                        let ours = if anisotropy == 0.0 {
                            plain.eval(l, v)
                        } else {
                            plain.with_anisotropy(anisotropy).eval(l, v)
                        };
                        assert_near(
                            ours,
                            written.eval(l, v),
                            &format!("{metallic} {roughness} {anisotropy} {l:?} {v:?}"),
                        );
                    }
                }
            }
        }
    }
    // Without extensions f0 is 0.04.
    let plain = MetallicRoughness::new(rgb(base), 0.0, Alpha(0.25));
    let same = plain.with_specular(1.5, 1.0, Rgb::splat(1.0));
    let up = Vec3::new(0.0, 0.0, 1.0);
    assert_near(plain.eval(up, up), same.eval(up, up).into(), "default");
}

#[test]
fn clearcoat_is_the_specification_and_not_reciprocal() {
    let base = Lambert::new(Rgb::splat(0.5_f64));
    let (c, alpha) = (0.7, 0.04);
    let coated = Clearcoat::new(base, c, Alpha(alpha));
    let mut ratio = 1.0_f64;
    for l in directions() {
        for v in directions() {
            let h = (l + v).normalize();
            let a2 = alpha * alpha;
            let part = |c: f64| 1.0 / (c + (a2 + (1.0 - a2) * c * c).sqrt());
            let d = a2 / core::f64::consts::PI / (h.z * h.z * (a2 - 1.0) + 1.0).powi(2);
            let blend = c * (0.04 + 0.96 * (1.0 - v.z).powi(5));
            let theirs = (1.0 - blend) * 0.5 / core::f64::consts::PI + blend * d * part(l.z) * part(v.z);
            let f = coated.eval(l, v);
            assert!((f.g / theirs - 1.0).abs() < 1e-9, "{} {theirs}", f.g);
            ratio = ratio.max(f.g / coated.eval(v, l).g);
        }
    }
    assert!(ratio > 1.1, "the docs say that it is not reciprocal, and here it is within {ratio}");
    // Over black the ratio is that of the two Fresnel terms: 1/0.04 from grazing to normal.
    let black = Clearcoat::new(Lambert::new(Rgb::splat(0.0_f64)), 1.0, Alpha(0.5));
    let (up, grazing) = (Vec3::new(0.0, 0.0, 1.0), Vec3::new(1.0, 0.0, 1e-9));
    let ratio = black.eval(up, grazing).g / black.eval(grazing, up).g;
    assert!((ratio - 25.0).abs() < 1e-5, "{ratio}");
}

/// The promise of `Coat`: over a white base nothing is gained by more than a rough top exceeds its own interface.
#[test]
fn a_coat_keeps_the_energy() {
    let white = Lambert::new(Rgb::splat(1.0_f64));
    let mut worst = 0.0_f64;
    for f0 in [0.02, 0.04, 0.2] {
        for alpha in [0.02, 0.1, 0.3] {
            let interface = Schlick::new(Rgb::splat(f0));
            let top = Microfacet::new(Ggx::new(Alpha(alpha)), SmithCorrelated, interface);
            let coat = Coat::new(top, interface, white);
            for cos in [1.0_f64, 0.8, 0.5, 0.2, 0.05] {
                let v = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                let albedo = directional_albedo(&coat, v);
                worst = worst.max(albedo.value.g - albedo.error);
                // The base is seen through the coat twice: some is always lost, and at normal incidence little.
                assert!(albedo.value.g > 0.1, "{f0} {alpha} {cos}: {albedo:?}");
            }
        }
    }
    assert!(worst < 1.0, "albedo {worst}");
}

/// The base under a sheen is scaled by `1 − E`, so the scale tells the `E` of the table.
#[test]
fn the_sheen_knows_its_albedo() {
    let white = Lambert::new(Rgb::splat(1.0_f64));
    for (roughness, cos, allowed) in [
        (0.14, 0.5, 0.15),
        (0.25, 0.3, 0.01),
        (0.42, 0.09, 0.01),
        (0.42, 0.7, 0.01),
        (0.75, 0.5, 0.01),
        (1.0, 0.95, 0.01),
    ] {
        let alpha = Alpha(roughness * roughness);
        let v = Vec3::new((1.0_f64 - cos * cos).sqrt(), 0.0, cos);
        let sheen = Charlie::new(Rgb::splat(1.0), alpha);
        let layered = SheenLayer::new(white, Rgb::splat(1.0), alpha);
        // At l = v both factors are the same.
        let scale = (layered.eval(v, v).g - sheen.eval(v, v).g) * core::f64::consts::PI;
        let albedo = directional_albedo(&sheen, v).value.g;
        assert!((1.0 - scale - albedo).abs() < allowed, "{} {albedo} at {roughness} {cos}", 1.0 - scale);
    }
}
