//! The material of glTF 2.0, whose numbers may come from textures: what it is at a point, and how many points of it are
//! shaded at once.

use crate::texture::Map;
use glam::{Vec2, Vec3};
use lobe::batch::Kernel;
use lobe::{Alpha, Black, Brdf, Clearcoat, MetallicRoughness, Real, Rgb, SheenLayer};
use lobe_energy::engines::{KarisMobile, SplitSum};

/// The numbers of a material. The defaults are those of the specification: without an extension it leaves no trace.
#[derive(Debug, Clone, PartialEq)]
pub struct Factors {
    /// Linear RGB, in `[0, 1]`.
    pub base_color: [f32; 3],
    /// The fourth part of the base colour.
    pub opacity: f32,
    /// 0 dielectric, 1 metal.
    pub metallic: f32,
    /// The perceptual roughness, whose square is `α`; below 0.01 it counts as 0.01.
    pub roughness: f32,
    /// `emissiveFactor` times `KHR_materials_emissive_strength`.
    pub emission: [f32; 3],
    /// What the x and y of the normal map are multiplied with.
    pub normal_scale: f32,
    /// How much of the occlusion map is felt.
    pub occlusion_strength: f32,
    /// `KHR_materials_ior`: 0, which reflects everything, or from 1.
    pub ior: f32,
    /// `KHR_materials_specular`: the weight of what the dielectric reflects.
    pub specular: f32,
    /// And its colour at normal incidence.
    pub specular_color: [f32; 3],
    /// `KHR_materials_anisotropy`: the strength.
    pub anisotropy: f32,
    /// In radians, counter-clockwise from the tangent.
    pub anisotropy_rotation: f32,
    /// `KHR_materials_clearcoat`: the intensity.
    pub clearcoat: f32,
    /// Its perceptual roughness.
    pub clearcoat_roughness: f32,
    /// What the x and y of its own normal map are multiplied with.
    pub clearcoat_normal_scale: f32,
    /// `KHR_materials_sheen`: the colour; black is none.
    pub sheen_color: [f32; 3],
    /// Its perceptual roughness; below 0.1 it counts as 0.1.
    pub sheen_roughness: f32,
    /// `KHR_materials_unlit`: the base colour as it stands.
    pub unlit: bool,
    /// Whether it is seen from behind.
    pub double_sided: bool,
    /// `alphaMode` `MASK`: less opacity than this is nothing, more is solid.
    pub cutoff: Option<f32>,
    /// `alphaMode` `BLEND`.
    pub blend: bool,
}

impl Default for Factors {
    fn default() -> Self {
        Self {
            base_color: [1.0; 3],
            opacity: 1.0,
            metallic: 1.0,
            roughness: 1.0,
            emission: [0.0; 3],
            normal_scale: 1.0,
            occlusion_strength: 1.0,
            ior: 1.5,
            specular: 1.0,
            specular_color: [1.0; 3],
            anisotropy: 0.0,
            anisotropy_rotation: 0.0,
            clearcoat: 0.0,
            clearcoat_roughness: 0.0,
            clearcoat_normal_scale: 1.0,
            sheen_color: [0.0; 3],
            sheen_roughness: 0.0,
            unlit: false,
            double_sided: false,
            cutoff: None,
            blend: false,
        }
    }
}

