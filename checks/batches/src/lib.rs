//! Batch kernels: what `tests/assembly.rs` reads the machine code of, and what the example runs, so
//! that `checks/batches/instructions` can count its instructions.

pub mod mutants;

use lobe::batch::{Batch, Level};
use lobe::distribution::{Beckmann, Ggx};
use lobe::fresnel::{Conductor, Schlick};
use lobe::masking::{SmithCorrelated, SmithSeparable};
use lobe::number::{Fast, Precise, Precision as _};
use lobe::{Alpha, BlinnPhong, Lambert, MetallicRoughness, Microfacet, Phong, Rgb, Shininess, Vec3, Ward};

/// A batch of one kernel: the level, `l`, `v`, and where the colours go.
pub type Run = fn(Level, Vec3<&[f32]>, Vec3<&[f32]>, Rgb<&mut [f32]>);

/// A kernel at one precision.
#[derive(Clone, Copy, Debug)]
pub struct Named {
    /// The lobe.
    pub kernel: &'static str,
    /// `precise` or `fast`.
    pub precision: &'static str,
    /// What runs it.
    pub run: Run,
    /// The type of its lobe as names of functions have it, without modules.
    pub type_name: &'static str,
}

macro_rules! kernels {
    ($($name:ident: $lobe:expr, $type_name:literal;)+) => {
        $(
            /// `eval_cos` of one lobe.
            pub mod $name {
                use super::*;
                /// The bits of the scalar.
                pub fn precise(level: Level, l: Vec3<&[f32]>, v: Vec3<&[f32]>, out: Rgb<&mut [f32]>) {
                    Batch::at(level).eval_cos(&$lobe, l, v, out).expect("the slices are equally long");
                }
                /// To 13 binary digits.
                pub fn fast(level: Level, l: Vec3<&[f32]>, v: Vec3<&[f32]>, out: Rgb<&mut [f32]>) {
                    let batch = Batch::at(level).precision::<Fast>();
                    batch.eval_cos(&$lobe, l, v, out).expect("the slices are equally long");
                }
            }
        )+

        /// All of them.
        pub const KERNELS: &[Named] = &[$(
            Named { kernel: stringify!($name), precision: Precise::NAME, run: $name::precise, type_name: $type_name },
            Named { kernel: stringify!($name), precision: Fast::NAME, run: $name::fast, type_name: $type_name },
        )+];
    };
}

kernels! {
    lambert: Lambert::new(Rgb::new(0.8_f32, 0.5, 0.2)), "Lambert";
    phong: Phong::new(COLOR, Shininess(50.0)), "Phong";
    blinn_phong: BlinnPhong::new(COLOR, Shininess(50.0)), "BlinnPhong";
    ggx: Microfacet::new(Ggx::new(Alpha(0.3)), SmithCorrelated, Schlick::new(COLOR)),
        "Microfacet<Ggx, SmithCorrelated, Schlick>";
    ggx_conductor: Microfacet::new(
        Ggx::new(Alpha(0.3)),
        SmithCorrelated,
        Conductor::new(Rgb::new(0.2, 0.9, 1.1), Rgb::new(3.9, 2.4, 2.2))
    ), "Microfacet<Ggx, SmithCorrelated, Conductor>";
    beckmann: Microfacet::new(Beckmann::new(Alpha(0.3)), SmithSeparable, Schlick::new(COLOR)),
        "Microfacet<Beckmann, SmithSeparable, Schlick>";
    ward: Ward::new(COLOR, Alpha(0.2), Alpha(0.5)), "Ward";
    metallic_roughness: MetallicRoughness::new(COLOR, 0.5, Alpha(0.3)), "MetallicRoughness";
}

const COLOR: Rgb = Rgb { r: 0.9, g: 0.6, b: 0.3 };
