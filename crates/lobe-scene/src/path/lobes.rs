//! From the lobes of a material to what can be sampled: the one place that knows which lobe has which sampler.

use crate::gltf_material::{AtPoint, GltfMaterial};
use crate::material::Surface;
use lobe::distribution::GgxAnisotropic;
use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
use lobe::masking::SmithCorrelated;
use lobe::{
    Alpha, Black, BlinnPhong, Brdf, Clearcoat, Lambert, MetallicRoughness, Mirror, Phong, Rgb, SheenLayer, Sum, Vec3,
};
use lobe_sampling::map::cosine_hemisphere;
use lobe_sampling::{Sample, Sampled};
use std::f32::consts::{FRAC_1_PI, PI};

type Anisotropic = MetallicRoughness<f32, SmithCorrelated, GgxAnisotropic>;

/// A lobe at a point, as a value: nothing is allocated.
pub(crate) enum Lobe<'a> {
    Diffuse(Lambert),
    BlinnTorrance(ByCosine<Sum<Lambert, BlinnTorranceHighlight>>),
    LecturePhong(ByCosine<Sum<Lambert, PhongHighlight>>),
    Phong(ByCosine<Sum<Lambert, Phong>>),
    BlinnPhong(ByCosine<Sum<Lambert, BlinnPhong>>),
    Gltf(ByCosine<MetallicRoughness>),
    Anisotropic(ByCosine<Anisotropic>),
    Sheen(ByCosine<SheenLayer<MetallicRoughness>>),
    AnisotropicSheen(ByCosine<SheenLayer<Anisotropic>>),
    Coat(ByCosine<Clearcoat<Black>>),
    Any(ByCosine<&'a dyn Brdf<f32>>),
    Mirror(AsDelta),
}

impl<'a> Lobe<'a> {
    /// The lobes of a surface that is the same everywhere; none for one that reflects nothing, and for one whose lobes are known
    /// only at a point.
    pub(crate) fn of(surface: &'a Surface) -> Option<Self> {
        Some(match surface {
            Surface::Diffuse(lobe) => Self::Diffuse(*lobe),
            Surface::BlinnTorrance(lobes) => Self::BlinnTorrance(ByCosine(*lobes)),
            Surface::Phong(lobes) => Self::LecturePhong(ByCosine(*lobes)),
            Surface::NormalizedPhong(lobes) => Self::Phong(ByCosine(*lobes)),
            Surface::NormalizedBlinnPhong(lobes) => Self::BlinnPhong(ByCosine(*lobes)),
            Surface::Lobes(lobes) => Self::Any(ByCosine(lobes.brdf())),
            Surface::Other(lobes) => Self::Any(ByCosine(&**lobes)),
            Surface::Black | Surface::Gltf(_) | Surface::Mapped(_) => return None,
        })
    }

    /// The base of a material of glTF at a point, without its coat.
    pub(crate) fn of_gltf(gltf: &GltfMaterial, at: &AtPoint) -> Self {
        let base = MetallicRoughness::new(at.base_color, at.metallic, Alpha(at.alpha));
        let base = base.with_specular(gltf.factors.ior, at.specular, at.specular_color);
        let sheen = (at.sheen_color, Alpha(at.sheen_alpha));
        match (gltf.is_anisotropic(), gltf.has_sheen()) {
            (false, false) => Self::Gltf(ByCosine(base)),
            (true, false) => Self::Anisotropic(ByCosine(base.with_anisotropy(at.anisotropy))),
            (false, true) => Self::Sheen(ByCosine(SheenLayer::new(base, sheen.0, sheen.1))),
            (true, true) => {
                let base = base.with_anisotropy(at.anisotropy);
                Self::AnisotropicSheen(ByCosine(SheenLayer::new(base, sheen.0, sheen.1)))
            }
        }
    }

    /// The coat alone.
    pub(crate) fn of_coat(at: &AtPoint) -> Self {
        Self::Coat(ByCosine(coat(at)))
    }

    pub(crate) fn of_mirror(mirror: Mirror) -> Self {
        Self::Mirror(AsDelta(mirror))
    }

    pub(crate) fn sampler(&self) -> &dyn Sample<f32> {
        match self {
            Self::Diffuse(lobe) => lobe,
            Self::BlinnTorrance(lobe) => lobe,
            Self::LecturePhong(lobe) => lobe,
            Self::Phong(lobe) => lobe,
            Self::BlinnPhong(lobe) => lobe,
            Self::Gltf(lobe) => lobe,
            Self::Anisotropic(lobe) => lobe,
            Self::Sheen(lobe) => lobe,
            Self::AnisotropicSheen(lobe) => lobe,
            Self::Coat(lobe) => lobe,
            Self::Any(lobe) => lobe,
            Self::Mirror(lobe) => lobe,
        }
    }
}

/// The coat of a material of glTF, with nothing below it.
pub(crate) fn coat(at: &AtPoint) -> Clearcoat<Black> {
    Clearcoat::new(Black, at.coat, Alpha(at.coat_alpha))
}

/// Any lobe, sampled by the cosine: right for each, and noisy for a sharp one.
pub(crate) struct ByCosine<B>(pub(crate) B);

impl<B: Brdf<f32>> Sample<f32> for ByCosine<B> {
    fn sample(&self, v: Vec3, [_, x, y]: [f32; 3]) -> Sampled<f32> {
        let l = cosine_hemisphere([x, y]);
        // `eval_cos` by the density, whose cosines have cancelled.
        Sampled::new(l, self.0.eval(l, v) * PI, l.z * FRAC_1_PI, v.z <= 0.0 || l.z <= 0.0)
    }

    fn pdf(&self, l: Vec3, v: Vec3) -> f32 {
        if v.z <= 0.0 || l.z <= 0.0 { 0.0 } else { l.z * FRAC_1_PI }
    }

    fn eval_cos_pdf(&self, l: Vec3, v: Vec3) -> (Rgb, f32) {
        (self.0.eval_cos(l, v), self.pdf(l, v))
    }

    /// Nothing is known of the lobe.
    fn albedo_guess(&self, _: Vec3) -> f32 {
        0.5
    }
}

/// A mirror, as a sampler of its one direction.
pub(crate) struct AsDelta(Mirror);

impl Sample<f32> for AsDelta {
    fn sample(&self, v: Vec3, _: [f32; 3]) -> Sampled<f32> {
        let seen = self.0.reflect(v);
        Sampled { l: seen.l, weight: seen.weight, pdf: 0.0, rejected: v.z <= 0.0, delta: true }
    }

    fn pdf(&self, _: Vec3, _: Vec3) -> f32 {
        0.0
    }

    fn eval_cos_pdf(&self, _: Vec3, _: Vec3) -> (Rgb, f32) {
        (Rgb::splat(0.0), 0.0)
    }

    fn albedo_guess(&self, _: Vec3) -> f32 {
        self.0.ks().luminance()
    }
}
