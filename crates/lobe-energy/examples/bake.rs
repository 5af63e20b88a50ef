//! Computes the albedos of GGX that `src/baked.rs` holds, and prints that file.
//!
//!     cargo run --release -p lobe-energy --example bake > baked.rs && mv baked.rs crates/lobe-energy/src/
//!
//! It takes some minutes.

use lobe::{Alpha, Microfacet, Rgb, Vec3};
use lobe::{distribution::Ggx, fresnel::Schlick, masking::SmithCorrelated};
use lobe_energy::{Corner, microfacet_albedo};
use std::f64::consts::PI;
use std::fmt::Write as _;

/// Nodes of the tables in each direction.
const NODES: usize = 32;
/// Coefficients of the polynomials along the width and along the cosine.
const FIT: (usize, usize) = (10, 11);
/// Coefficients of the mean losses, along the width.
const MEANS: usize = 10;

/// `1 − E` of a white GGX, and the mean of `(1 − v·h)⁵` over what it reflects.
fn loss_and_weight(alpha: f64, mu: f64) -> (f64, f64) {
    let v = Vec3::new(((1.0 - mu) * (1.0 + mu)).max(0.0).sqrt(), 0.0, mu);
    // Schlick's term with F0 = 0 is the weight.
    let lobe = Microfacet::new(Ggx::new(Alpha(alpha)), SmithCorrelated, Schlick::new(Rgb::new(1.0, 0.0, 0.0)));
    let albedo = microfacet_albedo(&lobe, (Alpha(alpha), Alpha(alpha)), v).value;
    (1.0 - albedo.r, albedo.g / albedo.r)
}

/// The loss in units of the corner's own scale.
fn scaled_loss(s: f64, x: f64) -> f64 {
    let alpha = s * s;
    let mu = Corner::cosine(alpha, x);
    loss_and_weight(alpha, mu).0 / Corner::new(alpha, mu).scale
}

/// Roots of the Chebyshev polynomial of degree `n`.
fn roots(n: usize) -> Vec<f64> {
    (0..n).map(|i| (PI * (i as f64 + 0.5) / n as f64).cos()).collect()
}

/// The coefficients of the polynomial through values at these roots.
fn coefficients(values: &[f64]) -> Vec<f64> {
    let n = values.len();
    let sum = |k: usize| -> f64 {
        let term = |(i, value): (usize, &f64)| value * (PI * k as f64 * (i as f64 + 0.5) / n as f64).cos();
        values.iter().enumerate().map(term).sum::<f64>() * if k == 0 { 1.0 } else { 2.0 } / n as f64
    };
    (0..n).map(sum).collect()
}

/// `2 ∫ μ loss(μ) dμ` in units of `α² (1 − ln α)`, for a loss that is an interpolation: to 1e-5 with many points.
fn mean(alpha: f64, loss: impl Fn(f64) -> f64) -> f64 {
    // Even in ln μ, from 1e-8: below there is 1e-16 of the light.
    const STEPS: usize = 4000;
    let step = 1e8_f64.ln() / STEPS as f64;
    let at = |i: usize| {
        let mu = (-(i as f64 + 0.5) * step).exp();
        2.0 * mu * mu * loss(mu)
    };
    (0..STEPS).map(at).sum::<f64>() * step / (alpha * alpha * (1.0 - alpha.ln()))
}

fn array(out: &mut String, name: &str, doc: &str, rows: &[Vec<f64>]) {
    let columns = rows[0].len();
    let _ =
        writeln!(out, "\n/// {doc}\n#[rustfmt::skip]\npub(crate) const {name}: [[f64; {columns}]; {}] = [", rows.len());
    for row in rows {
        let numbers: Vec<_> = row.iter().map(|x| format!("{x:.7}")).collect();
        let _ = writeln!(out, "    [{}],", numbers.join(", "));
    }
    *out += "];\n";
}

