//! The reflection of direct light as engines publish it.

use lobe::distribution::Ggx;
use lobe::fresnel::Schlick;
use lobe::masking::{Hammon, SmithCorrelated};
use lobe::{Alpha, Brdf, BurleyDiffuse, Lambert, Microfacet, PerceptualRoughness, Rgb, Vec3};
use lobe_energy::engines::{Brightened, Compensation, KarisMobile, MaterialX, Tabulated};

/// A material of metal and roughness, as engines have it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked {
    /// The base colour.
    pub base: Rgb<f64>,
    /// 0 for a dielectric with `F0 = 0.04`, 1 for a metal.
    pub metallic: f64,
    /// The perceptual roughness, `√α`.
    pub roughness: f64,
}

/// An engine's formula for direct light.
#[derive(Clone, Copy, Debug)]
pub struct Engine {
    /// Its name, and the versions that have it.
    pub name: &'static str,
    /// The terms, in a line.
    pub terms: &'static str,
    /// Where it is published.
    pub source: &'static str,
    /// What its authors say themselves.
    pub said: &'static str,
    /// The smallest perceptual roughness that it shades; smaller ones become this.
    pub least_roughness: f64,
    pub(super) build: fn(&Engine, Asked) -> Box<dyn Brdf<f64> + Send + Sync>,
}

impl Engine {
    /// The BRDF of a material.
    #[must_use]
    pub fn brdf(&self, asked: Asked) -> Box<dyn Brdf<f64> + Send + Sync> {
        (self.build)(self, asked)
    }

    fn alpha(&self, asked: Asked) -> Alpha<f64> {
        let roughness = asked.roughness.max(self.least_roughness);
        Alpha(roughness * roughness)
    }
}

/// `F0` of metal and dielectric, mixed, and what is left for the diffuse lobe: `base (1 − metallic)`.
fn blend(asked: Asked) -> (Rgb<f64>, Rgb<f64>) {
    let Asked { base, metallic, .. } = asked;
    (base.map(|base| 0.04 * (1.0 - metallic) + base * metallic), base.map(|base| base * (1.0 - metallic)))
}

