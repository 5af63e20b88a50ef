//! Prints the directional albedo of the power lobes over exponent and angle: the table of `docs/numerics.md`.
//!
//! ```text
//! cargo run --release -p lobe-energy --example albedo
//! ```

use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
use lobe::{BlinnPhong, Brdf, CommonNormalization, Phong, Rgb, Shininess, Vec3};
use lobe_energy::directional_albedo;

const ANGLES: [f64; 6] = [0.0, 30.0, 45.0, 60.0, 75.0, 85.0];

fn main() {
    println!("| lobe, coefficient 1 | q | {} |", ANGLES.map(|a| format!("{a}°")).join(" | "));
    println!("|---|---|{}", "---|".repeat(ANGLES.len()));
    for q in [0.0, 1.0, 8.0, 50.0, 1e3, 1e6] {
        let (white, s) = (Rgb::splat(1.0), Shininess(q));
        let common = BlinnPhong::<f64, CommonNormalization>::with_normalization(white, s);
        let lobes: [(&str, &dyn Brdf<f64>); 5] = [
            ("`Phong`", &Phong::new(white, s)),
            ("`BlinnPhong`", &BlinnPhong::new(white, s)),
            ("`BlinnPhong`, common", &common),
            ("`PhongHighlight`", &PhongHighlight::new(white, s)),
            ("`BlinnTorranceHighlight`", &BlinnTorranceHighlight::new(white, s)),
        ];
        for (name, lobe) in lobes {
            let row = ANGLES.map(|angle| {
                let (sin, cos) = libm::sincos(angle.to_radians());
                format!("{:.4}", directional_albedo(lobe, Vec3::new(sin, 0.0, cos)).value.g)
            });
            println!("| {name} | {q} | {} |", row.join(" | "));
        }
    }
}