fn main() {
    let even = |i: usize| i as f64 / (NODES - 1) as f64;
    // The width's axis starts at the smallest width of the domain.
    let width = |part: f64| 0.01 + 0.99 * part;
    let widths: Vec<f64> = (0..NODES).map(|i| width(even(i))).collect();
    let losses: Vec<Vec<f64>> =
        widths.iter().map(|&s| (0..NODES).map(|j| scaled_loss(s, even(j).clamp(1e-6, 1.0))).collect()).collect();
    let weight = |s: f64, root: f64| loss_and_weight(s * s, (root * root).clamp(1e-9, 1.0)).1;
    let weights: Vec<Vec<f64>> = widths.iter().map(|&s| (0..NODES).map(|j| weight(s, even(j))).collect()).collect();

    // First along the cosine at each root of the width, then along the width.
    let across: Vec<Vec<f64>> = roots(FIT.0)
        .iter()
        .map(|y| {
            let s = width(0.5 + 0.5 * y);
            // Over `x`, so that the loss is 0 at the horizon to the last digit.
            let values: Vec<f64> = roots(FIT.1).iter().map(|x| 0.5 + 0.5 * x).map(|x| scaled_loss(s, x) / x).collect();
            coefficients(&values)
        })
        .collect();
    let fit: Vec<Vec<f64>> =
        (0..FIT.1).map(|k| coefficients(&across.iter().map(|row| row[k]).collect::<Vec<_>>())).collect();

    // The means of what is interpolated, not of what is exact: a loss over its own mean integrates to 1.
    let widths: Vec<f64> = roots(MEANS).iter().map(|y| width(0.5 + 0.5 * y)).collect();
    let interpolated = |s: f64, mu: f64| {
        let corner = Corner::new(s * s, mu);
        let hat = |x: f64, i: usize| (1.0 - (x * (NODES - 1) as f64 - i as f64).abs()).max(0.0);
        let row = |row: &Vec<f64>| row.iter().enumerate().map(|(j, q)| q * hat(corner.x, j)).sum::<f64>();
        let y = (s - 0.01) / 0.99;
        losses.iter().enumerate().map(|(i, q)| if hat(y, i) > 0.0 { row(q) * hat(y, i) } else { 0.0 }).sum::<f64>()
            * corner.scale
    };
    let polynomial = |s: f64, mu: f64| {
        let corner = Corner::new(s * s, mu);
        let sum = |c: &[f64], x: f64| {
            let t = |k: usize| (k as f64 * (2.0 * x - 1.0).clamp(-1.0, 1.0).acos()).cos();
            c.iter().enumerate().map(|(k, c)| c * t(k)).sum::<f64>()
        };
        let row: Vec<f64> = fit.iter().map(|c| sum(c, (s - 0.01) / 0.99)).collect();
        sum(&row, corner.x) * corner.x * corner.scale
    };
    let table_means: Vec<f64> = widths.iter().map(|&s| mean(s * s, |mu| interpolated(s, mu))).collect();
    let fit_means: Vec<f64> = widths.iter().map(|&s| mean(s * s, |mu| polynomial(s, mu))).collect();

    let mut out = String::from(
        "//! Albedos of GGX with Smith's correlated masking, computed by\n\
         //! `cargo run --release -p lobe-energy --example bake`; not to be edited.\n\
         //!\n\
         //! Rows of the tables are `√α` from 0.01 to 1, columns as each says, both even. Polynomials are sums of\n\
         //! Chebyshev's, of arguments that are brought from the same ranges to [−1, 1]. Coordinates: [`Corner`](crate::Corner).\n",
    );
    array(&mut out, "LOSS", "The scaled loss `(1 − E)/w` by `x` from 0 to 1.", &losses);
    array(&mut out, "WEIGHT", "The mean of `(1 − v·h)⁵` by `√μ` from 0 to 1.", &weights);
    array(
        &mut out,
        "LOSS_FIT",
        "The scaled loss over `x` as a polynomial: a row for each degree in `x`, a column for each in `√α`.",
        &fit,
    );
    array(
        &mut out,
        "MEANS",
        "`2 ∫ μ (1 − E) dμ/(α² (1 − ln α))` as polynomials in `√α`: of the table, and of the polynomial.",
        &[coefficients(&table_means), coefficients(&fit_means)],
    );
    print!("{out}");
}