/// The engines, in alphabetical order.
pub static ENGINES: &[Engine] = &[
    Engine {
        name: "bevy 0.12 to 0.18",
        terms: "GGX, Smith correlated, Schlick; times 1 + F0 (1/A − 1) with the scale A of Karis' fit; Burley's diffuse",
        source: "bevy_pbr, pbr_lighting.wgsl: specular_multiscatter, F_AB, Fd_Burley",
        said: "the polynomial is an approximation, and a table (the feature dfg_lut) more accurate",
        least_roughness: 0.089,
        build: |engine, asked| {
            let (f0, diffuse) = blend(asked);
            let specular = Brightened::new(engine.alpha(asked), f0, KarisMobile, Compensation::Scale);
            both(
                specular,
                BurleyDiffuse::new(diffuse, PerceptualRoughness(asked.roughness.max(engine.least_roughness))),
            )
        },
    },
    Engine {
        name: "Filament 1.x",
        terms: "GGX, Smith correlated, Schlick; times 1 + F0 (1/(A + B) − 1) by a table; Lambert",
        source: "Filament's documentation, sections 4.4 and 4.7; shading_model_standard.fs",
        said: "the compensation after Lagarde and Golubev 2018; nothing is taken from the diffuse lobe",
        least_roughness: 0.045,
        build: |engine, asked| {
            let (f0, diffuse) = blend(asked);
            both(Brightened::new(engine.alpha(asked), f0, Tabulated, Compensation::Sum), Lambert::new(diffuse))
        },
    },
    Engine {
        name: "Filament 1.x, mobile",
        terms: "GGX, Hammon's linear visibility, Schlick, no compensation; Lambert",
        source: "Filament's documentation, section 4.4.2: V_SmithGGXCorrelatedFast",
        said: "the visibility is \"mathematically wrong\" and good enough for real time on phones",
        least_roughness: 0.089,
        build: |engine, asked| {
            let ((f0, diffuse), alpha) = (blend(asked), engine.alpha(asked));
            both(Microfacet::new(Ggx::new(alpha), Hammon::new(alpha), Schlick::new(f0)), Lambert::new(diffuse))
        },
    },
    Engine {
        name: "glTF Sample Viewer",
        terms: "GGX, Smith correlated, Schlick; the diffuse lobe gets 1 − F of the half vector",
        source: "Khronos, glTF-Sample-Renderer, brdf.glsl; glTF 2.0, appendix B",
        said: "single scattering in direct light; further reflections in image-based light alone",
        least_roughness: 0.0,
        build: |engine, asked| {
            let alpha = engine.alpha(asked);
            Box::new(GltfViewer { asked, alpha })
        },
    },
    Engine {
        name: "Godot 4",
        terms: "GGX, Hammon's linear visibility, Schlick, no compensation; Burley's diffuse",
        source: "scene_forward_lights_inc.glsl: V_GGX, D_GGX, SchlickFresnel",
        said: "the visibility after Hammon, as in Earl Hammon's talk",
        least_roughness: 0.0,
        build: |engine, asked| {
            let ((f0, diffuse), alpha) = (blend(asked), engine.alpha(asked));
            let specular = Microfacet::new(Ggx::new(alpha), Hammon::new(alpha), Schlick::new(f0));
            both(specular, BurleyDiffuse::new(diffuse, PerceptualRoughness(asked.roughness)))
        },
    },
    Engine {
        name: "MaterialX 1.38 and later",
        terms: "GGX, Smith correlated, Schlick; times 1 + F0 (1/(A + B) − 1) by its rational fit; Lambert under 1 − E(v)",
        source: "mx_microfacet_specular.glsl: mx_ggx_dir_albedo_analytic, mx_ggx_energy_compensation",
        said: "\"rational quadratic fit to Monte Carlo data\"; a table and a Monte Carlo sum can be chosen in its place",
        least_roughness: 0.0,
        build: |engine, asked| {
            let alpha = engine.alpha(asked);
            Box::new(MaterialXLayer { asked, alpha })
        },
    },
    Engine {
        name: "three.js, to r180",
        terms: "GGX, Smith correlated, Schlick by an exponential, no compensation in direct light; Lambert",
        source: "lights_physical_pars_fragment.glsl.js, bsdfs.glsl.js",
        said: "further reflections (Fdez-Agüera) in image-based light alone",
        least_roughness: 0.0525,
        build: |engine, asked| {
            let alpha = engine.alpha(asked);
            Box::new(ThreeJs { asked, alpha })
        },
    },
    Engine {
        name: "Unity URP 10 and later",
        terms: "α²/(d² max(0.1, (l·h)²) (4α + 2)) F0, no Fresnel term in direct light; Lambert",
        source: "URP, BRDF.hlsl: DirectBRDFSpecular; Karis and Lazarov, \"Optimizing PBR for Mobile\", SIGGRAPH 2015 course",
        said: "\"minimalist\" Cook-Torrance; V and F are approximated together",
        least_roughness: 0.089,
        build: |engine, asked| {
            let alpha = engine.alpha(asked);
            Box::new(Urp { asked, alpha })
        },
    },
    Engine {
        name: "Unreal 4 and 5",
        terms: "GGX, Hammon's linear visibility, Schlick, no compensation by default; Lambert",
        source: "ShadingModels.ush, BRDF.ush: Vis_SmithJointApprox; Karis 2013",
        said: "an approximation of Smith's joint masking; energy conservation is an option of the project",
        least_roughness: 0.02,
        build: |engine, asked| {
            let ((f0, diffuse), alpha) = (blend(asked), engine.alpha(asked));
            both(Microfacet::new(Ggx::new(alpha), Hammon::new(alpha), Schlick::new(f0)), Lambert::new(diffuse))
        },
    },
];

/// What all of them approximate: GGX, Smith correlated, Schlick, once reflected.
#[must_use]
pub fn exact(asked: Asked) -> Microfacet<Ggx<f64>, SmithCorrelated, Schlick<f64>> {
    let alpha = Alpha(asked.roughness * asked.roughness);
    Microfacet::new(Ggx::new(alpha), SmithCorrelated, Schlick::new(blend(asked).0))
}