impl Factors {
    /// Brings every number into its domain, and says which were outside.
    pub(crate) fn bring_into_domain(&mut self) -> Vec<String> {
        let mut said = Vec::new();
        let mut bring = |name: &str, number: &mut f32, low: f32, high: f32, or: f32| {
            if !(low..=high).contains(number) {
                let used = if number.is_nan() { or } else { number.clamp(low, high) };
                said.push(format!("{name} is {number}, and lies between {low} and {high}; {used} is taken"));
                *number = used;
            }
        };
        let mut unit = |name: &str, number: &mut f32, or: f32| bring(name, number, 0.0, 1.0, or);
        self.base_color.iter_mut().for_each(|part| unit("the base colour", part, 1.0));
        unit("the opacity", &mut self.opacity, 1.0);
        unit("metallicFactor", &mut self.metallic, 1.0);
        unit("roughnessFactor", &mut self.roughness, 1.0);
        unit("the occlusion's strength", &mut self.occlusion_strength, 1.0);
        unit("specularFactor", &mut self.specular, 1.0);
        unit("anisotropyStrength", &mut self.anisotropy, 0.0);
        unit("clearcoatFactor", &mut self.clearcoat, 0.0);
        unit("clearcoatRoughnessFactor", &mut self.clearcoat_roughness, 0.0);
        self.sheen_color.iter_mut().for_each(|part| unit("sheenColorFactor", part, 0.0));
        unit("sheenRoughnessFactor", &mut self.sheen_roughness, 0.0);
        if self.ior != 0.0 {
            bring("ior", &mut self.ior, 1.0, 1e6, 1.5);
        }
        self.specular_color.iter_mut().for_each(|part| bring("specularColorFactor", part, 0.0, 1e6, 1.0));
        self.emission.iter_mut().for_each(|part| bring("the emission", part, 0.0, 1e9, 0.0));
        for (name, number) in [
            ("the normal map's scale", &mut self.normal_scale),
            ("the coat's normal map's scale", &mut self.clearcoat_normal_scale),
            ("anisotropyRotation", &mut self.anisotropy_rotation),
        ] {
            bring(name, number, -1e6, 1e6, 0.0);
        }
        if let Some(cutoff) = &mut self.cutoff {
            // Above 1 it hides everything, which is allowed.
            bring("alphaCutoff", cutoff, 0.0, 1e6, 0.5);
        }
        said
    }
}

/// The textures of a material; each multiplies its factor.
#[derive(Debug, Clone, Default)]
pub struct Maps {
    /// RGB and opacity.
    pub base_color: Option<Map>,
    /// Roughness in G, metallic in B.
    pub metallic_roughness: Option<Map>,
    /// The normal, in the tangent frame.
    pub normal: Option<Map>,
    /// Occlusion of ambient light in R.
    pub occlusion: Option<Map>,
    /// RGB.
    pub emission: Option<Map>,
    /// The specular weight in A.
    pub specular: Option<Map>,
    /// RGB.
    pub specular_color: Option<Map>,
    /// The direction in RG, the strength in B.
    pub anisotropy: Option<Map>,
    /// The coat's intensity in R.
    pub clearcoat: Option<Map>,
    /// Its roughness in G.
    pub clearcoat_roughness: Option<Map>,
    /// Its normal.
    pub clearcoat_normal: Option<Map>,
    /// RGB.
    pub sheen_color: Option<Map>,
    /// The sheen's roughness in A.
    pub sheen_roughness: Option<Map>,
}

/// A material of glTF 2.0.
///
/// A layer that is absent is not computed, and `KHR_materials_ior` and `specular` at their defaults are not either, unless
/// the material needs the kernel for anisotropy or sheen. Dielectric and metal are always both computed.
#[derive(Debug, Clone, Default)]
pub struct GltfMaterial {
    /// Its numbers.
    pub factors: Factors,
    /// Its textures.
    pub maps: Maps,
}

/// A material at one point.
#[derive(Debug, Clone)]
pub(crate) struct AtPoint {
    pub(crate) base_color: Rgb,
    pub(crate) metallic: f32,
    pub(crate) alpha: f32,
    pub(crate) emission: Rgb,
    pub(crate) occlusion: f32,
    /// In the tangent frame; +z without a map.
    pub(crate) normal: Vec3,
    /// Of the grooves, in the tangent plane.
    pub(crate) direction: Vec2,
    pub(crate) anisotropy: f32,
    pub(crate) specular: f32,
    pub(crate) specular_color: Rgb,
    pub(crate) sheen_color: Rgb,
    pub(crate) sheen_alpha: f32,
    pub(crate) coat: f32,
    pub(crate) coat_alpha: f32,
    pub(crate) coat_normal: Vec3,
}

