//! From the lobes of a material to what can be sampled: the one place that knows which lobe has which sampler.

use crate::gltf_material::{AtPoint, GltfMaterial};
use crate::material::Surface;
use lobe::distribution::GgxAnisotropic;
use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Black, BlinnPhong, Clearcoat, Lambert, MetallicRoughness, Mirror, Phong, SheenLayer, Sum};
use lobe_sampling::Sample;

type Anisotropic = MetallicRoughness<f32, SmithCorrelated, GgxAnisotropic>;

/// A lobe at a point, as a value: nothing is allocated, and what is behind a pointer was built with the material.
pub(crate) enum Lobe<'a> {
    Diffuse(Lambert),
    BlinnTorrance(Sum<Lambert, BlinnTorranceHighlight>),
    LecturePhong(Sum<Lambert, PhongHighlight>),
    Phong(Sum<Lambert, Phong>),
    BlinnPhong(Sum<Lambert, BlinnPhong>),
    Gltf(MetallicRoughness),
    Anisotropic(Anisotropic),
    Sheen(SheenLayer<MetallicRoughness>),
    AnisotropicSheen(SheenLayer<Anisotropic>),
    Coat(Clearcoat<Black>),
    Any(&'a dyn Sample<f32>),
    Mirror(Mirror),
}

impl<'a> Lobe<'a> {
    /// The lobes of a surface that is the same everywhere; none for one that reflects nothing, and for one whose lobes are known
    /// only at a point.
    pub(crate) fn of(surface: &'a Surface) -> Option<Self> {
        Some(match surface {
            Surface::Diffuse(lobe) => Self::Diffuse(*lobe),
            Surface::BlinnTorrance(lobes) => Self::BlinnTorrance(*lobes),
            Surface::Phong(lobes) => Self::LecturePhong(*lobes),
            Surface::NormalizedPhong(lobes) => Self::Phong(*lobes),
            Surface::NormalizedBlinnPhong(lobes) => Self::BlinnPhong(*lobes),
            Surface::Lobes(lobes) => Self::Any(lobes.sampler()),
            Surface::Other(lobes) => Self::Any(&**lobes),
            Surface::Black | Surface::Gltf(_) | Surface::Mapped(_) => return None,
        })
    }

    /// The base of a material of glTF at a point, without its coat.
    pub(crate) fn of_gltf(gltf: &GltfMaterial, at: &AtPoint) -> Self {
        let base = MetallicRoughness::new(at.base_color, at.metallic, Alpha(at.alpha));
        let base = base.with_specular(gltf.factors.ior, at.specular, at.specular_color);
        let sheen = (at.sheen_color, Alpha(at.sheen_alpha));
        match (gltf.is_anisotropic(), gltf.has_sheen()) {
            (false, false) => Self::Gltf(base),
            (true, false) => Self::Anisotropic(base.with_anisotropy(at.anisotropy)),
            (false, true) => Self::Sheen(SheenLayer::new(base, sheen.0, sheen.1)),
            (true, true) => {
                Self::AnisotropicSheen(SheenLayer::new(base.with_anisotropy(at.anisotropy), sheen.0, sheen.1))
            }
        }
    }

    /// The coat alone: it has a normal of its own, so it is no [`Clearcoat`] over the base.
    pub(crate) fn of_coat(at: &AtPoint) -> Self {
        Self::Coat(coat(at))
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
            Self::Any(lobe) => *lobe,
            Self::Mirror(lobe) => lobe,
        }
    }
}

/// The coat of a material of glTF, with nothing below it.
pub(crate) fn coat(at: &AtPoint) -> Clearcoat<Black> {
    Clearcoat::new(Black, at.coat, Alpha(at.coat_alpha))
}