/// The sum of two lobes, and nothing between them.
fn both(
    specular: impl Brdf<f64> + Send + Sync + 'static,
    diffuse: impl Brdf<f64> + Send + Sync + 'static,
) -> Box<dyn Brdf<f64> + Send + Sync> {
    Box::new(Both(specular, diffuse))
}

struct Both<A, B>(A, B);

impl<A: Brdf<f64>, B: Brdf<f64>> Brdf<f64> for Both<A, B> {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.0.eval(l, v) + self.1.eval(l, v)
    }
    fn eval_cos(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.0.eval_cos(l, v) + self.1.eval_cos(l, v)
    }
}

/// `F` of white, `(1 − l·h)⁵`, is what the dielectric's diffuse lobe gets less.
struct GltfViewer {
    asked: Asked,
    alpha: Alpha<f64>,
}

impl Brdf<f64> for GltfViewer {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        let Asked { base, metallic, .. } = self.asked;
        let specular =
            |f0: Rgb<f64>| Microfacet::new(Ggx::new(self.alpha), SmithCorrelated, Schlick::new(f0)).eval(l, v);
        let cos = lobe::halfway(l, v).dot(l);
        let passed = 1.0 - (0.04 + 0.96 * (1.0 - cos).powi(5));
        let dielectric = Lambert::new(base).eval(l, v) * passed + specular(Rgb::splat(0.04));
        dielectric * (1.0 - metallic) + specular(base) * metallic
    }
}

/// The dielectric's diffuse lobe under the layer operator: `1 − E(v)` by the same fit.
struct MaterialXLayer {
    asked: Asked,
    alpha: Alpha<f64>,
}

impl Brdf<f64> for MaterialXLayer {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        use lobe_energy::engines::SplitSum as _;
        let Asked { base, metallic, .. } = self.asked;
        let specular = |f0: Rgb<f64>| Brightened::new(self.alpha, f0, MaterialX, Compensation::Sum).eval(l, v);
        let split = MaterialX.split(self.alpha, v.z.max(0.0));
        let sum = split.scale + split.bias;
        let albedo = (0.04 * split.scale + split.bias) * (1.0 + 0.04 * (1.0 / sum - 1.0));
        let dielectric = Lambert::new(base).eval(l, v) * (1.0 - albedo) + specular(Rgb::splat(0.04));
        dielectric * (1.0 - metallic) + specular(base) * metallic
    }
}

/// Schlick's term as `2^((−5.55473 c − 6.98316) c)` (Lagarde 2012).
struct ThreeJs {
    asked: Asked,
    alpha: Alpha<f64>,
}

impl Brdf<f64> for ThreeJs {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        let (f0, diffuse) = blend(self.asked);
        let white = Schlick::new(Rgb::splat(1.0));
        let shape = Microfacet::new(Ggx::new(self.alpha), SmithCorrelated, white).eval(l, v).g;
        let cos = lobe::halfway(l, v).dot(v);
        let weight = ((-5.55473 * cos - 6.98316) * cos).exp2();
        f0.map(|f0| (f0 * (1.0 - weight) + weight) * shape) + Lambert::new(diffuse).eval(l, v)
    }
}

/// The product of visibility and Fresnel as `1/(max(0.1, (l·h)²) (4α + 2))`.
struct Urp {
    asked: Asked,
    alpha: Alpha<f64>,
}

impl Brdf<f64> for Urp {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        if l.z.min(v.z) <= 0.0 {
            return Rgb::splat(0.0);
        }
        let (f0, diffuse) = blend(self.asked);
        let (h, alpha) = (lobe::halfway(l, v), self.alpha.0);
        // n·h by the vector: the engine's own 1 + 1e-5 in place of the last 1 is a guard of half precision.
        let d = alpha * alpha * h.z * h.z + h.x * h.x + h.y * h.y;
        let cos = l.dot(h);
        let specular = alpha * alpha / (d * d * (cos * cos).max(0.1) * (4.0 * alpha + 2.0));
        // Light is counted in units of π there: a white Lambert is 1.
        let per_sr = std::f64::consts::FRAC_1_PI;
        f0.map(|f0| f0 * specular * per_sr) + Lambert::new(diffuse).eval(l, v)
    }
}