/// `α` of a perceptual roughness, in the domain of the lobes.
fn alpha(roughness: f32, least: f32) -> f32 {
    let roughness = roughness.clamp(least, 1.0);
    roughness * roughness
}

impl GltfMaterial {
    /// How solid it is at a point: 0 where it is cut out, 1 where it is not seen through.
    pub(crate) fn opacity(&self, uv: [Vec2; 2], footprint: [f32; 2], color: f32) -> f32 {
        let factors = &self.factors;
        if factors.cutoff.is_none() && !factors.blend {
            return 1.0;
        }
        let map = self.maps.base_color.as_ref().map_or(1.0, |map| map.at(uv, footprint)[3]);
        let opacity = (factors.opacity * map * color).clamp(0.0, 1.0);
        match factors.cutoff {
            Some(cutoff) => f32::from(u8::from(opacity >= cutoff)),
            None => opacity,
        }
    }

    /// Whether some of it can be seen through.
    pub(crate) fn is_open(&self) -> bool {
        self.factors.cutoff.is_some() || self.factors.blend
    }

    /// Whether a point needs a tangent.
    pub(crate) fn needs_tangents(&self) -> bool {
        self.maps.normal.is_some() || self.maps.clearcoat_normal.is_some() || self.is_anisotropic()
    }

    pub(crate) fn is_anisotropic(&self) -> bool {
        self.factors.anisotropy > 0.0
    }

    pub(crate) fn has_sheen(&self) -> bool {
        self.factors.sheen_color != [0.0; 3]
    }

    pub(crate) fn has_coat(&self) -> bool {
        self.factors.clearcoat > 0.0
    }

    /// Whether the numbers of `KHR_materials_specular` differ from point to point, or a layer needs the full kernel.
    pub(crate) fn is_full(&self) -> bool {
        self.maps.specular.is_some() || self.maps.specular_color.is_some() || self.is_anisotropic() || self.has_sheen()
    }

    /// What it is at a point.
    pub(crate) fn at(&self, uv: [Vec2; 2], footprint: [f32; 2], color: Rgb) -> AtPoint {
        let (factors, maps) = (&self.factors, &self.maps);
        let read = |map: &Option<Map>| map.as_ref().map_or([1.0; 4], |map| map.at(uv, footprint));
        let rgb = |factor: [f32; 3], map: &Option<Map>| {
            let [r, g, b, _] = read(map);
            Rgb::from(factor) * Rgb::new(r, g, b)
        };
        let normal =
            |map: &Option<Map>, scale: f32| map.as_ref().map_or(Vec3::Z, |map| map.normal(scale, uv, footprint));
        let [_, roughness, metallic, _] = read(&maps.metallic_roughness);
        let (sine, cosine) = factors.anisotropy_rotation.sin_cos();
        let (mut direction, mut anisotropy) = (Vec2::X, factors.anisotropy);
        if let Some(map) = &maps.anisotropy {
            let [x, y, strength, _] = map.at(uv, footprint);
            direction = Vec2::new(2.0 * x - 1.0, 2.0 * y - 1.0).normalize_or(Vec2::X);
            anisotropy *= strength;
        }
        let [.., specular] = read(&maps.specular);
        let [.., sheen_roughness] = read(&maps.sheen_roughness);
        let unit = |c: Rgb| c.map(|part| part.clamp(0.0, 1.0));
        AtPoint {
            base_color: unit(rgb(factors.base_color, &maps.base_color) * color),
            metallic: factors.metallic * metallic,
            alpha: alpha(factors.roughness * roughness, 0.01),
            emission: rgb(factors.emission, &maps.emission),
            occlusion: 1.0 + factors.occlusion_strength * (read(&maps.occlusion)[0] - 1.0),
            normal: normal(&maps.normal, factors.normal_scale),
            direction: Vec2::new(cosine * direction.x - sine * direction.y, sine * direction.x + cosine * direction.y),
            anisotropy,
            specular: factors.specular * specular,
            specular_color: rgb(factors.specular_color, &maps.specular_color),
            sheen_color: rgb(factors.sheen_color, &maps.sheen_color),
            sheen_alpha: alpha(factors.sheen_roughness * sheen_roughness, 0.1),
            coat: factors.clearcoat * read(&maps.clearcoat)[0],
            coat_alpha: alpha(factors.clearcoat_roughness * read(&maps.clearcoat_roughness)[1], 0.01),
            coat_normal: normal(&maps.clearcoat_normal, factors.clearcoat_normal_scale),
        }
    }

