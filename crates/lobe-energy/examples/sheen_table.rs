//! The albedo of a white Charlie sheen, as the table that `lobe`'s `SheenLayer` interpolates: a row for each roughness
//! from 0.1 to 1, a column for each `√cos θ` from 0 to 1.
//!
//! ```text
//! cargo run --release --example sheen_table -p lobe-energy
//! ```

use lobe::{Alpha, Charlie, Rgb, Vec3};
use lobe_energy::directional_albedo;

fn main() {
    for row in 0..12 {
        let roughness = 0.1 + 0.9 * f64::from(row) / 11.0;
        let sheen = Charlie::new(Rgb::splat(1.0), Alpha(roughness * roughness));
        let values: Vec<_> = (0..16)
            .map(|i| {
                // On the horizon itself nothing is reflected; the limit is taken a little above it.
                let cos = (f64::from(i) / 15.0).powi(2).max(1e-5);
                let albedo = directional_albedo(&sheen, Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos));
                format!("{:.4}", albedo.value.g)
            })
            .collect();
        println!("    [{}],", values.join(", "));
    }
}