    /// What of ambient light is sent on, roughly, seen at these cosines to the normals of base and coat: of light from all
    /// around, by the diffuse lobe; and of light from around the mirror direction, by the others.
    ///
    /// The albedo of a microfacet lobe is Karis' fit (*Physically Based Shading on Mobile*, 2014).
    pub(crate) fn ambient(&self, at: &AtPoint, cos: f32, coat_cos: f32) -> (Rgb, Rgb) {
        let f0 = ((self.factors.ior - 1.0) / (self.factors.ior + 1.0)).powi(2);
        let f0 = (at.specular_color * f0).map(|f0| f0.min(1.0)) * at.specular;
        let (scale, bias) = albedo(at.alpha, cos);
        let dielectric = f0 * scale + Rgb::splat(bias * at.specular);
        let metal = at.base_color * scale + Rgb::splat(bias);
        let specular = dielectric * (1.0 - at.metallic) + metal * at.metallic;
        let below = Rgb::new(1.0 - dielectric.r, 1.0 - dielectric.g, 1.0 - dielectric.b);
        let diffuse = at.base_color * below * (1.0 - at.metallic);
        let (scale, bias) = albedo(at.coat_alpha, coat_cos);
        let coat = (0.04 * scale + bias) * at.coat;
        let rest = at.occlusion * (1.0 - coat);
        (diffuse * rest, specular * rest + Rgb::splat(coat * at.occlusion))
    }

    /// What goes into the columns of a batch for a point: as many numbers as the kernel has parameters.
    pub(crate) fn parameters(&self, at: &AtPoint) -> ([f32; FULL], usize) {
        let (base, color, sheen) = (at.base_color, at.specular_color, at.sheen_color);
        let all = [
            base.r,
            base.g,
            base.b,
            at.metallic,
            at.alpha,
            at.specular,
            color.r,
            color.g,
            color.b,
            at.anisotropy,
            sheen.r,
            sheen.g,
            sheen.b,
            at.sheen_alpha,
        ];
        (all, if self.is_full() { FULL } else { PLAIN })
    }

    /// Its lobe as the catalogue has it, for tables and plots: with the factors and without textures. None for an unlit one.
    /// What the catalogue does not have is left out: a sheen under a coat, and an `ior` of 0 or above 4.
    #[must_use]
    pub fn lobes(&self) -> Vec<lobe_models::Lobe> {
        use lobe_models::{Lobe, Value, model};
        let f = &self.factors;
        if f.unlit {
            return Vec::new();
        }
        // As the file says it: 0.3 and not 0.30000001192092896. In `f32` it is the same.
        let exact = |x: f32| x.to_string().parse().unwrap_or(f64::from(x));
        let colour = |c: [f32; 3]| Value::Colour(c.map(exact));
        let number = |x: f32, low: f32| Value::Number(exact(x.max(low)));
        let default = Factors::default();
        let mut base = vec![
            ("base-color", colour(f.base_color)),
            ("metallic", number(f.metallic, 0.0)),
            ("roughness", number(f.roughness, 0.01)),
        ];
        if f.ior != default.ior && (1.0..=4.0).contains(&f.ior) {
            base.push(("ior", number(f.ior, 1.0)));
        }
        if f.specular != default.specular {
            base.push(("specular", number(f.specular, 0.0)));
        }
        if f.specular_color != default.specular_color {
            base.push(("specular-color", colour(f.specular_color.map(|part| part.min(25.0)))));
        }
        if self.is_anisotropic() {
            base.push(("anisotropy", number(f.anisotropy, 0.0)));
        }
        let coat =
            [("clearcoat", number(f.clearcoat, 0.0)), ("clearcoat-roughness", number(f.clearcoat_roughness, 0.01))];
        let sheen = [("sheen-color", colour(f.sheen_color)), ("sheen-roughness", number(f.sheen_roughness, 0.1))];
        let name = match (self.has_coat(), self.has_sheen()) {
            (false, false) => "gltf",
            (true, _) => "gltf-clearcoat",
            (false, true) => "gltf-sheen",
        };
        match name {
            "gltf-clearcoat" => base.extend(coat),
            "gltf-sheen" => base.extend(sheen),
            _ => {}
        }
        let built = model(name).map(|model| Lobe::new(model, &base));
        built.and_then(Result::ok).into_iter().collect()
    }

    /// Which lobes it is made of, and why, in words with `code` between backticks; then what is left out.
    #[must_use]
    pub fn reasons(&self) -> Vec<String> {
        let (f, maps, default) = (&self.factors, &self.maps, Factors::default());
        if f.unlit {
            return vec!["no lobe: it is unlit, and its base color is what is seen".to_owned()];
        }
        let mut has =
            vec!["`gltf`: a diffuse and a microfacet lobe, which every material of metal and roughness has".to_owned()];
        let mut lacks = Vec::new();
        let mut part = |there: bool, what: String, name: &'static str| match there {
            true => has.push(what),
            false => lacks.push(name),
        };
        let number = |name: &str, x: f32| format!("`{name}` is {x}");
        let specular = match (maps.specular.is_some() || maps.specular_color.is_some(), f.ior != default.ior) {
            (true, _) => "a picture says it point by point".to_owned(),
            (false, true) => number("ior", f.ior),
            (false, false) if f.specular != default.specular => number("specular", f.specular),
            (false, false) => "its colour is not white".to_owned(),
        };
        let is_special = self.plain().specular.is_some() || maps.specular.is_some() || maps.specular_color.is_some();
        part(is_special, format!("a dielectric reflectance of its own: {specular}"), "`specular` and `ior`");
        let anisotropy = number("anisotropy", f.anisotropy);
        part(self.is_anisotropic(), format!("two widths: {anisotropy}"), "anisotropy");
        part(self.has_sheen(), "a lobe of sheen: its colour is not black".to_owned(), "sheen");
        let coat = number("clearcoat", f.clearcoat);
        part(self.has_coat(), format!("a lobe of the coat, in its own frame: {coat}"), "clearcoat");
        if !lacks.is_empty() {
            has.push(format!("left out, at their defaults: {}", lacks.join(", ")));
        }
        let pictures = [
            ("base color", &maps.base_color),
            ("metal and roughness", &maps.metallic_roughness),
            ("normal", &maps.normal),
            ("occlusion", &maps.occlusion),
            ("emission", &maps.emission),
            ("specular", &maps.specular),
            ("specular color", &maps.specular_color),
            ("anisotropy", &maps.anisotropy),
            ("coat", &maps.clearcoat),
            ("coat's roughness", &maps.clearcoat_roughness),
            ("coat's normal", &maps.clearcoat_normal),
            ("sheen", &maps.sheen_color),
            ("sheen's roughness", &maps.sheen_roughness),
        ];
        has.extend(crate::maps::pictures(&pictures));
        has
    }

    /// The kernel of a base without layers, whose `KHR_materials_specular` is the same everywhere.
    pub(crate) fn plain(&self) -> Plain {
        let Factors { ior, specular, specular_color, .. } = self.factors;
        let default = Factors::default();
        let is_default = (ior, specular, specular_color) == (default.ior, default.specular, default.specular_color);
        Plain { specular: (!is_default).then_some((ior, specular, specular_color)) }
    }

    /// The kernel of any base.
    pub(crate) fn full(&self) -> Full {
        Full { ior: self.factors.ior, anisotropic: self.is_anisotropic(), sheen: self.has_sheen() }
    }
}

/// The albedo of a microfacet lobe as `F0 · scale + bias`.
fn albedo(alpha: f32, cos: f32) -> (f32, f32) {
    let split = KarisMobile.split(Alpha(alpha), cos);
    // The fit goes a little below 0 at some angles, and a surface never takes light away.
    (split.scale.max(0.0), split.bias.max(0.0))
}

/// How many parameters [`Plain`] has.
pub(crate) const PLAIN: usize = 5;
/// How many parameters [`Full`] has.
pub(crate) const FULL: usize = 14;

/// `(base colour, metallic, α)`.
pub(crate) type PlainInput<R> = (Rgb<R>, R, R);
/// Those, `(specular, specular colour)`, the anisotropy, `(sheen colour, sheen α)`.
pub(crate) type FullInput<R> = (PlainInput<R>, (R, Rgb<R>), R, (Rgb<R>, R));

/// `eval_cos · E` of the base.
#[derive(Clone, Copy)]
pub(crate) struct Plain {
    /// `η`, the weight and the colour, if they are not the default.
    specular: Option<(f32, f32, [f32; 3])>,
}

impl<R: Real> Kernel<((lobe::Vec3<R>, lobe::Vec3<R>, Rgb<R>), PlainInput<R>), Rgb<R>> for Plain {
    #[inline(always)]
    fn apply(
        &self,
        ((l, v, e), (base, metallic, alpha)): ((lobe::Vec3<R>, lobe::Vec3<R>, Rgb<R>), PlainInput<R>),
    ) -> Rgb<R> {
        let mut lobes = MetallicRoughness::new(base, metallic, Alpha(alpha));
        if let Some((ior, weight, [r, g, b])) = self.specular {
            let color = Rgb::new(alpha.lift(f64::from(r)), alpha.lift(f64::from(g)), alpha.lift(f64::from(b)));
            lobes = lobes.with_specular(alpha.lift(f64::from(ior)), alpha.lift(f64::from(weight)), color);
        }
        lobes.eval_cos(l, v) * e
    }
}

/// `eval_cos · E` of a base with everything but a coat.
#[derive(Clone, Copy)]
pub(crate) struct Full {
    ior: f32,
    anisotropic: bool,
    sheen: bool,
}

impl<R: Real> Kernel<((lobe::Vec3<R>, lobe::Vec3<R>, Rgb<R>), FullInput<R>), Rgb<R>> for Full {
    #[inline(always)]
    fn apply(&self, ((l, v, e), input): ((lobe::Vec3<R>, lobe::Vec3<R>, Rgb<R>), FullInput<R>)) -> Rgb<R> {
        let ((base, metallic, alpha), (specular, color), anisotropy, (sheen, sheen_alpha)) = input;
        let base = MetallicRoughness::new(base, metallic, Alpha(alpha));
        let base = base.with_specular(alpha.lift(f64::from(self.ior)), specular, color);
        // The same for all points: one of four loops.
        let f = match (self.anisotropic, self.sheen) {
            (false, false) => base.eval_cos(l, v),
            (true, false) => base.with_anisotropy(anisotropy).eval_cos(l, v),
            (false, true) => SheenLayer::new(base, sheen, Alpha(sheen_alpha)).eval_cos(l, v),
            (true, true) => SheenLayer::new(base.with_anisotropy(anisotropy), sheen, Alpha(sheen_alpha)).eval_cos(l, v),
        };
        f * e
    }
}

/// `eval_cos · E` of a coat alone, for its intensity and its `α`. What is below it gets the rest,
/// [`Clearcoat::transmitted`].
#[derive(Clone, Copy)]
pub(crate) struct Coat;

impl<R: Real> Kernel<((lobe::Vec3<R>, lobe::Vec3<R>, Rgb<R>), (R, R)), Rgb<R>> for Coat {
    #[inline(always)]
    fn apply(&self, ((l, v, e), (coat, alpha)): ((lobe::Vec3<R>, lobe::Vec3<R>, Rgb<R>), (R, R))) -> Rgb<R> {
        Clearcoat::new(Black, coat, Alpha(alpha)).eval_cos(l, v) * e
    }
}
